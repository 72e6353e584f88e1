//! Shifts by a fraction of a cell.
//!
//! Each row is shifted by its Fourier series, so that waves keep their amplitudes; linear interpolation would damp the
//! shortest ones. Films and depths, which must not become negative, are shifted linearly.

use std::f64::consts::PI;
use std::fmt;
use std::sync::Arc;

use num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use super::motion::{Offset, copy_shifted};
use crate::error::InputError;

/// Shifts periodic heights along x by any distance with their Fourier series: exact for waves that the grid resolves;
/// the opposite shift restores the field.
///
/// It overshoots: non-negative fields may become negative.
///
/// ```
/// use stribeck::surface::{FourierShift, Offset};
/// use std::f64::consts::TAU;
/// let wave = |x: f64| (TAU * x / 16.0).cos() + 0.2 * (TAU * 5.0 * x / 16.0).sin();
/// let field: Vec<f64> = (0..16).map(|i| wave(f64::from(i))).collect();
/// let mut out = vec![0.0; 16];
/// FourierShift::new(16).apply(&field, 1, Offset { columns: 3, rows: 0, fraction: 0.37 }, &mut out)?;
/// assert!((out[2] - wave(5.37)).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Clone)]
pub struct FourierShift {
    nx: usize,
    /// Transform of a row.
    forward: Arc<dyn RealToComplex<f64>>,
    /// Its inverse, without normalization.
    inverse: Arc<dyn ComplexToReal<f64>>,
    /// Spectrum of the present row.
    spectrum: Vec<Complex64>,
    /// Copy of the present row.
    row: Vec<f64>,
    /// Work space of the transforms.
    scratch: Vec<Complex64>,
}

impl fmt::Debug for FourierShift {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FourierShift").field("nx", &self.nx).finish_non_exhaustive()
    }
}

impl FourierShift {
    /// Plan for rows of `nx` nodes.
    pub fn new(nx: usize) -> Self {
        let mut planner = RealFftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(nx.max(1)), planner.plan_fft_inverse(nx.max(1)));
        let scratch = forward.get_scratch_len().max(inverse.get_scratch_len());
        Self {
            nx: nx.max(1),
            spectrum: forward.make_output_vec(),
            row: vec![0.0; nx.max(1)],
            scratch: vec![Complex64::default(); scratch],
            forward,
            inverse,
        }
    }

    /// Overwrites `out` with the periodic `field` of `ny` rows shifted by `offset`. Allocates nothing.
    ///
    /// # Errors
    /// Slices that do not have `nx * ny` values, a fraction outside 0 to 1.
    pub fn apply(
        &mut self,
        field: &[f64],
        ny: usize,
        offset: Offset,
        out: &mut [f64],
    ) -> Result<(), InputError> {
        offset.validate()?;
        copy_shifted(field, self.nx, ny, (offset.columns, offset.rows), out)?;
        if offset.fraction == 0.0 {
            return Ok(());
        }
        for row in out.chunks_exact_mut(self.nx) {
            self.shift_row(row, offset.fraction)?;
        }
        Ok(())
    }

    /// Shifts a row by `fraction` of a cell.
    fn shift_row(&mut self, row: &mut [f64], fraction: f64) -> Result<(), InputError> {
        let misfit = |error: realfft::FftError| InputError::Conflict {
            field: "row".to_owned(),
            reason: error.to_string(),
        };
        self.row.copy_from_slice(row);
        let spectrum = &mut self.spectrum;
        self.forward.process_with_scratch(&mut self.row, spectrum, &mut self.scratch).map_err(misfit)?;
        let (nx, scale) = (self.nx, 1.0 / self.nx as f64);
        for (wave, value) in spectrum.iter_mut().enumerate() {
            let turn = 2.0 * PI * wave as f64 * fraction * scale;
            *value *= if 2 * wave == nx {
                // The shortest wave has no direction: keep its value between the nodes.
                Complex64::from(turn.cos() * scale)
            } else {
                Complex64::from_polar(scale, turn)
            };
        }
        // Rounding may leave imaginary parts where a real field has none.
        if let Some(mean) = spectrum.first_mut() {
            mean.im = 0.0;
        }
        if nx.is_multiple_of(2)
            && let Some(shortest) = spectrum.last_mut()
        {
            shortest.im = 0.0;
        }
        self.inverse.process_with_scratch(spectrum, row, &mut self.scratch).map_err(misfit)
    }
}

/// Overwrites `out` with the periodic `field` shifted by `offset`, linear between columns: non-negative fields stay
/// non-negative.
///
/// # Errors
/// Slices that do not have `nx * ny` values, a fraction outside 0 to 1.
pub(crate) fn blend_shifted(
    field: &[f64],
    nx: usize,
    ny: usize,
    offset: Offset,
    out: &mut [f64],
) -> Result<(), InputError> {
    offset.validate()?;
    copy_shifted(field, nx, ny, (offset.columns, offset.rows), out)?;
    if offset.fraction == 0.0 || nx == 0 {
        return Ok(());
    }
    for row in out.chunks_exact_mut(nx) {
        let first = row[0];
        for i in 0..nx {
            let next = if i + 1 < nx { row[i + 1] } else { first };
            row[i] += offset.fraction * (next - row[i]);
        }
    }
    Ok(())
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "sums of few short numbers")]
mod tests {
    use super::*;
    use crate::surface::motion::add_blended;

    #[test]
    fn shifts_match_their_definitions() -> Result<(), InputError> {
        let (mut out, mut field) = ([0.0; 4], [0.0; 4]);
        let quarter = Offset { columns: 1, rows: 0, fraction: 0.25 };
        blend_shifted(&[1.0, 2.0, 3.0, 4.0], 4, 1, quarter, &mut out)?;
        assert_eq!(out, [2.25, 3.25, 3.25, 1.25]);
        add_blended(&[2.0, 0.0, 4.0, 1.0], 4, 1, quarter, &mut field)?;
        assert_eq!(field, [1.75, 1.75, 0.5, 3.0]);
        for (nx, ny, sx, sy) in [(1, 1, 3, 5), (4, 3, 1, 2), (5, 7, 11, 13), (8, 2, 7, 0)] {
            let field: Vec<f64> = (0..nx * ny).map(|k| k as f64).collect();
            let (mut seen, mut back) = (vec![0.0; nx * ny], vec![0.0; nx * ny]);
            copy_shifted(&field, nx, ny, (sx, sy), &mut seen)?;
            let expected = (0..nx * ny).map(|k| ((k / nx + sy) % ny * nx + (k % nx + sx) % nx) as f64);
            assert_eq!(seen, expected.collect::<Vec<_>>());
            add_blended(&seen, nx, ny, Offset { columns: sx, rows: sy, fraction: 0.0 }, &mut back)?;
            assert_eq!(back, field);
        }
        Ok(())
    }

    #[test]
    fn blended_shift_and_its_adjoint_keep_sums_and_signs() -> Result<(), InputError> {
        let (nx, ny) = (15, 3);
        let field: Vec<f64> = (0..nx * ny).map(|k| (k as f64).sin().max(0.0)).collect();
        let (mut seen, mut back) = (vec![0.0; nx * ny], vec![0.0; nx * ny]);
        let offset = Offset { columns: 4, rows: 1, fraction: 0.3 };
        blend_shifted(&field, nx, ny, offset, &mut seen)?;
        add_blended(&seen, nx, ny, offset, &mut back)?;
        let sums = [&field, &seen, &back].map(|f| f.iter().sum::<f64>());
        assert!((sums[0] - sums[1]).abs() < 1e-12 && (sums[0] - sums[2]).abs() < 1e-12, "{sums:?}");
        assert!(seen.iter().chain(&back).all(|v| *v >= 0.0));
        Ok(())
    }

    #[test]
    fn fields_of_wrong_length_are_rejected() {
        assert!(copy_shifted(&[0.0; 5], 2, 3, (0, 0), &mut [0.0; 6]).is_err());
        assert!(copy_shifted(&[0.0; 6], 2, 3, (0, 0), &mut [0.0; 5]).is_err());
        let offset = Offset { columns: 1, rows: 1, fraction: 0.5 };
        assert!(add_blended(&[0.0; 6], usize::MAX, 3, offset, &mut [0.0; 6]).is_err());
        assert!(add_blended(&[], 0, 0, offset, &mut []).is_ok());
        for fraction in [-0.1, 1.1, f64::NAN] {
            let offset = Offset { fraction, ..offset };
            assert!(blend_shifted(&[0.0; 6], 2, 3, offset, &mut [0.0; 6]).is_err());
            assert!(add_blended(&[0.0; 6], 2, 3, offset, &mut [0.0; 6]).is_err());
        }
    }
}
