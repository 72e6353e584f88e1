//! The physical description of a contact and its history: the contents of a scene file.
//!
//! One file per table. A table is a plain struct of SI values beside the reader of its part of the file. The parts
//! of the model are built from it elsewhere (`setup`, `builder`). Readers reject unknown keys; ranges are checked
//! when a scene is used, and errors name the key.
//!
//! [`Scene::azam_2019`] is a complete example.

mod bearing;
mod cycle;
mod cycle_file;
mod cycle_source;
pub(in crate::sim) mod cycle_table;
#[cfg(feature = "serde")]
mod document;
mod elastic;
#[cfg(feature = "serde")]
mod explain;
#[cfg(feature = "serde")]
mod explain_output;
#[cfg(feature = "serde")]
mod files;
#[cfg(feature = "serde")]
mod given_film;
#[cfg(feature = "serde")]
mod given_film_table;
mod grid;
pub(in crate::sim) mod hertz;
#[cfg(feature = "serde")]
mod journal_speed;
#[cfg(feature = "serde")]
mod keys;
mod load;
mod lubricant;
#[cfg(feature = "serde")]
mod lubricant_table;
#[cfg(feature = "serde")]
mod markdown;
mod materials;
#[cfg(feature = "serde")]
mod missing;
mod motion;
mod named_material;
mod oil;
#[cfg(feature = "serde")]
mod oil_keys;
pub(in crate::sim) mod operating_schedule;
#[cfg(feature = "serde")]
mod plain_words;
mod processes;
mod roughness;
#[cfg(feature = "serde")]
mod roughness_table;
mod schedule;
mod solver;
mod stress;
#[cfg(feature = "serde")]
mod tables;
pub(in crate::sim) mod time_series;
mod track;
mod tribofilm;
mod wear;

pub use bearing::RollingBearingSpec;
pub use cycle::CycleSpec;
#[cfg(feature = "serde")]
pub(in crate::sim) use document::Document;
pub use elastic::{CoatedBody, Elastic, FilmElasticSpec, LayerSpec};
#[cfg(feature = "serde")]
pub use explain::explain;
#[cfg(feature = "serde")]
pub use given_film::{
    BearingSpec, GrooveSpec, HeatBalance, HoleSpec, JournalPosition, PadFilm, PadRelief, RoughnessSpec,
};
#[cfg(feature = "serde")]
pub(in crate::sim) use given_film_table::{BearingFile, CELLS_IN_DIMPLE};
pub use grid::GridSpec;
pub use load::Load;
pub use lubricant::{BarusConstants, InletSpec, LubricantSpec, ViscositySpec};
pub(in crate::sim) use materials::BODIES;
pub use materials::{Material, Materials};
#[cfg(feature = "serde")]
pub(in crate::sim) use missing::bearing_keys;
pub use motion::{Motion, RoughnessState};
pub use named_material::NamedMaterial;
pub use oil::{KinematicPoint, OilSpec};
pub use processes::{Flash, FlowThinning, FrictionSpec, PlasticSpec, ThermalSpec};
pub(in crate::sim) use roughness::ShortestWaves;
pub use roughness::{FileRoughness, Roughness, RoughnessPair};
pub use schedule::{Schedule, Schedules};
pub use solver::{SolverKind, SolverModel, SolverSpec};
pub use stress::StressSpec;
pub use track::{Exposure, TrackMotion, TrackSpec};
pub use tribofilm::{
    DrivingStress, GhanbarzadehSpec, ProportionalRemovalSpec, StressActivatedSpec, ThermalArrheniusSpec,
    TribofilmSpec,
};
pub use wear::{ArchardSpec, FrictionalEnergySpec, WearLawSpec, WearSpec};

use crate::surface::Form;

/// Complete definition of a contact, in SI units. Leave out a table to leave out its physics.
///
/// With the feature `serde` a scene is read from and written to TOML; errors name unknown keys. Keys are the field
/// names; the pages `docs/scene*.md` list them with units and defaults.
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scene;
/// use stribeck::sim::scene::{Load, Motion, PlasticSpec};
/// let mut scene = Scene::azam_2019(64);
/// scene.load = Load::force(20.0);
/// scene.motion = Motion::new(0.5, 0.1);
/// scene.plastic = Some(PlasticSpec::new(4e9));
/// assert!((scene.hertz()?.force - 20.0).abs() < 1e-9);
/// assert!(scene.is_lubricated());
/// # Ok::<(), stribeck::InputError>(())
/// ```
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
    /// Materials of the bodies, if they differ or their moduli are given separately.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Materials::is_empty"))]
    pub materials: Materials,
    /// Normal load.
    pub load: Load,
    /// Speeds; required with a lubricant, sliding or a history.
    #[cfg_attr(feature = "serde", serde(default))]
    pub motion: Motion,
    /// The lubricant; absent for a dry contact.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub lubricant: Option<LubricantSpec>,
    /// The grid.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "tables::grid"))]
    pub grid: GridSpec,
    /// Roughness of the two bodies.
    #[cfg_attr(feature = "serde", serde(default))]
    pub roughness: RoughnessPair,
    /// Plastic limit; absent for elastic bodies.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub plastic: Option<PlasticSpec>,
    /// Friction coefficients.
    #[cfg_attr(feature = "serde", serde(default))]
    pub friction: FrictionSpec,
    /// Growth of a tribofilm; absent for no film.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub tribofilm: Option<TribofilmSpec>,
    /// Wear; absent for no wear.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub wear: Option<WearSpec>,
    /// Motion of the roughness and exposure of the track in a history.
    #[cfg_attr(feature = "serde", serde(default))]
    pub track: TrackSpec,
    /// Temperatures.
    #[cfg_attr(feature = "serde", serde(default))]
    pub thermal: ThermalSpec,
    /// Conditions over time; a single contact uses those at time zero.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Schedules::is_empty"))]
    pub schedule: Schedules,
    /// Conditions over a cycle, for [`SimBuilder::solve_cycle`](crate::sim::SimBuilder::solve_cycle) alone.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub cycle: Option<CycleSpec>,
    /// Stresses below the surface of a single contact; absent if not computed.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub stress: Option<StressSpec>,
    /// The rolling bearing, for the viscosity ratio of [`Scene::oil_numbers`]; absent if unknown.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub bearing: Option<RollingBearingSpec>,
    /// Solver of the contact problem.
    #[cfg_attr(feature = "serde", serde(default))]
    pub solver: SolverSpec,
}

/// A length or a modulus without a finite value; it is left out of a file.
#[cfg(feature = "serde")]
fn infinite() -> f64 {
    f64::INFINITY
}

#[cfg(feature = "serde")]
fn is_infinite(value: &f64) -> bool {
    *value == f64::INFINITY
}

impl Scene {
    /// The scene of Azam et al. (2019): steel ball on rough disc, base oil at 80 C, two hours of sliding, without a
    /// tribofilm. The paper does not state autocorrelation, correlation length and seeds; they are chosen here.
    ///
    /// ```
    /// let scene = stribeck::sim::Scene::azam_2019(128);
    /// let hertz = scene.hertz()?;
    /// assert!((hertz.half_width_x - 149.83e-6).abs() < 0.01e-6);
    /// assert!((hertz.force - 54.07).abs() < 0.01);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn azam_2019(n: usize) -> Self {
        let random = |rq, seed| Roughness::gaussian(rq, 10e-6, seed);
        Self {
            form: Form::Sphere { radius: 9.525e-3 },
            elastic: Elastic::new(229.67e9),
            materials: Materials::default(),
            load: Load::hertz_pressure(1.15e9),
            motion: Motion::new(0.1, 0.05),
            lubricant: Some(LubricantSpec {
                eta0: 0.004,
                roelands_z: 0.68,
                roelands_p0: 1.96e8,
                alpha: None,
                temperature: None,
                roelands_s0: None,
                viscosity: None,
                oil: None,
                formula_alpha: Some(1.494e-8),
                density_a: 0.6e-9,
                density_b: 1.7e-9,
                supplied_film: None,
                inlet: InletSpec::Flooded,
                thermal: None,
            }),
            grid: GridSpec::Cells { nx: n, ny: n, x: [-0.25e-3, 0.25e-3], y: [-0.25e-3, 0.25e-3] },
            roughness: RoughnessPair { ball: random(20e-9, 1), disc: random(130e-9, 2) },
            plastic: Some(PlasticSpec { hardness: 6e9, film_hardness: Some(2e9), hardening_modulus: None }),
            friction: FrictionSpec::default(),
            tribofilm: None,
            wear: Some(WearSpec::azam_2019()),
            track: TrackSpec::default(),
            thermal: ThermalSpec::default(),
            schedule: Schedules::default(),
            cycle: None,
            stress: None,
            bearing: None,
            solver: SolverSpec::default(),
        }
    }

    /// The same scene with the tribofilm of Azam et al. (2019).
    #[must_use]
    pub fn with_tribofilm(mut self) -> Self {
        self.tribofilm = Some(TribofilmSpec::default());
        self
    }

    /// Whether both bodies have no roughness.
    pub fn is_smooth(&self) -> bool {
        self.roughness.ball.is_smooth() && self.roughness.disc.is_smooth()
    }
}
