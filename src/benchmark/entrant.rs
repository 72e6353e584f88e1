//! The solver of a contestant within a contact: metered, timed, and checked.

use std::fmt;
use std::sync::Arc;

use super::check;
use super::clock::Stopwatch;
use super::contestant::Maker;
use super::metered::{Fault, Meter, Metered};
use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::report::{SolveReport, Status};
use crate::reynolds::{ContactSolver, ContactState, LubricatedContact, ReynoldsError, StoppingRule};
use crate::sim::Scene;
use crate::solver_id::SolverId;

/// A contact solver that runs that of a contestant.
pub(super) struct Entrant {
    maker: Maker,
    scene: Arc<Scene>,
    meter: Arc<Meter>,
    /// Solves of the first contact, over which its seconds are the mean.
    repeats: u32,
    solver: Option<Box<dyn ContactSolver>>,
}

impl fmt::Debug for Entrant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Entrant")
    }
}

impl Clone for Entrant {
    /// The copy makes its own solver.
    fn clone(&self) -> Self {
        Self {
            maker: self.maker.clone(),
            scene: Arc::clone(&self.scene),
            meter: Arc::clone(&self.meter),
            repeats: self.repeats,
            solver: None,
        }
    }
}

impl Entrant {
    pub(super) fn new(maker: Maker, scene: Arc<Scene>, meter: Arc<Meter>, repeats: u32) -> Self {
        Self { maker, scene, meter, repeats, solver: None }
    }

    /// Solves the contact from `state` again, by a new solver each time, without effect on it.
    fn repeat(
        &self,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
        stop: &StoppingRule,
    ) -> Result<(), ReynoldsError> {
        for _ in 1..self.repeats {
            let mut state = state.clone();
            let mut solver = self.maker.solver(&self.scene, problem)?;
            // The last solve is the one that counts.
            drop(solver.solve(problem, &mut state, stop)?);
        }
        Ok(())
    }

    /// Reports faults of a returned state.
    fn check_state(
        &self,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
        report: &SolveReport,
        tolerance: f64,
    ) -> Result<(), ReynoldsError> {
        if let Err(error) = state.validate(&problem.grid()) {
            self.meter.report(Fault::WrongGrid(format!("returned a state that does not fit: {error}")));
            return Err(error.into());
        }
        if report.status == Status::Converged
            && let Some(contradiction) = check::contradiction(problem, state, tolerance)?
        {
            self.meter.report(Fault::FalselyConverged(contradiction));
        }
        Ok(())
    }
}

impl ContactSolver for Entrant {
    fn id(&self) -> SolverId {
        self.solver.as_ref().map_or(SolverId::Custom("contestant"), |solver| solver.id())
    }

    fn check(
        &self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        stop: &StoppingRule,
    ) -> Result<(), ReynoldsError> {
        self.maker.solver(&self.scene, problem)?.check(problem, state, stop)
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        let nodes = problem.grid().len();
        let meter = Arc::clone(&self.meter);
        let watch = Stopwatch::start();
        let (mut solver, solves) = match self.solver.take() {
            Some(solver) => (solver, 1),
            None => {
                self.repeat(problem, state, stop)?;
                (self.maker.solver(&self.scene, problem)?, self.repeats)
            }
        };
        let model: &mut dyn DeformationModel = &mut *problem.deformation;
        let mut metered = Metered { model, meter, nodes };
        let solved =
            solver.solve(&mut LubricatedContact { deformation: &mut metered, ..*problem }, state, stop);
        self.meter.add_seconds(watch.seconds() / f64::from(solves));
        self.solver = Some(solver);
        if self.meter.is_exceeded() {
            let reason = "the budget is used up".to_owned();
            return Err(InputError::Conflict { field: "solve".to_owned(), reason }.into());
        }
        let report = solved?;
        self.check_state(problem, state, &report, stop.tolerance)?;
        Ok(report)
    }
}
