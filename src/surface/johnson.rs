//! The Johnson system: transformation of normal deviates to a given skewness and kurtosis.
//!
//! With a normal deviate `g`, the standardized height is `(f(g) - mean)/deviation`. The function `f` is one of four: `g`,
//! `exp(g/delta)`, a logistic curve (bounded heights) or `sinh` (heavy tails). Skewness and kurtosis select it and its
//! constants: at a given skewness the lognormal curve separates bounded from unbounded ones. The transformation changes
//! the correlations of a normal surface; [`Johnson::correlations`] gives those that the normal surface needs.

use crate::error::InputError;

/// Largest skewness; heavier tails are not sampled by any surface.
const MAX_SKEWNESS: f64 = 5.0;
/// Largest kurtosis.
const MAX_KURTOSIS: f64 = 100.0;
/// Distance from the limit `kurtosis = skewness^2 + 1` of a two-point distribution.
const MARGIN: f64 = 0.2;
/// Distance from the lognormal curve below which a kurtosis counts as on it.
const ON_CURVE: f64 = 1e-6;
/// Smallest delta of bounded curves.
const DELTA_BOUNDED: f64 = 0.05;
/// Smallest delta of unbounded curves; for smaller ones the moments overflow.
const DELTA_UNBOUNDED: f64 = 0.3;
/// Largest delta; the curve is then normal to rounding.
const DELTA_LARGEST: f64 = 1e3;
/// Bisections for a constant.
const BISECTIONS: usize = 48;
/// Quadrature over the normal deviate: trapezoids, which converge exponentially here.
const REACH: f64 = 9.0;
/// Points of the quadrature between minus and plus [`REACH`].
const POINTS: usize = 601;
/// Intervals of the table of the curve.
const INTERVALS: usize = 8192;
/// Terms of the Hermite series for correlations.
const TERMS: usize = 30;
/// Nodes of the table of correlations.
const TABLE: usize = 1025;

/// The transformation of deviates, standardized to mean 0 and variance 1 and mirrored for a negative skewness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Johnson {
    /// Which member of the system.
    shape: Shape,
    /// -1 for a negative skewness, otherwise 1.
    mirror: f64,
    /// Mean of the curve.
    mean: f64,
    /// Its standard deviation.
    deviation: f64,
}

/// A member of the Johnson system.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    /// The deviate itself.
    Normal,
    /// `exp(g / delta)`
    Lognormal {
        /// Spread: smaller values are farther from normal.
        delta: f64,
    },
    /// `1 / (1 + exp(-(g - gamma) / delta))`
    Bounded { gamma: f64, delta: f64 },
    /// `sinh((g - gamma) / delta)`
    Unbounded { gamma: f64, delta: f64 },
}

impl Shape {
    /// The curve before standardization.
    fn at(self, deviate: f64) -> f64 {
        match self {
            Self::Normal => deviate,
            Self::Lognormal { delta } => (deviate / delta).exp(),
            Self::Bounded { gamma, delta } => 1.0 / (1.0 + ((gamma - deviate) / delta).exp()),
            Self::Unbounded { gamma, delta } => ((deviate - gamma) / delta).sinh(),
        }
    }

    /// Its derivative by the deviate.
    fn slope(self, deviate: f64) -> f64 {
        let value = self.at(deviate);
        match self {
            Self::Normal => 1.0,
            Self::Lognormal { delta } => value / delta,
            Self::Bounded { delta, .. } => value * (1.0 - value) / delta,
            Self::Unbounded { gamma, delta } => ((deviate - gamma) / delta).cosh() / delta,
        }
    }

    /// Mean, standard deviation, skewness and kurtosis by quadrature.
    fn moments(self) -> [f64; 4] {
        let values: Vec<(f64, f64)> = quadrature().map(|(g, weight)| (self.at(g), weight)).collect();
        let mean = values.iter().map(|(z, weight)| weight * z).sum::<f64>();
        let central =
            |power: i32| values.iter().map(|(z, weight)| weight * (z - mean).powi(power)).sum::<f64>();
        let deviation = central(2).sqrt();
        [mean, deviation, central(3) / deviation.powi(3), central(4) / deviation.powi(4)]
    }
}

/// Normal deviates and their probabilities.
fn quadrature() -> impl Iterator<Item = (f64, f64)> {
    let step = 2.0 * REACH / (POINTS - 1) as f64;
    let scale = step / std::f64::consts::TAU.sqrt();
    (0..POINTS).map(move |k| {
        let deviate = -REACH + step * k as f64;
        (deviate, scale * (-0.5 * deviate * deviate).exp())
    })
}

/// Bisects for the root of a monotonic condition: `below` is true on the lower side.
fn bisect([mut low, mut high]: [f64; 2], below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

impl Johnson {
    /// The member of the system with these moments.
    ///
    /// Source: Johnson, N. L. (1949), Biometrika 36, 149-176.
    pub(super) fn new(skewness: f64, kurtosis: f64) -> Result<Self, InputError> {
        let finite = skewness.is_finite() && skewness.abs() <= MAX_SKEWNESS;
        InputError::require(finite, "skewness", skewness, "between -5 and 5")?;
        let lowest = skewness * skewness + 1.0 + MARGIN;
        if !(lowest..=MAX_KURTOSIS).contains(&kurtosis) {
            return Err(InputError::Conflict {
                field: format!("kurtosis = {kurtosis}"),
                reason: format!(
                    "with skewness {skewness} it must be between skewness^2 + {:.1} = {lowest:.4} and {MAX_KURTOSIS}",
                    1.0 + MARGIN
                ),
            });
        }
        let shape = Self::fit(skewness.abs(), kurtosis);
        let [mean, deviation, ..] = shape.moments();
        Ok(Self { shape, mirror: if skewness < 0.0 { -1.0 } else { 1.0 }, mean, deviation })
    }

    /// The member with this `skewness`, not negative, and `kurtosis`.
    fn fit(skewness: f64, kurtosis: f64) -> Shape {
        // lognormal curve: skewness^2 = (w - 1)(w + 2)^2 with w = exp(1/delta^2)
        let beta = skewness * skewness;
        let w = bisect([1.0, 1.0 + beta], |w| (w - 1.0) * (w + 2.0) * (w + 2.0) < beta);
        let curve = w.powi(4) + 2.0 * w.powi(3) + 3.0 * w * w - 3.0;
        let delta = (1.0 / w.ln()).sqrt();
        if (kurtosis - curve).abs() < ON_CURVE {
            return if beta < ON_CURVE { Shape::Normal } else { Shape::Lognormal { delta } };
        }
        // at fixed skewness the kurtosis is monotonic in delta: bounded curves increase to the lognormal one, unbounded
        // ones decrease to it
        let largest = delta.min(DELTA_LARGEST);
        if kurtosis < curve {
            let at = |delta: f64| Shape::Bounded { gamma: gamma_bounded(delta, skewness), delta };
            at(bisect([DELTA_BOUNDED, largest], |delta| at(delta).moments()[3] < kurtosis))
        } else {
            let at = |delta: f64| gamma_unbounded(delta, skewness);
            let delta =
                bisect([DELTA_UNBOUNDED, largest], |delta| unbounded_moments(delta, at(delta))[1] > kurtosis);
            Shape::Unbounded { gamma: -at(delta) * delta, delta }
        }
    }

    /// The transformed deviate.
    pub(super) fn at(&self, deviate: f64) -> f64 {
        self.mirror * (self.shape.at(deviate) - self.mean) / self.deviation
    }

    /// [`Self::at`] as a table.
    pub(super) fn tabulated(&self) -> Curve<'_> {
        let step = 2.0 * REACH / INTERVALS as f64;
        let node = |k: usize| {
            let deviate = -REACH + step * k as f64;
            [self.at(deviate), self.mirror * self.shape.slope(deviate) / self.deviation * step]
        };
        Curve { johnson: self, nodes: (0..=INTERVALS).map(node).collect() }
    }

    /// Correlations of normal deviates for given ones of the transformed deviates: pairs `(requested, needed)`, increasing,
    /// for needed correlations from -1 to 1.
    ///
    /// With the Hermite coefficients `a_n` of the curve, `requested = sum a_n^2 n! needed^n / sum a_n^2 n!`.
    pub(super) fn correlations(&self) -> Vec<(f64, f64)> {
        let mut shares = [0.0; TERMS];
        for (deviate, weight) in quadrature() {
            let value = weight * self.at(deviate);
            // Hermite polynomials of unit norm
            let (mut before, mut current) = (0.0, 1.0);
            for (n, share) in shares.iter_mut().enumerate() {
                *share += value * current;
                let next = (deviate * current - (n as f64).sqrt() * before) / ((n + 1) as f64).sqrt();
                (before, current) = (current, next);
            }
        }
        let norm: f64 = shares.iter().skip(1).map(|a| a * a).sum();
        let requested = |needed: f64| {
            let terms = shares.iter().skip(1).rev();
            terms.fold(0.0, |sum, a| (sum + a * a) * needed) / norm
        };
        let needed = (0..TABLE).map(|k| 2.0 * k as f64 / (TABLE - 1) as f64 - 1.0);
        let mut table: Vec<(f64, f64)> = needed.map(|needed| (requested(needed), needed)).collect();
        // strongly skewed curves have a lower bound of the correlation: smaller requests get the bound
        let middle = TABLE / 2;
        let falling = (0..middle).rev().take_while(|&k| table[k].0 < table[k + 1].0).count();
        table.drain(..middle - falling);
        table
    }
}

/// A curve as cubic Hermite interpolation between nodes, with errors up to 1e-8.
pub(super) struct Curve<'a> {
    /// The exact curve, for deviates outside the table.
    johnson: &'a Johnson,
    /// Values, and slopes times node spacing, from `-REACH` to `REACH`.
    nodes: Vec<[f64; 2]>,
}

impl Curve<'_> {
    /// The transformed deviate.
    pub(super) fn at(&self, deviate: f64) -> f64 {
        let position = (deviate + REACH) * (INTERVALS as f64 / (2.0 * REACH));
        let index = position as usize;
        let (Some([low, slope_low]), Some([high, slope_high])) =
            (self.nodes.get(index), self.nodes.get(index + 1))
        else {
            return self.johnson.at(deviate);
        };
        if position < 0.0 {
            return self.johnson.at(deviate);
        }
        let t = position - index as f64;
        let rise = high - low;
        low + t
            * (slope_low
                + t * (3.0 * rise - 2.0 * slope_low - slope_high + t * (slope_low + slope_high - 2.0 * rise)))
    }
}

/// Shift of a bounded curve with the given skewness.
fn gamma_bounded(delta: f64, skewness: f64) -> f64 {
    // the curve tends to the lognormal one
    let farthest = 12.0 + 40.0 * delta;
    bisect([0.0, farthest], |gamma| Shape::Bounded { gamma, delta }.moments()[2] < skewness)
}

/// `-gamma / delta` of an unbounded curve with the given skewness.
fn gamma_unbounded(delta: f64, skewness: f64) -> f64 {
    bisect([0.0, 40.0], |omega| unbounded_moments(delta, omega)[0] < skewness)
}

/// Skewness and kurtosis of `sinh(g / delta + omega)`.
fn unbounded_moments(delta: f64, omega: f64) -> [f64; 2] {
    let w = (1.0 / (delta * delta)).exp();
    let variance = 0.5 * (w - 1.0) * (w * (2.0 * omega).cosh() + 1.0);
    let third =
        0.25 * w.sqrt() * (w - 1.0).powi(2) * (w * (w + 2.0) * (3.0 * omega).sinh() + 3.0 * omega.sinh());
    let fourth = (w - 1.0).powi(2) / 8.0
        * (w * w * (w.powi(4) + 2.0 * w.powi(3) + 3.0 * w * w - 3.0) * (4.0 * omega).cosh()
            + 4.0 * w * w * (w + 2.0) * (2.0 * omega).cosh()
            + 3.0 * (2.0 * w + 1.0));
    [third / variance.powf(1.5), fourth / (variance * variance)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fitted_curve_has_the_requested_moments() {
        let cases = [
            (0.0, 3.0),
            (-1.0, 5.0),
            (1.0, 4.0),
            (0.0, 1.8),
            (0.0, 1.2),
            (0.0, 20.0),
            (-2.0, 10.0),
            (-2.0, 5.2),
            (0.5, 3.0),
            (0.3, 3.1607),
            (3.0, 30.0),
            (1e-3, 3.0),
        ];
        for (skewness, kurtosis) in cases {
            let johnson = Johnson::new(skewness, kurtosis).unwrap();
            let weighted = |power: i32| quadrature().map(|(g, w)| w * johnson.at(g).powi(power)).sum::<f64>();
            assert!(weighted(1).abs() < 1e-9 && (weighted(2) - 1.0).abs() < 1e-9);
            assert!(
                (weighted(3) - skewness).abs() < 2e-3,
                "{skewness} {kurtosis}: {} {johnson:?}",
                weighted(3)
            );
            assert!((weighted(4) / kurtosis - 1.0).abs() < 2e-3, "{skewness} {kurtosis}: {}", weighted(4));
            let curve = johnson.tabulated();
            for k in 0..200_003 {
                let deviate = f64::from(k) * 1e-4 - 10.0;
                let exact = johnson.at(deviate);
                let error = (curve.at(deviate) - exact).abs() / exact.abs().max(1.0);
                assert!(error < 1e-8, "{skewness} {kurtosis}: {error:e} at {deviate}");
            }
        }
    }
}
