//! The areal Gaussian filter (ISO 16610-61).
//!
//! The weight at the distance `x` is `exp(-pi (x/(alpha cutoff))^2)` with `alpha = sqrt(ln 2/pi)`: a wave of the cut-off
//! length keeps half its amplitude. The S-filter keeps longer waves, the L-filter shorter ones. Undefined points and
//! points outside of open edges have zero weight.

use std::f64::consts::PI;

use num_complex::Complex64;
use rustfft::FftPlanner;

use super::error::SurfaceError;
use super::measured::Heights;
use crate::boundary::Boundary;
use crate::error::InputError;
use crate::numerics::fast_length;

/// Width of the weights in cut-offs, `sqrt(ln 2 / pi)`, for a transmission of one half at the cut-off.
const ALPHA: f64 = 0.469_718_639_349_825_7;
/// Number of cut-offs beyond which weights are below rounding.
const REACH: f64 = 1.6;

impl Heights {
    /// S-filter: keeps waves longer than `cutoff` \[m\]. The transmission at wavelength L is `exp(-ln 2 (cutoff/L)^2)`, one
    /// half at the cut-off.
    ///
    /// The weights are `exp(-pi (r / (alpha cutoff))^2)` with `alpha = sqrt(ln 2 / pi)`. Near undefined points and the edges
    /// of an open surface they are divided by their sum over defined points; a periodic surface is continued. Undefined
    /// points remain undefined.
    ///
    /// Source: ISO 16610-61:2015.
    ///
    /// # Errors
    /// [`SurfaceError::NoSpacing`], [`SurfaceError::AllUndefined`]; [`SurfaceError::Input`] for a cut-off
    /// that is not positive or longer than the surface.
    ///
    /// ```
    /// use std::f64::consts::TAU;
    /// use stribeck::{Boundary, surface::Heights};
    /// let wave: Vec<f64> = (0..80).map(|i| 1e-7 * (TAU * f64::from(i) / 20.0).sin()).collect();
    /// let mut surface = Heights::new(80, 1, Some([1e-6, 1e-6]), wave.clone(), None)?;
    /// surface.s_filter(20e-6, Boundary::Periodic)?;
    /// assert!(surface.heights().iter().zip(wave).all(|(z, before)| (z - 0.5 * before).abs() < 1e-18));
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn s_filter(&mut self, cutoff: f64, boundary: Boundary) -> Result<(), SurfaceError> {
        self.heights = self.smoothed(cutoff, boundary)?;
        Ok(())
    }

    /// L-filter: removes waves longer than `cutoff` \[m\] and the mean: the surface minus its [`Heights::s_filter`].
    ///
    /// # Errors
    /// The errors of [`Heights::s_filter`].
    ///
    /// ```
    /// use stribeck::{Boundary, surface::Heights};
    /// let mut surface = Heights::new(8, 8, Some([1e-6, 1e-6]), vec![5e-6; 64], None)?;
    /// surface.l_filter(4e-6, Boundary::Open)?;
    /// assert!(surface.heights().iter().all(|z| z.abs() < 1e-20));
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn l_filter(&mut self, cutoff: f64, boundary: Boundary) -> Result<(), SurfaceError> {
        let smooth = self.smoothed(cutoff, boundary)?;
        self.heights.iter_mut().zip(smooth).for_each(|(z, smooth)| *z -= smooth);
        Ok(())
    }

    /// The heights after the S-filter, zero where undefined.
    fn smoothed(&self, cutoff: f64, boundary: Boundary) -> Result<Vec<f64>, SurfaceError> {
        let [dx, dy] = self.spacing.ok_or(SurfaceError::NoSpacing)?;
        InputError::require_positive("cutoff", cutoff)?;
        let size = (dx * self.nx as f64).max(dy * self.ny as f64);
        InputError::require(cutoff <= size, "cutoff", cutoff, "at most the size of the surface")?;
        let mean = self.mean()?;
        let deviation = |k: usize| if self.is_defined(k) { self.heights[k] - mean } else { 0.0 };
        let points = 0..self.heights.len();
        let largest = points.clone().fold(0.0_f64, |largest, k| largest.max(deviation(k).abs()));
        if largest == 0.0 {
            return Ok(self.heights.clone());
        }
        InputError::require_finite("heights", &[largest])?;
        // heights and weights share a transform: scale both to one order
        let weight = |k: usize| if self.is_defined(k) { 1.0 } else { 0.0 };
        let mut field: Vec<Complex64> =
            points.clone().map(|k| Complex64::new(deviation(k) / largest, weight(k))).collect();
        for (start, stride, lines, count, spacing) in
            [(self.nx, 1, self.ny, self.nx, dx), (1, self.nx, self.nx, self.ny, dy)]
        {
            if count > 1 {
                smooth_lines(&mut field, [start, stride, lines, count], cutoff / spacing, boundary);
            }
        }
        let height = |k: usize| mean + largest * field[k].re / field[k].im;
        Ok(points.map(|k| if self.is_defined(k) { height(k) } else { 0.0 }).collect())
    }
}

/// Convolves `lines` lines of `count` points, the first points `start` apart and their points `stride`, with
/// Gaussian weights for a cut-off in points.
fn smooth_lines(
    field: &mut [Complex64],
    [start, stride, lines, count]: [usize; 4],
    cutoff: f64,
    boundary: Boundary,
) {
    let length = match boundary {
        Boundary::Periodic => count,
        Boundary::Open => fast_length(count + (REACH * cutoff) as usize + 1),
    };
    let mut planner = FftPlanner::new();
    let (forward, inverse) = (planner.plan_fft_forward(length), planner.plan_fft_inverse(length));
    let transmission: Vec<f64> = (0..length)
        .map(|wave| {
            let waves = wave.min(length - wave) as f64 / length as f64 * ALPHA * cutoff;
            (-PI * waves * waves).exp() / length as f64
        })
        .collect();
    let mut line = vec![Complex64::default(); length];
    let scratch = forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len());
    let mut scratch = vec![Complex64::default(); scratch];
    for first in (0..lines).map(|k| k * start) {
        line.fill(Complex64::default());
        for (value, k) in line.iter_mut().zip((0..count).map(|i| first + i * stride)) {
            *value = field[k];
        }
        forward.process_with_scratch(&mut line, &mut scratch);
        line.iter_mut().zip(&transmission).for_each(|(value, share)| *value *= share);
        inverse.process_with_scratch(&mut line, &mut scratch);
        for (value, k) in line.iter().zip((0..count).map(|i| first + i * stride)) {
            field[k] = *value;
        }
    }
}
