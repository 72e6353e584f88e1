//! Contact solvers written in Python. The crate evaluates their states.

use std::fmt;
use std::sync::Arc;

use pyo3::prelude::*;
use stribeck::reynolds::{
    ContactSolver, ContactState, Evaluation, LubricatedContact, ReynoldsError, StoppingRule,
};
use stribeck::{InputError, SolveReport, SolverId, Status};

use super::problem::{Problem, read_state, state_of_arrays};
use super::{Deformation, Failure, Function};
use crate::convert::shown;
use crate::error::raise;

/// A solver: `solve(problem, state)` writes pressures and approach into the state and returns whether it
/// converged.
#[derive(Clone)]
pub(crate) struct Solver {
    function: Arc<Function>,
    /// The model in Python that stands in place of that of the scene.
    deformation: Option<Deformation>,
    evaluation: Evaluation,
}

impl fmt::Debug for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.function.fmt(f)
    }
}

impl Solver {
    pub(crate) fn new(function: Function, deformation: Option<Deformation>) -> Self {
        let evaluation = Evaluation::new(function.grid);
        Self { function: Arc::new(function), deformation, evaluation }
    }

    /// Calls the function; whether it says that it has converged.
    fn call(
        &self,
        py: Python<'_>,
        problem: &LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> PyResult<bool> {
        let model = problem.deformation.on_grid(problem.grid());
        let model = model.or_else(|| self.deformation.clone().map(|model| Box::new(model) as _));
        let Some(model) = model else {
            let message = "solver: the deformation model lives on one grid alone";
            return Err(raise(py, "SolverError", message, Some("deformation"), None));
        };
        let grid = problem.grid();
        let problem = Bound::new(py, Problem::of(problem, model, stop, Arc::clone(&self.function)))?;
        let given = state_of_arrays(py, &grid, state)?;
        let returned = self.function.call(py, vec![problem.into_any(), given.clone()])?;
        read_state(&self.function, &given, state)?;
        returned.extract().map_err(|_| {
            let found = shown(&returned);
            let message =
                format!("must return True where it has converged and False where not, it returned {found}");
            self.function.refused(py, &message, returned)
        })
    }
}

impl ContactSolver for Solver {
    fn id(&self) -> SolverId {
        SolverId::Custom("python")
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        self.check(problem, state, stop)?;
        let called = Python::attach(|py| self.call(py, problem, state, stop));
        let converged = called.map_err(|error| {
            let reason = format!("it raised an exception: {error}");
            Failure.keep(error);
            InputError::Conflict { field: "solver".to_owned(), reason }
        })?;
        let residuals = self.evaluation.evaluate(problem, state)?;
        let status = if converged { Status::Converged } else { Status::Stalled };
        Ok(SolveReport::new(self.id(), status, residuals))
    }
}
