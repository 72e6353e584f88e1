//! What a solve tries, one attempt after the other.

use super::Workspace;
use super::homotopy::Homotopy;
use super::progress::Progress;
use super::settings::{Attempt, STEADY};
use crate::report::{Residuals, Status, Work};
use crate::reynolds::flow::Cavitation;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;
use crate::reynolds::{ReynoldsError, StoppingRule};
use crate::strategy::Strategy;

impl Workspace {
    /// Solves from the state as it is if it carries pressure and is near; else, and again where that stalls,
    /// from the dry contact; at last by another way. Leaves the best state.
    pub(super) fn run(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        (self.progress, self.work) = (Progress::new(&problem.grid()), Work::default());
        self.history.clear();
        self.strategy = Strategy::Attempt(1);
        self.best_strategy = self.strategy;
        let mut status = self.all_attempts(problem, state, stop)?;
        let is_stuck = matches!(status, Status::Stalled | Status::Diverged);
        let may_follow = self.settings.follows_time && problem.lubricant.is_some();
        if is_stuck && may_follow && problem.entrainment_speed > 0.0 {
            let (residuals, best, strategy) = (self.best_residuals, self.best.clone(), self.best_strategy);
            if self.take_another_way(problem, state, stop)? {
                status = Status::Converged;
            } else {
                (self.best_residuals, self.best, self.best_strategy) = (residuals, best, strategy);
                self.coupled.configure(problem);
            }
        }
        if status != Status::Converged && self.best_residuals.mass == f64::INFINITY {
            // No step with the cut-off and the condition of the problem was taken.
            self.coupled.configure(problem);
            self.coupled.begin(problem, state)?;
            self.work.convolutions += self.coupled.convolutions;
            self.best_residuals = self.coupled.residuals(problem, state);
            self.best.keep(&self.coupled, state);
        }
        self.coupled.fluid.set_cavitation(problem.cavitation);
        if status != Status::Converged && self.best_residuals.is_finite() {
            if status == Status::Diverged {
                // The last attempt did; an earlier one has left a state.
                status = Status::Stalled;
            }
            self.best.restore(&mut self.coupled, problem, state);
        }
        if status == Status::MaxIterations && self.progress.has_ended() {
            status = Status::Stalled;
        }
        Ok((status, self.best_residuals))
    }

    /// The attempts of the settings.
    pub(super) fn all_attempts(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        let attempts = std::mem::take(&mut self.settings.attempts);
        let status = self.attempts(&attempts, problem, state, stop);
        self.settings.attempts = attempts;
        status
    }

    /// One attempt after the other until one does not stall, the first from the state as it is if it carries
    /// pressure, all others from the dry contact. Keeps the best state of all.
    pub(super) fn attempts(
        &mut self,
        attempts: &[Attempt],
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        self.best_residuals = Residuals { mass: f64::INFINITY, ..Residuals::default() };
        let mut status = Status::Stalled;
        for (index, attempt) in attempts.iter().enumerate() {
            if matches!(status, Status::Converged | Status::MaxIterations) {
                break;
            }
            if let Strategy::Attempt(number) = &mut self.strategy {
                *number = index + 1;
            }
            let cold = index > 0 || state.pressure.iter().all(|&p| p <= 0.0);
            let film_cutoff = problem.film_cutoff;
            let ended = self.attempt(*attempt, cold, problem, state, stop);
            problem.film_cutoff = film_cutoff;
            status = ended?;
            self.work.convolutions += self.coupled.convolutions;
        }
        Ok(status)
    }

    /// One attempt, from the dry contact by film homotopy if it is `cold` or the state is not near: farther
    /// than [`NewtonSettings::near_below`](super::NewtonSettings::near_below) the dry contact mostly is the
    /// better start. Contacts on another way are taken as they are. Leaves another cut-off in the problem.
    fn attempt(
        &mut self,
        attempt: Attempt,
        cold: bool,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        let given = Homotopy { film_cutoff: problem.film_cutoff, condition: problem.cavitation };
        if !cold {
            self.begin(problem, state, given)?;
            let on_another_way = !matches!(self.strategy, Strategy::Attempt(_));
            if on_another_way || self.residuals.max() <= self.settings.near_below {
                let steadily = Attempt { pseudo_transient: STEADY, ..attempt };
                return self.newton(problem, state, stop, steadily, given);
            }
            self.work.convolutions += self.coupled.convolutions;
        }
        let first = attempt.first_contact_film * problem.film_cutoff;
        if attempt.gentle {
            problem.film_cutoff = first;
        }
        self.start_dry(problem, state, attempt.start_tolerance)?;
        problem.film_cutoff = first;
        let homotopy = Homotopy { condition: Cavitation::Reynolds, ..given };
        self.begin(problem, state, homotopy)?;
        self.newton(problem, state, stop, attempt, homotopy)
    }

    /// The dry contact under the film cut-off of the problem, to the gap error `tolerance` over the cells in a
    /// half-width: the same error of films is a larger one of the pressures of single nodes on finer meshes.
    pub(super) fn start_dry(
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
