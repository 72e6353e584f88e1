//! Warning about a cycle whose cells are too wide for its narrowest contact.

use crate::error::InputError;
use crate::grid::Grid;
use crate::metrics::CENTRAL;
use crate::sim::contact::mesh_error::CELLS_IN_HALF_WIDTH;
use crate::sim::contact::warnings::Warning;
use crate::sim::cycle::half_widths;
use crate::sim::scene::Scene;
use crate::sim::scene::cycle_table::CycleTable;
use crate::units::by_size;

/// The warning about the row of `table` with the fewest cells of `grid` along x in its Hertz half-width; `None` where they are
/// as many as on the coarsest mesh of a requested accuracy.
///
/// The mean film is that of the nodes within 2/3 of the half-width. Where the half-width changes, a column of nodes enters or
/// leaves this region at each side at once.
pub(super) fn few_in_narrowest(
    scene: &Scene,
    grid: &Grid,
    table: &CycleTable,
) -> Result<Option<Warning>, InputError> {
    let half_widths = half_widths(scene, table)?;
    let widest = half_widths.iter().copied().fold(0.0, f64::max);
    let narrowest = half_widths.into_iter().enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    let Some((index, half_width)) = narrowest else { return Ok(None) };
    let cells = half_width / grid.dx();
    Ok((cells < CELLS_IN_HALF_WIDTH).then(|| {
        let jumps = if scene.form.is_line() && widest > half_width {
            format!(
                ", and the mean film changes in jumps, where two columns of nodes, {:.0} % of those in the middle of the contact, enter \
                 or leave it",
                100.0 / (CENTRAL * cells)
            )
        } else {
            String::new()
        };
        Warning::new(
            "grid.nx",
            grid.nx() as f64,
            format!(
                "{} has {cells:.1} cells in its Hertz half-width of {}, the smallest of the cycle: films depend on the mesh{jumps}",
                table.source.row(index),
                by_size(half_width, "m")
            ),
            format!("at least {} cells", (CELLS_IN_HALF_WIDTH / cells * grid.nx() as f64).ceil()),
        )
    }))
}
