//! When a history ends, and the length of its steps.

use stribeck::sim::{MixedLubricationSim, Schedule};

use super::Options;
use crate::output;

/// Steps of a history whose time alone is known.
const STEPS: u64 = 100;

/// Time at which a history ends \[s\] and length of its steps \[s\].
pub(super) struct Plan {
    pub(super) end: f64,
    pub(super) time_step: f64,
}

/// End and length of the steps.
pub(super) fn plan(options: &Options, sim: &MixedLubricationSim) -> Result<Plan, String> {
    let time = options.duration.or_else(|| last_entry(sim));
    let (end, time_step) = match (options.steps, options.time_step, time) {
        (Some(_), Some(_), _) if options.duration.is_some() => {
            return Err("--duration, --steps and --time-step say it twice; give two of them".to_owned());
        }
        (Some(steps), Some(time_step), _) => (steps as f64 * time_step, time_step),
        (Some(steps), None, Some(time)) => (time, time / steps as f64),
        (None, Some(time_step), Some(time)) => {
            if time_step > time {
                let text = format!("--time-step is longer than the history: it is one step of {time} s");
                output::complain("warning", &text);
            }
            (time, time_step.min(time))
        }
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
