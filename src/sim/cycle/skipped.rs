//! Warning about a cycle in time whose steps skip the motion.

use crate::error::InputError;
use crate::sim::contact::warnings::Warning;
use crate::sim::cycle::half_widths;
use crate::sim::scene::Scene;
use crate::sim::scene::cycle_table::CycleTable;

/// Longest way of the entrained film in a step, in half-widths: in longer ones the film of a step leaves the contact.
const LONGEST_WAY: f64 = 1.0;

/// Longest way of the entrained film in a step over the rows of `table`, in half-widths of their Hertz contacts.
fn longest_way(scene: &Scene, table: &CycleTable) -> Result<f64, InputError> {
    let time_step = table.span()[1] / table.steps as f64;
    let ways = table.rows.iter().zip(half_widths(scene, table)?);
    Ok(ways.fold(0.0, |longest, (row, half_width)| {
        longest.max(row.entrainment().abs() * time_step / half_width)
    }))
}

/// The warning about steps of `table` that are too long for its motion; `None` for steady contacts.
pub(super) fn skipped_motion(scene: &Scene, table: &CycleTable) -> Result<Option<Warning>, InputError> {
    if table.quasi_static {
        return Ok(None);
    }
    let way = longest_way(scene, table)?;
    Ok((way > LONGEST_WAY).then(|| {
        Warning::new(
            "cycle.steps",
            table.steps as f64,
            format!(
                "{way:.2} half-widths of entrained film pass the contact in a step of {:.4e} s: changes of the motion within a step are left out",
                table.span()[1] / table.steps as f64
            ),
            format!("at least {} steps", (table.steps as f64 * way).ceil()),
        )
    }))
}
