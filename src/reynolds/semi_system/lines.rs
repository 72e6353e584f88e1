//! Relaxation of the semi-system by lines along x.
//!
//! It replaces the factorization in the preconditioner of Newton's method: a step is computed from the
//! linearized balances alone, line by line, with the neighboring lines fixed. Each line is a tridiagonal
//! system; its pivots are computed once per step and reused in all passes.

use crate::grid::Grid;
use crate::numerics::STENCIL;
use crate::reynolds::newton_krylov::FluidBlock;

/// Passes over all lines, up and down in turn. The pressure of fluid trapped between touching solids spreads
/// over the whole contact, line by line. Of 57 scenes of the stability map at 64 cells 48 converge with half
/// a pass per line and 51 with one and a half; a scene of 128 cells that stalls with 100 passes converges
/// with 300.
const PASSES_PER_LINE: u64 = 2;

/// Number of passes for `lines` lines; a single line is solved exactly by the first.
pub(super) fn passes(lines: usize) -> u64 {
    if lines == 1 { 1 } else { PASSES_PER_LINE * lines as u64 }
}

/// Symmetric line Gauss-Seidel; each line is solved by the Thomas algorithm, whose factors are reused in all
/// passes.
///
/// Where pressure flow into a node increases with its film, the diagonal of the row is smaller than its
/// couplings and the passes may diverge. If they grow until the first pass is below single-precision
/// rounding, the result of the first pass is returned.
#[derive(Debug)]
pub(super) struct LineBlock {
    /// Nodes in a line.
    nx: usize,
    /// Whether the first line is beside the last one.
    is_ring: bool,
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
        let (nx, is_ring) = (grid.nx(), grid.is_strip());
        Self { nx, is_ring, rhs: zeros(), pivot: zeros(), above: zeros(), first: zeros() }
    }

    /// Solves line `j` with the neighboring lines fixed.
    fn relax(&self, stencil: &[f32], values: &mut [f32], j: usize) {
        let nx = self.nx;
        let nodes = j * nx..(j + 1) * nx;
        let (before, rest) = values.split_at_mut(nodes.start);
        let (line, after) = rest.split_at_mut(nx);
        let rows = || stencil[STENCIL * nodes.start..STENCIL * nodes.end].chunks_exact(STENCIL);
        line.copy_from_slice(&self.rhs[nodes.clone()]);
        // Without a ring the first line has no southern neighbor, the last one no northern.
        let north = if after.is_empty() && self.is_ring { &*before } else { &*after };
        for ((value, row), north) in line.iter_mut().zip(rows()).zip(north) {
            *value -= row[3] * north;
        }
        let up_to_south = if before.is_empty() && self.is_ring { &*after } else { &*before };
        let south = &up_to_south[up_to_south.len().saturating_sub(nx)..];
        for ((value, row), south) in line.iter_mut().zip(rows()).zip(south) {
            *value -= row[4] * south;
        }
        // Thomas algorithm with the stored factors
        let mut last = 0.0;
        for ((value, row), pivot) in line.iter_mut().zip(rows()).zip(&self.pivot[nodes.clone()]) {
            last = (*value - row[2] * last) * pivot;
            *value = last;
        }
        // Back substitution.
        let mut next = 0.0;
        for (value, above) in line.iter_mut().zip(&self.above[nodes]).rev() {
            *value -= above * next;
            next = *value;
        }
    }
}

impl FluidBlock for LineBlock {
    fn prepare(&mut self, stencil: &[f32], _must_stop: &(dyn Fn() -> bool + Sync)) -> bool {
        let mut above = 0.0;
        for (k, row) in stencil.chunks_exact(STENCIL).enumerate() {
            if k % self.nx == 0 {
                above = 0.0;
            }
            // Factors of the Thomas algorithm, new on every line.
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
            // Gauss-Seidel over the lines, in alternating direction.
            for line in 0..lines {
                self.relax(stencil, rhs, if pass % 2 == 0 { line } else { lines - 1 - line });
            }
            let reached = size(rhs);
            // Growth beyond rounding of the first pass is divergence: return to that pass.
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

    /// Rows typical of pressure flow and entrainment to the east, weaker in every other line.
    fn rows(grid: &Grid) -> Vec<f32> {
        let nx = grid.nx();
        let mut stencil = Vec::with_capacity(STENCIL * grid.len());
        for k in 0..grid.len() {
            let (i, j) = (k % nx, k / nx);
            let [north, south] = [grid.north_of(k), grid.south_of(k)].map(|node| node.is_some());
            let flow = if j % 2 == 0 { 1.0 } else { 0.1 };
            let carried = 0.5;
            let beside = |inside: bool, value: f32| if inside { -value } else { 0.0 };
            stencil.extend([
                4.0 * flow + carried,
                beside(i + 1 < nx, flow),
                beside(i > 0, flow + carried),
                beside(north, flow),
                beside(south, flow),
            ]);
        }
        stencil
    }

    /// Rows whose couplings to the neighboring lines exceed their diagonals.
    #[test]
    fn divergent_passes_return_the_first() {
        let grid = Grid::from_edges(12, 9, [0.0, 1.0], [0.0, 1.0]).unwrap();
        let mut stencil = rows(&grid);
        for row in stencil.chunks_exact_mut(STENCIL) {
            row[0] = 0.5;
        }
        let mut relaxation = LineBlock::new(&grid);
        assert!(relaxation.prepare(&stencil, &|| false));
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
    fn passes_converge_to_the_solution() {
        let edges = [0.0, 1.0];
        let strip = Grid::strip(12, 9, edges, edges).unwrap();
        let plain = [9, 1].map(|ny| Grid::from_edges(12, ny, edges, edges).unwrap());
        for grid in plain.into_iter().chain([strip]) {
            let nx = grid.nx();
            let stencil = rows(&grid);
            let exact: Vec<f32> = (0..grid.len()).map(|k| (k as f32 * 0.7).sin()).collect();
            let product = |x: &[f32]| -> Vec<f32> {
                let at = |node: Option<usize>| node.map_or(0.0, |k| x[k]);
                let rows = stencil.chunks_exact(STENCIL).enumerate();
                rows.map(|(k, row)| {
                    row[0] * x[k]
                        + row[1] * at((k % nx + 1 < nx).then_some(k + 1))
                        + row[2] * at(k.checked_sub(1).filter(|_| k % nx > 0))
                        + row[3] * at(grid.north_of(k))
                        + row[4] * at(grid.south_of(k))
                })
                .collect()
            };
            let mut relaxation = LineBlock::new(&grid);
            assert!(relaxation.prepare(&stencil, &|| false));
            let (right, mut values) = (product(&exact), vec![0.0; grid.len()]);
            // A ring has no edges, which damp: it takes the passes twice.
            for _ in 0..if grid.is_strip() { 2 } else { 1 } {
                let image = product(&values);
                let mut change: Vec<f32> =
                    right.iter().zip(image).map(|(right, image)| right - image).collect();
                relaxation.solve(&stencil, &mut change);
                values.iter_mut().zip(&change).for_each(|(value, change)| *value += change);
            }
            for (k, (found, exact)) in values.iter().zip(&exact).enumerate() {
                assert!((found - exact).abs() < 1e-5, "node {k} of {grid:?}: {found} for {exact}");
            }
        }
    }
}
