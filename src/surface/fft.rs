//! The complex Fourier transform of a periodic field.

use std::sync::Arc;

use num_complex::Complex64;
use rustfft::{Fft, FftDirection, FftPlanner};

/// Transforms of `nx` x `ny` fields, row-major, both directions without normalisation.
pub(super) struct Fft2 {
    nx: usize,
    ny: usize,
    planner: FftPlanner<f64>,
}

impl Fft2 {
    pub(super) fn new(nx: usize, ny: usize) -> Self {
        Self { nx, ny, planner: FftPlanner::new() }
    }

    /// Overwrites `field` (`nx * ny` values) with its transform.
    pub(super) fn process(&mut self, field: &mut [Complex64], direction: FftDirection) {
        let rows = self.planner.plan_fft(self.nx, direction);
        let columns = self.planner.plan_fft(self.ny, direction);
        rows.process(field);
        self.process_columns(field, &columns);
    }

    fn process_columns(&self, field: &mut [Complex64], plan: &Arc<dyn Fft<f64>>) {
        let mut column = vec![Complex64::default(); self.ny];
        let mut scratch = vec![Complex64::default(); plan.get_inplace_scratch_len()];
        for i in 0..self.nx {
            for (value, source) in column.iter_mut().zip(field.iter().skip(i).step_by(self.nx)) {
                *value = *source;
            }
            plan.process_with_scratch(&mut column, &mut scratch);
            for (value, target) in column.iter().zip(field.iter_mut().skip(i).step_by(self.nx)) {
                *target = *value;
            }
        }
    }
}
