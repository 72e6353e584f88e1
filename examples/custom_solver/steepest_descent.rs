//! A solver of one's own; `work_precision` enters it in its chart.

use stribeck::reynolds::{ContactSolver, ContactState, Evaluation, LubricatedContact};
use stribeck::reynolds::{ReynoldsError, StoppingRule};
use stribeck::{SolveReport, SolverId, Status, Work};

/// Dry elastic contact by steepest descent; pressures that turn negative are cut off, the load is shared out
/// anew.
#[derive(Debug, Clone)]
pub(crate) struct SteepestDescent;

impl ContactSolver for SteepestDescent {
    fn id(&self) -> SolverId {
        SolverId::Custom("steepest_descent")
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        if problem.lubricant.is_some() {
            return Err(ReynoldsError::WrongSolver { solver: self.id(), reason: "it is for dry contacts" });
        }
        let (grid, mut work) = (problem.grid(), Work::default());
        let (nx, ny, mut evaluation) = (grid.nx(), grid.ny(), Evaluation::new(grid));
        let inner = |k: usize| (1..nx - 1).contains(&(k % nx)) && (1..ny - 1).contains(&(k / nx));
        if state.pressure.iter().all(|p| *p <= 0.0) {
            (0..nx * ny).filter(|k| inner(*k)).for_each(|k| state.pressure[k] = problem.reference_pressure);
        }
        let (mut step, mut answer) = (vec![0.0; nx * ny], vec![0.0; nx * ny]);
        loop {
            let carried = state.pressure.iter().sum::<f64>() * grid.cell_area();
            state.pressure.iter_mut().for_each(|p| *p *= problem.load / carried);
            // Films and residuals as all solvers report them.
            let residuals = evaluation.evaluate(problem, state)?;
            work.convolutions += 2.0;
            let converged = residuals.max() <= stop.tolerance;
            if converged || work.iterations == stop.max_iterations {
                let status = if converged { Status::Converged } else { Status::MaxIterations };
                return Ok(SolveReport::new(self.id(), status, residuals).with_work(work));
            }
            work.iterations += 1;
            // The bodies come closer until the gaps under pressure are those of contact on average.
            let touching = || (0..nx * ny).filter(|k| state.pressure[*k] > 0.0);
            let level = touching().map(|k| state.film[k]).sum::<f64>() / touching().count() as f64;
            for (k, step) in step.iter_mut().enumerate() {
                let gap = state.film[k] - level;
                *step = if inner(k) && (state.pressure[k] > 0.0 || gap < 0.0) { -gap } else { 0.0 };
            }
            state.approach += level - problem.contact_film();
            problem.deformation.displacement(&step, &mut answer)?;
            let sum = |other: &[f64]| step.iter().zip(other).map(|(s, o)| s * o).sum::<f64>();
            let length = sum(&step) / sum(&answer);
            state.pressure.iter_mut().zip(&step).for_each(|(p, s)| *p = (*p + length * s).max(0.0));
        }
    }
}
