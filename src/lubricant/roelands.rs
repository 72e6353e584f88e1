//! The Roelands law.

use super::ViscosityLaw;
use crate::error::InputError;

/// `eta = eta_0 exp{(ln eta_0 + 9.67) [(1 + p/p_0)^z - 1]}` with `eta_0` in Pa s.
///
/// The slope at ambient pressure is `alpha = z (ln eta_0 + 9.67) / p_0`. Valid up to about 1 GPa; above it
/// the exponent is capped at [`Roelands::MAX_EXPONENT`], so that asperity pressures do not overflow.
///
/// Source: Roelands, C.J.A. (1966), Correlational aspects of the viscosity-temperature-pressure
/// relationship of lubricating oils, thesis, Delft.
///
/// ```
/// use stribeck::lubricant::{Roelands, ViscosityLaw};
/// let oil = Roelands::new(0.004, 0.68, 1.96e8)?;
/// assert!((oil.viscosity(0.0) - 0.004).abs() < 1e-15);
/// assert!((oil.viscosity(1.15e9) - 300.0).abs() < 10.0);
/// assert!((oil.log_slope(0.0) - 14.39e-9).abs() < 0.01e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Roelands {
    /// Viscosity at ambient pressure \[Pa s\].
    eta0: f64,
    /// `ln eta_0 + 9.67`, or `alpha p_0 / z` for a given slope.
    exponent: f64,
    /// Index `z`.
    z: f64,
    /// Reference pressure \[Pa\].
    p0: f64,
}

impl Roelands {
    /// Largest exponent: a factor of 7e10 in viscosity, which blocks pressure flow.
    pub const MAX_EXPONENT: f64 = 25.0;

    /// Law with viscosity `eta0` \[Pa s\] at ambient pressure, index `z` and reference pressure `p0` \[Pa\]
    /// (1.96e8 in the usual form).
    ///
    /// # Errors
    /// `eta0` not above `exp(-9.67)` = 63 uPa s (the law would thin under pressure), `z` or `p0` not
    /// positive, or a value that is not finite.
    pub fn new(eta0: f64, z: f64, p0: f64) -> Result<Self, InputError> {
        InputError::require(
            eta0.is_finite() && eta0 > (-9.67_f64).exp(),
            "lubricant.eta0",
            eta0,
            "finite and above exp(-9.67) = 6.3e-5 Pa s, below which the Roelands law is not defined",
        )?;
        InputError::require_positive("lubricant.roelands_z", z)?;
        InputError::require_positive("lubricant.roelands_p0", p0)?;
        Ok(Self { eta0, exponent: eta0.ln() + 9.67, z, p0 })
    }

    /// Law with a given slope `alpha` \[1/Pa\] at ambient pressure, `z` and `p0`:
    /// `eta = eta_0 exp{(alpha p_0 / z) [(1 + p/p_0)^z - 1]}`.
    ///
    /// # Errors
    /// A parameter that is not finite and positive.
    pub fn from_alpha(eta0: f64, alpha: f64, z: f64, p0: f64) -> Result<Self, InputError> {
        for (field, value) in [
            ("lubricant.eta0", eta0),
            ("lubricant.alpha", alpha),
            ("lubricant.roelands_z", z),
            ("lubricant.roelands_p0", p0),
        ] {
            InputError::require_positive(field, value)?;
        }
        Ok(Self { eta0, exponent: alpha * p0 / z, z, p0 })
    }

    /// The viscosity `eta0` \[Pa s\] at all pressures.
    ///
    /// # Errors
    /// `eta0` or `p0` not finite and positive.
    pub(super) fn isoviscous(eta0: f64, p0: f64) -> Result<Self, InputError> {
        InputError::require_positive("lubricant.eta0", eta0)?;
        InputError::require_positive("lubricant.roelands_p0", p0)?;
        Ok(Self { eta0, exponent: 0.0, z: 1.0, p0 })
    }

    /// The law `eta_0 exp{E [f (1 + p/p_0)^z - 1]}`; `f = 1` is this law.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let eta0 = self.eta0 * (self.exponent * (factor - 1.0)).min(Self::MAX_EXPONENT).exp();
        Self { eta0, exponent: self.exponent * factor, ..self.clone() }
    }
}

impl ViscosityLaw for Roelands {
    fn viscosity(&self, pressure: f64) -> f64 {
        let growth = (self.z * (pressure.max(0.0) / self.p0).ln_1p()).exp() - 1.0;
        self.eta0 * (self.exponent * growth).min(Self::MAX_EXPONENT).exp()
    }

    fn log_slope(&self, pressure: f64) -> f64 {
        let base = 1.0 + pressure.max(0.0) / self.p0;
        let power = base.powf(self.z);
        if self.exponent * (power - 1.0) < Self::MAX_EXPONENT {
            self.exponent * self.z * power / (base * self.p0)
        } else {
            0.0
        }
    }
}
