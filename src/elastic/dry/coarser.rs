//! A dry contact on half of the cells per axis, as the start for the full grid.
//!
//! Cells are merged in pairs along each axis. Gaps, limits and pressures are averaged; the solution is
//! injected into the cells of the finer grid. The solver on the coarser grid starts from a coarser one
//! itself. The recursion ends below [`MIN_CELLS`] cells along an axis, or where the model exists on one grid
//! only.

use super::{DryProblem, DrySolver};
use crate::elastic::{DeformationModel, NEAR};
use crate::error::InputError;
use crate::grid::Grid;

/// Cells along an axis below which a grid is not coarsened.
const MIN_CELLS: usize = 32;
/// Gap error to which a coarser contact is solved; the interpolation error exceeds it on any mesh.
const TOLERANCE: f64 = 0.001;
/// Largest number of active-set passes on a coarser grid.
const PASSES: u64 = 40;

/// The contact on the coarser grid.
#[derive(Debug)]
pub(super) struct Coarser {
    /// Identity of the body on the finer grid.
    finer: BodyKey,
    /// The body on this grid.
    body: Box<dyn DeformationModel>,
    /// Its solver.
    solver: DrySolver,
    /// Undeformed gap \[m\].
    gap: Vec<f64>,
    /// Pressure limit \[Pa\].
    limit: Vec<f64>,
    /// Solution \[Pa\].
    pressure: Vec<f64>,
}

/// Identity of a body.
#[derive(Debug, PartialEq)]
struct BodyKey {
    /// Its grid.
    grid: Grid,
    /// First influence coefficients along x and along y \[m/Pa\].
    influence: [[f64; NEAR + 1]; 2],
}

impl BodyKey {
    /// The key of a body.
    fn new(body: &dyn DeformationModel) -> Self {
        let along_x = std::array::from_fn(|m| body.influence(m, 0));
        let along_y = std::array::from_fn(|m| body.influence(0, m));
        Self { grid: body.grid(), influence: [along_x, along_y] }
    }
}

/// Merges cells in pairs, along each axis with more than one cell. For an odd count the last coarse cell
/// extends beyond the edge; the rows of a strip, whose period it would change, are not merged.
fn coarsened(grid: &Grid) -> Option<Grid> {
    let halved = |n: usize| if n == 1 { 1 } else { n.div_ceil(2) };
    let (nx, ny) = (halved(grid.nx()), halved(grid.ny()));
    let is_odd_strip = grid.is_strip() && !grid.ny().is_multiple_of(2);
    if grid.nx() < MIN_CELLS || (grid.ny() > 1 && grid.ny() < MIN_CELLS) || is_odd_strip {
        return None;
    }
    let rows = if grid.ny() == 1 { 1.0 } else { 2.0 };
    let (left, bottom) = (grid.x(0) - 0.5 * grid.dx(), grid.y(0) - 0.5 * grid.dy());
    let (width, height) = (2.0 * grid.dx() * nx as f64, rows * grid.dy() * ny as f64);
    let make = if grid.is_strip() { Grid::strip } else { Grid::from_edges };
    make(nx, ny, [left, left + width], [bottom, bottom + height]).ok()
}

impl Coarser {
    /// `None` where the grid is small or the model exists on one grid only.
    fn new(finer: &dyn DeformationModel) -> Option<Self> {
        let grid = coarsened(&finer.grid())?;
        let body = finer.on_grid(grid)?;
        let zeros = || vec![0.0; grid.len()];
        Some(Self {
            finer: BodyKey::new(finer),
            body,
            solver: DrySolver::new(grid.len()),
            gap: zeros(),
            limit: zeros(),
            pressure: zeros(),
        })
    }

    /// Solves the averaged contact; returns convolutions in equivalents of the coarser grid.
    fn solve(
        &mut self,
        problem: &DryProblem<'_>,
        pressure: &[f64],
        tolerance: f64,
    ) -> Result<f64, InputError> {
        self.average(problem, pressure);
        let Self { body, solver, gap, limit, pressure, .. } = self;
        let limit = problem.limit.map(|_| limit.as_slice());
        let coarse = DryProblem { gap, load: problem.load, limit };
        let outcome = solver.solve(&coarse, body.as_mut(), pressure, tolerance.max(TOLERANCE), PASSES)?;
        Ok(outcome.convolutions)
    }

    /// Means of gaps, limits and pressures over the merged cells.
    fn average(&mut self, problem: &DryProblem<'_>, pressure: &[f64]) {
        let (fine, nx) = (self.finer.grid, self.body.grid().nx());
        for k in 0..self.gap.len() {
            let (mut n, mut gap, mut limit, mut sum) = (0.0, 0.0, 0.0, 0.0);
            for child in children(&fine, k % nx, k / nx) {
                n += 1.0;
                gap += problem.gap[child];
                limit += problem.limit_of(child);
                sum += pressure[child];
            }
            let share = 1.0 / n;
            (self.gap[k], self.limit[k], self.pressure[k]) = (gap * share, limit * share, sum * share);
        }
    }

    /// Copies the pressure of each coarse cell to its fine cells.
    fn inject(&self, pressure: &mut [f64]) {
        let (fine, nx) = (self.finer.grid, self.body.grid().nx());
        for (k, &p) in self.pressure.iter().enumerate() {
            for child in children(&fine, k % nx, k / nx) {
                pressure[child] = p;
            }
        }
    }
}

/// The nodes of the finer grid in cell `i`, `j` of the coarser one.
fn children(fine: &Grid, i: usize, j: usize) -> impl Iterator<Item = usize> {
    let (nx, ny) = (fine.nx(), fine.ny());
    let rows = if ny == 1 { j..j + 1 } else { 2 * j..(2 * j + 2).min(ny) };
    rows.flat_map(move |row| (2 * i..(2 * i + 2).min(nx)).map(move |column| row * nx + column))
}

impl DrySolver {
    /// Overwrites `pressure` with the solution on half of the cells; returns its cost in convolutions, zero
    /// where no coarser grid exists.
    pub(super) fn start_from_coarser(
        &mut self,
        problem: &DryProblem<'_>,
        deformation: &dyn DeformationModel,
        pressure: &mut [f64],
        tolerance: f64,
    ) -> Result<f64, InputError> {
        let fits = self.coarser.as_ref().is_some_and(|coarser| coarser.finer == BodyKey::new(deformation));
        if !fits {
            self.coarser = Coarser::new(deformation).map(Box::new);
        }
        let Some(coarser) = &mut self.coarser else { return Ok(0.0) };
        let convolutions = coarser.solve(problem, pressure, tolerance)?;
        coarser.inject(pressure);
        Ok(convolutions * coarser.gap.len() as f64 / pressure.len() as f64)
    }
}
