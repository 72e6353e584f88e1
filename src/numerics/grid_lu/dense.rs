//! The dense kernels of a front: matrices column by column, single precision.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};

/// Entries summed side by side in a scalar product, whatever the width of the machine's vectors: the sum does not
/// depend on it.
const LANES: usize = 16;
/// Border from which the general matrix product is faster than the loop here.
const SMALL: usize = 24;

/// `y -= a x`.
#[inline(always)]
pub(super) fn subtract(y: &mut [f32], a: f32, x: &[f32]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y -= a * x;
    }
}

/// `y -= sum of a_k x_k` for the columns `x_k` of `columns`.
#[inline(always)]
pub(super) fn subtract_product(y: &mut [f32], columns: &[f32], a: &[f32]) {
    let rows = y.len();
    let mut fours = columns.chunks_exact(4 * rows);
    let mut factors = a.chunks_exact(4);
    for (four, f) in fours.by_ref().zip(factors.by_ref()) {
        let (x0, rest) = four.split_at(rows);
        let (x1, rest) = rest.split_at(rows);
        let (x2, x3) = rest.split_at(rows);
        for ((((y, x0), x1), x2), x3) in y.iter_mut().zip(x0).zip(x1).zip(x2).zip(x3) {
            *y -= (f[0] * x0 + f[1] * x1) + (f[2] * x2 + f[3] * x3);
        }
    }
    for (x, &a) in fours.remainder().chunks_exact(rows).zip(factors.remainder()) {
        subtract(y, a, x);
    }
}

#[inline(always)]
pub(super) fn dot(x: &[f32], y: &[f32]) -> f32 {
    let mut sums = [0.0_f32; LANES];
    let (mut xs, mut ys) = (x.chunks_exact(LANES), y.chunks_exact(LANES));
    for (x, y) in xs.by_ref().zip(ys.by_ref()) {
        for ((sum, x), y) in sums.iter_mut().zip(x).zip(y) {
            *sum += x * y;
        }
    }
    let rest: f32 = xs.remainder().iter().zip(ys.remainder()).map(|(x, y)| x * y).sum();
    sums.iter().sum::<f32>() + rest
}

/// The blocks of a front with `s` pivots and `b` nodes in its border.
pub(super) struct Blocks<'a> {
    /// `s` x `s`; becomes its inverse.
    pub(super) own: &'a mut [f32],
    /// Rows of the border, `b` x `s`; becomes its product with the inverse.
    pub(super) lower: &'a mut [f32],
    /// Columns of the border, transposed, `b` x `s`.
    pub(super) upper: &'a mut [f32],
    /// `b` x `b`; becomes what is left for the parent.
    pub(super) remainder: &'a mut [f32],
}

impl Blocks<'_> {
    /// Eliminates the pivots without exchanging rows; pivots smaller than `smallest` count as that. Returns whether
    /// all were numbers. `scratch` holds `s` times the larger of `s` and `b`.
    #[inline(always)]
    pub(super) fn eliminate(
        &mut self,
        pivots: usize,
        border: usize,
        smallest: f32,
        scratch: &mut [f32],
    ) -> bool {
        let sound = self.invert(pivots, smallest, &mut scratch[..pivots]);
        if border > 0 {
            let raw = &mut scratch[..border * pivots];
            for (raw, lower) in raw.iter_mut().zip(&*self.lower) {
                *raw = -lower;
            }
            self.lower.fill(0.0);
            subtract_matrix_product(self.lower, raw, self.own, border, pivots);
            subtract_transposed(self.remainder, self.lower, self.upper, border, pivots);
        }
        sound
    }

    /// Gauss and Jordan's inversion in place.
    #[inline(always)]
    fn invert(&mut self, pivots: usize, smallest: f32, pivot_column: &mut [f32]) -> bool {
        let mut sound = true;
        for k in 0..pivots {
            pivot_column.copy_from_slice(&self.own[k * pivots..][..pivots]);
            let value = pivot_column[k];
            let pivot = if value.abs() < smallest { smallest.copysign(value) } else { value };
            sound &= pivot.is_finite();
            let inverse = 1.0 / pivot;
            pivot_column[k] = 0.0;
            for (j, column) in self.own.chunks_exact_mut(pivots).enumerate() {
                if j == k {
                    for (value, other) in column.iter_mut().zip(&*pivot_column) {
                        *value = -other * inverse;
                    }
                    column[k] = inverse;
                } else {
                    let factor = column[k] * inverse;
                    subtract(column, factor, pivot_column);
                    column[k] = factor;
                }
            }
        }
        sound
    }
}

/// `out -= a b`, with `a` of `rows` x `inner` and `b` of `inner` columns of that length.
#[inline(always)]
fn subtract_matrix_product(out: &mut [f32], a: &[f32], b: &[f32], rows: usize, inner: usize) {
    if rows < SMALL || inner < SMALL {
        for (out, b) in out.chunks_exact_mut(rows).zip(b.chunks_exact(inner)) {
            subtract_product(out, a, b);
        }
        return;
    }
    let columns = b.len() / inner;
    matmul(
        MatMut::from_column_major_slice_mut(out, rows, columns),
        Accum::Add,
        MatRef::from_column_major_slice(a, rows, inner),
        MatRef::from_column_major_slice(b, inner, columns),
        -1.0,
        Par::Seq,
    );
}

/// `out -= a b^T`, with `a` and `b` of `rows` x `inner`.
#[inline(always)]
fn subtract_transposed(out: &mut [f32], a: &[f32], b: &[f32], rows: usize, inner: usize) {
    if rows < SMALL {
        for (l, out) in out.chunks_exact_mut(rows).enumerate() {
            for (a, b) in a.chunks_exact(rows).zip(b.chunks_exact(rows)) {
                subtract(out, b[l], a);
            }
        }
        return;
    }
    matmul(
        MatMut::from_column_major_slice_mut(out, rows, rows),
        Accum::Add,
        MatRef::from_column_major_slice(a, rows, inner),
        MatRef::from_column_major_slice(b, rows, inner).transpose(),
        -1.0,
        Par::Seq,
    );
}
