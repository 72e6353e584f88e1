//! Linear systems on the stencil of the grid, solved to double precision.
//!
//! A system on one row is tridiagonal and eliminated directly. Others are factorized in single precision and
//! refined with residuals in double precision, until the residual is 1e-13 of the right-hand side or stops
//! halving.

use crate::grid::Grid;
use crate::numerics::{GridLu, STENCIL, solve_tridiagonal};

/// Relative residual of an accepted solution.
const TOLERANCE: f64 = 1e-13;
/// Largest number of refinement steps.
const MAX_REFINEMENTS: usize = 40;
/// Refinement stops after a step that leaves more than this share of the residual.
const STAGNANT: f64 = 0.5;

/// Solver for matrices on the five-point stencil of a grid.
#[derive(Debug)]
pub(super) struct LinearSolver {
    /// Nodes in a row.
    nx: usize,
    /// Elimination method, by the shape of the grid.
    method: Method,
    /// Residual of the current solution.
    residual: Vec<f64>,
}

/// Elimination methods.
#[derive(Debug)]
enum Method {
    /// Tridiagonal elimination of a single row.
    Row { below: Vec<f64>, diagonal: Vec<f64>, above: Vec<f64> },
    /// Nested dissection in single precision, with refinement.
    Plane { lu: Box<GridLu>, stencil: Vec<f32>, rhs: Vec<f32> },
}

impl LinearSolver {
    /// Buffers and order of elimination for `grid`.
    pub(super) fn new(grid: Grid) -> Self {
        let n = grid.len();
        let method = if grid.ny() == 1 {
            Method::Row { below: vec![0.0; n], diagonal: vec![0.0; n], above: vec![0.0; n] }
        } else {
            let lu = Box::new(GridLu::new(grid.nx(), grid.ny()));
            Method::Plane { lu, stencil: vec![0.0; STENCIL * n], rhs: vec![0.0; n] }
        };
        Self { nx: grid.nx(), method, residual: vec![0.0; n] }
    }

    /// Solves `A x = rhs` with row `k` of `A` at `stencil[5 k..5 k + 5]`: center, east, west, north, south.
    /// Returns the number of substitutions, or `None` if the factorization fails.
    pub(super) fn solve(&mut self, stencil: &[f64], rhs: &[f64], x: &mut [f64]) -> Option<u64> {
        let Self { nx, method, residual } = self;
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
            Method::Plane { lu, stencil: single, rhs: part } => {
                // A plane: factorize in single precision.
                for (single, value) in single.iter_mut().zip(stencil) {
                    *single = *value as f32;
                }
                if !lu.factorise(single) {
                    return None;
                }
                x.fill(0.0);
                residual.copy_from_slice(rhs);
                let start = norm(residual);
                let mut left = start;
                let mut substitutions = 0;
                // Iterative refinement with residuals in double precision.
                for _ in 0..MAX_REFINEMENTS {
                    if left <= TOLERANCE * start {
                        break;
                    }
                    for (part, residual) in part.iter_mut().zip(&*residual) {
                        *part = (residual / left) as f32;
                    }
                    lu.solve(part);
                    substitutions += 1;
                    for (x, part) in x.iter_mut().zip(&*part) {
                        *x += left * f64::from(*part);
                    }
                    subtract_product(stencil, *nx, x, rhs, residual);
                    let before = left;
                    left = norm(residual);
                    if left > STAGNANT * before || !left.is_finite() {
                        break;
                    }
                }
                left.is_finite().then_some(substitutions)
            }
        }
    }
}

/// Euclidean norm.
fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// `out = rhs - A x`.
fn subtract_product(stencil: &[f64], nx: usize, x: &[f64], rhs: &[f64], out: &mut [f64]) {
    let at = |k: Option<usize>| k.and_then(|k| x.get(k)).copied().unwrap_or(0.0);
    for (k, ((row, rhs), out)) in stencil.chunks_exact(STENCIL).zip(rhs).zip(out).enumerate() {
        let around = row[1] * at(Some(k + 1))
            + row[2] * at(k.checked_sub(1))
            + row[3] * at(Some(k + nx))
            + row[4] * at(k.checked_sub(nx));
        *out = rhs - row[0] * x[k] - around;
    }
}
