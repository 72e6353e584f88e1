//! The loop of Newton's method.

use super::contact_film::clamp_film_to_contact;
use super::globalization::{Globalization, StepControl};
use super::linear_system::LinearSystem;
use super::local_elimination::LocalElimination;
use super::prediction::Prediction;
use super::record::Record;
use super::snapshot::Snapshot;
use crate::report::{Residuals, Status};
use crate::reynolds::coupled::{Changed, Coupled};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;
use crate::reynolds::{ReynoldsError, StoppingRule};

/// The evaluated state, the parts of a step, and the record of the solve.
#[derive(Debug)]
pub(super) struct Newton {
    /// Films, balances and active set of the present state.
    pub(super) coupled: Coupled,
    pub(super) system: LinearSystem,
    elimination: LocalElimination,
    /// The state at the start of a step.
    start: Snapshot,
    /// Residuals of the present state; then best state, history of residuals, work.
    residuals: Residuals,
    pub(super) record: Record,
}

impl Newton {
    pub(super) fn new(coupled: Coupled, system: LinearSystem, elimination: LocalElimination) -> Self {
        let (start, record) = (Snapshot::new(coupled.fluid.grid), Record::new(coupled.fluid.grid));
        Self { coupled, system, elimination, start, residuals: Residuals::default(), record }
    }

    /// Evaluates a state of unknown origin: films, active set, balances and residuals; one convolution.
    pub(super) fn evaluate(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<Residuals, ReynoldsError> {
        self.coupled.configure(problem);
        self.residuals = self.coupled.evaluate(problem, state, Changed::Everything)?;
        Ok(self.residuals)
    }

    /// Newton steps from an evaluated state, each linear system solved to the reduction `linear_tolerance`, until
    /// the iteration converges, stalls, diverges or has no steps left. Keeps the best state.
    pub(super) fn iterate(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        globalization: &mut Globalization,
        linear_tolerance: f64,
    ) -> Result<Status, ReynoldsError> {
        for steps_left in (0..=stop.max_iterations.saturating_sub(self.record.work.iterations)).rev() {
            if !self.residuals.is_finite() {
                return Ok(Status::Diverged);
            }
            // End of the homotopy: cavitation as in the problem, and the flow evaluated anew.
            if globalization.restore_cavitation(problem, self.residuals.max()) {
                self.coupled.fluid.configure(problem);
                self.residuals = self.coupled.evaluate(problem, state, Changed::Film)?;
            }
            // Check convergence; residuals during the homotopy belong to a modified problem.
            self.record.history.push(self.residuals);
            if !globalization.is_homotopy(problem) {
                self.record.keep_if_best(self.residuals, &self.coupled, state);
                if self.residuals.max() <= stop.tolerance {
                    return Ok(Status::Converged);
                }
            }
            // Check progress.
            globalization.update_progress(problem, self.residuals.max());
            if globalization.has_stalled() {
                return Ok(Status::Stalled);
            }
            if steps_left == 0 {
                break;
            }
            // Next equations: contact film of the homotopy, pseudo-transient term.
            self.record.work.iterations += 1;
            let control = globalization.begin_step(problem, self.residuals.max());
            if control.is_homotopy {
                self.coupled.fluid.configure(problem);
            }
            self.coupled.fluid.set_pseudo_transient(control.pseudo_transient);
            // Linearize with films clamped to contact, and solve.
            clamp_film_to_contact(&mut self.coupled, problem, state);
            let solved = self.system.solve(&mut self.coupled, problem, state, linear_tolerance)?;
            let Some(krylov_steps) = solved else { return Ok(Status::Diverged) };
            self.record.work.inner_iterations += krylov_steps;
            // Step with backtracking, and adapt the step bound to the linearization error.
            globalization.update_step_bound(self.line_search(problem, state, control)?);
        }
        Ok(Status::MaxIterations)
    }

    /// Takes the step, halved until the residual is acceptable; returns the linearization error of the films.
    fn line_search(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        control: StepControl,
    ) -> Result<f64, ReynoldsError> {
        let capped_length = Globalization::capped_step_length(problem, self.system.largest_pressure_change());
        self.start.save(&self.coupled, state);
        let mut error = 0.0;
        for length in control.step_lengths() {
            if length < 1.0 {
                // Go back to the start of the step before a shorter one.
                self.start.restore(&mut self.coupled, problem, state)?;
                clamp_film_to_contact(&mut self.coupled, problem, state);
            }
            error = self.advance(problem, state, length * capped_length, length * control.step_bound)?;
            // Accept the step as soon as the residual is low enough.
            if self.residuals.max() <= control.acceptable {
                break;
            }
        }
        Ok(error)
    }

    /// Takes the `share` of the linear step and evaluates the state; returns its linearization error.
    fn advance(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        share: f64,
        step_bound: f64,
    ) -> Result<f64, ReynoldsError> {
        let Self { coupled, system, elimination, start, residuals, .. } = self;
        // Predict the state, and eliminate nodes and isolated regions.
        let prediction = Prediction::new(start, system, share);
        elimination.eliminate(&prediction, step_bound, coupled, problem, state);
        state.approach += prediction.approach_change();
        // Elastic films by one convolution.
        coupled.displace(problem, state)?;
        // A line contact, a strip included, shifts its approach by the mean rise: one pressure shifts all of its films
        // almost uniformly.
        if coupled.fluid.grid.ny() == 1 || coupled.fluid.grid.is_strip() {
            let rise = prediction.mean_rise(coupled, state);
            state.approach += rise;
            coupled.elastic_film.iter_mut().for_each(|film| *film -= rise);
        }
        *residuals = coupled.evaluate(problem, state, Changed::ElasticFilm)?;
        Ok(prediction.film_error(coupled, state, problem.contact_film()))
    }
}
