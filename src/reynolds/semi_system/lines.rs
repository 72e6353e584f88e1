//! Relaxation of the semi-system by lines along x.
//!
//! It stands where Newton's method has its factorisation: a change is found from the linearised balances
//! alone, line by line, each with the lines beside it held. A line is a tridiagonal system; its pivots are
//! made once a step and serve all passes.

use crate::grid::Grid;
use crate::numerics::STENCIL;
use crate::reynolds::newton_krylov::FluidBlock;

/// Passes over all lines, for each line one up and one down. The pressure of fluid between solids that touch
/// spreads over the whole contact, line by line: of 57 scenes of the stability map at 64 cells 48 converge
/// with half a pass a line, 51 with one and a half; a scene of 128 cells that stalls with 100 passes
/// converges with 300.
const PASSES_PER_LINE: u64 = 2;

/// Passes in which `lines` lines are relaxed; a single one is solved by the first.
pub(super) fn passes(lines: usize) -> u64 {
    if lines == 1 { 1 } else { PASSES_PER_LINE * lines as u64 }
}

/// Gauss-Seidel from line to line, up and down by turns; each line is solved at once by the Thomas algorithm,
/// whose factors serve all passes.
///
/// Where pressure flow into a node grows with its film the diagonal of its row is less than its couplings, and
/// passes may grow without bound. Where they have grown until the first of them is lost in the rounding of
/// single precision, that one alone is taken.
#[derive(Debug)]
pub(super) struct LineBlock {
    /// Nodes in a line.
    nx: usize,
    /// Right-hand side.
    rhs: Vec<f32>,
    /// One over the pivot of each node.
    pivot: Vec<f32>,
    /// Entry to the east over the pivot.
    above: Vec<f32>,
    /// Values after the first pass.
    first: Vec<f32>,
}

impl LineBlock {
    /// Buffers for `grid`.
    pub(super) fn new(grid: &Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        Self { nx: grid.nx(), rhs: zeros(), pivot: zeros(), above: zeros(), first: zeros() }
    }

    /// Solves line `j` for the values of the lines beside it.
    fn relax(&self, stencil: &[f32], values: &mut [f32], j: usize) {
        let nx = self.nx;
        let nodes = j * nx..(j + 1) * nx;
        let (before, rest) = values.split_at_mut(nodes.start);
        let (line, after) = rest.split_at_mut(nx);
        let rows = || stencil[STENCIL * nodes.start..STENCIL * nodes.end].chunks_exact(STENCIL);
        line.copy_from_slice(&self.rhs[nodes.clone()]);
        // The first line has none before it, the last one none after it.
        for ((value, row), north) in line.iter_mut().zip(rows()).zip(&*after) {
            *value -= row[3] * north;
        }
        let south = &before[before.len().saturating_sub(nx)..];
        for ((value, row), south) in line.iter_mut().zip(rows()).zip(south) {
            *value -= row[4] * south;
        }
        let mut last = 0.0;
        for ((value, row), pivot) in line.iter_mut().zip(rows()).zip(&self.pivot[nodes.clone()]) {
            last = (*value - row[2] * last) * pivot;
            *value = last;
        }
        let mut next = 0.0;
        for (value, above) in line.iter_mut().zip(&self.above[nodes]).rev() {
            *value -= above * next;
            next = *value;
        }
    }
}

impl FluidBlock for LineBlock {
    fn prepare(&mut self, stencil: &[f32]) -> bool {
        let mut above = 0.0;
        for (k, row) in stencil.chunks_exact(STENCIL).enumerate() {
            if k % self.nx == 0 {
                above = 0.0;
            }
            let pivot = 1.0 / (row[0] - row[2] * above);
            above = row[1] * pivot;
            (self.pivot[k], self.above[k]) = (pivot, above);
        }
        self.pivot.iter().chain(&self.above).all(|factor| factor.is_finite())
    }

    fn solve(&mut self, stencil: &[f32], rhs: &mut [f32]) {
        self.rhs.copy_from_slice(rhs);
        rhs.fill(0.0);
        let lines = rhs.len() / self.nx;
        let size = |values: &[f32]| values.iter().map(|value| value.abs()).sum::<f32>();
        let mut largest = f32::MAX;
        for pass in 0..passes(lines) {
            for line in 0..lines {
                self.relax(stencil, rhs, if pass % 2 == 0 { line } else { lines - 1 - line });
            }
            let reached = size(rhs);
            if pass == 0 {
                self.first.copy_from_slice(rhs);
                largest = reached / f32::EPSILON;
            } else if reached > largest || reached.is_nan() {
                rhs.copy_from_slice(&self.first);
                break;
            }
        }
    }

    fn row_size(&self, diagonal: f32) -> f32 {
        diagonal.abs().max(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows that pressure flow and entrainment to the east would have, weaker in every other line.
    fn rows(grid: &Grid) -> Vec<f32> {
        let (nx, ny) = (grid.nx(), grid.ny());
        let mut stencil = Vec::with_capacity(STENCIL * grid.len());
        for k in 0..grid.len() {
            let (i, j) = (k % nx, k / nx);
            let flow = if j % 2 == 0 { 1.0 } else { 0.1 };
            let carried = 0.5;
            let beside = |inside: bool, value: f32| if inside { -value } else { 0.0 };
            stencil.extend([
                4.0 * flow + carried,
                beside(i + 1 < nx, flow),
                beside(i > 0, flow + carried),
                beside(j + 1 < ny, flow),
                beside(j > 0, flow),
            ]);
        }
        stencil
    }

    /// Rows whose couplings to the lines beside them exceed their diagonals.
    #[test]
    fn passes_that_grow_without_bound_leave_the_first() {
        let grid = Grid::from_edges(12, 9, [0.0, 1.0], [0.0, 1.0]).unwrap();
        let mut stencil = rows(&grid);
        for row in stencil.chunks_exact_mut(STENCIL) {
            row[0] = 0.5;
        }
        let mut relaxation = LineBlock::new(&grid);
        assert!(relaxation.prepare(&stencil));
        let mut values = vec![1.0; grid.len()];
        relaxation.solve(&stencil, &mut values);
        let mut first = vec![0.0; grid.len()];
        for line in 0..grid.ny() {
            relaxation.relax(&stencil, &mut first, line);
        }
        assert_eq!(values, first);
        assert!(values.iter().all(|value| value.is_finite() && value.abs() > 0.0), "{values:?}");
    }

    #[test]
    fn passes_solve_the_rows() {
        for (nx, ny) in [(12, 9), (12, 1)] {
            let grid = Grid::from_edges(nx, ny, [0.0, 1.0], [0.0, 1.0]).unwrap();
            let stencil = rows(&grid);
            let exact: Vec<f32> = (0..grid.len()).map(|k| (k as f32 * 0.7).sin()).collect();
            let at = |k: usize, inside: bool, step: isize| {
                if inside { exact[k.wrapping_add_signed(step)] } else { 0.0 }
            };
            let mut values: Vec<f32> = (0..grid.len())
                .map(|k| {
                    let (i, j, row) = (k % nx, k / nx, &stencil[STENCIL * k..][..STENCIL]);
                    row[0] * exact[k]
                        + row[1] * at(k, i + 1 < nx, 1)
                        + row[2] * at(k, i > 0, -1)
                        + row[3] * at(k, j + 1 < ny, nx as isize)
                        + row[4] * at(k, j > 0, -(nx as isize))
                })
                .collect();
            let mut relaxation = LineBlock::new(&grid);
            assert!(relaxation.prepare(&stencil));
            relaxation.solve(&stencil, &mut values);
            for (k, (found, exact)) in values.iter().zip(&exact).enumerate() {
                assert!((found - exact).abs() < 1e-5, "node {k} of {nx} x {ny}: {found} for {exact}");
            }
        }
    }
}
