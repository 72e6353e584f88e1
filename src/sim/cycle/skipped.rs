//! Warning about a cycle in time whose steps skip the motion.

use crate::error::InputError;
use crate::sim::contact::warnings::Warning;
use crate::sim::cycle::half_widths;
use crate::sim::scene::Scene;
use crate::sim::scene::cycle_table::CycleTable;
use crate::units::by_size;

/// Longest way of the entrained film in a step, in half-widths: in longer ones the film of a step leaves the contact.
const LONGEST_WAY: f64 = 1.0;
/// Fewest and most steps of a cycle that does not give their number.
const USUAL_STEPS: [f64; 2] = [400.0, 4000.0];

/// Steps in which no row of `table` passes more than [`LONGEST_WAY`].
fn needed_steps(scene: &Scene, table: &CycleTable) -> Result<f64, InputError> {
    let rows = table.rows.iter().zip(half_widths(scene, table)?);
    let fastest =
        rows.fold(0.0_f64, |most, (row, half_width)| most.max(row.entrainment().abs() / half_width));
    Ok(table.span()[1] * fastest / LONGEST_WAY)
}

/// Steps of the given number, else as many as the film needs, 400 to 4000.
pub(super) fn steps(scene: &Scene, table: &CycleTable) -> Result<usize, InputError> {
    match table.steps {
        Some(steps) => Ok(steps),
        None => Ok(needed_steps(scene, table)?.ceil().clamp(USUAL_STEPS[0], USUAL_STEPS[1]) as usize),
    }
}

/// The warning about steps of `table` that are too long for its motion; `None` for steady contacts.
pub(super) fn skipped_motion(scene: &Scene, table: &CycleTable) -> Result<Option<Warning>, InputError> {
    let (needed, steps) = (needed_steps(scene, table)?, steps(scene, table)? as f64);
    if table.quasi_static || needed <= steps {
        return Ok(None);
    }
    let more = format!("at least {} steps", needed.ceil());
    let remedy = if needed > USUAL_STEPS[1] {
        let cycle = by_size(table.span()[1], "s");
        format!(
            "{more}; quasi_static = true solves the rows without squeeze and prints its size; check the unit of the times, {cycle} a cycle"
        )
    } else {
        more
    };
    Ok(Some(Warning::new(
        "cycle.steps",
        steps,
        format!(
            "{:.2} half-widths of entrained film pass the contact in a step of {:.4e} s: changes of the motion within a step are left out",
            LONGEST_WAY * needed / steps,
            table.span()[1] / steps
        ),
        remedy,
    )))
}
