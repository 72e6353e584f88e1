//! Full multigrid for smooth full films.

mod cycle;
mod level;
mod relax;
mod transfer;

use cycle::Hierarchy;

use super::coupled::Coupled;
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, ReynoldsError, StoppingRule, check_call};
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::report::{Residuals, SolveReport, Status, Work};

/// Cycles without a new best residual after which the solve has stalled.
const PATIENCE: u64 = 3;
/// A residual is better if it is below this share of the best one.
const GAIN: f64 = 0.8;

/// Full multigrid.
#[derive(Debug, Default)]
pub struct Multigrid {
    workspace: Option<Box<Workspace>>,
}

#[derive(Debug)]
struct Workspace {
    hierarchy: Hierarchy,
    coupled: Coupled,
    best: ContactState,
}

impl Multigrid {
    /// A solver; buffers are made at the first solve and kept.
    pub fn new() -> Self {
        Self::default()
    }

    fn wrong(&self, reason: &'static str) -> ReynoldsError {
        ReynoldsError::WrongSolver { solver: self.name(), reason }
    }

    fn workspace(&mut self, problem: &LubricatedContact<'_>, grid: Grid) -> Result<&mut Workspace, ReynoldsError> {
        let fits = self.workspace.as_ref().is_some_and(|w| w.hierarchy.fits(&*problem.deformation));
        if !fits {
            let Some(hierarchy) = Hierarchy::new(&*problem.deformation) else {
                return Err(self.wrong("the deformation model lives on one grid alone"));
            };
            self.workspace = Some(Box::new(Workspace {
                hierarchy,
                coupled: Coupled::new(grid),
                best: ContactState::new(&grid),
            }));
        }
        self.workspace.as_deref_mut().ok_or(ReynoldsError::Memory { nodes: grid.len() })
    }
}

impl ContactSolver for Multigrid {
    fn name(&self) -> &'static str {
        "multigrid"
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        let grid = check_call(problem, state, stop)?;
        let Some(lubricant) = problem.lubricant else {
            return Err(self.wrong("the problem has no lubricant"));
        };
        let solver = self.name();
        let workspace = self.workspace(problem, grid)?;
        let mut work = Work::default();
        let (status, residuals) = workspace.run(problem, lubricant, state, stop, &mut work)?;
        workspace.coupled.mark_contact(state);
        work.convolutions += workspace.hierarchy.convolutions + workspace.coupled.convolutions as f64;
        Ok(SolveReport { solver, status, residuals, work })
    }
}

impl Workspace {
    fn run(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        state: &mut ContactState,
        stop: &StoppingRule,
        work: &mut Work,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        self.coupled.configure(problem);
        self.hierarchy.configure(problem);
        self.hierarchy.start(problem, lubricant)?;
        let mut best = Residuals { mass: f64::INFINITY, ..Residuals::default() };
        let (mut mark, mut fruitless) = (f64::INFINITY, 0);
        let mut status = Status::MaxIterations;
        for cycle in 0..=stop.max_iterations {
            self.take_over(problem, lubricant, state)?;
            let residuals = self.coupled.residuals(problem, state);
            if !residuals.is_finite() {
                status = Status::Diverged;
                break;
            }
            if residuals.max() < best.max() {
                best = residuals;
                self.best.clone_from(state);
            }
            if residuals.max() <= stop.tolerance {
                return Ok((Status::Converged, residuals));
            }
            if best.max() < GAIN * mark {
                (mark, fruitless) = (best.max(), 0);
            } else {
                fruitless += 1;
            }
            if fruitless > PATIENCE {
                status = Status::Stalled;
                break;
            }
            if cycle < stop.max_iterations {
                let top = self.hierarchy.top();
                self.hierarchy.cycle(problem, lubricant, top)?;
                work.iterations += 1;
            }
        }
        state.clone_from(&self.best);
        self.coupled.evaluate(problem, state)?;
        Ok((status, best))
    }

    /// The finest grid's pressure as a state, evaluated, and its film back.
    fn take_over(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        state: &mut ContactState,
    ) -> Result<(), ReynoldsError> {
        state.approach = self.hierarchy.approach;
        let finest = self.hierarchy.finest_mut();
        state.pressure.copy_from_slice(&finest.pressure);
        state.fluid_pressure.copy_from_slice(&finest.pressure);
        self.coupled.evaluate(problem, state)?;
        finest.film.copy_from_slice(&self.coupled.elastic_film);
        finest.take_film(lubricant);
        Ok(())
    }
}
