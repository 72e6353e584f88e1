//! Fourier transforms of periodic fields.

use std::sync::Arc;

use num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
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
        rows.process(field);
        let mut columns = Columns::new(&mut self.planner, self.nx, self.ny, direction);
        for start in (0..self.nx).step_by(BLOCK) {
            columns.gather(field, start);
            columns.transform();
            columns.scatter(field, start);
        }
    }
}

/// Transforms of real `nx` x `ny` fields, of which `nx / 2 + 1` columns of the spectrum tell all.
pub(crate) struct RealFft2 {
    nx: usize,
    ny: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    planner: FftPlanner<f64>,
}

impl RealFft2 {
    pub(crate) fn new(nx: usize, ny: usize) -> Self {
        let mut real = RealFftPlanner::new();
        let (forward, inverse) = (real.plan_fft_forward(nx), real.plan_fft_inverse(nx));
        Self { nx, ny, forward, inverse, planner: FftPlanner::new() }
    }

    /// Columns of the spectrum that are kept.
    fn width(&self) -> usize {
        self.nx / 2 + 1
    }

    /// Overwrites `field` with its transform, changed by `each` and transformed back (without normalisation). `each` gets the
    /// index of a wave in a quarter of `nx / 2 + 1` x `ny / 2 + 1` waves, how many waves along x its value stands for,
    /// and the value.
    pub(crate) fn filter(&mut self, field: &mut [f64], mut each: impl FnMut(usize, f64, &mut Complex64)) {
        let (nx, ny, width) = (self.nx, self.ny, self.width());
        let mut spectrum = vec![Complex64::default(); width * ny];
        let mut scratch = self.forward.make_scratch_vec();
        for (row, out) in field.chunks_exact_mut(nx).zip(spectrum.chunks_exact_mut(width)) {
            let result = self.forward.process_with_scratch(row, out, &mut scratch);
            debug_assert!(result.is_ok(), "lengths fit");
        }
        let mut columns = Columns::new(&mut self.planner, width, ny, FftDirection::Forward);
        let mut back = Columns::new(&mut self.planner, width, ny, FftDirection::Inverse);
        for start in (0..width).step_by(BLOCK) {
            columns.gather(&spectrum, start);
            columns.transform();
            for (at, column) in columns.values.chunks_exact_mut(ny).enumerate() {
                let i = start + at;
                let waves = if i == 0 || 2 * i == nx { 1.0 } else { 2.0 };
                for (j, value) in column.iter_mut().enumerate() {
                    each(j.min(ny - j) * width + i, waves, value);
                }
            }
            std::mem::swap(&mut columns.values, &mut back.values);
            back.transform();
            back.scatter(&mut spectrum, start);
            std::mem::swap(&mut columns.values, &mut back.values);
        }
        let mut scratch = self.inverse.make_scratch_vec();
        for (row, values) in field.chunks_exact_mut(nx).zip(spectrum.chunks_exact_mut(width)) {
            // these are real but for rounding
            values[0].im = 0.0;
            if nx.is_multiple_of(2) {
                values[width - 1].im = 0.0;
            }
            let result = self.inverse.process_with_scratch(values, row, &mut scratch);
            debug_assert!(result.is_ok(), "lengths fit");
        }
    }

    /// Transform of a field that mirrors itself along both axes, given and returned as its `nx / 2 + 1` x `ny / 2 + 1` first
    /// values. Both directions are the same.
    pub(crate) fn symmetric(&mut self, quarter: &[f64]) -> Vec<f64> {
        let (nx, ny, width) = (self.nx, self.ny, self.width());
        let mut rows = Vec::with_capacity(quarter.len());
        let (mut row, mut out) = (vec![0.0; nx], vec![Complex64::default(); width]);
        let mut scratch = self.forward.make_scratch_vec();
        for values in quarter.chunks_exact(width) {
            row[..width].copy_from_slice(values);
            for i in width..nx {
                row[i] = values[nx - i];
            }
            let result = self.forward.process_with_scratch(&mut row, &mut out, &mut scratch);
            debug_assert!(result.is_ok(), "lengths fit");
            rows.extend(out.iter().map(|value| value.re));
        }
        let plan = self.planner.plan_fft_forward(ny);
        let mut column = vec![Complex64::default(); ny];
        let mut scratch = vec![Complex64::default(); plan.get_inplace_scratch_len()];
        // transforms of mirrored columns are real, so two share one
        for start in (0..width).step_by(2) {
            let second = (start + 1).min(width - 1);
            for (j, value) in column.iter_mut().enumerate() {
                let row = j.min(ny - j) * width;
                *value = Complex64::new(rows[row + start], rows[row + second]);
            }
            plan.process_with_scratch(&mut column, &mut scratch);
            for (values, result) in rows.chunks_exact_mut(width).zip(&column) {
                values[second] = result.im;
                values[start] = result.re;
            }
        }
        rows
    }
}

/// A block of columns, each contiguous, with what their transform needs.
struct Columns {
    nx: usize,
    ny: usize,
    plan: Arc<dyn Fft<f64>>,
    values: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl Columns {
    fn new(planner: &mut FftPlanner<f64>, nx: usize, ny: usize, direction: FftDirection) -> Self {
        let plan = planner.plan_fft(ny, direction);
        let scratch = vec![Complex64::default(); plan.get_inplace_scratch_len()];
        Self { nx, ny, plan, values: Vec::new(), scratch }
    }

    /// Takes the columns from `start` on.
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

    fn transform(&mut self) {
        self.plan.process_with_scratch(&mut self.values, &mut self.scratch);
    }

    /// Puts the columns back.
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

    const SHAPES: [(usize, usize); 8] = [(64, 48), (17, 9), (8, 1), (1, 8), (5, 2), (2, 5), (1, 1), (40, 37)];

    #[test]
    fn mirrored_fields_need_a_quarter() {
        for (nx, ny) in SHAPES {
            let at = |k: usize| 1.0 / (1.0 + (k * k) as f64);
            let folded = |k: usize| [(k % nx).min(nx - k % nx), (k / nx).min(ny - k / nx)];
            let mut whole: Vec<Complex64> =
                (0..nx * ny).map(folded).map(|[i, j]| Complex64::from(at(i + 3 * j))).collect();
            let (width, height) = (nx / 2 + 1, ny / 2 + 1);
            let quarter: Vec<f64> = (0..width * height).map(|k| at(k % width + 3 * (k / width))).collect();
            let found = RealFft2::new(nx, ny).symmetric(&quarter);
            Fft2::new(nx, ny).process(&mut whole, FftDirection::Forward);
            for (k, value) in whole.iter().enumerate() {
                let [i, j] = folded(k);
                assert!((found[j * width + i] - value).norm() < 1e-12, "{nx} x {ny}: {k}");
            }
        }
    }

    #[test]
    fn filters_of_real_fields_are_those_of_complex_ones() {
        for (nx, ny) in SHAPES {
            let width = nx / 2 + 1;
            let start: Vec<f64> = (0..nx * ny).map(|k| (k as f64 * 1.7).sin()).collect();
            let factor = |wave: usize| 1.0 / (1.0 + wave as f64);
            let mut found = start.clone();
            let mut count = 0.0;
            RealFft2::new(nx, ny).filter(&mut found, |wave, waves, value| {
                count += waves;
                *value *= factor(wave);
            });
            assert!((count - (nx * ny) as f64).abs() < 1e-12, "{nx} x {ny}: {count} waves");
            let mut field: Vec<Complex64> = start.into_iter().map(Complex64::from).collect();
            let mut transform = Fft2::new(nx, ny);
            transform.process(&mut field, FftDirection::Forward);
            for (k, value) in field.iter_mut().enumerate() {
                let (i, j) = ((k % nx).min(nx - k % nx), (k / nx).min(ny - k / nx));
                *value *= factor(j * width + i);
            }
            transform.process(&mut field, FftDirection::Inverse);
            for (a, b) in found.iter().zip(&field) {
                assert!((a - b.re).abs() < 1e-11, "{nx} x {ny}: {a} {b}");
            }
        }
    }
}
