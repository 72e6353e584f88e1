//! Thermally activated growth.

use super::barrier::Barrier;
use super::first_order::relax;
use super::{Activation, FilmGrowthLaw};
use crate::error::InputError;
use crate::surface_state::SurfaceState;

/// `dh/dt = k_0 exp[-E / (k_B T)] (h_max - h)` at active nodes: saturating growth at a rate that depends on
/// the temperature alone, including the flash temperature. Exact for any time step.
///
/// Valid where rubbing only exposes the surface. Measured films grow faster under stress (see
/// [`StressActivated`](super::StressActivated)).
///
/// Source of the rate: Arrhenius (1889), Zeitschrift fuer Physikalische Chemie 4, 226-248.
///
/// ```
/// use stribeck::tribochem::{ELECTRON_VOLT, ThermalArrhenius};
/// // The rate of the reference scene's law at 353.15 K.
/// let law = ThermalArrhenius::new(200e-9, 1.0, 0.8 * ELECTRON_VOLT)?.calibrated(1.2215e-3, 353.15)?;
/// assert!((law.rate_constant(353.15) - 1.2215e-3).abs() < 1e-12);
/// assert!((law.rate_constant(373.15) / law.rate_constant(353.15) - 4.1).abs() < 0.1);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ThermalArrhenius {
    /// Limit of growth \[m\].
    maximum: f64,
    /// Energy barrier of growth.
    barrier: Barrier,
    /// Condition for growth.
    activation: Activation,
}

impl ThermalArrhenius {
    /// Law with the growth limit `maximum_thickness` \[m\], the `prefactor` \[1/s\] and the
    /// `activation_energy` \[J\], active in solid contact.
    ///
    /// # Errors
    /// A thickness or prefactor that is not positive, a negative energy, a value not finite.
    pub fn new(maximum_thickness: f64, prefactor: f64, activation_energy: f64) -> Result<Self, InputError> {
        InputError::require_positive("maximum_thickness", maximum_thickness)?;
        let barrier = Barrier::new(prefactor, activation_energy, 0.0)?;
        Ok(Self { maximum: maximum_thickness, barrier, activation: Activation::default() })
    }

    /// The law with the prefactor for which `rate_constant` \[1/s\] holds at `temperature` \[K\].
    ///
    /// # Errors
    /// A value that is not finite and positive.
    pub fn calibrated(self, rate_constant: f64, temperature: f64) -> Result<Self, InputError> {
        Ok(Self { barrier: self.barrier.calibrated(rate_constant, 0.0, temperature)?, ..self })
    }

    /// The law with another activation condition.
    #[must_use]
    pub fn with_activation(mut self, activation: Activation) -> Self {
        self.activation = activation;
        self
    }

    /// Rate constant \[1/s\] at `temperature` \[K\].
    pub fn rate_constant(&self, temperature: f64) -> f64 {
        self.barrier.rate(0.0, temperature)
    }
}

impl FilmGrowthLaw for ThermalArrhenius {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        if self.activation.is_active(at) {
            self.rate_constant(at.temperature) * (self.maximum - thickness)
        } else {
            0.0
        }
    }

    fn maximum_thickness(&self) -> f64 {
        self.maximum
    }

    fn advance(&self, at: &SurfaceState, time_step: f64, states: &mut [f64]) {
        if let [thickness, ..] = states
            && self.activation.is_active(at)
            && time_step > 0.0
        {
            *thickness = relax(*thickness, self.maximum, self.rate_constant(at.temperature), time_step);
        }
    }
}
