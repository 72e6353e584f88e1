//! The physical description of a contact and its history: what a scene file holds.

use std::path::PathBuf;

use crate::analytic::HertzPoint;
use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::{FaceMobility, Scheme};
use crate::surface::Form;

/// Everything that defines a contact. All SI; every table that is absent is physics that is not modelled.
///
/// With the feature `serde` a scene is read from and written to TOML; unknown keys are errors that name the key.
/// The keys are the field names; `docs/scene.md` lists them with units and defaults.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Scene {
    /// Shape of the bodies.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "tables::form"))]
    pub form: Form,
    /// Elastic constants.
    pub elastic: Elastic,
    /// Normal load.
    pub load: Load,
    /// Speeds; needed where there is a lubricant, sliding or a history.
    #[cfg_attr(feature = "serde", serde(default))]
    pub motion: Motion,
    /// The lubricant; absent: dry contact.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub lubricant: Option<LubricantSpec>,
    /// The grid.
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
    /// Temperatures.
    #[cfg_attr(feature = "serde", serde(default))]
    pub thermal: ThermalSpec,
    /// How the contact problem is solved.
    #[cfg_attr(feature = "serde", serde(default))]
    pub solver: SolverSpec,
}

/// Elastic constants of the pair.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Elastic {
    /// `E'` \[Pa\], `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`.
    pub equivalent_modulus: f64,
}

/// Normal load, by exactly one of the two.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Load {
    /// Maximum Hertz pressure of the smooth contact \[Pa\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub hertz_pressure: Option<f64>,
    /// Force \[N\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub force: Option<f64>,
}

/// Speeds of the surfaces along x.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Motion {
    /// Mean of the two surface speeds \[m/s\].
    pub entrainment_speed: f64,
    /// Sliding speed over entrainment speed; the ball is the faster one where it is positive.
    pub slide_roll_ratio: f64,
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

/// Roelands viscosity and Dowson-Higginson density.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct LubricantSpec {
    /// Viscosity at ambient pressure \[Pa s\].
    pub eta0: f64,
    /// Roelands index.
    pub roelands_z: f64,
    /// Roelands reference pressure \[Pa\].
    #[cfg_attr(feature = "serde", serde(default = "defaults::roelands_p0"))]
    pub roelands_p0: f64,
    /// Pressure-viscosity coefficient \[1/Pa\]: the slope of the law is set to it where it is given, else it follows
    /// from `eta0`, `roelands_z` and `roelands_p0`.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub alpha: Option<f64>,
    /// Dowson-Higginson `a` \[1/Pa\].
    #[cfg_attr(feature = "serde", serde(default = "defaults::density_a"))]
    pub density_a: f64,
    /// Dowson-Higginson `b` \[1/Pa\].
    #[cfg_attr(feature = "serde", serde(default = "defaults::density_b"))]
    pub density_b: f64,
}

/// The grid by its box.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct GridSpec {
    /// Cells along x.
    pub nx: usize,
    /// Cells along y.
    pub ny: usize,
    /// Outer edges along x \[m\]; the flow goes along +x.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "tables::edges"))]
    pub x: [f64; 2],
    /// Outer edges along y \[m\].
    #[cfg_attr(feature = "serde", serde(deserialize_with = "tables::edges"))]
    pub y: [f64; 2],
}

/// Roughness of ball and disc.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct RoughnessPair {
    /// The ball, body 0.
    pub ball: Roughness,
    /// The disc, body 1.
    pub disc: Roughness,
}

/// Roughness of one body.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(tag = "kind", rename_all = "snake_case", try_from = "tables::RoughnessTable")
)]
pub enum Roughness {
    /// Smooth.
    #[default]
    None,
    /// Random, Gaussian autocorrelation.
    Gaussian(RandomRoughness),
    /// Random, exponential autocorrelation.
    Exponential(RandomRoughness),
    /// A measured surface.
    File(FileRoughness),
}

impl Roughness {
    /// Whether the body has no roughness.
    pub fn is_smooth(&self) -> bool {
        match self {
            Self::None => true,
            Self::Gaussian(random) | Self::Exponential(random) => random.rq == 0.0,
            Self::File(_) => false,
        }
    }
}

/// Parameters of random roughness.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct RandomRoughness {
    /// Root mean square height \[m\].
    pub rq: f64,
    /// Length along x where the autocorrelation is 10 % \[m\].
    pub length_x: f64,
    /// Length along y where the autocorrelation is 10 % \[m\].
    pub length_y: f64,
    /// Seed.
    #[cfg_attr(feature = "serde", serde(default))]
    pub seed: u64,
}

/// A file of heights.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct FileRoughness {
    /// Path, relative to the scene file, in any format of [`crate::surface`]. A file without spacings (`.npy` of shape
    /// (ny, nx)) is taken node by node, heights in metres, positive out of the body; one with spacings is levelled,
    /// mirror-tiled and resampled to the grid.
    pub path: PathBuf,
    /// Root mean square height to rescale to \[m\].
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub rq: Option<f64>,
}

/// Pressure limit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct PlasticSpec {
    /// Hardness of the substrate \[Pa\].
    pub hardness: f64,
    /// Hardness of a tribofilm of full thickness \[Pa\]; the limit falls linearly with the film.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub film_hardness: Option<f64>,
}

/// Friction of solid contact and of the fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct FrictionSpec {
    /// Boundary friction coefficient of solid contact.
    pub boundary_coefficient: f64,
    /// Largest shear stress that the fluid carries \[Pa\].
    pub limiting_shear_stress: f64,
}

impl Default for FrictionSpec {
    fn default() -> Self {
        Self { boundary_coefficient: 0.115, limiting_shear_stress: 1e8 }
    }
}

/// Two-state growth and removal of a tribofilm (see [`crate::tribochem::Ghanbarzadeh`]).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct TribofilmSpec {
    /// Thickness that growth alone approaches \[m\].
    pub maximum_thickness: f64,
    /// Mechanical activation factor.
    pub x_tribo: f64,
    /// Thickness that removal takes in the end \[m\].
    pub removal_limit: f64,
    /// Rate of removal \[1/s\].
    pub removal_rate: f64,
}

impl Default for TribofilmSpec {
    /// The constants of Azam et al. (2019).
    fn default() -> Self {
        Self { maximum_thickness: 200e-9, x_tribo: 1.66e-16, removal_limit: 54.32e-9, removal_rate: 4.022e-4 }
    }
}

/// Archard wear with a film-dependent coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct WearSpec {
    /// Dimensionless coefficient of the bare surface.
    pub coefficient: f64,
    /// Dimensionless coefficient under a film of full thickness.
    pub film_coefficient: f64,
    /// Hardness that divides the coefficient \[Pa\].
    pub hardness: f64,
    /// Whether only solid pressure wears, or all pressure.
    pub solid_pressure_only: bool,
}

impl Default for WearSpec {
    /// The constants of Azam et al. (2019), all pressure.
    fn default() -> Self {
        Self { coefficient: 5.45e-8, film_coefficient: 5.45e-9, hardness: 6e9, solid_pressure_only: false }
    }
}

/// Temperatures and thermal constants of both bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct ThermalSpec {
    /// Bulk temperature \[K\].
    pub bulk_temperature: f64,
    /// Flash temperature: computed, left out, or by its estimate.
    pub flash: Flash,
    /// Thermal conductivity \[W/(m K)\].
    pub conductivity: f64,
    /// Thermal diffusivity \[m^2/s\].
    pub diffusivity: f64,
}

impl Default for ThermalSpec {
    fn default() -> Self {
        Self { bulk_temperature: 353.15, flash: Flash::Auto, conductivity: 46.0, diffusivity: 1.27e-5 }
    }
}

/// Whether the flash temperature is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Flash {
    /// Computed where its estimate is 1 K or more.
    #[default]
    Auto,
    /// Computed.
    On,
    /// Left out.
    Off,
}

/// How the contact problem is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct SolverSpec {
    /// Which solver.
    pub kind: SolverKind,
    /// Bound for every residual.
    pub tolerance: f64,
    /// Largest number of outer iterations.
    pub max_iterations: u64,
    /// Discretisation of the wedge term.
    pub scheme: Scheme,
    /// Pressure flow through the faces; none for the one that suits the scene, see [`Scene::face_mobility`].
    pub face_mobility: Option<FaceMobility>,
    /// Film thickness at which solids touch \[m\].
    pub film_cutoff: f64,
    /// Under-relaxation of the semi-system sweeps.
    pub relaxation: f64,
    /// Stiffening of the implicit deformation in the semi-system sweeps.
    pub stiffness: f64,
}

impl Default for SolverSpec {
    fn default() -> Self {
        Self {
            kind: SolverKind::Auto,
            tolerance: 1e-6,
            max_iterations: 20_000,
            scheme: Scheme::default(),
            face_mobility: None,
            film_cutoff: 1e-9,
            relaxation: 0.2,
            stiffness: 6.0,
        }
    }
}

/// The solvers a scene can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum SolverKind {
    /// By what the scene holds, with fallback.
    Auto,
    /// Semi-system line sweeps.
    SemiSystem,
    /// Semismooth Newton with Krylov steps.
    NewtonKrylov,
    /// Dry contact; a lubricant in the scene is left out.
    Dry,
}

#[cfg(feature = "serde")]
mod defaults {
    pub(super) fn roelands_p0() -> f64 {
        1.96e8
    }
    pub(super) fn density_a() -> f64 {
        0.6e-9
    }
    pub(super) fn density_b() -> f64 {
        1.7e-9
    }
}

impl Scene {
    /// The scene of Azam et al. (2019): steel ball on rough disc, base oil at 80 C, two hours of rubbing, without a
    /// tribofilm. Autocorrelation, its length and the seeds are choices the paper leaves open.
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
            elastic: Elastic { equivalent_modulus: 229.67e9 },
            load: Load { hertz_pressure: Some(1.15e9), force: None },
            motion: Motion { entrainment_speed: 0.1, slide_roll_ratio: 0.05 },
            lubricant: Some(LubricantSpec {
                eta0: 0.004,
                roelands_z: 0.68,
                roelands_p0: 1.96e8,
                alpha: None,
                density_a: 0.6e-9,
                density_b: 1.7e-9,
            }),
            grid: GridSpec { nx: n, ny: n, x: [-0.25e-3, 0.25e-3], y: [-0.25e-3, 0.25e-3] },
            roughness: RoughnessPair { ball: random(20e-9, 1), disc: random(130e-9, 2) },
            plastic: Some(PlasticSpec { hardness: 6e9, film_hardness: Some(2e9) }),
            friction: FrictionSpec::default(),
            tribofilm: None,
            wear: Some(WearSpec::default()),
            thermal: ThermalSpec::default(),
            solver: SolverSpec::default(),
        }
    }

    /// The same scene with the tribofilm of Azam et al. (2019).
    #[must_use]
    pub fn with_tribofilm(mut self) -> Self {
        self.tribofilm = Some(TribofilmSpec::default());
        self
    }

    /// The grid.
    ///
    /// # Errors
    /// Counts or edges out of range.
    pub fn grid(&self) -> Result<Grid, InputError> {
        Grid::from_edges(self.grid.nx, self.grid.ny, self.grid.x, self.grid.y)
    }

    /// The Hertz contact of the smooth bodies.
    ///
    /// # Errors
    /// Form, modulus or load out of range, or both kinds of load, or none.
    pub fn hertz(&self) -> Result<HertzPoint, InputError> {
        self.form.validate()?;
        let (radius_x, radius_y) = self.form.radii();
        let ratio = radius_x / radius_y;
        let largest = HertzPoint::MAX_RADIUS_RATIO;
        let fits = (1.0 / largest..=largest).contains(&ratio);
        InputError::require(fits, "form.radius_x / form.radius_y", ratio, "between 1e-8 and 1e8")?;
        let modulus = self.elastic.equivalent_modulus;
        InputError::require_positive("elastic.equivalent_modulus", modulus)?;
        let (field, value, contact) = match (self.load.hertz_pressure, self.load.force) {
            (Some(pressure), None) => {
                InputError::require_positive("load.hertz_pressure", pressure)?;
                let contact = HertzPoint::from_max_pressure(radius_x, radius_y, modulus, pressure);
                ("load.hertz_pressure", pressure, contact)
            }
            (None, Some(force)) => {
                InputError::require_positive("load.force", force)?;
                ("load.force", force, HertzPoint::from_load(radius_x, radius_y, modulus, force))
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
        // All inputs are in range, so what is left is a result that is not.
        contact.map_err(|error| InputError::Conflict {
            field: format!("{field} = {value:?}"),
            reason: format!("the Hertz contact under it is beyond the range of numbers ({error})"),
        })
    }

    /// Whether the contact is solved with a lubricant.
    pub fn is_lubricated(&self) -> bool {
        self.lubricant.is_some() && self.solver.kind != SolverKind::Dry
    }

    /// The pressure flow through faces that the contact is solved with: the one named in `solver`, else arithmetic
    /// means for a smooth contact with first-order entrainment, where the two errors have opposite signs, and reduced
    /// pressures otherwise.
    pub fn face_mobility(&self) -> FaceMobility {
        let smooth = self.roughness.ball.is_smooth() && self.roughness.disc.is_smooth();
        self.solver.face_mobility.unwrap_or(match self.solver.scheme {
            Scheme::FirstOrder if smooth => FaceMobility::Arithmetic,
            _ => FaceMobility::ReducedPressure,
        })
    }
}

#[cfg(feature = "serde")]
mod files {
    use std::path::Path;

    use serde::Deserialize;

    use super::{Roughness, Scene};
    use crate::sim::SimError;

    /// Characters of a line that a syntax error quotes.
    const LONGEST_QUOTE: usize = 80;

    impl Scene {
        /// A scene from TOML text.
        ///
        /// # Errors
        /// [`SimError::Scene`] naming the key and the line of what does not fit.
        pub fn from_toml(text: &str) -> Result<Self, SimError> {
            let scene = |reason| SimError::Scene { reason };
            let tree = toml::Deserializer::parse(text).map_err(|error| {
                let line = text.lines().nth(line_of(text, &error)).unwrap_or_default().trim();
                let shown: String = line.chars().filter(|c| !c.is_control()).take(LONGEST_QUOTE).collect();
                scene(format!("{} in `{shown}`", in_one_line(text, error)))
            })?;
            Self::deserialize(tree).map_err(|error| scene(in_one_line(text, error)))
        }

        /// The scene as TOML text.
        ///
        /// # Errors
        /// [`SimError::Scene`] when a path is not UTF-8.
        pub fn to_toml(&self) -> Result<String, SimError> {
            toml::to_string(self).map_err(|e| SimError::Scene { reason: e.to_string() })
        }

        /// Reads a scene file; paths of roughness files in it are taken relative to its folder.
        ///
        /// # Errors
        /// [`SimError::Io`] when the file cannot be read, [`SimError::Scene`] when it does not fit.
        pub fn load(path: impl AsRef<Path>) -> Result<Self, SimError> {
            let path = path.as_ref();
            let text = std::fs::read_to_string(path)
                .map_err(|source| SimError::Io { path: path.to_owned(), source })?;
            let mut scene = Self::from_toml(&text)?;
            let folder = path.parent().unwrap_or(Path::new(""));
            for roughness in [&mut scene.roughness.ball, &mut scene.roughness.disc] {
                if let Roughness::File(file) = roughness {
                    file.path = folder.join(&file.path);
                }
            }
            Ok(scene)
        }
    }

    /// The parser's message with line and key in one line.
    fn in_one_line(text: &str, mut error: toml::de::Error) -> String {
        let line = 1 + line_of(text, &error);
        // With the text at hand the message would be a picture of the place instead of the key.
        error.set_input(None);
        let message = error.to_string();
        let words: Vec<&str> = message.split_whitespace().collect();
        format!("line {line}: {}", words.join(" "))
    }

    /// The line of the error, from 0.
    fn line_of(text: &str, error: &toml::de::Error) -> usize {
        let start = error.span().map_or(0, |span| span.start.min(text.len()));
        text.as_bytes()[..start].iter().filter(|byte| **byte == b'\n').count()
    }
}

/// What the derived readers are too lenient for. Tables whose keys depend on `kind` are read flat: derived enums would
/// take stray keys of a unit variant and lose the key of a value that does not fit.
#[cfg(feature = "serde")]
mod tables {
    use std::path::PathBuf;

    use serde::de::Error;
    use serde::{Deserialize, Deserializer};

    use super::{FileRoughness, RandomRoughness, Roughness};
    use crate::surface::Form;

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct FormTable {
        kind: FormKind,
        radius: Option<f64>,
        radius_x: Option<f64>,
        radius_y: Option<f64>,
    }

    #[derive(Deserialize, Clone, Copy)]
    #[serde(rename_all = "snake_case")]
    enum FormKind {
        Sphere,
        Ellipsoid,
    }

    pub(super) fn form<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Form, D::Error> {
        let table = FormTable::deserialize(deserializer)?;
        let given = [
            ("radius", table.radius.is_some()),
            ("radius_x", table.radius_x.is_some()),
            ("radius_y", table.radius_y.is_some()),
        ];
        match table.kind {
            FormKind::Sphere => refuse_strays("sphere", &given, &["radius"])
                .and_then(|()| Ok(Form::Sphere { radius: required("radius", table.radius)? })),
            FormKind::Ellipsoid => {
                refuse_strays("ellipsoid", &given, &["radius_x", "radius_y"]).and_then(|()| {
                    Ok(Form::Ellipsoid {
                        radius_x: required("radius_x", table.radius_x)?,
                        radius_y: required("radius_y", table.radius_y)?,
                    })
                })
            }
        }
        .map_err(D::Error::custom)
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    pub(super) struct RoughnessTable {
        kind: RoughnessKind,
        rq: Option<f64>,
        length_x: Option<f64>,
        length_y: Option<f64>,
        seed: Option<u64>,
        path: Option<PathBuf>,
    }

    #[derive(Deserialize, Clone, Copy)]
    #[serde(rename_all = "snake_case")]
    enum RoughnessKind {
        None,
        Gaussian,
        Exponential,
        File,
    }

    const RANDOM: [&str; 4] = ["rq", "length_x", "length_y", "seed"];

    impl TryFrom<RoughnessTable> for Roughness {
        type Error = String;

        fn try_from(table: RoughnessTable) -> Result<Self, String> {
            let given = [
                ("rq", table.rq.is_some()),
                ("length_x", table.length_x.is_some()),
                ("length_y", table.length_y.is_some()),
                ("seed", table.seed.is_some()),
                ("path", table.path.is_some()),
            ];
            let random = |kind| {
                refuse_strays(kind, &given, &RANDOM)?;
                Ok::<_, String>(RandomRoughness {
                    rq: required("rq", table.rq)?,
                    length_x: required("length_x", table.length_x)?,
                    length_y: required("length_y", table.length_y)?,
                    seed: table.seed.unwrap_or_default(),
                })
            };
            Ok(match table.kind {
                RoughnessKind::None => {
                    refuse_strays("none", &given, &[])?;
                    Self::None
                }
                RoughnessKind::Gaussian => Self::Gaussian(random("gaussian")?),
                RoughnessKind::Exponential => Self::Exponential(random("exponential")?),
                RoughnessKind::File => {
                    refuse_strays("file", &given, &["path", "rq"])?;
                    Self::File(FileRoughness { path: required("path", table.path)?, rq: table.rq })
                }
            })
        }
    }

    /// Exactly two numbers: the parser would drop further ones in silence.
    pub(super) fn edges<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 2], D::Error> {
        let edges = Vec::<f64>::deserialize(deserializer)?;
        <[f64; 2]>::try_from(edges.as_slice())
            .map_err(|_| D::Error::invalid_length(edges.len(), &"the two outer edges"))
    }

    fn refuse_strays(kind: &str, given: &[(&str, bool)], known: &[&str]) -> Result<(), String> {
        match given.iter().find(|(key, present)| *present && !known.contains(key)) {
            None => Ok(()),
            Some((key, _)) => Err(match known {
                [] => format!("unknown field `{key}`, kind = \"{kind}\" has no other fields"),
                _ => format!("unknown field `{key}`, kind = \"{kind}\" has `{}`", known.join("`, `")),
            }),
        }
    }

    fn required<T>(key: &str, value: Option<T>) -> Result<T, String> {
        value.ok_or_else(|| format!("missing field `{key}`"))
    }
}
