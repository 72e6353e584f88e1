//! Discrete convolution of fields on a grid through FFTs of the zero-padded (doubled) size, so that no
//! periodic image reaches the result (DC-FFT: Liu, Wang and Liu 2000, Wear 243, 101-111).
//!
//! With a kernel `K` on the offsets of an `nx` x `ny` grid the result is
//! `out[j, i] = sum K(i - k, j - l) f[l, k]` over all nodes. Fields are padded with zeros to the next fast
//! length from `2 n - 1` on along each axis, transformed along rows and then columns, multiplied by the
//! spectrum of the kernel, which holds the factor `1/(px py)` of the inverse, and transformed back. It costs
//! `O(n log n)` and agrees with the direct sum to rounding.
//!
//! Rows and columns are padded a few at a time, so memory is that of the fields and not of the doubled grid.

use std::fmt;
use std::sync::Arc;

use num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};

use super::parallel::{chunk_count, for_each_chunk};
use super::precision::Precision;
use super::spectrum::Spectrum;
use super::transpose::{BLOCK, transpose};

/// Transforms and kernel spectrum, fixed by grid and kernel. Shared by `Arc`.
#[derive(Clone)]
pub(crate) struct ConvolutionPlan<T: Precision = f64> {
    /// Columns of a field.
    nx: usize,
    /// Rows of a field.
    ny: usize,
    /// Values of a padded row, `px`.
    padded_x: usize,
    /// Values of a padded column, `py`.
    padded_y: usize,
    /// Forward transform of real rows.
    rows_forward: Arc<dyn RealToComplex<T>>,
    /// Inverse transform to real rows.
    rows_inverse: Arc<dyn ComplexToReal<T>>,
    /// Forward transform of columns.
    columns_forward: Arc<dyn Fft<T>>,
    /// Inverse transform of columns.
    columns_inverse: Arc<dyn Fft<T>>,
    /// Spectrum of the kernel, including the normalization of the inverse transform.
    spectrum: Spectrum<T>,
}

impl<T: Precision> fmt::Debug for ConvolutionPlan<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ConvolutionPlan")
            .field("size", &(self.nx, self.ny))
            .field("padded", &(self.padded_x, self.padded_y))
            .finish_non_exhaustive()
    }
}

/// The smallest even number >= `n` whose prime factors are 2, 3 and 5.
pub(crate) fn fast_length(n: usize) -> usize {
    let mut candidate = n.max(2).next_multiple_of(2);
    loop {
        let mut rest = candidate;
        for prime in [2, 3, 5] {
            while rest.is_multiple_of(prime) {
                rest /= prime;
            }
        }
        if rest == 1 {
            return candidate;
        }
        candidate += 2;
    }
}

/// Length of padded columns, at least `least`; a single row is not padded across.
fn fast_rows(ny: usize, least: usize) -> usize {
    if ny == 1 { 1 } else { fast_length(least) }
}

impl ConvolutionPlan {
    /// Plan for fields of `nx` x `ny` and the kernel `kernel(i, j)` at offsets `-nx < i < nx`,
    /// `-ny < j < ny`.
    pub(crate) fn new(nx: usize, ny: usize, kernel: impl Fn(isize, isize) -> f64) -> Self {
        Self::padded([nx, ny], [fast_length(2 * nx - 1), fast_rows(ny, 2 * ny - 1)], kernel)
    }

    /// Convolution on the periodic grid of the fields, padded only to a fast length, with minimum-image
    /// distances. It costs a quarter of the zero-padded one.
    pub(crate) fn periodic(nx: usize, ny: usize, kernel: impl Fn(isize, isize) -> f64) -> Self {
        Self::padded([nx, ny], [fast_length(nx), fast_rows(ny, ny)], kernel)
    }

    /// Convolution whose period along y is the rows of the fields, free along x.
    pub(crate) fn periodic_across(nx: usize, ny: usize, kernel: impl Fn(isize, isize) -> f64) -> Self {
        Self::padded([nx, ny], [fast_length(2 * nx - 1), ny], kernel)
    }

    /// The same on a grid that is also periodic along x, padded to a fast length there, with minimum-image distances.
    pub(crate) fn periodic_strip(nx: usize, ny: usize, kernel: impl Fn(isize, isize) -> f64) -> Self {
        Self::padded([nx, ny], [fast_length(nx), ny], kernel)
    }

    /// Convolution that is periodic along both axes with the fields as the period, by its real and even `spectrum(i, j)`
    /// at `i` waves along x and `j` along y, at most half of the cells.
    pub(crate) fn of_spectrum(nx: usize, ny: usize, spectrum: impl Fn(usize, usize) -> f64) -> Self {
        let mut plan = Self::transforms([nx, ny], [nx, ny]);
        let scale = 1.0 / (nx as f64 * ny as f64);
        let columns = (0..plan.half()).flat_map(|i| (0..ny).map(move |j| (i, j.min(ny - j))));
        let values = columns.map(|(i, j)| Complex::from(scale * spectrum(i, j))).collect();
        plan.spectrum = Spectrum::new(values, ny);
        plan
    }

    /// The plan in single precision with the kernel multiplied by `factor`: half of the memory and about half
    /// of the time.
    pub(crate) fn to_single(&self, factor: f64) -> ConvolutionPlan<f32> {
        let mut plan = ConvolutionPlan::transforms([self.nx, self.ny], [self.padded_x, self.padded_y]);
        plan.spectrum = self.spectrum.map(|value| (factor * value) as f32);
        plan
    }

    /// The convolution with the sum of the kernels of `self` and `other`, plans of one size.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self { spectrum: self.spectrum.plus(&other.spectrum, self.padded_y), ..self.clone() }
    }

    /// Plan for fields of `nx` x `ny` on a padded grid of these `lengths`.
    fn padded(size: [usize; 2], lengths: [usize; 2], kernel: impl Fn(isize, isize) -> f64) -> Self {
        let mut plan = Self::transforms(size, lengths);
        plan.spectrum = Spectrum::new(plan.kernel_spectrum(kernel), lengths[1]);
        plan
    }

    /// Transform of the kernel, wrapped around the padded grid, times `1/(px py)`, column by column.
    fn kernel_spectrum(&self, kernel: impl Fn(isize, isize) -> f64) -> Vec<Complex<f64>> {
        let (half, px, py) = (self.half(), self.padded_x, self.padded_y);
        let mut workspace = Convolution::workspace(self);
        let mut line = vec![Complex::default(); half];
        let mut spectrum = vec![Complex::default(); half * py];
        // Offsets wrap around; offsets beyond the grid stay zero.
        let offset = |i: usize, n: usize, period: usize| {
            let nearest = if 2 * i <= period { i as isize } else { i as isize - period as isize };
            (nearest.unsigned_abs() < n).then_some(nearest)
        };
        for j in 0..py {
            let Some(dj) = offset(j, self.ny, py) else { continue };
            for (i, value) in workspace.row.iter_mut().enumerate() {
                *value = offset(i, self.nx, px).map_or(0.0, |di| kernel(di, dj));
            }
            self.forward_row(&mut workspace.row, &mut line, &mut workspace.scratch);
            for (kx, value) in line.iter().enumerate() {
                spectrum[kx * py + j] = *value;
            }
        }
        self.columns_forward.process_with_scratch(&mut spectrum, &mut workspace.scratch);
        let scale = 1.0 / (px as f64 * py as f64);
        for value in &mut spectrum {
            *value *= scale;
        }
        spectrum
    }
}

impl<T: Precision> ConvolutionPlan<T> {
    /// The transforms with an empty kernel spectrum.
    fn transforms([nx, ny]: [usize; 2], [padded_x, padded_y]: [usize; 2]) -> Self {
        let mut real = RealFftPlanner::new();
        let mut complex = FftPlanner::new();
        Self {
            nx,
            ny,
            padded_x,
            padded_y,
            rows_forward: real.plan_fft_forward(padded_x),
            rows_inverse: real.plan_fft_inverse(padded_x),
            columns_forward: complex.plan_fft_forward(padded_y),
            columns_inverse: complex.plan_fft_inverse(padded_y),
            spectrum: Spectrum::General(Vec::new()),
        }
    }

    /// Inverse of this convolution plus `own` times the identity on its padded grid: the reciprocal of the
    /// spectrum, whose modulus is larger by `own`. For a periodic kernel that decays as `1/r` the inverse decays as
    /// `1/r^3`, so that periodic images affect the edges only.
    pub(crate) fn inverse_with(&self, own: f64) -> Self {
        let mut plan = self.clone();
        let scale = 1.0 / (plan.padded_x as f64 * plan.padded_y as f64);
        plan.spectrum.reciprocal(scale * scale, own * scale);
        plan
    }

    /// Length of the spectrum of a real row of `px` values: `px/2 + 1`.
    fn half(&self) -> usize {
        self.padded_x / 2 + 1
    }

    /// Spectrum of a padded row.
    fn forward_row(&self, row: &mut [T], out: &mut [Complex<T>], scratch: &mut [Complex<T>]) {
        let result = self.rows_forward.process_with_scratch(row, out, scratch);
        debug_assert!(result.is_ok(), "buffers are sized by the plan");
    }

    /// Real row from its spectrum, multiplied by `px`.
    fn inverse_row(&self, spectrum: &mut [Complex<T>], out: &mut [T], scratch: &mut [Complex<T>]) {
        // The imaginary parts of the first entry and, of an even length, of the last one are zero up to rounding;
        // realfft requires exact zeros.
        spectrum[0].im = T::zero();
        if self.padded_x.is_multiple_of(2) {
            spectrum[self.padded_x / 2].im = T::zero();
        }
        let result = self.rows_inverse.process_with_scratch(spectrum, out, scratch);
        debug_assert!(result.is_ok(), "buffers are sized by the plan");
    }
}

/// A plan with its own buffers; clones share the plan.
pub(crate) struct Convolution<T: Precision = f64> {
    /// Transforms and kernel.
    plan: Arc<ConvolutionPlan<T>>,
    /// Buffers of a convolution.
    work: Buffers<T>,
}

/// Buffers of a convolution, allocated once.
struct Buffers<T> {
    /// Spectra of the rows.
    rows: Vec<Complex<T>>,
    /// Spectra of the columns, without the padding.
    columns: Vec<Complex<T>>,
    /// One workspace for each chunk of lines.
    workspaces: Vec<Workspace<T>>,
}

/// Workspace of one thread.
struct Workspace<T> {
    /// A padded row.
    row: Vec<T>,
    /// Spectra of a block of rows.
    spectra: Vec<Complex<T>>,
    /// A block of padded columns, which stay in cache from the forward transform to the inverse.
    padded: Vec<Complex<T>>,
    /// Scratch memory of the transforms.
    scratch: Vec<Complex<T>>,
}

impl<T: Precision> Clone for Convolution<T> {
    fn clone(&self) -> Self {
        Self::new(Arc::clone(&self.plan))
    }
}

impl<T: Precision> fmt::Debug for Convolution<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Convolution").field("plan", &self.plan).finish_non_exhaustive()
    }
}

impl<T: Precision> Convolution<T> {
    /// Buffers for `plan`.
    pub(crate) fn new(plan: Arc<ConvolutionPlan<T>>) -> Self {
        let work = Self::buffers(&plan);
        Self { plan, work }
    }

    /// The plan.
    pub(crate) fn plan(&self) -> &ConvolutionPlan<T> {
        &self.plan
    }

    /// Replaces the plan by one for the same field and padding sizes.
    pub(crate) fn replace_plan(&mut self, plan: ConvolutionPlan<T>) {
        self.plan = Arc::new(plan);
    }

    /// Zeroed buffers of a plan.
    fn buffers(plan: &ConvolutionPlan<T>) -> Buffers<T> {
        Buffers {
            rows: vec![Complex::default(); plan.half() * plan.ny],
            columns: vec![Complex::default(); plan.half() * plan.ny],
            workspaces: (0..chunk_count(plan.nx * plan.ny)).map(|_| Self::workspace(plan)).collect(),
        }
    }

    /// Workspace of one thread.
    fn workspace(plan: &ConvolutionPlan<T>) -> Workspace<T> {
        let scratch = plan
            .rows_forward
            .get_scratch_len()
            .max(plan.rows_inverse.get_scratch_len())
            .max(plan.columns_forward.get_inplace_scratch_len())
            .max(plan.columns_inverse.get_inplace_scratch_len());
        Workspace {
            row: vec![T::zero(); plan.padded_x],
            spectra: vec![Complex::default(); plan.half() * plan.ny.min(BLOCK)],
            padded: vec![Complex::default(); plan.half().min(BLOCK) * plan.padded_y],
            scratch: vec![Complex::default(); scratch],
        }
    }

    /// Overwrites `out` with the convolution of `field`. Both must hold `nx * ny` values, which the callers
    /// check. Each line is transformed by one thread, so the result does not depend on the number of threads.
    pub(crate) fn apply(&mut self, field: &[f64], out: &mut [f64]) {
        self.apply_scaled(field, [1.0, 1.0], out);
    }

    /// Convolution with the field multiplied by the first factor before and by the second one after, to stay
    /// in the range of single precision.
    pub(crate) fn apply_scaled(&mut self, field: &[f64], [before, after]: [f64; 2], out: &mut [f64]) {
        let plan = &*self.plan;
        let Buffers { rows, columns, workspaces } = &mut self.work;
        let (nx, ny, half, py) = (plan.nx, plan.ny, plan.half(), plan.padded_y);
        // forward transform of the padded rows
        for_each_chunk(workspaces, rows, half, |first, rows, workspace| {
            for (row, spectrum) in field[first * nx..].chunks_exact(nx).zip(rows.chunks_exact_mut(half)) {
                for (own, value) in workspace.row.iter_mut().zip(row) {
                    *own = T::rounded(before * value);
                }
                workspace.row[nx..].fill(T::zero());
                plan.forward_row(&mut workspace.row, spectrum, &mut workspace.scratch);
            }
        });
        // columns: forward transform, product with the kernel, inverse transform
        for_each_chunk(workspaces, columns, ny, |first, columns, workspace| {
            for (block, columns) in columns.chunks_mut(BLOCK * ny).enumerate() {
                let first = first + block * BLOCK;
                let padded = &mut workspace.padded[..columns.len() / ny * py];
                transpose(rows, half, first, padded, py, ny);
                for (kx, (column, kept)) in
                    (first..).zip(padded.chunks_exact_mut(py).zip(columns.chunks_exact_mut(ny)))
                {
                    column[ny..].fill(Complex::default());
                    plan.columns_forward.process_with_scratch(column, &mut workspace.scratch);
                    plan.spectrum.multiply(kx, column);
                    plan.columns_inverse.process_with_scratch(column, &mut workspace.scratch);
                    kept.copy_from_slice(&column[..ny]);
                }
            }
        });
        // inverse transform of the rows
        for_each_chunk(workspaces, out, nx, |first, out, workspace| {
            for (block, out) in out.chunks_mut(BLOCK * nx).enumerate() {
                let spectra = &mut workspace.spectra[..out.len() / nx * half];
                transpose(columns, ny, first + block * BLOCK, spectra, half, half);
                for (row, spectrum) in out.chunks_exact_mut(nx).zip(spectra.chunks_exact_mut(half)) {
                    plan.inverse_row(spectrum, &mut workspace.row, &mut workspace.scratch);
                    for (value, own) in row.iter_mut().zip(&workspace.row) {
                        *value = after * own.wide();
                    }
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spectra_of_symmetric_kernels_are_real_and_halved() {
        for (nx, ny) in [(8, 6), (7, 5), (5, 9), (12, 1)] {
            let even = |i: isize, j: isize| 1.0 / (1.0 + (i * i + 2 * j * j) as f64).sqrt();
            let skew = |i: isize, j: isize| even(i, j) * (1.0 + 0.1 * (i as f64 + 0.5 * j as f64));
            let field: Vec<f64> = (0..nx * ny).map(|k| (k as f64).sin()).collect();
            let check = |kernel: &dyn Fn(isize, isize) -> f64, is_symmetric: bool| {
                let plan = Arc::new(ConvolutionPlan::new(nx, ny, kernel));
                assert_eq!(matches!(plan.spectrum, Spectrum::Symmetric(_)), is_symmetric, "{nx} x {ny}");
                let mut out = vec![0.0; nx * ny];
                Convolution::new(plan).apply(&field, &mut out);
                for (k, value) in out.iter().enumerate() {
                    let along = |l: usize| (k % nx) as isize - (l % nx) as isize;
                    let down = |l: usize| (k / nx) as isize - (l / nx) as isize;
                    let sum: f64 = (0..nx * ny).map(|l| kernel(along(l), down(l)) * field[l]).sum();
                    assert!((value - sum).abs() < 1e-12, "{nx} x {ny}, {k}: {value} {sum}");
                }
            };
            check(&even, true);
            check(&skew, false);
        }
    }

    #[test]
    fn results_are_bit_identical_for_any_number_of_chunks() {
        for (nx, ny) in [(64, 48), (33, 7), (5, 65), (40, 1)] {
            let kernel = |i: isize, j: isize| 1.0 / (1.0 + (i * i + 2 * j * j) as f64).sqrt();
            let plan = Arc::new(ConvolutionPlan::new(nx, ny, kernel));
            let field: Vec<f64> = (0..nx * ny).map(|k| (k as f64).sin()).collect();
            let mut single = Convolution::new(Arc::clone(&plan));
            let mut expected = vec![0.0; nx * ny];
            single.apply(&field, &mut expected);
            for count in [2, 3, 8, 100] {
                let mut many = Convolution::new(Arc::clone(&plan));
                many.work.workspaces = (0..count).map(|_| Convolution::workspace(&plan)).collect();
                let mut out = vec![f64::NAN; nx * ny];
                many.apply(&field, &mut out);
                assert_eq!(out, expected, "{nx} x {ny} in {count} chunks");
            }
        }
    }
}
