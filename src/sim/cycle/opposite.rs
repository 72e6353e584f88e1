//! Warning about rows outside of the range of the law of asperity inlets.

use crate::sim::contact::warnings::Warning;
use crate::sim::scene::cycle_table::CycleTable;
use crate::sim::scene::{Scene, SolverModel};

/// The warning about the rows of `table` whose surfaces move in opposite directions, where the asperities of `scene` carry by the law of
/// their inlets; `None` without such rows.
pub(super) fn opposite_surfaces(scene: &Scene, table: &CycleTable) -> Option<Warning> {
    if scene.solver.model != SolverModel::AsperityInlets {
        return None;
    }
    let is_opposite =
        |index: &usize| table.rows.get(*index).is_some_and(|row| row.speeds[0] * row.speeds[1] < 0.0);
    let rows: Vec<usize> = (0..table.rows.len()).filter(is_opposite).collect();
    let (first, last) = (rows.first()?, rows.last()?);
    Some(Warning::new(
        "solver.model",
        f64::NAN,
        format!(
            "the surfaces of {} of {} rows move in opposite directions, from {} to {}: their asperities have inlets on both sides, which the law leaves \
             out; take load ratio and friction there as a guess",
            rows.len(),
            table.rows.len(),
            table.source.row(*first),
            table.source.row(*last)
        ),
        "model = \"resolved\" for these rows".to_owned(),
    ))
}
