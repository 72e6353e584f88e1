//! The material ratio curve (bearing area or Abbott-Firestone curve) and its parameters (ISO 25178-2, ISO
//! 13565-2).

use super::roughness::{height_statistics, require_heights};
use crate::error::InputError;

/// Share of the curve through which the line of the core is fitted.
const SECANT: f64 = 0.4;

/// Height as a function of the areal material ratio, from the highest peak at ratio 0 to the deepest valley
/// at ratio 1. Heights are relative to their mean.
///
/// ```
/// use stribeck::metrics::BearingCurve;
/// let ramp: Vec<f64> = (0..1000).map(|i| f64::from(i) * 1e-9).collect();
/// let curve = BearingCurve::new(&ramp)?;
/// assert!(curve.height_at(0.5).abs() < 1e-12);
/// assert!((curve.height_at(0.1) - 400e-9).abs() < 1e-9);
/// assert!((curve.material_ratio_at(400e-9) - 0.1).abs() < 1e-3);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct BearingCurve {
    /// Heights about the mean, highest first \[m\]; entry i is at the ratio (i + 1/2)/n.
    heights: Vec<f64>,
}

/// Parameters of the core, the peaks and the valleys (ISO 13565-2, areal form ISO 25178-2).
///
/// The equivalent line is the line of least squares through the 40 % of the curve whose secant has the least
/// slope (the first of equals). Between the ratios 0 and 1 it spans the core height Sk. The ratios at which its
/// ends cut the curve are Smr1 and Smr2; the peaks above and the valleys below are turned into triangles of the
/// same area on these bases, whose heights are Spk and Svk.
///
/// # Examples
///
/// ```
/// use stribeck::metrics::BearingCurve;
/// // A plateau with deep valleys: Svk exceeds Spk.
/// let heights: Vec<f64> =
///     (0..1000).map(|i| if i % 10 == 0 { -1e-6 } else { 1e-9 * f64::from(i % 7) }).collect();
/// let core = BearingCurve::new(&heights)?.core();
/// assert!(core.svk > 10.0 * core.spk && core.smr2 < 0.95);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct CoreParameters {
    /// Core height \[m\].
    pub sk: f64,
    /// Reduced peak height \[m\].
    pub spk: f64,
    /// Reduced valley depth \[m\].
    pub svk: f64,
    /// Material ratio that separates peaks from the core, 0 to 1.
    pub smr1: f64,
    /// Material ratio that separates the core from the valleys, 0 to 1.
    pub smr2: f64,
}

/// Material and void volumes per area (ISO 25178-2).
///
/// # Examples
///
/// ```
/// use stribeck::metrics::BearingCurve;
/// let ramp: Vec<f64> = (0..1000).map(|i| f64::from(i) * 1e-9).collect();
/// let volumes = BearingCurve::new(&ramp)?.volumes(0.1, 0.8)?;
/// // A triangle of 0.1 by 100 nm above the first ratio.
/// assert!((volumes.vmp / (0.5 * 0.1 * 100e-9) - 1.0).abs() < 0.01);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct VolumeParameters {
    /// Material above the height of the first ratio \[m^3/m^2\].
    pub vmp: f64,
    /// Material between the heights of the two ratios \[m^3/m^2\].
    pub vmc: f64,
    /// Void between the heights of the two ratios \[m^3/m^2\].
    pub vvc: f64,
    /// Void below the height of the second ratio \[m^3/m^2\].
    pub vvv: f64,
}

impl BearingCurve {
    /// Curve of `heights` \[m\]. Sorting costs O(n log n).
    ///
    /// # Errors
    /// An empty slice, a height that is not finite.
    pub fn new(heights: &[f64]) -> Result<Self, InputError> {
        require_heights(heights)?;
        let mean = height_statistics(heights)?.mean;
        let mut heights: Vec<f64> = heights.iter().map(|h| h - mean).collect();
        heights.sort_unstable_by(|a, b| b.total_cmp(a));
        Ok(Self { heights })
    }

    /// The heights \[m\] about their mean, highest first; the i-th of n is at the material ratio
    /// `(i + 1/2)/n`.
    #[must_use]
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Height \[m\] at a material ratio, by linear interpolation; ratios are clamped to 0 and 1.
    ///
    /// ```
    /// # use stribeck::metrics::BearingCurve;
    /// let curve = BearingCurve::new(&[0.0, 2.0])?;
    /// assert!((curve.height_at(0.0) - 1.0).abs() < 1e-15 && (curve.height_at(1.0) + 1.0).abs() < 1e-15);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    #[must_use]
    pub fn height_at(&self, material_ratio: f64) -> f64 {
        let last = self.heights.len() - 1;
        let position = (material_ratio * self.heights.len() as f64 - 0.5).clamp(0.0, last as f64);
        let low = position as usize;
        let high = (low + 1).min(last);
        let part = position - low as f64;
        (1.0 - part) * self.heights[low] + part * self.heights[high]
    }

    /// Areal material ratio at `height` \[m\] (relative to the mean), by linear interpolation.
    ///
    /// ```
    /// # use stribeck::metrics::BearingCurve;
    /// let curve = BearingCurve::new(&[0.0, 2.0])?;
    /// assert!((curve.material_ratio_at(0.0) - 0.5).abs() < 1e-15);
    /// assert!(curve.material_ratio_at(5.0).abs() < 1e-15);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    #[must_use]
    pub fn material_ratio_at(&self, height: f64) -> f64 {
        let count = self.heights.len();
        let above = self.heights.partition_point(|&h| h > height);
        if above == 0 || above == count {
            return above as f64 / count as f64;
        }
        let (upper, lower) = (self.heights[above - 1], self.heights[above]);
        let part = (upper - height) / (upper - lower);
        (above as f64 - 0.5 + part) / count as f64
    }

    /// Core, peak and valley parameters.
    ///
    /// Of a normal distribution of standard deviation Sq: `sk = 2.574 Sq`, `spk = svk = 0.945 Sq`,
    /// `smr1 = 9.9 %`. The line through both ends of the secant, which some programs take, gives 2.622 Sq, 0.937 Sq
    /// and 9.5 %.
    ///
    /// ```
    /// # use stribeck::metrics::BearingCurve;
    /// let ramp: Vec<f64> = (0..1000).map(|i| f64::from(i) * 1e-9).collect();
    /// let core = BearingCurve::new(&ramp)?.core();
    /// assert!((core.sk - 1000e-9).abs() < 1e-12); // all core
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    #[must_use]
    pub fn core(&self) -> CoreParameters {
        let (top, bottom) = self.equivalent_line();
        let (smr1, smr2) = (self.material_ratio_at(top), self.material_ratio_at(bottom));
        let triangle = |area: f64, base: f64| if base > 0.0 { 2.0 * area / base } else { 0.0 };
        CoreParameters {
            sk: top - bottom,
            spk: triangle(self.material_above(top), smr1),
            svk: triangle(self.void_below(bottom), 1.0 - smr2),
            smr1,
            smr2,
        }
    }

    /// Material and void volumes for the ratios `peaks` and `valleys` (0.10 and 0.80 in the standard).
    ///
    /// # Errors
    /// Ratios that are not `0 <= peaks <= valleys <= 1`.
    ///
    /// ```
    /// # use stribeck::metrics::BearingCurve;
    /// let ramp: Vec<f64> = (0..1000).map(|i| f64::from(i) * 1e-9).collect();
    /// let volumes = BearingCurve::new(&ramp)?.volumes(0.1, 0.8)?;
    /// assert!((volumes.vvv - 0.5 * 0.2 * 200e-9).abs() < 1e-11); // a triangle
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn volumes(&self, peaks: f64, valleys: f64) -> Result<VolumeParameters, InputError> {
        InputError::require((0.0..=1.0).contains(&peaks), "peaks", peaks, "between 0 and 1")?;
        InputError::require(
            valleys >= peaks && valleys <= 1.0,
            "valleys",
            valleys,
            "at most 1 and not below the ratio of the peaks",
        )?;
        let (high, low) = (self.height_at(peaks), self.height_at(valleys));
        let (vmp, vvv) = (self.material_above(high), self.void_below(low));
        Ok(VolumeParameters {
            vmp,
            vmc: self.material_above(low) - vmp,
            vvc: self.void_below(high) - vvv,
            vvv,
        })
    }

    /// Heights \[m\] of the equivalent line of the core at the material ratios 0 and 1, see [`CoreParameters`].
    ///
    /// ```
    /// # use stribeck::metrics::BearingCurve;
    /// let ramp: Vec<f64> = (0..1000).map(|i| f64::from(i) * 1e-9).collect();
    /// let (top, bottom) = BearingCurve::new(&ramp)?.equivalent_line();
    /// assert!((top - 500e-9).abs() < 1e-12 && (bottom + 500e-9).abs() < 1e-12);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    #[must_use]
    pub fn equivalent_line(&self) -> (f64, f64) {
        let count = self.heights.len() as f64;
        let first = self.flattest_start();
        let points = ((SECANT * count).round() as usize).clamp(1, self.heights.len() - first);
        // the line of least squares about the middle of the points
        let middle = (first as f64 + 0.5 * points as f64) / count;
        let (mut mean, mut moment, mut square) = (0.0, 0.0, 0.0);
        for (i, height) in self.heights[first..first + points].iter().enumerate() {
            let ratio = ((first + i) as f64 + 0.5) / count - middle;
            mean += height / points as f64;
            moment += ratio * height;
            square += ratio * ratio;
        }
        let slope = if square > 0.0 { moment / square } else { 0.0 };
        (mean - slope * middle, mean + slope * (1.0 - middle))
    }

    /// First point of the 40 % of the curve whose secant has the least slope; the first of equals.
    fn flattest_start(&self) -> usize {
        let count = self.heights.len() as f64;
        let mut best = (0, f64::INFINITY);
        for i in 0..self.heights.len() {
            let start = (i as f64 + 0.5) / count;
            // both ends lie between points of the curve; a single point has no secant
            if start + SECANT > 1.0 - 0.5 / count {
                break;
            }
            let drop = self.height_at(start) - self.height_at(start + SECANT);
            if drop < best.1 {
                best = (i, drop);
            }
        }
        best.0
    }

    /// Material above `height` \[m\] over the area.
    fn material_above(&self, height: f64) -> f64 {
        let part = self.heights.iter().take_while(|&&h| h > height);
        part.map(|h| h - height).sum::<f64>() / self.heights.len() as f64
    }

    /// Void below `height` \[m\] over the area.
    fn void_below(&self, height: f64) -> f64 {
        let part = self.heights.iter().rev().take_while(|&&h| h < height);
        part.map(|h| height - h).sum::<f64>() / self.heights.len() as f64
    }
}
