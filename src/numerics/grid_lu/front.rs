//! What is done on one front: elimination of its pivots, and both halves of a substitution.
//!
//! All of it is inlined where vector instructions are switched on; closures would not be.

use pulp::{Scalar, Simd, WithSimd};

use super::Matrix;
use super::dense::{
    Block, VECTOR, add_matrix_product, add_product, invert, neglect, packed, padded, significant,
};
use super::structure::{Edge, Front, Run, Structure};

/// Smallest pivot, the largest entry of a row being one. Pivots may be small by the units of the unknowns alone:
/// that of a flow beside pressures which move 1e9 times as much.
pub(super) const SMALLEST_PIVOT: f32 = 1e-15;

/// What a front keeps of its elimination.
///
/// With the block `P` of the pivots, `B` below it and `C` beside it: `P^-1`, `-B P^-1` and `C`. Every node of
/// the border of a leaf has one neighbour among the pivots, so that `-B` and `C` have one entry for each, and
/// these are kept.
struct Parts<'a> {
    /// `P^-1`, padded rows, a column for each pivot.
    inverse: &'a mut [f32],
    /// `-B P^-1`; of a leaf `-B`.
    lower: &'a mut [f32],
    /// `C`.
    upper: &'a mut [f32],
}

impl Front {
    /// Number of values of each of the parts.
    fn part_lengths(&self) -> [usize; 3] {
        let [s, b] = self.size();
        let (rows, border_rows) = (self.pivot_rows(), self.border_rows());
        if self.is_leaf {
            [rows * s, border_rows, border_rows]
        } else {
            [rows * s, border_rows * s, rows * b]
        }
    }

    /// Number of values that the front keeps.
    pub(super) fn factors(&self) -> usize {
        self.part_lengths().into_iter().sum()
    }

    /// Number of values that the front leaves for its parent.
    pub(super) fn remainder(&self) -> usize {
        self.border_rows() * self.size()[1]
    }

    /// Number of values that the front needs for a while.
    pub(super) fn scratch(&self) -> usize {
        let [s, b] = self.size();
        packed(s) + self.border_rows() * s + (self.pivot_rows() * s).max(padded(b))
    }

    /// The three parts within what the front keeps.
    #[inline(always)]
    fn parts<'a>(&self, values: &'a mut [f32]) -> Parts<'a> {
        let [inverse, lower, upper] = self.part_lengths();
        let (inverse, rest) = values.split_at_mut(inverse);
        let (lower, rest) = rest.split_at_mut(lower);
        Parts { inverse, lower, upper: &mut rest[..upper] }
    }

    /// Subtracts from the border rows of `own` what the pivots hold, whose right-hand side comes before them.
    #[inline(always)]
    pub(super) fn forward<S: Simd>(&self, simd: S, edges: &[Edge], [values, own, scratch]: [&mut [f32]; 3]) {
        let (s, rows, stride) = (self.pivots.len(), self.pivot_rows(), self.border_rows());
        let Parts { inverse, lower, .. } = self.parts(values);
        let (pivots, border) = own.split_at_mut(rows);
        if self.is_leaf {
            let solution = &mut scratch[..rows];
            solution.fill(0.0);
            add_product(simd, solution, Block { values: inverse, stride: rows }, &pivots[..s]);
            for ((out, lower), edge) in border.iter_mut().zip(&*lower).zip(edges) {
                *out += lower * solution[edge.pivot as usize];
            }
        } else {
            add_product(simd, border, Block { values: lower, stride }, &pivots[..s]);
        }
    }

    /// The solution at the pivots under that of the border, which follows them in `own`.
    #[inline(always)]
    pub(super) fn backward<S: Simd>(&self, simd: S, edges: &[Edge], [values, own, scratch]: [&mut [f32]; 3]) {
        let ([s, b], rows) = (self.size(), self.pivot_rows());
        let Parts { inverse, upper, .. } = self.parts(values);
        let (pivots, border) = own.split_at_mut(rows);
        if self.is_leaf {
            for ((value, upper), edge) in border.iter().zip(&*upper).zip(edges) {
                pivots[edge.pivot as usize] -= upper * value;
            }
        } else {
            for (negative, value) in scratch.iter_mut().zip(&border[..b]) {
                *negative = -value;
            }
            add_product(simd, pivots, Block { values: upper, stride: rows }, &scratch[..b]);
        }
        let right = &mut scratch[..s];
        right.copy_from_slice(&pivots[..s]);
        pivots.fill(0.0);
        add_product(simd, pivots, Block { values: inverse, stride: rows }, right);
    }
}

/// Elimination of a front: with all vector instructions of the machine only what is inlined here.
pub(super) struct Elimination<'a, 'b> {
    /// The front.
    pub(super) front: &'a Front,
    /// All fronts.
    pub(super) structure: &'a Structure,
    /// The matrix.
    pub(super) matrix: Matrix<'a>,
    /// What it keeps.
    pub(super) values: &'b mut [f32],
    /// What its children have left, and where it goes.
    pub(super) children: [Option<(Block<'b>, &'a [Run])>; 2],
    /// What it leaves for its parent.
    pub(super) remainder: &'b mut [f32],
    /// Work space.
    pub(super) scratch: &'b mut [f32],
}

impl WithSimd for Elimination<'_, '_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        // Wider vectors than the columns are padded for: rare, and correct without any.
        if S::F32_LANES > VECTOR { self.run(Scalar) } else { self.run(simd) }
    }
}

impl Elimination<'_, '_> {
    /// Eliminates; whether all pivots were numbers.
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        let Self { front, structure, matrix, values, children, remainder, scratch } = self;
        let ([s, b], edges) = (front.size(), structure.edges(front));
        let (rows, border_rows) = (front.pivot_rows(), front.border_rows());
        let Parts { inverse, lower, upper } = front.parts(values);
        let (pack, scratch) = scratch.split_at_mut(packed(s));
        inverse.fill(0.0);
        structure.place_entries(front, matrix, inverse);
        if front.is_leaf {
            let sound = invert(simd, inverse, s, SMALLEST_PIVOT, [scratch, pack]);
            neglect(inverse);
            for (place, edge) in edges.iter().enumerate() {
                lower[place] = -matrix.entry(edge.of_border as usize);
                upper[place] = matrix.entry(edge.of_pivot as usize);
            }
            for (column, edge) in remainder.chunks_exact_mut(border_rows.max(1)).zip(edges) {
                let inverse = &inverse[edge.pivot as usize * rows..][..rows];
                let value = matrix.entry(edge.of_pivot as usize);
                for ((out, row), lower) in column.iter_mut().zip(edges).zip(&*lower) {
                    *out = significant(lower * inverse[row.pivot as usize]) * value;
                }
            }
            return sound;
        }
        let raw = &mut scratch[..border_rows * s];
        raw.fill(0.0);
        upper.fill(0.0);
        remainder.fill(0.0);
        for edge in edges {
            let (pivot, border) = (edge.pivot as usize, edge.border as usize);
            raw[pivot * border_rows + border] = matrix.entry(edge.of_border as usize);
            upper[border * rows + pivot] = matrix.entry(edge.of_pivot as usize);
        }
        for (left, runs) in children.into_iter().flatten() {
            let mut columns = left.values.chunks_exact(left.stride);
            let (on_pivots, on_border) = runs.split_at(runs.partition_point(|run| (run.to as usize) < rows));
            for run in on_pivots {
                for (to, column) in run.rows().zip(&mut columns) {
                    add_runs(&mut inverse[to * rows..][..rows], column, on_pivots, 0);
                    add_runs(&mut raw[to * border_rows..][..border_rows], column, on_border, rows);
                }
            }
            for run in on_border {
                for (to, column) in run.rows().zip(&mut columns) {
                    let to = to - rows;
                    add_runs(&mut upper[to * rows..][..rows], column, on_pivots, 0);
                    add_runs(&mut remainder[to * border_rows..][..border_rows], column, on_border, rows);
                }
            }
        }
        let (raw, rest) = scratch.split_at_mut(border_rows * s);
        let sound = invert(simd, inverse, s, SMALLEST_PIVOT, [rest, &mut *pack]);
        neglect(inverse);
        neglect(upper);
        for value in &mut *raw {
            *value = -significant(*value);
        }
        lower.fill(0.0);
        let raw = Block { values: raw, stride: border_rows };
        let of_pivots = Block { values: inverse, stride: rows };
        add_matrix_product(simd, [lower, &mut *pack], border_rows, raw, of_pivots, [border_rows, s, s]);
        neglect(lower);
        let (lower, upper) =
            (Block { values: lower, stride: border_rows }, Block { values: upper, stride: rows });
        add_matrix_product(simd, [remainder, pack], border_rows, lower, upper, [border_rows, s, b]);
        sound
    }
}

/// Adds the border of a child to the rows of a front from row `from` on.
#[inline(always)]
pub(super) fn add_runs(out: &mut [f32], values: &[f32], runs: &[Run], from: usize) {
    for run in runs {
        let (start, length) = (run.from as usize, run.length as usize);
        for (out, value) in out[run.to as usize - from..][..length].iter_mut().zip(&values[start..][..length])
        {
            *out += value;
        }
    }
}
