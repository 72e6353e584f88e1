//! Dense kernels on column-major blocks in single precision.
//!
//! Columns are padded to whole vectors with zeros, so that no loop has a remainder.

use pulp::Simd;

/// Entries of a vector: columns are padded to a multiple of it.
pub(super) const VECTOR: usize = 8;

/// `length` rounded up to whole vectors.
pub(super) fn padded(length: usize) -> usize {
    length.next_multiple_of(VECTOR)
}

/// A matrix within a slice: column `j` starts at `j * stride`.
#[derive(Clone, Copy)]
pub(super) struct Block<'a> {
    pub(super) values: &'a [f32],
    pub(super) stride: usize,
}

impl Block<'_> {
    #[inline(always)]
    fn below(self, row: usize) -> Self {
        Self { values: &self.values[row..], stride: self.stride }
    }
}

/// `out += a x`, with `a` of `out.len()` padded rows and `x.len()` columns.
#[inline(always)]
pub(super) fn add_product<S: Simd>(simd: S, out: &mut [f32], a: Block<'_>, x: &[f32]) {
    let b = Block { values: x, stride: x.len() };
    let rows = if x.is_empty() { 0 } else { out.len() };
    let mut row = 0;
    while row < rows {
        let left = (rows - row) / S::F32_LANES;
        row += S::F32_LANES
            * if left >= 8 {
                add_tile::<S, 8, 1>(simd, &mut out[row..], rows, a.below(row), b, x.len())
            } else if left >= 4 {
                add_tile::<S, 4, 1>(simd, &mut out[row..], rows, a.below(row), b, x.len())
            } else {
                add_tile::<S, 1, 1>(simd, &mut out[row..], rows, a.below(row), b, x.len())
            };
    }
}

/// `out += a b` for `rows` padded rows, `inner` columns of `a` and `columns` of `b`; column `j` of `out` starts at
/// `j * stride`.
#[inline(always)]
pub(super) fn add_matrix_product<S: Simd>(
    simd: S,
    out: &mut [f32],
    stride: usize,
    a: Block<'_>,
    b: Block<'_>,
    [rows, inner, columns]: [usize; 3],
) {
    let mut column = 0;
    while column < columns {
        let four = columns - column >= 4;
        let mut row = 0;
        while row < rows {
            let out = &mut out[column * stride + row..];
            let two = rows - row >= 2 * S::F32_LANES;
            let (a, b) = (a.below(row), Block { values: &b.values[column * b.stride..], stride: b.stride });
            row += S::F32_LANES
                * match (two, four) {
                    (true, true) => add_tile::<S, 2, 4>(simd, out, stride, a, b, inner),
                    (true, false) => add_tile::<S, 2, 1>(simd, out, stride, a, b, inner),
                    (false, true) => add_tile::<S, 1, 4>(simd, out, stride, a, b, inner),
                    (false, false) => add_tile::<S, 1, 1>(simd, out, stride, a, b, inner),
                };
        }
        column += if four { 4 } else { 1 };
    }
}

/// The product for the first `ROWS` vectors of rows and the first `COLUMNS` columns; returns `ROWS`.
#[inline(always)]
fn add_tile<S: Simd, const ROWS: usize, const COLUMNS: usize>(
    simd: S,
    out: &mut [f32],
    stride: usize,
    a: Block<'_>,
    b: Block<'_>,
    inner: usize,
) -> usize {
    let mut sums = [[simd.splat_f32s(0.0); ROWS]; COLUMNS];
    let mut factors: [&[f32]; COLUMNS] = [&[]; COLUMNS];
    for (j, factors) in factors.iter_mut().enumerate() {
        *factors = &b.values[j * b.stride..][..inner];
    }
    for k in 0..inner {
        let column = &a.values[k * a.stride..][..ROWS * S::F32_LANES];
        let Some(rows) = S::as_simd_f32s(column).0.first_chunk::<ROWS>() else { continue };
        for (sums, factors) in sums.iter_mut().zip(&factors) {
            let factor = simd.splat_f32s(factors[k]);
            for (sum, row) in sums.iter_mut().zip(rows) {
                *sum = simd.mul_add_e_f32s(*row, factor, *sum);
            }
        }
    }
    for (j, sums) in sums.iter().enumerate() {
        let column = &mut out[j * stride..][..ROWS * S::F32_LANES];
        for (out, sum) in S::as_mut_simd_f32s(column).0.iter_mut().zip(sums) {
            *out = simd.add_f32s(*out, *sum);
        }
    }
    ROWS
}

/// Inverts the leading `pivots` rows of the block in place by Gauss and Jordan's method, without exchanging rows; pivots
/// smaller than `smallest` count as that. Returns whether all were numbers.
#[inline(always)]
pub(super) fn invert(
    block: &mut [f32],
    stride: usize,
    pivots: usize,
    smallest: f32,
    column: &mut [f32],
) -> bool {
    let rows = padded(pivots);
    let pivot_column = &mut column[..rows];
    let mut sound = true;
    for k in 0..pivots {
        pivot_column.copy_from_slice(&block[k * stride..][..rows]);
        let value = pivot_column[k];
        let pivot = if value.abs() < smallest { smallest.copysign(value) } else { value };
        sound &= pivot.is_finite();
        let inverse = 1.0 / pivot;
        pivot_column[k] = 0.0;
        for (j, column) in block.chunks_mut(stride).take(pivots).enumerate() {
            let column = &mut column[..rows];
            if j == k {
                for (value, other) in column.iter_mut().zip(&*pivot_column) {
                    *value = -other * inverse;
                }
                column[k] = inverse;
            } else {
                let factor = column[k] * inverse;
                for (value, other) in column.iter_mut().zip(&*pivot_column) {
                    *value -= factor * other;
                }
                column[k] = factor;
            }
        }
    }
    sound
}
