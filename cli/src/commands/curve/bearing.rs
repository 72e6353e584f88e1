//! Curves of rigid bearings, scenes with the table `[given_film]`, over speed, load or temperature.

use std::error::Error;
use std::fs::File;
use std::io::Write as _;

use serde_json::{Value, json};
use stribeck::sim::scene::{BearingSpec, JournalPosition};
use stribeck::sim::{BearingNumbers, BearingSolution, RigidBearing, SimError};
use stribeck::{InputError, Status};

use super::Options;
use super::axis::Axis;
use crate::output::{self, Outcome};
use crate::{files, interrupt};

/// Lowest and highest speed and load over those of the scene.
const SPEEDS: [f64; 2] = [0.1, 10.0];
const LOADS: [f64; 2] = [0.1, 1.0];

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

/// Error for options that the curve of a bearing does not have.
fn refuse_options(options: &Options) -> Result<(), String> {
    let given = [
        ("--seeds", options.seeds.is_some()),
        ("--resolve", options.resolve.is_some()),
        ("--plot", options.output.plot),
    ];
    match given.into_iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((option, _)) => Err(format!(
            "{option}: a rigid bearing is one film without random surfaces, its curve is a table"
        )),
    }
}

/// Computes the curve of `bearing`.
pub(super) fn run(options: &Options, bearing: RigidBearing) -> Result<Outcome, Box<dyn Error>> {
    refuse_options(options)?;
    let in_scene = |error: &SimError| output::in_scene(&options.scene, error);
    let own = own_value(&bearing, options.over).map_err(|error| in_scene(&error.into()))?;
    let values = options.over.spread(options, false, own)?;
    let path = options.output.out.join(format!(
        "{}_{}.csv",
        output::stem(&options.scene),
        options.over.file_ending()
    ));
    files::make_folder(&options.output.out)?;
    files::claim(std::slice::from_ref(&path), options.output.force, output::OTHER_FOLDER)?;
    interrupt::listen("the curve ends here and keeps its finished points")?;
    let mut file = File::create(&path).map_err(|error| files::named(&path, &error))?;
    let over = options.over.column(false);
    let rough = ROUGH_COLUMNS.iter().filter(|_| bearing.roughness.is_some());
    let columns: Vec<_> = COLUMNS.iter().chain(rough).filter(|(name, _)| *name != over).collect();
    let names = columns.iter().map(|(name, _)| *name);
    writeln!(file, "{}", [over].into_iter().chain(names).collect::<Vec<_>>().join(","))?;
    let (mut points, mut said): (Vec<Value>, Vec<String>) = (Vec::new(), Vec::new());
    let (mut bearing, mut outcome) = (bearing, Outcome::Converged);
    for value in values {
        set(&mut bearing, options.over, value);
        let words = options.over.words(value, false);
        let solution = match solve(options, &bearing, &words, &mut said)? {
            Solved::Point(solution) => solution,
            Solved::LeftOut => {
                outcome = Outcome::NotConverged;
                continue;
            }
            Solved::Interrupted => {
                outcome = Outcome::NotConverged;
                break;
            }
        };
        let cells = columns.iter().map(|(_, number)| number(&solution.numbers));
        let cells: Vec<String> = [value].into_iter().chain(cells).map(cell).collect();
        writeln!(file, "{}", cells.join(","))?;
        if !options.output.json {
            if points.is_empty() {
                output::print(&header(options.over, bearing.roughness.is_some()))?;
            }
            let warned: Vec<&str> = solution.warnings.iter().map(|warning| warning.field.as_str()).collect();
            let mark = if warned.is_empty() { String::new() } else { format!("  ! {}", warned.join(", ")) };
            output::print(&(line(options.over, value, &solution.numbers) + &mark))?;
        }
        let mut numbers = serde_json::to_value(solution.numbers)?;
        numbers["over"] = value.into();
        points.push(numbers);
    }
    if points.is_empty() {
        files::remove(&path);
        return Err("no point of the curve was solved".into());
    }
    if options.output.json {
        output::print(&json!({ "over": over, "points": points, "version": env!("CARGO_PKG_VERSION") }))?;
    }
    output::report_files(std::slice::from_ref(&path), options.output.json)?;
    Ok(outcome)
}

/// The end of the solve of one point.
enum Solved {
    Point(Box<BearingSolution>),
    LeftOut,
    Interrupted,
}

/// Solves the point `words`, and complains of its warnings whose fields are not among those `said` before.
fn solve(
    options: &Options,
    bearing: &RigidBearing,
    words: &str,
    said: &mut Vec<String>,
) -> Result<Solved, String> {
    let reason = match bearing.solve(interrupt::is_requested) {
        Ok(solution) => {
            for warning in solution.warnings.iter().filter(|warning| !said.contains(&warning.field)) {
                output::complain("warning", &format!("at {words}: {warning}"));
            }
            said.extend(solution.warnings.iter().map(|warning| warning.field.clone()));
            match solution.film.report.status {
                Status::Converged => return Ok(Solved::Point(Box::new(solution))),
                status => status.to_string(),
            }
        }
        Err(SimError::Reynolds(_)) if interrupt::is_requested() => return Ok(Solved::Interrupted),
        // A load that the film does not carry ends no curve.
        Err(SimError::Input(error)) if options.over != Axis::Temperature => error.to_string(),
        Err(error) => return Err(output::in_scene(&options.scene, &error)),
    };
    output::complain("warning", &format!("{words} is left out of the curve: {reason}"));
    Ok(Solved::LeftOut)
}

/// A number of the table; nothing for NaN.
fn cell(number: f64) -> String {
    if number.is_nan() { String::new() } else { format!("{number:e}") }
}

fn header(over: Axis, is_rough: bool) -> String {
    let solids = if is_rough { "   solids, %" } else { "" };
    format!(
        "{:>11} {:>12} {:>12} {:>10} {:>10} {:>12} {:>10}{solids}",
        over.heading(false),
        "load, N",
        "film, um",
        "friction",
        "power, W",
        "sides, ml/s",
        "oil, degC"
    )
}

fn line(over: Axis, value: f64, numbers: &BearingNumbers) -> String {
    let solids = numbers.contact_share.map_or_else(String::new, |share| format!(" {:11.3}", 100.0 * share));
    format!(
        "{} {:>12} {:12.4} {:10.5} {:10.4} {:12.4} {:10.2}{solids}",
        over.cell(value),
        output::digits(numbers.load),
        1e6 * numbers.least_film,
        numbers.friction_coefficient,
        numbers.power_loss,
        1e6 * numbers.side_flow,
        numbers.temperature - 273.15
    )
}

/// Least and largest value by default.
fn own_value(bearing: &RigidBearing, over: Axis) -> Result<[f64; 2], InputError> {
    let refused = |reason: &str| {
        Err(InputError::Conflict {
            field: format!("--over {}", if over == Axis::Load { "load" } else { "slide_roll_ratio" }),
            reason: reason.to_owned(),
        })
    };
    match (over, bearing.bearing) {
        (
            Axis::Speed,
            BearingSpec::Journal { speed, .. }
            | BearingSpec::Pad { speed, .. }
            | BearingSpec::Step { speed, .. },
        ) => Ok(SPEEDS.map(|factor| factor * speed)),
        (Axis::Load, BearingSpec::Journal { position: JournalPosition::Load(load), .. }) => {
            Ok(LOADS.map(|factor| factor * load))
        }
        (Axis::Load, _) => refused(
            "the load of this bearing follows from its film; a journal with `load` has a curve over it",
        ),
        (Axis::Temperature, _) => Ok(super::axis::TEMPERATURES),
        _ => refused("one surface of a rigid bearing is at rest; --over speed, load or temperature"),
    }
}

/// Sets the quantity to `value`; with a heat balance the temperature is that of the supply.
fn set(bearing: &mut RigidBearing, over: Axis, value: f64) {
    match (over, &mut bearing.bearing) {
        (
            Axis::Speed,
            BearingSpec::Journal { speed, .. }
            | BearingSpec::Pad { speed, .. }
            | BearingSpec::Step { speed, .. },
        ) => *speed = value,
        (Axis::Load, BearingSpec::Journal { position, .. }) => *position = JournalPosition::Load(value),
        (Axis::Temperature, _) => match &mut bearing.heat {
            Some(balance) => balance.supply_temperature = value,
            None => bearing.temperature = value,
        },
        _ => {}
    }
}
