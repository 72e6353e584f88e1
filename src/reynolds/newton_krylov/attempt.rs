//! A solve: an attempt from the given state, a coarser grid or the dry contact, and continuation where that stalls.

use super::Workspace;
use super::globalization::Globalization;
use super::settings::START_TOLERANCE;
use super::soft_start::{FROM_COARSE, FROM_DRY, is_soft};
use crate::report::{Residuals, Status};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;
use crate::reynolds::{ReynoldsError, StoppingRule};

/// Where an attempt starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Start {
    /// The given state, if that is a warm start.
    Given,
    /// The dry contact.
    Dry,
    /// As soft bodies do, with this pseudo-transient term and its reduction behind a coarser grid.
    Soft((f64, f64)),
}

impl Workspace {
    /// Solves from the given state if that is a warm start, else from the dry contact, soft bodies from coarser grids;
    /// where that stalls, by continuation in the contact film. Leaves the best state.
    pub(super) fn run(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        self.newton.record.clear();
        let is_cold = state.pressure.iter().all(|&p| p <= 0.0);
        let start = match is_cold {
            false => Start::Given,
            true if is_soft(problem) => Start::Soft(FROM_COARSE),
            true => Start::Dry,
        };
        let mut status = self.attempt(start, problem, state, stop)?;
        // Where the coarser grid is far from the solution, a larger pseudo-transient term converges.
        if is_recoverable(status) && start == Start::Soft(FROM_COARSE) {
            status = self.attempt(Start::Soft(FROM_DRY), problem, state, stop)?;
        }
        if is_recoverable(status) && problem.box_load().is_some() && self.may_continue(problem, state) {
            status = self.continue_in_contact_film(problem, state, stop)?;
        }
        let best = self.newton.record.best.residuals;
        if status != Status::Converged && best == Residuals::UNKNOWN {
            // No state with contact film and cavitation of the problem was evaluated.
            let residuals = self.newton.evaluate(problem, state)?;
            self.count_convolutions();
            self.newton.record.best.residuals = residuals;
            self.newton.record.best.state.save(&self.newton.coupled, state);
        }
        let best = self.newton.record.best.residuals;
        if status != Status::Converged && best.is_finite() {
            if status == Status::Diverged {
                // The last attempt diverged; an earlier state remains.
                status = Status::Stalled;
            }
            // The last attempt may have had another contact film.
            self.newton.coupled.fluid.configure(problem);
            self.newton.record.best.state.restore(&mut self.newton.coupled, problem, state)?;
        }
        Ok((status, best))
    }

    /// Newton's method from `start`: from the given state only if its residual is low enough, or the approach is held,
    /// else by homotopy from the dry contact, which then is mostly the better start.
    pub(super) fn attempt(
        &mut self,
        start: Start,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<Status, ReynoldsError> {
        let mut globalization = Globalization::new(problem, &self.settings);
        // A warm start, the solution on a coarser grid, or the dry contact with a thick contact film.
        let holds_approach = problem.box_load().is_none();
        if start == Start::Given && (self.is_warm_start(problem, state)? || holds_approach) {
            globalization.for_warm_start();
        } else {
            let is_started = match start {
                Start::Soft(terms) => self.start_soft(problem, state, stop, (&mut globalization, terms))?,
                Start::Given | Start::Dry => false,
            };
            if !is_started {
                globalization.start_homotopy(problem);
                self.start_dry(problem, state)?;
            }
            self.newton.evaluate(problem, state)?;
        }
        // Iterate, and give the problem its own equations back.
        let status = self.iterate(problem, state, stop, &mut globalization)?;
        globalization.finish_homotopy(problem);
        Ok(status)
    }

    /// Newton steps from an evaluated state, their convolutions counted.
    pub(super) fn iterate(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        globalization: &mut Globalization,
    ) -> Result<Status, ReynoldsError> {
        let tolerance = self.settings.linear_tolerance(problem.grid().ny());
        let status = self.newton.iterate(problem, state, stop, globalization, tolerance)?;
        self.count_convolutions();
        Ok(status)
    }

    /// Evaluates the given state; whether its residual is that of a warm start.
    fn is_warm_start(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<bool, ReynoldsError> {
        let residuals = self.newton.evaluate(problem, state)?;
        let is_warm = residuals.max() <= self.settings.warm_start_threshold;
        if !is_warm {
            self.count_convolutions();
        }
        Ok(is_warm)
    }

    /// The dry contact under the film cut-off of the problem, to a gap error over the cells in a half-width: the
    /// same error of films is a larger one of the pressures of single nodes on finer meshes.
    fn start_dry(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<(), ReynoldsError> {
        state.pressure.fill(0.0);
        let cells = problem.reference_half_widths.0 / problem.grid().dx();
        self.newton.record.work += self.start.run(problem, state, START_TOLERANCE / cells)?;
        Ok(())
    }

    /// Adds the convolutions since the last evaluation of a state of unknown origin to the work.
    fn count_convolutions(&mut self) {
        self.newton.record.work.convolutions += self.newton.coupled.convolutions;
    }
}

/// Whether another strategy may follow an attempt that ended so.
pub(super) fn is_recoverable(status: Status) -> bool {
    matches!(status, Status::Stalled | Status::Diverged)
}
