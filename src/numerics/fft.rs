//! The complex Fourier transform of a periodic field.

use std::sync::Arc;

use num_complex::Complex64;
use rustfft::{Fft, FftDirection, FftPlanner};

/// Columns transformed together, so that the field is read in whole cache lines.
const BLOCK: usize = 16;

/// Transforms of `nx` x `ny` fields, row-major, both directions without normalisation.
pub(crate) struct Fft2 {
    nx: usize,
    ny: usize,
    planner: FftPlanner<f64>,
}

impl Fft2 {
    pub(crate) fn new(nx: usize, ny: usize) -> Self {
        Self { nx, ny, planner: FftPlanner::new() }
    }

    /// Overwrites `field` (`nx * ny` values) with its transform.
    pub(crate) fn process(&mut self, field: &mut [Complex64], direction: FftDirection) {
        let rows = self.planner.plan_fft(self.nx, direction);
        let columns = self.planner.plan_fft(self.ny, direction);
        rows.process(field);
        self.process_columns(field, &columns);
    }

    fn process_columns(&self, field: &mut [Complex64], plan: &Arc<dyn Fft<f64>>) {
        let (nx, ny) = (self.nx, self.ny);
        let mut block = vec![Complex64::default(); ny * BLOCK.min(nx)];
        let mut scratch = vec![Complex64::default(); plan.get_inplace_scratch_len()];
        for start in (0..nx).step_by(BLOCK) {
            let width = BLOCK.min(nx - start);
            for (j, row) in field.chunks_exact(nx).enumerate() {
                for (i, value) in row[start..start + width].iter().enumerate() {
                    block[i * ny + j] = *value;
                }
            }
            plan.process_with_scratch(&mut block[..width * ny], &mut scratch);
            for (j, row) in field.chunks_exact_mut(nx).enumerate() {
                for (i, value) in row[start..start + width].iter_mut().enumerate() {
                    *value = block[i * ny + j];
                }
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
