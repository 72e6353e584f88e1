//! `stribeck cycle`: a contact over a cycle of load, speeds and radius.

mod chart;
mod history;
mod page;
mod solved;
mod squeeze;

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use stribeck::sim::{CyclePoint, MixedLubricationSim, Scene, SimError};
use stribeck::units::by_size;

use crate::output::{self, Held, Outcome, Output, ReportFile};
use crate::picture;
use crate::{files, interrupt};
use chart::{chart, pressure_unit};
use solved::{Kept, Solved};
use squeeze::{largest_squeeze, squeeze_warning};

/// Kind of contact, by which the results have units and films.
#[derive(Clone, Copy)]
struct Kind {
    is_line: bool,
    is_rough: bool,
}

impl Kind {
    /// The film that represents the contact: the central one, of rough bodies the mean in the middle of the contact.
    fn film(self, point: &CyclePoint) -> f64 {
        if self.is_rough { point.film_mean_central } else { point.film_central }
    }
}

/// Most lines of the printed table.
const LINES: usize = 25;

/// The table [cycle] of the scene has the conditions over time or angle. Each contact is a line of `SCENE_cycle.csv`, each solved cycle
/// of a history (cycle.repeat) one of `SCENE_cycles.csv`. `SCENE_cycle.json` keeps the solved cycle: the same scene is not solved again.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Scene file
    scene: PathBuf,
    #[command(flatten)]
    report: ReportFile,
    #[command(flatten)]
    output: Output,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let scene = output::load(&options.scene)?;
    options.report.claim(&options.scene, options.output.force)?;
    let name = format!("{}_cycle", output::stem(&options.scene));
    let (out, force) = (&options.output.out, options.output.force);
    let kind = Kind { is_line: scene.form.is_line(), is_rough: !scene.is_smooth() };
    let mut tables = vec![out.join(format!("{name}.csv"))];
    if scene.cycle.as_ref().is_some_and(|cycle| cycle.repeat.is_some()) {
        tables.push(out.join(format!("{name}s.csv")));
    }
    let kept = Kept::of(&scene, out.join(format!("{name}.json")))?;
    let pictures = if options.output.plot { picture::files(out, &name).to_vec() } else { Vec::new() };
    let targets = [&tables[..], std::slice::from_ref(&kept.path), &pictures].concat();
    files::make_folder(out)?;
    files::claim(&targets, force || kept.is_of_scene(), output::OTHER_FOLDER)?;
    let (solved, written) = match kept.solved(&tables).filter(|_| !force) {
        Some(solved) => {
            let text =
                format!("{} has the cycle of this scene; --force solves it again", kept.path.display());
            output::complain("solved", &text);
            (solved, pictures)
        }
        None => {
            let solved = solve(options, scene)?;
            write_tables(&solved, &tables, kind)?;
            kept.write(solved.to_json())?;
            (solved, targets)
        }
    };
    if options.output.plot {
        picture::write(&chart(&output::stem(&options.scene), &solved, kind), out, &name)?;
    }
    finish(options, &solved, kind, written)
}

/// Solves the cycle of `scene`.
fn solve(options: &Options, scene: Scene) -> Result<Solved, Box<dyn Error>> {
    let start = Instant::now();
    let (held, bar) = (Held::default(), ProgressBar::new_spinner());
    bar.set_style(ProgressStyle::with_template("{spinner} {pos} contacts, {elapsed}")?);
    interrupt::listen("the cycle ends after this contact and keeps those before it")?;
    let (due, above) = (held.clone(), bar.clone());
    let builder = MixedLubricationSim::builder(scene).interrupt(move || {
        due.print(&above);
        false
    });
    let solved = builder.solve_cycle(&mut |_| {
        bar.inc(1);
        !interrupt::is_requested()
    });
    bar.finish_and_clear();
    let solution = solved.map_err(|error: SimError| output::in_scene(&options.scene, &error))?;
    Ok(Solved::of(solution, start.elapsed().as_secs_f64()))
}

/// Writes the contacts and, of a history, the cycles.
fn write_tables(solved: &Solved, tables: &[PathBuf], kind: Kind) -> Result<(), Box<dyn Error>> {
    let lines: String = solved.points.iter().map(|point| format!("{}\n", point.csv())).collect();
    let contacts = format!("{}\n{lines}", columns(CyclePoint::COLUMNS, kind.is_line));
    let texts = [contacts, history::csv(&solved.cycles, kind.is_line)];
    tables.iter().zip(texts).try_for_each(|(table, text)| files::write(table, text.as_bytes()))
}

/// Prints the numbers of a solved cycle, and the files `written`.
fn finish(
    options: &Options,
    solution: &Solved,
    kind: Kind,
    mut written: Vec<PathBuf>,
) -> Result<Outcome, Box<dyn Error>> {
    output::warn(&solution.warnings);
    let squeeze = squeeze_warning(solution);
    if let Some(text) = &squeeze {
        output::complain("warning", text);
    }
    let numbers = solution.to_json();
    if let Some(path) = &options.report.report {
        page::write(
            options,
            (solution, squeeze),
            (&numbers, kind),
            (&extremes(solution, kind.is_line), path),
        )?;
        written.push(path.clone());
    }
    if options.output.json {
        output::print(&numbers)?;
    } else {
        output::print(&format!("{}\ntime       {:.2} s", report(solution, kind), solution.seconds))?;
    }
    output::report_files(&written, options.output.json)?;
    if let Some(reason) = &solution.ended_early {
        output::complain(
            "error",
            &format!("the cycle ended after {} contacts: {reason}", solution.points.len()),
        );
        return Ok(Outcome::NotConverged);
    }
    Ok(Outcome::Converged)
}

/// The names of the `columns`, those of a line contact per metre.
fn columns(columns: &str, is_line: bool) -> String {
    if !is_line {
        return columns.to_owned();
    }
    let per_metre = |name: &str| match name {
        "load_N" | "friction_power_W" => format!("{name}_per_m"),
        "wear_ball_volume_m3" | "wear_disc_volume_m3" => name.replace("_m3", "_m3_per_m"),
        name => name.to_owned(),
    };
    columns.split(',').map(per_metre).collect::<Vec<_>>().join(",")
}

/// Mean power of friction over the contacts \[W\].
fn mean_power(points: &[CyclePoint]) -> f64 {
    points.iter().map(|point| point.friction_power).sum::<f64>() / points.len().max(1) as f64
}

/// Angle or time of a contact in words.
fn place(point: &CyclePoint) -> String {
    match point.angle {
        Some(angle) => format!("{:.2} deg", angle.to_degrees()),
        None => format!("{:.4e} s", point.time),
    }
}

/// The cycle in lines: its extremes, and a table of contacts.
fn report(solution: &Solved, kind: Kind) -> String {
    let Kind { is_line, is_rough } = kind;
    let points = &solution.points;
    let step = match (solution.quasi_static, solution.is_moving) {
        (true, true) => "means of passages of moving roughness".to_owned(),
        (true, false) => "steady contacts".to_owned(),
        (false, _) => {
            format!("in time, at most {:.2} half-widths of entrained film a step", solution.largest_step)
        }
    };
    let (unit, pascals) = pressure_unit(points);
    let mut lines = vec![format!("cycle      {} contacts, {step}", points.len())];
    lines.extend(extremes(solution, is_line).iter().map(|(name, text)| format!("{name:<10} {text}")));
    lines.extend(history::table(&solution.cycles, is_line));
    lines.push(format!(
        "\n{:>12} {:>9} {:>9} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7}",
        if points.iter().any(|point| point.angle.is_some()) { "angle, deg" } else { "time, s" },
        "ball, m/s",
        "disc, m/s",
        if is_line { "load, N/m" } else { "load, N" },
        if is_rough { "h mean,nm" } else { "h, nm" },
        "h min, nm",
        format!("p, {unit}"),
        "on solids",
        "friction",
        "flash,K"
    ));
    let every = points.len().div_ceil(LINES).max(1);
    lines.extend(points.iter().step_by(every).map(|point| row(point, kind, pascals)));
    lines.join("\n")
}

/// Names and texts of the extremes of the cycle.
fn extremes(solution: &Solved, is_line: bool) -> Vec<(&'static str, String)> {
    let points = &solution.points;
    let mut lines = Vec::new();
    let extreme = |value: fn(&CyclePoint) -> f64, sign: f64| {
        points.iter().max_by(|a, b| (sign * value(a)).total_cmp(&(sign * value(b))))
    };
    let per = if is_line { "W/m" } else { "W" };
    if let Some(point) = extreme(|p| p.film_minimum, -1.0) {
        lines.push(("least film", format!("{:.2} nm at {}", 1e9 * point.film_minimum, place(point))));
    }
    if let Some(point) = extreme(|p| p.pressure_max, 1.0) {
        lines.push(("pressure", format!("{} at {}", by_size(point.pressure_max, "Pa"), place(point))));
    }
    if let Some(point) = extreme(|p| p.contact_load_ratio, 1.0).filter(|p| p.contact_load_ratio > 0.0) {
        lines.push((
            "on solids",
            format!("up to {:.4} of the load, at {}", point.contact_load_ratio, place(point)),
        ));
    }
    let mean = mean_power(points);
    if let Some(point) = extreme(|p| p.friction_power, 1.0) {
        let power = point.friction_power;
        lines.push((
            "power",
            format!(
                "{} {per} at {}, {} {per} in the mean of the contacts",
                output::digits(power),
                place(point),
                output::digits(mean)
            ),
        ));
    }
    if let Some(point) = extreme(|p| p.flash_rise.unwrap_or(0.0), 1.0)
        && let Some(rise) = point.flash_rise
    {
        lines.push(("flash", format!("{rise:.1} K at {}", place(point))));
    }
    if let Some(point) = largest_squeeze(solution) {
        let ratio = point.squeeze_ratio.unwrap_or(0.0);
        let dead = points.iter().find(|point| point.squeeze_ratio.is_none());
        let dead = dead.map_or_else(String::new, |point| format!("; dead point at {}", place(point)));
        lines.push(("squeeze", format!("{ratio:.3} of the entrainment at {}{dead}", place(point))));
    }
    lines
}

/// A contact in a line, its pressure in so many `pascals`.
fn row(point: &CyclePoint, kind: Kind, pascals: f64) -> String {
    format!(
        "{:>12} {:>9.3} {:>9.3} {:>10.3e} {:>9.1} {:>9.1} {:>9.3} {:>9.4} {:>9.4} {:>7.1}",
        point
            .angle
            .map_or_else(|| format!("{:.4e}", point.time), |angle| format!("{:.2}", angle.to_degrees())),
        point.ball_speed,
        point.disc_speed,
        point.load,
        1e9 * kind.film(point),
        1e9 * point.film_minimum,
        point.pressure_max / pascals,
        point.contact_load_ratio,
        point.friction_coefficient,
        point.flash_rise.unwrap_or(0.0)
    )
}
