//! Prediction of a smooth full film from the problem data, without a solve.

use crate::grid::Grid;
use crate::reynolds::inner_nodes::interior;
use crate::reynolds::problem::LubricatedContact;

/// Largest variation of the second differences of a smooth gap, in reference films.
const ROUGHNESS: f64 = 0.1;
/// Ratio of pressure limit to reference pressure below which no full film is predicted.
const LIMIT_OVER_REFERENCE: f64 = 1.2;

/// Whether no solid contact is expected: a smooth gap, a reference film above `margin` times the contact
/// film, and pressures below the limit.
pub(in crate::reynolds) fn expects_full_film(problem: &LubricatedContact<'_>, margin: f64) -> bool {
    let grid = problem.grid();
    let is_thick = problem.reference_film > margin * problem.contact_film();
    let least = LIMIT_OVER_REFERENCE * problem.reference_pressure;
    let is_soft = interior(&grid).any(|k| problem.limit_at(k) < least);
    is_thick && !is_soft && is_smooth(problem, &grid)
}

/// Whether the gap is a paraboloid within the contact: second differences over a quarter of the half-widths
/// vary little relative to the reference film. Differences between neighboring nodes would miss waves of many
/// cells.
fn is_smooth(problem: &LubricatedContact<'_>, grid: &Grid) -> bool {
    let (a, b) = problem.reference_half_widths;
    let (nx, ny) = (grid.nx(), grid.ny());
    let stride = |half: f64, spacing: f64, n: usize| ((0.25 * half / spacing) as usize).min(n / 4).max(1);
    let (step_x, step_y) = (stride(a, grid.dx(), nx), stride(b, grid.dy(), ny));
    let bend = |k: usize, step: usize| problem.gap[k - step] - 2.0 * problem.gap[k] + problem.gap[k + step];
    let centre = ny / 2 * nx + nx / 2;
    let (rows, across) = if ny > 1 { (step_y..ny - step_y, step_y * nx) } else { (0..1, 0) };
    let typical = (bend(centre, across), bend(centre, step_x));
    let most = ROUGHNESS * problem.reference_film;
    rows.flat_map(|j| (step_x..nx - step_x).map(move |i| (i, j))).all(|(i, j)| {
        let k = j * nx + i;
        let is_far = (grid.x(i) / a).abs() > 1.5 || (grid.y(j) / b).abs() > 1.5;
        let excess = (bend(k, across) - typical.0).abs().max((bend(k, step_x) - typical.1).abs());
        is_far || excess < most
    })
}
