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
        rows.process(field);
        let mut columns = Columns::new(&mut self.planner, self.nx, self.ny, direction);
        for start in (0..self.nx).step_by(BLOCK) {
            columns.gather(field, start);
            columns.transform();
            columns.scatter(field, start);
        }
    }

    /// Transforms a field that mirrors itself (row `j` is row `ny - j`), given as its rows 0 to `ny / 2`, to the same form.
    /// Both directions are the same.
    pub(crate) fn process_symmetric(&mut self, half: &mut [Complex64]) {
        let rows = self.planner.plan_fft_forward(self.nx);
        rows.process(half);
        let mut columns = Columns::new(&mut self.planner, self.nx, self.ny, FftDirection::Forward);
        for start in (0..self.nx).step_by(BLOCK) {
            columns.gather(half, start);
            columns.transform();
            columns.scatter(half, start);
        }
    }

    /// Overwrites `field` with its forward transform and each value of that with what `each` makes of it and of the transform
    /// of `half` (rows 0 to `ny / 2` of a field that mirrors itself, used up). `each` also gets the index of the value,
    /// in no order.
    pub(crate) fn filter(
        &mut self,
        field: &mut [Complex64],
        half: &mut [Complex64],
        mut each: impl FnMut(usize, &mut Complex64, Complex64),
    ) {
        let rows = self.planner.plan_fft_forward(self.nx);
        rows.process(field);
        rows.process(half);
        let mut columns = Columns::new(&mut self.planner, self.nx, self.ny, FftDirection::Forward);
        let mut filters = Columns::new(&mut self.planner, self.nx, self.ny, FftDirection::Forward);
        for start in (0..self.nx).step_by(BLOCK) {
            columns.gather(field, start);
            columns.transform();
            filters.gather(half, start);
            filters.transform();
            for (at, (value, filter)) in columns.values.iter_mut().zip(&filters.values).enumerate() {
                each(at % self.ny * self.nx + start + at / self.ny, value, *filter);
            }
            columns.scatter(field, start);
        }
    }

    /// Calls `each` for every value of `field` with that of the mirrored field whose rows 0 to `ny / 2` are `half`.
    pub(crate) fn for_symmetric(
        &self,
        field: &mut [Complex64],
        half: &[Complex64],
        mut each: impl FnMut(&mut Complex64, Complex64),
    ) {
        for (j, row) in field.chunks_exact_mut(self.nx).enumerate() {
            let mirrored = j.min(self.ny - j) * self.nx;
            for (value, other) in row.iter_mut().zip(&half[mirrored..mirrored + self.nx]) {
                each(value, *other);
            }
        }
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

    /// Takes the columns from `start` on; rows that the field lacks mirror those that it has.
    fn gather(&mut self, field: &[Complex64], start: usize) {
        let width = BLOCK.min(self.nx - start);
        let ny = self.ny;
        self.values.resize(width * ny, Complex64::default());
        let given = field.len() / self.nx;
        for j in 0..ny {
            let row = if j < given { j } else { ny - j } * self.nx + start;
            for (i, value) in field[row..row + width].iter().enumerate() {
                self.values[i * ny + j] = *value;
            }
        }
    }

    fn transform(&mut self) {
        self.plan.process_with_scratch(&mut self.values, &mut self.scratch);
    }

    /// Puts the columns back, as many rows as the field has.
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

    #[test]
    fn half_of_a_mirrored_field_gives_the_bits_of_the_whole() {
        for (nx, ny) in [(64, 48), (17, 9), (8, 1), (1, 8), (5, 2)] {
            let at = |k: usize| Complex64::new(1.0 / (1.0 + k as f64), 0.0);
            let whole: Vec<Complex64> = (0..nx * ny)
                .map(|k| (k % nx, k / nx))
                .map(|(i, j)| at(i.min(nx - i) + 3 * j.min(ny - j)))
                .collect();
            let noise: Vec<Complex64> = (0..nx * ny).map(|k| Complex64::new((k as f64).sin(), 0.0)).collect();
            let mut half = whole[..nx * (ny / 2 + 1)].to_vec();
            let mut transform = Fft2::new(nx, ny);
            let (mut expected, mut filter, mut found) = (noise.clone(), whole, noise);
            transform.process(&mut expected, FftDirection::Forward);
            transform.process(&mut filter, FftDirection::Forward);
            let rows = half.len();
            let mut symmetric = half.clone();
            transform.process_symmetric(&mut symmetric);
            assert_eq!(symmetric, filter[..rows]);
            let mut seen = vec![0; nx * ny];
            transform.filter(&mut found, &mut half, |k, value, density| {
                assert_eq!(density, filter[k]);
                seen[k] += 1;
                *value *= density.re;
            });
            for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
                assert_eq!((*found, seen[k]), (*expected * filter[k].re, 1));
            }
        }
    }
}
