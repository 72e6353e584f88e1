//! Accessors of a simulation.

use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::ContactState;
use crate::sim::contact::far_field::FloodedInlet;
use crate::sim::contact::warnings::Warning;
use crate::sim::history::body::Body;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::Scene;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::operating_schedule::Conditions;
use crate::surface::RoughnessMotion;

impl MixedLubricationSim {
    /// The motion of the roughness from step to step.
    pub fn motion(&self) -> &dyn RoughnessMotion {
        self.surface_motion.motion.as_ref()
    }

    /// Whether the film has a squeeze term.
    pub fn has_squeeze(&self) -> bool {
        self.surface_motion.squeeze
    }

    /// The grid of the contact and of both bodies' patches.
    pub fn grid(&self) -> Grid {
        self.contact.grid
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Load, speeds and temperature at the present time.
    pub fn conditions(&self) -> Conditions {
        self.operating_schedule.at(self.time)
    }

    /// Hertz contact of the smooth bodies under the load of the last step; of a line contact per metre.
    pub fn hertz(&self) -> HertzContact {
        self.contact.hertz.per_metre(&self.contact.grid)
    }

    /// Simulated time \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Number of committed steps.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Ball and disc.
    pub fn bodies(&self) -> &[Body; 2] {
        &self.bodies
    }

    /// Pressures and film of the last solve, in the frame of the contact.
    pub fn state(&self) -> &ContactState {
        &self.state
    }

    /// All warnings of the run so far: those of [`Scene::warnings`], of heights read or given, and of the first
    /// contact.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Whether the flash temperature is modelled.
    pub fn models_flash_temperature(&self) -> bool {
        self.heat.is_modelled
    }

    /// Largest flash temperature rise of the smooth contact over the entries of the schedule \[K\]. Unless the
    /// scene decides, the flash temperature is modelled if this is 1 K or more. The heat is that of boundary
    /// friction under the full load, or of shear of a fluid film of the thickness by formula, whichever is
    /// larger (see [`estimate_rise_under_flux`](crate::tribochem::estimate_rise_under_flux)). Ellipses and line
    /// contacts are treated as a circle under the same mean flux.
    pub fn flash_estimate(&self) -> f64 {
        self.heat.estimate
    }

    /// The flooded inlet under the conditions of the last step, or of the start; `None` for a dry contact, for a
    /// lubricant supply at the edge of the box and for a supplied film.
    ///
    /// # Errors
    /// Never for a simulation built by [`SimBuilder`](crate::sim::SimBuilder).
    pub fn inlet(&self) -> Result<Option<FloodedInlet>, InputError> {
        self.contact.flooded_inlet()
    }

    /// Largest difference over both bodies between the surface and `initial - wear - plastic + film` \[m\].
    ///
    /// # Errors
    /// Never for a simulation built by [`SimBuilder`](crate::sim::SimBuilder): its fields have one length.
    pub fn ledger_residual(&self) -> Result<f64, InputError> {
        let [ball, disc] = &self.bodies;
        Ok(ball.ledger()?.residual(&ball.surface)?.max(disc.ledger()?.residual(&disc.surface)?))
    }
}
