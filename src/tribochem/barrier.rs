//! Rates over an energy barrier that stress lowers.

use crate::error::InputError;

/// Boltzmann constant \[J/K\].
pub(super) const BOLTZMANN: f64 = 1.380649e-23;

/// One electronvolt \[J\]: activation energies are mostly printed in it.
///
/// ```
/// let barrier = 0.8 * stribeck::tribochem::ELECTRON_VOLT;
/// assert!((barrier * 6.02214076e23 - 77.2e3).abs() < 50.0); // J/mol
/// ```
pub const ELECTRON_VOLT: f64 = 1.602176634e-19;

/// `k = k_0 exp[-max(E - s V, 0) / (k_B T)]`: the form of Bell, ended where the stress `s` has taken the
/// whole barrier away. In the unit of `k_0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Barrier {
    /// Rate without barrier.
    prefactor: f64,
    /// Height of the barrier \[J\].
    energy: f64,
    /// Volume that the stress acts on \[m^3\].
    volume: f64,
}

impl Barrier {
    /// A barrier whose constants are in range.
    pub(super) fn new(prefactor: f64, energy: f64, volume: f64) -> Result<Self, InputError> {
        InputError::require_positive("prefactor", prefactor)?;
        InputError::require_non_negative("activation_energy", energy)?;
        InputError::require_non_negative("activation_volume", volume)?;
        Ok(Self { prefactor, energy, volume })
    }

    /// The same barrier with the prefactor that gives `rate` at `stress` and `temperature`.
    pub(super) fn calibrated(mut self, rate: f64, stress: f64, temperature: f64) -> Result<Self, InputError> {
        InputError::require_positive("rate_constant", rate)?;
        InputError::require_non_negative("reference_stress", stress)?;
        InputError::require_positive("reference_temperature", temperature)?;
        self.prefactor = rate / self.boltzmann_factor(stress, temperature);
        InputError::require_positive("prefactor", self.prefactor)?;
        Ok(self)
    }

    /// Zero for temperatures that are not positive numbers; the sign of the stress does not matter.
    pub(super) fn rate(&self, stress: f64, temperature: f64) -> f64 {
        if temperature.is_finite() && temperature > 0.0 {
            self.prefactor * self.boltzmann_factor(stress, temperature)
        } else {
            0.0
        }
    }

    /// Share of attempts that pass the barrier.
    fn boltzmann_factor(&self, stress: f64, temperature: f64) -> f64 {
        let left = (self.energy - stress.abs() * self.volume).max(0.0);
        (-left / (BOLTZMANN * temperature)).exp()
    }
}
