//! Fourier transforms of real periodic fields.
//!
//! The spectrum of a real field is Hermitian, `F[-l, -k] = conj F[l, k]`, so `nx/2 + 1` columns represent it.
//! Transforms are not normalized: a forward and an inverse transform multiply a field by `nx ny`.

use std::sync::Arc;

use num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};

use super::parallel::{chunk_count, for_each_chunk};
use super::transpose::{BLOCK, transpose};

/// Transforms of real `nx` x `ny` fields, with `nx / 2 + 1` columns of the spectrum. Each line is transformed
/// by one thread, so results are bit-identical for any number of threads.
pub(crate) struct RealFft2 {
    /// Columns.
    nx: usize,
    /// Rows.
    ny: usize,
    /// Forward transform of real rows.
    rows_forward: Arc<dyn RealToComplex<f64>>,
    /// Inverse transform to real rows.
    rows_inverse: Arc<dyn ComplexToReal<f64>>,
    /// Forward transform of columns.
    columns_forward: Arc<dyn Fft<f64>>,
    /// Inverse transform of columns.
    columns_inverse: Arc<dyn Fft<f64>>,
}

/// Workspace of one thread.
struct Workspace {
    /// A row.
    row: Vec<f64>,
    /// Spectra of a block of rows, or a column.
    spectra: Vec<Complex64>,
    /// Scratch memory of the transforms.
    scratch: Vec<Complex64>,
}

impl RealFft2 {
    /// Plans for one shape.
    pub(crate) fn new(nx: usize, ny: usize) -> Self {
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        Self {
            nx,
            ny,
            rows_forward: real.plan_fft_forward(nx),
            rows_inverse: real.plan_fft_inverse(nx),
            columns_forward: complex.plan_fft_forward(ny),
            columns_inverse: complex.plan_fft_inverse(ny),
        }
    }

    /// Number of stored columns of the spectrum.
    fn width(&self) -> usize {
        self.nx / 2 + 1
    }

    /// Workspaces for the chunks of a field of this shape.
    fn workspaces(&self) -> Vec<Workspace> {
        let scratch = self
            .rows_forward
            .get_scratch_len()
            .max(self.rows_inverse.get_scratch_len())
            .max(self.columns_forward.get_inplace_scratch_len())
            .max(self.columns_inverse.get_inplace_scratch_len());
        let workspace = |_| Workspace {
            row: vec![0.0; self.nx],
            spectra: vec![Complex64::default(); (self.width() * self.ny.min(BLOCK)).max(self.ny)],
            scratch: vec![Complex64::default(); scratch],
        };
        (0..chunk_count(self.nx * self.ny)).map(workspace).collect()
    }

    /// Transforms `field`, applies `each` to its spectrum, and transforms back (without normalization).
    /// `each` receives a value and its index in the quarter of `nx / 2 + 1` x `ny / 2 + 1` wave vectors.
    pub(crate) fn filter(&self, field: &mut [f64], each: impl Fn(usize, &mut Complex64) + Sync) {
        let (nx, ny, width) = (self.nx, self.ny, self.width());
        let mut workspaces = self.workspaces();
        let mut rows = vec![Complex64::default(); width * ny];
        // forward transform of the rows
        for_each_chunk(&mut workspaces, &mut rows, width, |first, rows, workspace| {
            for (row, out) in field[first * nx..].chunks_exact(nx).zip(rows.chunks_exact_mut(width)) {
                workspace.row.copy_from_slice(row);
                self.forward_row(workspace, out);
            }
        });
        let mut columns = vec![Complex64::default(); width * ny];
        // columns: forward transform, filter, inverse transform
        for_each_chunk(&mut workspaces, &mut columns, ny, |first, columns, workspace| {
            transpose(&rows, width, first, columns, ny, ny);
            for (i, column) in (first..).zip(columns.chunks_exact_mut(ny)) {
                self.columns_forward.process_with_scratch(column, &mut workspace.scratch);
                for (j, value) in column.iter_mut().enumerate() {
                    each(j.min(ny - j) * width + i, value);
                }
                self.columns_inverse.process_with_scratch(column, &mut workspace.scratch);
            }
        });
        // inverse transform of the rows
        for_each_chunk(&mut workspaces, field, nx, |first, field, workspace| {
            for (block, out) in field.chunks_mut(BLOCK * nx).enumerate() {
                let spectra = &mut workspace.spectra[..out.len() / nx * width];
                transpose(&columns, ny, first + block * BLOCK, spectra, width, width);
                for (row, spectrum) in out.chunks_exact_mut(nx).zip(spectra.chunks_exact_mut(width)) {
                    self.inverse_row(spectrum, row, &mut workspace.scratch);
                }
            }
        });
    }

    /// The first `kept_x` x `kept_y` values of the field with a given spectrum (without normalization).
    /// `fill` receives the index of one of `nx / 2 + 1` columns and the column of `ny` zeros, writes the
    /// spectrum, and returns whether it is non-zero. Lines outside the kept part are not transformed.
    pub(crate) fn synthesise(
        &self,
        [kept_x, kept_y]: [usize; 2],
        fill: impl Fn(usize, &mut [Complex64]) -> bool + Sync,
    ) -> Vec<f64> {
        let (nx, ny, width) = (self.nx, self.ny, self.width());
        let mut workspaces = self.workspaces();
        let mut columns = vec![Complex64::default(); width * ny];
        for_each_chunk(&mut workspaces, &mut columns, ny, |first, columns, workspace| {
            for (i, column) in (first..).zip(columns.chunks_exact_mut(ny)) {
                if fill(i, column) {
                    self.columns_inverse.process_with_scratch(column, &mut workspace.scratch);
                }
            }
        });
        let mut field = vec![0.0; kept_x * kept_y];
        for_each_chunk(&mut workspaces, &mut field, kept_x, |first, field, workspace| {
            let Workspace { row: whole, spectra, scratch } = workspace;
            for (block, out) in field.chunks_mut(BLOCK * kept_x).enumerate() {
                let spectra = &mut spectra[..out.len() / kept_x * width];
                transpose(&columns, ny, first + block * BLOCK, spectra, width, width);
                for (row, spectrum) in out.chunks_exact_mut(kept_x).zip(spectra.chunks_exact_mut(width)) {
                    self.inverse_row(spectrum, &mut whole[..nx], scratch);
                    row.copy_from_slice(&whole[..kept_x]);
                }
            }
        });
        field
    }

    /// Transform of a field that is symmetric about both axes, given and returned as its first `nx / 2 + 1` x
    /// `ny / 2 + 1` values. The transform is its own inverse up to normalization.
    pub(crate) fn symmetric(&self, quarter: &[f64]) -> Vec<f64> {
        let (nx, ny, width) = (self.nx, self.ny, self.width());
        let height = ny / 2 + 1;
        let mut workspaces = self.workspaces();
        let mut rows = vec![0.0; width * height];
        for_each_chunk(&mut workspaces, &mut rows, width, |first, rows, workspace| {
            let mut spectrum = vec![Complex64::default(); width];
            for (values, out) in
                quarter[first * width..].chunks_exact(width).zip(rows.chunks_exact_mut(width))
            {
                for (i, value) in workspace.row.iter_mut().enumerate() {
                    *value = values[i.min(nx - i)];
                }
                self.forward_row(workspace, &mut spectrum);
                out.iter_mut().zip(&spectrum).for_each(|(out, value)| *out = value.re);
            }
        });
        // transforms of symmetric columns are real, so two share one complex transform
        let pairs = width.div_ceil(2);
        let mut columns = vec![0.0; 2 * pairs * height];
        for_each_chunk(&mut workspaces, &mut columns, 2 * height, |first, columns, workspace| {
            let last = width.min(2 * first + columns.len() / height) - 2 * first;
            transpose(&rows, width, 2 * first, &mut columns[..last * height], height, height);
            for pair in columns.chunks_exact_mut(2 * height) {
                let (left, right) = pair.split_at_mut(height);
                let column = &mut workspace.spectra[..ny];
                for (j, value) in column.iter_mut().enumerate() {
                    let j = j.min(ny - j);
                    *value = Complex64::new(left[j], right[j]);
                }
                self.columns_forward.process_with_scratch(column, &mut workspace.scratch);
                for (j, value) in column[..height].iter().enumerate() {
                    (left[j], right[j]) = (value.re, value.im);
                }
            }
        });
        for_each_chunk(&mut workspaces, &mut rows, width, |first, rows, _| {
            transpose(&columns, height, first, rows, width, width);
        });
        rows
    }

    /// Spectrum of the row in the workspace.
    fn forward_row(&self, workspace: &mut Workspace, out: &mut [Complex64]) {
        let result = self.rows_forward.process_with_scratch(&mut workspace.row, out, &mut workspace.scratch);
        debug_assert!(result.is_ok(), "lengths fit");
    }

    /// Real row from its spectrum, multiplied by `nx`.
    fn inverse_row(&self, spectrum: &mut [Complex64], out: &mut [f64], scratch: &mut [Complex64]) {
        // real up to rounding; realfft requires exact zeros
        spectrum[0].im = 0.0;
        if self.nx.is_multiple_of(2) {
            spectrum[self.width() - 1].im = 0.0;
        }
        let result = self.rows_inverse.process_with_scratch(spectrum, out, scratch);
        debug_assert!(result.is_ok(), "lengths fit");
    }
}

#[cfg(test)]
mod tests {
    use rustfft::FftDirection;

    use super::super::fft::Fft2;
    use super::*;

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
            RealFft2::new(nx, ny).filter(&mut found, |wave, value| *value *= factor(wave));
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

    #[test]
    fn kept_lines_are_those_of_the_whole_field() {
        for (nx, ny) in SHAPES {
            let width = nx / 2 + 1;
            let value = |i: usize, j: usize| Complex64::new((i as f64).sin() + 0.1, (j as f64 * 1.3).cos());
            // half of the spectrum, the other half conjugate; also for the first and the middle column
            let spectrum = |i: usize, j: usize| match (2 * i).cmp(&nx) {
                _ if i == 0 || 2 * i == nx => (value(i, j) + value(i, (ny - j) % ny).conj()) / 2.0,
                std::cmp::Ordering::Less => value(i, j),
                _ => value(nx - i, (ny - j) % ny).conj(),
            };
            let mut whole: Vec<Complex64> = (0..nx * ny).map(|k| spectrum(k % nx, k / nx)).collect();
            Fft2::new(nx, ny).process(&mut whole, FftDirection::Inverse);
            let (kept_x, kept_y) = (nx.div_ceil(2), ny.div_ceil(3));
            let found = RealFft2::new(nx, ny).synthesise([kept_x, kept_y], |i, column| {
                assert!(i < width);
                column.iter_mut().enumerate().for_each(|(j, out)| *out = spectrum(i, j));
                true
            });
            for (k, z) in found.iter().enumerate() {
                let expected = whole[k / kept_x * nx + k % kept_x];
                assert!((z - expected.re).abs() < 1e-11, "{nx} x {ny}, {k}: {z} {expected}");
                assert!(expected.im.abs() < 1e-11, "{nx} x {ny}, {k}: {expected}");
            }
        }
    }
}
