//! A solve: an attempt, and continuation where that stalls.

use super::Workspace;
use super::homotopy::Homotopy;
use super::settings::{Attempt, STEADY};
use crate::report::{Residuals, Status, Work};
use crate::reynolds::flow::Cavitation;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;
use crate::reynolds::{ReynoldsError, StoppingRule};
use crate::strategy::Strategy;

impl Workspace {
    /// Solves from the state as it is if it carries pressure and is near, else from the dry contact; where that
    /// stalls, by way of thicker contact films. Leaves the best state.
    pub(super) fn run(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        self.work = Work::default();
        self.history.clear();
        (self.strategy, self.best_strategy) = (Strategy::Attempt, Strategy::Attempt);
        self.best_residuals = Residuals::UNKNOWN;
        let cold = state.pressure.iter().all(|&p| p <= 0.0);
        let mut status = self.attempt(cold, problem, state, stop)?;
        if may_go_on(status) && problem.box_load().is_some() && self.can_continue(problem, state) {
            status = self.continue_in_contact_film(problem, state, stop)?;
        }
        if status != Status::Converged && self.best_residuals == Residuals::UNKNOWN {
            // No step with the cut-off and the condition of the problem was taken.
            self.coupled.configure(problem);
            self.coupled.begin(problem, state)?;
            self.work.convolutions += self.coupled.convolutions;
            self.best_residuals = self.coupled.residuals(problem, state);
            self.best.keep(&self.coupled, state);
        }
        if status != Status::Converged && self.best_residuals.is_finite() {
            if status == Status::Diverged {
                // What was tried last did; before it a state was left.
                status = Status::Stalled;
            }
            // What was tried last may have been another contact film.
            self.coupled.fluid.configure(problem);
            self.best.restore(&mut self.coupled, problem, state);
        }
        Ok((status, self.best_residuals))
    }

    /// From the dry contact by film homotopy if it is `cold` or the state is not near: farther
    /// than [`NewtonSettings::near_below`](super::NewtonSettings::near_below) the dry contact mostly is the
    /// better start.
    pub(super) fn attempt(
        &mut self,
        cold: bool,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        let attempt = self.settings.attempt_on(&problem.grid());
        let homotopy = Homotopy::to(problem);
        let holds_approach = problem.box_load().is_none();
        let attempt = if !cold && (self.begins_near(problem, state)? || holds_approach) {
            Attempt { pseudo_transient: STEADY, ..attempt }
        } else {
            problem.film_cutoff *= attempt.first_contact_film;
            problem.cavitation = Cavitation::Reynolds;
            self.start_dry(problem, state, attempt.start_tolerance)?;
            self.begin(problem, state)?;
            attempt
        };
        let status = self.newton(problem, state, stop, attempt, homotopy)?;
        self.work.convolutions += self.coupled.convolutions;
        homotopy.end(problem);
        Ok(status)
    }

    /// Begins from the state as it is; whether that is near.
    fn begins_near(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<bool, ReynoldsError> {
        self.begin(problem, state)?;
        let near = self.residuals.max() <= self.settings.near_below;
        if !near {
            self.work.convolutions += self.coupled.convolutions;
        }
        Ok(near)
    }

    /// The dry contact under the film cut-off of the problem, to the gap error `tolerance` over the cells in a
    /// half-width: the same error of films is a larger one of the pressures of single nodes on finer meshes.
    fn start_dry(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        tolerance: f64,
    ) -> Result<(), ReynoldsError> {
        state.pressure.fill(0.0);
        let cells = problem.reference_half_widths.0 / problem.grid().dx();
        self.work += self.start.run(problem, state, tolerance / cells)?;
        Ok(())
    }
}

/// Whether a solve that has ended so may be tried in another way.
pub(super) fn may_go_on(status: Status) -> bool {
    matches!(status, Status::Stalled | Status::Diverged)
}
