//! The peak of a field between its nodes.

use crate::error::InputError;
use crate::grid::Grid;

/// Ratio of the neighbors to the largest value above which a peak counts as resolved.
const RESOLVED: f64 = 0.9;

/// Interpolated peak of a non-negative field: its largest value, plus the rise of parabolas along x and y
/// through that node and its neighbors, `(f_+ - f_-)^2 / (8 (2 f_0 - f_+ - f_-))` each.
///
/// On a smooth field the interpolation removes the second-order error due to the offset of the peak from the
/// nodes. A direction in which a neighbor is missing or below nine tenths of the largest value adds nothing,
/// as the peak is not resolved.
///
/// # Errors
/// A field that does not fit the grid or is not finite.
///
/// ```
/// use stribeck::{Grid, metrics::peak};
/// let grid = Grid::from_edges(64, 64, [-1.0, 1.0], [-1.0, 1.0])?;
/// let field: Vec<f64> = grid.nodes().map(|(x, y)| 5.0 - (x - 0.01).powi(2) - 2.0 * y * y).collect();
/// assert!((peak(&grid, &field)? - 5.0).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn peak(grid: &Grid, field: &[f64]) -> Result<f64, InputError> {
    grid.require_field("field", field)?;
    let (nx, ny) = (grid.nx(), grid.ny());
    let Some((k, &top)) = field.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)) else {
        return Ok(0.0);
    };
    let mut peak = top;
    for (position, count, stride) in [(k % nx, nx, 1), (k / nx, ny, nx)] {
        if position == 0 || position + 1 >= count {
            continue;
        }
        let (below, above) = (field[k - stride], field[k + stride]);
        let curvature = 2.0 * top - below - above;
        if below.min(above) >= RESOLVED * top && curvature > 0.0 {
            peak += (above - below).powi(2) / (8.0 * curvature);
        }
    }
    Ok(peak)
}
