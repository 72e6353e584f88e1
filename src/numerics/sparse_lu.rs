//! Sparse LU of a matrix with a fixed pattern, factorised again and again: buffers are kept.

use std::fmt;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::lu::{LuRef, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par};

/// Number of entries in a row of the five-point stencil: centre, east, west, north, south.
pub(crate) const STENCIL: usize = 5;

/// LU factorisation of a matrix that couples each node of an `nx` x `ny` grid to its four neighbours.
pub(crate) struct GridLu {
    pattern: SymbolicSparseColMat<usize>,
    /// For each entry of the compressed columns, where its value stands in the stencil array.
    source: Vec<usize>,
    values: Vec<f64>,
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
    factor_stack: MemBuffer,
    solve_stack: MemBuffer,
    factorised: bool,
}

impl fmt::Debug for GridLu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("GridLu").field("rows", &self.pattern.nrows()).finish_non_exhaustive()
    }
}

impl GridLu {
    /// Pattern, ordering and buffers for a grid; `None` when the ordering runs out of memory.
    pub(crate) fn new(nx: usize, ny: usize) -> Option<Self> {
        let n = nx * ny;
        let (mut column_start, mut rows, mut source) = (vec![0], Vec::new(), Vec::new());
        for column in 0..n {
            let (i, j) = (column % nx, column / nx);
            // Rows in ascending order; the slot says which neighbour the column is to that row.
            let candidates = [
                (j > 0, column.wrapping_sub(nx), 3),
                (i > 0, column.wrapping_sub(1), 1),
                (true, column, 0),
                (i + 1 < nx, column + 1, 2),
                (j + 1 < ny, column + nx, 4),
            ];
            for (inside, row, slot) in candidates {
                if inside {
                    rows.push(row);
                    source.push(row * STENCIL + slot);
                }
            }
            column_start.push(rows.len());
        }
        let pattern = SymbolicSparseColMat::new_checked(n, n, column_start, None, rows);
        let symbolic = factorize_symbolic_lu(pattern.as_ref(), Default::default()).ok()?;
        let factor = symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Default::default());
        let solve = symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        Some(Self {
            values: vec![0.0; source.len()],
            pattern,
            source,
            numeric: NumericLu::new(),
            factor_stack: MemBuffer::try_new(factor).ok()?,
            solve_stack: MemBuffer::try_new(solve).ok()?,
            symbolic,
            factorised: false,
        })
    }

    /// Factorises the matrix with row `k` at `stencil[5 k..5 k + 5]` in the order centre, east, west, north, south.
    /// Returns whether it succeeded.
    pub(crate) fn factorise(&mut self, stencil: &[f64]) -> bool {
        for (value, &at) in self.values.iter_mut().zip(&self.source) {
            *value = stencil[at];
        }
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), &self.values);
        let outcome = self.symbolic.factorize_numeric_lu(
            &mut self.numeric,
            matrix,
            Par::Seq,
            MemStack::new(&mut self.factor_stack),
            Default::default(),
        );
        self.factorised = outcome.is_ok();
        self.factorised
    }

    /// Solves in place; without a factorisation the right-hand side is left as it is.
    pub(crate) fn solve(&mut self, rhs: &mut [f64]) {
        if !self.factorised {
            return;
        }
        let n = rhs.len();
        LuRef::new_unchecked(&self.symbolic, &self.numeric).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(rhs, n, 1),
            Par::Seq,
            MemStack::new(&mut self.solve_stack),
        );
    }
}
