//! One history: its run, its folder, and reading that back.

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use stribeck::sim::{MixedLubricationSim, Observer, RunEnd, RunFolder, SimError, StepRecord};

use crate::case_run::Run;
use crate::options::Options;
use crate::statements::{History, PARTS, bearing_heights, film_profile};

/// Why a history ended early.
const NOTE: &str = "failed.txt";
/// Steps from one checkpoint to the next.
const EVERY: u64 = 10;
/// Positions of the roughness that a history may pass over because they were not solved: each costs as much
/// as tens of steps, and what is left is a selection.
const MOST_PASSED_OVER: u32 = 20;

/// Whether `run` has ended, early or not: its fields are written last.
pub(crate) fn has_ended(run: &Run, options: &Options) -> bool {
    run.folder(options).join("fields.npz").exists()
}

/// Whether `run` has taken all of its steps.
pub(crate) fn is_complete(run: &Run, options: &Options) -> bool {
    has_ended(run, options) && !run.folder(options).join(NOTE).exists()
}

/// Writes the folder of the run, and the bearing curve of the disc at the end of each part, before the
/// checkpoint that could stand there.
struct Writer<'a> {
    folder: RunFolder,
    path: &'a Path,
    steps: u64,
    passed_over: u32,
    failure: Option<String>,
}

impl Observer for Writer<'_> {
    fn after_step(&mut self, sim: &MixedLubricationSim, record: &StepRecord) -> ControlFlow<()> {
        let ends = |part: &usize| *part as u64 * self.steps / PARTS as u64 == sim.steps();
        let curve = (1..=PARTS).find(ends).map(|part| bearing_file(self.path, part));
        let written = curve.map_or(Ok(()), |file| write_bearing(sim, sim.bodies()[1].surface(), &file));
        if let Err(error) = written {
            self.failure = Some(error);
            return ControlFlow::Break(());
        }
        self.passed_over += record.attempts - 1;
        if self.passed_over > MOST_PASSED_OVER {
            self.failure = Some(format!("{} positions of the roughness were passed over", self.passed_over));
            return ControlFlow::Break(());
        }
        self.folder.after_step(sim, record)
    }
}

/// Runs one history, from its last checkpoint on if there is one; a line on how it went.
///
/// # Errors
/// A file that cannot be written. A history that ends early is noted in its folder and in the line.
pub(crate) fn run(run: &Run, options: &Options) -> Result<String, String> {
    let start = Instant::now();
    let path = run.folder(options);
    let text = |error: SimError| error.to_string();
    let mut sim = run.build().map_err(text)?;
    let (folder, records) = RunFolder::resume(&path, &mut sim, EVERY).map_err(text)?;
    write_bearing(&sim, sim.bodies()[1].initial(), &bearing_file(&path, 0))?;
    let passed_over = records.iter().map(|record| record.attempts - 1).sum();
    let mut writer = Writer { folder, path: &path, steps: run.case.steps, passed_over, failure: None };
    let left = run.case.steps.saturating_sub(sim.steps());
    let failure = match sim.run(left, run.time_step, &mut writer) {
        Ok(RunEnd::Finished) => None,
        // Where the folder stopped the run its own error follows below.
        Ok(RunEnd::Stopped) => writer.failure,
        Err(error) => Some(error.to_string()),
    };
    let note = path.join(NOTE);
    if let Some(reason) = &failure {
        fs::write(&note, reason).map_err(|error| format!("{}: {error}", note.display()))?;
    }
    writer.folder.finish(&sim).map_err(text)?;
    let outcome = failure.map_or_else(String::new, |reason| format!(", ended early: {reason}"));
    Ok(format!("{left} steps in {:.0} s{outcome}", start.elapsed().as_secs_f64()))
}

fn bearing_file(path: &Path, part: usize) -> PathBuf {
    path.join(format!("bearing{part}.csv"))
}

/// A height a line, at even shares of the area.
fn write_bearing(sim: &MixedLubricationSim, heights: &[f64], file: &Path) -> Result<(), String> {
    let heights = bearing_heights(sim, heights).map_err(|error| error.to_string())?;
    let text: String = heights.iter().map(|height| format!("{height:e}\n")).collect();
    fs::write(file, text).map_err(|error| format!("{}: {error}", file.display()))
}

/// Reads a complete history.
pub(crate) fn read(run: &Run, options: &Options) -> Result<History, String> {
    let path = run.folder(options);
    let mut sim = run.build().map_err(|error| error.to_string())?;
    let (_, records) =
        RunFolder::resume(&path, &mut sim, EVERY).map_err(|error| format!("{}: {error}", path.display()))?;
    let curve = |part| Ok::<_, String>((part, read_numbers(&bearing_file(&path, part))?));
    let bearing = (0..=PARTS).map(curve).collect::<Result<_, _>>()?;
    Ok(History { records, profile: film_profile(&sim, &sim.state().film), bearing })
}

fn read_numbers(file: &Path) -> Result<Vec<f64>, String> {
    let text = fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let numbers = text.lines().map(|line| line.parse().map_err(|_| format!("{}: `{line}`", file.display())));
    numbers.collect()
}
