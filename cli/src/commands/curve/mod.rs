//! `stribeck curve`: friction over speed, slide-roll ratio, load or temperature.

mod axis;
mod bearing;
mod chart;
mod model;
mod report;
mod row;
mod surfaces;

use std::error::Error;
use std::fs::File;
use std::io::Write as _;
use std::path::PathBuf;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};
use stribeck::Status;
use stribeck::sim::scene::{GridSpec, Scene, SolverModel};
use stribeck::sim::{Conditions, ContactSolution, MixedLubricationSim, SceneFile, SimError};

use self::axis::Axis;
use self::model::{ModelChoice, Plan, Starts, resolved_values};
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
    /// Lowest value, "0.001" or "1 mm/s" [default: a hundredth of the speed or a tenth of the load of the scene, ratio 0,
    /// 40 degC]
    #[arg(long, allow_hyphen_values = true)]
    from: Option<String>,
    /// Highest value [default: a hundred times the speed, or the load of the scene, ratio 0.5, 100 degC]
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
    points: Vec<Point>,
    plan: Plan,
    starts: Starts,
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
    let all = curve.points.iter().all(|point| point.solution.report.status == Status::Converged);
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
        let (csv, rows, resolved, points) = ((path, file), Vec::new(), Vec::new(), Vec::new());
        let (plan, starts) = (Plan::new(options.model, scene), Starts::default());
        let is_complete = true;
        let mut curve = Self {
            options,
            scene: scene.clone(),
            columns,
            csv,
            bar,
            rows,
            resolved,
            points,
            plan,
            starts,
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

    /// Solves one value after the other for all surfaces; whether all were solved and none interrupted.
    fn solve(
        &mut self,
        scenes: &[Scene],
        (mut conditions, values): (Conditions, &[f64]),
        held: &Held,
    ) -> Result<bool, Box<dyn Error>> {
        self.bar.tick();
        let beside = resolved_values(self.options.resolve.unwrap_or(0), values.len());
        for (index, &value) in values.iter().enumerate() {
            let at = (&mut conditions, value);
            let Some(points) = self.points_at(scenes, at, held)? else { return Ok(false) };
            let is_model = points.first().is_some_and(|point| !is_resolved(point));
            self.take(value, points, false)?;
            if is_model && beside.contains(&index) {
                let (at, resolved) = ((&mut conditions, value), SolverModel::Resolved);
                let Some(points) = self.solve_surfaces(scenes, at, resolved, held)? else { return Ok(false) };
                self.take(value, points, true)?;
            }
        }
        Ok(true)
    }

    /// The contacts at one value by the model that holds there; `None` after an interruption.
    fn points_at(
        &mut self,
        scenes: &[Scene],
        (conditions, value): (&mut Conditions, f64),
        held: &Held,
    ) -> Result<Option<Vec<Point>>, Box<dyn Error>> {
        if self.plan == Plan::TryInlets {
            match self.solve_surfaces(scenes, (&mut *conditions, value), self.plan.model(), held) {
                Ok(None) => return Ok(None),
                Ok(Some(points)) => match points.iter().find(|point| !point.solution.is_within_model()) {
                    None if !points.is_empty() => return Ok(Some(points)),
                    outside => {
                        self.plan = outside.map_or(Plan::Resolved, |point| self.plan.after(&point.solution));
                    }
                },
                // Outside of the model, or an error that the resolved solve repeats.
                Err(_) => self.plan = Plan::Resolved,
            }
            self.bar.set_position((self.points.len()) as u64);
            return self.solve_surfaces(scenes, (conditions, value), SolverModel::Resolved, held);
        }
        self.solve_surfaces(scenes, (conditions, value), self.plan.model(), held)
    }

    /// The contacts of all surfaces at one value by one model, as many at once as there are processors; `None` after an
    /// interruption.
    fn solve_surfaces(
        &mut self,
        scenes: &[Scene],
        (conditions, value): (&mut Conditions, f64),
        model: SolverModel,
        held: &Held,
    ) -> Result<Option<Vec<Point>>, Box<dyn Error>> {
        let mut points = Vec::with_capacity(scenes.len());
        let numbered: Vec<_> = scenes.iter().enumerate().collect();
        for group in numbered.chunks(surfaces::at_once(scenes.len())) {
            let builder = |(surface, scene): (usize, &Scene)| {
                let mut scene = scene.clone();
                scene.solver.model = model;
                self.columns.over.set(&mut scene, conditions, value);
                let (held, bar) = (held.clone(), self.bar.clone());
                let builder = MixedLubricationSim::builder(scene).interrupt(move || {
                    held.print(&bar);
                    interrupt::is_requested()
                });
                let start = self.starts.of(surface).filter(|_| !model.is_resolved());
                if let Some(start) = start { builder.contact_start(start) } else { builder }
            };
            let builders = group.iter().copied().map(builder).collect();
            for ((surface, _), solved) in group.iter().zip(surfaces::solve_together(builders)) {
                match solved {
                    Ok(solution) => {
                        self.starts.keep(*surface, &solution);
                        points.push(Point { conditions: *conditions, surface: *surface, solution });
                    }
                    Err(SimError::Interrupted) => return Ok(None),
                    Err(error @ SimError::BoxTooSmall(_)) => {
                        self.is_complete = false;
                        self.warn(format!("{} is left out of the curve: {error}", self.columns.words(value)));
                    }
                    Err(error) => return Err(output::in_scene(&self.options.scene, &error).into()),
                }
                self.bar.inc(1);
            }
        }
        Ok(Some(points))
    }

    /// Prints and writes the `points` of one value, those of the curve or resolved ones beside it.
    fn take(&mut self, value: f64, points: Vec<Point>, is_beside: bool) -> Result<(), Box<dyn Error>> {
        for (field, text) in warnings(&self.columns.words(value), &points, &self.said) {
            self.said.extend(field);
            self.warn(text);
        }
        let is_converged = |point: &&Point| point.solution.report.status == Status::Converged;
        let solutions: Vec<_> = points.iter().filter(is_converged).map(|point| &point.solution).collect();
        if let Some(row) = Row::of(value, &solutions, self.formula(&points, value)) {
            self.write_line(&row.csv(self.columns))?;
            if !self.options.output.json {
                let is_first = self.rows.is_empty() && self.resolved.is_empty();
                let header = is_first.then(|| row::table_header(self.columns));
                let lines = header.into_iter().chain([row.table_line(self.columns)]).collect::<Vec<_>>();
                self.bar.suspend(|| output::print(&lines.join("\n")))?;
            }
            if is_beside { &mut self.resolved } else { &mut self.rows }.push(row);
        }
        if self.remarks && points.iter().any(|point| surfaces::is_mixed(&point.solution)) {
            self.remarks = false;
            let text = format!(
                "at {} solids and fluid share the load: this is one random surface of many; \
                 --seeds 4 gives the mean of four and their standard deviation",
                self.columns.words(value)
            );
            self.warn(text);
        }
        self.points.extend(points);
        Ok(())
    }

    /// Central film by formula at `value`, under the conditions of the `points`.
    fn formula(&self, points: &[Point], value: f64) -> Option<f64> {
        let (mut scene, mut conditions) = (self.scene.clone(), points.first()?.conditions);
        self.columns.over.set(&mut scene, &mut conditions, value);
        Some(scene.formula_film().ok()??.map.central)
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
        if !self.points.is_empty() {
            let numbers = self.to_json(start.elapsed().as_secs_f64())?;
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
    fn to_json(&self, seconds: f64) -> Result<Value, serde_json::Error> {
        let mut list = Vec::with_capacity(self.points.len());
        for point in &self.points {
            let mut numbers = serde_json::to_value(&point.solution)?;
            numbers["motion"] = serde_json::to_value(point.conditions.motion)?;
            numbers["load"] = point.conditions.load.into();
            numbers["bulk_temperature"] = point.conditions.bulk_temperature.into();
            if self.columns.spread {
                numbers["surface"] = point.surface.into();
            }
            list.push(numbers);
        }
        let rows = self.rows.iter().chain(&self.resolved);
        let rows: Vec<_> = rows.map(|row| row.to_json(self.columns)).collect();
        Ok(json!({
            "points": list, "curve": rows, "seconds": seconds, "version": env!("CARGO_PKG_VERSION"),
        }))
    }
}

/// Whether the contact was solved by the resolved model.
fn is_resolved(point: &Point) -> bool {
    point.solution.model != Some(SolverModel::AsperityInlets)
}

/// The warnings of the `points` of a value about fields that are not among the `said` ones, and about contacts that were
/// not solved, which have no field.
fn warnings(value: &str, points: &[Point], said: &[String]) -> Vec<(Option<String>, String)> {
    let mut new: Vec<(Option<String>, String)> = Vec::new();
    for point in points {
        let status = point.solution.report.status;
        if status != Status::Converged {
            let which =
                if points.len() > 1 { format!(", surface {},", point.surface) } else { String::new() };
            new.push((None, format!("{value}{which} is left out of the curve: {status}")));
        }
        for warning in &point.solution.warnings {
            let field = &warning.field;
            if !said.contains(field) && !new.iter().any(|(known, _)| known.as_ref() == Some(field)) {
                new.push((Some(field.clone()), format!("at {value}: {warning}")));
            }
        }
    }
    new
}
