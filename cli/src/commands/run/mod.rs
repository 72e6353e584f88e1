//! `stribeck run`: the history of a contact.

mod log;
mod plan;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use indicatif::ProgressBar;
use stribeck::sim::{MixedLubricationSim, RunFolder, SimError, StepControl, StepRecord};
use stribeck::units::Dimension;
use stribeck::wear::WearPressure;

use self::log::Log;
use self::plan::{Plan, plan};
use crate::output::{self, Held, Outcome, ReportFile};
use crate::{files, interrupt, picture};

/// Relative difference of times that rounding explains.
const ROUNDING: f64 = 1e-9;

/// Numbers are means over the last tenth of the steps.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Scene file
    scene: PathBuf,
    /// Number of steps, not counting those that end at an entry of a schedule [default: as many as the time needs, or 100]
    #[arg(long, allow_hyphen_values = true, value_parser = |text: &str| output::count::<u64>("--steps", text, 1..=u64::MAX))]
    steps: Option<u64>,
    /// Length of a step, "10" or "10 s"; the last one ends at the time [default: an equal share of the time]
    #[arg(long, allow_hyphen_values = true, value_parser = |text: &str| output::positive(Dimension::Time, "--time-step", text))]
    time_step: Option<f64>,
    /// Time of the history, "7200" or "2 h" [default: the last entry of the schedules]
    #[arg(long, allow_hyphen_values = true, value_parser = |text: &str| output::positive(Dimension::Time, "--duration", text))]
    duration: Option<f64>,
    /// Folder of the run: scene, history, checkpoint, fields and pictures
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Go on from the checkpoint in the folder of the run, up to the same or a later time
    #[arg(long, requires = "out")]
    resume: bool,
    /// Write over files that exist, and over the run that is in the folder
    #[arg(long, conflicts_with = "resume")]
    force: bool,
    /// Steps between checkpoints [default: a twentieth of the steps]
    #[arg(
        long, requires = "out", allow_hyphen_values = true,
        value_parser = |text: &str| output::count::<u64>("--checkpoint-every", text, 1..=u64::MAX)
    )]
    checkpoint_every: Option<u64>,
    /// Write a row for each step as comma-separated values
    #[arg(long, value_name = "OUT.csv", conflicts_with = "resume")]
    csv: Option<PathBuf>,
    /// Print one JSON object in SI units on standard output
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    report: ReportFile,
    /// Write pictures of the history and of the last contact as SVG and PNG
    #[arg(long)]
    plot: bool,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    if let Some(path) = &options.csv {
        output::keep_scene(&options.scene, path)?;
    }
    options.report.claim(&options.scene, options.force || options.resume)?;
    let scene = output::load(&options.scene)?;
    let (held, bar) = (Held::default(), ProgressBar::new(0));
    if let Some(remark) = output::without_cycle(&scene, "run") {
        held.hold("warning", remark);
    }
    let (due, above) = (held.clone(), bar.clone());
    let builder = MixedLubricationSim::builder(scene).interrupt(move || {
        due.print(&above);
        false
    });
    let mut sim = builder.build().map_err(|error| output::in_scene(&options.scene, &error))?;
    held.hold_warnings(sim.warnings());
    output::announce_memory(sim.scene(), &held)?;
    let known = sim.warnings().len();
    let plan = plan(options, &sim)?;
    claim(options, &sim)?;
    let mut log = Log::new(options, &mut sim, &plan, bar)?;
    announce_resume(options, &sim, &plan, &log);
    interrupt::listen("the run ends after this step")?;
    let first = sim.steps();
    let outcome = sim.run_until(plan.end, &StepControl::fixed(plan.time_step), &mut log);
    log.bar.finish_and_clear();
    if outcome.is_ok() {
        held.print(&log.bar);
    }
    let mut files = log.finish(options, &sim)?;
    output::warn(sim.warnings().iter().skip(known));
    let end = match outcome {
        Ok(_) if plan.end - sim.time() > ROUNDING * plan.time_step => Some(interrupted(options, &sim, &plan)),
        Ok(_) => None,
        Err(error @ (SimError::NotConverged { .. } | SimError::BoxTooSmall(_))) => Some(error.to_string()),
        // A law or a file ended a history that had begun: its steps are kept.
        Err(error) if sim.steps() > first => {
            let (steps, time) = (sim.steps(), sim.time());
            Some(format!("{}, after {steps} steps, at {time} s", output::in_scene(&options.scene, &error)))
        }
        Err(error) => return Err(output::in_scene(&options.scene, &error).into()),
    };
    if let Some(reason) = &end {
        output::complain("error", reason);
    }
    let mut numbers = serde_json::to_value(log.means().numbers(&sim))?;
    numbers["seconds"] = start.elapsed().as_secs_f64().into();
    if let Some(reason) = &end {
        numbers["ended_early"] = reason.as_str().into();
    }
    files.extend(log.write_report(options, &sim, (&numbers, end.as_deref()))?);
    if options.json && !(end.is_some() && log.records.is_empty()) {
        output::print(&numbers)?;
    } else if end.is_none() {
        output::print(&format!("{}{}", log.means(), wear_without_contact(&sim, &log.records)))?;
    }
    output::report_files(&files, options.json)?;
    Ok(if end.is_none() { Outcome::Converged } else { Outcome::NotConverged })
}

/// The line about a scene with wear whose solids touched at no step; empty for others.
fn wear_without_contact(sim: &MixedLubricationSim, records: &[StepRecord]) -> &'static str {
    let Some(wear) = sim.scene().wear else { return "" };
    if records.iter().any(|record| record.contact.load_ratio > 0.0) {
        return "";
    }
    match wear.pressure {
        WearPressure::Total => {
            "\nwear by the pressure of the fluid (wear.pressure = \"total\"): solids touched at no step"
        }
        _ => "\nno wear: solids touched at no step",
    }
}

/// Says where a run goes on that `--resume` asks for, where that is not as its command line reads.
fn announce_resume(options: &Options, sim: &MixedLubricationSim, plan: &Plan, log: &Log) {
    let Some(folder) = options.out.as_ref().filter(|_| options.resume) else { return };
    let name = folder.display();
    if sim.steps() == 0 {
        return output::complain(
            "warning",
            &format!("{name}: there is no run to go on with; a new one begins"),
        );
    }
    if plan.end - sim.time() <= ROUNDING * plan.time_step {
        let (end, steps) = (plan.end, sim.steps());
        let text = format!(
            "{name}: the run is at its end already, {end} s after {steps} steps; a later --duration goes on"
        );
        return output::complain("warning", &text);
    }
    let longest = log.records.iter().map(|record| record.time_step).reduce(f64::max);
    if let Some(before) = longest.filter(|before| (before / plan.time_step - 1.0).abs() > ROUNDING) {
        let step = plan.time_step;
        let text = format!("the run has taken steps of {before} s, it goes on with steps of {step} s");
        output::complain("warning", &text);
    }
}

/// The remaining part of a run that was interrupted, and how it goes on.
fn interrupted(options: &Options, sim: &MixedLubricationSim, plan: &Plan) -> String {
    let rest = match &options.out {
        Some(folder) => {
            format!("the same command with --resume goes on from the checkpoint in {}", folder.display())
        }
        None => "with --out FOLDER it would have left a checkpoint".to_owned(),
    };
    format!("interrupted after {} steps, at {} s of {} s; {rest}", sim.steps(), sim.time(), plan.end)
}

/// Checks before the first step that all files can be written. A run that goes on replaces its own.
fn claim(options: &Options, sim: &MixedLubricationSim) -> Result<(), String> {
    let run = |folder: &PathBuf| RunFolder::FILES.map(|file| folder.join(file));
    let of_run = || options.out.iter().flat_map(run);
    if let Some(folder) = options.out.as_ref().filter(|_| !options.resume && !options.force)
        && ["history.csv", "checkpoint"].iter().any(|file| folder.join(file).exists())
    {
        let name = folder.display();
        return Err(format!("{name}: there is a run; --resume goes on with it, --force writes over it"));
    }
    if let Some(folder) = &options.out {
        output::keep_scene(&options.scene, &folder.join("scene.toml"))?;
        files::make_folder(folder)?;
    }
    let mut targets: Vec<PathBuf> = of_run().collect();
    if options.plot {
        let (out, name) = (picture_folder(options), output::stem(&options.scene));
        targets.extend(picture::files(out, &format!("{name}_history")));
        if sim.grid().ny() > 1 {
            targets.extend(picture::files(out, &format!("{name}_maps")));
        }
    }
    targets.extend(options.csv.clone());
    let elsewhere = if options.out.is_some() { output::OTHER_FOLDER } else { output::OTHER_NAME };
    files::claim(&targets, options.force || options.resume, elsewhere)
}

/// Where pictures go.
fn picture_folder(options: &Options) -> &Path {
    options.out.as_deref().unwrap_or(Path::new("."))
}
