//! Fourier transforms of periodic fields.
//!
//! Complex fields of `nx` x `ny` values, row-major: `F[l, k] = sum f[j, i] exp(-+ 2 pi i (k i/nx + l j/ny))`
//! with the upper sign for the forward transform. A forward and an inverse transform multiply a field by
//! `nx ny`.
//!
//! Real fields use [`RealFft2`](super::RealFft2); spectra and correlations need the complex transform.

use std::sync::Arc;

use num_complex::Complex64;
use rustfft::{Fft, FftDirection, FftPlanner};

/// Number of columns in a block, so that whole cache lines are read.
const BLOCK: usize = 16;

/// Transforms of row-major `nx` x `ny` fields, both directions without normalization.
pub(crate) struct Fft2 {
    /// Columns.
    nx: usize,
    /// Rows.
    ny: usize,
    /// Creates and caches plans.
    planner: FftPlanner<f64>,
}

impl Fft2 {
    /// Transforms for one shape; plans are created on first use.
    pub(crate) fn new(nx: usize, ny: usize) -> Self {
        Self { nx, ny, planner: FftPlanner::new() }
    }

    /// Overwrites `field` (`nx * ny` values) with its transform.
    pub(crate) fn process(&mut self, field: &mut [Complex64], direction: FftDirection) {
        let rows = self.planner.plan_fft(self.nx, direction);
        rows.process(field);
        let mut columns = Columns::new(&mut self.planner, self.nx, self.ny, direction);
        for start in (0..self.nx).step_by(BLOCK) {
            columns.gather(field, start);
            columns.transform();
            columns.scatter(field, start);
        }
    }
}

/// A block of contiguous columns and the workspace of their transform.
struct Columns {
    nx: usize,
    ny: usize,
    /// Transform of one column.
    plan: Arc<dyn Fft<f64>>,
    /// The columns, one after another.
    values: Vec<Complex64>,
    /// Workspace of the transform.
    scratch: Vec<Complex64>,
}

impl Columns {
    /// Buffers for blocks of columns of `ny` values.
    fn new(planner: &mut FftPlanner<f64>, nx: usize, ny: usize, direction: FftDirection) -> Self {
        let plan = planner.plan_fft(ny, direction);
        let scratch = vec![Complex64::default(); plan.get_inplace_scratch_len()];
        Self { nx, ny, plan, values: Vec::new(), scratch }
    }

    /// Copies a block of columns, starting at `start`, from the field.
    fn gather(&mut self, field: &[Complex64], start: usize) {
        let width = BLOCK.min(self.nx - start);
        let ny = self.ny;
        self.values.resize(width * ny, Complex64::default());
        for (j, row) in field.chunks_exact(self.nx).enumerate() {
            for (i, value) in row[start..start + width].iter().enumerate() {
                self.values[i * ny + j] = *value;
            }
        }
    }

    /// Transforms the block.
    fn transform(&mut self) {
        self.plan.process_with_scratch(&mut self.values, &mut self.scratch);
    }

    /// Copies the block back into the field.
    fn scatter(&self, field: &mut [Complex64], start: usize) {
        let width = BLOCK.min(self.nx - start);
        for (j, row) in field.chunks_exact_mut(self.nx).enumerate() {
            for (i, value) in row[start..start + width].iter_mut().enumerate() {
                *value = self.values[i * self.ny + j];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_columns_change_no_bit() {
        for (nx, ny) in [(64, 48), (128, 128), (7, 5), (17, 40), (1, 9), (33, 1)] {
            let start: Vec<Complex64> =
                (0..nx * ny).map(|k| Complex64::new((k as f64).sin(), (k * k % 7) as f64)).collect();
            let mut blocked = start.clone();
            Fft2::new(nx, ny).process(&mut blocked, FftDirection::Forward);
            let mut single = start;
            let mut planner = FftPlanner::new();
            planner.plan_fft_forward(nx).process(&mut single);
            let plan = planner.plan_fft_forward(ny);
            for i in 0..nx {
                let mut column: Vec<Complex64> = single.iter().skip(i).step_by(nx).copied().collect();
                plan.process(&mut column);
                single.iter_mut().skip(i).step_by(nx).zip(&column).for_each(|(to, from)| *to = *from);
            }
            assert_eq!(blocked, single, "{nx} x {ny}");
        }
    }
}
