//! Stress-activated growth with removal proportional to the film.

use super::barrier::Barrier;
use super::first_order::relax;
use super::{Activation, FilmGrowthLaw};
use crate::error::InputError;
use crate::surface_state::SurfaceState;

/// `dh/dt = G exp[-(E - tau V) / (k_B T)] - a h` at active nodes: growth activated by the shear stress `tau`,
/// independent of the film, and removal proportional to the film, as thick films are softer at the top. The
/// film approaches the equilibrium, at most its maximum thickness. Exact for any time step.
///
/// Source: form of Akchurin and Bosman (2017), Tribology Letters 65, doi 10.1007/s11249-017-0842-8. The
/// constants are for the user to provide; they were fitted for each experiment.
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::tribochem::{FilmGrowthLaw, ProportionalRemoval};
/// // 0.2 nm/s at any stress and 2e-3 1/s: 100 nm in equilibrium.
/// let law = ProportionalRemoval::new(200e-9, 0.2e-9, 0.0, 0.0, 2e-3)?;
/// let at = SurfaceState::new(1e9, 353.15).with_solid_pressure(1e9)
///     .with_shear_stress(1e8).with_sliding_speed(0.005).with_in_contact(true);
/// let mut states = [0.0];
/// law.advance(&at, 500.0, &mut states);
/// assert!((states[0] - 100e-9 * (1.0 - (-1.0_f64).exp())).abs() < 1e-18);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ProportionalRemoval {
    /// Largest thickness \[m\].
    maximum: f64,
    /// Energy barrier of growth.
    barrier: Barrier,
    /// Rate of removal \[1/s\].
    removal_rate: f64,
    /// Condition for growth.
    activation: Activation,
}

impl ProportionalRemoval {
    /// Law with the largest film `maximum_thickness` \[m\], the `growth_rate` G \[m/s\] without barrier, the
    /// `activation_energy` E \[J\], the `shear_activation_volume` V \[m^3\] and the `removal_rate` a \[1/s\].
    /// Every sheared node is active.
    ///
    /// # Errors
    /// A thickness or growth rate that is not positive, another constant that is negative, a value not
    /// finite.
    pub fn new(
        maximum_thickness: f64,
        growth_rate: f64,
        activation_energy: f64,
        shear_activation_volume: f64,
        removal_rate: f64,
    ) -> Result<Self, InputError> {
        InputError::require_positive("maximum_thickness", maximum_thickness)?;
        InputError::require_positive("growth_rate", growth_rate)?;
        InputError::require_non_negative("removal_rate", removal_rate)?;
        let barrier = Barrier::new(growth_rate, activation_energy, shear_activation_volume)?;
        Ok(Self { maximum: maximum_thickness, barrier, removal_rate, activation: Activation::ShearStress })
    }

    /// The law with another activation condition.
    #[must_use]
    pub fn with_activation(mut self, activation: Activation) -> Self {
        self.activation = activation;
        self
    }

    /// Growth rate at a node without removal \[m/s\].
    fn growth(&self, at: &SurfaceState) -> f64 {
        self.barrier.rate(at.shear_stress, at.temperature)
    }
}

impl FilmGrowthLaw for ProportionalRemoval {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        if !self.activation.is_active(at) {
            return 0.0;
        }
        let net = self.growth(at) - self.removal_rate * thickness;
        if thickness < self.maximum { net } else { net.min(0.0) }
    }

    fn maximum_thickness(&self) -> f64 {
        self.maximum
    }

    fn advance(&self, at: &SurfaceState, time_step: f64, states: &mut [f64]) {
        let [thickness, ..] = states else { return };
        if !(self.activation.is_active(at) && time_step > 0.0) {
            return;
        }
        let growth = self.growth(at);
        let balance = growth / self.removal_rate;
        // The linear limit, far below the equilibrium or without removal.
        let next = if balance.is_finite() && self.removal_rate * time_step > 1e-12 {
            relax(*thickness, balance, self.removal_rate, time_step)
        } else {
            *thickness + growth * time_step
        };
        *thickness = next.min(self.maximum.max(*thickness));
    }
}
