//! Stress-activated growth.

use super::barrier::Barrier;
use super::first_order::relax;
use super::{Activation, FilmGrowthLaw};
use crate::error::InputError;
use crate::surface_state::SurfaceState;

/// `dh/dt = k_0 exp[-(E - s V) / (k_B T)] (h_max - h)` at active nodes, the Bell model: a stress `s` on the
/// activation volume `V` lowers the barrier `E`, down to zero. Exact for any time step.
///
/// The constructor selects the stress, since an activation volume belongs to the stress of its fit. Shear
/// stresses in contacts are a tenth of the pressures, and published volumes differ accordingly: about 0.1
/// nm^3 for [shear](Self::by_shear_stress) and 0.004 nm^3 for [normal stress](Self::by_normal_stress).
///
/// Sources: form: Bell (1978), Science 200, 618-627; film growth under normal stress: Gosvami and co-workers
/// (2015), Science 348, 102-106; under shear stress: Zhang and Spikes (2016), Tribology Letters 63.
///
/// ```
/// use stribeck::tribochem::{ELECTRON_VOLT, StressActivated};
/// let law = StressActivated::by_shear_stress(200e-9, 1.0, 0.8 * ELECTRON_VOLT, 0.13e-27)?
///     .calibrated(1.2215e-3, 0.115 * 1.15e9, 353.15)?;
/// assert!((law.rate_constant(0.115 * 1.15e9, 353.15) - 1.2215e-3).abs() < 1e-12);
/// // The shear stress lowers the barrier by 0.107 eV, a factor of 34.
/// assert!((law.rate_constant(0.115 * 1.15e9, 353.15) / law.rate_constant(0.0, 353.15) - 34.0).abs() < 1.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct StressActivated {
    /// Limit of growth \[m\].
    maximum: f64,
    /// Energy barrier of growth.
    barrier: Barrier,
    /// Stress that lowers the barrier.
    stress: Stress,
    /// Condition for growth.
    activation: Activation,
}

/// Stress that lowers the barrier.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stress {
    Shear,
    Normal,
}

impl StressActivated {
    /// Law activated by the total shear stress of the node, of solid contact and fluid: growth limit
    /// `maximum_thickness` \[m\], `prefactor` \[1/s\], `activation_energy` \[J\], `shear_activation_volume`
    /// \[m^3\]. Every sheared node is active, in solid contact or not.
    ///
    /// # Errors
    /// A thickness or prefactor that is not positive, a negative energy or volume, a value not finite.
    pub fn by_shear_stress(
        maximum_thickness: f64,
        prefactor: f64,
        activation_energy: f64,
        shear_activation_volume: f64,
    ) -> Result<Self, InputError> {
        InputError::require_positive("maximum_thickness", maximum_thickness)?;
        let barrier = Barrier::new(prefactor, activation_energy, shear_activation_volume)?;
        Ok(Self {
            maximum: maximum_thickness,
            barrier,
            stress: Stress::Shear,
            activation: Activation::ShearStress,
        })
    }

    /// Law activated by the pressure of the node: growth limit `maximum_thickness` \[m\], `prefactor`
    /// \[1/s\], `activation_energy` \[J\], `normal_activation_volume` \[m^3\]; active in solid contact.
    ///
    /// # Errors
    /// The errors of [`by_shear_stress`](Self::by_shear_stress).
    pub fn by_normal_stress(
        maximum_thickness: f64,
        prefactor: f64,
        activation_energy: f64,
        normal_activation_volume: f64,
    ) -> Result<Self, InputError> {
        InputError::require_positive("maximum_thickness", maximum_thickness)?;
        let barrier = Barrier::new(prefactor, activation_energy, normal_activation_volume)?;
        Ok(Self {
            maximum: maximum_thickness,
            barrier,
            stress: Stress::Normal,
            activation: Activation::SolidContact,
        })
    }

    /// The law with the prefactor for which `rate_constant` \[1/s\] holds at `stress` \[Pa\] (the activating
    /// one) and `temperature` \[K\].
    ///
    /// # Errors
    /// A rate constant or temperature that is not positive, a negative stress, a value not finite.
    pub fn calibrated(self, rate_constant: f64, stress: f64, temperature: f64) -> Result<Self, InputError> {
        Ok(Self { barrier: self.barrier.calibrated(rate_constant, stress, temperature)?, ..self })
    }

    /// The law with another activation condition.
    #[must_use]
    pub fn with_activation(mut self, activation: Activation) -> Self {
        self.activation = activation;
        self
    }

    /// Rate constant \[1/s\] at `stress` \[Pa\] (the activating one) and `temperature` \[K\].
    pub fn rate_constant(&self, stress: f64, temperature: f64) -> f64 {
        self.barrier.rate(stress, temperature)
    }

    /// Rate constant at a node, by its activating stress.
    fn rate_constant_at(&self, at: &SurfaceState) -> f64 {
        let stress = match self.stress {
            Stress::Shear => at.shear_stress,
            Stress::Normal => at.pressure,
        };
        self.rate_constant(stress, at.temperature)
    }
}

impl FilmGrowthLaw for StressActivated {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        if self.activation.is_active(at) {
            self.rate_constant_at(at) * (self.maximum - thickness)
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
            *thickness = relax(*thickness, self.maximum, self.rate_constant_at(at), time_step);
        }
    }
}
