//! Hybrid parameters: slope and area (ISO 25178-2).

use super::mask::Mask;
use crate::error::InputError;
use crate::grid::Grid;

/// Hybrid parameters.
///
/// # Examples
///
/// ```
/// use stribeck::metrics::hybrid_parameters;
/// use stribeck::Grid;
/// let grid = Grid::centred(64, 8, 1e-6, 1e-6)?;
/// let wave: Vec<f64> = grid.nodes().map(|(x, _)| 1e-7 * (x * std::f64::consts::TAU / 64e-6).sin()).collect();
/// let slope = hybrid_parameters(&grid, &wave, None)?.sdq;
/// // For a sine: amplitude times wave number over the square root of two.
/// let exact = 1e-7 * std::f64::consts::TAU / 64e-6 / 2.0_f64.sqrt();
/// assert!((slope / exact - 1.0).abs() < 0.01);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct HybridParameters {
    /// Root mean square gradient `sqrt(mean (dz/dx)^2 + mean (dz/dy)^2)`; of a line the slope along it alone.
    pub sdq: f64,
    /// Developed area over projected area, minus 1; zero for a line.
    pub sdr: f64,
}

/// Gradient and developed area of `heights` \[m\] on `grid`, where `defined` (`None`: everywhere).
///
/// Slopes are differences between neighbors, averaged along each axis over all pairs of defined points. The
/// area of the cell between four defined points is the mean of its two triangulations. On surfaces that are
/// rough at all scales both parameters grow with the resolution; filter first.
///
/// # Errors
/// Slices that do not fit the grid, a defined height that is not finite, no two defined neighbours.
///
/// ```
/// use stribeck::{Grid, metrics::hybrid_parameters};
/// let grid = Grid::centred(8, 8, 1e-6, 1e-6)?;
/// let ramp: Vec<f64> = grid.nodes().map(|(x, y)| 0.3 * x + 0.4 * y).collect();
/// let hybrid = hybrid_parameters(&grid, &ramp, None)?;
/// assert!((hybrid.sdq - 0.5).abs() < 1e-9);
/// assert!((hybrid.sdr - (1.25_f64.sqrt() - 1.0)).abs() < 1e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn hybrid_parameters(
    grid: &Grid,
    heights: &[f64],
    defined: Option<&[bool]>,
) -> Result<HybridParameters, InputError> {
    let mask = Mask::new(grid, heights, defined)?;
    let (nx, ny, dx, dy) = (grid.nx(), grid.ny(), grid.dx(), grid.dy());
    let slope =
        |a: usize, b: usize, d: f64| (mask.has(a) && mask.has(b)).then(|| (heights[b] - heights[a]) / d);
    let (mut along_x, mut along_y, mut area) = (Mean::default(), Mean::default(), Mean::default());
    for j in 0..ny {
        for i in 0..nx {
            let k = j * nx + i;
            let (right, up) = (i + 1 < nx, j + 1 < ny);
            let bottom = right.then(|| slope(k, k + 1, dx)).flatten();
            let left = up.then(|| slope(k, k + nx, dy)).flatten();
            bottom.iter().for_each(|p| along_x.add(p * p));
            left.iter().for_each(|p| along_y.add(p * p));
            if !(right && up) {
                continue;
            }
            let top = slope(k + nx, k + nx + 1, dx);
            let far = slope(k + 1, k + nx + 1, dy);
            if let (Some(bottom), Some(top), Some(left), Some(far)) = (bottom, top, left, far) {
                let corner = |p: f64, q: f64| excess(p * p + q * q);
                let corners =
                    [corner(bottom, left), corner(bottom, far), corner(top, left), corner(top, far)];
                area.add(0.25 * corners.iter().sum::<f64>());
            }
        }
    }
    if along_x.count + along_y.count == 0 {
        return Err(InputError::Conflict {
            field: "heights".to_owned(),
            reason: "slopes need two defined neighbors".to_owned(),
        });
    }
    Ok(HybridParameters { sdq: (along_x.value() + along_y.value()).sqrt(), sdr: area.value() })
}

/// `sqrt(1 + squared) - 1` without cancellation.
fn excess(squared: f64) -> f64 {
    squared / ((1.0 + squared).sqrt() + 1.0)
}

/// A running mean.
#[derive(Default)]
struct Mean {
    /// Sum of the values.
    sum: f64,
    /// Number of the values.
    count: usize,
}

impl Mean {
    /// Adds a value.
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1;
    }

    /// The mean, or zero without values.
    fn value(&self) -> f64 {
        self.sum / self.count.max(1) as f64
    }
}
