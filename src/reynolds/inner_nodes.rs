//! Nodes inside the edges of a grid.

use crate::grid::Grid;

/// Indices of the nodes without the outermost ring, or without the two ends of the rows of a line contact.
pub(super) fn interior(grid: &Grid) -> impl Iterator<Item = usize> + use<> {
    let nx = grid.nx();
    inner_rows(grid).flat_map(move |j| (1..nx.saturating_sub(1)).map(move |i| j * nx + i))
}

/// Rows without the edge rows; for a line contact, which has no edge rows, all of them.
pub(super) fn inner_rows(grid: &Grid) -> std::ops::Range<usize> {
    if grid.has_side_edges() { 1..grid.ny().saturating_sub(1) } else { 0..grid.ny() }
}
