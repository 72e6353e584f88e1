//! Continuation in the contact film: where the attempt stalls, contacts with thicker ones are solved first.

use super::Workspace;
use super::attempt::{Start, is_recoverable};
use super::globalization::Globalization;
use crate::report::{Residuals, Status};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;
use crate::reynolds::{ReynoldsError, StoppingRule};
use crate::strategy::Strategy;

/// Ratio of the contact films that are tried in turn, and their number at most.
const DOUBLED: f64 = 2.0;
const DOUBLINGS: i32 = 8;

impl Workspace {
    /// Whether solids touch in `state`, or would with the contact film from which the attempt starts.
    pub(super) fn may_continue(&self, problem: &LubricatedContact<'_>, state: &ContactState) -> bool {
        let thickest = self.settings.first_contact_film.max(DOUBLED) * problem.film_cutoff;
        self.settings.least_film_ratio < DOUBLED && state.film.iter().any(|&film| film < thickest)
    }

    /// Solves the problem by continuation. Where that fails the best state so far remains the best.
    pub(super) fn continue_in_contact_film(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        let film_cutoff = problem.film_cutoff;
        let kept = self.newton.record.best.clone();
        self.newton.record.strategy = Strategy::Continuation;
        let status = self.raise_contact_film(problem, state, stop)?;
        problem.film_cutoff = film_cutoff;
        if status != Status::Converged {
            self.newton.record.best = kept;
        }
        Ok(status)
    }

    /// Doubles the contact film until the attempt converges, and lowers that of its solution again. Leaves another
    /// cut-off in the problem.
    fn raise_contact_film(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        let film_cutoff = problem.film_cutoff;
        for doubling in 1..=DOUBLINGS {
            // Start from the dry contact with a contact film twice as thick as before.
            let ratio = DOUBLED.powi(doubling);
            problem.film_cutoff = ratio * film_cutoff;
            self.newton.record.best.residuals = Residuals::UNKNOWN;
            let status = self.attempt(Start::Dry, problem, state, stop)?;
            if status == Status::Converged {
                // Continue the solution to the contact film of the problem.
                problem.film_cutoff = film_cutoff;
                return self.lower_contact_film(problem, state, stop, ratio);
            }
            if !is_recoverable(status) {
                return Ok(status);
            }
        }
        Ok(Status::Stalled)
    }

    /// Lowers the contact film of a solution from `ratio` times that of the problem to it, in as few steps as
    /// converge. Leaves another cut-off in the problem.
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
                // A step of twice the length in the logarithm.
                (ratio, step) = (next, step * step);
                solved.clone_from(state);
            } else {
                // Half the length.
                step = (ratio / next).sqrt();
                if !is_recoverable(status) || step < self.settings.least_film_ratio {
                    return Ok(status);
                }
                state.clone_from(&solved);
            }
        }
        Ok(Status::Converged)
    }

    /// Solves from the solution with another contact film.
    fn follow(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        self.newton.record.best.residuals = Residuals::UNKNOWN;
        let mut globalization = Globalization::new(problem, &self.settings);
        globalization.for_continuation();
        self.newton.evaluate(problem, state)?;
        self.iterate(problem, state, stop, &mut globalization)
    }
}
