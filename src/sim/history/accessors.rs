//! What can be asked of a simulation between two steps.

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
    /// How the roughness moves from step to step.
    pub fn motion(&self) -> &dyn RoughnessMotion {
        self.surface_motion.motion.as_ref()
    }

    /// Whether each contact feels the squeeze of the film before it.
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

    /// What acts on the contact at the time that has passed.
    pub fn conditions(&self) -> Conditions {
        self.operating_schedule.at(self.time)
    }

    /// Hertz contact of the smooth bodies under the load of the last step.
    pub fn hertz(&self) -> HertzContact {
        self.contact.hertz
    }

    /// Time that has passed \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps that were committed.
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

    /// What is unlikely to be meant or to hold: that of [`Scene::warnings`], of heights that were read or
    /// given, and after the first step of its contact. The list is that of the whole run, no step repeats it.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Whether the flash temperature is modelled.
    pub fn models_flash_temperature(&self) -> bool {
        self.heat.is_modelled
    }

    /// Largest flash temperature rise that the smooth contact would have \[K\] under the conditions at any
    /// entry of the schedule, by which it is modelled or left out unless the scene says which: by boundary
    /// friction under all of the load, or by shear of a fluid film of the thickness that the formulas give,
    /// whichever is hotter (see [`estimate_rise_under_flux`](crate::tribochem::estimate_rise_under_flux)). Of
    /// ellipses and line contacts it is that of a circle of their mean flux.
    pub fn flash_estimate(&self) -> f64 {
        self.heat.estimate
    }

    /// The inlet under the conditions of the last step, or of the start; none in a dry contact and where the oil begins
    /// at the edge of the box or, by a supplied film, within it.
    ///
    /// # Errors
    /// Never for a simulation that was built.
    pub fn inlet(&self) -> Result<Option<FloodedInlet>, InputError> {
        self.contact.flooded_inlet()
    }

    /// Largest difference over both bodies between the surface and `initial - wear - plastic + film` \[m\].
    ///
    /// # Errors
    /// Never for a simulation that was built: its fields have one length.
    pub fn ledger_residual(&self) -> Result<f64, InputError> {
        let [ball, disc] = &self.bodies;
        Ok(ball.ledger()?.residual(&ball.surface)?.max(disc.ledger()?.residual(&disc.surface)?))
    }
}
