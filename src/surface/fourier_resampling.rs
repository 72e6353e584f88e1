//! Resampling of a periodic surface by its Fourier series.
//!
//! Waves resolved by both sets of nodes are kept exactly, shorter ones are dropped or zero: there is no smoothing and no
//! aliasing. Use it to refine generated surfaces in mesh studies.

use std::f64::consts::PI;
use std::sync::Arc;

use num_complex::Complex64;
use rustfft::{Fft, FftPlanner};

use super::error::SurfaceError;
use super::measured::Heights;
use crate::grid::Grid;

impl Heights {
    /// The same area with `nx` x `ny` points, by the periodic Fourier series of the surface. It is exact for waves resolved
    /// by both sets of points. Waves that the new points do not resolve are dropped, without aliasing.
    ///
    /// Edges that do not match cause ringing: apply [`Heights::taper`] or [`Heights::tile_mirrored`] first.
    ///
    /// # Errors
    /// [`SurfaceError::Undefined`]; [`SurfaceError::Input`] for a count of zero or more than
    /// [`Grid::MAX_NODES`] points.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let wave = |x: f64| 1e-7 * (std::f64::consts::TAU * x / 16e-6).sin();
    /// let fine = (0..16).map(|i| wave((f64::from(i) + 0.5) * 1e-6)).collect();
    /// let coarse = Heights::new(16, 1, Some([1e-6, 1e-6]), fine, None)?.resample_fourier(10, 1)?;
    /// let expected = (0..10).map(|i| wave((f64::from(i) + 0.5) * 1.6e-6));
    /// assert!(coarse.heights().iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-20));
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn resample_fourier(&self, nx: usize, ny: usize) -> Result<Self, SurfaceError> {
        Grid::centred(nx, ny, 1.0, 1.0)?;
        if self.undefined() > 0 {
            return Err(SurfaceError::Undefined { points: self.undefined() });
        }
        let mut along_x = Line::new(self.nx, nx);
        let mut along_y = Line::new(self.ny, ny);
        let mut rows = Vec::with_capacity(nx * self.ny);
        for row in self.heights.chunks_exact(self.nx) {
            along_x.load(row.iter().copied());
            rows.extend(along_x.transfer().map(|value| value.re));
        }
        let mut heights = vec![0.0; nx * ny];
        for i in 0..nx {
            along_y.load(rows.iter().skip(i).step_by(nx).copied());
            for (j, value) in along_y.transfer().enumerate() {
                heights[j * nx + i] = value.re;
            }
        }
        let finer = |points: usize, nodes: usize| points as f64 / nodes as f64;
        let spacing = self.spacing.map(|[dx, dy]| [dx * finer(self.nx, nx), dy * finer(self.ny, ny)]);
        Ok(Self {
            #[cfg(feature = "formats")]
            unit: self.unit,
            #[cfg(feature = "formats")]
            warnings: self.warnings.clone(),
            ..Self::new(nx, ny, spacing, heights, None)?
        })
    }
}

/// Plan to resample lines of one length to another.
struct Line {
    /// Transform of the source.
    forward: Arc<dyn Fft<f64>>,
    /// Inverse transform of the target.
    inverse: Arc<dyn Fft<f64>>,
    /// Values, then spectrum, at the source points.
    source: Vec<Complex64>,
    /// Spectrum, then values, at the target nodes.
    target: Vec<Complex64>,
}

impl Line {
    /// Plan from lines of `points` values to `nodes` values.
    fn new(points: usize, nodes: usize) -> Self {
        let mut planner = FftPlanner::new();
        Self {
            forward: planner.plan_fft_forward(points),
            inverse: planner.plan_fft_inverse(nodes),
            source: vec![Complex64::default(); points],
            target: vec![Complex64::default(); nodes],
        }
    }

    /// Loads and transforms a line.
    fn load(&mut self, heights: impl Iterator<Item = f64>) {
        self.source.iter_mut().zip(heights).for_each(|(value, height)| *value = Complex64::from(height));
    }

    /// The loaded line at the new points.
    fn transfer(&mut self) -> impl Iterator<Item = &Complex64> {
        let (points, nodes) = (self.source.len(), self.target.len());
        if points == nodes {
            self.target.copy_from_slice(&self.source);
            return self.target.iter();
        }
        self.forward.process(&mut self.source);
        self.target.fill(Complex64::default());
        let resolved = points.min(nodes);
        // points are cell centers, so the first ones of both sets do not coincide
        let turn = PI * (1.0 / nodes as f64 - 1.0 / points as f64);
        for wave in 0..=resolved / 2 {
            let shift = Complex64::from_polar(1.0 / points as f64, turn * wave as f64);
            let positive = self.source[wave] * shift;
            if wave == 0 {
                self.target[0] = positive;
            } else if 2 * wave < resolved {
                self.target[wave] = positive;
                self.target[nodes - wave] = positive.conj();
            } else if nodes == resolved {
                // both directions of the shortest wave coincide
                self.target[wave] = positive + positive.conj();
            } else {
                self.target[wave] = 0.5 * positive;
                self.target[nodes - wave] = 0.5 * positive.conj();
            }
        }
        self.inverse.process(&mut self.target);
        self.target.iter()
    }
}
