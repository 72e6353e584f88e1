//! The curve of a rigid bearing: its table, picture and report.

use std::error::Error;
use std::fs::File;
use std::io::Write as _;
use std::path::PathBuf;

use serde_json::{Value, json};
use stribeck::Status;
use stribeck::sim::{BearingNumbers, BearingSolution, Warning};

use super::axis::Axis;
use super::row::mark;
use super::{Options, bearing_chart};
use crate::output::{self, Outcome};
use crate::report::Report;
use crate::{files, picture};

/// Name of a column and its number.
type Column = (&'static str, fn(&BearingNumbers) -> f64);

/// Columns of the table behind the quantity that the curve is over.
const COLUMNS: [Column; 9] = [
    ("load_N", |numbers| numbers.load),
    ("eccentricity", |numbers| numbers.eccentricity.unwrap_or(f64::NAN)),
    ("least_film_m", |numbers| numbers.least_film),
    ("pressure_max_Pa", |numbers| numbers.pressure_max),
    ("friction_N", |numbers| numbers.friction_moving),
    ("friction_coefficient", |numbers| numbers.friction_coefficient),
    ("power_loss_W", |numbers| numbers.power_loss),
    ("side_flow_m3_s", |numbers| numbers.side_flow),
    ("temperature_K", |numbers| numbers.temperature),
];

/// Further columns of rough surfaces.
const ROUGH_COLUMNS: [Column; 3] = [
    ("contact_share", |numbers| numbers.contact_share.unwrap_or(f64::NAN)),
    ("contact_friction_N", |numbers| numbers.contact_friction.unwrap_or(f64::NAN)),
    ("film_over_rq", |numbers| numbers.film_over_rq.unwrap_or(f64::NAN)),
];

/// The curve as far as it is solved.
pub(super) struct Curve<'a> {
    options: &'a Options,
    path: PathBuf,
    file: File,
    columns: Vec<&'static Column>,
    is_rough: bool,
    is_wide: bool,
    points: Vec<(f64, BearingNumbers)>,
    /// Fields of the warnings that were printed.
    said: Vec<String>,
    warnings: Vec<String>,
    /// Status of the first point that was left out.
    pub(super) left_out: Option<Status>,
    pub(super) is_interrupted: bool,
}

impl<'a> Curve<'a> {
    /// Opens the table and checks that picture and report can be written; a wide pad has forces, flows and powers per metre.
    pub(super) fn begin(
        options: &'a Options,
        [is_rough, is_wide]: [bool; 2],
        name: &str,
    ) -> Result<Self, Box<dyn Error>> {
        let out = &options.output.out;
        options.report.claim(&options.scene, options.output.force)?;
        let path = out.join(format!("{name}.csv"));
        let mut targets = vec![path.clone()];
        if options.output.plot {
            targets.extend(picture::files(out, name));
        }
        files::make_folder(out)?;
        files::claim(&targets, options.output.force, output::OTHER_FOLDER)?;
        let mut file = File::create(&path).map_err(|error| files::named(&path, &error))?;
        let over = options.over.column(is_wide);
        let rough = ROUGH_COLUMNS.iter().filter(|_| is_rough);
        let columns: Vec<_> = COLUMNS
            .iter()
            .chain(rough)
            .filter(|(name, _)| options.over != Axis::Load || *name != "load_N")
            .collect();
        let per = if is_wide { "_per_m" } else { "" };
        let name_of = |(name, _): &&Column| match *name {
            "load_N" | "friction_N" | "contact_friction_N" | "power_loss_W" | "side_flow_m3_s" => {
                format!("{name}{per}")
            }
            name => name.to_owned(),
        };
        let names = columns.iter().map(name_of);
        writeln!(file, "{}", [over.to_owned()].into_iter().chain(names).collect::<Vec<_>>().join(","))?;
        let (points, said, warnings) = (Vec::new(), Vec::new(), Vec::new());
        let (left_out, is_interrupted) = (None, false);
        Ok(Self {
            options,
            path,
            file,
            columns,
            is_rough,
            is_wide,
            points,
            said,
            warnings,
            left_out,
            is_interrupted,
        })
    }

    /// Prints the point and appends it to the table.
    pub(super) fn add(&mut self, value: f64, solution: &BearingSolution) -> Result<(), Box<dyn Error>> {
        let numbers = &solution.numbers;
        let cells = self.columns.iter().map(|(_, number)| number(numbers));
        let cells: Vec<String> = [value].into_iter().chain(cells).map(cell).collect();
        writeln!(self.file, "{}", cells.join(","))?;
        if !self.options.output.json {
            if self.points.is_empty() {
                output::print(&header(self.options.over, [self.is_rough, self.is_wide]))?;
            }
            let warned: Vec<String> = solution.warnings.iter().map(|warning| warning.field.clone()).collect();
            output::print(&(line(self.options.over, value, numbers) + &mark(&warned)))?;
        }
        self.points.push((value, *numbers));
        Ok(())
    }

    /// Prints the warnings at the point `words` about fields that no earlier one was about.
    pub(super) fn warn_once(&mut self, words: &str, warnings: &[Warning]) {
        for warning in warnings {
            if !self.said.contains(&warning.field) {
                self.warn(format!("at {words}: {warning}"));
                self.said.push(warning.field.clone());
            }
        }
    }

    /// Prints a warning and keeps it for the report.
    pub(super) fn warn(&mut self, text: String) {
        output::complain("warning", &text);
        self.warnings.push(text);
    }

    /// Writes picture and report and prints the JSON.
    ///
    /// # Errors
    /// A curve without a point, whose table is removed.
    pub(super) fn finish(&self, name: &str) -> Result<Outcome, Box<dyn Error>> {
        if self.points.is_empty() {
            files::remove(&self.path);
            return Err("no point of the curve was solved".into());
        }
        let Options { scene, over, output: to, report, .. } = self.options;
        let point = |(value, numbers): &(f64, BearingNumbers)| {
            let mut numbers = serde_json::to_value(numbers)?;
            numbers["over"] = (*value).into();
            Ok(numbers)
        };
        let points = self.points.iter().map(point).collect::<Result<Vec<Value>, serde_json::Error>>()?;
        let numbers = json!({ "over": over.column(self.is_wide), "points": points, "version": env!("CARGO_PKG_VERSION") });
        let chart = bearing_chart::chart(scene, (*over, self.is_wide), &self.points);
        let mut written = vec![self.path.clone()];
        if to.plot {
            written.extend(picture::write(&chart, &to.out, name)?);
        }
        if let Some(path) = &report.report {
            let mut report = Report::new(
                scene,
                over.title().trim_end_matches(" of"),
                self.left_out.unwrap_or(Status::Converged),
            )?;
            if self.is_interrupted {
                report.end_early("interrupted");
            }
            report.warn(self.warnings.iter().cloned());
            report.table(&bearing_chart::table((*over, self.is_wide), &numbers));
            report.chart(&chart)?;
            report.write(path)?;
            written.push(path.clone());
        }
        if to.json {
            output::print(&numbers)?;
        }
        output::report_files(&written, to.json)?;
        let is_whole = self.left_out.is_none() && !self.is_interrupted;
        Ok(if is_whole { Outcome::Converged } else { Outcome::NotConverged })
    }
}

/// A number of the table; nothing for NaN.
fn cell(number: f64) -> String {
    if number.is_nan() { String::new() } else { format!("{number:e}") }
}

fn header(over: Axis, [is_rough, is_wide]: [bool; 2]) -> String {
    let [load, power] = if is_wide { ["load, N/m", "power, W/m"] } else { ["load, N", "power, W"] };
    let solids = if is_rough { "   solids, %" } else { "" };
    format!(
        "{:>11} {:>12} {:>12} {:>10} {:>10} {:>12} {:>10}{solids}",
        over.heading(is_wide),
        if over == Axis::Load { "p max, MPa" } else { load },
        "film, um",
        "friction",
        power,
        "sides, ml/s",
        "oil, degC"
    )
}

fn line(over: Axis, value: f64, numbers: &BearingNumbers) -> String {
    let solids = numbers.contact_share.map_or_else(String::new, |share| format!(" {:11.3}", 100.0 * share));
    format!(
        "{} {:>12} {:12.4} {:10.5} {:10.4} {:12.4} {:10.2}{solids}",
        over.cell(value),
        output::digits(if over == Axis::Load { 1e-6 * numbers.pressure_max } else { numbers.load }),
        1e6 * numbers.least_film,
        numbers.friction_coefficient,
        numbers.power_loss,
        1e6 * numbers.side_flow,
        numbers.temperature - 273.15
    )
}
