//! Solves one quasi-static contact that a scene file describes (`docs/scene.md`).
//!
//! ```text
//! cargo run --release --example solve -- SCENE.toml [--json] [--fields OUT.npz]
//! ```
//!
//! Ends with 0 when the solve converged, 2 when it did not, 1 for bad input, with one line on standard error; warnings stand there too, a
//! line each.

use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use serde_json::{Value, json};
use stribeck::Status;
use stribeck::elastic::Extreme;
use stribeck::sim::{ContactSolution, Scene, Warning, solve_contact, write_npz};

const USAGE: &str = "usage: solve SCENE.toml [--json] [--fields OUT.npz]";
const NOT_CONVERGED: u8 = 2;

struct Arguments {
    scene: PathBuf,
    json: bool,
    fields: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run() {
        Ok(Some(Status::Converged) | None) => ExitCode::SUCCESS,
        Ok(Some(_)) => ExitCode::from(NOT_CONVERGED),
        Err(error) => {
            let line = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
            // Nobody is left to be told when standard error is closed.
            let _ = writeln!(io::stderr(), "error: {line}");
            ExitCode::FAILURE
        }
    }
}

/// The status of the solve; none when only help was wanted.
fn run() -> Result<Option<Status>, Box<dyn Error>> {
    let Some(arguments) = parse_arguments()? else {
        writeln!(io::stdout(), "{USAGE}")?;
        return Ok(None);
    };
    let start = Instant::now();
    let scene = Scene::load(&arguments.scene).map_err(|e| in_scene(&arguments.scene, &e))?;
    let known = scene.warnings();
    warn(known.iter());
    let solution = solve_contact(&scene).map_err(|e| in_scene(&arguments.scene, &e))?;
    warn(solution.warnings.iter().filter(|warning| !known.contains(warning)));
    let seconds = start.elapsed().as_secs_f64();
    if let Some(path) = &arguments.fields {
        write_fields(path, &solution)?;
    }
    let text =
        if arguments.json { to_json(&solution, seconds).to_string() } else { summary(&solution, seconds) };
    writeln!(io::stdout(), "{text}")?;
    Ok(Some(solution.report.status))
}

/// A line each on standard error; those of the scene come before the solve, which may take long.
fn warn<'a>(warnings: impl Iterator<Item = &'a Warning>) {
    for warning in warnings {
        let _ = writeln!(io::stderr(), "warning: {warning}");
    }
}

fn parse_arguments() -> Result<Option<Arguments>, Box<dyn Error>> {
    use lexopt::prelude::*;
    let mut parser = lexopt::Parser::from_env();
    let (mut scene, mut json, mut fields) = (None, false, None);
    while let Some(argument) = parser.next()? {
        match argument {
            Long("json") => json = true,
            Long("fields") => fields = Some(PathBuf::from(parser.value()?)),
            Long("help") | Short('h') => return Ok(None),
            Value(path) if scene.is_none() => scene = Some(PathBuf::from(path)),
            other => return Err(format!("{}; {USAGE}", other.unexpected()).into()),
        }
    }
    let scene = scene.ok_or_else(|| format!("no scene file is given; {USAGE}"))?;
    Ok(Some(Arguments { scene, json, fields }))
}

/// The error with the scene file in front, unless it already names it.
fn in_scene(path: &Path, error: &dyn Error) -> String {
    let (name, text) = (path.display().to_string(), error.to_string());
    if text.starts_with(&name) { text } else { format!("{name}: {text}") }
}

fn write_fields(path: &Path, solution: &ContactSolution) -> Result<(), Box<dyn Error>> {
    let state = &solution.state;
    let fields: [(&str, &[f64]); 6] = [
        ("pressure", &state.pressure),
        ("fluid_pressure", &state.fluid_pressure),
        ("film", &state.film),
        ("theta", &state.content),
        ("gap", &solution.gap),
        ("plastic_depth", &state.plastic_depth),
    ];
    write_npz(path, solution.grid.nx(), solution.grid.ny(), &fields)?;
    Ok(())
}

/// Everything in SI units; a number that is not finite becomes null.
fn to_json(solution: &ContactSolution, seconds: f64) -> Value {
    let ContactSolution {
        report,
        grid,
        hertz,
        moes,
        film,
        contact,
        discretisation,
        cavitation,
        flow,
        error_estimate,
        stress,
        state,
        ..
    } = solution;
    json!({
        "status": report.status.to_string(),
        "solver": report.solver,
        "scheme": discretisation.map(|(scheme, ..)| scheme),
        "face_mobility": discretisation.map(|(_, face_mobility, _)| face_mobility),
        "cavitation": cavitation,
        "contact_definition": discretisation.map(|(.., contact)| contact),
        "residual": {
            "mass": report.residuals.mass,
            "load": report.residuals.load,
            "complementarity": report.residuals.complementarity,
        },
        "energy_error": report.energy_error,
        "work": {
            "convolutions": report.work.convolutions,
            "iterations": report.work.iterations,
            "inner_iterations": report.work.inner_iterations,
        },
        "seconds": seconds,
        "hertz": {
            "radius": hertz.radius,
            "half_width_x": hertz.a_x,
            "half_width_y": hertz.a_y,
            "pressure": hertz.p_max,
            "force": hertz.load,
        },
        "moes": moes.map(|(m, l)| json!({ "m": m, "l": l })),
        "film": {
            "central": film.central,
            "minimum": film.minimum,
            "mean_central": film.mean_central,
            "minimum_gap": film.minimum_gap,
        },
        "pressure": { "max": contact.max_pressure, "central": contact.central_pressure },
        "contact": {
            "area_ratio": contact.area_ratio,
            "load_ratio": contact.load_ratio,
            "area": contact.area,
            "corrected_area_ratio": contact.corrected_area_ratio,
            "corrected_area": contact.corrected_area,
            "plastic_area": contact.plastic_area,
            "film_cutoff": contact.film_cutoff,
        },
        "friction": {
            "coefficient": solution.friction_coefficient,
            "boundary": solution.friction_boundary,
            "fluid": solution.friction_fluid,
        },
        "flow": flow.map(|flow| json!({
            "inflow": flow.inflow,
            "outflow": flow.outflow,
            "imbalance": flow.imbalance,
        })),
        "approach": state.approach,
        "stress": stress.map(|stress| json!({
            "von_mises": extreme(&stress.largest.von_mises),
            "orthogonal_shear": extreme(&stress.largest.orthogonal_shear),
            "yield_ratio": stress.yield_ratio,
            "shakedown_ratio": stress.shakedown_ratio,
        })),
        "error_estimate": error_estimate.map(|estimate| json!({
            "central_film": estimate.central_film,
            "minimum_film": estimate.minimum_film,
            "max_pressure": estimate.max_pressure,
            "mean_film": estimate.mean_film,
            "load_ratio": estimate.load_ratio,
            "area_ratio": estimate.area_ratio,
            "friction_coefficient": estimate.friction_coefficient,
        })),
        "grid": { "nx": grid.nx(), "ny": grid.ny(), "dx": grid.dx(), "dy": grid.dy() },
        "warnings": solution.warnings,
        "version": env!("CARGO_PKG_VERSION"),
    })
}

fn extreme(largest: &Extreme) -> Value {
    json!({ "stress": largest.stress, "depth": largest.depth, "x": largest.place.0, "y": largest.place.1 })
}

fn summary(solution: &ContactSolution, seconds: f64) -> String {
    let ContactSolution {
        report, grid, hertz, moes, film, contact, flow, error_estimate, stress, state, ..
    } = solution;
    let (residuals, work) = (report.residuals, report.work);
    let moes = moes.map_or_else(|| "dry".to_owned(), |(m, l)| format!("Moes M {m:.1}, L {l:.3}"));
    let mut lines = vec![
        format!(
            "{} by {} in {seconds:.2} s on {} x {} nodes",
            report.status,
            report.solver,
            grid.nx(),
            grid.ny()
        ),
        format!(
            "residuals  mass {:.1e}, load {:.1e}, complementarity {:.1e}",
            residuals.mass, residuals.load, residuals.complementarity
        ),
        format!(
            "work       {} iterations, {} inner, {:.0} convolutions",
            work.iterations, work.inner_iterations, work.convolutions
        ),
        format!(
            "Hertz      {:.4} GPa, {:.4} N, {:.2} x {:.2} um; {moes}",
            hertz.p_max * 1e-9,
            hertz.load,
            hertz.a_x * 1e6,
            hertz.a_y * 1e6
        ),
        format!(
            "film       central {:.3} nm, minimum {:.3} nm, mean {:.3} nm",
            film.central * 1e9,
            film.minimum * 1e9,
            film.mean_central * 1e9
        ),
        format!(
            "pressure   maximum {:.4} GPa, central {:.4} GPa",
            contact.max_pressure * 1e-9,
            contact.central_pressure * 1e-9
        ),
        format!(
            "contact    below {:.2} nm: {:.2} % of the Hertz area, {:.2} % of the load, {:.1} um^2 plastic",
            contact.film_cutoff * 1e9,
            contact.area_ratio * 100.0,
            contact.load_ratio * 100.0,
            contact.plastic_area * 1e12
        ),
        format!("friction   {:.4}", solution.friction_coefficient),
        flow.map_or_else(
            || "flow       none: dry".to_owned(),
            |flow| {
                let unit = if grid.ny() == 1 { "m^2/s" } else { "m^3/s" };
                format!(
                    "flow       in {:.4e}, out {:.4e} {unit}, imbalance {:.1e}",
                    flow.inflow, flow.outflow, flow.imbalance
                )
            },
        ),
        format!("approach   {:.3} nm", state.approach * 1e9),
        error_estimate.map_or_else(
            || "errors     not estimated".to_owned(),
            |estimate| {
                format!(
                    "errors     central film {:.2} %, minimum film {:.2} %, maximum pressure {:.2} %, mean film {:.2} %, friction {:.2} %, \
                     load ratio {:.4}, area ratio {:.4}",
                    estimate.central_film * 100.0,
                    estimate.minimum_film * 100.0,
                    estimate.max_pressure * 100.0,
                    estimate.mean_film * 100.0,
                    estimate.friction_coefficient * 100.0,
                    estimate.load_ratio,
                    estimate.area_ratio
                )
            },
        ),
    ];
    if let Some(stress) = stress {
        let (mises, shear) = (stress.largest.von_mises, stress.largest.orthogonal_shear);
        lines.push(format!(
            "stress     von Mises {:.4} GPa at {:.2} um, orthogonal shear {:.4} GPa at {:.2} um",
            mises.stress * 1e-9,
            mises.depth * 1e6,
            shear.stress * 1e-9,
            shear.depth * 1e6
        ));
    }
    lines.join("\n")
}
