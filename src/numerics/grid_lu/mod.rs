//! Sparse LU factorization on the five-point stencil of a grid, for repeated factorizations with reused
//! buffers.
//!
//! The method is multifrontal elimination in nested-dissection order, without pivoting: in single precision as a
//! preconditioner, in double precision for fluid that is weakly coupled to its surroundings. Decoupled nodes,
//! with a diagonal row and column, cost one division.
//!
//! `dissection` divides the grid into two subdomains and a separator between them, recursively. The
//! subdomains are independent until their separator is eliminated, so subtrees are factorized in parallel
//! (`tree`, `traversal`); the columns of the products of the last fronts are divided between threads
//! (`division`). `structure` computes the fronts for the sparsity pattern of each matrix. The elimination of a
//! front is work on small dense blocks (`front`, `dense`): a front with the pivot block `P`, the block `B`
//! below and `C` beside it passes the update matrix (Schur complement) `-B P^-1 C` to its parent. With `n`
//! coupled nodes a factorization costs `O(n^1.5)` operations and `O(n log n)` memory, a solve `O(n log n)`.
//!
//! Rows are scaled to a largest entry of one. Small pivots are perturbed ([`Real::STATIC_PIVOT`], static
//! pivoting).

mod dense;
mod dissection;
mod division;
mod front;
mod real;
mod structure;
mod traversal;
mod tree;

use std::fmt;

use dense::perturbed_pivot;
use real::Real;
use structure::DECOUPLED;
use tree::Tree;

use super::lines::map_nodes;
use super::parallel::chunk_count;

/// Number of entries in a row of the five-point stencil: center, east, west, north, south.
pub(crate) const STENCIL: usize = 5;

/// LU factorization of a matrix that couples each node of an `nx` x `ny` grid to its four neighbors.
pub(crate) struct GridLu<T> {
    /// Fronts, factors and vectors.
    tree: Tree<T>,
    /// Reciprocal of the largest entry of each row, divided by the pivot for decoupled nodes.
    scale: Vec<T>,
    /// Couplings of each node to its neighbors, by an entry in either row: one bit for each slot.
    couplings: Vec<u8>,
    /// Whether the last factorization succeeded.
    factorised: bool,
}

/// A matrix with row scaling.
#[derive(Debug, Clone, Copy)]
struct Matrix<'a, T> {
    stencil: &'a [T],
    scale: &'a [T],
}

impl<T: Real> Matrix<'_, T> {
    /// Scaled entry at index `at` of the stencils.
    #[inline(always)]
    fn entry(&self, at: usize) -> T {
        self.stencil[at] * self.scale[at / STENCIL]
    }
}

impl<T> fmt::Debug for GridLu<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("GridLu").field("rows", &self.scale.len()).finish_non_exhaustive()
    }
}

impl<T: Real> GridLu<T> {
    /// Elimination order and buffers for a grid.
    pub(crate) fn new(nx: usize, ny: usize) -> Self {
        let n = nx * ny;
        Self {
            tree: Tree::new(nx, ny, chunk_count(n)),
            scale: vec![T::one(); n],
            couplings: vec![0; n],
            factorised: false,
        }
    }

    /// Factorizes the matrix with row `k` in `stencil[5 k..5 k + 5]`, in the order center, east, west, north,
    /// south. Entries that point outside the grid must be zero. Returns whether all pivots are finite.
    pub(crate) fn factorise(&mut self, stencil: &[T]) -> bool {
        self.factorise_unless(stencil, &|| false)
    }

    /// As [`factorise`](Self::factorise); false also where `must_stop` becomes true, which is polled before each
    /// large front.
    pub(crate) fn factorise_unless(&mut self, stencil: &[T], must_stop: &(dyn Fn() -> bool + Sync)) -> bool {
        map_nodes(&mut self.scale, |node, scale| {
            let row = &stencil[STENCIL * node..][..STENCIL];
            let largest = row.iter().fold(T::zero(), |m, v| if v.abs() > m { v.abs() } else { m });
            *scale = if largest > T::zero() { T::one() / largest } else { T::one() };
        });
        let offsets = self.tree.structure.offsets;
        let has_entry = |node: usize, slot: usize| {
            let row = node.checked_mul(STENCIL).and_then(|start| stencil.get(start..start + STENCIL));
            row.is_some_and(|row| row[slot + 1] != T::zero())
        };
        map_nodes(&mut self.couplings, |node, couplings| {
            let is_coupled = |slot: usize| {
                has_entry(node, slot) || has_entry(node.wrapping_add_signed(offsets[slot + 1]), slot ^ 1)
            };
            *couplings = (0..4).map(|slot| u8::from(is_coupled(slot)) << slot).sum();
        });
        self.tree.update(|node, slot| self.couplings[node] >> slot & 1 == 1);
        let matrix = Matrix { stencil, scale: &self.scale };
        let is_finite = self.tree.eliminate(matrix, must_stop) && self.eliminate_decoupled(stencil);
        self.factorised = is_finite;
        is_finite
    }

    /// Divides the row scale of decoupled nodes by their pivot; returns whether the pivots are finite.
    fn eliminate_decoupled(&mut self, stencil: &[T]) -> bool {
        let mut is_finite = true;
        let rows = stencil.chunks_exact(STENCIL).zip(&mut self.scale).zip(&self.tree.structure.rank);
        for ((row, scale), _) in rows.filter(|(_, rank)| **rank == DECOUPLED) {
            let pivot = perturbed_pivot(row[0] * *scale);
            is_finite &= pivot.is_finite();
            *scale /= pivot;
        }
        is_finite
    }

    /// Solves in place; without a factorization the right-hand side is unchanged.
    pub(crate) fn solve(&mut self, rhs: &mut [T]) {
        if !self.factorised {
            return;
        }
        for (value, scale) in rhs.iter_mut().zip(&self.scale) {
            *value *= *scale;
        }
        self.tree.solve(rhs);
    }
}

#[cfg(test)]
mod tests {
    use faer::prelude::Solve;
    use faer::{Col, Mat};

    use super::*;

    /// A diagonally dominant, unsymmetric matrix without entries that leave the grid; some nodes are
    /// decoupled.
    fn matrix(nx: usize, ny: usize) -> Vec<f32> {
        let mut seed = 3_u64;
        let mut noise = move || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 40) as f32 / (1_u64 << 24) as f32
        };
        let alone = |k: usize| k % 7 == 3 || k % nx > nx / 2;
        let mut stencil = vec![0.0; STENCIL * nx * ny];
        for (k, row) in stencil.chunks_exact_mut(STENCIL).enumerate() {
            let (i, j) = (k % nx, k / nx);
            let inside = [i + 1 < nx, i > 0, j + 1 < ny, j > 0];
            let nodes = [k + 1, k.wrapping_sub(1), k + nx, k.wrapping_sub(nx)];
            for slot in 0..4 {
                if inside[slot] && !alone(k) && !alone(nodes[slot]) {
                    row[slot + 1] = -noise();
                }
            }
            row[0] = 0.1 + row[1..].iter().map(|v| v.abs()).sum::<f32>();
            let unit = 10.0_f32.powf(6.0 * noise() - 20.0);
            row.iter_mut().for_each(|v| *v *= unit);
        }
        stencil
    }

    fn product(stencil: &[f32], nx: usize, x: &[f64]) -> Vec<f32> {
        let at = |k: usize, offset: isize| x.get(k.wrapping_add_signed(offset)).copied().unwrap_or(0.0);
        let nx = nx as isize;
        let offsets = [0, 1, -1, nx, -nx];
        stencil
            .chunks_exact(STENCIL)
            .enumerate()
            .map(|(k, row)| {
                row.iter().zip(offsets).map(|(v, o)| f64::from(*v) * at(k, o)).sum::<f64>() as f32
            })
            .collect()
    }

    #[test]
    fn solves_on_grids_of_any_shape() {
        for (nx, ny) in [(1, 1), (1, 40), (40, 1), (5, 3), (17, 16), (64, 48), (101, 67), (200, 170)] {
            let stencil = matrix(nx, ny);
            let exact: Vec<f64> = (0..nx * ny).map(|k| 1e8 * (1.0 + (k as f64).sin())).collect();
            let mut lu = GridLu::new(nx, ny);
            // Twice: the second factorization must not depend on the first.
            for _ in 0..2 {
                let mut x = product(&stencil, nx, &exact);
                assert!(lu.factorise(&stencil), "{nx} x {ny}");
                lu.solve(&mut x);
                let worst = x.iter().zip(&exact).fold(0.0_f64, |m, (a, b)| m.max((f64::from(*a) - b).abs()));
                assert!(worst < 1e-4 * 2e8, "{nx} x {ny}: off by {worst}");
            }
        }
    }

    #[test]
    fn solutions_are_bit_identical_for_any_number_of_tasks() {
        let (nx, ny) = (200, 170);
        let stencil = matrix(nx, ny);
        let right: Vec<f32> = (0..nx * ny).map(|k| stencil[STENCIL * k] * (2.0 + (k as f32).cos())).collect();
        let solutions = [1, 2, 5, 8].map(|tasks| {
            let mut lu = GridLu::new(nx, ny);
            lu.tree = Tree::new(nx, ny, tasks);
            let mut x = right.clone();
            assert!(lu.factorise(&stencil));
            lu.solve(&mut x);
            x.into_iter().map(f32::to_bits).collect::<Vec<_>>()
        });
        assert!(solutions.windows(2).all(|pair| pair[0] == pair[1]));
    }

    #[test]
    fn unknowns_may_have_any_units() {
        let (nx, ny) = (40, 30);
        let mut stencil = matrix(nx, ny);
        let exact: Vec<f64> = (0..nx * ny).map(|k| 2.0 + (k as f64).sin()).collect();
        let right = product(&stencil, nx, &exact);
        // A flow equation beside pressures: its diagonal is 1e-9 of its other entries.
        let unit = |k: usize| if k.is_multiple_of(3) { 1e-9 } else { 1.0 };
        let mut lu = GridLu::new(nx, ny);
        for (k, row) in stencil.chunks_exact_mut(STENCIL).enumerate() {
            for (value, offset) in row.iter_mut().zip(lu.tree.structure.offsets) {
                *value *= unit(k.wrapping_add_signed(offset)) as f32;
            }
        }
        let mut x = right;
        assert!(lu.factorise(&stencil));
        lu.solve(&mut x);
        for (k, (x, exact)) in x.iter().zip(&exact).enumerate() {
            assert!((f64::from(*x) * unit(k) / exact - 1.0).abs() < 1e-3, "node {k}: {x} for {exact}");
        }
    }

    #[test]
    fn agrees_with_a_dense_factorisation_that_exchanges_rows() {
        let (nx, ny) = (17, 16);
        let (stencil, n) = (matrix(nx, ny), nx * ny);
        let mut lu = GridLu::new(nx, ny);
        let mut dense = Mat::<f64>::zeros(n, n);
        for (k, row) in stencil.chunks_exact(STENCIL).enumerate() {
            for (value, offset) in
                row.iter().zip(lu.tree.structure.offsets).filter(|(value, _)| **value != 0.0)
            {
                dense[(k, k.wrapping_add_signed(offset))] = f64::from(*value);
            }
        }
        // Rows of sizes between 1e-20 and 1e-14: right sides of the size of each.
        let right: Vec<f32> = (0..n).map(|k| stencil[STENCIL * k] * (2.0 + (k as f32).cos())).collect();
        let exact = dense.partial_piv_lu().solve(Col::from_fn(n, |k| f64::from(right[k])));
        let mut x = right;
        assert!(lu.factorise(&stencil));
        lu.solve(&mut x);
        for (k, (x, exact)) in x.iter().zip(exact.iter()).enumerate() {
            assert!((f64::from(*x) / exact - 1.0).abs() < 1e-4, "node {k}: {x} for {exact}");
        }
    }

    #[test]
    fn factorization_stops_when_told_to() {
        let (nx, ny) = (200, 200);
        let (stencil, polls) = (matrix(nx, ny), std::sync::atomic::AtomicUsize::new(0));
        let must_stop = || polls.fetch_add(1, std::sync::atomic::Ordering::Relaxed) == 2;
        let mut lu = GridLu::new(nx, ny);
        assert!(!lu.factorise_unless(&stencil, &must_stop));
        assert!(lu.factorise_unless(&stencil, &must_stop), "all later polls are false");
    }

    #[test]
    fn factorization_fails_for_nan() {
        let mut stencil = matrix(9, 9);
        stencil[STENCIL * 40] = f32::NAN;
        assert!(!GridLu::new(9, 9).factorise(&stencil), "NaN");
        // Decoupled nodes.
        let mut alone: Vec<f32> = (0..81).flat_map(|_| [1.0, 0.0, 0.0, 0.0, 0.0]).collect();
        alone[STENCIL * 40] = 0.0;
        let mut lu = GridLu::new(9, 9);
        assert!(lu.factorise(&alone), "a zero pivot is perturbed");
        let mut x = vec![1.0; 81];
        lu.solve(&mut x);
        assert!(x.iter().all(|x| x.is_finite()));
        alone[STENCIL * 40] = f32::NAN;
        assert!(!GridLu::new(9, 9).factorise(&alone), "NaN of a decoupled node");
    }
}
