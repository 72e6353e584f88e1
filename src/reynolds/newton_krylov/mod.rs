//! Semismooth Newton on the whole coupled problem, linear systems by preconditioned GMRES.

mod across;
mod attempt;
mod coarse_films;
mod continuation;
mod fluid_block;
mod globalisation;
mod homotopy;
mod iteration;
mod linearisation;
mod local;
mod pockets;
mod preconditioner;
mod prescribed_displacements;
mod settings;
mod snapshot;
mod step;
mod unknowns;
mod window;

pub(super) use fluid_block::FluidBlock;
use linearisation::Linearisation;
use pockets::Pockets;
use preconditioner::BlockPreconditioner;
pub use settings::{Attempt, NewtonSettings, PocketSettings};
use snapshot::Snapshot;
use unknowns::Unknowns;

use super::coupled::Coupled;
use super::dry::DryStart;
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, ReynoldsError, StoppingRule, check_call};
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Gmres, GridLu};
use crate::report::{Residuals, SolveReport, Work};
use crate::solver_id::SolverId;
use crate::strategy::Strategy;

/// Semismooth Newton solver with approach and load balance inside the system.
///
/// Each step solves the linearised equations of the sides (cavitated, fluid, contact, yielded) that the nodes
/// are on by GMRES on products of a quarter of the cost of a DC-FFT convolution, and checks them by a whole
/// one. The preconditioner is triangular: sparse LU of the fluid equations in which films follow their own
/// pressures alone, then the pressures of the contact nodes by conjugate gradients on blocks of nodes and the
/// inverse convolution, and the load balance as a border. Then each node's own equations are eliminated,
/// neighbours held as the step foresees them (nonlinear elimination): that decides its side and follows the
/// viscosity over its orders of magnitude, where a linear step alone makes nodes go round in cycles.
///
/// A state that carries no pressure, or whose residual is above [`NewtonSettings::near_below`], is started
/// from the dry contact, which is close to the answer in mixed lubrication: the asperities already carry
/// their load and the fluid fills what is left. Steps from there are steps in time at first. A contact that
/// stalls is solved with thicker contact films, and that solution followed to its own.
#[derive(Debug)]
pub struct NewtonKrylov {
    fluid_block: fn(&Grid) -> Box<dyn FluidBlock>,
    settings: NewtonSettings,
    workspace: Option<Box<Workspace>>,
}

/// Directions of a linear solve whose film changes are kept: most solves take no more, and where one does, a
/// convolution is little of it.
const KEPT_FILMS: usize = 8;
/// Residuals for which there is room at first.
const HISTORY: usize = 256;

#[derive(Debug)]
struct Workspace {
    settings: NewtonSettings,
    coupled: Coupled,
    unknowns: Unknowns,
    linearisation: Linearisation,
    preconditioner: BlockPreconditioner,
    gmres: Gmres,
    /// Film changes under the first directions of a linear solve, which make up that of its solution.
    films: Vec<Vec<f32>>,
    residual: Vec<f32>,
    step: Vec<f32>,
    start: DryStart,
    best: Snapshot,
    best_residuals: Residuals,
    best_strategy: Strategy,
    /// What is tried now.
    strategy: Strategy,
    /// Residuals of all steps of the solve so far.
    history: Vec<Residuals>,
    /// Of the solve so far, without the convolutions of the attempt at work.
    work: Work,
    /// Of the state as it is.
    residuals: Residuals,
    before: Snapshot,
    /// Films through which the fluid flows in a step (see [`Workspace::close_contact`]).
    flow_film: Vec<f64>,
    /// Films that the last step foresaw.
    foreseen: Vec<f64>,
    pockets: Pockets,
}

impl Clone for NewtonKrylov {
    /// The same settings; the copy makes buffers of its own at its first solve.
    fn clone(&self) -> Self {
        Self::by(self.fluid_block, self.settings.clone())
    }
}

impl Default for NewtonKrylov {
    fn default() -> Self {
        Self::by(|grid| Box::new(GridLu::new(grid.nx(), grid.ny())), NewtonSettings::default())
    }
}

impl NewtonKrylov {
    /// A solver; buffers are made at the first solve and kept.
    pub fn new() -> Self {
        Self::default()
    }

    /// A solver that goes by other numbers than the default ones.
    ///
    /// # Errors
    ///
    /// [`InputError`] naming the number that is out of its range.
    pub fn with_settings(settings: NewtonSettings) -> Result<Self, InputError> {
        settings.validate()?;
        Ok(Self { settings, ..Self::default() })
    }

    /// A solver whose fluid equations are solved by `fluid_block`.
    pub(super) fn by(fluid_block: fn(&Grid) -> Box<dyn FluidBlock>, settings: NewtonSettings) -> Self {
        Self { fluid_block, settings, workspace: None }
    }

    fn workspace(&mut self, problem: &LubricatedContact<'_>) -> &mut Workspace {
        let grid = problem.grid();
        let length = Unknowns::most(&grid);
        let kept = self.workspace.take().filter(|w| w.coupled.fluid.grid == grid);
        let workspace = kept.unwrap_or_else(|| {
            Box::new(Workspace {
                settings: self.settings.clone(),
                coupled: Coupled::new(grid),
                unknowns: Unknowns::new(grid),
                linearisation: Linearisation::new(grid),
                preconditioner: BlockPreconditioner::new(grid, (self.fluid_block)(&grid)),
                gmres: Gmres::new(length, self.settings.krylov_steps),
                films: (0..KEPT_FILMS).map(|_| vec![0.0; grid.len()]).collect(),
                residual: vec![0.0; length],
                step: vec![0.0; length],
                start: DryStart::new(grid),
                best: Snapshot::new(grid),
                best_residuals: Residuals::default(),
                best_strategy: Strategy::Attempt,
                strategy: Strategy::Attempt,
                history: Vec::with_capacity(HISTORY),
                work: Work::default(),
                residuals: Residuals::default(),
                before: Snapshot::new(grid),
                flow_film: vec![0.0; grid.len()],
                foreseen: vec![0.0; grid.len()],
                pockets: Pockets::new(grid, self.settings.pockets),
            })
        });
        self.workspace.insert(workspace)
    }
}

impl ContactSolver for NewtonKrylov {
    fn id(&self) -> SolverId {
        SolverId::NewtonKrylov
    }

    fn check(
        &self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        stop: &StoppingRule,
    ) -> Result<(), ReynoldsError> {
        check_call(problem, state, stop)?;
        if problem.is_paper() {
            let reason = "it needs fluid and solid pressure apart, which the paper's contact does not know";
            return Err(ReynoldsError::WrongSolver { solver: self.id(), reason });
        }
        Ok(())
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        self.check(problem, state, stop)?;
        // Films and cavitation are others on the way.
        let problem = &mut problem.copied();
        let workspace = self.workspace(problem);
        workspace.preconditioner.configure(problem)?;
        let (status, residuals) = workspace.run(problem, state, stop)?;
        workspace.coupled.mark_contact(problem, state);
        Ok(SolveReport::new(SolverId::NewtonKrylov, status, residuals)
            .with_work(workspace.work)
            .with_strategy(workspace.best_strategy)
            .with_residual_history(workspace.history.clone()))
    }
}
