//! The contact of worn bodies under other conditions, for Stribeck curves of a history.

use crate::error::InputError;
use crate::reynolds::{ContactState, require_speed};
use crate::sim::contact::film_heat::FilmIteration;
use crate::sim::contact::numbers::Numbers;
use crate::sim::contact::numbers::is_known;
use crate::sim::contact::setup;
use crate::sim::contact::solution::ContactSolution;
use crate::sim::error::SimError;
use crate::sim::history::heat;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::operating_schedule::Conditions;
use crate::surface::Offset;

impl MixedLubricationSim {
    /// Solves the contact of the present bodies under `conditions`, with their roughness in its first position
    /// and without squeeze. Nothing is committed; later steps do not depend on this call. A solve that does not
    /// converge is no error: see the status of the report.
    ///
    /// # Errors
    /// Conditions out of range, a load that the grid or the pressure limit cannot carry.
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(32)).build()?;
    /// sim.step(60.0)?;
    /// let mut fast = sim.conditions();
    /// fast.motion.entrainment_speed = 1.0;
    /// let [now, fast] = [sim.solve_under(&sim.conditions())?, sim.solve_under(&fast)?];
    /// assert!(fast.contact.load_ratio < now.contact.load_ratio);
    /// assert_eq!(sim.steps(), 1);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn solve_under(&mut self, conditions: &Conditions) -> Result<ContactSolution, SimError> {
        conditions.validate(self.scene.is_lubricated())?;
        let hertz = self.contact.hertz_under(&self.scene, conditions.load)?;
        setup::validate_box(&self.contact.grid, &hertz, self.scene.form.is_line())?;
        let saved = self.contact.saved();
        let state = std::mem::replace(&mut self.state, ContactState::new(&self.contact.grid));
        let squeeze = std::mem::take(&mut self.surface_motion.squeeze);
        let start = self.contact_start.take();
        let film = self.film_heat.as_mut().map(FilmIteration::take_start);
        let solved = self.solve_and_measure(conditions);
        if let (Some(heat), Some(film)) = (&mut self.film_heat, film) {
            heat.set_start(film);
        }
        self.surface_motion.squeeze = squeeze;
        self.contact_start = start;
        self.state = state;
        self.contact.restore_conditions(saved);
        solved
    }

    /// Solves and measures the contact under `conditions`; the caller restores the changed state.
    fn solve_and_measure(&mut self, conditions: &Conditions) -> Result<ContactSolution, SimError> {
        self.contact.set_conditions(&self.scene, conditions)?;
        let solved = self.solve_at([Offset::default(); 2])?;
        let rq = self.roughness();
        let Self { contact, placement, friction, yielding, laws, state, .. } = self;
        let known = is_known(state).then_some(&*friction);
        let limit = laws.plasticity.is_some().then_some(yielding.limit.as_slice());
        let numbers = Numbers::of(contact, state, known, limit, rq)?;
        let rise = |fields| heat::steady_rise(&self.scene, contact, fields, self.film_heat.as_ref());
        let flash_rise = known.map(rise).transpose()?.flatten();
        let state = std::mem::replace(state, ContactState::new(&contact.grid));
        let mut solution = contact.solution(solved, state, placement.gap.clone(), known, numbers);
        solution.flash_rise = flash_rise;
        Ok(solution)
    }
}

impl Conditions {
    /// Error for a load or a temperature that is not positive, a negative speed, or a lubricated contact at zero
    /// speed.
    pub(super) fn validate(&self, lubricated: bool) -> Result<(), InputError> {
        InputError::require_positive("load", self.load)?;
        let (speed, ratio) = (self.motion.entrainment_speed, self.motion.slide_roll_ratio);
        let field = "entrainment_speed";
        if lubricated {
            require_speed(field, speed)?;
        }
        InputError::require_non_negative(field, speed)?;
        InputError::require(ratio.is_finite(), "slide_roll_ratio", ratio, "finite")?;
        InputError::require_positive("bulk_temperature", self.bulk_temperature)
    }
}
