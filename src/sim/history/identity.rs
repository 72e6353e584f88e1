//! What tells one simulation from another.
//!
//! A checkpoint carries the identity of its run; one that resumes compares them part by part and names what
//! differs. Scenes are compared as files with all defaults, own laws by what `Debug` prints, own bodies and
//! solvers by what they do and are called. [`CONDITIONS`] lists what may differ where a run goes on under
//! other conditions.

use toml::{Table, Value};

use crate::elastic::{DeformationModel, NEAR};
use crate::sim::error::SimError;
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::{GridSpec, Scene};

/// Parts that act on the bodies from outside: a run may go on under others.
pub(in crate::sim) const CONDITIONS: [&str; 11] = [
    "scene.load",
    "scene.motion",
    "scene.lubricant",
    "scene.friction",
    "scene.thermal",
    "scene.schedule",
    "scene.solver",
    "boundary friction",
    "viscosity law",
    "density law",
    "solver",
];
/// Of the description below.
const VERSION: u32 = 1;
/// What a part is called that follows from the scene.
const OF_SCENE: &str = "of the scene";

/// A run in words: its scene as a scene file, and what was put in place of parts of the scene.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub(in crate::sim) struct Identity {
    /// Of this description.
    version: u32,
    /// The scene as a file.
    scene: String,
    /// What else a run depends on: name and words.
    parts: Vec<(String, String)>,
}

impl Identity {
    /// The grid of the scene.
    pub(in crate::sim) fn grid(&self) -> Option<GridSpec> {
        Scene::from_toml(&self.scene).ok().map(|scene| scene.grid)
    }

    /// The parts in which both differ.
    pub(in crate::sim) fn differences(&self, other: &Self) -> Vec<String> {
        if self.version != other.version {
            return vec!["description".to_owned()];
        }
        let (own, others) = (tables(&self.scene), tables(&other.scene));
        let mut names: Vec<&String> =
            own.keys().chain(others.keys().filter(|key| !own.contains_key(*key))).collect();
        names.retain(|key| own.get(*key) != others.get(*key));
        let of_scene = names.into_iter().map(|key| format!("scene.{key}"));
        let differ = self.parts.iter().filter(|part| !other.parts.contains(part));
        of_scene.chain(differ.map(|(name, _)| name.clone())).collect()
    }
}

/// The tables of a scene file with all defaults of this version, so that keys which an earlier one did not
/// know make no difference; the bare text where the scene is none of this version.
fn tables(scene: &str) -> Table {
    let full = Scene::from_toml(scene).and_then(|scene| scene.to_toml());
    let text = full.as_deref().unwrap_or(scene);
    text.parse().unwrap_or_else(|_| Table::from_iter([("file".to_owned(), Value::from(text))]))
}

/// What was put in place of parts of the scene, by what `Debug` prints of it.
#[derive(Debug, Default, Clone)]
pub(in crate::sim) struct OwnParts(Vec<(&'static str, String)>);

impl OwnParts {
    /// Those of a builder whose laws have not been taken yet.
    pub(in crate::sim) fn of(builder: &SimBuilder) -> Self {
        let own = &builder.custom;
        let words = |part: Option<&dyn std::fmt::Debug>| {
            part.map_or_else(|| OF_SCENE.to_owned(), |part| format!("{part:?}"))
        };
        Self(vec![
            ("motion", words(builder.motion.as_ref().map(|part| part as _))),
            ("growth law", words(builder.growth.as_ref().map(|part| part as _))),
            ("plasticity model", words(builder.plasticity.as_ref().map(|part| part as _))),
            ("wear law", words(builder.wear.as_ref().map(|part| part as _))),
            ("boundary friction", words(builder.friction.as_ref().map(|part| part as _))),
            ("viscosity law", words(own.viscosity.as_ref().map(|part| part as _))),
            ("density law", words(own.density.as_ref().map(|part| part as _))),
        ])
    }
}

impl MixedLubricationSim {
    /// The same with parts put in place of those of the scene.
    pub(in crate::sim) fn with_own_parts(mut self, own_parts: OwnParts) -> Self {
        self.own_parts = own_parts;
        self
    }

    /// The scene as a file, and the parts in its place.
    ///
    /// # Errors
    /// A scene that no file can hold.
    pub(in crate::sim) fn identity(&self) -> Result<Identity, SimError> {
        let bodies = self.contact.deformation.bodies();
        let influence = [0, 1, NEAR].map(|di| format!("{:e}", bodies.influence(di, 0)));
        let others = [
            ("squeeze", self.surface_motion.squeeze.to_string()),
            ("solver", self.contact.solver.id().to_string()),
            // By what it does: buffers may show in `Debug`.
            ("deformation model", influence.join(" ")),
        ];
        let parts = self.own_parts.0.iter().map(|(name, words)| (*name, words.clone())).chain(others);
        Ok(Identity {
            version: VERSION,
            scene: self.scene.to_toml()?,
            parts: parts.map(|(name, words)| (name.to_owned(), words)).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(scene: &str) -> Identity {
        Identity { version: VERSION, scene: scene.to_owned(), parts: Vec::new() }
    }

    #[test]
    fn what_a_file_does_not_say_is_the_default() {
        let full = Scene::azam_2019(32).to_toml().unwrap_or_default();
        let short = full.replace("max_iterations = 20000\n", "");
        assert!(short.len() < full.len());
        assert!(identity(&full).differences(&identity(&short)).is_empty());
        let other = full.replace("max_iterations = 20000\n", "max_iterations = 7\n");
        assert_eq!(identity(&full).differences(&identity(&other)), ["scene.solver"]);
        let later = Identity { version: VERSION + 1, ..identity(&full) };
        assert_eq!(identity(&full).differences(&later), ["description"]);
        // Scenes that are none are compared as they stand.
        assert_eq!(identity("a = 1").differences(&identity("a = 2")), ["scene.a"]);
    }
}
