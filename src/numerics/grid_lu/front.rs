//! Dense operations on one front: elimination of its pivots and both halves of a substitution.
//!
//! All functions are inlined into a SIMD context; closures would not be.

use pulp::{Scalar, Simd, WithSimd};

use super::Matrix;
use super::dense::{Block, VECTOR, add_product, flush_negligible, invert, packed, padded, significant};
use super::division::add_divided_product;
use super::real::Real;
use super::structure::{Edge, Front, IndexRange, Structure};

/// Factors of a front.
///
/// With the pivot block `P`, `B` below it and `C` beside it: `P^-1`, `-B P^-1` and `C`. Each border node of a
/// leaf has one neighbor among the pivots, so `-B` and `C` have one entry per border node and are stored
/// directly.
struct Parts<'a, T> {
    /// `P^-1`, padded rows, one column per pivot.
    inverse: &'a mut [T],
    /// `-B P^-1`; for a leaf `-B`.
    lower: &'a mut [T],
    /// `C`.
    upper: &'a mut [T],
}

impl Front {
    /// Lengths of the three parts.
    fn part_lengths(&self) -> [usize; 3] {
        let [s, b] = self.size();
        let (rows, border_rows) = (self.pivot_rows(), self.border_rows());
        if self.is_leaf {
            [rows * s, border_rows, border_rows]
        } else {
            [rows * s, border_rows * s, rows * b]
        }
    }

    /// Length of the factors.
    pub(super) fn factors(&self) -> usize {
        self.part_lengths().into_iter().sum()
    }

    /// Length of the update matrix.
    pub(super) fn update_length(&self) -> usize {
        self.border_rows() * self.size()[1]
    }

    /// Length of the workspace.
    pub(super) fn scratch(&self) -> usize {
        let [s, b] = self.size();
        packed(s) + self.border_rows() * s + (self.pivot_rows() * s).max(padded(b))
    }

    /// The factors as three parts.
    #[inline(always)]
    fn parts<'a, T>(&self, values: &'a mut [T]) -> Parts<'a, T> {
        let [inverse, lower, upper] = self.part_lengths();
        let (inverse, rest) = values.split_at_mut(inverse);
        let (lower, rest) = rest.split_at_mut(lower);
        Parts { inverse, lower, upper: &mut rest[..upper] }
    }

    /// Adds the contribution of the pivots, whose right-hand side comes first in `own`, to the border rows.
    #[inline(always)]
    pub(super) fn forward<S: Simd, T: Real>(
        &self,
        simd: S,
        edges: &[Edge],
        [values, own, scratch]: [&mut [T]; 3],
    ) {
        let (s, rows, stride) = (self.pivots.len(), self.pivot_rows(), self.border_rows());
        let Parts { inverse, lower, .. } = self.parts(values);
        let (pivots, border) = own.split_at_mut(rows);
        if self.is_leaf {
            let solution = &mut scratch[..rows];
            solution.fill(T::zero());
            add_product(simd, solution, Block { values: inverse, stride: rows }, &pivots[..s]);
            for ((out, lower), edge) in border.iter_mut().zip(&*lower).zip(edges) {
                *out += *lower * solution[edge.pivot as usize];
            }
        } else {
            add_product(simd, border, Block { values: lower, stride }, &pivots[..s]);
        }
    }

    /// Solution at the pivots from that at the border, which follows the pivots in `own`.
    #[inline(always)]
    pub(super) fn backward<S: Simd, T: Real>(
        &self,
        simd: S,
        edges: &[Edge],
        [values, own, scratch]: [&mut [T]; 3],
    ) {
        let ([s, b], rows) = (self.size(), self.pivot_rows());
        let Parts { inverse, upper, .. } = self.parts(values);
        let (pivots, border) = own.split_at_mut(rows);
        if self.is_leaf {
            for ((value, upper), edge) in border.iter().zip(&*upper).zip(edges) {
                pivots[edge.pivot as usize] -= *upper * *value;
            }
        } else {
            for (negative, value) in scratch.iter_mut().zip(&border[..b]) {
                *negative = -*value;
            }
            add_product(simd, pivots, Block { values: upper, stride: rows }, &scratch[..b]);
        }
        let right = &mut scratch[..s];
        right.copy_from_slice(&pivots[..s]);
        pivots.fill(T::zero());
        add_product(simd, pivots, Block { values: inverse, stride: rows }, right);
    }
}

/// Elimination of a front. SIMD instructions apply to inlined functions only.
pub(super) struct Elimination<'a, 'b, T> {
    /// The front.
    pub(super) front: &'a Front,
    /// All fronts.
    pub(super) structure: &'a Structure,
    /// The matrix.
    pub(super) matrix: Matrix<'a, T>,
    /// Factors of the front.
    pub(super) values: &'b mut [T],
    /// Update matrices of the children with their maps to this front.
    pub(super) children: [Option<(Block<'b, T>, &'a [IndexRange])>; 2],
    /// Update matrix of this front.
    pub(super) update_matrix: &'b mut [T],
    /// Workspace.
    pub(super) scratch: &'b mut [T],
    /// Workspaces of further threads for the products of a large front; empty for one thread.
    pub(super) packs: &'b mut [Vec<T>],
}

impl<T: Real> WithSimd for Elimination<'_, '_, T> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        // The padding does not fit wider vectors; the scalar fallback is rare.
        if T::lanes::<S>() > VECTOR { self.run(Scalar) } else { self.run(simd) }
    }
}

/// Factors and update matrix of a leaf, of which one stencil entry couples each border node, from the inverse of its pivots.
#[inline(always)]
fn eliminate_leaf<T: Real>(
    matrix: Matrix<'_, T>,
    edges: &[Edge],
    [rows, border_rows]: [usize; 2],
    [inverse, lower, upper, update_matrix]: [&mut [T]; 4],
) {
    for (place, edge) in edges.iter().enumerate() {
        lower[place] = -matrix.entry(edge.of_border as usize);
        upper[place] = matrix.entry(edge.of_pivot as usize);
    }
    for (column, edge) in update_matrix.chunks_exact_mut(border_rows.max(1)).zip(edges) {
        let inverse = &inverse[edge.pivot as usize * rows..][..rows];
        let value = matrix.entry(edge.of_pivot as usize);
        for ((out, row), lower) in column.iter_mut().zip(edges).zip(&*lower) {
            *out = significant(*lower * inverse[row.pivot as usize]) * value;
        }
    }
}

/// Adds the update matrix of a child to the four blocks of its parent: pivots, border by pivots, pivots by border, and border.
#[inline(always)]
fn add_child<T: Real>(
    (update, index_ranges): (Block<'_, T>, &[IndexRange]),
    [rows, border_rows]: [usize; 2],
    [pivots, lower, upper, border]: [&mut [T]; 4],
) {
    let mut columns = update.values.chunks_exact(update.stride);
    let (on_pivots, on_border) =
        index_ranges.split_at(index_ranges.partition_point(|range| (range.to as usize) < rows));
    for range in on_pivots {
        for (to, column) in range.rows().zip(&mut columns) {
            extend_add(&mut pivots[to * rows..][..rows], column, on_pivots, 0);
            extend_add(&mut lower[to * border_rows..][..border_rows], column, on_border, rows);
        }
    }
    for range in on_border {
        for (to, column) in range.rows().zip(&mut columns) {
            let to = to - rows;
            extend_add(&mut upper[to * rows..][..rows], column, on_pivots, 0);
            extend_add(&mut border[to * border_rows..][..border_rows], column, on_border, rows);
        }
    }
}

impl<T: Real> Elimination<'_, '_, T> {
    /// Eliminates the pivots; returns whether they are finite.
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        let Self { front, structure, matrix, values, children, update_matrix, scratch, packs } = self;
        let ([s, b], edges) = (front.size(), structure.edges(front));
        let (rows, border_rows) = (front.pivot_rows(), front.border_rows());
        let Parts { inverse, lower, upper } = front.parts(values);
        let (pack, scratch) = scratch.split_at_mut(packed(s));
        inverse.fill(T::zero());
        structure.place_entries(front, matrix, inverse);
        if front.is_leaf {
            let is_finite = invert(simd, inverse, s, [scratch, pack], packs);
            flush_negligible(inverse);
            eliminate_leaf(matrix, edges, [rows, border_rows], [inverse, lower, upper, update_matrix]);
            return is_finite;
        }
        // stencil entries between pivots and border
        let raw = &mut scratch[..border_rows * s];
        raw.fill(T::zero());
        upper.fill(T::zero());
        update_matrix.fill(T::zero());
        for edge in edges {
            let (pivot, border) = (edge.pivot as usize, edge.border as usize);
            raw[pivot * border_rows + border] = matrix.entry(edge.of_border as usize);
            upper[border * rows + pivot] = matrix.entry(edge.of_pivot as usize);
        }
        for child in children.into_iter().flatten() {
            add_child(child, [rows, border_rows], [inverse, raw, upper, update_matrix]);
        }
        // P^-1, -B P^-1 and the update matrix C' - B P^-1 C
        let (raw, rest) = scratch.split_at_mut(border_rows * s);
        let is_finite = invert(simd, inverse, s, [rest, &mut *pack], packs);
        flush_negligible(inverse);
        flush_negligible(upper);
        for value in &mut *raw {
            *value = -significant(*value);
        }
        lower.fill(T::zero());
        let raw = Block { values: raw, stride: border_rows };
        let of_pivots = Block { values: inverse, stride: rows };
        let sizes = [border_rows, s, s];
        add_divided_product(simd, [lower, &mut *pack], packs, border_rows, [raw, of_pivots], sizes);
        flush_negligible(lower);
        let (lower, upper) =
            (Block { values: lower, stride: border_rows }, Block { values: upper, stride: rows });
        let sizes = [border_rows, s, b];
        add_divided_product(simd, [update_matrix, pack], packs, border_rows, [lower, upper], sizes);
        is_finite
    }
}

/// Extend-add of a column of a child's update matrix to the rows of a front, from row `from` on.
#[inline(always)]
pub(super) fn extend_add<T: Real>(out: &mut [T], values: &[T], index_ranges: &[IndexRange], from: usize) {
    for range in index_ranges {
        let (start, length) = (range.from as usize, range.length as usize);
        for (out, value) in
            out[range.to as usize - from..][..length].iter_mut().zip(&values[start..][..length])
        {
            *out += *value;
        }
    }
}
