//! `stribeck run`: the history of a contact.

use std::error::Error;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use stribeck::reynolds::ContactState;
use stribeck::sim::{
    HistoryMeans, MixedLubricationSim, Observer, RunFolder, Schedule, SimError, StepControl, StepRecord,
};
use stribeck::units::Dimension;

use super::contact_pictures::{Seen, maps};
use crate::output::{self, Held, Outcome};
use crate::picture::{self, BLUE, Chart, GREEN, Line, Panel, VERMILION, XScale};
use crate::{files, interrupt};

/// Steps of a history whose time alone is known.
const STEPS: u64 = 100;
/// Relative difference of times that rounding explains.
const ROUNDING: f64 = 1e-9;

/// Numbers are means over the last tenth of the steps.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Scene file
    scene: PathBuf,
    /// Number of steps, not counting those that end at an entry of a schedule [default: what the time needs, or 100]
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
    /// Write pictures of the history and of the last contact as SVG and PNG
    #[arg(long)]
    plot: bool,
}

/// What is kept of a history while it runs.
struct Log {
    bar: ProgressBar,
    steps: u64,
    means: HistoryMeans,
    folder: Option<RunFolder>,
    csv: Option<(PathBuf, BufWriter<File>)>,
    failure: Option<String>,
    /// For the pictures.
    records: Vec<StepRecord>,
    last: Option<ContactState>,
    plot: bool,
}

/// Time at which a history ends \[s\] and length of its steps \[s\].
struct Plan {
    end: f64,
    time_step: f64,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    if let Some(path) = &options.csv {
        output::keep_scene(&options.scene, path)?;
    }
    let scene = output::load(&options.scene)?;
    let (held, bar) = (Held::default(), ProgressBar::new(0));
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
    let longest = log.records.iter().map(|record| record.time_step).reduce(f64::max);
    if let Some(before) = longest.filter(|before| (before / plan.time_step - 1.0).abs() > ROUNDING) {
        let text =
            format!("the run has taken steps of {before} s, it goes on with steps of {} s", plan.time_step);
        output::complain("warning", &text);
    }
    interrupt::listen("the run ends after this step")?;
    let outcome = sim.run_until(plan.end, &StepControl::fixed(plan.time_step), &mut log);
    log.bar.finish_and_clear();
    if outcome.is_ok() {
        held.print(&log.bar);
    }
    let files = log.finish(options, &sim)?;
    output::warn(sim.warnings().iter().skip(known));
    let status = match outcome {
        Ok(_) if plan.end - sim.time() > ROUNDING * plan.time_step => {
            output::complain("error", &interrupted(options, &sim, &plan));
            Outcome::NotConverged
        }
        Ok(_) => Outcome::Converged,
        Err(error @ SimError::NotConverged { .. }) => {
            output::complain("error", &error.to_string());
            Outcome::NotConverged
        }
        Err(error) => return Err(output::in_scene(&options.scene, &error).into()),
    };
    if status == Outcome::Converged {
        let mut numbers = serde_json::to_value(log.means.numbers(&sim))?;
        numbers["seconds"] = start.elapsed().as_secs_f64().into();
        if options.json { output::print(&numbers)? } else { output::print(&log.means)? }
    }
    output::report_files(&files, options.json)?;
    Ok(status)
}

/// End and length of the steps.
fn plan(options: &Options, sim: &MixedLubricationSim) -> Result<Plan, String> {
    let time = options.duration.or_else(|| last_entry(sim));
    let (end, time_step) = match (options.steps, options.time_step, time) {
        (Some(_), Some(_), _) if options.duration.is_some() => {
            return Err("--duration, --steps and --time-step say it twice; give two of them".to_owned());
        }
        (Some(steps), Some(time_step), _) => (steps as f64 * time_step, time_step),
        (Some(steps), None, Some(time)) => (time, time / steps as f64),
        (None, Some(time_step), Some(time)) => (time, time_step.min(time)),
        (None, None, Some(time)) => (time, time / STEPS as f64),
        (.., None) => {
            return Err(
                "how long? No schedule of the scene ends; give --steps and --time-step, or --duration"
                    .to_owned(),
            );
        }
    };
    output::require(end > 0.0, "duration", end, "finite and > 0").map_err(|error| error.to_string())?;
    Ok(Plan { end, time_step })
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
    if let Some(folder) = options.out.as_ref().filter(|_| !options.resume && !options.force) {
        if ["history.csv", "checkpoint"].iter().any(|file| folder.join(file).exists()) {
            let name = folder.display();
            return Err(format!("{name}: there is a run; --resume goes on with it, --force writes over it"));
        }
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

/// The last time that a schedule of the scene names \[s\].
fn last_entry(sim: &MixedLubricationSim) -> Option<f64> {
    let schedules = &sim.scene().schedule;
    let given = [
        &schedules.load,
        &schedules.entrainment_speed,
        &schedules.slide_roll_ratio,
        &schedules.bulk_temperature,
    ];
    let last = given.into_iter().flatten().filter_map(|schedule| match schedule {
        Schedule::Steps { times, .. } | Schedule::Ramps { times, .. } => times.last().copied(),
        // Constants have no end, and tables were read when the simulation was built.
        _ => None,
    });
    last.max_by(f64::total_cmp).filter(|time| *time > 0.0)
}

impl Log {
    fn new(
        options: &Options,
        sim: &mut MixedLubricationSim,
        plan: &Plan,
        bar: ProgressBar,
    ) -> Result<Self, Box<dyn Error>> {
        let all = sim.steps_until(plan.end, plan.time_step);
        let every = options.checkpoint_every.unwrap_or_else(|| all.div_ceil(20));
        let (folder, records) = match &options.out {
            Some(path) if options.resume => {
                let (folder, records) = RunFolder::resume(path, sim, every)?;
                if sim.time() > plan.end + ROUNDING * plan.time_step {
                    let (folder, time, end) = (path.display(), sim.time(), plan.end);
                    return Err(format!(
                        "{folder}: the run has reached {time} s, more than the {end} s asked for; give a later end, or begin again \
                         with --force in place of --resume"
                    )
                    .into());
                }
                (Some(folder), records)
            }
            Some(path) => (Some(RunFolder::create(path, sim, every)?), Vec::new()),
            None => (None, Vec::new()),
        };
        let steps = sim.steps() + sim.steps_until(plan.end, plan.time_step);
        let mut means = HistoryMeans::new(steps);
        records.iter().for_each(|record| means.see(record));
        let csv = options.csv.as_ref().map(|path| -> Result<_, String> {
            let named = |error: io::Error| files::named(path, &error);
            let mut csv = BufWriter::new(File::create(path).map_err(named)?);
            let written = writeln!(csv, "{}", StepRecord::csv_header()).and_then(|()| csv.flush());
            written.map_err(named).inspect_err(|_| files::remove(path))?;
            Ok((path.clone(), csv))
        });
        let last = folder.as_ref().and_then(|folder| folder.last_contact().cloned());
        bar.set_style(ProgressStyle::with_template("{wide_bar} {pos} of {len} steps, {eta} left{msg}")?);
        bar.set_length(steps);
        bar.set_position(sim.steps());
        bar.reset_eta();
        let csv = csv.transpose()?;
        Ok(Self { bar, steps, means, folder, csv, failure: None, records, last, plot: options.plot })
    }

    /// Ends all files, also those of a run that failed; the files that were written.
    fn finish(
        &mut self,
        options: &Options,
        sim: &MixedLubricationSim,
    ) -> Result<Vec<PathBuf>, Box<dyn Error>> {
        let mut files = Vec::new();
        if let Some(folder) = self.folder.take() {
            folder.finish(sim)?;
            files.extend(options.out.clone());
        }
        if let Some(failure) = self.failure.take() {
            return Err(failure.into());
        }
        files.extend(options.csv.clone());
        if self.plot && !self.records.is_empty() {
            files.extend(self.pictures(options, sim)?);
        }
        Ok(files)
    }

    fn pictures(&self, options: &Options, sim: &MixedLubricationSim) -> Result<Vec<PathBuf>, Box<dyn Error>> {
        let (name, out) = (output::stem(&options.scene), picture_folder(options));
        let chart = history(&name, &self.records);
        let mut files = picture::write(&chart, out, &format!("{name}_history"))?.to_vec();
        if let Some(state) = self.last.as_ref().filter(|_| sim.grid().ny() > 1) {
            let film = sim.scene().tribofilm.map(|_| sim.bodies()[1].tribofilm());
            let time = self.records.last().map_or(0.0, |record| record.time);
            let seen = Seen {
                title: format!("{name} after {time:.0} s"),
                grid: sim.grid(),
                hertz: sim.hertz(),
                state,
                lubricated: sim.scene().is_lubricated(),
                tribofilm: film,
            };
            files.extend(picture::write(&maps(&seen), out, &format!("{name}_maps"))?);
        }
        Ok(files)
    }
}

impl Observer for Log {
    fn after_step(&mut self, sim: &MixedLubricationSim, record: &StepRecord) -> ControlFlow<()> {
        let done = record.step + 1;
        self.bar.set_message(format!(", friction {:.4}", record.friction.coefficient));
        self.bar.set_position(done);
        // Without a terminal a line after each tenth of the steps.
        if self.bar.is_hidden() && (done.is_multiple_of(self.steps.div_ceil(10)) || done == self.steps) {
            let line = format!("{done} of {} steps, {:.1} s of the test", self.steps, record.time);
            let _ = writeln!(io::stderr(), "{line}");
        }
        self.means.see(record);
        if self.plot {
            self.records.push(record.clone());
            self.last.get_or_insert_with(|| sim.state().clone()).clone_from(sim.state());
        }
        if let Some((path, csv)) = &mut self.csv {
            if let Err(error) = record.write_csv(csv).and_then(|()| csv.flush()) {
                self.failure = Some(files::named(path, &error));
                return ControlFlow::Break(());
            }
        }
        let flow =
            self.folder.as_mut().map_or(ControlFlow::Continue(()), |folder| folder.after_step(sim, record));
        if interrupt::is_requested() { ControlFlow::Break(()) } else { flow }
    }
}

/// Friction, share of the load on solids, film over roughness, wear and tribofilm over time.
fn history(name: &str, records: &[StepRecord]) -> Chart {
    let line = |name, colour, value: fn(&StepRecord) -> f64| Line {
        name,
        colour,
        points: records.iter().map(|record| (record.time, value(record))).collect(),
        bands: Vec::new(),
    };
    let panel = |y_label: &str, lines| Panel { y_label: y_label.to_owned(), lines, highest: None };
    let mut panels = vec![
        panel("friction", vec![line("", BLUE, |r| r.friction.coefficient)]),
        panel("load on solids", vec![line("", BLUE, |r| r.contact.load_ratio)]),
        panel("film / Rq", vec![line("", BLUE, |r| r.film.lambda.unwrap_or(f64::NAN))]),
    ];
    let grows =
        |value: fn(&StepRecord) -> [f64; 2]| records.iter().any(|r| value(r).iter().any(|v| *v > 0.0));
    if grows(|r| r.wear.in_contact()) {
        let lines = vec![
            line("ball", VERMILION, |r| 1e9 * r.wear.ball_in_contact),
            line("disc", GREEN, |r| 1e9 * r.wear.disc_in_contact),
        ];
        panels.push(panel("worn (nm)", lines));
    }
    if grows(|r| r.tribofilm.in_contact()) {
        let lines = vec![
            line("ball", VERMILION, |r| 1e9 * r.tribofilm.ball_in_contact),
            line("disc", GREEN, |r| 1e9 * r.tribofilm.disc_in_contact),
        ];
        panels.push(panel("tribofilm (nm)", lines));
    }
    Chart { title: format!("{name}: history"), x_label: "time (s)", x_scale: XScale::Linear, panels }
}
