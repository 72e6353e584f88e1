//! From a builder to a checked simulation.

use crate::error::InputError;
use crate::sim::contact::asperity_inlets;
use crate::sim::contact::components::validate_loads;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::SimError;
use crate::sim::history::body::Body;
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::exposure;
use crate::sim::history::half_mesh::HalfMesh;
use crate::sim::history::heat::Heat;
use crate::sim::history::placement::SurfaceMotion;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::Scene;
use crate::sim::scene::operating_schedule::OperatingSchedule;

impl SimBuilder {
    /// Checks the scene and makes the simulation, with the physics of the scene.
    ///
    /// # Errors
    /// A scene or heights that do not fit.
    pub fn build(mut self) -> Result<MixedLubricationSim, SimError> {
        require_at_rest(&self.scene)?;
        self.scene.schedule.read_tables()?;
        self.require_growable()?;
        #[cfg(feature = "serde")]
        let custom_identity = crate::sim::history::identity::CustomIdentity::of(&self);
        let replaced = self.replaced();
        let custom_contact = self.custom_contact();
        let custom = std::mem::take(&mut self.custom);
        let interrupt = custom.interrupt.clone();
        let mut contact = ContactModel::new(&self.scene, custom)?;
        let operating_schedule = OperatingSchedule::new(&self.scene)?;
        let plastic = self.scene.plastic.filter(|_| self.plasticity.is_none());
        validate_loads(&self.scene, plastic, &contact.grid, &operating_schedule)?;
        exposure::validate(&self.scene, &operating_schedule, &contact.grid)?;
        let laws = self.laws()?;
        let bodies = [self.body(0, &contact, &laws)?, self.body(1, &contact, &laws)?];
        asperity_inlets::require_no_lay(&self.scene, &contact.grid, bodies.each_ref().map(Body::initial))?;
        let warnings = self.warnings(replaced, &contact, &bodies, &laws);
        contact.face_mobility = self.face_mobility(replaced, &bodies);
        let heat = Heat::new(&self.scene, &contact, &operating_schedule, &laws)?;
        let motion = self.motion.unwrap_or_else(|| self.scene.track.roughness_motion().into());
        let surface_motion = SurfaceMotion { motion, squeeze: self.squeeze };
        let whole = (self.scene, operating_schedule, warnings);
        let mut sim = MixedLubricationSim::assemble(whole, contact, bodies, laws, heat, surface_motion)?;
        sim.contact_start = self.contact_start;
        if sim.scene.solver.estimate
            && let Some(part) = custom_contact
        {
            return Err(SimError::Input(InputError::Conflict {
                field: part.to_owned(),
                reason: "it is known on one grid, an estimate of errors (solver.estimate) needs two"
                    .to_owned(),
            }));
        }
        sim.half_mesh = HalfMesh::new(&sim.scene, &sim.contact, interrupt.clone())?.map(Box::new);
        sim.interrupt = interrupt;
        #[cfg(feature = "serde")]
        let sim = sim.with_custom_identity(custom_identity);
        Ok(sim)
    }

    /// Prepares [`build`](Self::build) and the first step of the history up to the first iteration of its solver,
    /// without solving. Returns the warnings known by then. [`check_contact`](Self::check_contact) is the same
    /// for a single contact.
    ///
    /// # Errors
    /// The input errors of [`build`](Self::build) and of the first step. Some concern a history only: a track
    /// shorter than the patch, a load of the schedule that does not fit into the box or exceeds the pressure
    /// limit.
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut scene = Scene::azam_2019(32);
    /// let builder = |scene: &Scene| MixedLubricationSim::builder(scene.clone());
    /// assert!(builder(&scene).check()?.starts_with(&scene.warnings()));
    /// scene.track.radius_disc = Some(1e-6); // the track is shorter than the patch
    /// assert!(builder(&scene).check().is_err() && builder(&scene).check_contact().is_ok());
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn check(self) -> Result<Vec<Warning>, SimError> {
        let mut sim = self.build()?;
        sim.check_first_contact()?;
        Ok(sim.warnings)
    }
}

/// Rejects roughness in motion in a history.
fn require_at_rest(scene: &Scene) -> Result<(), InputError> {
    if scene.motion.roughness.is_at_rest() {
        return Ok(());
    }
    Err(InputError::Conflict {
        field: "motion.roughness = \"moving\"".to_owned(),
        reason:
            "is for single contacts; in a history track.motion says how the roughness moves from step to step"
                .to_owned(),
    })
}
