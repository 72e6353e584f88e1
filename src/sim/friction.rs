//! Shear in a solved contact: boundary friction under the solid pressure, shear of the fluid under its own.

use super::contact::ContactModel;
use super::scene::Scene;
use crate::error::InputError;
use crate::lubricant::Rheology;
use crate::metrics;
use crate::reynolds::ContactState;

/// Friction fields of one solved contact. A node in contact that also carries fluid pressure has both shares, each by
/// its own pressure.
#[derive(Debug)]
pub(super) struct FrictionFields {
    boundary: f64,
    rheology: Rheology,
    sliding: f64,
    /// Pressure that solid contact carries \[Pa\].
    pub(super) solid: Vec<f64>,
    viscosity: Vec<f64>,
    /// Shear stress of the fluid \[Pa\].
    pub(super) shear: Vec<f64>,
}

impl FrictionFields {
    pub(super) fn new(scene: &Scene, n: usize) -> Result<Self, InputError> {
        let zeros = || vec![0.0; n];
        Ok(Self {
            boundary: scene.friction.boundary_coefficient,
            rheology: scene.friction.rheology()?,
            sliding: scene.motion.sliding_speed(),
            solid: zeros(),
            viscosity: zeros(),
            shear: zeros(),
        })
    }

    /// Overwrites the fields with those of `state`.
    pub(super) fn update(&mut self, contact: &ContactModel, state: &ContactState) -> Result<(), InputError> {
        for (k, solid) in self.solid.iter_mut().enumerate() {
            *solid = state.solid_pressure(k);
        }
        match &contact.lubricant {
            None => self.shear.fill(0.0),
            Some(lubricant) => {
                lubricant.viscosity().fill(&state.fluid_pressure, &mut self.viscosity);
                let (viscosity, film) = (&self.viscosity, &state.film);
                metrics::viscous_shear_into(viscosity, film, self.sliding, &self.rheology, &mut self.shear)?;
            }
        }
        Ok(())
    }

    /// Shear stress on the surfaces at node `k` \[Pa\]; none without sliding.
    pub(super) fn stress(&self, k: usize) -> f64 {
        if self.sliding > 0.0 { self.boundary * self.solid[k] + self.shear[k] } else { 0.0 }
    }

    /// Heat of friction at node `k` \[W/m^2\].
    pub(super) fn heat(&self, k: usize) -> f64 {
        self.stress(k) * self.sliding
    }

    /// Friction coefficient of solid contact; zero without sliding.
    pub(super) fn boundary(&self) -> f64 {
        if self.sliding > 0.0 { self.boundary } else { 0.0 }
    }

    /// Friction force over load; zero without sliding.
    pub(super) fn coefficient(&self, contact: &ContactModel) -> Result<f64, InputError> {
        metrics::friction_coefficient(
            &contact.grid,
            self.boundary(),
            &self.solid,
            &self.shear,
            contact.hertz.load,
        )
    }
}
