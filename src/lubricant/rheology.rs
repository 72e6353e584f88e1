//! Shear stress of the lubricant as a function of viscosity and shear rate.

use super::thinning::Thinning;
use crate::error::InputError;

/// Newtonian, `tau = eta g`, Eyring, `tau = tau_E asinh(eta g / tau_E)`, or Carreau,
/// `tau = eta g [1 + (eta g/G)^2]^((n - 1)/2)`, each with an optional limiting stress, constant or
/// proportional to the pressure. `g` is the shear rate \[1/s\].
///
/// Mineral oils have Eyring stresses of about 5 to 10 MPa and limiting stresses of 5 to 10 % of the pressure.
/// The rheology determines friction and heat; for pressure flow see
/// [`ShearThinning`](crate::reynolds::ShearThinning).
///
/// Sources: Eyring (1936), Journal of Chemical Physics 4, 283-291; Carreau (1972), Transactions of the
/// Society of Rheology 16, 99-127, with the time constant `eta/G`.
///
/// ```
/// use stribeck::lubricant::Rheology;
/// let newtonian = Rheology::newtonian();
/// assert!((newtonian.shear_stress(100.0, 1e6) - 1e8).abs() < 1e-6);
/// let eyring = Rheology::eyring(5e6)?;
/// assert!((eyring.shear_stress(100.0, 1e6) - 5e6 * 20.0_f64.asinh()).abs() < 1e-6);
/// assert!((eyring.shear_stress(1e-3, 1e6) - 1e3).abs() < 1e-3); // thin oil: Newtonian
/// assert!((newtonian.with_limit(2e7)?.shear_stress(100.0, 1e6) - 2e7).abs() < 1e-6);
/// let by_pressure = newtonian.with_limit_by_pressure(0.05)?;
/// assert!((by_pressure.shear_stress_under(1e9, 100.0, 1e6) - 5e7).abs() < 1e-6);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rheology {
    /// Shear-thinning law.
    thinning: Thinning,
    limit: f64,
    /// Limiting stress over pressure.
    share: f64,
}

impl Rheology {
    /// Stress proportional to the shear rate, without limit.
    pub fn newtonian() -> Self {
        Self::thinned(Thinning::None)
    }

    /// Shear thinning with the Eyring stress `stress` \[Pa\], without limit.
    ///
    /// # Errors
    /// A stress that is not finite and positive.
    pub fn eyring(stress: f64) -> Result<Self, InputError> {
        InputError::require_positive("friction.eyring_stress", stress)?;
        Ok(Self::thinned(Thinning::Eyring { stress }))
    }

    /// Carreau shear thinning with the onset stress `stress` \[Pa\] and the exponent `n`, without limit.
    ///
    /// ```
    /// use stribeck::lubricant::Rheology;
    /// let oil = Rheology::carreau(5e6, 0.4)?;
    /// assert!((oil.shear_stress(1e-3, 1e6) - 1e3).abs() < 1e-3); // thin oil: Newtonian
    /// assert!((oil.shear_stress(1e5, 1e6) / (5e6 * 2e4_f64.powf(0.4)) - 1.0).abs() < 1e-6); // far above the onset: a power law
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    ///
    /// # Errors
    /// A stress that is not finite and positive, an exponent not above zero or above one.
    pub fn carreau(stress: f64, exponent: f64) -> Result<Self, InputError> {
        InputError::require_positive("friction.carreau_stress", stress)?;
        let inside = 0.0 < exponent && exponent <= 1.0;
        InputError::require(inside, "friction.carreau_exponent", exponent, "above 0 and at most 1")?;
        Ok(Self::thinned(Thinning::Carreau { stress, exponent }))
    }

    /// A fluid without a limiting stress.
    fn thinned(thinning: Thinning) -> Self {
        Self { thinning, limit: f64::INFINITY, share: f64::INFINITY }
    }

    /// The same fluid with a limiting shear stress of `share` times the pressure.
    ///
    /// # Errors
    /// A share that is not finite and positive.
    pub fn with_limit_by_pressure(self, share: f64) -> Result<Self, InputError> {
        InputError::require_positive("friction.limiting_stress_coefficient", share)?;
        Ok(Self { share, ..self })
    }

    /// The same fluid with a limiting shear stress `limit` \[Pa\].
    ///
    /// # Errors
    /// A stress that is not finite and positive.
    pub fn with_limit(self, limit: f64) -> Result<Self, InputError> {
        InputError::require_positive("friction.limiting_shear_stress", limit)?;
        Ok(Self { limit, ..self })
    }

    /// Limiting shear stress \[Pa\] under `pressure` \[Pa\].
    pub fn limit(&self, pressure: f64) -> f64 {
        if self.share.is_finite() { self.limit.min(self.share * pressure.max(0.0)) } else { self.limit }
    }

    /// Shear stress \[Pa\] of a fluid of `viscosity` \[Pa s\] at `shear_rate` \[1/s\], both non-negative,
    /// without a pressure-dependent limit; [`shear_stress_under`](Self::shear_stress_under) includes it.
    pub fn shear_stress(&self, viscosity: f64, shear_rate: f64) -> f64 {
        self.thinning.stress(viscosity * shear_rate).min(self.limit)
    }

    /// Shear stress \[Pa\] under `pressure` \[Pa\], at most the limiting stress.
    pub fn shear_stress_under(&self, pressure: f64, viscosity: f64, shear_rate: f64) -> f64 {
        self.thinning.stress(viscosity * shear_rate).min(self.limit(pressure))
    }

    /// The law without its limit.
    pub(crate) fn thinning(&self) -> Thinning {
        self.thinning
    }
}
