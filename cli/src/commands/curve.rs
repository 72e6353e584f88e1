//! `stribeck curve`: friction over speed, from boundary lubrication to full film.

use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};
use stribeck::sim::scene::{Motion, Scene};
use stribeck::sim::{ContactSolution, solve_contact};
use stribeck::units::Dimension;
use stribeck::{InputError, Status};

use crate::output::{self, Outcome, Output};
use crate::picture::{self, BLUE, Chart, Line, Panel, XScale};

/// Range of speeds around that of the scene, and how many in it.
const RANGE: f64 = 100.0;
const POINTS: u32 = 13;

/// The oil, the surfaces, the load and the ratio of sliding are those of the scene. The curve is written as a
/// table (csv) too.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Scene file
    scene: PathBuf,
    /// Lowest entrainment speed, "0.001" or "1 mm/s" [default: a hundredth of that of the scene]
    #[arg(long, allow_hyphen_values = true, value_parser = |text: &str| output::positive(Dimension::Speed, "--from", text))]
    from: Option<f64>,
    /// Highest entrainment speed [default: a hundred times that of the scene]
    #[arg(long, allow_hyphen_values = true, value_parser = |text: &str| output::positive(Dimension::Speed, "--to", text))]
    to: Option<f64>,
    /// Number of speeds, evenly spread over their logarithms
    #[arg(
        long, default_value_t = POINTS, allow_hyphen_values = true,
        value_parser = |text: &str| output::count::<u32>("--points", text, 2..=1000)
    )]
    points: u32,
    #[command(flatten)]
    output: Output,
}

/// A solved speed.
struct Point {
    motion: Motion,
    solution: ContactSolution,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    let scene = output::load(&options.scene)?;
    let motion = start_motion(options, &scene)?;
    let speeds = speeds(options, motion.entrainment_speed)?;
    if motion.slide_roll_ratio == 0.0 {
        output::complain("warning", "the slide-roll ratio is 0: without sliding there is no friction");
    }
    output::warn(&scene.warnings());
    let points = solve(options, &scene, motion, &speeds)?;
    let name = format!("{}_curve", output::stem(&options.scene));
    let out = &options.output.out;
    std::fs::create_dir_all(out).map_err(|error| format!("{}: {error}", out.display()))?;
    let mut files = vec![out.join(format!("{name}.csv"))];
    for file in &files {
        std::fs::write(file, csv(&points)?).map_err(|error| format!("{}: {error}", file.display()))?;
    }
    if options.output.plot {
        files.extend(picture::write(&chart(options, &points), out, &name)?);
    }
    if options.output.json {
        output::print(&to_json(&points, start.elapsed().as_secs_f64())?)?;
    } else {
        output::print(&table(&points).trim_end())?;
    }
    output::report_files(&files, options.output.json)?;
    let all = points.iter().all(|point| point.solution.report.status == Status::Converged);
    Ok(if all { Outcome::Converged } else { Outcome::NotConverged })
}

/// The motion at the start of the schedule of an oiled contact.
fn start_motion(options: &Options, scene: &Scene) -> Result<Motion, Box<dyn Error>> {
    if !scene.is_lubricated() {
        return Err(output::in_scene(
            &options.scene,
            &InputError::Conflict {
                field: "lubricant".to_owned(),
                reason: "a Stribeck curve needs an oil, this contact is dry".to_owned(),
            },
        )
        .into());
    }
    Ok(scene.conditions(0.0).map_err(|error| output::in_scene(&options.scene, &error))?.motion)
}

/// Those that are asked for, about the `own` one of the scene \[m/s\].
fn speeds(options: &Options, own: f64) -> Result<Vec<f64>, Box<dyn Error>> {
    if options.from.is_none() || options.to.is_none() {
        output::require(own > 0.0, "motion.entrainment_speed", own, "finite and > 0")
            .map_err(|error| output::in_scene(&options.scene, &error))?;
    }
    let (from, to) = (options.from.unwrap_or(own / RANGE), options.to.unwrap_or(own * RANGE));
    if to <= from {
        return Err(format!("--to = {to} m/s must be above --from = {from} m/s").into());
    }
    let last = f64::from(options.points - 1);
    Ok((0..options.points).map(|k| from * (to / from).powf(f64::from(k) / last)).collect())
}

fn solve(
    options: &Options,
    scene: &Scene,
    mut motion: Motion,
    speeds: &[f64],
) -> Result<Vec<Point>, Box<dyn Error>> {
    let bar = ProgressBar::new(speeds.len() as u64);
    bar.set_style(ProgressStyle::with_template("{wide_bar} {pos} of {len} speeds, {eta} left")?);
    bar.tick();
    let mut points = Vec::with_capacity(speeds.len());
    for &speed in speeds {
        let mut scene = scene.clone();
        scene.motion.entrainment_speed = speed;
        scene.schedule.entrainment_speed = None;
        let solution = solve_contact(&scene).map_err(|error| output::in_scene(&options.scene, &error))?;
        let status = solution.report.status;
        if status != Status::Converged {
            output::complain("warning", &format!("{speed:.4e} m/s is left out of the curve: {status}"));
        }
        motion.entrainment_speed = speed;
        points.push(Point { motion, solution });
        bar.inc(1);
    }
    bar.finish_and_clear();
    warn(scene, &points);
    Ok(points)
}

/// The warnings of the speeds and their solutions, each once, beside those of the scene: with the first speed
/// that has it unless all speeds share it.
fn warn(scene: &Scene, points: &[Point]) {
    let mut said: Vec<String> = scene.warnings().into_iter().map(|warning| warning.field).collect();
    for point in points {
        for warning in &point.solution.warnings {
            if said.contains(&warning.field) {
                continue;
            }
            let shared = points.iter().all(|point| point.solution.warnings.contains(warning));
            let speed = if shared {
                String::new()
            } else {
                format!("at {:.4e} m/s: ", point.motion.entrainment_speed)
            };
            output::complain("warning", &format!("{speed}{warning}"));
            said.push(warning.field.clone());
        }
    }
}

fn converged(points: &[Point]) -> impl Iterator<Item = &Point> {
    points.iter().filter(|point| point.solution.report.status == Status::Converged)
}

fn table(points: &[Point]) -> String {
    let mut text = format!(
        "{:>11} {:>9} {:>14} {:>9} {:>9}\n",
        "speed, m/s", "friction", "load on solids", "film, nm", "film / Rq"
    );
    for point in converged(points) {
        let solution = &point.solution;
        let lambda = solution.film.lambda.map_or_else(|| "-".to_owned(), |lambda| format!("{lambda:.3}"));
        text += &format!(
            "{:11.4e} {:9.4} {:14.4} {:9.2} {lambda:>9}\n",
            point.motion.entrainment_speed,
            solution.friction.coefficient,
            solution.contact.load_ratio,
            1e9 * solution.film.mean_central
        );
    }
    text
}

/// The curve in SI units.
fn csv(points: &[Point]) -> Result<String, std::fmt::Error> {
    let mut text =
        "motion_entrainment_speed_m_s,friction_coefficient,contact_load_ratio,film_mean_central_m,film_lambda\n".to_owned();
    for point in converged(points) {
        let solution = &point.solution;
        let lambda = solution.film.lambda.map_or_else(String::new, |lambda| format!("{lambda:e}"));
        writeln!(
            text,
            "{:e},{:e},{:e},{:e},{lambda}",
            point.motion.entrainment_speed,
            solution.friction.coefficient,
            solution.contact.load_ratio,
            solution.film.mean_central
        )?;
    }
    Ok(text)
}

/// Each point under the names of `solve`, with its speeds.
fn to_json(points: &[Point], seconds: f64) -> Result<Value, serde_json::Error> {
    let mut list = Vec::with_capacity(points.len());
    for point in points {
        let mut numbers = serde_json::to_value(&point.solution)?;
        numbers["motion"] = serde_json::to_value(point.motion)?;
        list.push(numbers);
    }
    Ok(json!({ "points": list, "seconds": seconds, "version": env!("CARGO_PKG_VERSION") }))
}

fn chart(options: &Options, points: &[Point]) -> Chart {
    let panel = |y_label: &str, value: fn(&Point) -> Option<f64>| Panel {
        y_label: y_label.to_owned(),
        lines: vec![Line {
            name: "",
            colour: BLUE,
            points: converged(points)
                .filter_map(|point| value(point).map(|value| (point.motion.entrainment_speed.log10(), value)))
                .collect(),
        }],
        highest: None,
    };
    let mut panels = vec![
        panel("friction", |point| Some(point.solution.friction.coefficient)),
        panel("load on solids", |point| Some(point.solution.contact.load_ratio)),
        panel("film (nm)", |point| Some(1e9 * point.solution.film.mean_central)),
    ];
    if points.iter().any(|point| point.solution.film.lambda.is_some()) {
        panels.push(panel("film / Rq", |point| point.solution.film.lambda));
    }
    Chart {
        title: format!("Stribeck curve of {}", output::stem(&options.scene)),
        x_label: "entrainment speed (m/s)",
        x_scale: XScale::Decades,
        panels,
    }
}
