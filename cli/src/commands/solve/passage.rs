//! `stribeck solve` of a contact whose roughness moves: means over a passage, its contacts as a table, frames and a picture.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};
use stribeck::Status;
use stribeck::sim::scene::Scene;
use stribeck::sim::{MixedLubricationSim, PassageNumbers, PassageSolution, Scatter, StepRecord};

use super::{Options, write_fields};
use crate::output::{self, Held, Outcome};
use crate::picture::{self, BLUE, Chart, Line, Panel, Scale};
use crate::report::{self, ErrorOf, Number, Report};
use crate::{files, interrupt};

/// Decimals of a frame's number in its file name.
const DIGITS: usize = 4;

/// A line of the report: name, unit, factor to it, decimals, the quantity, and its value in a contact.
type Quantity =
    (&'static str, &'static str, f64, usize, fn(&PassageNumbers) -> Scatter, fn(&StepRecord) -> f64);

const QUANTITIES: [Quantity; 5] = [
    ("mean film", "nm", 1e9, 2, |n| n.film_mean_central, |r| r.film.mean_central),
    ("least film", "nm", 1e9, 2, |n| n.film_minimum, |r| r.film.minimum),
    ("pressure", "GPa", 1e-9, 4, |n| n.pressure_max, |r| r.pressure.max),
    ("on solids", "", 1.0, 4, |n| n.contact_load_ratio, |r| r.contact.load_ratio),
    ("friction", "", 1.0, 5, |n| n.friction_coefficient, |r| r.friction.coefficient),
];

/// Solves the passage of `scene`, whose roughness moves.
pub(super) fn run(options: &Options, scene: Scene, start: Instant) -> Result<Outcome, Box<dyn Error>> {
    if options.fields.is_some() {
        return Err("--fields: a passage has many contacts; --frames writes some of them".into());
    }
    let (held, checked) = (Held::default(), MixedLubricationSim::builder(scene.clone()).check_passage());
    let (known, contacts) = checked.map_err(|error| output::in_scene(&options.scene, &error))?;
    held.hold_warnings(&known);
    let name = output::stem(&options.scene);
    claim(options, &name)?;
    interrupt::listen("the passage ends after this contact and keeps those before it")?;
    let bar = ProgressBar::new(contacts as u64);
    bar.set_style(ProgressStyle::with_template("{wide_bar} {pos} of {len} contacts, {eta} left")?);
    let above = bar.clone();
    let builder = MixedLubricationSim::builder(scene).interrupt(move || {
        held.print(&above);
        false
    });
    let mut frames = Frames::new(options, &name);
    let solved = builder.solve_passage(&mut |sim: &MixedLubricationSim, _: &StepRecord| {
        bar.inc(1);
        let done = bar.position() as usize;
        // Without a terminal a line after each tenth of the contacts.
        if bar.is_hidden() && done.is_multiple_of(contacts.div_ceil(10)) {
            let passed = output::time(start.elapsed().as_secs_f64());
            output::complain("passage", &format!("{done} of {contacts} contacts, {passed}"));
        }
        frames.keep(sim);
        if interrupt::is_requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    bar.finish_and_clear();
    let solution = solved.map_err(|error| output::in_scene(&options.scene, &error))?;
    let written = frames.write(&solution)?;
    output::warn(solution.warnings.iter().filter(|warning| !known.contains(warning)));
    finish(options, &name, &solution, written, start.elapsed().as_secs_f64())
}

/// Writes the other files of a solved passage, prints its numbers and the files `written`.
fn finish(
    options: &Options,
    name: &str,
    solution: &PassageSolution,
    mut written: Vec<PathBuf>,
    seconds: f64,
) -> Result<Outcome, Box<dyn Error>> {
    if let Some(path) = &options.csv {
        files::write(path, table(solution)?.as_bytes())?;
        written.push(path.clone());
    }
    if options.output.plot {
        written.extend(picture::write(
            &chart(name, solution),
            &options.output.out,
            &format!("{name}_passage"),
        )?);
    }
    let numbers = json!({
        "means": solution.means,
        "time_step": solution.time_step,
        "start_up": solution.start_up,
        "contacts": solution.passage().len(),
        "hertz": solution.hertz,
        "warnings": solution.warnings,
        "ended_early": solution.ended_early,
        "seconds": seconds,
        "version": env!("CARGO_PKG_VERSION"),
    });
    if let Some(path) = &options.report.report {
        write_report(options, solution, &numbers, path)?;
        written.push(path.clone());
    }
    if options.output.json {
        output::print(&numbers)?;
    } else if !solution.passage().is_empty() {
        output::print(&format!("{}\ntime       {seconds:.2} s", report(solution)))?;
    }
    output::report_files(&written, options.output.json)?;
    if let Some(reason) = &solution.ended_early {
        output::complain(
            "error",
            &format!("the passage ended after {} contacts: {reason}", solution.records.len()),
        );
        return Ok(Outcome::NotConverged);
    }
    Ok(Outcome::Converged)
}

/// Checks before the first contact that all files can be written.
fn claim(options: &Options, name: &str) -> Result<(), String> {
    let (out, force) = (&options.output.out, options.output.force);
    if let Some(path) = &options.csv {
        output::keep_scene(&options.scene, path)?;
        files::claim(std::slice::from_ref(path), force, output::OTHER_NAME)?;
    }
    let mut targets: Vec<PathBuf> = Vec::new();
    if options.output.plot {
        targets.extend(picture::files(out, &format!("{name}_passage")));
    }
    targets.extend((0..options.frames.unwrap_or(0)).map(|k| out.join(frame_name(name, k))));
    if !targets.is_empty() {
        files::make_folder(out)?;
        files::claim(&targets, force, output::OTHER_FOLDER)?;
    }
    Ok(())
}

/// File name of the frame `number`.
fn frame_name(name: &str, number: usize) -> String {
    format!("{name}_frame_{number:0DIGITS$}.npz")
}

/// Films and pressures of contacts.
type Fields = [Vec<f64>; 3];

/// Evenly spread contacts of the passage.
struct Frames<'a> {
    options: &'a Options,
    name: &'a str,
    count: usize,
    /// Contacts so far, with the number of each.
    kept: Vec<(usize, Fields)>,
    seen: usize,
    /// Contacts between two that are kept; it doubles when there are twice as many as needed.
    every: usize,
}

impl<'a> Frames<'a> {
    fn new(options: &'a Options, name: &'a str) -> Self {
        Self { options, name, count: options.frames.unwrap_or(0), kept: Vec::new(), seen: 0, every: 1 }
    }

    /// Keeps the last contact of `sim`, if it is one of those to keep.
    fn keep(&mut self, sim: &MixedLubricationSim) {
        if self.count > 0 && self.seen.is_multiple_of(self.every) {
            let state = sim.state();
            let fields = [&state.film, &state.pressure, &state.fluid_pressure].map(Clone::clone);
            self.kept.push((self.seen, fields));
            // Eight times as many as needed: the start-up is among them.
            if self.kept.len() > 16 * self.count {
                self.every *= 2;
                self.kept.retain(|(number, _)| number.is_multiple_of(self.every));
            }
        }
        self.seen += 1;
    }

    /// Writes the contacts nearest to `count` even parts of the passage; the files.
    fn write(&self, solution: &PassageSolution) -> Result<Vec<PathBuf>, Box<dyn Error>> {
        let [first, last] = [solution.start_up, solution.records.len()];
        let mut written = Vec::new();
        for k in 0..self.count.min(last.saturating_sub(first)) {
            let place = first + (2 * k + 1) * (last - first) / (2 * self.count);
            let nearest = self.kept.iter().min_by_key(|(number, _)| number.abs_diff(place));
            let Some((_, [film, pressure, fluid])) = nearest else { continue };
            let path = self.options.output.out.join(frame_name(self.name, k));
            write_fields(
                &path,
                &solution.grid,
                &[("film", film), ("pressure", pressure), ("fluid_pressure", fluid)],
            )?;
            written.push(path);
        }
        Ok(written)
    }
}

/// All contacts, with a first column that is 1 in the passage and 0 in the start-up.
fn table(solution: &PassageSolution) -> Result<String, Box<dyn Error>> {
    let mut text = format!("in_passage,{}\n", StepRecord::csv_header());
    for (index, record) in solution.records.iter().enumerate() {
        let mut line = Vec::new();
        record.write_csv(&mut line)?;
        text.push_str(if index < solution.start_up { "0," } else { "1," });
        text.push_str(&String::from_utf8(line)?);
    }
    Ok(text)
}

/// Means, scatter and range in lines.
fn report(solution: &PassageSolution) -> String {
    let mut lines = vec![format!(
        "passage    {} contacts after {} of the start-up, one cell of the faster surface each, {:.3e} s",
        solution.passage().len(),
        solution.start_up,
        solution.time_step
    )];
    lines.extend(QUANTITIES.map(|(name, unit, factor, decimals, scatter, _)| {
        let Scatter { mean, standard_deviation, minimum, maximum, .. } = scatter(&solution.means);
        let number = |value: f64| format!("{:.decimals$}", factor * value);
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        format!(
            "{name:<10} {} +- {}{unit}, from {} to {}",
            number(mean),
            number(standard_deviation),
            number(minimum),
            number(maximum)
        )
    }));
    lines.join("\n")
}

const fn scatter(
    name: &'static str,
    unit: &'static str,
    factor: f64,
    [key, deviation]: [&'static str; 2],
) -> Number<'static> {
    Number { name, key, unit, factor, offset: 0.0, error: ErrorOf::Absolute(deviation) }
}

const fn plain(name: &'static str, key: &'static str) -> Number<'static> {
    Number { name, key, unit: "", factor: 1.0, offset: 0.0, error: ErrorOf::None }
}

/// Means with their standard deviation over the contacts.
const NUMBERS: [Number<'static>; 8] = [
    scatter(
        "Mean film",
        "nm",
        1e9,
        ["means.film_mean_central.mean", "means.film_mean_central.standard_deviation"],
    ),
    scatter("Least film", "nm", 1e9, ["means.film_minimum.mean", "means.film_minimum.standard_deviation"]),
    scatter(
        "Largest pressure",
        "GPa",
        1e-9,
        ["means.pressure_max.mean", "means.pressure_max.standard_deviation"],
    ),
    scatter(
        "Load on solids",
        "",
        1.0,
        ["means.contact_load_ratio.mean", "means.contact_load_ratio.standard_deviation"],
    ),
    scatter(
        "Friction coefficient",
        "",
        1.0,
        ["means.friction_coefficient.mean", "means.friction_coefficient.standard_deviation"],
    ),
    plain("Contacts", "contacts"),
    plain("Contacts of the start-up", "start_up"),
    Number {
        name: "Hertz pressure",
        key: "hertz.pressure",
        unit: "GPa",
        factor: 1e-9,
        offset: 0.0,
        error: ErrorOf::None,
    },
];

fn write_report(
    options: &Options,
    solution: &PassageSolution,
    numbers: &Value,
    path: &Path,
) -> Result<(), Box<dyn Error>> {
    let mut report = Report::new(&options.scene, "passage", Status::Converged)?;
    report.warn(solution.warnings.iter().map(ToString::to_string));
    if let Some(reason) = &solution.ended_early {
        report.end_early(reason);
    }
    report.table(&report::list(numbers, &NUMBERS));
    report.chart(&chart(&output::stem(&options.scene), solution))?;
    report.write(path)
}

/// The quantities over time.
fn chart(name: &str, solution: &PassageSolution) -> Chart {
    let panels = QUANTITIES.map(|(label, unit, factor, _, _, value)| {
        let points =
            solution.records.iter().map(|record| (1e6 * record.time, factor * value(record))).collect();
        let line = Line { name: "", colour: BLUE, points, bands: Vec::new() };
        let y_label = if unit.is_empty() { label.to_owned() } else { format!("{label} ({unit})") };
        Panel::new(y_label, vec![line])
    });
    Chart {
        title: format!("Passage of {name}"),
        x_label: "time (µs)",
        x_scale: Scale::Linear,
        upper: None,
        panels: panels.into(),
    }
}
