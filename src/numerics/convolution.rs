//! Discrete convolution of fields on a grid through FFTs of the zero-padded (doubled) size, so that no
//! periodic image reaches the result (DC-FFT: Liu, Wang and Liu 2000, Wear 243, 101-111).
//!
//! With a kernel `K` on the offsets of an `nx` x `ny` grid the result is
//! `out[j, i] = sum K(i - k, j - l) f[l, k]` over all nodes. Fields are padded with zeros to the next fast
//! length from `2 n - 1` on along each axis, transformed along rows and then columns, multiplied by the
//! spectrum of the kernel, which holds the factor `1/(px py)` of the inverse, and transformed back. It costs
//! `O(n log n)` and agrees with the direct sum to rounding.
//!
//! Rows and columns are held padded a few at a time: memory is that of the fields, not of the doubled grid.

use std::fmt;
use std::sync::Arc;

use num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftNum, FftPlanner};

use super::lanes::{lanes_for, share_lines};
use super::spectrum::Spectrum;
use super::transpose::{BLOCK, transpose};

/// A number that transforms are done in; fields are always of double precision.
pub(crate) trait Precision: FftNum + Default {
    /// The nearest number of this precision.
    fn rounded(value: f64) -> Self;
    /// The same number in double precision.
    fn wide(self) -> f64;
}

impl Precision for f64 {
    #[inline]
    fn rounded(value: f64) -> Self {
        value
    }

    #[inline]
    fn wide(self) -> f64 {
        self
    }
}

impl Precision for f32 {
    #[inline]
    fn rounded(value: f64) -> Self {
        value as Self
    }

    #[inline]
    fn wide(self) -> f64 {
        f64::from(self)
    }
}

/// What is fixed by grid and kernel: transforms and the spectrum of the kernel. Shared by `Arc`.
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
    /// Real rows to half a spectrum.
    rows_forward: Arc<dyn RealToComplex<T>>,
    /// Half a spectrum to real rows.
    rows_inverse: Arc<dyn ComplexToReal<T>>,
    /// Columns to their spectrum.
    columns_forward: Arc<dyn Fft<T>>,
    /// And back.
    columns_inverse: Arc<dyn Fft<T>>,
    /// Spectrum of the kernel with the normalisation of the inverse folded in.
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

/// The smallest even number >= `n` with prime factors 2, 3 and 5 alone.
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

impl ConvolutionPlan {
    /// Plan for fields of `nx` x `ny` and the kernel `kernel(i, j)` at offsets `-nx < i < nx`,
    /// `-ny < j < ny`.
    pub(crate) fn new(nx: usize, ny: usize, kernel: impl Fn(isize, isize) -> f64) -> Self {
        Self::padded(nx, ny, [2 * nx - 1, 2 * ny - 1], kernel)
    }

    /// The convolution on the periodic grid of the fields themselves, padded only to a fast length: every two
    /// nodes see each other the shortest way round. A quarter of the cost.
    pub(crate) fn periodic(nx: usize, ny: usize, kernel: impl Fn(isize, isize) -> f64) -> Self {
        Self::padded(nx, ny, [nx, ny], kernel)
    }

    /// The same in single precision, the kernel multiplied by `factor`: half the memory and about half the
    /// time.
    pub(crate) fn to_single(&self, factor: f64) -> ConvolutionPlan<f32> {
        let mut plan = ConvolutionPlan::transforms([self.nx, self.ny], [self.padded_x, self.padded_y]);
        plan.spectrum = self.spectrum.map(|value| (factor * value) as f32);
        plan
    }

    /// Plan on a padded grid of at least `least` values along each axis; a single row needs no padding
    /// across.
    fn padded(nx: usize, ny: usize, least: [usize; 2], kernel: impl Fn(isize, isize) -> f64) -> Self {
        let padded_y = if ny == 1 { 1 } else { fast_length(least[1]) };
        let mut plan = Self::transforms([nx, ny], [fast_length(least[0]), padded_y]);
        plan.spectrum = Spectrum::new(plan.kernel_spectrum(kernel), padded_y);
        plan
    }

    /// Transform of the kernel, wrapped around the padded grid, times `1/(px py)`, column by column.
    fn kernel_spectrum(&self, kernel: impl Fn(isize, isize) -> f64) -> Vec<Complex<f64>> {
        let (half, px, py) = (self.half(), self.padded_x, self.padded_y);
        let mut lane = Convolution::lane(self);
        let mut line = vec![Complex::default(); half];
        let mut spectrum = vec![Complex::default(); half * py];
        // Offsets wrap around; those that no two nodes have stay zero.
        let offset = |i: usize, n: usize, period: usize| {
            let nearest = if 2 * i <= period { i as isize } else { i as isize - period as isize };
            (nearest.unsigned_abs() < n).then_some(nearest)
        };
        for j in 0..py {
            let Some(dj) = offset(j, self.ny, py) else { continue };
            for (i, value) in lane.row.iter_mut().enumerate() {
                *value = offset(i, self.nx, px).map_or(0.0, |di| kernel(di, dj));
            }
            self.forward_row(&mut lane.row, &mut line, &mut lane.scratch);
            for (kx, value) in line.iter().enumerate() {
                spectrum[kx * py + j] = *value;
            }
        }
        self.columns_forward.process_with_scratch(&mut spectrum, &mut lane.scratch);
        let scale = 1.0 / (px as f64 * py as f64);
        for value in &mut spectrum {
            *value *= scale;
        }
        spectrum
    }
}

impl<T: Precision> ConvolutionPlan<T> {
    /// The transforms, without a kernel yet.
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

    /// The inverse of this convolution plus `own` times the field on its padded grid: one over the modulus of
    /// the spectrum of the kernel and `own`. Of a periodic kernel that falls as `1/r` the inverse falls as
    /// `1/r^3`, so that the images reach nothing but the edges.
    pub(crate) fn inverse_with(&self, own: f64) -> Self {
        let mut plan = self.clone();
        let scale = 1.0 / (plan.padded_x as f64 * plan.padded_y as f64);
        plan.spectrum.reciprocal(scale * scale, own * scale);
        plan
    }

    /// Values of the spectrum of a real row of `px` values: `px/2 + 1`.
    fn half(&self) -> usize {
        self.padded_x / 2 + 1
    }

    /// Spectrum of a padded row.
    fn forward_row(&self, row: &mut [T], out: &mut [Complex<T>], scratch: &mut [Complex<T>]) {
        let result = self.rows_forward.process_with_scratch(row, out, scratch);
        debug_assert!(result.is_ok(), "buffers are sized by the plan");
    }

    /// Row of a spectrum, `px` times as large as the one it is the spectrum of.
    fn inverse_row(&self, spectrum: &mut [Complex<T>], out: &mut [T], scratch: &mut [Complex<T>]) {
        // The imaginary parts of the first and last entry vanish up to rounding; realfft insists on zero.
        let last = self.half() - 1;
        spectrum[0].im = T::zero();
        spectrum[last].im = T::zero();
        let result = self.rows_inverse.process_with_scratch(spectrum, out, scratch);
        debug_assert!(result.is_ok(), "buffers are sized by the plan");
    }
}

/// A plan with buffers of its own; cloning shares the plan.
pub(crate) struct Convolution<T: Precision = f64> {
    /// Transforms and kernel.
    plan: Arc<ConvolutionPlan<T>>,
    /// What it writes to.
    work: Buffers<T>,
}

/// What a convolution writes to, made once.
struct Buffers<T> {
    /// Spectra of the rows, row by row.
    rows: Vec<Complex<T>>,
    /// Column by column, without the padding.
    columns: Vec<Complex<T>>,
    /// One for each piece of the lines that are shared among threads.
    lanes: Vec<Lane<T>>,
}

/// What one thread needs.
struct Lane<T> {
    /// A padded row.
    row: Vec<T>,
    /// Spectra of a block of rows.
    spectra: Vec<Complex<T>>,
    /// A block of padded columns, which stay in the cache from the rows to the product and back.
    padded: Vec<Complex<T>>,
    /// Work space of the transforms, the largest that any of them asks for.
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

    /// What is fixed.
    pub(crate) fn plan(&self) -> &ConvolutionPlan<T> {
        &self.plan
    }

    /// Takes another plan for fields and padding of the same sizes.
    pub(crate) fn take(&mut self, plan: ConvolutionPlan<T>) {
        self.plan = Arc::new(plan);
    }

    /// Buffers of a plan, all zero.
    fn buffers(plan: &ConvolutionPlan<T>) -> Buffers<T> {
        Buffers {
            rows: vec![Complex::default(); plan.half() * plan.ny],
            columns: vec![Complex::default(); plan.half() * plan.ny],
            lanes: (0..lanes_for(plan.nx * plan.ny)).map(|_| Self::lane(plan)).collect(),
        }
    }

    /// Buffers of one thread.
    fn lane(plan: &ConvolutionPlan<T>) -> Lane<T> {
        let scratch = plan
            .rows_forward
            .get_scratch_len()
            .max(plan.rows_inverse.get_scratch_len())
            .max(plan.columns_forward.get_inplace_scratch_len())
            .max(plan.columns_inverse.get_inplace_scratch_len());
        Lane {
            row: vec![T::zero(); plan.padded_x],
            spectra: vec![Complex::default(); plan.half() * plan.ny.min(BLOCK)],
            padded: vec![Complex::default(); plan.half().min(BLOCK) * plan.padded_y],
            scratch: vec![Complex::default(); scratch],
        }
    }

    /// Overwrites `out` with the convolution of `field`. Both must hold `nx * ny` values: the callers check.
    /// Lines are transformed one by one, whichever thread does it: the result does not depend on their
    /// number.
    pub(crate) fn apply(&mut self, field: &[f64], out: &mut [f64]) {
        self.apply_scaled(field, [1.0, 1.0], out);
    }

    /// The same with the field multiplied by the first factor before and by the second one after: what keeps
    /// numbers of any size within single precision.
    pub(crate) fn apply_scaled(&mut self, field: &[f64], [before, after]: [f64; 2], out: &mut [f64]) {
        let plan = &*self.plan;
        let Buffers { rows, columns, lanes } = &mut self.work;
        let (nx, ny, half, py) = (plan.nx, plan.ny, plan.half(), plan.padded_y);
        share_lines(lanes, rows, half, |first, rows, lane| {
            for (row, spectrum) in field[first * nx..].chunks_exact(nx).zip(rows.chunks_exact_mut(half)) {
                for (own, value) in lane.row.iter_mut().zip(row) {
                    *own = T::rounded(before * value);
                }
                lane.row[nx..].fill(T::zero());
                plan.forward_row(&mut lane.row, spectrum, &mut lane.scratch);
            }
        });
        share_lines(lanes, columns, ny, |first, columns, lane| {
            for (block, columns) in columns.chunks_mut(BLOCK * ny).enumerate() {
                let first = first + block * BLOCK;
                let padded = &mut lane.padded[..columns.len() / ny * py];
                transpose(rows, half, first, padded, py, ny);
                for (kx, (column, kept)) in
                    (first..).zip(padded.chunks_exact_mut(py).zip(columns.chunks_exact_mut(ny)))
                {
                    column[ny..].fill(Complex::default());
                    plan.columns_forward.process_with_scratch(column, &mut lane.scratch);
                    plan.spectrum.multiply(kx, column);
                    plan.columns_inverse.process_with_scratch(column, &mut lane.scratch);
                    kept.copy_from_slice(&column[..ny]);
                }
            }
        });
        share_lines(lanes, out, nx, |first, out, lane| {
            for (block, out) in out.chunks_mut(BLOCK * nx).enumerate() {
                let spectra = &mut lane.spectra[..out.len() / nx * half];
                transpose(columns, ny, first + block * BLOCK, spectra, half, half);
                for (row, spectrum) in out.chunks_exact_mut(nx).zip(spectra.chunks_exact_mut(half)) {
                    plan.inverse_row(spectrum, &mut lane.row, &mut lane.scratch);
                    for (value, own) in row.iter_mut().zip(&lane.row) {
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
    fn lanes_change_no_bit() {
        for (nx, ny) in [(64, 48), (33, 7), (5, 65), (40, 1)] {
            let kernel = |i: isize, j: isize| 1.0 / (1.0 + (i * i + 2 * j * j) as f64).sqrt();
            let plan = Arc::new(ConvolutionPlan::new(nx, ny, kernel));
            let field: Vec<f64> = (0..nx * ny).map(|k| (k as f64).sin()).collect();
            let mut single = Convolution::new(Arc::clone(&plan));
            let mut expected = vec![0.0; nx * ny];
            single.apply(&field, &mut expected);
            for count in [2, 3, 8, 100] {
                let mut many = Convolution::new(Arc::clone(&plan));
                many.work.lanes = (0..count).map(|_| Convolution::lane(&plan)).collect();
                let mut out = vec![f64::NAN; nx * ny];
                many.apply(&field, &mut out);
                assert_eq!(out, expected, "{nx} x {ny} in {count} lanes");
            }
        }
    }
}
