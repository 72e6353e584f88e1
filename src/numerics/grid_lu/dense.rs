//! Dense kernels on column-major blocks in single precision.
//!
//! Columns are zero-padded to whole SIMD vectors, so that loops have no remainder.

use std::ops::Range;

use pulp::Simd;

use super::division::add_divided_product;

/// Padding of columns, in entries.
pub(super) const VECTOR: usize = 8;
/// SIMD vectors per tile of rows in a matrix product.
const TILE: usize = 2;
/// Pivots per panel of an inversion.
const PANEL: usize = 8;

/// Magnitude below which values are set to zero, so that products of the others are normal numbers. Couplings
/// decay by orders of magnitude from node to node, and denormal numbers cost up to a hundred times as much on
/// some processors.
const NEGLIGIBLE: f32 = 1e-18;

/// `length` rounded up to whole SIMD vectors.
pub(super) fn padded(length: usize) -> usize {
    length.next_multiple_of(VECTOR)
}

/// The value, or zero if it is negligible.
#[inline(always)]
pub(super) fn significant(value: f32) -> f32 {
    if value.abs() < NEGLIGIBLE { 0.0 } else { value }
}

/// Sets negligible values to zero.
#[inline(always)]
pub(super) fn flush_negligible(values: &mut [f32]) {
    for value in values {
        *value = significant(*value);
    }
}

/// Copies values, negligible ones as zero.
#[inline(always)]
fn copy_significant(to: &mut [f32], from: &[f32]) {
    for (to, value) in to.iter_mut().zip(from) {
        *to = significant(*value);
    }
}

/// A matrix within a slice: column `j` starts at `j * stride`.
#[derive(Clone, Copy)]
pub(super) struct Block<'a> {
    /// The entries; padding rows are zero.
    pub(super) values: &'a [f32],
    /// Entries between the starts of columns.
    pub(super) stride: usize,
}

impl Block<'_> {
    /// The block without the rows above `row`.
    #[inline(always)]
    fn below(self, row: usize) -> Self {
        Self { values: &self.values[row..], stride: self.stride }
    }

    /// The block without the columns before `column`.
    #[inline(always)]
    pub(super) fn beside(self, column: usize) -> Self {
        Self { values: &self.values[column * self.stride..], stride: self.stride }
    }
}

/// `out += a x`, with `a` of `out.len()` padded rows and `x.len()` columns.
#[inline(always)]
pub(super) fn add_product<S: Simd>(simd: S, out: &mut [f32], a: Block<'_>, x: &[f32]) {
    let rows = if x.is_empty() { 0 } else { out.len() };
    let mut row = 0;
    while row < rows {
        let (out, a) = (&mut out[row..], a.below(row));
        row += S::F32_LANES
            * match out.len() / S::F32_LANES {
                0..2 => add_to_column::<S, 1>(simd, out, a, x),
                2..4 => add_to_column::<S, 2>(simd, out, a, x),
                4..8 => add_to_column::<S, 4>(simd, out, a, x),
                _ => add_to_column::<S, 8>(simd, out, a, x),
            };
    }
}

/// Product for the first `ROWS` vectors of rows; returns `ROWS`.
#[inline(always)]
fn add_to_column<S: Simd, const ROWS: usize>(simd: S, out: &mut [f32], a: Block<'_>, x: &[f32]) -> usize {
    let mut sums = [simd.splat_f32s(0.0); ROWS];
    for (x, column) in x.iter().zip(a.values.chunks(a.stride)) {
        let factor = simd.splat_f32s(*x);
        let rows = S::as_simd_f32s(&column[..ROWS * S::F32_LANES]).0;
        for (sum, row) in sums.iter_mut().zip(rows) {
            *sum = simd.mul_add_e_f32s(*row, factor, *sum);
        }
    }
    for (out, sum) in S::as_mut_simd_f32s(out).0.iter_mut().zip(&sums) {
        *out = simd.add_f32s(*out, *sum);
    }
    ROWS
}

/// Length of the packed left factor of a matrix product with `inner` columns.
pub(super) fn packed(inner: usize) -> usize {
    TILE * VECTOR * inner.max(PANEL)
}

/// `out += a b` for `rows` padded rows, `inner` columns of `a` and `columns` of `b`; column `j` of `out`
/// starts at `j * stride`. `pack` holds [`packed`] entries.
#[inline(always)]
pub(super) fn add_matrix_product<S: Simd>(
    simd: S,
    [out, pack]: [&mut [f32]; 2],
    stride: usize,
    a: Block<'_>,
    b: Block<'_>,
    [rows, inner, columns]: [usize; 3],
) {
    if inner == 0 || columns == 0 {
        return;
    }
    let mut row = 0;
    while row < rows {
        let (out, a) = (&mut out[row..], a.below(row));
        row += S::F32_LANES
            * if rows - row < TILE * S::F32_LANES {
                add_to_rows::<S, 1>(simd, [out, pack], stride, a, b, [inner, columns])
            } else {
                add_to_rows::<S, TILE>(simd, [out, pack], stride, a, b, [inner, columns])
            };
    }
}

/// Product for the first `ROWS` vectors of rows, packed contiguously; returns `ROWS`.
#[inline(always)]
fn add_to_rows<S: Simd, const ROWS: usize>(
    simd: S,
    [out, pack]: [&mut [f32]; 2],
    stride: usize,
    a: Block<'_>,
    b: Block<'_>,
    [inner, columns]: [usize; 2],
) -> usize {
    let height = ROWS * S::F32_LANES;
    let pack = &mut pack[..height * inner];
    for (pack, column) in pack.chunks_exact_mut(height).zip(a.values.chunks(a.stride)) {
        pack.copy_from_slice(&column[..height]);
    }
    let a = S::as_simd_f32s(pack).0.as_chunks::<ROWS>().0;
    let mut column = 0;
    while column < columns {
        let (out, b) = (&mut out[column * stride..], b.beside(column));
        column += match columns - column {
            1 => add_to_tile::<S, ROWS, 1>(simd, out, stride, a, b),
            2 => add_to_tile::<S, ROWS, 2>(simd, out, stride, a, b),
            3 => add_to_tile::<S, ROWS, 3>(simd, out, stride, a, b),
            4 => add_to_tile::<S, ROWS, 4>(simd, out, stride, a, b),
            5 => add_to_tile::<S, ROWS, 5>(simd, out, stride, a, b),
            _ => add_to_tile::<S, ROWS, 6>(simd, out, stride, a, b),
        };
    }
    ROWS
}

/// Product for the first `COLUMNS` columns; returns `COLUMNS`. All sums stay in registers.
#[inline(always)]
fn add_to_tile<S: Simd, const ROWS: usize, const COLUMNS: usize>(
    simd: S,
    out: &mut [f32],
    stride: usize,
    a: &[[S::f32s; ROWS]],
    b: Block<'_>,
) -> usize {
    let mut sums = [[simd.splat_f32s(0.0); ROWS]; COLUMNS];
    let mut factors: [&[f32]; COLUMNS] = [&[]; COLUMNS];
    for (j, factors) in factors.iter_mut().enumerate() {
        *factors = &b.values[j * b.stride..][..a.len()];
    }
    for (k, rows) in a.iter().enumerate() {
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
    COLUMNS
}

/// Inverts a padded block of `pivots` columns in place by blocked Gauss-Jordan elimination without pivoting;
/// pivots below `smallest` are perturbed to it. `scratch` is as long as the block, `pack` holds [`packed`]
/// entries, each of `packs` as many for a further thread. Returns whether all pivots are finite.
#[inline(always)]
pub(super) fn invert<S: Simd>(
    simd: S,
    block: &mut [f32],
    pivots: usize,
    smallest: f32,
    [scratch, pack]: [&mut [f32]; 2],
    packs: &mut [Vec<f32>],
) -> bool {
    let rows = padded(pivots);
    if pivots <= 2 * PANEL {
        return invert_panel(block, rows, 0..pivots, smallest, scratch);
    }
    let (panel, of_panel) = scratch.split_at_mut(PANEL * rows);
    let mut is_finite = true;
    // invert a panel, then update all other columns with it
    for from in (0..pivots).step_by(PANEL) {
        let range = from..(from + PANEL).min(pivots);
        let width = range.len();
        let in_place = &mut block[from * rows..range.end * rows];
        is_finite &= invert_panel(in_place, rows, range.clone(), smallest, panel);
        copy_significant(panel, in_place);
        // The panel's rows of the other columns are replaced by their product with the panel.
        for (of_panel, column) in of_panel.chunks_exact_mut(PANEL).zip(block.chunks_exact_mut(rows)) {
            copy_significant(of_panel, &column[range.clone()]);
        }
        let panel = Block { values: panel, stride: rows };
        for columns in [0..from, range.end..pivots] {
            let out = &mut block[columns.start * rows..columns.end * rows];
            for column in out.chunks_exact_mut(rows) {
                column[range.clone()].fill(0.0);
            }
            let of_panel = Block { values: of_panel, stride: PANEL }.beside(columns.start);
            let sizes = [rows, width, columns.len()];
            add_divided_product(simd, [out, &mut *pack], packs, rows, [panel, of_panel], sizes);
        }
    }
    is_finite
}

/// Static pivot perturbation: `value`, or `smallest` with its sign if it is smaller in magnitude.
#[inline(always)]
pub(super) fn perturbed_pivot(value: f32, smallest: f32) -> f32 {
    if value.abs() < smallest { smallest.copysign(value) } else { value }
}

/// Gauss-Jordan steps with the pivots `range`, on their own columns, the content of `panel`.
#[inline(always)]
fn invert_panel(
    panel: &mut [f32],
    rows: usize,
    range: Range<usize>,
    smallest: f32,
    scratch: &mut [f32],
) -> bool {
    let pivot_column = &mut scratch[..rows];
    let mut is_finite = true;
    for (own, k) in range.clone().enumerate() {
        copy_significant(pivot_column, &panel[own * rows..]);
        let value = pivot_column[k];
        let pivot = perturbed_pivot(value, smallest);
        is_finite &= pivot.is_finite();
        let inverse = 1.0 / pivot;
        pivot_column[k] = 0.0;
        for (j, column) in panel.chunks_exact_mut(rows).take(range.len()).enumerate() {
            if j == own {
                for (value, other) in column.iter_mut().zip(&*pivot_column) {
                    *value = -other * inverse;
                }
                column[k] = inverse;
            } else {
                let factor = significant(column[k] * inverse);
                for (value, other) in column.iter_mut().zip(&*pivot_column) {
                    *value -= factor * other;
                }
                column[k] = factor;
            }
        }
    }
    is_finite
}
