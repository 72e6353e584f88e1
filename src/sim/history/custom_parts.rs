//! The parts of a scene that a builder replaces.

use crate::reynolds::FaceMobility;
use crate::sim::history::body::Body;
use crate::sim::history::builder::SimBuilder;

/// Flags of the parts of the scene that were replaced.
#[derive(Debug, Default, Clone, Copy)]
pub(in crate::sim) struct ReplacedParts {
    /// Heights of ball and disc.
    pub(in crate::sim) heights: [bool; 2],
    /// The viscosity law.
    pub(in crate::sim) viscosity: bool,
    /// The growth law.
    pub(in crate::sim) growth: bool,
}

impl SimBuilder {
    /// The face mobility. Its default for custom heights is that of rough surfaces.
    pub(in crate::sim) fn face_mobility(&self, replaced: ReplacedParts, bodies: &[Body; 2]) -> FaceMobility {
        let roughness = [&self.scene.roughness.ball, &self.scene.roughness.disc];
        let smooth = (0..2).all(|index| {
            let surface = bodies[index].surface();
            let is_flat = || surface.iter().all(|z| z.to_bits() == surface[0].to_bits());
            if replaced.heights[index] { is_flat() } else { roughness[index].is_smooth() }
        });
        self.scene.face_mobility_between(smooth)
    }

    /// The parts of the scene replaced so far.
    pub(in crate::sim) fn replaced(&self) -> ReplacedParts {
        ReplacedParts {
            heights: [0, 1].map(|body| self.heights[body].is_some() || self.starts[body].is_some()),
            viscosity: self.custom.viscosity.is_some(),
            growth: self.growth.is_some(),
        }
    }

    /// The first custom component of the contact, apart from heights and starts.
    pub(in crate::sim) fn custom_contact(&self) -> Option<&'static str> {
        let custom = &self.custom;
        [
            ("deformation", custom.deformation.is_some()),
            ("viscosity", custom.viscosity.is_some()),
            ("density", custom.density.is_some()),
            ("solver", custom.solver.is_some()),
            ("plasticity", self.plasticity.is_some()),
            ("boundary_friction", self.friction.is_some()),
        ]
        .into_iter()
        .find_map(|(part, given)| given.then_some(part))
    }

    /// The first custom component, height or start.
    pub(in crate::sim) fn custom_part(&self) -> Option<&'static str> {
        let [ball, disc] = &self.heights;
        let [ball_start, disc_start] = &self.starts;
        let given = [
            ("ball_heights", ball.is_some()),
            ("disc_heights", disc.is_some()),
            ("ball_start", ball_start.is_some()),
            ("disc_start", disc_start.is_some()),
            ("contact_start", self.contact_start.is_some()),
        ];
        given.into_iter().find_map(|(part, given)| given.then_some(part)).or_else(|| self.custom_contact())
    }

    /// A custom component that is defined on one grid and cannot follow a growing box.
    pub(in crate::sim) fn part_on_one_grid(&self) -> Option<&'static str> {
        let others = [
            ("growth_law", self.growth.is_some()),
            ("wear_law", self.wear.is_some()),
            ("motion", self.motion.is_some()),
            ("squeeze", self.squeeze),
        ];
        self.custom_part().or_else(|| others.into_iter().find_map(|(part, given)| given.then_some(part)))
    }
}
