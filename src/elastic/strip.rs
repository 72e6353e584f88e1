//! The elastic half-space under loads that repeat across the flow, by FFTs.
//!
//! The grid is a [strip](Grid::strip): free along x, periodic along y. The mean over a period behaves as a line
//! load, whose displacement has no limit at infinity, hence the reference distance.

use std::f64::consts::PI;

use super::line::require_reference;
use super::response::ElasticResponse;
use super::{DeformationModel, NEAR, ResponseApproximations};
use crate::analytic::rectangle_potential;
use crate::error::InputError;
use crate::grid::Grid;

/// Periods on each side whose cells are summed one by one; the sum over all further ones is an integral.
const NEAR_PERIODS: i32 = 8;

/// Two half-spaces pressed together under a pressure that repeats along y with the period `W` of a strip.
///
/// A cell of a period acts together with its images,
/// `u(x, y) = 2/(pi E') lim [sum over |q| <= Q of f(x, y + q W) + 2 dx dy/W ln(reference/(2 Q W))]` with Love's potential
/// `f` of the cell. For the mean over a period this is [`LineHalfSpace`](super::LineHalfSpace), zero at the distance
/// `reference` from a line load; another reference shifts `u` and the approach only.
///
/// `E'` is the equivalent modulus, `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`. Cost: one forward and one inverse real FFT
/// of 2 N points for N nodes. Cloning shares the plan.
///
/// ```
/// use stribeck::Grid;
/// use stribeck::elastic::{DeformationModel, LineHalfSpace, StripHalfSpace};
/// let (x, y) = ([-1e-4, 1e-4], [-2e-5, 2e-5]);
/// let mut strip = StripHalfSpace::new(Grid::strip(64, 16, x, y)?, 230e9, 10e-3)?;
/// let mut line = LineHalfSpace::new(Grid::from_edges(64, 1, x, [-0.5, 0.5])?, 230e9, 10e-3)?;
/// // Equal rows deflect as a line contact.
/// let (mut rows, mut row) = ([0.0; 64 * 16], [0.0; 64]);
/// strip.displacement(&[1e9; 64 * 16], &mut rows)?;
/// line.displacement(&[1e9; 64], &mut row)?;
/// assert!((rows[8 * 64 + 20] / row[20] - 1.0).abs() < 1e-7);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone)]
pub struct StripHalfSpace {
    /// `E'` \[Pa\].
    equivalent_modulus: f64,
    /// Distance of zero displacement \[m\].
    reference: f64,
    /// Influence coefficients by rows and columns of offset \[m/Pa\].
    near: [[f64; NEAR + 1]; NEAR + 1],
    /// Convolution with all influence coefficients.
    response: ElasticResponse,
}

impl StripHalfSpace {
    /// Half-space under the strip `grid` with equivalent modulus `E'` \[Pa\] and displacements relative to those at
    /// the distance `reference` \[m\].
    ///
    /// # Errors
    /// A grid that is no strip. A modulus that is not finite and positive. A reference below the length of the strip,
    /// which would make the influence of distant nodes negative.
    pub fn new(grid: Grid, equivalent_modulus: f64, reference: f64) -> Result<Self, InputError> {
        require_strip(&grid, reference)?;
        InputError::require_positive("elastic.equivalent_modulus", equivalent_modulus)?;
        let (nx, ny) = (grid.nx(), grid.ny());
        let factor = 2.0 / (PI * equivalent_modulus);
        let mut table = Vec::with_capacity(nx * (ny / 2 + 1));
        for dj in 0..=ny / 2 {
            table.extend((0..nx).map(|di| factor * potential(&grid, reference, di, dj)));
        }
        let at = |di: usize, dj: usize| {
            let dj = dj % ny;
            table.get(dj.min(ny - dj) * nx + di).copied().filter(|_| di < nx).unwrap_or(0.0)
        };
        Ok(Self {
            equivalent_modulus,
            reference,
            near: std::array::from_fn(|dj| std::array::from_fn(|di| at(di, dj))),
            response: ElasticResponse::new(grid, |di, dj| at(di.unsigned_abs(), dj.unsigned_abs())),
        })
    }
}

/// Rejects grids whose rows do not repeat, and a reference below the length of the strip.
pub(super) fn require_strip(grid: &Grid, reference: f64) -> Result<(), InputError> {
    if grid.is_strip() {
        return require_reference(grid, reference);
    }
    Err(InputError::Conflict {
        field: "grid".to_owned(),
        reason: "its rows do not repeat; use Grid::strip".to_owned(),
    })
}

/// Potential \[m\] of a cell of `grid` and of its images at an offset of `di` columns and `dj` rows, up to half a
/// period.
pub(super) fn potential(grid: &Grid, reference: f64, di: usize, dj: usize) -> f64 {
    let half = [0.5 * grid.dx(), 0.5 * grid.dy()];
    let at = [grid.dx() * di as f64, grid.dy() * dj as f64];
    periods(grid, reference, (at, 0.0), NEAR_PERIODS, |x, y| rectangle_potential(x, y, half[0], half[1]))
}

/// The same at a `depth` \[m\] below the cells, above 0, by the potential `cell(x, y)` of one. At a distance of more than
/// [`NEAR_PERIODS`] all images but the cell itself are an integral.
pub(super) fn buried_potential(
    grid: &Grid,
    reference: f64,
    (di, dj): (usize, usize),
    depth: f64,
    cell: impl Fn(f64, f64) -> f64,
) -> f64 {
    let at = [grid.dx() * di as f64, grid.dy() * dj as f64];
    let is_far = at[0].hypot(depth) > f64::from(NEAR_PERIODS) * grid.size_y();
    periods(grid, reference, (at, depth), if is_far { 0 } else { NEAR_PERIODS }, cell)
}

/// Sum of the potential `cell(x, y)` \[m\] of a cell of `grid` and of its images at the offset `[x, y]` and `depth` \[m\]
/// from the cell. The sum over the images beyond `near` periods is that of point sources with the second moments of the
/// cell, by the Euler-Maclaurin formula at midpoints, up to the third derivative.
fn periods(
    grid: &Grid,
    reference: f64,
    ([x, y], depth): ([f64; 2], f64),
    near: i32,
    cell: impl Fn(f64, f64) -> f64,
) -> f64 {
    let (dx, dy, period) = (grid.dx(), grid.dy(), grid.size_y());
    let cells: f64 = (-near..=near).map(|q| cell(x, y + f64::from(q) * period)).sum();
    let beyond = |from: f64| {
        let r = x.hypot(depth).hypot(from);
        let third = 9.0 * from / r.powi(5) - 15.0 * from.powi(3) / r.powi(7);
        let (square, s) = (period * period, from + r);
        let moment = (x / r).powi(2) * (1.0 / r + 1.0 / s) - 1.0 / r;
        -s.ln() - (square - dy * dy) * from / (24.0 * r.powi(3)) + dx * dx * moment / (24.0 * s)
            - 7.0 * square * square / 5760.0 * third
    };
    let first = (f64::from(near) + 0.5) * period;
    cells + dx * dy / period * (2.0 * reference.ln() + beyond(first + y) + beyond(first - y))
}

impl DeformationModel for StripHalfSpace {
    fn grid(&self) -> Grid {
        self.response.grid
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.displacement(pressure, out)
    }

    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        let body = Self::new(grid, self.equivalent_modulus, self.reference.max(grid.size_x())).ok()?;
        Some(Box::new(body))
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        self.near.get(dj).and_then(|row| row.get(di)).copied().unwrap_or(0.0)
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        Some(&mut self.response)
    }
}
