//! Output of a history while it runs: progress bar, means, files and pictures.

use std::error::Error;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::Value;
use stribeck::Status;
use stribeck::reynolds::ContactState;
use stribeck::sim::{ErrorEstimate, HistoryMeans, MixedLubricationSim, Observer, RunFolder, StepRecord};

use super::plan::Plan;
use super::{Options, ROUNDING, picture_folder};
use crate::commands::contact_pictures::{Seen, maps};
use crate::picture::{self, BLUE, Chart, GREEN, Line, Panel, Scale, VERMILION, extremes};
use crate::report::{self, Fields, Report};
use crate::{files, interrupt, output};

/// Output of a history while it runs.
pub(super) struct Log {
    pub(super) bar: ProgressBar,
    steps: u64,
    folder: Option<RunFolder>,
    csv: Option<(PathBuf, BufWriter<File>)>,
    failure: Option<String>,
    pub(super) records: Vec<StepRecord>,
    last: Option<ContactState>,
    plot: bool,
    is_line: bool,
    /// Fields of the contacts so far, for the report.
    fields: Option<Fields>,
}

impl Log {
    pub(super) fn new(
        options: &Options,
        sim: &mut MixedLubricationSim,
        plan: &Plan,
        bar: ProgressBar,
    ) -> Result<Self, Box<dyn Error>> {
        let all = sim.steps_until(plan.end, plan.time_step);
        let every = options.checkpoint_every.unwrap_or_else(|| all.div_ceil(20));
        let (folder, records) = match &options.out {
            Some(path) if options.resume => {
                let (folder, records) = RunFolder::resume(path, sim, every).map_err(output::plain)?;
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
            Some(path) => (Some(RunFolder::create(path, sim, every).map_err(output::plain)?), Vec::new()),
            None => (None, Vec::new()),
        };
        let steps = sim.steps() + sim.steps_until(plan.end, plan.time_step);
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
        let fields = options.report.report.as_ref().map(|_| Fields::many());
        Ok(Self {
            bar,
            steps,
            folder,
            csv,
            failure: None,
            records,
            last,
            plot: options.plot,
            is_line: sim.scene().form.is_line(),
            fields,
        })
    }

    /// Means over the last tenth of the steps so far.
    pub(super) fn means(&self) -> HistoryMeans {
        let means = HistoryMeans::new(self.records.last().map_or(0, |record| record.step + 1));
        let mut means = if self.is_line { means.of_line() } else { means };
        self.records.iter().for_each(|record| means.see(record));
        means
    }

    /// Ends all files, also those of a run that failed; the files that were written.
    pub(super) fn finish(
        &mut self,
        options: &Options,
        sim: &MixedLubricationSim,
    ) -> Result<Vec<PathBuf>, Box<dyn Error>> {
        let mut files = Vec::new();
        if let Some(folder) = self.folder.take() {
            folder.finish(sim).map_err(output::plain)?;
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
            let seen = seen(&name, sim, state, self.records.last());
            files.extend(picture::write(&maps(&seen), out, &format!("{name}_maps"))?);
        }
        Ok(files)
    }

    /// Writes the report, if one is asked for, with the `numbers` of the JSON object.
    pub(super) fn write_report(
        &self,
        options: &Options,
        sim: &MixedLubricationSim,
        (numbers, ended_early): (&Value, Option<&str>),
    ) -> Result<Option<PathBuf>, Box<dyn Error>> {
        let (Some(path), Some(fields)) = (&options.report.report, &self.fields) else { return Ok(None) };
        if self.records.is_empty() {
            return Ok(None);
        }
        let mut report = Report::new(&options.scene, "history", Status::Converged)?;
        report.warn(sim.warnings().iter().map(ToString::to_string));
        if let Some(reason) = ended_early {
            report.end_early(reason);
        }
        let name = output::stem(&options.scene);
        report.table("<p>Means over the last tenth of the steps.</p>");
        report.table(&report::contact(numbers, sim.scene().is_lubricated(), sim.scene().form.is_line()));
        report.chart(&history(&name, &self.records))?;
        let seen = self.last.as_ref().map(|state| seen(&name, sim, state, self.records.last()));
        let last = seen.as_ref().filter(|_| sim.grid().ny() > 1).map(maps);
        report.maps(last.as_ref(), fields)?;
        report.write(path)?;
        Ok(Some(path.clone()))
    }
}

impl Observer for Log {
    fn after_step(&mut self, sim: &MixedLubricationSim, record: &StepRecord) -> ControlFlow<()> {
        let done = record.step + 1;
        self.bar.set_message(format!(", friction {:.4}", record.friction.coefficient));
        self.bar.set_position(done);
        // Without a terminal a line after each tenth of the steps.
        if self.bar.is_hidden() && (done.is_multiple_of(self.steps.div_ceil(10)) || done == self.steps) {
            let line = format!("{done} of {} steps, {} of the test", self.steps, output::time(record.time));
            let _ = writeln!(io::stderr(), "{line}");
        }
        self.records.push(record.clone());
        if let Some(fields) = &mut self.fields {
            let seen = seen("", sim, sim.state(), Some(record));
            fields.keep(&maps(&seen), &seen.title);
        }
        if self.plot || self.fields.is_some() {
            self.last.get_or_insert_with(|| sim.state().clone()).clone_from(sim.state());
        }
        if let Some((path, csv)) = &mut self.csv
            && let Err(error) = record.write_csv(csv).and_then(|()| csv.flush())
        {
            self.failure = Some(files::named(path, &error));
            return ControlFlow::Break(());
        }
        let flow =
            self.folder.as_mut().map_or(ControlFlow::Continue(()), |folder| folder.after_step(sim, record));
        if interrupt::is_requested() { ControlFlow::Break(()) } else { flow }
    }
}

/// The contact of `sim` in the `state` after `record`.
fn seen<'a>(
    name: &str,
    sim: &'a MixedLubricationSim,
    state: &'a ContactState,
    record: Option<&StepRecord>,
) -> Seen<'a> {
    let time = record.map_or(0.0, |record| record.time);
    let after = if time < 10.0 { output::time(time) } else { format!("{time:.0} s") };
    Seen {
        title: format!("{name} after {after}").trim_start().to_owned(),
        grid: sim.grid(),
        hertz: sim.hertz(),
        state,
        lubricated: sim.scene().is_lubricated(),
        tribofilm: sim.scene().tribofilm.map(|_| sim.bodies()[1].tribofilm()),
    }
}

/// The `line` of `records` with a band where their errors are estimated: `error` is absolute, of an estimate and a value.
fn with_band(records: &[StepRecord], mut line: Line, error: fn(&ErrorEstimate, f64) -> f64) -> Line {
    let band = |(record, (time, value)): (&StepRecord, &(f64, f64))| {
        let error = error(record.error_estimate.as_ref()?, *value);
        Some((*time, [value - error, value + error]))
    };
    line.bands = records.iter().zip(&line.points).filter_map(band).collect();
    line
}

/// Steps of a running mean.
const MEAN_STEPS: usize = 25;

/// The mean of the first of the `lines` over steps around each, where it has many.
fn running_mean(lines: &[Line]) -> Option<Line> {
    let points = &lines.first()?.points;
    let (low, high) = extremes(points.iter().map(|point| point.1));
    // A line that is level but for rounding is its own mean.
    if points.len() < 4 * MEAN_STEPS || high - low <= 1e-6 * high.abs() {
        return None;
    }
    let means = points.windows(MEAN_STEPS).map(|window| {
        let mean = window.iter().map(|point| point.1).sum::<f64>() / window.len() as f64;
        (window[MEAN_STEPS / 2].0, mean)
    });
    Some(Line { name: "mean of 25 steps", colour: VERMILION, points: means.collect(), bands: Vec::new() })
}

/// Friction, share of the load on solids, mean film, film over roughness, wear and tribofilm over time.
fn history(name: &str, records: &[StepRecord]) -> Chart {
    let line = |name, colour, value: fn(&StepRecord) -> f64| Line {
        name,
        colour,
        points: records.iter().map(|record| (record.time, value(record))).collect(),
        bands: Vec::new(),
    };
    let panel = |y_label: &str, lines| Panel::new(y_label, lines);
    let mut panels = vec![
        panel(
            "friction",
            vec![with_band(records, line("", BLUE, |r| r.friction.coefficient), |error, value| {
                error.friction_coefficient * value
            })],
        ),
        panel(
            "load on solids",
            vec![with_band(records, line("", BLUE, |r| r.contact.load_ratio), |error, _| {
                error.contact_load_ratio
            })],
        ),
        panel(
            "film / Rq",
            vec![with_band(
                records,
                line("", BLUE, |r| r.film.lambda.unwrap_or(f64::NAN)),
                |error, value| error.film_mean_central * value,
            )],
        ),
    ];
    let film = with_band(records, line("", BLUE, |r| 1e9 * r.film.mean_central), |error, value| {
        error.film_mean_central * value
    });
    panels.insert(2, panel("mean film (nm)", vec![film]));
    panels.iter_mut().for_each(|panel| panel.lines.extend(running_mean(&panel.lines)));
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
    Chart {
        title: format!("{name}: history"),
        x_label: "time (s)",
        x_scale: Scale::Linear,
        panels,
        upper: None,
    }
}
