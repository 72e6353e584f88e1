//! `stribeck check`: regime, film and load on solids by formula, whether a scene can be solved and run, and the
//! parts of its model, without solving. The film of a rigid bearing is solved.

mod bearing;
mod cycle;
mod parts;
mod words;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use stribeck::InputError;
use stribeck::sim::scene::{GridSpec, Scene, TrackSpec};
use stribeck::sim::{
    Expectation, ExpectedFilm, FormulaFilm, HertzContact, MixedLubricationSim, OilNumbers, SceneFile,
    SimError, Warning,
};

use self::parts::{Part, parts};
use crate::output::{self, Outcome};

/// Box and cells on which a scene is looked at that picks its own.
const OWN_BOX: f64 = 2.0;
const OWN_CELLS: usize = 64;

/// Warnings go to standard error. The film of a rigid bearing (table `given_film`) is solved.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Scene file
    scene: PathBuf,
    /// Print one JSON object in SI units on standard output
    #[arg(long)]
    json: bool,
}

/// Why a scene is refused as a single contact, and as a history; none of it where it is not.
struct Refusals {
    solve: Option<SimError>,
    run: Option<SimError>,
}

/// Results of a check: warnings and estimates before a solve.
struct Expected {
    refusals: Refusals,
    parts: Vec<Part>,
    hertz: HertzContact,
    oil: Option<OilNumbers>,
    formula: Option<FormulaFilm>,
    expectation: Expectation,
    /// The grid is picked by the solve.
    picks_grid: bool,
    /// Errors are estimated by the solve.
    has_estimate: bool,
    /// How the oil has its temperature.
    temperature: OilTemperature,
    /// Memory of a solve on the grid \[byte\].
    memory: f64,
    warnings: Vec<Warning>,
    sim: MixedLubricationSim,
}

/// How the oil has its temperature.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum OilTemperature {
    /// Its viscosity does not depend on it.
    Without,
    /// The scene states it.
    Stated,
    /// That of scenes without `thermal.bulk_temperature`.
    Default,
}

impl OilTemperature {
    /// That of `scene`, whose file is `path`.
    fn of(scene: &Scene, path: &Path) -> Result<Self, InputError> {
        let mut warmer = scene.clone();
        warmer.thermal.bulk_temperature += 1.0;
        let eta0 = |scene: &Scene| Ok::<_, InputError>(scene.oil_numbers()?.map(|oil| oil.eta0));
        if eta0(scene)? == eta0(&warmer)? {
            return Ok(Self::Without);
        }
        let text = fs::read_to_string(path).unwrap_or_default();
        let file = text.parse::<toml::Table>().unwrap_or_default();
        let states =
            |table: &str| file.get(table).is_some_and(|table| table.get("bulk_temperature").is_some());
        Ok(if states("thermal") || states("schedule") { Self::Stated } else { Self::Default })
    }
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let scene = match output::load_any(&options.scene)? {
        SceneFile::Bearing(bearing) => return bearing::run(options, &bearing),
        file => output::contact(&options.scene, file)?,
    };
    let named = |error: Box<dyn Error>| output::in_scene(&options.scene, error.as_ref());
    let mut expected = Expected::of(&scene, &options.scene).map_err(named)?;
    let rows = cycle::Rows::of(&scene, &options.scene).map_err(named)?;
    if let Some(rows) = &rows {
        expected.warnings = joined(expected.warnings, rows.warnings());
    }
    let mut numbers = expected.to_json()?;
    output::warn(&expected.warnings);
    if options.json {
        if let Some(rows) = rows {
            numbers["cycle"] = rows.to_json()?;
        }
        output::print(&numbers)?;
    } else {
        output::print(&expected.to_text(rows.as_ref()))?;
    }
    Ok(Outcome::Converged)
}

/// The warnings `known`, and those of `found` whose fields they do not name.
fn joined(known: Vec<Warning>, found: &[Warning]) -> Vec<Warning> {
    let is_new = |warning: &&Warning| known.iter().all(|known| known.field != warning.field);
    let new: Vec<Warning> = found.iter().filter(is_new).cloned().collect();
    [known, new].concat()
}

impl Expected {
    /// # Errors
    /// That of a single contact, where neither it nor a history can be made of the scene.
    fn of(scene: &Scene, path: &Path) -> Result<Self, Box<dyn Error>> {
        let builder = || MixedLubricationSim::builder(scene.clone());
        let (warnings, refusals) = match (builder().check_contact(), builder().check()) {
            (Err(solve), Err(_)) => return Err(solve.into()),
            (Ok(warnings), run) => (warnings, Refusals { solve: None, run: run.err() }),
            (Err(solve), Ok(warnings)) => (warnings, Refusals { solve: Some(solve), run: None }),
        };
        let picks_grid = matches!(scene.grid, GridSpec::Accuracy { .. });
        let hertz = scene.hertz()?;
        let mut on_grid = scene.clone();
        if picks_grid {
            on_grid.grid = own_grid(scene, &hertz);
        }
        (on_grid.solver.accuracy, on_grid.solver.estimate) = (None, false);
        let memory = on_grid.memory()?;
        if refusals.run.is_some() {
            leave_contact(&mut on_grid)?;
        }
        let sim = MixedLubricationSim::builder(on_grid).build()?;
        let expected = sim.expected_warnings()?;
        let warnings = joined(warnings, &expected);
        Ok(Self {
            refusals,
            parts: parts(scene, &sim)?,
            hertz,
            oil: scene.oil_numbers()?,
            formula: scene.formula_film()?,
            expectation: sim.expectation()?,
            picks_grid,
            has_estimate: scene.solver.estimate || scene.solver.accuracy.is_some(),
            temperature: OilTemperature::of(scene, path)?,
            memory,
            warnings,
            sim,
        })
    }

    /// Cells in a Hertz half-width.
    fn cells(&self) -> f64 {
        let grid = self.sim.grid();
        let [half_x, half_y] = self.hertz.half_extents();
        let is_line = self.sim.scene().form.is_line();
        let across = if is_line { f64::INFINITY } else { half_y / grid.dy() };
        (half_x / grid.dx()).min(across)
    }

    /// Distance of the edges of the box along x from the middle, in Hertz half-widths.
    fn room(&self) -> [f64; 2] {
        let grid = self.sim.grid();
        let low = grid.x(0) - 0.5 * grid.dx();
        [-low, low + grid.size_x()].map(|distance| distance / self.hertz.half_extents()[0])
    }

    fn to_json(&self) -> Result<Value, serde_json::Error> {
        let (hertz, grid, [inlet, outlet]) = (&self.hertz, self.sim.grid(), self.room());
        let film = self.expectation.film;
        let mut roughness = serde_json::to_value(self.expectation.roughness)?;
        roughness["short_roughness"] = self.expectation.short_roughness.into();
        roughness["correlation_length"] = self.expectation.correlation_length.into();
        let grid = (!self.picks_grid).then(|| {
            json!({
                "nx": grid.nx(), "ny": grid.ny(), "dx": grid.dx(), "dy": grid.dy(),
                "cells_in_half_width": self.cells(),
                "inlet_in_half_widths": inlet,
                "outlet_in_half_widths": outlet,
                "memory": self.memory,
            })
        });
        let refused = |error: &Option<SimError>| error.as_ref().map(ToString::to_string);
        Ok(json!({
            "refused": { "solve": refused(&self.refusals.solve), "run": refused(&self.refusals.run) },
            "modelled": parts::objects(&self.parts),
            "hertz": hertz,
            "oil": self.oil,
            "moes": self.formula.map(|formula| formula.moes),
            "regime": film.map(|film| film.map.regime),
            "viscosity_parameter": film.map(|film| film.map.viscosity_parameter),
            "elasticity_parameter": film.map(|film| film.map.elasticity_parameter),
            "film": {
                "formula_central": film.map(|film| film.central),
                "formula": film.map(|film| film.formula),
                "formula_lambda": film.and_then(|film| film.lambda),
            },
            "contact": {
                "load_ratio": film.and_then(|film| film.load_ratio),
                "load_ratio_range": film.and_then(|film| film.load_ratio_range),
                "film_cutoff": film.map(|_| self.sim.scene().solver.film_cutoff),
                "inlet_number": film.and_then(|film| film.inlet_number),
                "load_ratio_by_contact_film": film.and_then(|film| film.load_ratio_by_contact_film),
                "friction_by_contact_film": film.and_then(|film| film.friction_by_contact_film),
            },
            "friction": film.map(|ExpectedFilm { friction: [boundary, fluid], .. }| {
                json!({ "coefficient": boundary + fluid, "boundary": boundary, "fluid": fluid })
            }),
            "film_rise": film.map(|film| film.film_rise),
            "flash_rise": self.expectation.flash_rise,
            "roughness": roughness,
            "grid": grid,
            "warnings": serde_json::to_value(&self.warnings)?,
            "version": env!("CARGO_PKG_VERSION"),
        }))
    }
}

/// Removes the parts of `scene` that only a history may reject: the rest is the contact at the start.
fn leave_contact(scene: &mut Scene) -> Result<(), InputError> {
    let start = scene.conditions(0.0)?;
    (scene.load.force, scene.load.hertz_pressure) = (Some(start.load), None);
    (scene.motion, scene.thermal.bulk_temperature) = (start.motion, start.bulk_temperature);
    (scene.motion.roughness, scene.motion.passage) = (Default::default(), None);
    (scene.schedule, scene.track) = (Default::default(), TrackSpec::default());
    Ok(())
}

/// Cells on which a scene is looked at that picks its own.
fn own_grid(scene: &Scene, hertz: &HertzContact) -> GridSpec {
    let edges = |half_width: f64| [-OWN_BOX * half_width, OWN_BOX * half_width];
    let [half_x, half_y] = hertz.half_extents();
    let (n, x) = (OWN_CELLS, edges(half_x));
    if scene.form.is_line() {
        GridSpec::Row { nx: n, x }
    } else {
        GridSpec::Cells { nx: n, ny: n, x, y: edges(half_y) }
    }
}
