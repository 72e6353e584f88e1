//! Picks the solver by what the scene holds.

use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, Dry, NewtonKrylov, ReynoldsError, SemiSystem, StoppingRule};
use crate::report::{SolveReport, Status};

/// [`Dry`] without a lubricant, else [`NewtonKrylov`]; where that does not converge although no solids touch,
/// [`SemiSystem`] tries, which in solid contact would not. The report names the solver whose state was kept and counts
/// the work of all.
#[derive(Debug, Default)]
pub struct Auto {
    dry: Dry,
    newton: NewtonKrylov,
    sweeps: SemiSystem,
    kept: Option<ContactState>,
}

impl Auto {
    /// A solver; each method makes its buffers when it is first used.
    pub fn new() -> Self {
        Self::default()
    }

    /// A solver that takes a dry contact at the edge of the box as it is (see [`Dry::allowing_edge_contact`]).
    pub fn allowing_edge_contact() -> Self {
        Self { dry: Dry::allowing_edge_contact(), ..Self::default() }
    }
}

impl ContactSolver for Auto {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        if problem.lubricant.is_none() {
            return self.dry.solve(problem, state, stop);
        }
        let first = self.newton.solve(problem, state, stop)?;
        if first.status == Status::Converged || state.in_contact.contains(&true) {
            return Ok(first);
        }
        let kept = self.kept.get_or_insert_with(|| state.clone());
        kept.clone_from(state);
        let mut second = self.sweeps.solve(problem, state, stop)?;
        second.work += first.work;
        let off_load = second.residuals.load > first.residuals.load.max(stop.tolerance);
        if second.residuals.max() <= first.residuals.max() && !off_load {
            return Ok(second);
        }
        state.clone_from(kept);
        Ok(SolveReport { work: second.work, ..first })
    }
}
