//! Curves of rigid bearings, scenes with the table `[given_film]`, over speed, load or temperature.

use std::error::Error;

use stribeck::sim::scene::{BearingSpec, JournalPosition, PadFilm};
use stribeck::sim::{BearingSolution, RigidBearing, SimError};
use stribeck::{InputError, Status};

use super::Options;
use super::axis::Axis;
use super::bearing_table::Curve;
use crate::interrupt;
use crate::output::{self, Outcome};

/// Lowest and highest speed and load over those of the scene.
const SPEEDS: [f64; 2] = [0.1, 10.0];
const LOADS: [f64; 2] = [0.1, 1.0];

/// Error for options that the curve of a bearing does not have.
fn refuse_options(options: &Options) -> Result<(), String> {
    let given = [("--seeds", options.seeds.is_some()), ("--resolve", options.resolve.is_some())];
    match given.into_iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((option, _)) => Err(format!("{option}: a rigid bearing is one film without random surfaces")),
    }
}

/// Computes the curve of `bearing`.
pub(super) fn run(options: &Options, mut bearing: RigidBearing) -> Result<Outcome, Box<dyn Error>> {
    refuse_options(options)?;
    let in_scene = |error: &SimError| output::in_scene(&options.scene, error);
    let own = own_value(&bearing, options.over).map_err(|error| in_scene(&error.into()))?;
    let is_wide = matches!(bearing.bearing, BearingSpec::Pad { width: None, .. });
    let values = options.over.spread(options, is_wide, own)?;
    let name = format!("{}_{}", output::stem(&options.scene), options.over.file_ending());
    let mut curve = Curve::begin(options, [bearing.roughness.is_some(), is_wide], &name)?;
    interrupt::listen("the curve ends here and keeps its finished points")?;
    for value in values {
        set(&mut bearing, options.over, value);
        let words = options.over.words(value, is_wide);
        match solve(options, &bearing, &words, &mut curve)? {
            Solved::Point(solution) => curve.add(value, &solution)?,
            Solved::LeftOut(status) => curve.left_out = curve.left_out.or(Some(status)),
            Solved::Interrupted => {
                curve.is_interrupted = true;
                break;
            }
        }
    }
    curve.finish(&name)
}

/// The end of the solve of one point.
enum Solved {
    Point(Box<BearingSolution>),
    LeftOut(Status),
    Interrupted,
}

/// Solves the point `words`, and prints its warnings.
fn solve(
    options: &Options,
    bearing: &RigidBearing,
    words: &str,
    curve: &mut Curve<'_>,
) -> Result<Solved, String> {
    let (status, reason) = match bearing.solve(interrupt::is_requested) {
        Ok(solution) => {
            curve.warn_once(words, &solution.warnings);
            match solution.film.report.status {
                Status::Converged => return Ok(Solved::Point(Box::new(solution))),
                status => (status, status.to_string()),
            }
        }
        Err(SimError::Reynolds(_)) if interrupt::is_requested() => return Ok(Solved::Interrupted),
        // A load that the film does not carry ends no curve.
        Err(SimError::Input(error)) if options.over != Axis::Temperature => {
            (Status::Stalled, error.to_string())
        }
        Err(error) => return Err(output::in_scene(&options.scene, &error)),
    };
    curve.warn(format!("{words} is left out of the curve: {reason}"));
    Ok(Solved::LeftOut(status))
}

/// Least and largest value by default.
fn own_value(bearing: &RigidBearing, over: Axis) -> Result<[f64; 2], InputError> {
    let refused = |reason: &str| {
        Err(InputError::Conflict {
            field: match over {
                Axis::Load => "--over load",
                Axis::Temperature => "--over temperature",
                _ => "--over slide_roll_ratio",
            }
            .to_owned(),
            reason: reason.to_owned(),
        })
    };
    match (over, bearing.bearing) {
        (Axis::Speed, BearingSpec::Journal { speed, .. } | BearingSpec::Pad { speed, .. }) => {
            Ok(SPEEDS.map(|factor| factor * speed))
        }
        (
            Axis::Load,
            BearingSpec::Journal { position: JournalPosition::Load(load), .. }
            | BearingSpec::Pad { film: PadFilm::Fixed { load, .. } | PadFilm::Pivoted { load, .. }, .. },
        ) => Ok(LOADS.map(|factor| factor * load)),
        (Axis::Load, _) => refused(
            "the load of this bearing follows from its film; a bearing with `load` has a curve over it",
        ),
        (Axis::Temperature, _) if !bearing.has_thermal_oil() && bearing.heat.is_none() => refused(
            "the viscosity of this oil does not depend on temperature; a grade and its viscosity_index",
        ),
        (Axis::Temperature, _) => Ok(super::axis::TEMPERATURES),
        _ => refused("one surface of a rigid bearing is at rest; --over speed, load or temperature"),
    }
}

/// Sets the quantity to `value`; with a heat balance the temperature is that of the supply.
fn set(bearing: &mut RigidBearing, over: Axis, value: f64) {
    match (over, &mut bearing.bearing) {
        (Axis::Speed, BearingSpec::Journal { speed, .. } | BearingSpec::Pad { speed, .. }) => {
            *speed = value;
            bearing.speed_diameter = None;
        }
        (Axis::Load, BearingSpec::Journal { position, .. }) => *position = JournalPosition::Load(value),
        (
            Axis::Load,
            BearingSpec::Pad { film: PadFilm::Fixed { load, .. } | PadFilm::Pivoted { load, .. }, .. },
        ) => {
            *load = value;
        }
        (Axis::Temperature, _) => match &mut bearing.heat {
            Some(balance) => balance.supply_temperature = value,
            None => bearing.temperature = value,
        },
        _ => {}
    }
}
