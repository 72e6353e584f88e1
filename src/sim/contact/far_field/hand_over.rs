//! Interpolation from the mesh of the outer contact to that of the inner one.

use crate::grid::Grid;

/// The value of `field` at the point `(x, y)` by cubic interpolation along each axis, for a `positive` field of its
/// logarithm. Next to the edge of the grid and to zeros of a positive field it is bilinear; outside of the grid it is
/// zero.
pub(super) fn interpolate(grid: &Grid, field: &[f64], [x, y]: [f64; 2], positive: bool) -> f64 {
    let along = [(x - grid.x(0)) / grid.dx(), (y - grid.y(0)) / grid.dy()];
    let (nx, ny) = (grid.nx(), grid.ny());
    let Some((i, wx)) = weights(along[0], nx) else { return 0.0 };
    let Some((j, wy)) = (if ny == 1 { Some((0, [0.0, 1.0, 0.0, 0.0])) } else { weights(along[1], ny) })
    else {
        return 0.0;
    };
    let at = |i: usize, j: usize| field.get(j * nx + i).copied().unwrap_or(0.0);
    let (is_inside_x, is_inside_y) = (i >= 1 && i + 2 < nx, ny == 1 || (j >= 1 && j + 2 < ny));
    let rows = if ny == 1 { 0..1 } else { 0..4 };
    if is_inside_x && is_inside_y {
        let sum = |value: &dyn Fn(f64) -> f64| -> f64 {
            rows.clone()
                .map(|b| {
                    let (row, weight) = if ny == 1 { (0, 1.0) } else { (j + b - 1, wy[b]) };
                    let along: f64 =
                        wx.iter().enumerate().map(|(a, wx)| wx * value(at(i + a - 1, row))).sum();
                    weight * along
                })
                .sum()
        };
        if !positive {
            return sum(&|value| value);
        }
        // Pressures increase by orders of magnitude towards the contact: cubics of their logarithms stay positive.
        let logarithm = sum(&f64::ln);
        if logarithm.is_finite() {
            return logarithm.exp();
        }
    }
    let (s, t) = (along[0] - i as f64, if ny == 1 { 0.0 } else { along[1] - j as f64 });
    let row = |j: usize| (1.0 - s) * at(i, j) + s * at(i + 1, j);
    if ny == 1 { row(0) } else { (1.0 - t) * row(j) + t * row(j + 1) }
}

/// The node below `position` of `n`, and the cubic weights of the four nodes around it; `None` outside of the nodes.
///
fn weights(position: f64, n: usize) -> Option<(usize, [f64; 4])> {
    if !(position >= 0.0 && position <= (n - 1) as f64) {
        return None;
    }
    let i = (position as usize).min(n.saturating_sub(2));
    let s = position - i as f64;
    let (before, after, second) = (s + 1.0, s - 1.0, s - 2.0);
    Some((
        i,
        [
            -s * after * second / 6.0,
            before * after * second / 2.0,
            -before * s * second / 2.0,
            before * s * after / 6.0,
        ],
    ))
}

/// The fraction of each cell of `grid` outside of the inner nodes' cells of `inner`, in node order.
pub(super) fn shares_outside<'a>(grid: &'a Grid, inner: &'a Grid) -> impl Iterator<Item = f64> + 'a {
    let share = |centre: f64, width: f64, [low, high]: [f64; 2]| {
        let (from, to) = ((centre - 0.5 * width).max(low), (centre + 0.5 * width).min(high));
        ((to - from) / width).clamp(0.0, 1.0)
    };
    let span = |first: f64, width: f64, n: usize| {
        let from = first + 0.5 * width;
        [from, from + (n - 2) as f64 * width]
    };
    let x_span = span(inner.x(0), inner.dx(), inner.nx());
    let y_span = (grid.ny() > 1).then(|| span(inner.y(0), inner.dy(), inner.ny()));
    grid.nodes().map(move |(x, y)| {
        let across = y_span.map_or(1.0, |y_span| share(y, grid.dy(), y_span));
        1.0 - share(x, grid.dx(), x_span) * across
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_interpolated_exactly_in_the_interior() {
        let grid = Grid::centred(12, 9, 0.1, 0.2).unwrap();
        let cubic = |x: f64, y: f64| 1.0 + x * x * x - 2.0 * x * y * y + y * y * y;
        let field: Vec<f64> = grid.nodes().map(|(x, y)| cubic(x, y)).collect();
        for (x, y) in [(0.013, 0.05), (-0.21, 0.33), (0.32, -0.4)] {
            let found = interpolate(&grid, &field, [x, y], false);
            assert!((found - cubic(x, y)).abs() < 1e-13, "{found} at {x} {y}");
        }
        assert!(interpolate(&grid, &field, [5.0, 0.0], false) == 0.0);
    }

    #[test]
    fn shares_outside_sum_to_the_area_outside() {
        let outer = Grid::centred(20, 16, 0.31, 0.27).unwrap();
        let inner = Grid::from_edges(10, 8, [-1.1, 0.7], [-0.6, 0.6]).unwrap();
        let area = shares_outside(&outer, &inner).sum::<f64>() * outer.cell_area();
        let inside = (1.8 - 2.0 * 0.18) * (1.2 - 2.0 * 0.15);
        assert!((area - (outer.size_x() * outer.size_y() - inside)).abs() < 1e-12);
    }
}
