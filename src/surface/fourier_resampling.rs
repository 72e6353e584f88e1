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
use crate::error::InputError;
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
        if self.undefined() > 0 {
            return Err(SurfaceError::Undefined { points: self.undefined() });
        }
        let heights = resolved_waves(&self.heights, [self.nx, self.ny], [nx, ny])?;
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

/// The Fourier series of `heights` on `from` cells at the centers of `to` cells of the same box. For fewer cells than
/// `from`, the middle ones of an odd number along each axis of a mesh that resolves all waves are taken: all meshes
/// sample one surface.
pub(crate) fn series_at_nodes(
    heights: &[f64],
    from: [usize; 2],
    [nx, ny]: [usize; 2],
) -> Result<Vec<f64>, InputError> {
    let parts = |cells: usize, holding: usize| holding.div_ceil(cells.max(1)) | 1;
    let (along_x, along_y) = (parts(nx, from[0]), parts(ny, from[1]));
    let fine = resolved_waves(heights, from, [along_x * nx, along_y * ny])?;
    let rows = fine.chunks_exact(along_x * nx).skip(along_y / 2).step_by(along_y);
    Ok(rows.flat_map(|row| row.iter().skip(along_x / 2).step_by(along_x).copied()).collect())
}

/// The Fourier series of `heights` on `from` cells at the centers of `to` cells, without the waves that these do not
/// resolve.
fn resolved_waves(
    heights: &[f64],
    [old_nx, old_ny]: [usize; 2],
    [nx, ny]: [usize; 2],
) -> Result<Vec<f64>, InputError> {
    Grid::centred(nx, ny, 1.0, 1.0)?;
    let mut along_x = Line::new(old_nx, nx);
    let mut along_y = Line::new(old_ny, ny);
    let mut rows = Vec::with_capacity(nx * old_ny);
    for row in heights.chunks_exact(old_nx) {
        along_x.load(row.iter().copied());
        rows.extend(along_x.transfer().map(|value| value.re));
    }
    let mut resampled = vec![0.0; nx * ny];
    for i in 0..nx {
        along_y.load(rows.iter().skip(i).step_by(nx).copied());
        for (j, value) in along_y.transfer().enumerate() {
            resampled[j * nx + i] = value.re;
        }
    }
    Ok(resampled)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fourier_series_has_equal_heights_on_all_meshes() {
        // Two waves; eight cells resolve only one of them.
        let height = |x: f64, y: f64| (6.0 * x + 0.3).cos() + 0.5 * (2.0 * (x - y)).sin();
        let on = |nx: usize, ny: usize| -> Vec<f64> {
            let centre = |i: usize, n: usize| std::f64::consts::TAU * (i as f64 + 0.5) / n as f64;
            (0..nx * ny).map(|k| height(centre(k % nx, nx), centre(k / nx, ny))).collect()
        };
        for (nx, ny) in [(8, 7), (16, 14), (32, 28), (9, 20), (4, 3)] {
            for (found, expected) in
                series_at_nodes(&on(16, 14), [16, 14], [nx, ny]).unwrap().iter().zip(on(nx, ny))
            {
                assert!((found - expected).abs() < 1e-12, "{nx} x {ny}: {found} {expected}");
            }
        }
    }
}
