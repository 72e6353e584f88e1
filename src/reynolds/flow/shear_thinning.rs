//! Viscosity of a sliding Eyring fluid in the flow by pressure.

use crate::error::InputError;

/// Largest Newtonian over Eyring stress that is told apart from larger ones.
const LARGEST: f64 = 1e100;

/// Shear thinning of the flow by pressure, by the sliding of the surfaces.
///
/// Sliding at `u_s` shears a film of thickness `h` by the stress `tau_E asinh(x)`, `x = eta u_s / (h tau_E)`,
/// in place of the Newtonian `eta u_s / h`. The flow by pressure takes the viscosity that is left,
///
/// `eta* = eta asinh(x) / x`,
///
/// in all directions alike. It holds where sliding shears the film far more than the pressure flow does. Of a
/// small change of shear along the sliding direction the resistance is the lower
/// `d tau / d rate = eta / sqrt(1 + x^2)`; that difference of directions is left out. A limiting stress does
/// not enter.
///
/// ```
/// use stribeck::reynolds::ShearThinning;
/// let oil = ShearThinning { eyring_stress: 5e6, sliding_speed: 0.5 };
/// // 10 Pa s over 100 nm: the Newtonian stress would be ten Eyring stresses.
/// assert!((oil.viscosity_ratio(10.0, 1e-7) - 10.0_f64.asinh() / 10.0).abs() < 1e-15);
/// assert!((oil.viscosity_ratio(1e-6, 1e-7) - 1.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearThinning {
    /// Eyring stress `tau_E` \[Pa\].
    pub eyring_stress: f64,
    /// Difference of the surface speeds, not negative \[m/s\]; without any the fluid is Newtonian.
    pub sliding_speed: f64,
}

impl ShearThinning {
    /// Checks the ranges.
    ///
    /// # Errors
    /// A stress that is not finite and positive, a speed that is not finite or negative.
    pub fn validate(&self) -> Result<(), InputError> {
        InputError::require_positive("shear_thinning.eyring_stress", self.eyring_stress)?;
        InputError::require_non_negative("shear_thinning.sliding_speed", self.sliding_speed)
    }

    /// `eta* / eta`, in (0, 1], of a fluid of `viscosity` \[Pa s\] in a film \[m\], both positive.
    pub fn viscosity_ratio(&self, viscosity: f64, film: f64) -> f64 {
        ratio(self.length(viscosity) / film).0
    }

    /// The film in which a fluid of `viscosity` \[Pa s\] has `x = 1` \[m\].
    pub(super) fn length(&self, viscosity: f64) -> f64 {
        viscosity * self.sliding_speed / self.eyring_stress
    }
}

/// `eta* / eta` of one node with its derivatives by pressure and film.
#[derive(Debug, Clone, Copy)]
pub(super) struct ViscosityRatio {
    pub(super) value: f64,
    pub(super) by_pressure: f64,
    pub(super) by_film: f64,
}

impl ViscosityRatio {
    pub(super) const NEWTONIAN: Self = Self { value: 1.0, by_pressure: 0.0, by_film: 0.0 };

    /// The same `factor` times as large.
    pub(super) fn times(self, factor: f64) -> Self {
        Self {
            value: factor * self.value,
            by_pressure: factor * self.by_pressure,
            by_film: factor * self.by_film,
        }
    }

    /// At `x`, of which the logarithmic derivatives are given.
    pub(super) fn new(x: f64, by_pressure: f64, by_film: f64) -> Self {
        let (value, slope) = ratio(x);
        let change = |by: f64| if slope == 0.0 { 0.0 } else { slope * by };
        Self { value, by_pressure: change(by_pressure), by_film: change(by_film) }
    }
}

/// `asinh(x) / x` and `x` times its slope, for `x` from zero on.
fn ratio(x: f64) -> (f64, f64) {
    if x < f64::MIN_POSITIVE {
        return (1.0, 0.0);
    }
    let bounded = x.min(LARGEST);
    let value = bounded.asinh() / bounded;
    (value, if x < LARGEST { 1.0 / x.hypot(1.0) - value } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ratio_is_that_of_asinh_with_its_slope() {
        for x in [1e-300, 1e-9, 1e-3, 0.3, 1.0, 7.0, 1e3, 1e9, 1e90] {
            let (value, slope) = ratio(x);
            assert!(value > 0.0 && value <= 1.0 + f64::EPSILON, "{value} at {x:e}");
            // tau / tau_E = x eta*/eta turned round.
            if (1e-3..1e2).contains(&x) {
                assert!(((value * x).sinh() / x - 1.0).abs() < 1e-12, "{value} at {x:e}");
            }
            let step = 1e-5;
            let difference = (ratio(x * (1.0 + step)).0 - ratio(x * (1.0 - step)).0) / (2.0 * step);
            assert!((difference - slope).abs() < 1e-9, "{difference:e} and {slope:e} at {x:e}");
        }
        assert_eq!(ratio(0.0), (1.0, 0.0));
        assert_eq!(ratio(f64::INFINITY), (ratio(LARGEST).0, 0.0));
    }
}
