//! Stress under one loaded cell, on a strip together with its images in all periods.

use std::f64::consts::PI;

use super::corners::COMPONENTS;
use crate::grid::Grid;

/// Periods on each side whose cells are summed one by one; the sum over all further ones is an integral.
const NEAR_PERIODS: usize = 4;

/// Distance from the cell at which antiderivatives have their limits, over the largest length of the sum.
const FAR: f64 = 1e9;

/// Six stress components.
type Stresses = [f64; COMPONENTS];

/// Stresses at one depth under a unit load on a cell of a grid, by offset.
pub(super) struct Rectangle {
    width: usize,
    /// Rows of a period; zero without periods.
    period: usize,
    /// `G/(2 pi)` at the cell corners, by rows and columns of offset.
    values: Vec<Stresses>,
    /// Sums over the images beyond [`NEAR_PERIODS`], as differences over the corners along x; by rows of offset, up to half
    /// a period. Empty without periods.
    beyond: Vec<Stresses>,
}

impl Rectangle {
    /// From the antiderivative `value(x, y)` along both axes.
    pub(super) fn new(grid: &Grid, value: impl Fn([f64; 2]) -> Stresses) -> Self {
        let (nx, ny) = (grid.nx(), grid.ny());
        let scaled = |at: [f64; 2]| value(at).map(|g| g / (2.0 * PI));
        let column = |i: usize| (i as f64 + 0.5) * grid.dx();
        let rows = if grid.is_strip() { (NEAR_PERIODS + 1) * ny } else { ny };
        let corner = |k: usize| scaled([column(k % nx), ((k / nx) as f64 + 0.5) * grid.dy()]);
        let values = (0..nx * rows).map(corner).collect();
        let offsets = if grid.is_strip() { nx * (ny / 2 + 1) } else { 0 };
        let beyond = |k: usize| beyond(grid, &scaled, [column(k % nx), (k / nx) as f64 * grid.dy()]);
        Self {
            width: nx,
            period: if grid.is_strip() { ny } else { 0 },
            values,
            beyond: (0..offsets).map(beyond).collect(),
        }
    }

    /// Stress `component` at an offset of columns and rows from the loaded cell, whose `G` is odd in x or y.
    pub(super) fn stress(&self, component: usize, parity: [bool; 2], [di, dj]: [isize; 2]) -> f64 {
        if self.period == 0 {
            return self.of_cell(component, parity, [di, dj]);
        }
        let (near, period) = (NEAR_PERIODS.cast_signed(), self.period.cast_signed());
        let cells = (-near..=near).map(|q| self.of_cell(component, parity, [di, dj + q * period]));
        // The sum over images is even along y where `G` is odd.
        let ([odd_x, odd_y], row) = (parity, dj.unsigned_abs() * self.width);
        let sign = if dj < 0 && !odd_y { -1.0 } else { 1.0 };
        let at = |i: isize| {
            let (i, mirror) = folded(i, odd_x);
            mirror * self.beyond[row + i][component]
        };
        cells.sum::<f64>() + sign * (at(di) - at(di - 1))
    }

    /// Stress under the cell alone.
    fn of_cell(&self, component: usize, [odd_x, odd_y]: [bool; 2], [di, dj]: [isize; 2]) -> f64 {
        let corner = |i: isize, j: isize| {
            let ((i, sign_x), (j, sign_y)) = (folded(i, odd_x), folded(j, odd_y));
            sign_x * sign_y * self.values[j * self.width + i][component]
        };
        (corner(di, dj) - corner(di - 1, dj)) - (corner(di, dj - 1) - corner(di - 1, dj - 1))
    }
}

/// Index and sign of corner `m`, which lies at `m + 1/2` cells; negative `m` mirror the others.
fn folded(m: isize, odd: bool) -> (usize, f64) {
    let mirrored = m < 0;
    let index = if mirrored { -m - 1 } else { m }.unsigned_abs();
    (index, if mirrored && odd { -1.0 } else { 1.0 })
}

/// Sum over the images of a cell of `grid` beyond [`NEAR_PERIODS`] on both sides at the corner column `x` and the row
/// offset `y` \[m\]: `dy/W` times the integral of the stress along y, by the Euler-Maclaurin formula at midpoints up to the
/// third derivative, with the even moments of the cell. `value` is the antiderivative along both axes.
fn beyond(grid: &Grid, value: &impl Fn([f64; 2]) -> Stresses, [x, y]: [f64; 2]) -> Stresses {
    let (dy, period) = (grid.dy(), grid.size_y());
    let first = (NEAR_PERIODS as f64 + 0.5) * period;
    let far = FAR * grid.size_x().max(first);
    let step = 0.25 * period;
    // Coefficients of the second and the fourth derivative, over the powers of the step.
    let (square, cell) = ((period / step).powi(2), (dy / step).powi(2));
    let second = (square - cell) / 24.0;
    let fourth = square * cell / 576.0 - 7.0 * square * square / 5760.0 - cell * cell / 1920.0;
    let end = |y: f64| {
        let [a, b, at, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|steps| value([x, y + steps * step]));
        std::array::from_fn::<_, COMPONENTS, _>(|c| {
            let (twice, four) =
                (b[c] - 2.0 * at[c] + d[c], a[c] - 4.0 * b[c] + 6.0 * at[c] - 4.0 * d[c] + e[c]);
            at[c] - second * (twice - four / 12.0) - fourth * four
        })
    };
    let (limits, ends) = ([-far, far].map(|y| value([x, y])), [end(y - first), end(y + first)]);
    std::array::from_fn(|c| dy / period * ((limits[1][c] - ends[1][c]) + (ends[0][c] - limits[0][c])))
}
