//! The areal autocorrelation function and its parameters (ISO 25178-2).

use num_complex::Complex64;
use rustfft::FftDirection;

use super::mask::Mask;
use crate::boundary::Boundary;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::Fft2;

/// Normalized autocorrelation for lags up to half of the surface, 1 at lag zero.
///
/// `f(t_x, t_y) = mean z(x, y) z(x + t_x, y + t_y) / mean z^2`, averaged over all pairs of defined points at
/// that lag.
#[derive(Debug, Clone, PartialEq)]
pub struct AreaCorrelation {
    /// Largest lag along each axis, in nodes.
    reach: [usize; 2],
    /// Node spacing along x and y \[m\].
    spacing: [f64; 2],
    /// Lag `(i, j)`, from minus to plus the reach, at `(j + reach_y) * (2 reach_x + 1) + i + reach_x`.
    values: Vec<f64>,
}

/// Spatial parameters.
///
/// # Examples
///
/// ```
/// use stribeck::metrics::AreaCorrelation;
/// use stribeck::surface::{Autocorrelation, RoughnessSpec, generate};
/// use stribeck::{Boundary, Grid};
/// let grid = Grid::centred(128, 128, 2e-6, 2e-6)?;
/// let (autocorrelation, rq) = (Autocorrelation::Gaussian, 1e-7);
/// let spec = RoughnessSpec { autocorrelation, rq, length_x: 40e-6, length_y: 8e-6, seed: 2 };
/// let correlation = AreaCorrelation::new(&grid, &generate(&grid, &spec)?, None, Boundary::Periodic)?;
/// let spatial = correlation.spatial(0.2)?;
/// // The shortest correlation length is across the lay.
/// assert!(spatial.sal.is_some_and(|length| (4e-6..10e-6).contains(&length)));
/// assert!(spatial.str.is_none_or(|ratio| ratio < 0.5));
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SpatialParameters {
    /// Autocorrelation length \[m\]: shortest lag at which the function falls to the threshold; `None` if it
    /// stays above.
    pub sal: Option<f64>,
    /// Texture aspect ratio: `sal` over the longest such lag, 0 (lay) to 1 (isotropic); `None` for a profile, and if the
    /// function stays above the threshold up to the largest lag in some direction.
    pub str: Option<f64>,
}

impl AreaCorrelation {
    /// Autocorrelation of `heights` \[m\] on `grid` where `defined` (`None`: everywhere), about their mean.
    /// For an open surface each lag is averaged over the overlapping pairs (unbiased, with more scatter at
    /// long lags).
    ///
    /// # Errors
    /// Slices that do not fit the grid, a defined height that is not finite, heights that are all equal.
    ///
    /// ```
    /// use stribeck::{Boundary, Grid, metrics::AreaCorrelation};
    /// let grid = Grid::centred(32, 1, 1e-6, 1e-6)?;
    /// let wave: Vec<f64> = (0..32).map(|i| (f64::from(i) * std::f64::consts::TAU / 8.0).sin()).collect();
    /// let correlation = AreaCorrelation::new(&grid, &wave, None, Boundary::Periodic)?;
    /// assert!((correlation.at(4, 0).unwrap() + 1.0).abs() < 1e-12); // half a wavelength
    /// assert!((correlation.at(-8, 0).unwrap() - 1.0).abs() < 1e-12);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn new(
        grid: &Grid,
        heights: &[f64],
        defined: Option<&[bool]>,
        boundary: Boundary,
    ) -> Result<Self, InputError> {
        let mask = Mask::new(grid, heights, defined)?;
        let deviations = mask.deviations(heights);
        let (nx, ny) = (grid.nx(), grid.ny());
        let reach = [nx / 2, ny / 2];
        // padding by half of the surface excludes wrapped pairs up to the reach
        let padded = match boundary {
            Boundary::Open => [nx + reach[0], ny + reach[1]],
            Boundary::Periodic => [nx, ny],
        };
        let largest = deviations.iter().fold(0.0_f64, |largest, z| largest.max(z.abs()));
        if largest == 0.0 {
            return Err(InputError::Conflict {
                field: "heights".to_owned(),
                reason: "a flat surface has no autocorrelation".to_owned(),
            });
        }
        // heights and weights share a transform and must be of similar magnitude
        let mut field = vec![Complex64::default(); padded[0] * padded[1]];
        for (k, z) in deviations.iter().enumerate() {
            let weight = if mask.has(k) { 1.0 } else { 0.0 };
            field[k / nx * padded[0] + k % nx] = Complex64::new(z / largest, weight);
        }
        let mut transform = Fft2::new(padded[0], padded[1]);
        transform.process(&mut field, FftDirection::Forward);
        let mut power = powers(&field, padded);
        transform.process(&mut power, FftDirection::Inverse);
        let square = power[0].re / power[0].im;
        let unit = (padded[0] * padded[1]) as f64;
        let (rx, ry) = (reach[0] as isize, reach[1] as isize);
        let mut values = Vec::with_capacity((2 * reach[0] + 1) * (2 * reach[1] + 1));
        for j in -ry..=ry {
            let row = j.rem_euclid(padded[1] as isize) as usize * padded[0];
            for i in -rx..=rx {
                let pair = power[row + i.rem_euclid(padded[0] as isize) as usize];
                // less than half a pair is rounding
                let pairs = pair.im / unit;
                values.push(if pairs > 0.5 { pair.re / pair.im / square } else { 0.0 });
            }
        }
        Ok(Self { reach, spacing: [grid.dx(), grid.dy()], values })
    }

    /// Largest lag along x and y, in nodes: half of the surface.
    #[must_use]
    pub fn reach(&self) -> (usize, usize) {
        (self.reach[0], self.reach[1])
    }

    /// The function at a lag of `(i, j)` nodes; `None` beyond the reach.
    #[must_use]
    pub fn at(&self, i: isize, j: isize) -> Option<f64> {
        let fits = i.unsigned_abs() <= self.reach[0] && j.unsigned_abs() <= self.reach[1];
        fits.then(|| self.values[self.index(i, j)])
    }

    /// Index of a lag in the values.
    fn index(&self, i: isize, j: isize) -> usize {
        let (rx, ry) = (self.reach[0] as isize, self.reach[1] as isize);
        ((j + ry) * (2 * rx + 1) + i + rx) as usize
    }

    /// The values as a row-major field of `2 reach_x + 1` by `2 reach_y + 1`, with lag zero in the middle.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Sal and Str for `threshold` (0.2 in the standard).
    ///
    /// A flood fill from lag zero covers the region in which the function exceeds the threshold. Lengths are
    /// interpolated linearly between the nodes on both sides of the threshold.
    ///
    /// # Errors
    /// A threshold that is not between 0 and 1.
    ///
    /// ```
    /// use stribeck::{Boundary, Grid, metrics::AreaCorrelation};
    /// use stribeck::surface::{Autocorrelation, RoughnessSpec, generate};
    /// let grid = Grid::centred(256, 256, 1e-6, 1e-6)?;
    /// let spec = RoughnessSpec {
    ///     autocorrelation: Autocorrelation::Gaussian, rq: 1e-7, length_x: 20e-6, length_y: 20e-6, seed: 1,
    /// };
    /// let heights = generate(&grid, &spec)?;
    /// let spatial = AreaCorrelation::new(&grid, &heights, None, Boundary::Periodic)?.spatial(0.2)?;
    /// // exp(-ln(10) s^2) = 0.2 at s = 0.836
    /// assert!((spatial.sal.unwrap() / 16.7e-6 - 1.0).abs() < 0.1 && spatial.str.unwrap() > 0.7);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn spatial(&self, threshold: f64) -> Result<SpatialParameters, InputError> {
        InputError::require(threshold > 0.0 && threshold < 1.0, "threshold", threshold, "between 0 and 1")?;
        let (mut nearest, mut farthest) = (f64::INFINITY, 0.0_f64);
        let mut inside = vec![false; self.values.len()];
        let mut reaches_edge = false;
        let mut open = vec![(0_isize, 0_isize)];
        inside[self.index(0, 0)] = true;
        while let Some((i, j)) = open.pop() {
            let value = self.values[self.index(i, j)];
            for (di, dj) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
                let (u, v) = (i + di, j + dj);
                let Some(beyond) = self.at(u, v) else {
                    // a single node along an axis has no larger lags
                    reaches_edge |= (di != 0 && self.reach[0] > 0) || (dj != 0 && self.reach[1] > 0);
                    continue;
                };
                if beyond > threshold {
                    let k = self.index(u, v);
                    if !inside[k] {
                        inside[k] = true;
                        open.push((u, v));
                    }
                    continue;
                }
                let part = (value - threshold) / (value - beyond);
                let x = (i as f64 + part * di as f64) * self.spacing[0];
                let y = (j as f64 + part * dj as f64) * self.spacing[1];
                nearest = nearest.min(x.hypot(y));
                farthest = farthest.max(x.hypot(y));
            }
        }
        Ok(SpatialParameters {
            sal: nearest.is_finite().then_some(nearest),
            str: (nearest.is_finite() && !reaches_edge && !self.reach.contains(&0))
                .then(|| nearest / farthest),
        })
    }
}

/// Transforms of the correlations of `z` and `w`, as real and imaginary part, from that of `z + i w` (heights
/// and weights).
fn powers(field: &[Complex64], [nx, ny]: [usize; 2]) -> Vec<Complex64> {
    (0..field.len())
        .map(|k| {
            let (i, j) = (k % nx, k / nx);
            let opposite = field[(ny - j) % ny * nx + (nx - i) % nx].conj();
            let z = 0.5 * (field[k] + opposite);
            let w = 0.5 * (field[k] - opposite);
            Complex64::new(z.norm_sqr(), w.norm_sqr())
        })
        .collect()
}
