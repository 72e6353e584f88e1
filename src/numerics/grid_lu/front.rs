//! What is done on one front: elimination of its pivots, and both halves of a substitution.
//!
//! All of it is inlined where vector instructions are switched on; closures would not be.

use pulp::Simd;

use super::dense::{Block, add_matrix_product, add_product, invert};
use super::dissection::Run;
use super::tree::{Branch, Walk};

/// Smallest pivot, the largest entry of a row being one.
const SMALLEST_PIVOT: f32 = 1e-6;

impl Walk<'_> {
    /// Eliminates the pivots of front `f`. Returns whether all were numbers.
    #[inline(always)]
    pub(super) fn eliminate_front<S: Simd>(
        &self,
        simd: S,
        f: usize,
        branch: Branch<'_>,
        linked: &[bool],
    ) -> bool {
        let Branch { first, factors, remainders, idle, scratch, .. } = branch;
        let front = &self.fronts[f];
        let (s, b) = (front.pivots.len(), front.border.len());
        let (rows, border_rows) = (front.pivot_rows(), front.border_rows());
        let stride = rows + border_rows;
        let start = self.starts.factors[f] - self.starts.factors[first];
        let (pivot_columns, rest) = factors[start..].split_at_mut(s * stride);
        let border_columns = &mut rest[..rows * b];
        idle[f - first] = front.children.iter().all(|child| idle[child.front - first])
            && linked[front.pivots.clone()].iter().all(|&linked| !linked);
        if idle[f - first] {
            for value in pivot_columns.iter_mut().step_by(stride + 1).take(s) {
                *value = 1.0 / *value;
            }
            return true;
        }
        let start = self.starts.remainders[f] - self.starts.remainders[first];
        let (below, own) = remainders.split_at_mut(start);
        let remainder = &mut own[..border_rows * b];
        remainder.fill(0.0);
        for child in &front.children {
            if !idle[child.front - first] {
                let start = self.starts.remainders[child.front] - self.starts.remainders[first];
                let columns = below[start..].chunks_exact(self.fronts[child.front].border_rows());
                add_child(
                    pivot_columns,
                    border_columns,
                    remainder,
                    columns,
                    &child.runs,
                    [rows, border_rows],
                );
            }
        }
        let Some(scratch) = scratch.first_mut() else { return false };
        let sound = invert(pivot_columns, stride, s, SMALLEST_PIVOT, scratch);
        if b > 0 {
            let (raw, rest) = scratch.split_at_mut(border_rows * s);
            let inverse = &mut rest[..rows * s];
            let copies = raw.chunks_exact_mut(border_rows).zip(inverse.chunks_exact_mut(rows));
            for (column, (raw, inverse)) in pivot_columns.chunks_exact_mut(stride).zip(copies) {
                let (own, below) = column.split_at_mut(rows);
                inverse.copy_from_slice(own);
                for (raw, value) in raw.iter_mut().zip(below) {
                    *raw = -*value;
                    *value = 0.0;
                }
            }
            let (raw, inverse) =
                (Block { values: raw, stride: border_rows }, Block { values: inverse, stride: rows });
            add_matrix_product(simd, &mut pivot_columns[rows..], stride, raw, inverse, [border_rows, s, s]);
            let lower = Block { values: &pivot_columns[rows..], stride };
            let upper = Block { values: border_columns, stride: rows };
            add_matrix_product(simd, remainder, border_rows, lower, upper, [border_rows, s, b]);
            let raw = &mut scratch[..rows * b];
            for (raw, value) in raw.iter_mut().zip(&mut *border_columns) {
                *raw = -*value;
                *value = 0.0;
            }
            let (inverse, raw) =
                (Block { values: pivot_columns, stride }, Block { values: raw, stride: rows });
            add_matrix_product(simd, border_columns, rows, inverse, raw, [rows, s, b]);
        }
        sound
    }

    /// Makes of the right-hand side at the pivots of front `f` the solution without its border, and its border's share.
    #[inline(always)]
    pub(super) fn forward_front<S: Simd>(&self, simd: S, f: usize, branch: Branch<'_>) {
        let Branch { first, factors, vectors, idle, scratch, .. } = branch;
        if idle[f - first] {
            return;
        }
        let front = &self.fronts[f];
        let (s, rows) = (front.pivots.len(), front.pivot_rows());
        let stride = rows + front.border_rows();
        let start = self.starts.vectors[f] - self.starts.vectors[first];
        let (below, own) = vectors.split_at_mut(start);
        let own = &mut own[..stride];
        own[rows..].fill(0.0);
        for child in front.children.iter().filter(|child| !idle[child.front - first]) {
            let start = self.starts.vectors[child.front] - self.starts.vectors[first];
            add_runs(own, &below[start + self.fronts[child.front].pivot_rows()..], &child.runs, 0);
        }
        let Some(scratch) = scratch.first_mut() else { return };
        scratch[..s].copy_from_slice(&own[..s]);
        own[..rows].fill(0.0);
        let start = self.starts.factors[f] - self.starts.factors[first];
        add_product(simd, own, Block { values: &factors[start..][..s * stride], stride }, &scratch[..s]);
    }

    /// Subtracts the border from the solution at the pivots of front `f`, and hands both to its children.
    #[inline(always)]
    pub(super) fn backward_front<S: Simd>(&self, simd: S, f: usize, branch: Branch<'_>) {
        let Branch { first, factors, vectors, idle, .. } = branch;
        let front = &self.fronts[f];
        let (s, b, rows) = (front.pivots.len(), front.border.len(), front.pivot_rows());
        let stride = rows + front.border_rows();
        let start = self.starts.vectors[f] - self.starts.vectors[first];
        let (below, own) = vectors.split_at_mut(start);
        let own = &mut own[..stride];
        let start = self.starts.factors[f] - self.starts.factors[first];
        let (pivot_columns, border_columns) = factors[start..].split_at(s * stride);
        if idle[f - first] {
            for (value, inverse) in own[..s].iter_mut().zip(pivot_columns.iter().step_by(stride + 1)) {
                *value *= inverse;
            }
            return;
        }
        let (pivots, border) = own.split_at_mut(rows);
        add_product(simd, pivots, Block { values: &border_columns[..rows * b], stride: rows }, &border[..b]);
        for child in front.children.iter().filter(|child| !idle[child.front - first]) {
            let start = self.starts.vectors[child.front] - self.starts.vectors[first];
            let to = &mut below[start + self.fronts[child.front].pivot_rows()..];
            for run in &child.runs {
                to[run.from..][..run.length].copy_from_slice(&own[run.to..][..run.length]);
            }
        }
    }
}

/// Adds the remainder of a child, whose border is where `runs` say, to the blocks of a front.
#[inline(always)]
fn add_child<'a>(
    pivot_columns: &mut [f32],
    border_columns: &mut [f32],
    remainder: &mut [f32],
    mut columns: impl Iterator<Item = &'a [f32]>,
    runs: &[Run],
    [rows, border_rows]: [usize; 2],
) {
    let stride = rows + border_rows;
    let (on_pivots, on_border) = runs.split_at(runs.partition_point(|run| run.to < rows));
    for run in on_pivots {
        for (to, column) in (run.to..run.to + run.length).zip(&mut columns) {
            add_runs(&mut pivot_columns[to * stride..][..stride], column, runs, 0);
        }
    }
    for run in on_border {
        for (to, column) in (run.to - rows..run.to - rows + run.length).zip(&mut columns) {
            add_runs(&mut border_columns[to * rows..][..rows], column, on_pivots, 0);
            add_runs(&mut remainder[to * border_rows..][..border_rows], column, on_border, rows);
        }
    }
}

/// Adds the border of a child to the rows of a front from row `from` on.
#[inline(always)]
fn add_runs(out: &mut [f32], values: &[f32], runs: &[Run], from: usize) {
    for run in runs {
        let values = &values[run.from..][..run.length];
        for (out, value) in out[run.to - from..][..run.length].iter_mut().zip(values) {
            *out += value;
        }
    }
}
