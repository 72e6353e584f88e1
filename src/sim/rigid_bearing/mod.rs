//! Rigid bearings of scene files.

mod equilibrium;
mod heat;
mod journal;
mod numbers;
mod pad;
mod relief;

pub use numbers::BearingNumbers;

use std::path::Path;

use self::journal::JournalSize;
use self::numbers::Thickness;
use self::pad::Pad;
use crate::analytic::GreenwoodTripp;
use crate::error::InputError;
use crate::lubricant::Lubricant;
use crate::metrics::composite_rq;
use crate::report::Status;
use crate::reynolds::{ElasticBore, GivenFilmSolution, MeanRoughness, ReynoldsError};
use crate::sim::contact::oil;
use crate::sim::contact::warnings::{
    Warning, bearing_warnings, other_diameter, reject_oil_temperature, tension, turbulent_film,
    unsolved_bearing,
};
use crate::sim::error::SimError;
use crate::sim::scene::{
    BearingFile, BearingSpec, Document, GrooveSpec, HeatBalance, HoleSpec, LubricantSpec, PadRelief,
    RoughnessSpec, bearing_keys,
};

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
    /// Pressure at which the oil cavitates \[Pa\], relative to ambient as those of the edges.
    pub cavitation_pressure: f64,
    /// Whether the film of a pad repeats along the motion, as around a ring.
    pub is_periodic: bool,
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
    /// Diameter \[m\] on which the speed of a journal is given as a rate of rotation; `None` for its own diameter and
    /// for speeds in m/s.
    pub speed_diameter: Option<f64>,
}

/// A solved bearing.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct BearingSolution {
    /// Forces, flows and power.
    pub numbers: BearingNumbers,
    /// Pressures and film fractions. The lower surface moves.
    pub film: GivenFilmSolution,
    /// Film thickness at the nodes \[m\].
    pub thickness: Vec<f64>,
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
        let file: BearingFile = document.read(bearing_keys)?;
        document.require_keys(bearing_keys)?;
        let table = file.given_film;
        let refused = |reason: String| SimError::Scene {
            reason: format!("given_film: {reason}").replace("missing field", "missing key"),
        };
        Ok(Self {
            bearing: table.spec().map_err(refused)?,
            heat: table.heat().map_err(refused)?,
            edge_pressures: table.edge_pressures().map_err(refused)?,
            cavitation_pressure: table.cavitation_pressure(),
            is_periodic: table.is_periodic().map_err(refused)?,
            relief: table.relief().map_err(refused)?,
            grooves: table.grooves().map_err(refused)?,
            holes: table.holes().map_err(refused)?,
            bore: table.bore().map_err(refused)?,
            roughness: table.roughness(),
            cells: table.cells(),
            speed_diameter: document.speed_diameter,
            lubricant: file.lubricant.0,
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
    /// A value out of range, a load that no eccentricity up to 0.99 or no film of a pad carries, a heat balance without through-flow, a relief
    /// that does not fit its pad, an interruption.
    pub fn solve(&self, interrupted: impl Fn() -> bool) -> Result<BearingSolution, SimError> {
        let mut solution = match &self.heat {
            None => {
                InputError::require_positive("thermal.bulk_temperature", self.temperature)?;
                reject_oil_temperature("thermal.bulk_temperature", self.temperature)?;
                self.solve_at(self.temperature, &interrupted)?
            }
            Some(balance) => heat::solve(self, balance, &interrupted)?,
        };
        if solution.film.report.status == Status::Converged {
            let (numbers, oil) = (&solution.numbers, self.lubricant.oil.as_ref());
            let warnings = bearing_warnings([numbers.load, numbers.temperature], oil, self.relief.as_ref());
            let mean_film = solution.thickness.iter().sum::<f64>() / solution.thickness.len() as f64;
            let turbulent =
                turbulent_film(&self.bearing, [mean_film, numbers.eta0, numbers.temperature], oil);
            let scene = [
                other_diameter(&self.bearing, self.speed_diameter),
                tension(self.cavitation_pressure),
                turbulent,
            ];
            solution.warnings.extend(warnings.into_iter().chain(scene.into_iter().flatten()));
        } else {
            solution.warnings.push(unsolved_bearing(
                [solution.numbers.alpha, solution.numbers.viscosity_ratio],
                self.bore.is_none(),
            ));
            solution.numbers = solution.numbers.without_results();
        }
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
                let size = JournalSize { diameter, width, clearance, speed };
                journal::solve(self, lubricant, (size, position), interrupted)
            }
            BearingSpec::Pad { length, width, film, step, speed } => {
                let (is_wide, width) = (width.is_none(), width.unwrap_or(1.0));
                Pad { bearing: self, lubricant, length, width, is_wide, step, speed, interrupted }
                    .solve_with(film)
            }
        }
    }

    /// Least pressure of the edges through which the film is fed \[Pa\].
    fn least_edge_pressure(&self) -> f64 {
        let ends = if self.is_periodic { 2 } else { 0 };
        self.edge_pressures[ends..].iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Root mean square height of both surfaces together \[m\].
    fn composite_rq(&self) -> Option<f64> {
        self.roughness.map(|spec| composite_rq(spec.rq[0], spec.rq[1]))
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

    /// Whether the viscosity of the oil depends on temperature.
    ///
    /// ```
    /// use stribeck::sim::RigidBearing;
    /// let pad = "[given_film]\nkind = \"pad\"\nlength = \"20 mm\"\ninlet_film = \"20 um\"\noutlet_film = \"10 um\"\nspeed = 1\n";
    /// let depends = |oil: &str| RigidBearing::from_toml(&format!("{pad}[lubricant]\n{oil}\n")).map(|pad| pad.has_thermal_oil());
    /// assert!(depends("grade = \"ISO VG 32\"\nviscosity_index = 98")?);
    /// assert!(!depends("eta0 = \"18 mPa s\"")?); // isoviscous
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn has_thermal_oil(&self) -> bool {
        let law = oil::viscosity_law(&self.lubricant, self.temperature);
        law.is_ok_and(|law| law.at_temperature(self.temperature).is_some())
    }

    /// The lubricant at `temperature` \[K\].
    fn lubricant(&self, temperature: f64) -> Result<Lubricant, InputError> {
        let spec = &self.lubricant;
        let viscosity = oil::viscosity_law(spec, temperature)?;
        let viscosity = viscosity.at_temperature(temperature).unwrap_or(viscosity);
        Ok(Lubricant::from_boxed(viscosity, oil::density_law(spec, temperature)?))
    }
}

/// Error unless the surface moves along +x.
fn require_speed(speed: f64) -> Result<(), InputError> {
    InputError::require_positive("given_film.speed", speed)
}

/// The error with the table before its field.
fn in_table(error: ReynoldsError) -> SimError {
    match error {
        ReynoldsError::Input(error) => SimError::Input(error.within("given_film")),
        error => error.into(),
    }
}
