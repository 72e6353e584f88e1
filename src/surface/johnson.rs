//! The Johnson system: a normal deviate turned into one of given skewness and kurtosis.
//!
//! With a normal deviate `g`, the standardised height is `(f(g) - mean)/deviation`, `f` one of four: `g`
//! itself, `exp(g/delta)`, a logistic curve (bounded heights) or `sinh` (heavy tails). Skewness and kurtosis
//! decide which, and fix its constants: at a given skewness the lognormal curve divides bounded from
//! unbounded. Turning a correlated normal surface changes its correlations; [`Johnson::correlations`] says
//! which ones the normal surface needs.

use crate::error::InputError;

/// Largest skewness and kurtosis that are offered; heavier tails are not sampled by any surface.
const MAX_SKEWNESS: f64 = 5.0;
/// Largest kurtosis that is fitted.
const MAX_KURTOSIS: f64 = 100.0;
/// Distance kept from the limit `kurtosis = skewness^2 + 1`, where only two heights are left.
const MARGIN: f64 = 0.2;
/// Kurtosis this close to that of the lognormal curve counts as on it.
const ON_CURVE: f64 = 1e-6;
/// Smallest delta of either branch and largest that are tried.
const DELTA_BOUNDED: f64 = 0.05;
/// Of unbounded curves; smaller ones have no such moments in doubles.
const DELTA_UNBOUNDED: f64 = 0.3;
/// Beyond it a curve is as good as normal.
const DELTA_LARGEST: f64 = 1e3;
/// Halvings of an interval for a constant.
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

/// The curve between two deviates, standardised to mean 0 and variance 1 and mirrored for a negative
/// skewness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Johnson {
    /// Which member of the system.
    shape: Shape,
    /// -1 where the skewness asked for is negative, else 1.
    mirror: f64,
    /// Mean of what the shape gives.
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
        /// Spread: the smaller, the farther from normal.
        delta: f64,
    },
    /// `1 / (1 + exp(-(g - gamma) / delta))`
    Bounded { gamma: f64, delta: f64 },
    /// `sinh((g - gamma) / delta)`
    Unbounded { gamma: f64, delta: f64 },
}

impl Shape {
    /// The curve, not standardised.
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

/// Argument in the middle of the last interval when `rises` tells on which side of the root a value lies.
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
        // the lognormal curve: skewness^2 = (w - 1)(w + 2)^2 with w = exp(1/delta^2)
        let beta = skewness * skewness;
        let w = bisect([1.0, 1.0 + beta], |w| (w - 1.0) * (w + 2.0) * (w + 2.0) < beta);
        let curve = w.powi(4) + 2.0 * w.powi(3) + 3.0 * w * w - 3.0;
        let delta = (1.0 / w.ln()).sqrt();
        if (kurtosis - curve).abs() < ON_CURVE {
            return if beta < ON_CURVE { Shape::Normal } else { Shape::Lognormal { delta } };
        }
        // at a given skewness the kurtosis is monotonic in delta: up to the curve when bounded, down to it
        // when not
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

    /// The deviate of the distribution that belongs to a normal one.
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

    /// Correlations that normal deviates need so that the turned ones have those asked for: pairs
    /// `(asked, needed)`, rising, for needed correlations from -1 to 1.
    ///
    /// With the Hermite coefficients `a_n` of the curve, `asked = sum a_n^2 n! needed^n / sum a_n^2 n!`.
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
        let asked = |needed: f64| {
            let terms = shares.iter().skip(1).rev();
            terms.fold(0.0, |sum, a| (sum + a * a) * needed) / norm
        };
        let needed = (0..TABLE).map(|k| 2.0 * k as f64 / (TABLE - 1) as f64 - 1.0);
        let mut table: Vec<(f64, f64)> = needed.map(|needed| (asked(needed), needed)).collect();
        // strongly skewed curves cannot be anticorrelated beyond some value: what asks for more gets that
        let middle = TABLE / 2;
        let falling = (0..middle).rev().take_while(|&k| table[k].0 < table[k + 1].0).count();
        table.drain(..middle - falling);
        table
    }
}

/// A curve as cubic polynomials between nodes (Hermite), at most 1e-8 off.
pub(super) struct Curve<'a> {
    /// The curve itself, for deviates beyond the table.
    johnson: &'a Johnson,
    /// Values and slopes, these times the distance of the nodes, from `-REACH` to `REACH`.
    nodes: Vec<[f64; 2]>,
}

impl Curve<'_> {
    /// The deviate of the distribution that belongs to a normal one.
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

/// Shift that gives a bounded curve the skewness.
fn gamma_bounded(delta: f64, skewness: f64) -> f64 {
    // far out the curve is lognormal
    let farthest = 12.0 + 40.0 * delta;
    bisect([0.0, farthest], |gamma| Shape::Bounded { gamma, delta }.moments()[2] < skewness)
}

/// `-gamma / delta` that gives an unbounded curve the skewness.
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
