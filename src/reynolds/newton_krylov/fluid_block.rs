//! Solvers of the fluid equations of a linear step.

use std::fmt::Debug;

use crate::grid::Grid;
use crate::numerics::{GridLu, Periodicity};

/// Solves the fluid equations in which films respond to their own pressures alone: a matrix on the five-point
/// stencil, row `k` at `stencil[5 k..5 k + 5]` in the order center, east, west, north, south. On a strip the first row
/// of nodes is north of the last one.
pub(crate) trait FluidBlock: Debug + Send + Sync {
    /// Factorizes a new matrix; false where it has no finite factors or `must_stop` becomes true.
    fn prepare(&mut self, stencil: &[f32], must_stop: &(dyn Fn() -> bool + Sync)) -> bool;

    /// Overwrites the right-hand side with the solution or an estimate of it.
    fn solve(&mut self, stencil: &[f32], rhs: &mut [f32]);

    /// Size of a row with this diagonal in the norm that the Krylov method minimizes. The residual of an estimate
    /// grows with the diagonal and would hide all other rows.
    fn row_size(&self, diagonal: f32) -> f32;
}

/// The sparse LU factorization for matrices on `grid`.
pub(super) fn lu_of(grid: &Grid) -> GridLu<f32> {
    let periodicity = if grid.is_strip() { Periodicity::AlongY } else { Periodicity::None };
    GridLu::new(grid.nx(), grid.ny(), periodicity)
}

impl FluidBlock for GridLu<f32> {
    fn prepare(&mut self, stencil: &[f32], must_stop: &(dyn Fn() -> bool + Sync)) -> bool {
        self.factorise_unless(stencil, must_stop)
    }

    fn solve(&mut self, _stencil: &[f32], rhs: &mut [f32]) {
        Self::solve(self, rhs);
    }

    /// All rows have the same weight: divided by their large diagonals, those of isolated regions would vanish.
    fn row_size(&self, _diagonal: f32) -> f32 {
        1.0
    }
}
