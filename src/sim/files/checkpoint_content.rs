//! The bytes of a checkpoint.
//!
//! | bytes | content |
//! |---|---|
//! | 0..20 | `stribeck checkpoint\n` |
//! | 20..24 | format version, little-endian |
//! | 24..32 | length of the content, little-endian |
//! | 32..36 | CRC-32 of the content, little-endian |
//! | 36.. | content in the `postcard` format |

use std::borrow::Cow;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::InputError;
use crate::grid::Grid;
use crate::plastic::PlasticDepth;
use crate::regular_file;
use crate::reynolds::ContactState;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::CheckpointError;
use crate::sim::history::body::Body;
use crate::sim::history::identity::Identity;
use crate::sim::history::squeeze_memory::SqueezeMemory;
use crate::tribochem::{FilmGrowthLaw, Tribofilm};
use crate::wear::WearDepth;

/// First bytes of a checkpoint file.
const MAGIC: &[u8; 20] = b"stribeck checkpoint\n";
/// Format version that this version of the crate writes and reads.
const FORMAT: u32 = 9;
/// Bytes before the content.
const HEADER: usize = 36;

/// Checks the temperature rises of the film on both surfaces.
pub(super) fn validate_rises(rises: Option<&[f64]>, grid: &Grid) -> Result<(), InputError> {
    let Some(rises) = rises else { return Ok(()) };
    InputError::require_len("film rises", rises, 2 * grid.len())?;
    InputError::require_finite("film rises", rises)
}

/// State of a body.
#[derive(Serialize, Deserialize)]
pub(super) struct BodyPart<'a> {
    /// Initial heights; a simulation that resumes must have the same ones.
    pub(super) initial: Cow<'a, [f64]>,
    /// Heights at the time of the checkpoint.
    pub(super) surface: Cow<'a, [f64]>,
    /// Worn depth.
    pub(super) wear: Cow<'a, [f64]>,
    /// Plastic depth.
    pub(super) plastic: Cow<'a, [f64]>,
    /// The tribofilm, if there is one.
    pub(super) film: Option<FilmPart<'a>>,
    /// Worn volume.
    pub(super) worn_volume: f64,
}

/// State of a tribofilm.
#[derive(Serialize, Deserialize)]
pub(super) struct FilmPart<'a> {
    /// State variables of the growth law, node by node.
    pub(super) states: Cow<'a, [f64]>,
    /// Total thickness that the nodes have gained and lost \[m\].
    pub(super) changes: [f64; 2],
}

/// All state that later steps depend on, and the identity of the run.
#[derive(Serialize, Deserialize)]
pub(super) struct Content<'a> {
    /// Scene and parts that the simulation was built from.
    pub(super) identity: Identity,
    /// Ball and disc.
    pub(super) bodies: [BodyPart<'a>; 2],
    /// Solution of the last step: with squeeze, the next step starts from it.
    pub(super) state: Cow<'a, ContactState>,
    /// The last two contacts.
    pub(super) squeeze_memory: Cow<'a, SqueezeMemory>,
    /// Simulated time \[s\].
    pub(super) time: f64,
    /// Number of committed steps.
    pub(super) step: u64,
    /// Number of roughness positions tried so far.
    pub(super) draws: u64,
    /// Initial temperature rise of the film in the next contact \[K\]; `None` for an isothermal film.
    pub(super) film_rises: Option<Cow<'a, [f64]>>,
    /// Warnings so far.
    pub(super) warnings: Cow<'a, [Warning]>,
}

impl<'a> BodyPart<'a> {
    /// The state of `body`.
    pub(super) fn of(body: &'a Body) -> Self {
        Self {
            initial: body.initial().into(),
            surface: body.surface().into(),
            wear: body.wear().into(),
            plastic: body.plastic_depth().into(),
            film: body
                .film
                .as_ref()
                .map(|film| FilmPart { states: film.states().into(), changes: film.changes() }),
            worn_volume: body.worn_volume,
        }
    }

    /// Rebuilds the body, with a film that grows by `law`. Rejects fields that do not have `n` finite values.
    pub(super) fn into_body(self, law: Option<&dyn FilmGrowthLaw>, n: usize) -> Result<Body, InputError> {
        let mut body = Body::new(self.initial.into_owned(), None);
        body.wear = WearDepth::from_values(self.wear.into_owned())?;
        body.plastic = PlasticDepth::from_values(self.plastic.into_owned())?;
        body.film = match (law, self.film) {
            (Some(law), Some(film)) => {
                Some(Tribofilm::from_states(law, film.states.into_owned(), film.changes)?)
            }
            (None, None) => None,
            _ => {
                return Err(InputError::Conflict {
                    field: "tribofilm".to_owned(),
                    reason: "there is a law or a film, not both".to_owned(),
                });
            }
        };
        body.surface = self.surface.into_owned();
        InputError::require_non_negative("worn volume", self.worn_volume)?;
        body.worn_volume = self.worn_volume;
        for (field, values) in [
            ("initial heights", body.initial()),
            ("surface", body.surface()),
            ("wear", body.wear()),
            ("plastic depth", body.plastic_depth()),
            ("tribofilm", body.tribofilm()),
        ] {
            InputError::require_len(field, values, n)?;
            InputError::require_finite(field, values)?;
        }
        Ok(body)
    }
}

/// Header and serialized `content`.
pub(super) fn with_header(content: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER + content.len());
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&FORMAT.to_le_bytes());
    bytes.extend_from_slice(&(content.len() as u64).to_le_bytes());
    bytes.extend_from_slice(&crc32fast::hash(content).to_le_bytes());
    bytes.extend_from_slice(content);
    bytes
}

/// The bytes of a file. Their number is not bounded: it depends on the grid.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, CheckpointError> {
    let io = |source| CheckpointError::Io { path: path.to_owned(), source };
    if !regular_file::begins_with(path, MAGIC).map_err(io)? {
        return Err(CheckpointError::Foreign { path: path.to_owned() });
    }
    regular_file::read(path, u64::MAX).map_err(io)
}

/// The content after a valid header.
pub(super) fn checked_content<'a>(path: &Path, bytes: &'a [u8]) -> Result<&'a [u8], CheckpointError> {
    let damaged =
        |reason: &str| CheckpointError::Damaged { path: path.to_owned(), reason: reason.to_owned() };
    let Some(rest) = bytes.strip_prefix(MAGIC) else {
        return Err(CheckpointError::Foreign { path: path.to_owned() });
    };
    let Some((header, content)) = rest.split_first_chunk::<{ HEADER - MAGIC.len() }>() else {
        return Err(damaged("it ends within its header"));
    };
    let [f0, f1, f2, f3, length @ .., c0, c1, c2, c3] = header;
    let found = u32::from_le_bytes([*f0, *f1, *f2, *f3]);
    if found > FORMAT {
        return Err(CheckpointError::Newer { path: path.to_owned(), found, known: FORMAT });
    }
    if found < FORMAT {
        return Err(damaged("its format is not one that this version reads"));
    }
    if length != (content.len() as u64).to_le_bytes().as_slice() {
        return Err(damaged("its length is not the one it was written with"));
    }
    if crc32fast::hash(content) != u32::from_le_bytes([*c0, *c1, *c2, *c3]) {
        return Err(damaged("its checksum does not fit"));
    }
    Ok(content)
}
