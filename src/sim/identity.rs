//! What tells one simulation from another.

use super::simulation::MixedLubricationSim;
use crate::elastic::{DeformationModel, NEAR};
use crate::lubricant::Lubricant;

/// Parts that act on the bodies from outside: a run may go on under others.
pub(super) const CONDITIONS: [&str; 11] = [
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

/// The scene and what was put in place of its parts, in words.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub(super) struct Identity {
    parts: Vec<(String, String)>,
}

impl Identity {
    /// The parts in which both differ.
    pub(super) fn differences(&self, other: &Self) -> Vec<String> {
        let (longer, shorter) =
            if self.parts.len() >= other.parts.len() { (self, other) } else { (other, self) };
        let parts = longer.parts.iter().enumerate();
        let differ = parts.filter(|(k, part)| shorter.parts.get(*k) != Some(*part));
        differ.map(|(_, (name, _))| name.clone()).collect()
    }
}

impl MixedLubricationSim {
    /// The scene and the parts in its place by what `Debug` prints of them, which for laws are their
    /// constants.
    pub(super) fn identity(&self) -> Identity {
        let (scene, laws, lubricant) = (&self.scene, &self.laws, &self.contact.lubricant);
        let parts = [
            ("scene.form", format!("{:?}", scene.form)),
            ("scene.elastic", format!("{:?}", scene.elastic)),
            ("scene.materials", format!("{:?}", scene.materials)),
            ("scene.load", format!("{:?}", scene.load)),
            ("scene.motion", format!("{:?}", scene.motion)),
            ("scene.lubricant", format!("{:?}", scene.lubricant)),
            ("scene.grid", format!("{:?}", scene.grid)),
            ("scene.roughness", format!("{:?}", scene.roughness)),
            ("scene.plastic", format!("{:?}", scene.plastic)),
            ("scene.friction", format!("{:?}", scene.friction)),
            ("scene.tribofilm", format!("{:?}", scene.tribofilm)),
            ("scene.wear", format!("{:?}", scene.wear)),
            ("scene.track", format!("{:?}", scene.track)),
            ("scene.thermal", format!("{:?}", scene.thermal)),
            ("scene.schedule", format!("{:?}", scene.schedule)),
            ("scene.solver", format!("{:?}", scene.solver)),
            ("motion", format!("{:?}", self.travel.motion)),
            ("squeeze", format!("{:?}", self.travel.squeeze)),
            ("growth law", format!("{:?}", laws.growth)),
            ("plasticity model", format!("{:?}", laws.plasticity)),
            ("wear law", format!("{:?}", laws.wear)),
            ("boundary friction", format!("{:?}", laws.friction)),
            ("viscosity law", format!("{:?}", lubricant.as_ref().map(Lubricant::viscosity))),
            ("density law", format!("{:?}", lubricant.as_ref().map(Lubricant::density))),
            ("solver", self.contact.solver.name().to_owned()),
            // By what it does: buffers may show in `Debug`.
            (
                "deformation model",
                format!("{:?}", [0, 1, NEAR].map(|di| self.contact.deformation.influence(di, 0))),
            ),
        ];
        Identity { parts: parts.into_iter().map(|(part, words)| (part.to_owned(), words)).collect() }
    }
}
