//! Bodies from an earlier run as a start.

use crate::error::{InputError, format_number};
use crate::grid::Grid;
use crate::plastic::PlasticDepth;
use crate::sim::history::body::Body;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::tribochem::{FilmGrowthLaw, Tribofilm};
use crate::wear::WearDepth;

/// State of a body from an earlier run: initial heights, wear, plastic depth and tribofilm, all on the grid of
/// the contact. Its surface is `initial - wear - plastic + tribofilm`.
///
/// ```
/// use stribeck::sim::{BodyStart, MixedLubricationSim, Scene};
/// let scene = Scene::azam_2019(32).with_tribofilm();
/// let mut first = MixedLubricationSim::builder(scene.clone()).build()?;
/// first.step(60.0)?;
/// let [ball, disc] = first.starts();
/// let mut faster = scene.clone();
/// faster.motion.entrainment_speed = 0.5;
/// let second = MixedLubricationSim::builder(faster).ball_start(ball).disc_start(disc).build()?;
/// assert_eq!(second.bodies()[1].surface(), first.bodies()[1].surface());
/// // From memory: a disc of the scene that is worn by a nanometre everywhere.
/// let heights = first.bodies()[1].initial().to_vec();
/// let worn = BodyStart::new(scene.grid()?, heights).with_wear(vec![1e-9; 32 * 32]);
/// MixedLubricationSim::builder(scene).disc_start(worn).build()?;
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct BodyStart {
    /// The grid of the heights.
    grid: Grid,
    /// Heights before any change \[m\].
    pub(in crate::sim) initial: Vec<f64>,
    /// Worn depth \[m\].
    pub(in crate::sim) wear: Vec<f64>,
    /// Plastic depth \[m\].
    pub(in crate::sim) plastic: Vec<f64>,
    /// Thickness of the tribofilm \[m\].
    pub(in crate::sim) tribofilm: Vec<f64>,
    /// State of the growth law, node-major, if known.
    pub(in crate::sim) states: Option<Vec<f64>>,
}

impl MixedLubricationSim {
    /// Ball and disc in their present state, as starts of another run.
    pub fn starts(&self) -> [BodyStart; 2] {
        let [ball, disc] = self.bodies();
        [ball, disc].map(|body| {
            BodyStart {
                states: body.film.as_ref().map(|film| film.states().to_vec()),
                ..BodyStart::new(self.grid(), body.initial().to_vec())
            }
            .with_wear(body.wear().to_vec())
            .with_plastic_depth(body.plastic_depth().to_vec())
            .with_film(body.tribofilm().to_vec())
        })
    }
}

impl BodyStart {
    /// A new body with the heights `initial` \[m\], one per node of `grid`, positive out of the body.
    pub fn new(grid: Grid, initial: Vec<f64>) -> Self {
        let zeros = || vec![0.0; initial.len()];
        Self { grid, wear: zeros(), plastic: zeros(), tribofilm: zeros(), states: None, initial }
    }

    /// The same body worn by `depth` \[m\].
    #[must_use]
    pub fn with_wear(mut self, depth: Vec<f64>) -> Self {
        self.wear = depth;
        self
    }

    /// The same body flattened by `depth` \[m\].
    #[must_use]
    pub fn with_plastic_depth(mut self, depth: Vec<f64>) -> Self {
        self.plastic = depth;
        self
    }

    /// The same body with a tribofilm of `thickness` \[m\], whose law has no other state.
    #[must_use]
    pub fn with_tribofilm(mut self, thickness: Vec<f64>) -> Self {
        self.states = None;
        self.with_film(thickness)
    }

    /// The same body with the `states` of its growth law, all of a node together, under the same film.
    #[must_use]
    pub fn with_film_states(mut self, states: Vec<f64>) -> Self {
        self.states = Some(states);
        self
    }

    /// The grid that the body lives on.
    pub fn grid(&self) -> Grid {
        self.grid
    }

    /// Heights of the new body \[m\].
    pub fn initial(&self) -> &[f64] {
        &self.initial
    }

    /// Worn depth \[m\].
    pub fn wear(&self) -> &[f64] {
        &self.wear
    }

    /// Plastic depth \[m\].
    pub fn plastic_depth(&self) -> &[f64] {
        &self.plastic
    }

    /// Thickness of the tribofilm \[m\].
    pub fn tribofilm(&self) -> &[f64] {
        &self.tribofilm
    }

    /// States of the growth law, all of a node together, where they are known.
    pub fn film_states(&self) -> Option<&[f64]> {
        self.states.as_deref()
    }

    fn with_film(mut self, thickness: Vec<f64>) -> Self {
        self.tribofilm = thickness;
        self
    }

    /// The body `name` on `grid` with a film that grows by `law`.
    pub(in crate::sim) fn into_body(
        self,
        name: &str,
        grid: &Grid,
        law: Option<&dyn FilmGrowthLaw>,
    ) -> Result<Body, InputError> {
        self.check_grid(name, grid)?;
        for (part, values) in [
            ("heights", &self.initial),
            ("wear", &self.wear),
            ("plastic depth", &self.plastic),
            ("tribofilm", &self.tribofilm),
        ] {
            let field = format!("{name} start {part}");
            grid.require_field(&field, values)?;
            let negative = values.iter().enumerate().find(|(_, value)| **value < 0.0);
            if let (Some((k, value)), true) = (negative, part != "heights") {
                let place = format!("{}[{}]", grid.row(&field, k), k % grid.nx());
                InputError::require_non_negative(&place, *value)?;
            }
        }
        let film = self.film(name, law)?;
        let mut body = Body::new(self.initial, None);
        body.wear = WearDepth::from_values(self.wear)?;
        body.plastic = PlasticDepth::from_values(self.plastic)?;
        body.film = film;
        body.rebuild().map_err(|error| InputError::Conflict {
            field: format!("{name} start"),
            reason: error.to_string(),
        })?;
        Ok(body)
    }

    /// Rejects a start on another grid.
    fn check_grid(&self, name: &str, grid: &Grid) -> Result<(), InputError> {
        let words = |grid: &Grid| {
            let [dx, dy] = [grid.dx(), grid.dy()].map(format_number);
            format!("{} x {} cells of {dx} x {dy} m", grid.nx(), grid.ny())
        };
        if self.grid == *grid {
            return Ok(());
        }
        Err(InputError::Conflict {
            field: format!("{name} start"),
            reason: format!(
                "its grid has {}, that of the scene {}, or another position",
                words(&self.grid),
                words(grid)
            ),
        })
    }

    /// The tribofilm of the start, with the state of `law`; rejects a film without a law.
    fn film(&self, name: &str, law: Option<&dyn FilmGrowthLaw>) -> Result<Option<Tribofilm>, InputError> {
        let field = format!("{name} start tribofilm");
        let thickest = self.tribofilm.iter().copied().fold(0.0, f64::max);
        let Some(law) = law else {
            if thickest == 0.0 {
                return Ok(None);
            }
            return Err(InputError::Conflict {
                field,
                reason: format!(
                    "it is up to {} m thick, but the scene has no tribofilm",
                    format_number(thickest)
                ),
            });
        };
        let fits = thickest <= law.maximum_thickness() * (1.0 + 1e-9);
        InputError::require(fits, &field, thickest, "at most the largest thickness of the growth law")?;
        // The state is used only if it has the thickness of the start: other laws define theirs differently.
        let known = self.states.as_ref().filter(|states| {
            let n_states = law.n_states().max(1);
            let thickness = states.chunks_exact(n_states).map(|states| law.thickness(states));
            states.len() == n_states * self.tribofilm.len()
                && thickness.zip(&self.tribofilm).all(|(a, b)| a.to_bits() == b.to_bits())
        });
        Ok(Some(match known {
            Some(states) => Tribofilm::from_states(law, states.clone(), [0.0; 2])?,
            None => Tribofilm::from_thickness(law, &self.tribofilm)?,
        }))
    }
}
