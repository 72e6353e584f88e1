//! The changes of the bodies in a step: its length, flattening, wear and film growth.

use crate::error::InputError;
use crate::sim::contact::outer_rows::{self, Change};
use crate::sim::error::SimError;
use crate::sim::history::contact_exposure::ContactExposure;
use crate::sim::history::exposure;
use crate::sim::history::placement::Offsets;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::history::step_control::StepControl;
use crate::sim::scene::operating_schedule::Conditions;

/// Most reductions of the length of a step.
const MAX_CUTS: usize = 40;

impl MixedLubricationSim {
    /// Commits the longest step that `control` allows and returns its length.
    pub(in crate::sim) fn commit_within(
        &mut self,
        control: &StepControl,
        offsets: Offsets,
    ) -> Result<f64, SimError> {
        let mut time_step = control.longest;
        for _ in 0..MAX_CUTS {
            self.commit(time_step, offsets)?;
            let change = self.largest_change();
            if change.min(control.depth) > self.half_width() {
                return Err(SimError::Input(InputError::Conflict {
                    field: format!("time_step = {time_step:e}"),
                    reason: format!(
                        "a node would change by {change:.1e} m, more than the half-width of the contact: take shorter steps, or check \
                         the coefficient of wear"
                    ),
                }));
            }
            if change <= control.depth {
                return Ok(time_step);
            }
            for (body, backup) in self.bodies.iter_mut().zip(&self.backup) {
                body.clone_from(backup);
            }
            time_step *= (0.98 * control.depth / change).clamp(0.02, 0.98);
        }
        Err(SimError::Input(InputError::Conflict {
            field: format!("depth = {:?}", control.depth),
            reason: format!("the laws change a node by more than it even within {time_step:e} s"),
        }))
    }

    /// Rejects a step in which wear or a tribofilm has reached the edge of the box.
    pub(in crate::sim) fn require_changes_inside(&self) -> Result<(), SimError> {
        if self.scene.solver.edge_contact {
            return Ok(());
        }
        let Conditions { motion, bulk_temperature, .. } = self.conditions();
        let speeds = motion.surface_speeds();
        let growth = self.laws.growth.as_deref();
        let by_solids = growth.is_some_and(|law| outer_rows::needs_solids(law, bulk_temperature));
        for (body, (now, before)) in self.bodies.iter().zip(&self.backup).enumerate() {
            let change = Change {
                body,
                visits: exposure::visits(self.surface_motion.motion.as_ref(), speeds[body]),
                wear: [now.wear(), before.wear()],
                film: by_solids.then(|| [now.tribofilm(), before.tribofilm()]),
            };
            let contact_film = self.scene.solver.film_cutoff;
            change.require_inside(&self.contact.grid, &self.contact.hertz, contact_film)?;
        }
        Ok(())
    }

    /// Smaller half-width of the Hertz contact \[m\].
    pub(in crate::sim) fn half_width(&self) -> f64 {
        self.contact.hertz.half_width_x.min(self.contact.hertz.half_width_y)
    }

    /// Largest change of wear or film of any node since the backup \[m\].
    fn largest_change(&self) -> f64 {
        let fields = self.bodies.iter().zip(&self.backup).flat_map(|(now, before)| {
            let wear = now.wear().iter().zip(before.wear());
            wear.chain(now.tribofilm().iter().zip(before.tribofilm()))
        });
        fields.fold(0.0, |largest, (now, before)| largest.max((now - before).abs()))
    }

    /// Applies flattening, wear and film growth of a step of `time_step` \[s\] to the bodies.
    fn commit(&mut self, time_step: f64, offsets: Offsets) -> Result<(), SimError> {
        let Conditions { motion, bulk_temperature, .. } = self.conditions();
        let Self { bodies, contact, laws, state, yielding, friction, buffers, .. } = self;
        let (grid, speeds) = (&contact.grid, motion.surface_speeds());
        let (track, roughness_motion) = (&self.scene.track, self.surface_motion.motion.as_ref());
        let time_weight = |exposure| {
            exposure::time_weight((track, exposure), roughness_motion, grid, &contact.hertz, speeds)
        };
        let wear_exposure = self.scene.wear.map_or(track.exposure, |wear| wear.exposure);
        let contact_exposure = ContactExposure {
            grid,
            state,
            friction,
            rises: self.heat.rises(),
            bulk: bulk_temperature,
            sliding: motion.sliding_speed(),
            offsets,
            time_weight: time_weight(track.exposure)?,
            wear_time_weight: time_weight(wear_exposure)?,
        };
        if laws.plasticity.is_some() {
            yielding.share(&state.plastic_depth)?;
            buffers.flatten(bodies, &contact_exposure, &yielding.split, time_step)?;
        }
        buffers.wear_and_grow(bodies, &contact_exposure, laws, self.represented_cycles * time_step)
    }
}
