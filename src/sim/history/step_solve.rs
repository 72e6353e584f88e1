//! The contact of a step at a position of the roughness at which its solve converges.

use crate::error::InputError;
use crate::reynolds::ContactState;
use crate::sim::contact::film_heat::{self, SolveContext, Solved};
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::outer_rows;
use crate::sim::error::SimError;
use crate::sim::history::placement::Offsets;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::history::squeeze_memory::Entrainment;

/// Most positions of the roughness tried in a step.
const MAX_ATTEMPTS: u32 = 8;

impl MixedLubricationSim {
    /// Solves the contact at the next position of the roughness, or at further ones if that fails.
    pub(in crate::sim) fn solve_at_some_position(&mut self) -> Result<(Solved, Offsets, u32), SimError> {
        let mut attempt = 1;
        loop {
            let offsets = self.offsets()?;
            self.draws += 1;
            let (report, heat) = self.solve_at(offsets)?;
            match report.require_converged() {
                Ok(()) => return Ok(((report, heat), offsets, attempt)),
                // Without another position a further attempt would be the same.
                Err(source) if attempt >= MAX_ATTEMPTS || self.offsets()? == offsets => {
                    return Err(SimError::NotConverged { step: self.step, attempts: attempt, source });
                }
                // With squeeze a solve starts from the previous state: restore the last converged one.
                Err(_) => {
                    self.state.clone_from(&self.before);
                    attempt += 1;
                }
            }
        }
    }

    /// Offsets of the roughness at the next solve.
    fn offsets(&self) -> Result<Offsets, InputError> {
        let speeds = self.operating_schedule.mean_speeds(self.time);
        self.surface_motion.offsets(self.draws, self.time, speeds, &self.contact.grid)
    }

    /// Returns the input errors of the next solve without solving.
    pub(in crate::sim) fn check_first_contact(&mut self) -> Result<(), SimError> {
        let offsets = self.offsets()?;
        let Self { bodies, contact, laws, state, contact_start, placement, yielding, .. } = self;
        placement.place(bodies, &contact.form_gap, offsets)?;
        contact.set_tribofilms(&placement.films)?;
        let limit = match &laws.plasticity {
            None => None,
            Some(models) => {
                yielding.start(models, &placement.films, &placement.depths)?;
                Some(yielding.limit.as_slice())
            }
        };
        Ok(contact.check(&placement.gap, limit, contact_start.as_ref().unwrap_or(state))?)
    }

    /// Solves the contact of the bodies at `offsets` with its shear stresses and, if modelled, the film
    /// temperature.
    pub(in crate::sim) fn solve_at(&mut self, offsets: Offsets) -> Result<Solved, SimError> {
        let Self { contact, laws, state, placement, yielding, squeeze_memory, squeezed, .. } = self;
        placement.place(&self.bodies, &contact.form_gap, offsets)?;
        contact.set_tribofilms(&placement.films)?;
        let squeeze = if self.surface_motion.squeeze {
            squeeze_memory.squeeze(self.step, Entrainment::of(contact), squeezed)?
        } else {
            None
        };
        // With squeeze the previous film is close to the next one: keep it as a start. Otherwise the roughness
        // has moved far, and the dry contact is as good a start.
        match self.contact_start.as_ref().filter(|_| self.step == 0) {
            Some(start) => state.clone_from(start),
            None if squeeze.is_none() => state.pressure.fill(0.0),
            None => {}
        }
        if let Some(heat) = &mut self.film_heat {
            heat.move_at(contact.motion.surface_speeds(), &contact.grid)?;
        }
        let given = SolveContext { laws, tribofilms: &placement.films };
        let models = laws.plasticity.as_ref();
        let mut once = |contact: &mut ContactModel, state: &mut ContactState| {
            yielding.solve(models, placement, contact, squeeze, state)
        };
        let heat = self.film_heat.as_mut();
        let solved = film_heat::solve(&given, heat, (contact, state, &mut self.friction), &mut once);
        outer_rows::require_solids_inside(&self.scene, (contact, state), solved)
    }
}
