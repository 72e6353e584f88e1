//! The unified Reynolds model by line sweeps with a convolution after each.
//!
//! A sweep solves one tridiagonal system per line for the pressures: pressure flow, and entrainment of the
//! films of the line, with the influence coefficients of a node and its next two neighbors times the
//! stiffness. A share of the change (the relaxation) is applied, bounded by zero and the pressure limit. A
//! convolution then updates the films. The approach changes by one per cent of the correction for the load
//! error.

use super::{classify, configure, evaluate, mark_contact, reaches_limit};
use crate::grid::Grid;
use crate::numerics::solve_tridiagonal;
use crate::report::{Residuals, Status, Work};
use crate::reynolds::active_set::Fluid;
use crate::reynolds::coupled::{Changed, Coupled};
use crate::reynolds::dry::hertzian;
use crate::reynolds::inner_nodes::inner_rows;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;
use crate::reynolds::{ReynoldsError, StoppingRule};

/// Share of the approach correction that is applied after each sweep.
const LOAD_GAIN: f64 = 0.01;
/// Pressure below which a cavitating node is set to zero, in reference pressures.
const NEGLIGIBLE_PRESSURE: f64 = 1e-12;
/// Bound on the relative load error in the approach correction.
const LARGEST_LOAD_ERROR: f64 = 0.1;
/// Decrease of the best residual within [`STALL_SWEEPS`] that counts as progress.
const PROGRESS: f64 = 0.9;
const STALL_SWEEPS: u64 = 5_000;

/// Convergence parameters of the sweeps.
#[derive(Debug, Clone, Copy)]
pub(in crate::reynolds) struct Damping {
    /// Share of each pressure change that is applied.
    pub(in crate::reynolds) relaxation: f64,
    /// Factor on the implicit influence coefficients.
    pub(in crate::reynolds) stiffness: f64,
}

/// Under-relaxed tridiagonal sweeps with pressure flow and entrainment, the latter with the three nearest
/// influence coefficients.
#[derive(Debug)]
pub(in crate::reynolds) struct Sweeps {
    /// Films, balances and residuals.
    pub(in crate::reynolds) coupled: Coupled,
    /// Residuals of the start and after each sweep.
    pub(in crate::reynolds) history: Vec<Residuals>,
    /// State with the lowest residual.
    best: ContactState,
    /// Subdiagonal entries (upstream neighbor).
    below: Vec<f64>,
    /// Diagonal entries.
    diagonal: Vec<f64>,
    /// Superdiagonal entries (downstream neighbor).
    above: Vec<f64>,
    /// Right-hand sides, overwritten by changes of pressure.
    rhs: Vec<f64>,
}

/// Hertzian pressure under the load of the problem, and the approach of an open film.
fn start_from_hertz(problem: &LubricatedContact<'_>, state: &mut ContactState) {
    hertzian(problem, &mut state.pressure);
    let carried = state.pressure.iter().sum::<f64>() * problem.grid().cell_area();
    if carried > 0.0 {
        for p in &mut state.pressure {
            *p *= problem.box_load().unwrap_or(problem.load) / carried;
        }
    }
    state.fluid_pressure.clone_from(&state.pressure);
}

impl Sweeps {
    /// Buffers for `grid`.
    pub(in crate::reynolds) fn new(grid: Grid) -> Self {
        let line = || vec![0.0; grid.nx()];
        Self {
            coupled: Coupled::new(grid),
            history: Vec::new(),
            best: ContactState::new(&grid),
            below: line(),
            diagonal: line(),
            above: line(),
            rhs: line(),
        }
    }

    /// Sweeps until `stop` or a stall, from a Hertzian pressure if `state` has none; leaves the best state.
    pub(in crate::reynolds) fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        damping: Damping,
        work: &mut Work,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        let (status, residuals) = self.iterate(problem, state, stop, damping, work)?;
        mark_contact(problem, state);
        work.convolutions += self.coupled.convolutions;
        Ok((status, residuals))
    }

    /// Sweeps until convergence, stall or the iteration limit; leaves the best state evaluated, and returns
    /// status and residuals.
    fn iterate(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        damping: Damping,
        work: &mut Work,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        let mut residuals = self.begin(problem, state)?;
        self.history.clear();
        let mut best = Residuals::UNKNOWN;
        let mut mark = (f64::INFINITY, 0);
        let mut status = Status::MaxIterations;
        for sweep in 0..=stop.max_iterations {
            self.history.push(residuals);
            if !residuals.is_finite() {
                status = Status::Diverged;
                break;
            }
            // best state, convergence, progress
            if residuals.max() < best.max() {
                best = residuals;
                self.best.clone_from(state);
            }
            if residuals.max() <= stop.tolerance {
                return Ok((Status::Converged, residuals));
            }
            if best.max() < PROGRESS * mark.0 {
                mark = (best.max(), sweep);
            } else if sweep > mark.1 + STALL_SWEEPS {
                status = Status::Stalled;
                break;
            }
            if sweep == stop.max_iterations {
                break;
            }
            // active set, pressures, approach, films
            work.iterations += 1;
            classify(&mut self.coupled, problem, state);
            self.sweep(problem, state, damping);
            self.balance_load(problem, state);
            residuals = evaluate(&mut self.coupled, problem, state, Changed::Pressures)?;
        }
        if best.is_finite() {
            state.clone_from(&self.best);
            evaluate(&mut self.coupled, problem, state, Changed::Pressures)?;
        }
        Ok((status, best))
    }

    /// Evaluates the initial state and returns its residuals; without pressure it is the Hertz contact with an open film.
    fn begin(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<Residuals, ReynoldsError> {
        let cold = state.pressure.iter().all(|&p| p <= 0.0);
        if cold {
            start_from_hertz(problem, state);
        }
        configure(&mut self.coupled, problem);
        let residuals = evaluate(&mut self.coupled, problem, state, Changed::Pressures)?;
        if cold { self.open_film(problem, state) } else { Ok(residuals) }
    }

    /// Shifts the approach until the lowest film under pressure is the reference film; returns the residuals.
    fn open_film(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<Residuals, ReynoldsError> {
        let mut lowest = f64::INFINITY;
        for (h, p) in self.coupled.elastic_film.iter().zip(&state.pressure) {
            if *p > 0.0 {
                lowest = lowest.min(*h);
            }
        }
        let lift = problem.reference_film.max(2.0 * problem.contact_film()) - lowest;
        if lift.is_finite() {
            state.approach -= lift;
            for (h, film) in self.coupled.elastic_film.iter_mut().zip(&mut state.film) {
                *h += lift;
                *film += lift;
            }
        }
        Ok(evaluate(&mut self.coupled, problem, state, Changed::Film)?)
    }

    /// One sweep over all lines.
    fn sweep(&mut self, problem: &LubricatedContact<'_>, state: &mut ContactState, damping: Damping) {
        let grid = self.coupled.fluid.grid;
        for j in inner_rows(&grid) {
            // Films and balances of all lines are those before the sweep.
            self.assemble_line(problem, state, j, damping.stiffness);
            solve_tridiagonal(&self.below, &self.diagonal, &mut self.above, &mut self.rhs);
            self.update_line(problem, state, j, damping.relaxation);
        }
        for k in 0..grid.len() {
            if self.coupled.active_set[k].fluid == Fluid::Boundary {
                state.fluid_pressure[k] = 0.0;
                state.pressure[k] = 0.0;
            }
        }
    }

    /// Assembles line `j` with influence coefficients times `stiffness`. Rows of boundary, cavitated and
    /// limited nodes are the identity.
    fn assemble_line(
        &mut self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        j: usize,
        stiffness: f64,
    ) {
        let grid = self.coupled.fluid.grid;
        let nx = grid.nx();
        let previous = problem.squeeze.map(|s| s.previous_mass);
        for i in 0..nx {
            let k = j * nx + i;
            let side = self.coupled.active_set[k];
            if matches!(side.fluid, Fluid::Boundary | Fluid::Cavitated) {
                // Fixed within the solve: clipping afterwards would expose the neighbors to a spurious
                // suction.
                let change = -state.fluid_pressure[k];
                (self.below[i], self.diagonal[i], self.above[i], self.rhs[i]) = (0.0, 1.0, 0.0, change);
                continue;
            }
            let balance = self.coupled.fluid.balance(k, previous);
            let limit = problem.limit_at(k);
            if balance < 0.0 && reaches_limit(state.fluid_pressure[k], limit) {
                // Fixed at the limit.
                let change = limit - state.fluid_pressure[k];
                (self.below[i], self.diagonal[i], self.above[i], self.rhs[i]) = (0.0, 1.0, 0.0, change);
                continue;
            }
            let (below, diagonal, above) = self.coupled.fluid.line_row(k, self.coupled.near, stiffness);
            (self.below[i], self.diagonal[i], self.above[i], self.rhs[i]) =
                (below, diagonal, above, -balance);
        }
    }

    /// Applies the share `relaxation` of the changes of line `j`, bounded by zero and the pressure limit.
    fn update_line(
        &mut self,
        problem: &LubricatedContact<'_>,
        state: &mut ContactState,
        j: usize,
        relaxation: f64,
    ) {
        let nx = self.coupled.fluid.grid.nx();
        for i in 1..nx - 1 {
            let k = j * nx + i;
            let limit = problem.limit_at(k);
            let wanted = (state.fluid_pressure[k] + self.rhs[i]).clamp(0.0, limit);
            let mut fluid = state.fluid_pressure[k] + relaxation * (wanted - state.fluid_pressure[k]);
            // A pressure that decays to zero ends there.
            if wanted == 0.0 && fluid < NEGLIGIBLE_PRESSURE * problem.reference_pressure {
                fluid = 0.0;
            }
            // Initial pressures may exceed the limit.
            let fluid = fluid.min(limit);
            state.fluid_pressure[k] = fluid;
            state.pressure[k] = fluid;
        }
    }

    /// Updates the approach by the load error. In equilibrium a relative load error `e` requires a change of
    /// about `e` times the mean elastic displacement. Films respond slowly in the sweeps, so a small share is
    /// applied.
    fn balance_load(&self, problem: &LubricatedContact<'_>, state: &mut ContactState) {
        let carried = state.pressure.iter().sum::<f64>() * self.coupled.fluid.grid.cell_area();
        let residual = (problem.load - carried) / problem.load;
        let (mut sum, mut weight) = (0.0, 0.0);
        for (k, p) in state.pressure.iter().enumerate() {
            sum += p * (self.coupled.elastic_film[k] - problem.gap[k] + state.approach);
            weight += p;
        }
        if weight > 0.0 {
            state.approach +=
                LOAD_GAIN * residual.clamp(-LARGEST_LOAD_ERROR, LARGEST_LOAD_ERROR) * sum / weight;
        }
    }
}
