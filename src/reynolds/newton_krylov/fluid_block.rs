//! How the fluid equations of a linear step are solved, and what goes with it.

use std::fmt::Debug;

use super::attempt::Attempt;
use crate::grid::Grid;
use crate::numerics::GridLu;

/// Solves the fluid equations in which films follow their own pressures alone: a matrix on the five-point stencil, row `k` at
/// `stencil[5 k..5 k + 5]` in the order centre, east, west, north, south.
pub(in crate::reynolds) trait FluidBlock: Debug + Send {
    /// Takes a new matrix; false where it has no finite factors.
    fn prepare(&mut self, stencil: &[f32]) -> bool;

    /// Puts the solution, or an estimate of it, in the place of the right-hand side.
    fn solve(&mut self, stencil: &[f32], rhs: &mut [f32]);
}

impl FluidBlock for GridLu {
    fn prepare(&mut self, stencil: &[f32]) -> bool {
        self.factorise(stencil)
    }

    fn solve(&mut self, _stencil: &[f32], rhs: &mut [f32]) {
        Self::solve(self, rhs);
    }
}

/// How a solve goes about its linear and its nonlinear equations.
#[derive(Debug, Clone, Copy)]
pub(in crate::reynolds) struct Method {
    pub(in crate::reynolds) fluid_block: fn(&Grid) -> Box<dyn FluidBlock>,
    /// Directions that one pass of a linear solve combines, and such passes.
    pub(in crate::reynolds) directions: usize,
    pub(in crate::reynolds) passes: u32,
    pub(in crate::reynolds) attempts: &'static [Attempt],
    /// Whether a contact that stalls in all of them is followed in time.
    pub(in crate::reynolds) follows_time: bool,
}
