//! Linear systems on the stencil of the grid, solved to double precision.
//!
//! A system on one row is tridiagonal and eliminated directly. Others are factorized in single precision and
//! refined with residuals in double precision. Fluid that contacts enclose has couplings of 1e-9 to its
//! surroundings, which single precision loses: from the first system on whose refinement stagnates, all are
//! factorized in double precision.

use crate::grid::Grid;
use crate::numerics::{GridLu, Neighbors, Periodicity, STENCIL, solve_tridiagonal};

/// Relative residual of an accepted solution.
const TOLERANCE: f64 = 1e-13;
/// Largest relative residual of a solution in single precision.
const SINGLE_TOLERANCE: f64 = 1e-8;
/// Largest number of refinement steps.
const MAX_REFINEMENTS: usize = 40;
/// Refinement stops after a step that leaves more than this share of the residual.
const STAGNANT: f64 = 0.5;

/// Solver for matrices on the five-point stencil of a grid.
#[derive(Debug)]
pub(super) struct LinearSolver {
    /// The grid of the unknowns.
    grid: Grid,
    /// The axis along which it repeats.
    periodicity: Periodicity,
    /// Elimination method, by the shape of the grid and the matrices so far.
    method: Method,
    /// Residual of the current solution.
    residual: Vec<f64>,
}

/// Elimination methods.
#[derive(Debug)]
enum Method {
    /// Tridiagonal elimination of a single row.
    Row { below: Vec<f64>, diagonal: Vec<f64>, above: Vec<f64> },
    /// Nested dissection in single precision.
    Single { lu: Box<GridLu<f32>>, stencil: Vec<f32>, part: Vec<f32> },
    /// Nested dissection in double precision.
    Double { lu: Box<GridLu<f64>>, part: Vec<f64> },
}

impl LinearSolver {
    /// Buffers and order of elimination for `grid`, which may repeat along one axis.
    pub(super) fn new(grid: Grid, periodicity: Periodicity) -> Self {
        let n = grid.len();
        let method = if grid.ny() == 1 {
            Method::Row { below: vec![0.0; n], diagonal: vec![0.0; n], above: vec![0.0; n] }
        } else {
            let lu = Box::new(GridLu::new(grid.nx(), grid.ny(), periodicity));
            Method::Single { lu, stencil: vec![0.0; STENCIL * n], part: vec![0.0; n] }
        };
        Self { grid, periodicity, method, residual: vec![0.0; n] }
    }

    /// Solves `A x = rhs` with row `k` of `A` at `stencil[5 k..5 k + 5]`: center, east, west, north, south.
    /// Returns the number of substitutions, or `None` if the factorization fails.
    pub(super) fn solve(&mut self, stencil: &[f64], rhs: &[f64], x: &mut [f64]) -> Option<u64> {
        let Self { grid, periodicity, method, residual } = self;
        let product = Product { stencil, neighbors: Neighbors::new(grid.nx(), grid.ny(), *periodicity) };
        match method {
            Method::Row { below, diagonal, above } => {
                // A single row: the Thomas algorithm.
                for (k, row) in stencil.chunks_exact(STENCIL).enumerate() {
                    (diagonal[k], above[k], below[k]) = (row[0], row[1], row[2]);
                }
                x.copy_from_slice(rhs);
                solve_tridiagonal(below, diagonal, above, x);
                x.iter().all(|x| x.is_finite()).then_some(1)
            }
            Method::Single { lu, stencil: single, part } => {
                for (single, value) in single.iter_mut().zip(stencil) {
                    *single = *value as f32;
                }
                let refined = lu.factorise(single).then(|| {
                    refine(product, rhs, [x, residual], |residual, scale, x| {
                        for (part, residual) in part.iter_mut().zip(residual) {
                            *part = (residual / scale) as f32;
                        }
                        lu.solve(part);
                        for (x, part) in x.iter_mut().zip(&*part) {
                            *x += scale * f64::from(*part);
                        }
                    })
                });
                if let Some((substitutions, left)) = refined
                    && left <= SINGLE_TOLERANCE
                {
                    return Some(substitutions);
                }
                // Lost couplings: double precision from here on.
                let lu = Box::new(GridLu::new(grid.nx(), grid.ny(), *periodicity));
                self.method = Method::Double { lu, part: vec![0.0; grid.len()] };
                self.solve(stencil, rhs, x)
            }
            Method::Double { lu, part } => {
                if !lu.factorise(stencil) {
                    return None;
                }
                let (substitutions, left) = refine(product, rhs, [x, residual], |residual, scale, x| {
                    for (part, residual) in part.iter_mut().zip(residual) {
                        *part = residual / scale;
                    }
                    lu.solve(part);
                    for (x, part) in x.iter_mut().zip(&*part) {
                        *x += scale * part;
                    }
                });
                left.is_finite().then_some(substitutions)
            }
        }
    }
}

/// Iterative refinement from zero: `correct` adds the approximate solution for a residual of the given norm. Returns the
/// number of corrections and the norm of the residual over that of the right-hand side.
fn refine(
    product: Product<'_>,
    rhs: &[f64],
    [x, residual]: [&mut [f64]; 2],
    mut correct: impl FnMut(&[f64], f64, &mut [f64]),
) -> (u64, f64) {
    x.fill(0.0);
    residual.copy_from_slice(rhs);
    let start = norm(residual);
    let (mut left, mut corrections) = (start, 0);
    for _ in 0..MAX_REFINEMENTS {
        if left <= TOLERANCE * start {
            break;
        }
        correct(residual, left, x);
        corrections += 1;
        product.subtract(x, rhs, residual);
        let before = left;
        left = norm(residual);
        if left > STAGNANT * before || !left.is_finite() {
            break;
        }
    }
    (corrections, if start > 0.0 { left / start } else { 0.0 })
}

/// Euclidean norm.
fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// The matrix of a stencil.
#[derive(Debug, Clone, Copy)]
struct Product<'a> {
    /// Rows: center, east, west, north, south.
    stencil: &'a [f64],
    /// Nodes of the stencils; entries across an edge are zero.
    neighbors: Neighbors,
}

impl Product<'_> {
    /// `out = rhs - A x`.
    fn subtract(self, x: &[f64], rhs: &[f64], out: &mut [f64]) {
        for (k, ((row, rhs), out)) in self.stencil.chunks_exact(STENCIL).zip(rhs).zip(out).enumerate() {
            let term = |slot: usize| row[slot] * x.get(self.neighbors.at(k, slot)).copied().unwrap_or(0.0);
            *out = rhs - row[0] * x[k] - (term(1) + term(2) + term(3) + term(4));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Conduction on 24 x 24 nodes, whose edges lose heat. The square in their middle conducts to its
    /// surroundings by `coupling`.
    fn with_enclosed_square(coupling: f64) -> (Grid, Vec<f64>) {
        let n = 24;
        let grid = Grid::from_edges(n, n, [0.0, 1.0], [0.0, 1.0]).unwrap();
        let is_enclosed = |i: usize, j: usize| (8..16).contains(&i) && (8..16).contains(&j);
        let mut stencil = vec![0.0; STENCIL * n * n];
        for (k, row) in stencil.chunks_exact_mut(STENCIL).enumerate() {
            let (i, j) = (k % n, k / n);
            let around = [(i + 1, j), (i.wrapping_sub(1), j), (i, j + 1), (i, j.wrapping_sub(1))];
            for (entry, (a, b)) in (1..).zip(around) {
                let conductance = if is_enclosed(i, j) == is_enclosed(a, b) { 1.0 } else { coupling };
                row[0] += conductance;
                row[entry] = if a < n && b < n { -conductance } else { 0.0 };
            }
        }
        (grid, stencil)
    }

    #[test]
    fn weakly_coupled_regions_are_solved_in_double_precision() {
        for (coupling, is_single) in [(1.0, true), (1e-3, true), (1e-9, false)] {
            let (grid, stencil) = with_enclosed_square(coupling);
            // A unit source in the square leaves it through its boundary.
            let mut rhs = vec![0.0; grid.len()];
            rhs[24 * 12 + 12] = 1.0;
            let mut solver = LinearSolver::new(grid, Periodicity::None);
            let mut x = vec![0.0; grid.len()];
            solver.solve(&stencil, &rhs, &mut x).unwrap();
            let lost = (8..16).flat_map(|j| {
                [(8, 7), (15, 16)].map(|(inside, outside)| {
                    let along = x[24 * j + inside] - x[24 * j + outside];
                    let across = x[24 * inside + j] - x[24 * outside + j];
                    coupling * (along + across)
                })
            });
            let lost: f64 = lost.sum();
            assert!((lost - 1.0).abs() < 1e-6, "coupling {coupling}: {lost} of 1 leaves the square");
            assert_eq!(matches!(solver.method, Method::Single { .. }), is_single, "coupling {coupling}");
        }
    }
}
