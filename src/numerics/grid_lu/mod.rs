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
mod periodicity;
mod real;
mod structure;
mod traversal;
mod tree;

use std::fmt;

use dense::perturbed_pivot;
pub(crate) use periodicity::{Neighbors, Periodicity};
use real::Real;
use structure::DECOUPLED;
use tree::Tree;

use super::lines::map_nodes;
use super::parallel::chunk_count;

/// Number of entries in a row of the five-point stencil: center, east, west, north, south.
pub(crate) const STENCIL: usize = 5;

/// LU factorization of a matrix that couples each node of an `nx` x `ny` grid to its four neighbors.
///
/// On a periodic grid the last column or row is coupled to the first as well ([`Periodicity`]).
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
    /// Elimination order and buffers for a grid, a ring of any number of nodes where it is periodic.
    pub(crate) fn new(nx: usize, ny: usize, periodicity: Periodicity) -> Self {
        let n = nx * ny;
        Self {
            tree: Tree::new(nx, ny, periodicity, chunk_count(n)),
            scale: vec![T::one(); n],
            couplings: vec![0; n],
            factorised: false,
        }
    }

    /// Factorizes the matrix with row `k` in `stencil[5 k..5 k + 5]`, in the order center, east, west, north,
    /// south. Entries that point across an edge of the grid must be zero. Returns whether all pivots are finite.
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
        let neighbors = self.tree.structure.neighbors;
        let has_entry = |node: usize, slot: usize| {
            let row = node.checked_mul(STENCIL).and_then(|start| stencil.get(start..start + STENCIL));
            row.is_some_and(|row| row[slot + 1] != T::zero())
        };
        map_nodes(&mut self.couplings, |node, couplings| {
            let is_coupled =
                |slot: usize| has_entry(node, slot) || has_entry(neighbors.at(node, slot + 1), slot ^ 1);
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
mod tests;
