//! The Barus law.

use super::ViscosityLaw;
use crate::error::InputError;

/// `eta = eta_0 exp(alpha p)`. Realistic up to about 0.3 GPa; at higher pressure it overestimates the
/// viscosity by orders of magnitude. The exponent is capped at [`Barus::MAX_EXPONENT`], so the result stays
/// finite.
///
/// Source: Barus, C. (1893), American Journal of Science 45, 87-96.
///
/// ```
/// use stribeck::lubricant::{Barus, ViscosityLaw};
/// let oil = Barus::new(0.04, 2.2e-8)?;
/// assert!((oil.viscosity(1e8) - 0.04 * 2.2_f64.exp()).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Barus {
    /// Viscosity at ambient pressure \[Pa s\].
    eta0: f64,
    /// Pressure-viscosity coefficient \[1/Pa\].
    alpha: f64,
}

impl Barus {
    /// Largest exponent; beyond it a film is solid on any relevant time scale.
    pub const MAX_EXPONENT: f64 = 46.0;

    /// Law with viscosity `eta0` \[Pa s\] at ambient pressure and coefficient `alpha` \[1/Pa\].
    ///
    /// # Errors
    /// `eta0` not positive, `alpha` negative, or one of them not finite.
    pub fn new(eta0: f64, alpha: f64) -> Result<Self, InputError> {
        InputError::require_positive("eta0", eta0)?;
        InputError::require_non_negative("alpha", alpha)?;
        Ok(Self { eta0, alpha })
    }
}

impl ViscosityLaw for Barus {
    fn viscosity(&self, pressure: f64) -> f64 {
        self.eta0 * (self.alpha * pressure.max(0.0)).min(Self::MAX_EXPONENT).exp()
    }

    fn log_slope(&self, pressure: f64) -> f64 {
        if self.alpha * pressure < Self::MAX_EXPONENT { self.alpha } else { 0.0 }
    }
}
