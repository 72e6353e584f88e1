//! Starts of smooth full films of soft bodies: a large pseudo-transient term on a coarse grid, then nested grids.
//!
//! In the dry contact of soft bodies no film is entrained, and pressures too low to thicken the oil do not keep films in
//! place: with the usual pseudo-transient term, films under the outlet oscillate for hundreds of steps.

use super::globalization::Globalization;
use super::{NewtonKrylov, Workspace};
use crate::elastic::DeformationModel;
use crate::grid::Grid;
use crate::report::Status;
use crate::reynolds::multigrid::{Transfer, coarser, expects_full_film};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;
use crate::reynolds::{ContactSolver, EdgePressure, ReynoldsError, StoppingRule, outermost};

/// Expected film over contact film from which on no solids are expected.
const FILM_OVER_CONTACT: f64 = 10.0;
/// Viscosity at the reference pressure over that at ambient pressure up to which bodies are soft.
const MOST_THICKENING: f64 = 10.0;
/// Nodes up to which a grid starts from the dry contact.
const FEW_NODES: usize = 64 * 64;
/// Pseudo-transient term and its reduction from the dry contact. Half of the terms and reductions of 0.85 or 0.9 leave
/// some of six soft contacts on 96 x 96 cells above 60 steps; these take 19 to 51.
pub(super) const FROM_DRY: (f64, f64) = (10.0, 0.8);
/// The same from the solution on a coarser grid: 7 to 9 steps.
pub(super) const FROM_COARSE: (f64, f64) = (0.3, 0.7);
/// Residual to which coarser grids are solved.
const COARSE_TOLERANCE: f64 = 1e-2;

/// Whether a smooth steady full film of a nearly isoviscous oil is expected.
pub(super) fn is_soft(problem: &LubricatedContact<'_>) -> bool {
    let is_isoviscous = problem.lubricant.is_some_and(|oil| {
        let viscosity = |pressure: f64| oil.viscosity().viscosity(pressure);
        viscosity(problem.reference_pressure) < MOST_THICKENING * viscosity(0.0)
    });
    is_isoviscous
        && problem.squeeze.is_none()
        && problem.box_load().is_some()
        && expects_full_film(problem, FILM_OVER_CONTACT)
}

impl Workspace {
    /// The solution on half of the cells along each side, and the pseudo-transient term `from_coarse` with its reduction;
    /// false on few nodes, and if that did not converge: the term is then that from the dry contact.
    pub(super) fn start_soft(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        (globalization, from_coarse): (&mut Globalization, (f64, f64)),
    ) -> Result<bool, ReynoldsError> {
        // The next coarser grid, if it is worth a solve.
        let grid = problem.grid();
        let is_fine = grid.len() > FEW_NODES && grid.ny() > 1 && !grid.is_strip();
        let coarse = if is_fine { coarser(&grid) } else { None };
        let body = coarse.and_then(|coarse| problem.deformation.on_grid(coarse));
        let is_started = match body {
            Some(mut body) => self.start_coarse(problem, &mut *body, state, stop)?,
            None => false,
        };
        globalization.set_pseudo_transient(if is_started { from_coarse } else { FROM_DRY });
        Ok(is_started)
    }

    /// The solution on the grid of `body`, interpolated; counts its convolutions. False if it did not converge.
    fn start_coarse(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        body: &mut dyn DeformationModel,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<bool, ReynoldsError> {
        let (grid, coarse) = (problem.grid(), body.grid());
        let mut transfer = Transfer::new(&grid, &coarse);
        // Gap and edge pressure on the coarser grid.
        let (mut gap, mut edge) = (vec![0.0; coarse.len()], vec![0.0; coarse.len()]);
        transfer.sample(problem.gap, &mut gap);
        if let Some(outer) = problem.edge_pressure {
            transfer.sample(outer.field, &mut edge);
            edge.iter_mut().for_each(|p| *p = p.max(0.0));
        }
        let edge_pressure = problem.edge_pressure.map(|outer| EdgePressure { field: &edge, ..outer });
        // A full film stays below the pressure limit.
        let mut below = LubricatedContact {
            gap: &gap,
            deformation: body,
            pressure_limit: None,
            edge_pressure,
            ..*problem
        };
        let rule = StoppingRule { tolerance: stop.tolerance.max(COARSE_TOLERANCE), ..*stop };
        let mut solution = ContactState::new(&coarse);
        // Solve there, and interpolate.
        let mut solver = NewtonKrylov { settings: self.settings.clone(), ..NewtonKrylov::new() };
        let report = solver.solve(&mut below, &mut solution, &rule)?;
        let share = coarse.len() as f64 / grid.len() as f64;
        self.newton.record.work.convolutions += share * report.work.convolutions;
        interpolate(&mut transfer, &grid, &solution, state);
        Ok(report.status == Status::Converged)
    }
}

/// Interpolates pressures and approach of a coarser grid.
fn interpolate(transfer: &mut Transfer, grid: &Grid, coarse: &ContactState, state: &mut ContactState) {
    transfer.interpolate_cubic(&coarse.fluid_pressure, &mut state.pressure);
    state.pressure.iter_mut().for_each(|p| *p = p.max(0.0));
    for k in outermost(grid) {
        state.pressure[k] = 0.0;
    }
    state.fluid_pressure.clone_from(&state.pressure);
    state.approach = coarse.approach;
}
