//! Shear stress of the lubricant as a function of its viscosity and shear rate.

use crate::error::InputError;

/// Newtonian, `tau = eta g`, or of Eyring, `tau = tau_E asinh(eta g / tau_E)`, and in both cases at most a limiting
/// stress. `g` is the shear rate \[1/s\].
///
/// Mineral oils have Eyring stresses of some 5 to 10 MPa and limiting stresses of 5 to 10 % of the pressure. Isothermal.
/// Here it decides friction and heat; of the flow by pressure see [`ShearThinning`](crate::reynolds::ShearThinning).
///
/// Source: Eyring (1936), Journal of Chemical Physics 4, 283-291.
///
/// ```
/// use stribeck::lubricant::Rheology;
/// let newtonian = Rheology::newtonian();
/// assert!((newtonian.shear_stress(100.0, 1e6) - 1e8).abs() < 1e-6);
/// let eyring = Rheology::eyring(5e6)?;
/// assert!((eyring.shear_stress(100.0, 1e6) - 5e6 * 20.0_f64.asinh()).abs() < 1e-6);
/// assert!((eyring.shear_stress(1e-3, 1e6) - 1e3).abs() < 1e-3); // thin oil: Newtonian
/// assert!((newtonian.with_limit(2e7)?.shear_stress(100.0, 1e6) - 2e7).abs() < 1e-6);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rheology {
    eyring_stress: f64,
    limit: f64,
}

impl Rheology {
    /// Stress in proportion to the shear rate, without limit.
    pub fn newtonian() -> Self {
        Self { eyring_stress: f64::INFINITY, limit: f64::INFINITY }
    }

    /// Shear thinning with the Eyring stress `stress` \[Pa\], without limit.
    ///
    /// # Errors
    /// A stress that is not finite and positive.
    pub fn eyring(stress: f64) -> Result<Self, InputError> {
        InputError::require_positive("friction.eyring_stress", stress)?;
        Ok(Self { eyring_stress: stress, limit: f64::INFINITY })
    }

    /// The same fluid with a largest shear stress `limit` \[Pa\].
    ///
    /// # Errors
    /// A stress that is not finite and positive.
    pub fn with_limit(self, limit: f64) -> Result<Self, InputError> {
        InputError::require_positive("friction.limiting_shear_stress", limit)?;
        Ok(Self { limit, ..self })
    }

    /// Shear stress \[Pa\] of a fluid of `viscosity` \[Pa s\] at `shear_rate` \[1/s\], both not negative.
    pub fn shear_stress(&self, viscosity: f64, shear_rate: f64) -> f64 {
        let newtonian = viscosity * shear_rate;
        let stress = if self.eyring_stress.is_finite() {
            self.eyring_stress * (newtonian / self.eyring_stress).asinh()
        } else {
            newtonian
        };
        stress.min(self.limit)
    }
}
