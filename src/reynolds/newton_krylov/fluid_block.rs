//! How the fluid equations of a linear step are solved.

use std::fmt::Debug;

use crate::numerics::GridLu;

/// Solves the fluid equations in which films follow their own pressures alone: a matrix on the five-point
/// stencil, row `k` at `stencil[5 k..5 k + 5]` in the order centre, east, west, north, south.
pub(in crate::reynolds) trait FluidBlock: Debug + Send + Sync {
    /// Takes a new matrix; false where it has no finite factors.
    fn prepare(&mut self, stencil: &[f32]) -> bool;

    /// Puts the solution, or an estimate of it, in the place of the right-hand side.
    fn solve(&mut self, stencil: &[f32], rhs: &mut [f32]);

    /// Size of a row of this diagonal in the norm that Krylov's method lessens. What an estimate leaves grows
    /// with the diagonal, and would hide all other rows.
    fn row_size(&self, diagonal: f32) -> f32;
}

impl FluidBlock for GridLu {
    fn prepare(&mut self, stencil: &[f32]) -> bool {
        self.factorise(stencil)
    }

    fn solve(&mut self, _stencil: &[f32], rhs: &mut [f32]) {
        Self::solve(self, rhs);
    }

    /// All rows count alike: divided by their large diagonals, those of pockets would hardly do.
    fn row_size(&self, _diagonal: f32) -> f32 {
        1.0
    }
}
