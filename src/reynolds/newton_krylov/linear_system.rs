//! The linear system of a Newton step and its solution.

use super::fluid_block::FluidBlock;
use super::linearization::Linearization;
use super::preconditioner::BlockPreconditioner;
use super::settings::KEPT_FILMS;
use super::unknowns::{Linearized, NodeChange, Response, Unknowns};
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Gmres, PreconditionedOperator};
use crate::reynolds::ReynoldsError;
use crate::reynolds::coupled::Coupled;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// Unknowns, linearization, preconditioner and GMRES: from a state to the changes of all nodes.
#[derive(Debug)]
pub(super) struct LinearSystem {
    unknowns: Unknowns,
    linearization: Linearization,
    preconditioner: BlockPreconditioner,
    gmres: Gmres,
    /// Film changes under the first directions of a linear solve, from which that of its solution is combined.
    direction_films: Vec<Vec<f32>>,
    residual: Vec<f32>,
    solution: Vec<f32>,
}

impl LinearSystem {
    /// A system on `grid`, its fluid equations solved by `fluid_block`.
    pub(super) fn new(grid: Grid, fluid_block: Box<dyn FluidBlock>, krylov_steps: usize) -> Self {
        let length = Unknowns::most(&grid);
        Self {
            unknowns: Unknowns::new(grid),
            linearization: Linearization::new(grid),
            preconditioner: BlockPreconditioner::new(grid, fluid_block),
            gmres: Gmres::new(length, krylov_steps),
            direction_films: (0..KEPT_FILMS).map(|_| vec![0.0; grid.len()]).collect(),
            residual: vec![0.0; length],
            solution: vec![0.0; length],
        }
    }

    /// Takes the elastic response of the problem.
    pub(super) fn configure(&mut self, problem: &mut LubricatedContact<'_>) -> Result<(), InputError> {
        self.preconditioner.configure(problem)
    }

    /// Linearizes at the state and flow in `coupled` and solves, to the reduction `tolerance` of the residual;
    /// returns the Krylov steps, or `None` where the fluid equations have no finite factors or the solve must stop.
    ///
    /// The right-hand side contains the whole elastic response, products its periodic approximation; the error
    /// of that is corrected in the next step.
    pub(super) fn solve(
        &mut self,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
        tolerance: f64,
    ) -> Result<Option<u64>, ReynoldsError> {
        let Self { unknowns, linearization, preconditioner, gmres, direction_films, .. } = self;
        // Partition the nodes by the active set and differentiate the flow.
        unknowns.partition(coupled, problem, state);
        if problem.lubricant.is_some() {
            linearization.update(&coupled.fluid, coupled.near.own);
        }
        // Factorize the fluid block and prepare the border of the load balance.
        if problem.deformation.must_stop()
            || !preconditioner.prepare(coupled, linearization, unknowns, problem)
        {
            return Ok(None);
        }
        // Line contacts are solved to the rounding of single precision, with padded convolutions throughout.
        let is_row = coupled.fluid.grid.ny() == 1;
        let response = if is_row { Response::Padded } else { Response::Periodic };
        let mut at = Linearized { coupled, problem, linearization };
        preconditioner.border(unknowns, &mut at)?;
        let n = unknowns.len();
        let (residual, solution) = (&mut self.residual[..n], &mut self.solution[..n]);
        solution.fill(0.0);
        unknowns.residual(&mut at, state, residual)?;
        // Solve by GMRES.
        let films = if is_row { &mut [] } else { &mut direction_films[..] };
        let mut system =
            System { unknowns, at: &mut at, preconditioner, response, films: &mut *films, products: 0 };
        let outcome = gmres.solve(&mut system, residual, tolerance, solution)?;
        // Scatter the solution to the changes of all nodes, without a convolution where the films are kept.
        if unknowns.are_pinned() || outcome.steps as usize > films.len() {
            unknowns.scatter_step(&mut at, solution, response)?;
        } else {
            let shares = gmres.coefficients(outcome).iter().copied();
            let films = shares.zip(films.iter().map(Vec::as_slice));
            unknowns.scatter_step_from_films(at.linearization, solution, films);
        }
        Ok(Some(outcome.steps))
    }

    /// Changes of node `k` over the whole step.
    pub(super) fn node_change(&self, k: usize) -> NodeChange {
        self.unknowns.node(k)
    }

    /// Largest change of a total pressure over the whole step \[Pa\].
    pub(super) fn largest_pressure_change(&self) -> f64 {
        self.unknowns.largest_pressure(&self.solution[..self.unknowns.len()])
    }

    /// Change of the approach over the whole step \[m\].
    pub(super) fn approach_change(&self) -> f64 {
        self.unknowns.approach(&self.solution[..self.unknowns.len()])
    }
}

/// The linear system as GMRES sees it.
struct System<'a, 'b, 'c> {
    unknowns: &'a mut Unknowns,
    at: &'a mut Linearized<'b, 'c>,
    preconditioner: &'a mut BlockPreconditioner,
    response: Response,
    /// Film changes under the first products.
    films: &'a mut [Vec<f32>],
    products: usize,
}

impl PreconditionedOperator for System<'_, '_, '_> {
    type Error = InputError;

    fn apply(&mut self, x: &[f32], out: &mut [f32]) -> Result<(), InputError> {
        self.unknowns.product(self.at, x, self.response, out)?;
        if let Some(films) = self.films.get_mut(self.products) {
            self.unknowns.copy_films(films);
        }
        self.products += 1;
        Ok(())
    }

    fn precondition(&mut self, r: &[f32], out: &mut [f32]) -> Result<(), InputError> {
        self.preconditioner.apply(self.unknowns, self.at, r, out)
    }
}
