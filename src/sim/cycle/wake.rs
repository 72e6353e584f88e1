//! Warning about oil that leaves the box before the flow turns back.

use crate::grid::Grid;
use crate::sim::contact::warnings::Warning;
use crate::sim::scene::cycle_table::CycleTable;
use crate::units::by_size;

/// Longest way of the entrained film between two rows of `table` at which the flow turns back \[m\].
fn longest_stroke(table: &CycleTable) -> f64 {
    let (mut longest, mut stroke) = (0.0_f64, 0.0_f64);
    for pair in table.rows.windows(2) {
        let (before, after) = (pair[0].entrainment(), pair[1].entrainment());
        let way = 0.5 * (before + after) * (pair[1].time - pair[0].time);
        if before * after <= 0.0 || way * stroke < 0.0 {
            stroke = 0.0;
        }
        stroke += way;
        longest = longest.max(stroke.abs());
    }
    longest
}

/// The warning that the film behind the contact leaves the box of `grid` in a stroke of `table`, whose flow turns back; `None` for
/// steady contacts and for a flow in one direction.
pub(super) fn left_the_box(grid: &Grid, table: &CycleTable) -> Option<Warning> {
    let edge = -grid.x(0) + 0.5 * grid.dx();
    let stroke = longest_stroke(table);
    (!table.quasi_static && table.reverses() && stroke > edge).then(|| {
        Warning::new(
            "grid.x",
            -edge,
            format!(
                "the film behind the contact leaves the box in a stroke of up to {}, and flow that turns back brings full oil from its edge: films \
                 after a reversal are those of a track that is refilled, and thicker than without refill",
                by_size(stroke, "m")
            ),
            "a box as long as the stroke keeps the film behind the contact".to_owned(),
        )
    })
}
