//! Rigid bearings of scene files.

mod heat;
mod numbers;
mod relief;

pub use numbers::BearingNumbers;

use std::path::Path;

use crate::analytic::GreenwoodTripp;
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::{
    ElasticBore, Feed, FilmThickness, GivenFilm, GivenFilmSolution, Grooves, Holes, JournalBearing,
    JournalSolution, MeanRoughness,
};
use crate::sim::contact::oil;
use crate::sim::contact::warnings::{Warning, bearing_warnings, given_film_warnings};
use crate::sim::error::SimError;
use crate::sim::scene::{
    BearingFile, BearingSpec, Document, GrooveSpec, HeatBalance, HoleSpec, JournalPosition, LubricantSpec,
    PadRelief, RoughnessSpec,
};

/// Length of grooves over the width of their bearing, where it is not given.
const USUAL_GROOVE: f64 = 0.8;

/// A rigid bearing by a scene file with the table `[given_film]`.
///
/// ```
/// use stribeck::sim::RigidBearing;
/// let scene = "[given_film]\nkind = \"journal\"\ndiameter = \"50 mm\"\nwidth = \"25 mm\"\nclearance = \"40 um\"\n\
///              speed = \"1500 rpm on 50 mm\"\nload = \"1 kN\"\nnx = 90\nny = 16\n[lubricant]\ngrade = \"ISO VG 32\"\n\
///              viscosity_index = 98\n[thermal]\nbulk_temperature = \"50 degC\"\n";
/// let solved = RigidBearing::from_toml(scene)?.solve(|| false)?;
/// assert!((solved.numbers.load / 1000.0 - 1.0).abs() < 1e-5);
/// assert!(solved.numbers.power_loss > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct RigidBearing {
    /// Shape and motion.
    pub bearing: BearingSpec,
    /// The lubricant.
    pub lubricant: LubricantSpec,
    /// Temperature of the oil without a heat balance \[K\].
    pub temperature: f64,
    /// Heat balance that determines the temperature of the oil.
    pub heat: Option<HeatBalance>,
    /// Pressures at inlet, outlet and both sides of a pad \[Pa\].
    pub edge_pressures: [f64; 4],
    /// Relief of a pad.
    pub relief: Option<PadRelief>,
    /// Grooves of a journal.
    pub grooves: Option<GrooveSpec>,
    /// Holes that feed the film.
    pub holes: Option<HoleSpec>,
    /// Deflection of journal and bush.
    pub bore: Option<ElasticBore>,
    /// Roughness of both surfaces in the mean; smooth surfaces without it.
    pub roughness: Option<RoughnessSpec>,
    /// Cells along and across the motion.
    pub cells: [usize; 2],
}

/// A solved bearing.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct BearingSolution {
    /// Forces, flows and power.
    pub numbers: BearingNumbers,
    /// Pressures and film fractions. The lower surface moves.
    pub film: GivenFilmSolution,
    /// Implausible values.
    pub warnings: Vec<Warning>,
}

impl RigidBearing {
    /// Reads a scene with the table `[given_film]` from TOML text.
    ///
    /// # Errors
    /// [`SimError::Scene`] with key and line for a value that does not fit, [`SimError::Input`] for a quantity of
    /// another dimension than its key.
    pub fn from_toml(text: &str) -> Result<Self, SimError> {
        Self::read(&Document::parse(text)?)
    }

    /// Reads a parsed scene file.
    pub(super) fn read(document: &Document<'_>) -> Result<Self, SimError> {
        let file: BearingFile = document.read(|_| Vec::new())?;
        let table = file.given_film;
        let refused = |reason: String| SimError::Scene {
            reason: format!("given_film: {reason}").replace("missing field", "missing key"),
        };
        Ok(Self {
            bearing: table.spec().map_err(refused)?,
            heat: table.heat().map_err(refused)?,
            edge_pressures: table.edge_pressures().map_err(refused)?,
            relief: table.relief().map_err(refused)?,
            grooves: table.grooves().map_err(refused)?,
            holes: table.holes().map_err(refused)?,
            bore: table.bore().map_err(refused)?,
            roughness: table.roughness(),
            cells: table.cells(),
            lubricant: file.lubricant,
            temperature: file.thermal.bulk_temperature,
        })
    }

    /// The bearing with paths of files relative to `folder`.
    pub(super) fn in_folder(mut self, folder: &Path) -> Self {
        if let Some(PadRelief::File { path, .. }) = &mut self.relief {
            *path = folder.join(&path);
        }
        self
    }

    /// Solves; `interrupted` ends it with an error.
    ///
    /// # Errors
    /// A value out of range, a load that no eccentricity up to 0.99 carries, a heat balance without through-flow, a relief
    /// that does not fit its pad, an interruption.
    pub fn solve(&self, interrupted: impl Fn() -> bool) -> Result<BearingSolution, SimError> {
        let mut solution = match &self.heat {
            None => {
                InputError::require_positive("thermal.bulk_temperature", self.temperature)?;
                self.solve_at(self.temperature, &interrupted)?
            }
            Some(balance) => heat::solve(self, balance, &interrupted)?,
        };
        let has_data_sheet = self.lubricant.oil.is_some();
        let seen = (solution.numbers.load, solution.numbers.temperature);
        solution.warnings.extend(bearing_warnings(seen, has_data_sheet, self.relief.as_ref()));
        Ok(solution)
    }

    /// Solves with the oil at `temperature` \[K\].
    fn solve_at(
        &self,
        temperature: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<BearingSolution, SimError> {
        let lubricant = self.lubricant(temperature)?;
        let mut solution = self.solve_with(&lubricant, interrupted)?;
        solution.numbers.temperature = temperature;
        Ok(solution)
    }

    /// Solves with `lubricant`.
    fn solve_with(
        &self,
        lubricant: &Lubricant,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<BearingSolution, SimError> {
        match self.bearing {
            BearingSpec::Journal { diameter, width, clearance, speed, position } => {
                InputError::require_positive("given_film.diameter", diameter)?;
                require_speed(speed)?;
                let radius = 0.5 * diameter;
                let grooves = self.grooves.as_ref();
                let grooves = grooves.map(|spec| {
                    let length = spec.length.unwrap_or(USUAL_GROOVE * width);
                    Grooves::new(&spec.angles, [spec.width, length], spec.pressure)
                });
                let journal = JournalBearing::new([radius, width, clearance], speed / radius, lubricant)
                    .with_cells(self.cells)
                    .with_roughness(self.mean_roughness()?)
                    .with_grooves(grooves)
                    .with_holes(
                        self.holes
                            .as_ref()
                            .map(|spec| Holes::new(&spec.places, spec.diameter, spec.pressure)),
                    )
                    .with_bore(self.bore);
                let solved = match position {
                    JournalPosition::Eccentricity(eccentricity) => {
                        journal.solve_unless(eccentricity, interrupted)
                    }
                    JournalPosition::Load(load) => journal.equilibrium_unless(load, interrupted),
                };
                let solved = solved.map_err(in_table)?;
                self.journal(lubricant, speed, clearance, solved)
            }
            BearingSpec::Pad { length, width, inlet_film, outlet_film, speed } => {
                let film = |x: f64| inlet_film + (outlet_film - inlet_film) * x / length;
                self.pad(lubricant, [length, width.unwrap_or(1.0), speed], &film, interrupted)
            }
            BearingSpec::Step { length, width, inlet_film, outlet_film, step, speed } => {
                InputError::require(
                    (0.0..length).contains(&step),
                    "given_film.step",
                    step,
                    "at least 0 and below the length: the length of the part before the step",
                )?;
                let film = |x: f64| if x < step { inlet_film } else { outlet_film };
                self.pad(lubricant, [length, width.unwrap_or(1.0), speed], &film, interrupted)
            }
        }
    }

    /// The roughness of both surfaces.
    fn mean_roughness(&self) -> Result<Option<MeanRoughness>, InputError> {
        let rough = |spec: &RoughnessSpec| {
            let contact =
                GreenwoodTripp::new(spec.asperity_number, spec.rq_over_radius, spec.equivalent_modulus)?;
            MeanRoughness::new(spec.rq, spec.gamma, contact, spec.boundary_friction)
        };
        let found = self.roughness.as_ref().map(rough).transpose();
        found.map_err(|error| error.within("given_film.roughness"))
    }

    /// The lubricant at `temperature` \[K\].
    fn lubricant(&self, temperature: f64) -> Result<Lubricant, InputError> {
        let spec = &self.lubricant;
        let viscosity = oil::viscosity_law(spec, temperature)?;
        let viscosity = viscosity.at_temperature(temperature).unwrap_or(viscosity);
        Ok(Lubricant::from_boxed(viscosity, oil::density_law(spec, temperature)?))
    }

    /// Numbers of a solved journal bearing.
    fn journal(
        &self,
        lubricant: &Lubricant,
        speed: f64,
        clearance: f64,
        solved: JournalSolution,
    ) -> Result<BearingSolution, SimError> {
        let grid = solved.film.grid();
        let films = [clearance * (1.0 + solved.eccentricity), solved.least_film];
        let film =
            FilmThickness::from_function(
                grid,
                |x, _| if x < 0.5 * grid.size_x() { films[0] } else { films[1] },
            )?;
        let problem = GivenFilm::new(&film, lubricant, [speed, 0.0]).with_roughness(self.mean_roughness()?);
        let warnings = given_film_warnings(&problem, &solved.film);
        let numbers = BearingNumbers {
            force: Some(solved.force),
            attitude: Some(solved.attitude),
            eccentricity: Some(solved.eccentricity),
            sommerfeld: Some(solved.sommerfeld),
            contact_share: self.roughness.is_some().then_some(solved.contact_share),
            groove_flow: self.grooves.is_some().then_some(solved.groove_flow),
            hole_flow: self.holes.is_some().then_some(solved.hole_flow),
            bore_widening: self.bore.is_some().then_some(solved.bore_widening),
            ..self.numbers(lubricant, solved.load, solved.least_film, &solved.film)
        };
        Ok(BearingSolution { numbers, film: solved.film, warnings })
    }

    /// Solves a pad of `[length, width, speed]`.
    fn pad(
        &self,
        lubricant: &Lubricant,
        [length, width, speed]: [f64; 3],
        thickness: &dyn Fn(f64) -> f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<BearingSolution, SimError> {
        InputError::require_positive("given_film.length", length)?;
        InputError::require_positive("given_film.width", width)?;
        require_speed(speed)?;
        InputError::require_positive("given_film.inlet_film", thickness(0.0))?;
        InputError::require_positive("given_film.outlet_film", thickness(length))?;
        let grid = Grid::from_edges(self.cells[0], self.cells[1], [0.0, length], [0.0, width])?;
        let film = relief::film(self.relief.as_ref(), grid, thickness)?;
        let feeds = self.pad_feeds([length, width])?;
        let problem = GivenFilm::new(&film, lubricant, [speed, 0.0])
            .with_edge_pressures(self.edge_pressures)
            .with_feeds(&feeds)
            .with_roughness(self.mean_roughness()?);
        let solved = problem.solve_unless(interrupted).map_err(in_table)?;
        let warnings = given_film_warnings(&problem, &solved);
        let least = if self.relief.is_some() {
            film.nodes().iter().copied().fold(f64::INFINITY, f64::min)
        } else {
            thickness(0.0).min(thickness(length))
        };
        Ok(BearingSolution {
            numbers: self.numbers(lubricant, solved.load, least, &solved),
            film: solved,
            warnings,
        })
    }

    /// Holes of a pad of `[length, width]`.
    fn pad_feeds(&self, [length, width]: [f64; 2]) -> Result<Vec<Feed>, InputError> {
        let Some(holes) = &self.holes else { return Ok(Vec::new()) };
        let field = |key: &str| format!("given_film.{key}");
        if self.cells[1] == 1 {
            let reason = "holes need the `width` of the pad".to_owned();
            return Err(InputError::Conflict { field: field("hole_positions"), reason });
        }
        InputError::require(
            holes.diameter > 0.0 && holes.diameter < width,
            &field("hole_diameter"),
            holes.diameter,
            "above 0 and below the width of the pad",
        )?;
        InputError::require_non_negative(&field("supply_pressure"), holes.pressure)?;
        let radius = 0.5 * holes.diameter;
        holes
            .places
            .iter()
            .map(|&place| {
                let requirement = "at least a radius of the hole from inlet and outlet";
                let fits = place > radius && place < length - radius;
                InputError::require(fits, &field("hole_positions"), place, requirement)?;
                Ok(Feed::hole([place, 0.5 * width], holes.diameter, holes.pressure))
            })
            .collect()
    }

    /// Numbers that all bearings have.
    fn numbers(
        &self,
        lubricant: &Lubricant,
        load: f64,
        least_film: f64,
        film: &GivenFilmSolution,
    ) -> BearingNumbers {
        let [moving, resting] = film.friction;
        let contact = film.contact.as_ref();
        BearingNumbers {
            load,
            force: None,
            attitude: None,
            eccentricity: None,
            sommerfeld: None,
            least_film,
            pressure_max: film.pressure.iter().copied().fold(0.0, f64::max),
            friction_moving: -moving,
            friction_resting: resting,
            friction_coefficient: if load > 0.0 { -moving / load } else { f64::NAN },
            cavitated_shear: film.cavitated_shear,
            contact_share: contact.map(|contact| contact.load / load),
            contact_area: contact.map(|contact| contact.area),
            contact_friction: contact.map(|contact| contact.friction),
            film_over_rq: self.roughness.map(|spec| least_film / spec.rq[0].hypot(spec.rq[1])),
            side_flow: film.side_flow,
            edge_flows: film.edge_flows,
            groove_flow: None,
            hole_flow: self.holes.is_some().then(|| film.feed_flows.iter().sum()),
            bore_widening: None,
            power_loss: film.power_loss,
            eta0: lubricant.viscosity().viscosity(0.0),
            temperature: self.temperature,
            supply_temperature: None,
            outlet_temperature: None,
            carried_heat: None,
        }
    }
}

/// Error unless the surface moves along +x.
fn require_speed(speed: f64) -> Result<(), InputError> {
    InputError::require_positive("given_film.speed", speed)
}

/// The error with the table before its field.
fn in_table(error: crate::reynolds::ReynoldsError) -> SimError {
    match error {
        crate::reynolds::ReynoldsError::Input(error) => SimError::Input(error.within("given_film")),
        error => error.into(),
    }
}
