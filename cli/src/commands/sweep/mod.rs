//! `stribeck sweep`: one scene under all combinations of some of its values.

mod axes;
mod folder;
mod seeds;

use std::error::Error;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};
use stribeck::sim::{MixedLubricationSim, SimError};

use self::axes::{Axis, Input};
use self::folder::Folder;
use crate::interrupt;
use crate::output::{self, Outcome};

/// Each point is kept in the folder once it is solved; points that are kept are not solved again. Ctrl-C ends the
/// sweep after the points at hand.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Scene file
    scene: PathBuf,
    /// Key of the scene and its values, "load.force=10N,20N" or "load.force=1N..100N:20"; values
    /// of a range are evenly spread over their logarithms, evenly where an end is not positive
    #[arg(long, required = true, value_name = "KEY=VALUES", value_parser = Axis::parse)]
    over: Vec<Axis>,
    /// Values of the keys side by side, in place of all combinations
    #[arg(long)]
    zip: bool,
    /// Contacts that are solved at the same time [default: the number of processors]
    #[arg(long, value_parser = |text: &str| output::count::<usize>("--jobs", text, 1..=4096))]
    jobs: Option<usize>,
    /// Only the points I, I + N, ..., for arrays of jobs with one folder
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<(usize, usize)>,
    /// Folder of the sweep
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
    /// Print one JSON object in SI units on standard output
    #[arg(long)]
    json: bool,
}

/// `i/n` with i below n.
fn shard(text: &str) -> Result<(usize, usize), String> {
    let parsed = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    parsed.filter(|(i, n)| i < n).ok_or_else(|| format!("--shard {text}: must be I/N with I from 0 to N - 1"))
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let scene = output::load(&options.scene)?;
    if let Some(remark) = output::without_cycle(&scene, "sweep") {
        output::complain("warning", &remark);
    }
    let inputs = axes::points(&scene, &options.over, options.zip)?;
    let folder = Folder::open(&options.out, &scene, &inputs)?;
    interrupt::listen("the sweep ends after the points at hand")?;
    let (first, step) = options.shard.unwrap_or((0, 1));
    let todo: Vec<usize> =
        (first..inputs.len()).step_by(step).filter(|k| folder.kept(*k).is_none()).collect();
    solve(options, &folder, &inputs, &todo)?;
    let done: Vec<(usize, Value)> = (0..inputs.len()).filter_map(|k| Some((k, folder.kept(k)?))).collect();
    let table = folder.write_table(&inputs, &done)?;
    let surfaces = seeds::groups(&options.over, &inputs, &done);
    if options.json {
        let points: Vec<Value> = done.iter().map(|(k, result)| with_inputs(&inputs[*k], result)).collect();
        let surfaces: Vec<Value> = surfaces.iter().map(seeds::Group::to_json).collect();
        output::print(&json!({ "points": points, "seeds": surfaces, "version": env!("CARGO_PKG_VERSION") }))?;
    } else {
        let failed = done.iter().filter(|(_, result)| result["status"] != "converged").count();
        output::print(&format!("points     {} of {} done, {failed} failed", done.len(), inputs.len()))?;
        seeds::table(&surfaces).iter().try_for_each(|line| output::print(line))?;
    }
    output::report_files(&[table], options.json)?;
    let mut mine = done.iter().filter(|(k, _)| k % step == first);
    let missing = mine.clone().count() < (first..inputs.len()).step_by(step).count();
    if missing {
        output::complain("error", "interrupted; the same command goes on with the points that are left");
    }
    let converged = mine.all(|(_, result)| result["status"] == "converged");
    Ok(if converged && !missing { Outcome::Converged } else { Outcome::NotConverged })
}

/// Solves the points `todo` on threads and keeps each.
fn solve(options: &Options, folder: &Folder, inputs: &[Input], todo: &[usize]) -> Result<(), Box<dyn Error>> {
    let style = ProgressStyle::with_template("{wide_bar} {pos} of {len} points, {eta} left")?;
    let bar = ProgressBar::new(todo.len() as u64).with_style(style);
    let next = AtomicUsize::new(0);
    let fault: Mutex<Option<String>> = Mutex::new(None);
    let work = || {
        while let Some(k) = todo.get(next.fetch_add(1, Ordering::Relaxed)) {
            let result = solved(&inputs[*k]);
            let kept = result.map_or(Ok(()), |result| folder.keep(*k, &result));
            bar.inc(1);
            if let Err(error) = kept {
                *fault.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
                next.store(todo.len(), Ordering::Relaxed);
            }
            if interrupt::is_requested() {
                next.store(todo.len(), Ordering::Relaxed);
            }
        }
    };
    let processors = || thread::available_parallelism().map_or(1, usize::from);
    let jobs = options.jobs.unwrap_or_else(processors).min(todo.len());
    thread::scope(|scope| (0..jobs).for_each(|_| drop(scope.spawn(work))));
    bar.finish_and_clear();
    match fault.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(error) => Err(error.into()),
        None => Ok(()),
    }
}

/// The numbers of a point with its status, or its error; nothing after an interruption.
fn solved(input: &Input) -> Option<Value> {
    let builder = MixedLubricationSim::builder(input.scene.clone()).interrupt(interrupt::is_requested);
    match builder.solve() {
        Ok(solution) => match serde_json::to_value(&solution) {
            Ok(values) => Some(json!({ "status": values["status"], "error": null, "values": values })),
            Err(error) => Some(refused(&error)),
        },
        Err(SimError::Interrupted) => None,
        Err(error) => Some(refused(&error)),
    }
}

fn refused(error: &dyn Error) -> Value {
    json!({ "status": "refused", "error": error.to_string(), "values": {} })
}

/// The result with the inputs of its point.
fn with_inputs(input: &Input, result: &Value) -> Value {
    let inputs: serde_json::Map<String, Value> = input.values.iter().cloned().collect();
    let mut object = json!({ "inputs": inputs });
    for part in ["status", "error", "values"] {
        object[part] = result[part].clone();
    }
    object
}
