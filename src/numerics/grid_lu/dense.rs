//! Dense kernels on column-major blocks.
//!
//! Columns are zero-padded to whole SIMD vectors, so that loops have no remainder.

use std::ops::Range;

use pulp::Simd;

use super::division::add_divided_product;
use super::real::Real;

/// Padding of columns, in entries.
pub(super) const VECTOR: usize = 8;
/// SIMD vectors per tile of rows in a matrix product.
const TILE: usize = 2;
/// Pivots per panel of an inversion.
const PANEL: usize = 8;

/// `length` rounded up to whole SIMD vectors.
pub(super) fn padded(length: usize) -> usize {
    length.next_multiple_of(VECTOR)
}

/// The value, or zero if it is negligible.
#[inline(always)]
pub(super) fn significant<T: Real>(value: T) -> T {
    if value.abs() < T::NEGLIGIBLE { T::zero() } else { value }
}

/// Sets negligible values to zero.
#[inline(always)]
pub(super) fn flush_negligible<T: Real>(values: &mut [T]) {
    for value in values {
        *value = significant(*value);
    }
}

/// Copies values, negligible ones as zero.
#[inline(always)]
fn copy_significant<T: Real>(to: &mut [T], from: &[T]) {
    for (to, value) in to.iter_mut().zip(from) {
        *to = significant(*value);
    }
}

/// A matrix within a slice: column `j` starts at `j * stride`.
#[derive(Clone, Copy)]
pub(super) struct Block<'a, T> {
    /// The entries; padding rows are zero.
    pub(super) values: &'a [T],
    /// Entries between the starts of columns.
    pub(super) stride: usize,
}

impl<T> Block<'_, T> {
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
pub(super) fn add_product<S: Simd, T: Real>(simd: S, out: &mut [T], a: Block<'_, T>, x: &[T]) {
    let rows = if x.is_empty() { 0 } else { out.len() };
    let mut row = 0;
    while row < rows {
        let (out, a) = (&mut out[row..], a.below(row));
        row += T::lanes::<S>()
            * match out.len() / T::lanes::<S>() {
                0..2 => add_to_column::<S, T, 1>(simd, out, a, x),
                2..4 => add_to_column::<S, T, 2>(simd, out, a, x),
                4..8 => add_to_column::<S, T, 4>(simd, out, a, x),
                _ => add_to_column::<S, T, 8>(simd, out, a, x),
            };
    }
}

/// Product for the first `ROWS` vectors of rows; returns `ROWS`.
#[inline(always)]
fn add_to_column<S: Simd, T: Real, const ROWS: usize>(
    simd: S,
    out: &mut [T],
    a: Block<'_, T>,
    x: &[T],
) -> usize {
    let mut sums = [T::splat(simd, T::zero()); ROWS];
    for (x, column) in x.iter().zip(a.values.chunks(a.stride)) {
        let factor = T::splat(simd, *x);
        let rows = T::vectors::<S>(&column[..ROWS * T::lanes::<S>()]);
        for (sum, row) in sums.iter_mut().zip(rows) {
            *sum = T::multiply_add(simd, [*row, factor], *sum);
        }
    }
    for (out, sum) in T::vectors_mut::<S>(out).iter_mut().zip(&sums) {
        *out = T::sum(simd, *out, *sum);
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
pub(super) fn add_matrix_product<S: Simd, T: Real>(
    simd: S,
    [out, pack]: [&mut [T]; 2],
    stride: usize,
    a: Block<'_, T>,
    b: Block<'_, T>,
    [rows, inner, columns]: [usize; 3],
) {
    if inner == 0 || columns == 0 {
        return;
    }
    let mut row = 0;
    while row < rows {
        let (out, a) = (&mut out[row..], a.below(row));
        row += T::lanes::<S>()
            * if rows - row < TILE * T::lanes::<S>() {
                add_to_rows::<S, T, 1>(simd, [out, pack], stride, a, b, [inner, columns])
            } else {
                add_to_rows::<S, T, TILE>(simd, [out, pack], stride, a, b, [inner, columns])
            };
    }
}

/// Product for the first `ROWS` vectors of rows, packed contiguously; returns `ROWS`.
#[inline(always)]
fn add_to_rows<S: Simd, T: Real, const ROWS: usize>(
    simd: S,
    [out, pack]: [&mut [T]; 2],
    stride: usize,
    a: Block<'_, T>,
    b: Block<'_, T>,
    [inner, columns]: [usize; 2],
) -> usize {
    let height = ROWS * T::lanes::<S>();
    let pack = &mut pack[..height * inner];
    for (pack, column) in pack.chunks_exact_mut(height).zip(a.values.chunks(a.stride)) {
        pack.copy_from_slice(&column[..height]);
    }
    let a = T::vectors::<S>(pack).as_chunks::<ROWS>().0;
    let mut column = 0;
    while column < columns {
        let (out, b) = (&mut out[column * stride..], b.beside(column));
        column += match columns - column {
            1 => add_to_tile::<S, T, ROWS, 1>(simd, out, stride, a, b),
            2 => add_to_tile::<S, T, ROWS, 2>(simd, out, stride, a, b),
            3 => add_to_tile::<S, T, ROWS, 3>(simd, out, stride, a, b),
            4 => add_to_tile::<S, T, ROWS, 4>(simd, out, stride, a, b),
            5 => add_to_tile::<S, T, ROWS, 5>(simd, out, stride, a, b),
            _ => add_to_tile::<S, T, ROWS, 6>(simd, out, stride, a, b),
        };
    }
    ROWS
}

/// Product for the first `COLUMNS` columns; returns `COLUMNS`. All sums stay in registers.
#[inline(always)]
fn add_to_tile<S: Simd, T: Real, const ROWS: usize, const COLUMNS: usize>(
    simd: S,
    out: &mut [T],
    stride: usize,
    a: &[[T::Vector<S>; ROWS]],
    b: Block<'_, T>,
) -> usize {
    let mut sums = [[T::splat(simd, T::zero()); ROWS]; COLUMNS];
    let mut factors: [&[T]; COLUMNS] = [&[]; COLUMNS];
    for (j, factors) in factors.iter_mut().enumerate() {
        *factors = &b.values[j * b.stride..][..a.len()];
    }
    for (k, rows) in a.iter().enumerate() {
        for (sums, factors) in sums.iter_mut().zip(&factors) {
            let factor = T::splat(simd, factors[k]);
            for (sum, row) in sums.iter_mut().zip(rows) {
                *sum = T::multiply_add(simd, [*row, factor], *sum);
            }
        }
    }
    for (j, sums) in sums.iter().enumerate() {
        let column = &mut out[j * stride..][..ROWS * T::lanes::<S>()];
        for (out, sum) in T::vectors_mut::<S>(column).iter_mut().zip(sums) {
            *out = T::sum(simd, *out, *sum);
        }
    }
    COLUMNS
}

/// Inverts a padded block of `pivots` columns in place by blocked Gauss-Jordan elimination without pivoting;
/// pivots below `smallest` are perturbed to it. `scratch` is as long as the block, `pack` holds [`packed`]
/// entries, each of `packs` as many for a further thread. Returns whether all pivots are finite.
#[inline(always)]
pub(super) fn invert<S: Simd, T: Real>(
    simd: S,
    block: &mut [T],
    pivots: usize,
    [scratch, pack]: [&mut [T]; 2],
    packs: &mut [Vec<T>],
) -> bool {
    let rows = padded(pivots);
    if pivots <= 2 * PANEL {
        return invert_panel(block, rows, 0..pivots, scratch);
    }
    let (panel, of_panel) = scratch.split_at_mut(PANEL * rows);
    let mut is_finite = true;
    // invert a panel, then update all other columns with it
    for from in (0..pivots).step_by(PANEL) {
        let range = from..(from + PANEL).min(pivots);
        let width = range.len();
        let in_place = &mut block[from * rows..range.end * rows];
        is_finite &= invert_panel(in_place, rows, range.clone(), panel);
        copy_significant(panel, in_place);
        // The panel's rows of the other columns are replaced by their product with the panel.
        for (of_panel, column) in of_panel.chunks_exact_mut(PANEL).zip(block.chunks_exact_mut(rows)) {
            copy_significant(of_panel, &column[range.clone()]);
        }
        let panel = Block { values: panel, stride: rows };
        for columns in [0..from, range.end..pivots] {
            let out = &mut block[columns.start * rows..columns.end * rows];
            for column in out.chunks_exact_mut(rows) {
                column[range.clone()].fill(T::zero());
            }
            let of_panel = Block { values: of_panel, stride: PANEL }.beside(columns.start);
            let sizes = [rows, width, columns.len()];
            add_divided_product(simd, [out, &mut *pack], packs, rows, [panel, of_panel], sizes);
        }
    }
    is_finite
}

/// Static pivot perturbation: `value`, or [`Real::STATIC_PIVOT`] with its sign if it is smaller in magnitude.
#[inline(always)]
pub(super) fn perturbed_pivot<T: Real>(value: T) -> T {
    if value.abs() < T::STATIC_PIVOT { T::STATIC_PIVOT.with_sign_of(value) } else { value }
}

/// Gauss-Jordan steps with the pivots `range`, on their own columns, the content of `panel`.
#[inline(always)]
fn invert_panel<T: Real>(panel: &mut [T], rows: usize, range: Range<usize>, scratch: &mut [T]) -> bool {
    let pivot_column = &mut scratch[..rows];
    let mut is_finite = true;
    for (own, k) in range.clone().enumerate() {
        copy_significant(pivot_column, &panel[own * rows..]);
        let value = pivot_column[k];
        let pivot = perturbed_pivot(value);
        is_finite &= pivot.is_finite();
        let inverse = T::one() / pivot;
        pivot_column[k] = T::zero();
        for (j, column) in panel.chunks_exact_mut(rows).take(range.len()).enumerate() {
            if j == own {
                for (value, other) in column.iter_mut().zip(&*pivot_column) {
                    *value = -*other * inverse;
                }
                column[k] = inverse;
            } else {
                let factor = significant(column[k] * inverse);
                for (value, other) in column.iter_mut().zip(&*pivot_column) {
                    *value -= factor * *other;
                }
                column[k] = factor;
            }
        }
    }
    is_finite
}
