//! A solver of one's own, driven by the same simulation, and its work beside that of the solver of the crate.
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

use stribeck::reynolds::{
    ContactSolver, ContactState, Evaluation, LubricatedContact, ReynoldsError, StoppingRule,
};
use stribeck::sim::{MixedLubricationSim, Scene, SimError};
use stribeck::{SolveReport, Status, Work};

/// Dry elastic contact by steepest descent on the nodes that touch; pressures that turn negative are cut off and the load
/// is shared out anew.
#[derive(Debug, Default)]
struct SteepestDescent {
    step: Vec<f64>,
    answer: Vec<f64>,
}

impl ContactSolver for SteepestDescent {
    fn name(&self) -> &'static str {
        "steepest_descent"
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        if problem.lubricant.is_some() {
            return Err(ReynoldsError::WrongSolver { solver: self.name(), reason: "it is for dry contacts" });
        }
        let (grid, mut work) = (problem.grid(), Work::default());
        let (nx, ny, mut evaluation) = (grid.nx(), grid.ny(), Evaluation::new(grid));
        let inner = |k: usize| (1..nx - 1).contains(&(k % nx)) && (1..ny - 1).contains(&(k / nx));
        if state.pressure.iter().all(|p| *p <= 0.0) {
            (0..nx * ny).filter(|k| inner(*k)).for_each(|k| state.pressure[k] = problem.reference_pressure);
        }
        self.step.resize(nx * ny, 0.0);
        self.answer.resize(nx * ny, 0.0);
        loop {
            let carried = state.pressure.iter().sum::<f64>() * grid.cell_area();
            state.pressure.iter_mut().for_each(|p| *p *= problem.load / carried);
            let residuals = evaluation.evaluate(problem, state)?;
            work.convolutions += 1.0;
            let converged = residuals.max() <= stop.tolerance;
            if converged || work.iterations == stop.max_iterations {
                let status = if converged { Status::Converged } else { Status::MaxIterations };
                return Ok(SolveReport { solver: self.name(), status, residuals, work });
            }
            work.iterations += 1;
            // The bodies come closer until the gaps under pressure are those of contact on average.
            let touching = || (0..grid.len()).filter(|k| state.pressure[*k] > 0.0);
            let level = touching().map(|k| state.film[k]).sum::<f64>() / touching().count() as f64;
            for (k, step) in self.step.iter_mut().enumerate() {
                let gap = state.film[k] - level;
                *step = if inner(k) && (state.pressure[k] > 0.0 || gap < 0.0) { -gap } else { 0.0 };
            }
            state.approach += level - problem.contact_film();
            problem.deformation.displacement(&self.step, &mut self.answer)?;
            work.convolutions += 1.0;
            let along: f64 = self.step.iter().map(|s| s * s).sum();
            let curvature: f64 = self.step.iter().zip(&self.answer).map(|(s, a)| s * a).sum();
            for (p, step) in state.pressure.iter_mut().zip(&self.step) {
                *p = (*p + along / curvature * step).max(0.0);
            }
        }
    }
}

fn main() -> Result<(), SimError> {
    let mut scene = Scene::azam_2019(48);
    (scene.lubricant, scene.plastic) = (None, None);
    println!("{:>9} {:>22} {:>22}", "residual", "own: convolutions", "crate: convolutions");
    for tolerance in [1e-2, 1e-3, 1e-4] {
        scene.solver.tolerance = tolerance;
        let build = || MixedLubricationSim::builder(scene.clone());
        let own = build().solver(SteepestDescent::default()).build()?.step(10.0)?;
        let crates = build().build()?.step(10.0)?;
        println!(
            "{tolerance:9.0e} {:22} {:22}",
            own.report.work.convolutions, crates.report.work.convolutions
        );
        assert!((own.area_ratio / crates.area_ratio - 1.0).abs() < 0.05, "both find the same contact");
    }
    Ok(())
}
