//! Nodes inside the edges of a grid.

use crate::grid::Grid;

/// Indices of the nodes without the outermost ring, or without the two ends of a line contact.
pub(super) fn interior(grid: &Grid) -> impl Iterator<Item = usize> + use<> {
    let nx = grid.nx();
    inner_rows(grid).flat_map(move |j| (1..nx.saturating_sub(1)).map(move |i| j * nx + i))
}

/// Rows without the edge rows; for a line contact, which has no edge rows, its only row.
pub(super) fn inner_rows(grid: &Grid) -> std::ops::Range<usize> {
    if grid.ny() == 1 { 0..1 } else { 1..grid.ny().saturating_sub(1) }
}
