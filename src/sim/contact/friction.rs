//! Shear stresses of a solved contact: boundary friction under the solid pressure, shear of the fluid.
//!
//! At a node in solid contact the boundary law gives the friction coefficient of the solid pressure. The shear stress of
//! the fluid follows from its rheology at the rate `sliding/film` and the viscosity at its pressure, bounded by the
//! limiting stress. It is multiplied by the film fraction `theta`, as gas carries no shear. Both stresses act on both
//! surfaces; their power `stress * sliding` is the frictional heat.

use crate::boundary_friction::BoundaryFriction;
use crate::error::InputError;
use crate::lubricant::Rheology;
use crate::metrics;
use crate::reynolds::ContactState;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::numbers::FrictionNumbers;
use crate::sim::scene::Scene;

/// Friction fields of a solved contact. A node in contact with fluid pressure has both stresses, each from its own
/// pressure.
#[derive(Debug, Clone)]
pub(in crate::sim) struct FrictionFields {
    /// Shear stress law of the fluid.
    rheology: Rheology,
    /// Sliding speed, non-negative \[m/s\].
    sliding: f64,
    /// Solid pressure \[Pa\].
    pub(in crate::sim) solid: Vec<f64>,
    /// Friction coefficient of solid contact.
    boundary: Vec<f64>,
    /// Viscosity at the fluid pressure \[Pa s\].
    viscosity: Vec<f64>,
    /// Shear stress of the fluid \[Pa\].
    pub(in crate::sim) shear: Vec<f64>,
}

impl FrictionFields {
    /// Fields of zeros for `n` nodes with the rheology of the scene.
    pub(in crate::sim) fn new(scene: &Scene, n: usize) -> Result<Self, InputError> {
        let zeros = || vec![0.0; n];
        Ok(Self {
            rheology: scene.friction.rheology()?,
            sliding: 0.0,
            solid: zeros(),
            boundary: zeros(),
            viscosity: zeros(),
            shear: zeros(),
        })
    }

    /// Computes the fields of `state` between bodies with the tribofilms `films` \[m\].
    pub(in crate::sim) fn update(
        &mut self,
        contact: &ContactModel,
        state: &ContactState,
        law: &dyn BoundaryFriction,
        films: &[Vec<f64>; 2],
    ) -> Result<(), InputError> {
        self.sliding = contact.motion.sliding_speed();
        for (k, solid) in self.solid.iter_mut().enumerate() {
            *solid = state.solid_pressure(k);
        }
        let [ball, disc] = films;
        law.coefficients(&self.solid, self.sliding, [ball, disc], &mut self.boundary);
        for &coefficient in &self.boundary {
            InputError::require_non_negative("boundary friction of the law", coefficient)?;
        }
        match &contact.lubricant {
            None => self.shear.fill(0.0),
            Some(lubricant) => {
                lubricant.viscosity().fill(&state.fluid_pressure, &mut self.viscosity);
                let (viscosity, film) = (&self.viscosity, &state.film);
                let (rheology, pressure, theta) = (&self.rheology, &state.fluid_pressure, &state.theta);
                let stress =
                    |k: usize, eta, rate| theta[k] * rheology.shear_stress_under(pressure[k], eta, rate);
                metrics::fill_shear((viscosity, film), self.sliding, stress, &mut self.shear)?;
            }
        }
        Ok(())
    }

    /// Shear stress on the surfaces at node `k` \[Pa\]; zero without sliding.
    pub(in crate::sim) fn stress(&self, k: usize) -> f64 {
        if self.sliding > 0.0 { self.boundary[k] * self.solid[k] + self.shear[k] } else { 0.0 }
    }

    /// Shear stress law of the fluid.
    pub(in crate::sim) fn rheology(&self) -> &Rheology {
        &self.rheology
    }

    /// Heat of boundary friction at every node \[W/m^2\].
    pub(in crate::sim) fn boundary_heat(&self) -> Vec<f64> {
        self.boundary.iter().zip(&self.solid).map(|(mu, solid)| mu * solid * self.sliding).collect()
    }

    /// Frictional heat at node `k` \[W/m^2\].
    pub(in crate::sim) fn heat(&self, k: usize) -> f64 {
        self.stress(k) * self.sliding
    }

    /// Boundary friction coefficient at the first node; zero without sliding.
    pub(in crate::sim) fn first_boundary(&self) -> f64 {
        if self.sliding > 0.0 { self.boundary.first().copied().unwrap_or(0.0) } else { 0.0 }
    }

    /// Friction coefficient and its parts; zero without sliding.
    pub(in crate::sim) fn numbers(&self, contact: &ContactModel) -> Result<FrictionNumbers, InputError> {
        InputError::require_finite("solid_pressure", &self.solid)?;
        InputError::require_finite("viscous_shear", &self.shear)?;
        if self.sliding <= 0.0 {
            return Ok(FrictionNumbers::default());
        }
        // Summed as differences to the first node: exact for a constant law.
        let reference = self.boundary.first().copied().unwrap_or(0.0);
        let nodes = self.boundary.iter().zip(&self.solid);
        let beyond: f64 = nodes.map(|(coefficient, solid)| (coefficient - reference) * solid).sum();
        let boundary = reference * self.solid.iter().sum::<f64>() + beyond;
        let fluid = self.shear.iter().sum::<f64>();
        let area = contact.grid.cell_area();
        let outside = contact.far_field.as_ref().map_or(0.0, |far| far.friction_force);
        let per_load = contact.hertz.per_metre(&contact.grid).force * self.sliding;
        let forces = [boundary * area, fluid * area + outside];
        Ok(FrictionNumbers::of(forces, contact.hertz.force, per_load))
    }
}
