//! Runs the history that a scene file describes (`docs/scene.md`) and prints what it ends with.
//!
//! ```text
//! cargo run --release --example history -- SCENE.toml --steps N --time-step S [--json] [--csv OUT.csv]
//! ```
//!
//! Numbers are means over the last tenth of the steps. Ends with 0 when all steps were taken, 2 when a
//! contact did not converge, 1 for bad input, with one line on standard error; warnings and progress go there
//! too.

use std::error::Error;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use stribeck::InputError;
use stribeck::sim::{HistoryMeans, MixedLubricationSim, Scene, SimError, StepRecord, Warning};

const USAGE: &str = "usage: history SCENE.toml --steps N --time-step S [--json] [--csv OUT.csv]";
const NOT_CONVERGED: u8 = 2;

struct Arguments {
    scene: PathBuf,
    steps: u64,
    time_step: f64,
    json: bool,
    csv: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let line = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
            // Nobody is left to be told when standard error is closed.
            let _ = writeln!(io::stderr(), "error: {line}");
            match error.downcast_ref::<SimError>() {
                Some(SimError::NotConverged { .. }) => ExitCode::from(NOT_CONVERGED),
                _ => ExitCode::FAILURE,
            }
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let Some(arguments) = parse_arguments()? else {
        writeln!(io::stdout(), "{USAGE}")?;
        return Ok(());
    };
    let start = Instant::now();
    let scene = Scene::load(&arguments.scene).map_err(|e| in_scene(&arguments.scene, &e))?;
    let mut sim = MixedLubricationSim::builder(scene).build().map_err(|e| in_scene(&arguments.scene, &e))?;
    warn(sim.warnings());
    let known = sim.warnings().len();
    let mut means = HistoryMeans::new(arguments.steps);
    let mut csv = arguments.csv.as_deref().map(csv_file).transpose()?;
    let mut failure = None;
    let outcome =
        sim.run(arguments.steps, arguments.time_step, &mut |_: &MixedLubricationSim, record: &StepRecord| {
            progress(record, arguments.steps);
            means.see(record);
            if let Err(error) = write_row(csv.as_mut(), record) {
                failure = Some(error);
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
    warn(&sim.warnings()[known..]);
    // The rows of a run that ends early are those of its steps.
    if let Some(mut csv) = csv {
        csv.flush()?;
    }
    outcome?;
    if let Some(error) = failure {
        return Err(error);
    }
    let mut numbers = serde_json::to_value(means.numbers(&sim))?;
    numbers["seconds"] = start.elapsed().as_secs_f64().into();
    let text = if arguments.json { numbers.to_string() } else { means.to_string() };
    writeln!(io::stdout(), "{text}")?;
    Ok(())
}

/// A line each on standard error.
fn warn(warnings: &[Warning]) {
    for warning in warnings {
        let _ = writeln!(io::stderr(), "warning: {warning}");
    }
}

fn parse_arguments() -> Result<Option<Arguments>, Box<dyn Error>> {
    use lexopt::prelude::*;
    let mut parser = lexopt::Parser::from_env();
    let (mut scene, mut steps, mut time_step, mut json, mut csv) = (None, None, None, false, None);
    while let Some(argument) = parser.next()? {
        match argument {
            Long("steps") => steps = Some(parser.value()?.parse::<u64>()?),
            Long("time-step") => time_step = Some(parser.value()?.parse::<f64>()?),
            Long("json") => json = true,
            Long("csv") => csv = Some(PathBuf::from(parser.value()?)),
            Long("help") | Short('h') => return Ok(None),
            Value(path) if scene.is_none() => scene = Some(PathBuf::from(path)),
            other => return Err(format!("{}; {USAGE}", other.unexpected()).into()),
        }
    }
    let missing = |what: &str| format!("{what}; {USAGE}");
    let scene = scene.ok_or_else(|| missing("no scene file is given"))?;
    let steps = steps.ok_or_else(|| missing("--steps is missing"))?;
    let time_step = time_step.ok_or_else(|| missing("--time-step is missing"))?;
    let refused =
        |field: &str, value, requirement| InputError::Value { field: field.to_owned(), value, requirement };
    if steps == 0 {
        return Err(refused("--steps", 0.0, "at least 1").into());
    }
    if !time_step.is_finite() || time_step <= 0.0 {
        return Err(refused("--time-step", time_step, "finite and > 0").into());
    }
    Ok(Some(Arguments { scene, steps, time_step, json, csv }))
}

/// The error with the scene file in front, unless it already names it.
fn in_scene(path: &Path, error: &dyn Error) -> String {
    let (name, text) = (path.display().to_string(), error.to_string());
    if text.starts_with(&name) { text } else { format!("{name}: {text}") }
}

fn csv_file(path: &Path) -> Result<BufWriter<File>, Box<dyn Error>> {
    let file = File::create(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut csv = BufWriter::new(file);
    writeln!(csv, "{}", StepRecord::csv_header())?;
    Ok(csv)
}

fn write_row(csv: Option<&mut BufWriter<File>>, record: &StepRecord) -> Result<(), Box<dyn Error>> {
    if let Some(csv) = csv {
        record.write_csv(csv)?;
    }
    Ok(())
}

/// A line after each tenth of the steps.
fn progress(record: &StepRecord, steps: u64) {
    let done = record.step + 1;
    if done.is_multiple_of(steps.div_ceil(10)) || done == steps {
        let _ = writeln!(io::stderr(), "{done} of {steps} steps, {:.1} s of the test", record.time);
    }
}
