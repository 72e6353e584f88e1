//! Evaluation of a state, for custom solvers.

use super::coupled::{Changed, Coupled};
use super::flow::{FilmFlows, FlowBalance};
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ReynoldsError, StoppingRule, check_call, unified_reynolds};
use crate::grid::Grid;
use crate::report::Residuals;

/// Films and residuals of a state as all solvers of the crate compute them, so that custom solvers report the same
/// values. Owns its buffers; an evaluation allocates nothing.
///
/// ```
/// use stribeck::Grid;
/// use stribeck::elastic::HalfSpace;
/// use stribeck::reynolds::{ContactState, Evaluation, LubricatedContact};
/// let grid = Grid::centred(32, 32, 1e-5, 1e-5)?;
/// let gap: Vec<f64> = grid.nodes().map(|(x, y)| (x * x + y * y) / 0.02).collect();
/// let mut body = HalfSpace::new(grid, 230e9)?;
/// let mut problem = LubricatedContact::new(&gap, &mut body, 1.0, (4e-5, 4e-5), 3e8);
/// // Half of the load on one node.
/// let mut state = ContactState::new(&grid);
/// state.pressure[16 * 32 + 16] = 0.5 / grid.cell_area();
/// let residuals = Evaluation::new(grid).evaluate(&mut problem, &mut state)?;
/// assert!((residuals.load - 0.5).abs() < 1e-12);
/// assert!(state.film[16 * 32 + 16] > state.film[0] - gap[0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Evaluation {
    /// The evaluation shared by all solvers.
    coupled: Coupled,
}

impl Clone for Evaluation {
    /// New buffers on the same grid.
    fn clone(&self) -> Self {
        Self::new(self.coupled.fluid.grid)
    }
}

impl Evaluation {
    /// Buffers for contacts on `grid`.
    pub fn new(grid: Grid) -> Self {
        Self { coupled: Coupled::new(grid) }
    }

    /// Flow balance of the box at the pressures and films of `state`; `None` without a lubricant. Computes no elastic
    /// displacement.
    ///
    /// # Errors
    /// As of [`evaluate`](Self::evaluate).
    pub fn flow_balance(
        &mut self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
    ) -> Result<Option<FlowBalance>, ReynoldsError> {
        let previous = problem.squeeze.map(|s| s.previous_mass);
        let is_lubricated = self.update(problem, state)?;
        Ok(is_lubricated.then(|| self.coupled.fluid.flow_balance(previous)))
    }

    /// Overwrites `flows` with the flows through the cells at the pressures and films of `state`, by face mobility and
    /// entrainment scheme of the problem; zeros without a lubricant. Returns the same as
    /// [`flow_balance`](Self::flow_balance). Computes no elastic displacement.
    ///
    /// # Errors
    /// As of [`evaluate`](Self::evaluate).
    pub fn film_flows(
        &mut self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        flows: &mut FilmFlows,
    ) -> Result<Option<FlowBalance>, ReynoldsError> {
        let balance = self.flow_balance(problem, state)?;
        if balance.is_some() {
            self.coupled.fluid.film_flows(flows);
        } else {
            flows.resize(state.film.len());
        }
        Ok(balance)
    }

    /// Updates the fluid from `state`. Returns whether there is any.
    fn update(
        &mut self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
    ) -> Result<bool, ReynoldsError> {
        self.prepare(problem, state)?;
        let Some(lubricant) = problem.lubricant else { return Ok(false) };
        let fluid = &mut self.coupled.fluid;
        fluid.configure(problem);
        let pressure = if problem.is_hard() {
            &state.fluid_pressure
        } else {
            fluid.close_below(problem.contact_film());
            &state.pressure
        };
        fluid.update(lubricant, pressure, &state.film, problem.squeeze.map(|s| s.previous_mass));
        Ok(true)
    }

    /// Buffers for the grid of the problem.
    fn prepare(
        &mut self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
    ) -> Result<(), ReynoldsError> {
        check_call(problem, state, &StoppingRule::default())?;
        let grid = problem.grid();
        if grid != self.coupled.fluid.grid {
            self.coupled = Coupled::new(grid);
        }
        Ok(())
    }

    /// Overwrites film, plastic depth, mass, film fraction and contact flags of `state` (in the paper's contact the
    /// fluid pressure too) with those of its pressures and approach, and returns its residuals; one elastic
    /// displacement. If the fluid itself is at the pressure limit, the plastic depth is an independent unknown and
    /// kept.
    ///
    /// # Errors
    /// A problem or a state that breaks the contract of [`LubricatedContact`], or one of another grid.
    pub fn evaluate(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<Residuals, ReynoldsError> {
        self.prepare(problem, state)?;
        let coupled = &mut self.coupled;
        // The active set of the state is not known.
        if !problem.is_hard() {
            unified_reynolds::configure(coupled, problem);
            let residuals = unified_reynolds::evaluate(coupled, problem, state, Changed::Everything)?;
            unified_reynolds::mark_contact(problem, state);
            return Ok(residuals);
        }
        coupled.configure(problem);
        let residuals = coupled.evaluate(problem, state, Changed::Everything)?;
        self.coupled.mark_contact(state);
        Ok(residuals)
    }
}
