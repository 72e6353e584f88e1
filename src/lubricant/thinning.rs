//! Shear thinning: stress by shear rate, and the secant and tangent viscosities.

/// Shear stress as a function of the rate `g`, in terms of `x = eta g / S`, the Newtonian stress over the
/// onset stress of thinning.
///
/// | law | stress | secant `tau/(eta g)` | tangent `(1/eta) d tau/dg` | range |
/// |---|---|---|---|---|
/// | none | `eta g` | 1 | 1 | |
/// | Eyring | `S asinh(x)` | `asinh(x)/x` | `(1 + x^2)^(-1/2)` | `S > 0` |
/// | Carreau | `S x (1 + x^2)^m` | `(1 + x^2)^m` | `(1 + x^2)^(m - 1) (1 + n x^2)` | `S > 0`, `0 < n <= 1` |
///
/// with `m = (n - 1)/2`. Tangents are at most equal to the secants, and both are at most one.
///
/// Sources: Eyring (1936), Journal of Chemical Physics 4, 283-291; Carreau (1972), Transactions of the
/// Society of Rheology 16, 99-127, with the time constant `eta/S`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Thinning {
    None,
    Eyring { stress: f64 },
    Carreau { stress: f64, exponent: f64 },
}

/// Upper bound of `x`, against overflow.
const LARGEST: f64 = 1e100;

impl Thinning {
    /// Onset stress `S` of thinning \[Pa\]; infinite for a Newtonian fluid.
    pub(crate) fn onset(self) -> f64 {
        match self {
            Self::None => f64::INFINITY,
            Self::Eyring { stress } | Self::Carreau { stress, .. } => stress,
        }
    }

    /// Shear stress \[Pa\] by the non-negative Newtonian one.
    pub(crate) fn stress(self, newtonian: f64) -> f64 {
        match self {
            Self::None => newtonian,
            Self::Eyring { stress } => stress * (newtonian / stress).asinh(),
            Self::Carreau { stress, exponent } => newtonian * carreau(newtonian / stress, exponent),
        }
    }

    /// The secant and `x` times its slope, for `x >= 0`.
    pub(crate) fn secant(self, x: f64) -> (f64, f64) {
        if x < f64::MIN_POSITIVE {
            return (1.0, 0.0);
        }
        let bounded = x.min(LARGEST);
        let value = match self {
            Self::None => 1.0,
            Self::Eyring { .. } => bounded.asinh() / bounded,
            Self::Carreau { exponent, .. } => carreau(bounded, exponent),
        };
        // The derivative of x times the secant is the tangent.
        (value, if x < LARGEST { self.tangent(x).0 - value } else { 0.0 })
    }

    /// The tangent and `x` times its slope, for `x >= 0`.
    pub(crate) fn tangent(self, x: f64) -> (f64, f64) {
        let bounded = x.min(LARGEST);
        let square = bounded * bounded;
        let share = square / (1.0 + square);
        let (value, logarithmic) = match self {
            Self::None => (1.0, 0.0),
            Self::Eyring { .. } => (1.0 / bounded.hypot(1.0), -share),
            Self::Carreau { exponent, .. } => {
                let value = carreau(bounded, exponent) * (1.0 + (exponent - 1.0) * share);
                let rise = 2.0 * exponent * square / (1.0 + exponent * square);
                (value, (exponent - 3.0) * share + rise)
            }
        };
        (value, if x < LARGEST { value * logarithmic } else { 0.0 })
    }
}

/// `(1 + x^2)^((n - 1)/2)`.
fn carreau(x: f64, exponent: f64) -> f64 {
    (0.5 * (exponent - 1.0) * (x * x).ln_1p()).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laws() -> impl Iterator<Item = Thinning> {
        let carreau = |exponent| Thinning::Carreau { stress: 5e6, exponent };
        let exponents = [0.05, 1.0 / 3.0, 0.6, 1.0].map(carreau);
        [Thinning::None, Thinning::Eyring { stress: 5e6 }].into_iter().chain(exponents)
    }

    #[test]
    fn secant_and_tangent_match_the_stress_and_their_slopes() {
        for law in laws() {
            for x in [1e-300, 1e-9, 1e-3, 0.3, 1.0, 7.0, 1e3, 1e9, 1e90] {
                let ((secant, slope), (tangent, tangent_slope)) = (law.secant(x), law.tangent(x));
                assert!(0.0 < tangent && tangent <= secant * (1.0 + 1e-15), "{law:?} at {x:e}");
                assert!(secant <= 1.0, "{law:?} at {x:e}: {secant}");
                let newtonian = 5e6 * x;
                assert!((law.stress(newtonian) / newtonian / secant - 1.0).abs() < 1e-12, "{law:?} at {x:e}");
                let step = 1e-5;
                let change = |value: &dyn Fn(f64) -> f64| {
                    (value(x * (1.0 + step)) - value(x * (1.0 - step))) / (2.0 * step)
                };
                let by_rate = change(&|x| law.stress(5e6 * x)) / newtonian;
                assert!((by_rate / tangent - 1.0).abs() < 1e-6, "{law:?} at {x:e}: {by_rate}, {tangent}");
                let differences = [change(&|x| law.secant(x).0), change(&|x| law.tangent(x).0)];
                for (difference, exact) in differences.into_iter().zip([slope, tangent_slope]) {
                    assert!((difference - exact).abs() < 1e-9, "{law:?} at {x:e}: {difference:e}, {exact:e}");
                }
            }
        }
    }

    #[test]
    fn slow_shear_and_an_exponent_of_one_are_newtonian() {
        for law in laws() {
            assert_eq!((law.secant(0.0), law.tangent(0.0)), ((1.0, 0.0), (1.0, 0.0)), "{law:?}");
            for x in [1e-300, 1e-12, 1e-7] {
                assert!((law.secant(x).0 - 1.0).abs() < 1e-13, "{law:?} at {x:e}");
                assert!((law.tangent(x).0 - 1.0).abs() < 1e-13, "{law:?} at {x:e}");
            }
        }
        let linear = Thinning::Carreau { stress: 5e6, exponent: 1.0 };
        for x in [1e-9, 0.3, 7.0, 1e9, f64::INFINITY] {
            assert_eq!((linear.secant(x), linear.tangent(x)), ((1.0, 0.0), (1.0, 0.0)), "at {x:e}");
        }
    }

    /// A Carreau fluid far above the onset follows a power law, where the tangent is `n` times the secant.
    #[test]
    fn fast_shear_follows_a_power_law() {
        for exponent in [0.05, 0.4, 0.9] {
            let law = Thinning::Carreau { stress: 5e6, exponent };
            let (secant, tangent) = (law.secant(1e9).0, law.tangent(1e9).0);
            assert!((secant / 1e9_f64.powf(exponent - 1.0) - 1.0).abs() < 1e-12, "{secant:e}");
            assert!((tangent / secant / exponent - 1.0).abs() < 1e-12, "{tangent:e} and {secant:e}");
        }
        for law in laws() {
            assert_eq!(law.secant(f64::INFINITY), (law.secant(LARGEST).0, 0.0));
            assert_eq!(law.tangent(f64::INFINITY), (law.tangent(LARGEST).0, 0.0));
        }
    }

    /// `x` times the slope of the logarithm stays above -1 for all fluids except the tangent of Carreau
    /// fluids with `n` below a third.
    #[test]
    fn viscosity_times_rate_increases_with_the_rate() {
        let steepest = |law: Thinning, along: bool| {
            let at = |x: f64| if along { law.tangent(x) } else { law.secant(x) };
            let points = (-400..=400).map(|k| at(10.0_f64.powf(f64::from(k) / 50.0)));
            points.map(|(value, slope)| slope / value).fold(0.0, f64::min)
        };
        for law in laws() {
            assert!(steepest(law, false) >= -1.0, "{law:?}");
            let is_steep = matches!(law, Thinning::Carreau { exponent, .. } if exponent < 0.33);
            assert_eq!(steepest(law, true) < -1.0 - 1e-12, is_steep, "{law:?}");
        }
    }
}
