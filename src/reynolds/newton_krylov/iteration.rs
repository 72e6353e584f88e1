//! Newton steps, one after the other.

use super::Workspace;
use super::globalisation::Globalisation;
use super::homotopy::Homotopy;
use super::settings::Attempt;
use crate::report::Status;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;
use crate::reynolds::{ReynoldsError, StoppingRule};

impl Workspace {
    /// Takes over the problem and evaluates a state of unknown origin.
    pub(super) fn begin(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<(), ReynoldsError> {
        self.coupled.configure(problem);
        self.coupled.begin(problem, state)?;
        self.residuals = self.coupled.residuals(problem, state);
        Ok(())
    }

    /// Newton steps from a state that has begun until `stop` or a stall, along the `homotopy`. Keeps the best
    /// state of the solve.
    pub(super) fn newton(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        attempt: Attempt,
        homotopy: Homotopy,
    ) -> Result<Status, ReynoldsError> {
        let left = stop.max_iterations.saturating_sub(self.work.iterations);
        let mut globalisation = Globalisation::new(attempt, problem.reference_pressure);
        for iteration in 0..=left {
            if !self.residuals.is_finite() {
                return Ok(Status::Diverged);
            }
            if homotopy.may_end(problem, self.residuals.max(), &self.settings) {
                homotopy.end(problem);
                self.coupled.fluid.configure(problem);
                self.coupled.refresh(problem, state);
                self.residuals = self.coupled.residuals(problem, state);
            }
            self.history.push(self.residuals);
            // Residuals of other equations than those of the problem tell nothing of its solution.
            if !homotopy.is_on(problem)
                && let Some(status) = self.judge(state, stop)
            {
                return Ok(status);
            }
            globalisation.watch(self.residuals.max(), homotopy.eases_films(problem), &self.settings);
            if globalisation.has_stalled() {
                return Ok(Status::Stalled);
            }
            if iteration == left {
                break;
            }
            if !self.step(problem, state, &mut globalisation, homotopy)? {
                return Ok(Status::Diverged);
            }
        }
        Ok(Status::MaxIterations)
    }

    /// Keeps the state if it is the best so far; the status with which the solve ends here, if it does.
    fn judge(&mut self, state: &ContactState, stop: &StoppingRule) -> Option<Status> {
        if self.residuals.max() < self.best_residuals.max() {
            (self.best_residuals, self.best_strategy) = (self.residuals, self.strategy);
            self.best.keep(&self.coupled, state);
        }
        (self.residuals.max() <= stop.tolerance).then_some(Status::Converged)
    }

    /// One Newton step; false where its equations have no solution.
    fn step(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        globalisation: &mut Globalisation,
        homotopy: Homotopy,
    ) -> Result<bool, ReynoldsError> {
        self.work.iterations += 1;
        let (before, is_on) = (self.residuals.max(), homotopy.is_on(problem));
        let eases_films = homotopy.eases_films(problem);
        if is_on {
            homotopy.go_on(problem);
            self.coupled.fluid.configure(problem);
            // The flow follows below.
            self.coupled.apply_plastic_depth(problem, state);
        }
        let pseudo_transient = globalisation.next_pseudo_transient(before, is_on, &self.settings);
        self.coupled.fluid.set_pseudo_transient(pseudo_transient);
        self.close_contact(problem, state);
        let tolerance = globalisation.attempt.krylov_tolerance;
        let Some(krylov_steps) = self.linear_step(problem, state, tolerance)? else {
            return Ok(false);
        };
        self.work.inner_iterations += krylov_steps;
        let growth = globalisation.growth(eases_films);
        self.residuals = self.advance_carefully(problem, state, globalisation.trust, before, growth)?;
        globalisation.adapt(self.unforeseen_share(state, problem.contact_film()));
        Ok(true)
    }
}
