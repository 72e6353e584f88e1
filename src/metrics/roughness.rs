//! Height parameters of a surface (ISO 25178-2).

use crate::error::InputError;

/// Moments and extremes of the heights of a surface about their mean, without leveling or filtering.
///
/// # Examples
///
/// ```
/// use stribeck::metrics::height_statistics;
/// let wave: Vec<f64> = (0..64).map(|i| (f64::from(i) * std::f64::consts::TAU / 64.0).sin()).collect();
/// let statistics = height_statistics(&wave)?;
/// assert!((statistics.sq - 0.5_f64.sqrt()).abs() < 1e-12); // for a sine
/// assert!((statistics.sku - 1.5).abs() < 1e-12 && statistics.ssk.abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct HeightStatistics {
    /// Mean height \[m\], the reference of the other parameters.
    pub mean: f64,
    /// Arithmetic mean deviation `mean |z|` \[m\].
    pub sa: f64,
    /// Root mean square deviation `sqrt(mean z^2)` \[m\].
    pub sq: f64,
    /// Skewness `mean z^3 / sq^3`; zero for a flat surface.
    pub ssk: f64,
    /// Kurtosis `mean z^4 / sq^4` (3 for a normal distribution); zero for a flat surface.
    pub sku: f64,
    /// Height of the highest peak `max z` \[m\].
    pub sp: f64,
    /// Depth of the deepest valley `-min z` \[m\].
    pub sv: f64,
    /// Total height `sp + sv` \[m\].
    pub sz: f64,
}

/// Height parameters of `heights` \[m\]: population moments (divided by the number of values) about the mean.
///
/// A surface counts as flat if its deviations are below the rounding error of the mean.
///
/// # Errors
/// An empty slice, a height that is not finite.
///
/// ```
/// let statistics = stribeck::metrics::height_statistics(&[1e-6, -1e-6, 1e-6, -1e-6])?;
/// assert!((statistics.sq - 1e-6).abs() < 1e-18);
/// assert!((statistics.sku - 1.0).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn height_statistics(heights: &[f64]) -> Result<HeightStatistics, InputError> {
    require_heights(heights)?;
    let count = heights.len() as f64;
    let mean = mean(heights.iter().copied());
    let (mut absolute, mut square) = (0.0, 0.0);
    let (mut highest, mut lowest) = (0.0_f64, 0.0_f64);
    for height in heights {
        let z = height - mean;
        absolute += z.abs();
        square += z * z;
        highest = highest.max(z);
        lowest = lowest.min(z);
    }
    let sq = (square / count).sqrt();
    let flat = sq <= 4.0 * f64::EPSILON * mean.abs();
    let (ssk, sku) = if flat { (0.0, 0.0) } else { shape(heights, mean, sq) };
    Ok(HeightStatistics {
        mean,
        sa: absolute / count,
        sq,
        ssk,
        sku,
        sp: highest,
        sv: -lowest,
        sz: highest - lowest,
    })
}

/// Mean of heights; a second pass removes the rounding error of the first.
pub(super) fn mean(heights: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = heights.clone().count() as f64;
    let rough: f64 = heights.clone().map(|z| z / count).sum();
    rough + heights.map(|z| (z - rough) / count).sum::<f64>()
}

/// Skewness and kurtosis of scaled heights, as fourth powers of nanometers would underflow.
fn shape(heights: &[f64], mean: f64, sq: f64) -> (f64, f64) {
    let (mut third, mut fourth) = (0.0, 0.0);
    for height in heights {
        let z = (height - mean) / sq;
        third += z * z * z;
        fourth += z * z * z * z;
    }
    (third / heights.len() as f64, fourth / heights.len() as f64)
}

/// Rejects empty slices and heights that are not finite.
pub(super) fn require_heights(heights: &[f64]) -> Result<(), InputError> {
    if heights.is_empty() {
        return Err(InputError::Shape { field: "heights".to_owned(), expected: 1, found: 0 });
    }
    InputError::require_finite("heights", heights)
}

/// Root mean square roughness of the gap between two independent surfaces, `sqrt(Rq1^2 + Rq2^2)` \[m\].
///
/// ```
/// let composite = stribeck::metrics::composite_rq(20e-9, 130e-9);
/// assert!((composite - 131.5e-9).abs() < 0.05e-9);
/// ```
#[must_use]
pub fn composite_rq(first: f64, second: f64) -> f64 {
    first.hypot(second)
}
