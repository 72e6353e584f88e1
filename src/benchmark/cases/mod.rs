//! Lists of cases.

mod generated;
mod references;

use std::path::Path;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng as _, SeedableRng as _};

use super::case::Case;
use super::case_file;
use crate::error::InputError;
use crate::sim::SimError;

/// Names of the lists of the crate.
const NAMES: [&str; 6] = ["battery", "corners", "map", "lines", "thermal", "references"];
/// Version of the lists of the crate, raised when a case changes.
const VERSION: u32 = 1;

/// A list of cases.
///
/// | list | cases |
/// |---|---|
/// | `battery` | 405 on 64 x 64 cells: all combinations of 5 speeds, 5 roughnesses, 2 correlation lengths, 3 pressures and 3 hardnesses; tags `battery` and `smooth` or `rough` |
/// | `corners` | 63 harder ones: finer meshes, anisotropic and exponential roughness, a measured disc, squeeze; 3 have no solution |
/// | `map` | both |
/// | `lines` | 64 rough line contacts on 512 cells |
/// | `thermal` | 444 of `map`, with film temperature, shear thinning, a limiting stress, a coating and spin; 3 have no solution |
/// | `references` | 36 small rough contacts with known limits |
///
/// ```
/// use stribeck::benchmark::{Case, Cases};
/// use stribeck::sim::Scene;
/// let mut cases = Cases::named("map", 1)?;
/// assert_eq!((cases.len(), cases.version), (468, 1));
/// cases.push(Case::new("own", Scene::azam_2019(64)).with_tags(["own"]));
/// assert_eq!(cases.clone().tagged("own").len(), 1);
/// assert_eq!(cases.draw(20, 7).len(), 20);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct Cases {
    /// Name of the list; empty for a list of the user.
    pub name: String,
    /// Version of the list of the crate: results of one version are comparable. 0 for a list of the user.
    pub version: u32,
    /// The cases.
    pub cases: Vec<Case>,
}

impl From<Vec<Case>> for Cases {
    fn from(cases: Vec<Case>) -> Self {
        Self { cases, ..Self::default() }
    }
}

impl Cases {
    /// The list of the crate with this name. `seed` is that of the roughness; the references ignore it.
    ///
    /// # Errors
    /// An unknown name.
    pub fn named(name: &str, seed: u64) -> Result<Self, SimError> {
        let cases = match name {
            "battery" => generated::battery(seed)?,
            "corners" => generated::corners(seed)?,
            "map" => [generated::battery(seed)?, generated::corners(seed)?].concat(),
            "lines" => generated::lines(seed)?,
            "thermal" => generated::thermal(seed)?,
            "references" => references::cases()?,
            _ => {
                let reason = format!("no list is called `{name}`; known: {}", NAMES.join(", "));
                return Err(InputError::Conflict { field: "cases".to_owned(), reason }.into());
            }
        };
        Ok(Self { name: name.to_owned(), version: VERSION, cases })
    }

    /// Names of the lists of the crate.
    pub fn names() -> &'static [&'static str] {
        &NAMES
    }

    /// Cases of a TOML file: tables `[[case]]` with `name`, `scene` (path of a scene file, relative to this one),
    /// and optionally `tags`, `parameters`, `history` and `reference`.
    ///
    /// ```toml
    /// [[case]]
    /// name = "ground disc, slow"
    /// scene = "ground_disc.toml"
    /// tags = ["measured"]
    /// parameters = { speed = 0.01 }
    /// history = { contacts = 6, time_step = 1e-4, is_transient = true }
    /// # The fingerprint is in the column `scene` of results.
    /// reference = { scene = "a430d5b1d6ce2bc5", load_ratio = [0.31, 0.02], mean_film = [21e-9, 1e-9] }
    /// ```
    ///
    /// # Errors
    /// A file that cannot be read, an unknown key, a value of another type; errors of the scene files.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, SimError> {
        case_file::load(path.as_ref()).map(Self::from)
    }

    /// Number of cases.
    pub fn len(&self) -> usize {
        self.cases.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.cases.is_empty()
    }

    /// Appends a case.
    pub fn push(&mut self, case: Case) {
        self.cases.push(case);
    }

    /// The cases followed by those of `other`.
    #[must_use]
    pub fn joined(mut self, other: impl Into<Self>) -> Self {
        self.cases.extend(other.into().cases);
        self
    }

    /// The cases with this tag.
    #[must_use]
    pub fn tagged(mut self, tag: &str) -> Self {
        self.cases.retain(|case| case.has_tag(tag));
        self
    }

    /// The first case and every `n`-th after it.
    #[must_use]
    pub fn every(mut self, n: usize) -> Self {
        self.cases = self.cases.into_iter().step_by(n.max(1)).collect();
        self
    }

    /// `count` cases, drawn without repetition by `seed`, in their order; all if there are fewer.
    #[must_use]
    pub fn draw(mut self, count: usize, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        while self.cases.len() > count {
            let place = (random.next_u64() % self.cases.len() as u64) as usize;
            self.cases.remove(place);
        }
        self
    }
}
