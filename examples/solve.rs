//! Solves one quasi-static contact that a scene file describes (`docs/scene.md`).
//!
//! ```text
//! cargo run --release --example solve -- SCENE.toml [--json] [--fields OUT.npz]
//! ```
//!
//! Ends with 0 when the solve converged, 2 when it did not, 1 for bad input, with one line on standard error;
//! warnings stand there too, a line each.

use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use serde_json::Value;
use stribeck::Status;
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
    let text = if arguments.json { to_json(&solution, seconds)?.to_string() } else { solution.to_string() };
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
    write_npz(path, &solution.grid, &solution.fields())?;
    Ok(())
}

/// Everything in SI units; a number that is not finite becomes null.
fn to_json(solution: &ContactSolution, seconds: f64) -> Result<Value, Box<dyn Error>> {
    let mut numbers = serde_json::to_value(solution)?;
    numbers["seconds"] = seconds.into();
    Ok(numbers)
}
