//! `stribeck curve`: friction over speed, slide-roll ratio, load or temperature.

mod axis;
mod bearing;
mod bearing_chart;
mod bearing_table;
mod chart;
mod model;
mod report;
mod row;
mod solve;
mod speeds;
mod surfaces;

use std::error::Error;
use std::fs::File;
use std::io::Write as _;
use std::path::PathBuf;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};
use stribeck::Status;
use stribeck::sim::scene::{GridSpec, Scene};
use stribeck::sim::{Conditions, ContactSolution, SceneFile, SimError, SingleContact};

use self::axis::Axis;
use self::model::{ModelChoice, Plan};
use self::row::{Columns, Row};
use crate::output::{self, Held, Outcome, Output, ReportFile};
use crate::{files, interrupt, picture};

/// Number of values.
const POINTS: u32 = 13;
/// Largest number of surfaces.
const MOST_SURFACES: u64 = 1000;

/// The oil, the surfaces and all other conditions are those of the scene. Each contact is printed and written to a
/// table (csv) once it is solved; Ctrl-C ends the curve and keeps them. A rigid bearing (table `given_film`) has curves over speed, load
/// and temperature.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Scene file
    scene: PathBuf,
    /// Quantity that the curve is over
    #[arg(long, value_enum, default_value_t = Axis::Speed)]
    over: Axis,
    /// Lowest value, "0.001" or "1 mm/s" [default: the speed of a film of 0.03 Rq by formula, of smooth bodies and bearings a tenth of
    /// that of the scene; a tenth of the load, ratio 0, 40 degC]
    #[arg(long, allow_hyphen_values = true)]
    from: Option<String>,
    /// Highest value [default: the speed of a film of 3 Rq, at most 10 m/s or ten times that of the scene; of smooth bodies and bearings
    /// ten times that; the load, ratio 0.5, 100 degC]
    #[arg(long, allow_hyphen_values = true)]
    to: Option<String>,
    /// Number of values; speeds and loads are evenly spread over their logarithms
    #[arg(
        long, default_value_t = POINTS, allow_hyphen_values = true,
        value_parser = |text: &str| output::count::<u32>("--points", text, 2..=1000)
    )]
    points: u32,
    /// Number of random surfaces: rows are their means, with the standard deviation of a surface; 1 for that of the scene
    /// [default: 4 for a strip without grid.y, else 1]
    #[arg(
        long, allow_hyphen_values = true,
        value_parser = |text: &str| output::count::<u32>("--seeds", text, 1..=MOST_SURFACES)
    )]
    seeds: Option<u32>,
    /// Model of the mixed contacts
    #[arg(long, value_enum, default_value_t = ModelChoice::Auto)]
    model: ModelChoice,
    /// Number of values at which the resolved model is solved beside asperity inlets
    #[arg(
        long, allow_hyphen_values = true,
        value_parser = |text: &str| output::count::<u32>("--resolve", text, 1..=1000)
    )]
    resolve: Option<u32>,
    #[command(flatten)]
    report: ReportFile,
    #[command(flatten)]
    output: Output,
}

/// A solved contact of the curve.
struct Point {
    conditions: Conditions,
    surface: usize,
    solution: ContactSolution,
}

/// The curve as far as it is solved.
struct Curve<'a> {
    options: &'a Options,
    scene: Scene,
    columns: Columns,
    csv: (PathBuf, File),
    bar: ProgressBar,
    rows: Vec<Row>,
    /// Rows of the resolved model beside the curve.
    resolved: Vec<Row>,
    /// Status and numbers of each contact; their fields are not kept.
    contacts: Vec<(Status, Value)>,
    plan: Plan,
    /// The contact of each surface by asperity inlets, once it was solved.
    by_inlets: Vec<Option<SingleContact>>,
    /// The folder of the table was made for it.
    made_folder: bool,
    /// Fields of the warnings that were printed.
    said: Vec<String>,
    /// The warnings.
    warnings: Vec<String>,
    /// All contacts so far were solved or have a status.
    is_complete: bool,
    /// The remark that a mixed contact is one sample is still to be made.
    remarks: bool,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    let scene = match output::load_any(&options.scene)? {
        SceneFile::Bearing(bearing) => return bearing::run(options, *bearing),
        file => output::contact(&options.scene, file)?,
    };
    let start_conditions = axis::start(options, &scene)?;
    let values = axis::values(options, &scene, &start_conditions)?;
    let scenes =
        surfaces::scenes(&scene, options.seeds).map_err(|error| output::in_scene(&options.scene, &error))?;
    let is_sample = scenes.len() > 1;
    options.report.claim(&options.scene, options.output.force)?;
    let name = format!("{}_{}", output::stem(&options.scene), options.over.file_ending());
    let solves = values.len() * scenes.len();
    let held = announced(options, &scene, &start_conditions, [values.len(), scenes.len()])
        .map_err(|error| output::in_scene(&options.scene, &error))?;
    let mut curve = Curve::begin(options, &scene, &name, (solves, is_sample))?;
    curve.warnings = held.warnings();
    interrupt::listen("the curve ends here and keeps its finished contacts")?;
    let ended = curve.solve(&scenes, (start_conditions, &values), &held);
    curve.bar.finish_and_clear();
    if curve.rows.is_empty() {
        // A table without a row is no result, nor is a folder without a file.
        files::remove(&curve.csv.0);
        if curve.made_folder {
            files::remove_empty(&options.output.out);
        }
    }
    let is_whole = ended?;
    let written = curve.finish(&name, is_whole, start)?;
    output::report_files(&written, options.output.json)?;
    if !is_whole {
        let (done, all, values) = (curve.rows.len(), values.len(), options.over.values());
        let rest = if done > 0 {
            "; --from with another --out goes on behind them"
        } else {
            ": none was finished, nothing is written"
        };
        output::complain("error", &format!("interrupted after {done} of {all} {values}{rest}"));
    }
    let all = curve.contacts.iter().all(|(status, _)| *status == Status::Converged);
    Ok(if is_whole && all && curve.is_complete { Outcome::Converged } else { Outcome::NotConverged })
}

/// Lines about the scene and about the work ahead, which are printed when the first solve begins.
fn announced(
    options: &Options,
    scene: &Scene,
    conditions: &Conditions,
    [values, count]: [usize; 2],
) -> Result<Held, SimError> {
    let held = Held::default();
    let [megabytes, most] = [scene.first_memory()?, scene.memory()?].map(|bytes| 1e-6 * bytes);
    let finer = if most > megabytes {
        format!(", at most {most:.0} MB where cells are halved")
    } else {
        String::new()
    };
    let (solves, together) = (values * count, surfaces::at_once(count));
    let at_once = if together > 1 { format!(", {together} at once") } else { String::new() };
    held.hold(
        "needs",
        format!("{solves} solves{at_once}, each with about {:.0} MB of memory{finer}", megabytes.max(1.0)),
    );
    if options.over != Axis::SlideRollRatio && conditions.motion.slide_roll_ratio == 0.0 {
        held.hold("warning", "the slide-roll ratio is 0: without sliding there is no friction".to_owned());
    }
    if let Some(remark) = output::without_cycle(scene, "curve") {
        held.hold("warning", remark);
    }
    held.hold_warnings(&scene.warnings());
    Ok(held)
}

impl<'a> Curve<'a> {
    /// Opens the table and checks that the pictures can be written.
    fn begin(
        options: &'a Options,
        scene: &Scene,
        name: &str,
        (solves, is_sample): (usize, bool),
    ) -> Result<Self, Box<dyn Error>> {
        let out = &options.output.out;
        let path = out.join(format!("{name}.csv"));
        let mut targets = vec![path.clone()];
        if options.output.plot {
            targets.extend(picture::files(out, name));
        }
        let made_folder = !out.exists();
        files::make_folder(out)?;
        files::claim(&targets, options.output.force, output::OTHER_FOLDER)?;
        let has_errors = scene.solver.estimate
            || scene.solver.accuracy.is_some()
            || matches!(scene.grid, GridSpec::Accuracy { .. });
        let (over, line) = (options.over, scene.form.is_line());
        let columns = Columns { over, line, errors: has_errors, spread: is_sample };
        let file = File::create(&path).map_err(|error| files::named(&path, &error))?;
        let style = "{wide_bar} {pos} of {len} solves, {eta} left";
        let bar = ProgressBar::new(solves as u64).with_style(ProgressStyle::with_template(style)?);
        let said = scene.warnings().into_iter().map(|warning| warning.field).collect();
        let remarks = !is_sample && options.seeds.is_none() && surfaces::is_random(scene);
        let (csv, rows, resolved, contacts) = ((path, file), Vec::new(), Vec::new(), Vec::new());
        let (plan, by_inlets) = (Plan::new(options.model, scene), Vec::new());
        let is_complete = true;
        let mut curve = Self {
            options,
            scene: scene.clone(),
            columns,
            csv,
            bar,
            rows,
            resolved,
            contacts,
            plan,
            by_inlets,
            made_folder,
            said,
            warnings: Vec::new(),
            remarks,
            is_complete,
        };
        curve.write_line(&row::csv_header(columns)).inspect_err(|_| files::remove(&curve.csv.0))?;
        Ok(curve)
    }

    /// Appends a line to the table; on an error no part of it is left.
    fn write_line(&mut self, line: &str) -> Result<(), String> {
        let (path, file) = &mut self.csv;
        let before = file.metadata().map_or(0, |found| found.len());
        // One write, without a buffer: the line is in the file when it returns.
        file.write_all(format!("{line}\n").as_bytes()).map_err(|error| {
            // The first error is the one to report.
            drop(file.set_len(before));
            files::named(path, &error)
        })
    }

    /// Prints a warning and keeps it for the report.
    fn warn(&mut self, text: String) {
        self.bar.suspend(|| output::complain("warning", &text));
        self.warnings.push(text);
    }

    /// Writes the pictures and prints the JSON; the files that were written.
    fn finish(&self, name: &str, is_whole: bool, start: Instant) -> Result<Vec<PathBuf>, Box<dyn Error>> {
        let mut written = Vec::new();
        if !self.rows.is_empty() {
            written.push(self.csv.0.clone());
            if self.options.output.plot {
                let chart = chart::chart(&output::stem(&self.options.scene), self);
                written.extend(picture::write(&chart, &self.options.output.out, name)?);
            }
        }
        if !self.contacts.is_empty() {
            let numbers = self.to_json(start.elapsed().as_secs_f64());
            if let Some(path) = self.options.report.report.as_ref().filter(|_| !self.rows.is_empty()) {
                report::write(self, (&numbers, is_whole), path)?;
                written.push(path.clone());
            }
            if self.options.output.json {
                output::print(&numbers)?;
            }
        }
        Ok(written)
    }

    /// Each contact under the names of `solve`, with its conditions, and the rows of the table.
    fn to_json(&self, seconds: f64) -> Value {
        let contacts: Vec<_> = self.contacts.iter().map(|(_, numbers)| numbers).collect();
        let rows = self.rows.iter().chain(&self.resolved);
        let rows: Vec<_> = rows.map(|row| row.to_json(self.columns)).collect();
        json!({
            "points": contacts, "curve": rows, "seconds": seconds, "version": env!("CARGO_PKG_VERSION"),
        })
    }
}

impl Point {
    /// The numbers of the contact under the names of `solve`, with its conditions; with its surface if there are several.
    fn to_json(&self, has_surfaces: bool) -> Result<Value, serde_json::Error> {
        let mut numbers = serde_json::to_value(&self.solution)?;
        numbers["motion"] = serde_json::to_value(self.conditions.motion)?;
        numbers["load"] = self.conditions.load.into();
        numbers["bulk_temperature"] = self.conditions.bulk_temperature.into();
        if has_surfaces {
            numbers["surface"] = self.surface.into();
        }
        Ok(numbers)
    }
}
