//! The physical description of a contact and its history: what a scene file holds.

mod elastic;
#[cfg(feature = "serde")]
mod files;
#[cfg(feature = "serde")]
mod keys;
mod lubricant;
mod materials;
#[cfg(feature = "serde")]
mod missing;
mod processes;
mod roughness;
#[cfg(feature = "serde")]
mod roughness_table;
mod schedule;
mod stress;
#[cfg(feature = "serde")]
mod tables;
mod track;
mod tribofilm;
mod wear;

pub use elastic::{Elastic, LayerSpec};
pub use lubricant::{BarusConstants, LubricantSpec, ViscositySpec};
pub(super) use materials::BODIES;
pub use materials::{Material, Materials, NamedMaterial};
pub use processes::{Flash, FlowThinning, FrictionSpec, PlasticSpec, ThermalSpec};
pub(super) use roughness::ShortestWaves;
pub use roughness::{FileRoughness, RandomRoughness, Roughness, RoughnessPair};
pub use schedule::{Schedule, Schedules};
pub use stress::StressSpec;
pub use track::{Exposure, TrackMotion, TrackSpec};
pub use tribofilm::{
    DrivingStress, GhanbarzadehSpec, ProportionalRemovalSpec, StressActivatedSpec, ThermalArrheniusSpec,
    TribofilmSpec,
};
pub use wear::{ArchardSpec, FrictionalEnergySpec, WearSpec};

use crate::analytic::{HertzLine, HertzPoint};
use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::{Cavitation, ContactDefinition, FaceMobility, LubricatedContact, Scheme, StoppingRule};
use crate::sim::hertz::{HertzContact, LINE_LENGTH};
use crate::surface::Form;
use crate::with_fields::with_fields;

/// Everything that defines a contact. All SI; every table that is absent is physics that is not modelled.
///
/// With the feature `serde` a scene is read from and written to TOML; unknown keys are errors that name the
/// key. The keys are the field names; the pages `docs/scene*.md` list them with units and defaults.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Scene {
    /// Shape of the bodies.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "tables::form"))]
    pub form: Form,
    /// Elastic constants.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Elastic::is_absent"))]
    pub elastic: Elastic,
    /// Materials of the bodies, where they differ or their moduli are given one by one.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Materials::is_empty"))]
    pub materials: Materials,
    /// Normal load.
    pub load: Load,
    /// Speeds; needed where there is a lubricant, sliding or a history.
    #[cfg_attr(feature = "serde", serde(default))]
    pub motion: Motion,
    /// The lubricant; absent: dry contact.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub lubricant: Option<LubricantSpec>,
    /// The grid.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "tables::grid"))]
    pub grid: GridSpec,
    /// Roughness of the two bodies.
    #[cfg_attr(feature = "serde", serde(default))]
    pub roughness: RoughnessPair,
    /// Plastic limit; absent: elastic.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub plastic: Option<PlasticSpec>,
    /// Friction coefficients for heat and the friction output.
    #[cfg_attr(feature = "serde", serde(default))]
    pub friction: FrictionSpec,
    /// Growth of a tribofilm; absent: none.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub tribofilm: Option<TribofilmSpec>,
    /// Wear; absent: none.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub wear: Option<WearSpec>,
    /// Motion of the roughness and exposure of the track in a history.
    #[cfg_attr(feature = "serde", serde(default))]
    pub track: TrackSpec,
    /// Temperatures.
    #[cfg_attr(feature = "serde", serde(default))]
    pub thermal: ThermalSpec,
    /// Conditions that change in time; a single contact is that of the start.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Schedules::is_empty"))]
    pub schedule: Schedules,
    /// Stresses below the surface of a single contact; absent: none.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub stress: Option<StressSpec>,
    /// How the contact problem is solved.
    #[cfg_attr(feature = "serde", serde(default))]
    pub solver: SolverSpec,
}

/// Normal load, by exactly one of the two.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct Load {
    /// Maximum Hertz pressure of the smooth contact \[Pa\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub hertz_pressure: Option<f64>,
    /// Force \[N\]; of a line contact force per length \[N/m\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub force: Option<f64>,
}

impl Load {
    /// The load under which the smooth contact has this maximum Hertz pressure \[Pa\].
    pub const fn hertz_pressure(pressure: f64) -> Self {
        Self { hertz_pressure: Some(pressure), force: None }
    }

    /// A force \[N\]; of a line contact force per length \[N/m\].
    pub const fn force(force: f64) -> Self {
        Self { hertz_pressure: None, force: Some(force) }
    }
}

/// Speeds of the surfaces along x.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct Motion {
    /// Mean of the two surface speeds \[m/s\].
    pub entrainment_speed: f64,
    /// Sliding speed over entrainment speed; the ball is the faster one where it is positive.
    pub slide_roll_ratio: f64,
}

impl Motion {
    /// An entrainment speed \[m/s\] and a slide-to-roll ratio.
    pub const fn new(entrainment_speed: f64, slide_roll_ratio: f64) -> Self {
        Self { entrainment_speed, slide_roll_ratio }
    }
}

impl Motion {
    /// Sliding speed, never negative \[m/s\].
    pub fn sliding_speed(&self) -> f64 {
        (self.entrainment_speed * self.slide_roll_ratio).abs()
    }

    /// Speeds of ball and disc \[m/s\].
    pub fn surface_speeds(&self) -> [f64; 2] {
        let half = 0.5 * self.slide_roll_ratio;
        [self.entrainment_speed * (1.0 + half), self.entrainment_speed * (1.0 - half)]
    }
}

/// The grid, or what is asked of it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(untagged))]
#[non_exhaustive]
pub enum GridSpec {
    /// Cells that fill a box. A line contact is solved on one row of them: `ny` and `y` are checked and not
    /// used.
    Cells {
        /// Cells along x.
        nx: usize,
        /// Cells along y.
        ny: usize,
        /// Outer edges along x \[m\]; the flow goes along +x.
        x: [f64; 2],
        /// Outer edges along y \[m\].
        y: [f64; 2],
    },
    /// The cells of a line contact.
    Row {
        /// Cells along x.
        nx: usize,
        /// Outer edges along x \[m\]; the flow goes along +x.
        x: [f64; 2],
    },
    /// Box and cells are picked for an error, which is estimated from coarser grids: of a smooth contact the
    /// relative one of the central film (dry: of the maximum pressure), of a rough one that of
    /// [`SolverSpec::accuracy`]. Single contacts only; normal heights with shortest waves (Gaussian
    /// autocorrelation, self-affine down to one), which tell the cells to begin with.
    Accuracy {
        /// Largest error.
        accuracy: f64,
    },
}

/// How the contact problem is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct SolverSpec {
    /// Which solver.
    pub kind: SolverKind,
    /// Bound for every residual.
    pub tolerance: f64,
    /// Largest number of outer iterations.
    pub max_iterations: u64,
    /// What entrainment carries through faces; none for that of the contact definition, see
    /// [`Scene::scheme`].
    pub scheme: Option<Scheme>,
    /// Pressure flow through the faces; none for that of the contact definition, see
    /// [`Scene::face_mobility`].
    pub face_mobility: Option<FaceMobility>,
    /// What holds where the fluid cavitates.
    pub cavitation: Option<Cavitation>,
    /// Film thickness at which solids touch \[m\].
    pub film_cutoff: f64,
    /// What solid contact is.
    pub contact: ContactDefinition,
    /// Whether errors are estimated by a second solve on half the cells along each side; single contacts on a
    /// given grid only.
    pub estimate: bool,
    /// Cells of a given grid are halved until the largest of four estimated errors, those of load and area
    /// ratio and the relative ones of mean film and friction, is at most this; single contacts only.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub accuracy: Option<f64>,
    /// Whether a dry contact may reach the edge of the box.
    pub edge_contact: bool,
    /// Under-relaxation of the semi-system sweeps of the paper's contact.
    pub relaxation: f64,
    /// Stiffening of the implicit deformation in these sweeps.
    pub stiffness: f64,
}

with_fields!(SolverSpec {
    with_kind kind: SolverKind,
    with_tolerance tolerance: f64,
    with_max_iterations max_iterations: u64,
    with_scheme scheme: Option<Scheme>,
    with_face_mobility face_mobility: Option<FaceMobility>,
    with_cavitation cavitation: Option<Cavitation>,
    with_film_cutoff film_cutoff: f64,
    with_contact contact: ContactDefinition,
    with_estimate estimate: bool,
    with_accuracy accuracy: Option<f64>,
    with_edge_contact edge_contact: bool,
    with_relaxation relaxation: f64,
    with_stiffness stiffness: f64,
});

impl Default for SolverSpec {
    fn default() -> Self {
        let StoppingRule { tolerance, max_iterations } = StoppingRule::default();
        Self {
            kind: SolverKind::Auto,
            tolerance,
            max_iterations,
            scheme: None,
            face_mobility: None,
            cavitation: None,
            film_cutoff: LubricatedContact::FILM_CUTOFF,
            contact: ContactDefinition::default(),
            estimate: false,
            accuracy: None,
            edge_contact: false,
            relaxation: 0.2,
            stiffness: 6.0,
        }
    }
}

/// The solvers a scene can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum SolverKind {
    /// By what the scene holds, with fallback.
    Auto,
    /// Full multigrid.
    Multigrid,
    /// Semi-system line sweeps.
    SemiSystem,
    /// Semismooth Newton with Krylov steps.
    NewtonKrylov,
    /// Dry contact; a lubricant in the scene is left out.
    Dry,
}

impl Scene {
    /// The scene of Azam et al. (2019): steel ball on rough disc, base oil at 80 C, two hours of rubbing,
    /// without a tribofilm. Autocorrelation, its length and the seeds are choices the paper leaves open.
    ///
    /// ```
    /// let scene = stribeck::sim::Scene::azam_2019(128);
    /// let hertz = scene.hertz()?;
    /// assert!((hertz.a_x - 149.83e-6).abs() < 0.01e-6);
    /// assert!((hertz.load - 54.07).abs() < 0.01);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn azam_2019(n: usize) -> Self {
        let random =
            |rq, seed| Roughness::Gaussian(RandomRoughness { rq, length_x: 10e-6, length_y: 10e-6, seed });
        Self {
            form: Form::Sphere { radius: 9.525e-3 },
            elastic: Elastic::new(229.67e9),
            materials: Materials::default(),
            load: Load::hertz_pressure(1.15e9),
            motion: Motion { entrainment_speed: 0.1, slide_roll_ratio: 0.05 },
            lubricant: Some(LubricantSpec {
                eta0: 0.004,
                roelands_z: 0.68,
                roelands_p0: 1.96e8,
                alpha: None,
                temperature: None,
                roelands_s0: None,
                viscosity: None,
                formula_alpha: Some(1.494e-8),
                density_a: 0.6e-9,
                density_b: 1.7e-9,
                supplied_film: None,
                thermal: None,
            }),
            grid: GridSpec::Cells { nx: n, ny: n, x: [-0.25e-3, 0.25e-3], y: [-0.25e-3, 0.25e-3] },
            roughness: RoughnessPair { ball: random(20e-9, 1), disc: random(130e-9, 2) },
            plastic: Some(PlasticSpec { hardness: 6e9, film_hardness: Some(2e9), hardening_modulus: None }),
            friction: FrictionSpec::default(),
            tribofilm: None,
            wear: Some(WearSpec::default()),
            track: TrackSpec::default(),
            thermal: ThermalSpec::default(),
            schedule: Schedules::default(),
            stress: None,
            solver: SolverSpec::default(),
        }
    }

    /// The same scene with the tribofilm of Azam et al. (2019).
    #[must_use]
    pub fn with_tribofilm(mut self) -> Self {
        self.tribofilm = Some(TribofilmSpec::default());
        self
    }

    /// The grid; of a line contact one row of cells one metre wide.
    ///
    /// # Errors
    /// Counts or edges out of range; a row for a point contact; an accuracy in place of a grid.
    pub fn grid(&self) -> Result<Grid, InputError> {
        let row = |nx, x| Grid::from_edges(nx, 1, x, [-0.5 * LINE_LENGTH, 0.5 * LINE_LENGTH]);
        let conflict = |field: &str, reason: &str| {
            Err(InputError::Conflict { field: field.to_owned(), reason: reason.to_owned() })
        };
        match self.grid {
            GridSpec::Cells { nx, ny, x, y } => {
                let grid = Grid::from_edges(nx, ny, x, y)?;
                if self.form.is_line() { row(nx, x) } else { Ok(grid) }
            }
            GridSpec::Row { nx, x } if self.form.is_line() => row(nx, x),
            GridSpec::Row { .. } => conflict("grid", "ny and y are missing; only a cylinder needs none"),
            GridSpec::Accuracy { .. } => {
                conflict("grid.accuracy", "only a single contact picks its grid, this needs nx, ny, x and y")
            }
        }
    }

    /// The Hertz contact of the smooth bodies, at the start where the load is scheduled.
    ///
    /// # Errors
    /// Form, modulus, load or schedule out of range, or both kinds of load, or none.
    pub fn hertz(&self) -> Result<HertzContact, InputError> {
        match self.schedule.load {
            None => self.constant_hertz(),
            Some(_) => self.hertz_under(self.conditions(0.0)?.load),
        }
    }

    /// The Hertz contact under the `load` \[N\] of a schedule.
    pub(super) fn hertz_under(&self, load: f64) -> Result<HertzContact, InputError> {
        self.hertz_by(Load::force(load))
    }

    /// The Hertz contact under the load of the scene, whatever the schedule.
    pub(super) fn constant_hertz(&self) -> Result<HertzContact, InputError> {
        self.hertz_by(self.load)
    }

    fn hertz_by(&self, load: Load) -> Result<HertzContact, InputError> {
        self.form.validate()?;
        let (radius_x, radius_y) = self.form.radii();
        let line = self.form.is_line();
        let ratio = radius_x / radius_y;
        let largest = HertzPoint::MAX_RADIUS_RATIO;
        let fits = line || (1.0 / largest..=largest).contains(&ratio);
        InputError::require(fits, "form.radius_x / form.radius_y", ratio, "between 1e-8 and 1e8")?;
        let modulus = self.equivalent_modulus()?;
        let (field, value, contact) = match (load.hertz_pressure, load.force) {
            (Some(pressure), None) => {
                InputError::require_positive("load.hertz_pressure", pressure)?;
                let contact = if line {
                    HertzLine::from_max_pressure(radius_x, modulus, pressure).map(HertzContact::from)
                } else {
                    HertzPoint::from_max_pressure(radius_x, radius_y, modulus, pressure)
                        .map(HertzContact::from)
                };
                ("load.hertz_pressure", pressure, contact)
            }
            (None, Some(force)) => {
                InputError::require_positive("load.force", force)?;
                let contact = if line {
                    HertzLine::from_load(radius_x, modulus, force).map(HertzContact::from)
                } else {
                    HertzPoint::from_load(radius_x, radius_y, modulus, force).map(HertzContact::from)
                };
                ("load.force", force, contact)
            }
            (Some(pressure), Some(force)) => {
                return Err(InputError::Conflict {
                    field: "load".to_owned(),
                    reason: format!(
                        "give hertz_pressure or force, not both (hertz_pressure = {pressure:?}, force = {force:?})"
                    ),
                });
            }
            (None, None) => {
                return Err(InputError::Conflict {
                    field: "load".to_owned(),
                    reason: "hertz_pressure or force is missing".to_owned(),
                });
            }
        };
        let turned = contact.map(|contact| HertzContact { angle: self.form.angle(), ..contact });
        // All inputs are in range, so what is left is a result that is not.
        turned.map_err(|error| InputError::Conflict {
            field: format!("{field} = {value:?}"),
            reason: format!("the Hertz contact under it is beyond the range of numbers ({error})"),
        })
    }

    /// Whether the contact is solved with a lubricant.
    pub fn is_lubricated(&self) -> bool {
        self.lubricant.is_some() && self.solver.kind != SolverKind::Dry
    }

    /// What entrainment carries through faces: the scheme named in `solver`, else the default, of first order
    /// in the paper's contact as published.
    pub fn scheme(&self) -> Scheme {
        self.solver.scheme.unwrap_or(match self.solver.contact {
            ContactDefinition::Hard => Scheme::default(),
            ContactDefinition::UnifiedReynolds => Scheme::FirstOrder,
        })
    }

    /// What holds where the fluid cavitates: the condition named in `solver`, else the default, Reynolds'
    /// condition in the paper's contact as published.
    pub fn cavitation(&self) -> Cavitation {
        self.solver.cavitation.unwrap_or(match self.solver.contact {
            ContactDefinition::Hard => Cavitation::default(),
            ContactDefinition::UnifiedReynolds => Cavitation::Reynolds,
        })
    }

    /// Whether both bodies have no roughness.
    pub(crate) fn is_smooth(&self) -> bool {
        self.roughness.ball.is_smooth() && self.roughness.disc.is_smooth()
    }

    /// The pressure flow through faces: the one named in `solver`, else that which knows edges of contacts
    /// within a cell between rough surfaces, that of a film which is linear between nodes between smooth
    /// ones, whose inlets are resolved, and arithmetic means in the paper's contact as published.
    pub fn face_mobility(&self) -> FaceMobility {
        self.face_mobility_between(self.is_smooth())
    }

    /// The same between bodies that are `smooth` or not, whatever the scene says of their roughness.
    pub(super) fn face_mobility_between(&self, smooth: bool) -> FaceMobility {
        self.solver.face_mobility.unwrap_or(match self.solver.contact {
            ContactDefinition::Hard if smooth => FaceMobility::Wedge,
            ContactDefinition::Hard => FaceMobility::Inlet,
            ContactDefinition::UnifiedReynolds => FaceMobility::Arithmetic,
        })
    }
}
