//! Semismooth Newton on the whole coupled problem, linear systems by preconditioned GMRES.
//!
//! One Newton step, in the order of [`newton`]:
//!
//! 1. choose contact film, pseudo-transient term and step bound ([`globalization`]);
//! 2. clamp the films of contact nodes, linearize the equations that the active set selects, and solve the linear
//!    system to a tenth of its residual ([`linear_system`]);
//! 3. predict a state ([`prediction`]): the start of the step plus the solution, shortened where a pressure would
//!    change by too much;
//! 4. eliminate every node's own equations near the prediction, neighbors held: that determines its pressures and
//!    its place in the active set ([`node`]); then those of isolated fluid regions ([`isolated_regions`]);
//! 5. evaluate films, by one convolution, flow and residuals; halve the step where the residual grows too much;
//! 6. adapt the step bound to the linearization error.
//!
//! [`attempt`] starts the loop from the given state or the dry contact, [`soft_start`] from coarser grids,
//! [`continuation`] follows solutions with thicker contact films where it stalls.
//!
//! Vectors of films, and when they are valid:
//!
//! | vector | content | valid |
//! |---|---|---|
//! | `ContactState::film` | film with plastic depth | after `Coupled::update`; from `clamp_film_to_contact` to the next one it is the contact film at contact nodes |
//! | `Coupled::elastic_film` | film without plastic depth | after `Coupled::deform`; within the elimination of isolated regions it is the predicted film and its own response |
//! | `Snapshot` of the start of a step | film without plastic depth | throughout the step |
//! | `Snapshot` of the best state | the same | once a state of the problem's own equations is evaluated |
//! | `Unknowns`, changes without plastic depth and those that the flow takes | changes under the last vector: during a linear solve any direction, after it the solution | until the next linear solve |
//! | `LinearSystem::direction_films` | film changes under the first directions | within a linear solve |
//!
//! The predicted films have no vector: [`prediction::Prediction`] adds start and change node by node.

mod across;
mod attempt;
mod coarse_films;
mod contact_film;
mod continuation;
mod face_flows;
mod fluid_block;
mod globalization;
mod homotopy;
mod isolated_regions;
mod linear_system;
mod linearization;
mod local_elimination;
mod newton;
mod node;
mod preconditioner;
mod prediction;
mod prescribed_displacements;
mod record;
mod settings;
mod snapshot;
mod soft_start;
mod unknowns;
mod weak_coupling;
mod window;
mod window_place;

pub(crate) use fluid_block::FluidBlock;
use fluid_block::lu_of;
use linear_system::LinearSystem;
use local_elimination::LocalElimination;
use newton::Newton;
pub use settings::NewtonSettings;

use super::coupled::Coupled;
use super::dry::DryStart;
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, ReynoldsError, StoppingRule};
use crate::error::InputError;
use crate::grid::Grid;
use crate::report::SolveReport;
use crate::solver_id::SolverId;

/// Semismooth Newton solver with approach and load balance inside the system.
///
/// Each step solves the linearized equations of the active set (nodes are cavitated, fluid, in contact or yielded)
/// by GMRES, with products that cost a quarter of a DC-FFT convolution. The preconditioner is triangular: a sparse
/// LU of the fluid equations in which films respond to their own pressures alone, then the pressures of contact
/// nodes by conjugate gradients on blocks of nodes and the inverse convolution, and the load balance as a border.
/// Then each node's own equations are eliminated, neighbors as the linear step predicts them (nonlinear
/// elimination): that determines its place in the active set and resolves the viscosity over its orders of
/// magnitude, where plain Newton steps cycle.
///
/// A state without pressure, or with a residual above [`NewtonSettings::warm_start_threshold`], is replaced by the
/// dry contact, which is close to the answer in mixed lubrication: the asperities already carry their load and the
/// fluid fills the gaps. Smooth full films of soft bodies are solved on coarser grids first. The first steps from there
/// are steps in pseudo-time. A contact that stalls is solved with thicker contact films, and that solution followed to
/// its own.
#[derive(Debug)]
pub struct NewtonKrylov {
    fluid_block: fn(&Grid) -> Box<dyn FluidBlock>,
    settings: NewtonSettings,
    workspace: Option<Box<Workspace>>,
}

/// The loop and its starts on one grid.
#[derive(Debug)]
struct Workspace {
    settings: NewtonSettings,
    newton: Newton,
    start: DryStart,
}

impl Clone for NewtonKrylov {
    /// The same settings; the copy makes buffers of its own at its first solve.
    fn clone(&self) -> Self {
        Self::by(self.fluid_block, self.settings.clone())
    }
}

impl Default for NewtonKrylov {
    fn default() -> Self {
        Self::by(|grid| Box::new(lu_of(grid)), NewtonSettings::default())
    }
}

impl NewtonKrylov {
    /// A solver; buffers are made at the first solve and kept.
    pub fn new() -> Self {
        Self::default()
    }

    /// A solver with other than the default settings.
    ///
    /// # Errors
    ///
    /// [`InputError`] naming the setting that is out of its range.
    pub fn with_settings(settings: NewtonSettings) -> Result<Self, InputError> {
        settings.validate()?;
        Ok(Self { settings, ..Self::default() })
    }

    /// A solver whose fluid equations are solved by `fluid_block`.
    pub(crate) fn by(fluid_block: fn(&Grid) -> Box<dyn FluidBlock>, settings: NewtonSettings) -> Self {
        Self { fluid_block, settings, workspace: None }
    }

    fn workspace(&mut self, problem: &LubricatedContact<'_>) -> &mut Workspace {
        let grid = problem.grid();
        let kept = self.workspace.take().filter(|w| w.newton.coupled.fluid.grid == grid);
        let workspace = kept.unwrap_or_else(|| {
            let settings = self.settings.clone();
            let system = LinearSystem::new(grid, (self.fluid_block)(&grid), settings.krylov_steps);
            let elimination = LocalElimination::new(grid, settings.eliminates_regions);
            let newton = Newton::new(Coupled::new(grid), system, elimination);
            Box::new(Workspace { settings, newton, start: DryStart::new(grid) })
        });
        self.workspace.insert(workspace)
    }
}

impl ContactSolver for NewtonKrylov {
    fn id(&self) -> SolverId {
        SolverId::NewtonKrylov
    }

    fn unsupported(&self, problem: &LubricatedContact<'_>) -> Option<&'static str> {
        let reason = "it needs fluid and solid pressure apart, which the paper's contact does not know";
        (!problem.is_hard()).then_some(reason)
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        self.check(problem, state, stop)?;
        // The homotopy changes contact film and cavitation of a copy.
        let problem = &mut problem.copied();
        // Buffers of this grid, kept from solve to solve.
        let workspace = self.workspace(problem);
        workspace.newton.system.configure(problem)?;
        let (status, residuals) = workspace.run(problem, state, stop)?;
        let Newton { coupled, record, .. } = &workspace.newton;
        coupled.mark_contact(state);
        Ok(SolveReport::new(SolverId::NewtonKrylov, status, residuals)
            .with_work(record.work)
            .with_strategy(record.best.strategy)
            .with_residual_history(record.history.clone()))
    }
}
