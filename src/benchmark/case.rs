//! One case: a scene with tags, parameters, and what is known of its solution.

use std::fmt;
use std::sync::Arc;

use super::limits::Limits;
use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::scene::GridSpec;
use crate::sim::{MixedLubricationSim, Scene, SimBuilder, SimError};
use crate::surface::{Advected, Heights, RoughnessSpec, generate};
use crate::with_fields::with_fields;

/// Heights of ball and disc on a grid \[m\], for surfaces that no scene describes.
#[derive(Clone)]
pub struct HeightsOnGrid(Arc<HeightsFn>);

/// The function of [`HeightsOnGrid`].
type HeightsFn = dyn Fn(&Grid) -> Result<[Vec<f64>; 2], SimError> + Send + Sync;

impl HeightsOnGrid {
    /// Heights by `heights`.
    pub fn new(heights: impl Fn(&Grid) -> Result<[Vec<f64>; 2], SimError> + Send + Sync + 'static) -> Self {
        Self(Arc::new(heights))
    }

    /// Random surfaces of both bodies on the mesh `coarse`, brought to finer meshes of its box by their Fourier series.
    pub fn by_fourier_series(coarse: Grid, surfaces: [RoughnessSpec; 2]) -> Self {
        Self::new(move |grid| {
            if grid.nx() < coarse.nx() || grid.ny() < coarse.ny() {
                let cells = coarse.nx().max(coarse.ny());
                let reason = format!("the surfaces have {cells} cells along each side, take as many or more");
                return Err(InputError::Conflict { field: "meshes".to_owned(), reason }.into());
            }
            let of = |spec: &RoughnessSpec| {
                let spacing = Some([coarse.dx(), coarse.dy()]);
                let heights =
                    Heights::new(coarse.nx(), coarse.ny(), spacing, generate(&coarse, spec)?, None)?;
                Ok::<_, SimError>(heights.resample_fourier(grid.nx(), grid.ny())?.heights().to_vec())
            };
            Ok([of(&surfaces[0])?, of(&surfaces[1])?])
        })
    }
}

impl fmt::Debug for HeightsOnGrid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("HeightsOnGrid")
    }
}

/// A case of several contacts, one after the other. The last one is reported; a failure of an earlier one ends
/// the case.
///
/// ```
/// use stribeck::benchmark::History;
/// let history = History::transient(6, 1e-4);
/// assert!(history.is_transient && history.contacts == 6);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct History {
    /// Number of contacts.
    pub contacts: u32,
    /// Time from one to the next \[s\].
    pub time_step: f64,
    /// Whether the roughness of both bodies is advected with them, with squeeze; otherwise it moves as in the
    /// scene.
    pub is_transient: bool,
}

impl History {
    /// `contacts` of a history, `time_step` \[s\] apart.
    pub fn new(contacts: u32, time_step: f64) -> Self {
        Self { contacts, time_step, is_transient: false }
    }

    /// `contacts` of advected surfaces with squeeze, `time_step` \[s\] apart.
    pub fn transient(contacts: u32, time_step: f64) -> Self {
        Self { contacts, time_step, is_transient: true }
    }
}

/// A scene that contestants solve.
///
/// ```
/// use stribeck::benchmark::{Case, Limits, Quantity};
/// use stribeck::sim::Scene;
/// let scene = Scene::azam_2019(64);
/// let limits = Limits::of(&scene)?.with(Quantity::LoadRatio, 0.31, 0.02);
/// let case = Case::new("reference contact", scene).with_tags(["rough"]).with_reference(Some(limits));
/// assert!(case.has_tag("rough") && !case.has_tag("smooth"));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Case {
    /// Name, unique in a benchmark.
    pub name: String,
    /// The scene. Contestants replace its solver, and the benchmark its tolerance.
    pub scene: Scene,
    /// Tags to filter by; the first one is the group in tables and pictures.
    pub tags: Vec<String>,
    /// Varied values by name, for tables and the layout of the stability map.
    pub parameters: Vec<(String, f64)>,
    /// Limits of fine meshes and small tolerances, if known.
    pub reference: Option<Limits>,
    /// Several contacts in place of one.
    pub history: Option<History>,
    /// Heights in place of those of the scene.
    pub heights: Option<HeightsOnGrid>,
}

with_fields!(Case {
    with_scene scene: Scene,
    with_parameters parameters: Vec<(String, f64)>,
    with_reference reference: Option<Limits>,
    with_history history: Option<History>,
    with_heights heights: Option<HeightsOnGrid>,
});

impl Case {
    /// The case of one contact.
    pub fn new(name: impl Into<String>, scene: Scene) -> Self {
        Self {
            name: name.into(),
            scene,
            tags: Vec::new(),
            parameters: Vec::new(),
            reference: None,
            history: None,
            heights: None,
        }
    }

    /// Replaces the tags.
    #[must_use]
    pub fn with_tags<T: Into<String>>(mut self, tags: impl IntoIterator<Item = T>) -> Self {
        self.tags = tags.into_iter().map(Into::into).collect();
        self
    }

    /// Whether the case has this tag.
    pub fn has_tag(&self, tag: &str) -> bool {
        self.tags.iter().any(|other| other == tag)
    }

    /// A builder of the contact of `scene`, a variant of that of the case, with the heights of the case.
    pub(super) fn builder(&self, scene: Scene) -> Result<SimBuilder, SimError> {
        if matches!(scene.grid, GridSpec::Accuracy { .. }) {
            let reason = "a benchmark solves on given cells: replace it by nx, ny, x and y".to_owned();
            return Err(InputError::Conflict { field: "grid.accuracy".to_owned(), reason }.into());
        }
        let heights = match &self.heights {
            Some(heights) => Some((heights.0)(&scene.grid()?)?),
            None => None,
        };
        let mut builder = MixedLubricationSim::builder(scene);
        if let Some([ball, disc]) = heights {
            builder = builder.ball_heights(ball).disc_heights(disc);
        }
        if self.history.is_some_and(|history| history.is_transient) {
            builder = builder.motion(Advected).with_squeeze();
        }
        Ok(builder)
    }

    /// Checks name and history.
    pub(super) fn validate(&self) -> Result<(), InputError> {
        if self.name.is_empty() {
            let reason = "a case has no name".to_owned();
            return Err(InputError::Conflict { field: "case.name".to_owned(), reason });
        }
        let Some(history) = self.history else { return Ok(()) };
        let field = |name: &str| format!("case `{}`: history.{name}", self.name);
        let contacts = f64::from(history.contacts);
        InputError::require(contacts >= 1.0, &field("contacts"), contacts, "at least 1")?;
        InputError::require_positive(&field("time_step"), history.time_step)
    }
}
