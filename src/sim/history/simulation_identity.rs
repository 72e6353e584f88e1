//! Identities of a builder and of a simulation.

use crate::elastic::{DeformationModel, NEAR};
use crate::sim::error::SimError;
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::identity::{CustomIdentity, Identity};
use crate::sim::history::simulation::MixedLubricationSim;

/// Description of a part that follows from the scene.
const OF_SCENE: &str = "of the scene";

impl CustomIdentity {
    /// The custom components of a builder; call it before they are moved out.
    pub(in crate::sim) fn of(builder: &SimBuilder) -> Self {
        let custom = &builder.custom;
        let words = |part: Option<&dyn std::fmt::Debug>| {
            part.map_or_else(|| OF_SCENE.to_owned(), |part| format!("{part:?}"))
        };
        Self(vec![
            ("motion", words(builder.motion.as_ref().map(|part| part as _))),
            ("growth law", words(builder.growth.as_ref().map(|part| part as _))),
            ("plasticity model", words(builder.plasticity.as_ref().map(|part| part as _))),
            ("wear law", words(builder.wear.as_ref().map(|part| part as _))),
            ("boundary friction", words(builder.friction.as_ref().map(|part| part as _))),
            ("viscosity law", words(custom.viscosity.as_ref().map(|part| part as _))),
            ("density law", words(custom.density.as_ref().map(|part| part as _))),
        ])
    }
}

impl MixedLubricationSim {
    /// The identity with custom components.
    pub(in crate::sim) fn with_custom_identity(mut self, custom_identity: CustomIdentity) -> Self {
        self.custom_identity = custom_identity;
        self
    }

    /// The scene as a file, and the custom components.
    ///
    /// # Errors
    /// A scene that cannot be written to a file.
    pub(in crate::sim) fn identity(&self) -> Result<Identity, SimError> {
        let bodies = self.contact.deformation.bodies();
        let influence = [0, 1, NEAR].map(|di| format!("{:e}", bodies.influence(di, 0)));
        let others = [
            ("squeeze", self.surface_motion.squeeze.to_string()),
            ("solver", self.contact.solver.id().to_string()),
            // Compared by its response: the `Debug` output may contain buffers.
            ("deformation model", influence.join(" ")),
        ];
        let parts = self.custom_identity.0.iter().map(|(name, words)| (*name, words.clone())).chain(others);
        let parts = parts.map(|(name, words)| (name.to_owned(), words)).collect();
        Ok(Identity::new(self.scene.to_toml()?, parts))
    }
}
