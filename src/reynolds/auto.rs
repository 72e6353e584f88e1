//! Picks the solver by what the scene holds.

use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, Dry, Multigrid, NewtonKrylov, ReynoldsError, SemiSystem, StoppingRule, check_call};
use crate::report::{SolveReport, Status};

/// [`Dry`] without a lubricant. [`Multigrid`] where a smooth full film is expected; [`NewtonKrylov`] finishes what
/// that leaves above the tolerance, and solves all the rest. Where it does not converge although no solids touch,
/// [`SemiSystem`] tries, which in solid contact would not. The report names the solver whose state was kept
/// (`"multigrid+newton_krylov"` if the second finished what the first began) and counts the work of all.
#[derive(Debug, Default)]
pub struct Auto {
    dry: Dry,
    multigrid: Multigrid,
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
        check_call(problem, state, stop)?;
        if !Multigrid::suits(problem) {
            return self.newton_then_sweeps(problem, state, stop);
        }
        let given = self.kept.get_or_insert_with(|| state.clone());
        given.clone_from(state);
        let mut first = self.multigrid.solve(problem, state, stop)?;
        if first.status == Status::Converged {
            return Ok(first);
        }
        let is_full_film = first.residuals.is_finite() && first.residuals.complementarity <= stop.tolerance;
        if is_full_film {
            let finish = self.newton.solve(problem, state, stop)?;
            first.work += finish.work;
            if finish.status == Status::Converged {
                return Ok(SolveReport { solver: "multigrid+newton_krylov", work: first.work, ..finish });
            }
        }
        if let Some(given) = &self.kept {
            state.clone_from(given);
        }
        let mut second = self.newton_then_sweeps(problem, state, stop)?;
        second.work += first.work;
        if first.status == Status::MeshTooCoarse && second.status != Status::Converged {
            second.status = Status::MeshTooCoarse;
        }
        Ok(second)
    }
}

impl Auto {
    fn newton_then_sweeps(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
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
