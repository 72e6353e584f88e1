//! Continuation in the contact film: where the attempt stalls, contacts with thicker ones are solved first.

use super::Workspace;
use super::attempt::may_go_on;
use super::homotopy::Homotopy;
use super::settings::Attempt;
use crate::report::{Residuals, Status};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;
use crate::reynolds::{ReynoldsError, StoppingRule};
use crate::strategy::Strategy;

/// Thicker contact films are tried in this ratio, so many at most.
const DOUBLED: f64 = 2.0;
const DOUBLINGS: i32 = 8;
/// Pseudo-transient term of a step in time in which the fluid passes one cell.
const CELL_PASSAGE: f64 = 1.0;

impl Workspace {
    /// Whether solids touch in `state`, or would with the contact film from which the attempt starts.
    pub(super) fn can_continue(&self, problem: &LubricatedContact<'_>, state: &ContactState) -> bool {
        let thickest = self.settings.attempt.first_contact_film.max(DOUBLED) * problem.film_cutoff;
        self.settings.least_film_ratio < DOUBLED && state.film.iter().any(|&film| film < thickest)
    }

    /// Solves the problem by way of thicker contact films. Where that fails the best state so far stays the best.
    pub(super) fn continue_in_contact_film(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        let film_cutoff = problem.film_cutoff;
        let kept = (self.best.clone(), self.best_residuals, self.best_strategy);
        self.strategy = Strategy::Continuation;
        let status = self.by_thicker_film(problem, state, stop)?;
        problem.film_cutoff = film_cutoff;
        if status != Status::Converged {
            (self.best, self.best_residuals, self.best_strategy) = kept;
        }
        Ok(status)
    }

    /// Doubles the contact film until the attempt converges, and lowers that of its solution again. Leaves another
    /// cut-off in the problem.
    fn by_thicker_film(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        let film_cutoff = problem.film_cutoff;
        for doubling in 1..=DOUBLINGS {
            let ratio = DOUBLED.powi(doubling);
            problem.film_cutoff = ratio * film_cutoff;
            self.best_residuals = Residuals::UNKNOWN;
            let status = self.attempt(true, problem, state, stop)?;
            if status == Status::Converged {
                problem.film_cutoff = film_cutoff;
                return self.lower_contact_film(problem, state, stop, ratio);
            }
            if !may_go_on(status) {
                return Ok(status);
            }
        }
        Ok(Status::Stalled)
    }

    /// Lowers the contact film of a solution from `ratio` times that of the problem to it, in as many steps as it
    /// takes. Leaves another cut-off in the problem.
    fn lower_contact_film(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        mut ratio: f64,
    ) -> Result<Status, ReynoldsError> {
        let film_cutoff = problem.film_cutoff;
        let (mut solved, mut step) = (state.clone(), ratio);
        while ratio > 1.0 {
            let next = (ratio / step).max(1.0);
            problem.film_cutoff = next * film_cutoff;
            let status = self.follow(problem, state, stop)?;
            if status == Status::Converged {
                (ratio, step) = (next, step * step);
                solved.clone_from(state);
            } else {
                step = (ratio / next).sqrt();
                if !may_go_on(status) || step < self.settings.least_film_ratio {
                    return Ok(status);
                }
                state.clone_from(&solved);
            }
        }
        Ok(Status::Converged)
    }

    /// Solves from a solution with another contact film: by whole steps, as shortened ones come back to the same
    /// states where a few nodes of a pocket cavitate and open in turn, and by shorter steps in time than those
    /// that have stalled, which grow half as fast.
    fn follow(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        self.best_residuals = Residuals::UNKNOWN;
        let attempt = self.settings.attempt_on(&problem.grid());
        let pseudo_transient = (CELL_PASSAGE, attempt.pseudo_transient.1.sqrt());
        let following = Attempt { growth: f64::INFINITY, pseudo_transient, ..attempt };
        self.begin(problem, state)?;
        let status = self.newton(problem, state, stop, following, Homotopy::to(problem))?;
        self.work.convolutions += self.coupled.convolutions;
        Ok(status)
    }
}
