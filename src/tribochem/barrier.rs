//! Rates over an energy barrier that is lowered by stress.

use crate::error::InputError;

/// Boltzmann constant \[J/K\].
pub(super) const BOLTZMANN: f64 = 1.380649e-23;

/// One electronvolt \[J\], the usual unit of activation energies.
///
/// ```
/// let barrier = 0.8 * stribeck::tribochem::ELECTRON_VOLT;
/// assert!((barrier * 6.02214076e23 - 77.2e3).abs() < 50.0); // J/mol
/// ```
pub const ELECTRON_VOLT: f64 = 1.602176634e-19;

/// `k = k_0 exp[-max(E - s V, 0) / (k_B T)]`: the Bell model, limited to barriers that are not negative. In
/// the unit of `k_0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Barrier {
    /// Rate without barrier.
    prefactor: f64,
    /// Height of the barrier \[J\].
    energy: f64,
    /// Activation volume \[m^3\].
    volume: f64,
}

impl Barrier {
    /// A barrier; rejects constants out of range.
    pub(super) fn new(prefactor: f64, energy: f64, volume: f64) -> Result<Self, InputError> {
        InputError::require_positive("prefactor", prefactor)?;
        InputError::require_non_negative("activation_energy", energy)?;
        InputError::require_non_negative("activation_volume", volume)?;
        Ok(Self { prefactor, energy, volume })
    }

    /// The barrier with the prefactor for which `rate` holds at `stress` and `temperature`.
    pub(super) fn calibrated(mut self, rate: f64, stress: f64, temperature: f64) -> Result<Self, InputError> {
        InputError::require_positive("rate_constant", rate)?;
        InputError::require_non_negative("reference_stress", stress)?;
        InputError::require_positive("reference_temperature", temperature)?;
        self.prefactor = rate / self.boltzmann_factor(stress, temperature);
        InputError::require_positive("prefactor", self.prefactor)?;
        Ok(self)
    }

    /// Zero for a temperature that is not positive or NaN; the sign of the stress is ignored.
    pub(super) fn rate(&self, stress: f64, temperature: f64) -> f64 {
        if temperature.is_finite() && temperature > 0.0 {
            self.prefactor * self.boltzmann_factor(stress, temperature)
        } else {
            0.0
        }
    }

    /// Boltzmann factor of the lowered barrier.
    fn boltzmann_factor(&self, stress: f64, temperature: f64) -> f64 {
        let left = (self.energy - stress.abs() * self.volume).max(0.0);
        (-left / (BOLTZMANN * temperature)).exp()
    }
}
