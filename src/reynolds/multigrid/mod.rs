//! Full multigrid for smooth full films: the full approximation scheme (FAS) on a hierarchy of grids.
//!
//! Coarse grids reduce smooth errors, relaxation on the fine grid reduces oscillatory ones. A cycle therefore
//! reduces any error by a fixed factor, independent of the number of nodes. In FAS every grid solves for
//! pressures instead of corrections, so complementarity (no negative pressure) holds on each.
//!
//! This file holds the public solver and its loop: a cycle, the residuals of the full problem, the
//! convergence test. `level` holds the fields of one grid, `relax` its relaxation, `transfer` restriction and
//! interpolation, `cycle` the order of operations, `start` the initial state, and `acceleration` combines
//! cycles. The discretization is that of the other solvers (`flow`), so a converged state agrees with theirs
//! to the tolerance.

mod acceleration;
mod cycle;
mod full_film;
mod hierarchy;
mod level;
mod progress;
mod relax;
mod start;
mod transfer;

use acceleration::Acceleration;
pub(super) use full_film::expects_full_film;
use hierarchy::Hierarchy;
pub(super) use hierarchy::coarser;
use progress::Progress;
pub(super) use transfer::Transfer;

use super::coupled::{Changed, Coupled};
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, ReynoldsError, StoppingRule, check_call};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::report::{Residuals, SolveReport, Status, Work};
use crate::solver_id::SolverId;

/// Reduction factor of a cycle above which relaxation is damped more, from cycle [`SETTLED`] on.
const SLOW_REDUCTION: f64 = 0.6;
/// First cycle to which [`SLOW_REDUCTION`] applies.
const SETTLED: u64 = 3;
/// Ratio of expected film to contact film above which touching films indicate too coarse a mesh.
const EXPECTED_OVER_CONTACT: f64 = 2.0;
/// Smallest number of nodes along an axis for which the solver is selected.
const SMALLEST_GRID: usize = 32;
/// Reason for problems without lubricant.
const NO_LUBRICANT: &str = "the problem has no lubricant";
/// Reason to reject a deformation model without coarser grids.
const ONE_GRID: &str = "the deformation model lives on one grid alone";

/// Full multigrid after Venner and Lubrecht: W cycles of the full approximation scheme with hybrid line
/// relaxation, and the approach updated on the coarsest grid alone.
///
/// A zero initial pressure starts full multigrid: a Hertzian pressure and the reference film on a coarse
/// grid, interpolated upward with two cycles per grid. The result reaches the discretization error in about
/// 24 convolutions of the finest grid. Each further cycle costs eight convolutions. Seven to ten cycles, each
/// combined with the previous one, reduce all residuals to 1e-6, nearly independent of load and grid.
///
/// The solver covers full films without solid contact or pressure limit. If films fall below the contact
/// film, the solve ends as [`Status::MeshTooCoarse`] when the reference film is well above it, and as
/// [`Status::Stalled`] otherwise or when pressures exceed the limit. The deformation model must exist on
/// coarser grids ([`DeformationModel::on_grid`](crate::elastic::DeformationModel::on_grid)).
///
/// Source: Venner, C. H. and Lubrecht, A. A. (2000), Multilevel Methods in Lubrication, Elsevier.
///
/// # Examples
///
/// ```
/// use stribeck::SolverId;
/// use stribeck::sim::scene::{InletSpec, Load, Motion, Roughness, SolverKind};
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(64);
/// (scene.roughness.ball, scene.roughness.disc) = (Roughness::None, Roughness::None);
/// (scene.load, scene.motion) = (Load::hertz_pressure(0.5e9), Motion::new(5.0, 0.0));
/// scene.solver.kind = SolverKind::Multigrid;
/// // Its grids have ambient pressure at the edge of the box.
/// scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
/// let solution = solve_contact(&scene)?;
/// assert_eq!(solution.report.solver, SolverId::Multigrid);
/// solution.report.require_converged().map_err(|error| error.to_string())?;
/// assert!(solution.film.minimum > 0.0 && solution.film.minimum < solution.film.central);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Multigrid {
    /// Condition for a handover to another solver.
    hand_over: Option<HandOver>,
    /// Buffers, allocated at the first solve on a grid.
    workspace: Option<Box<Workspace>>,
}

/// Condition for a handover: the residuals are below `residual` and the predicted number of cycles exceeds
/// `cycles`. The solve then ends as stalled.
#[derive(Debug, Clone, Copy)]
pub(super) struct HandOver {
    /// Largest predicted number of cycles.
    pub(super) cycles: u64,
    /// Residual below which the prediction counts.
    pub(super) residual: f64,
}

/// Buffers of a solve, reused.
#[derive(Debug)]
struct Workspace {
    /// Condition for a handover to another solver.
    hand_over: Option<HandOver>,
    /// Grids and their fields.
    hierarchy: Hierarchy,
    /// Iterates of the last cycle.
    acceleration: Acceleration,
    /// Films, balances and residuals on the finest grid, shared code of all solvers.
    coupled: Coupled,
    /// State with the lowest residual.
    best: ContactState,
    /// Residuals of the start and after each cycle.
    history: Vec<Residuals>,
}

impl Clone for Multigrid {
    /// The clone allocates its own buffers at its first solve.
    fn clone(&self) -> Self {
        Self { hand_over: self.hand_over, workspace: None }
    }
}

impl Multigrid {
    /// A solver without buffers; they are allocated at the first solve.
    pub fn new() -> Self {
        Self::default()
    }

    /// A solver that hands slow solves over to another one.
    pub(super) fn handing_over(hand_over: HandOver) -> Self {
        Self { hand_over: Some(hand_over), workspace: None }
    }

    /// Whether the problem is a smooth full film with a flooded inlet on a grid that can be coarsened. The
    /// cycles use Reynolds' cavitation condition, which has no inlet meniscus.
    pub(super) fn suits(problem: &LubricatedContact<'_>) -> bool {
        let grid = problem.grid();
        grid.nx().min(grid.ny()) >= SMALLEST_GRID
            && !grid.is_strip()
            && problem.supplied_film.is_none()
            && problem.spin_radius.is_none()
            && problem.edge_pressure.is_none()
            && expects_full_film(problem, EXPECTED_OVER_CONTACT)
    }

    /// Rejects problems that no hierarchy of grids can solve; returns the lubricant. Allocates nothing.
    fn checked<'a>(
        &self,
        problem: &LubricatedContact<'a>,
        state: &ContactState,
        stop: &StoppingRule,
    ) -> Result<&'a Lubricant, ReynoldsError> {
        check_call(problem, state, stop)?;
        match self.unsupported(problem) {
            Some(reason) => Err(self.wrong_solver(reason)),
            None => problem.lubricant.ok_or_else(|| self.wrong_solver(NO_LUBRICANT)),
        }
    }

    /// The error for a problem outside the scope of this solver.
    fn wrong_solver(&self, reason: &'static str) -> ReynoldsError {
        ReynoldsError::WrongSolver { solver: self.id(), reason }
    }

    /// The workspace of this body, reused if it exists.
    fn workspace(
        &mut self,
        problem: &LubricatedContact<'_>,
        grid: Grid,
    ) -> Result<&mut Workspace, ReynoldsError> {
        let kept = self.workspace.take().filter(|w| w.hierarchy.fits(&*problem.deformation));
        let workspace = match kept {
            Some(workspace) => workspace,
            None => {
                let Some(hierarchy) = Hierarchy::new(&*problem.deformation) else {
                    return Err(self.wrong_solver(ONE_GRID));
                };
                Box::new(Workspace {
                    hand_over: self.hand_over,
                    hierarchy,
                    acceleration: Acceleration::new(grid.len()),
                    coupled: Coupled::new(grid),
                    best: ContactState::new(&grid),
                    history: Vec::new(),
                })
            }
        };
        Ok(self.workspace.insert(workspace))
    }
}

impl ContactSolver for Multigrid {
    fn id(&self) -> SolverId {
        SolverId::Multigrid
    }

    fn unsupported(&self, problem: &LubricatedContact<'_>) -> Option<&'static str> {
        // Grids first, then the flow.
        let grid = problem.grid();
        [
            (grid.ny() == 1, "a line contact has no second axis to coarsen"),
            (grid.is_strip(), "its grids have edges at their sides; take another solver"),
            (
                problem.spin_radius.is_some(),
                "its line relaxation along x does not cover entrainment along y, which spin causes",
            ),
            (
                problem.edge_pressure.is_some(),
                "its grids have ambient pressure at the edge of the box: take another solver, a wider box or lubricant.inlet = \"box_edge\"",
            ),
            (problem.lubricant.is_none(), NO_LUBRICANT),
        ]
        .into_iter()
        .find_map(|(applies, reason)| applies.then_some(reason))
    }

    fn check(
        &self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        stop: &StoppingRule,
    ) -> Result<(), ReynoldsError> {
        self.checked(problem, state, stop)?;
        if Hierarchy::has_bodies(&*problem.deformation) { Ok(()) } else { Err(self.wrong_solver(ONE_GRID)) }
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        let lubricant = self.checked(problem, state, stop)?;
        let (solver, grid) = (self.id(), problem.grid());
        let workspace = self.workspace(problem, grid)?;
        let mut work = Work::default();
        let (status, residuals) = workspace.run(problem, lubricant, state, stop, &mut work)?;
        workspace.coupled.mark_contact(state);
        work.inner_iterations = workspace.hierarchy.sweeps;
        work.convolutions += workspace.hierarchy.convolutions + workspace.coupled.convolutions;
        Ok(SolveReport::new(solver, status, residuals)
            .with_work(work)
            .with_residual_history(workspace.history.clone()))
    }
}

impl Workspace {
    /// Cycles until convergence, stall or the iteration limit; leaves the best state in `state`, evaluated,
    /// and returns its status and residuals. Relaxation is damped more if a cycle leaves more than
    /// [`SLOW_REDUCTION`] of the residual.
    fn run(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        state: &mut ContactState,
        stop: &StoppingRule,
        work: &mut Work,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        self.begin(problem, lubricant, state)?;
        let (mut best, mut status) = (Residuals::UNKNOWN, Status::MaxIterations);
        let mut progress = Progress::default();
        for cycle in 0..=stop.max_iterations {
            // residuals of the full problem
            let residuals = self.evaluate_finest(problem, lubricant, state)?;
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
            let touches = touches(problem, state);
            if residuals.max() <= stop.tolerance && within_limit(problem, state) && !touches {
                return Ok((Status::Converged, residuals));
            }
            progress.see_best(best.max());
            // damp a slow relaxation, or hand over to another solver
            if cycle >= SETTLED
                && residuals.max() > SLOW_REDUCTION * progress.last[0]
                && self.hierarchy.damp_relaxation()
            {
                self.acceleration.reset();
                progress.stalled_cycles = 0;
            }
            let needed = progress.cycles_needed(residuals.max(), stop.tolerance);
            let is_slow = self
                .hand_over
                .is_some_and(|h| residuals.max() < h.residual && cycle as f64 + needed > h.cycles as f64);
            if is_slow || progress.is_stalled(touches) {
                status = Status::Stalled;
                break;
            }
            // one W cycle, combined with the last one
            if cycle < stop.max_iterations {
                self.hierarchy.cycle_finest(problem, lubricant)?;
                self.hierarchy.accelerate(&mut self.acceleration, state, &self.coupled.balance);
                work.iterations += 1;
            }
        }
        // The best state is returned, not the last one.
        if best.is_finite() {
            state.clone_from(&self.best);
            self.coupled.evaluate(problem, state, Changed::Pressures)?;
        }
        let is_coarse = status == Status::Stalled && touches_a_thick_film(problem, state);
        Ok((if is_coarse { Status::MeshTooCoarse } else { status }, best))
    }

    /// Prepares all grids: full multigrid, or a warm start on the finest grid.
    fn begin(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        state: &ContactState,
    ) -> Result<(), InputError> {
        self.coupled.configure(problem);
        self.hierarchy.configure(problem);
        self.acceleration.reset();
        self.history.clear();
        // A cold start is full multigrid from the coarsest grid.
        if state.pressure.iter().all(|&p| p <= 0.0) {
            self.hierarchy.start(problem, lubricant)
        } else {
            self.hierarchy.resume(problem, state)
        }
    }

    /// Copies the pressure of the finest grid to `state`, evaluates it, and copies the film back; returns its residuals.
    fn evaluate_finest(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        state: &mut ContactState,
    ) -> Result<Residuals, ReynoldsError> {
        // Pressure to the state.
        state.approach = self.hierarchy.approach;
        let finest = self.hierarchy.finest_mut();
        state.pressure.copy_from_slice(&finest.pressure);
        state.fluid_pressure.copy_from_slice(&finest.pressure);
        let residuals = self.coupled.evaluate(problem, state, Changed::Pressures)?;
        // Film back to the grid.
        finest.film.copy_from_slice(&self.coupled.elastic_film);
        finest.update_flow(lubricant);
        Ok(residuals)
    }
}

/// Whether the film touches although it is expected to be thick.
fn touches_a_thick_film(problem: &LubricatedContact<'_>, state: &ContactState) -> bool {
    problem.reference_film > EXPECTED_OVER_CONTACT * problem.contact_film() && touches(problem, state)
}

/// Whether any film under pressure is below the contact film.
fn touches(problem: &LubricatedContact<'_>, state: &ContactState) -> bool {
    let contact_film = problem.contact_film();
    state.film.iter().zip(&state.pressure).any(|(h, p)| *p > 0.0 && *h < contact_film)
}

/// Whether all pressures are within their limit.
fn within_limit(problem: &LubricatedContact<'_>, state: &ContactState) -> bool {
    state.pressure.iter().enumerate().all(|(k, p)| *p <= problem.limit_at(k))
}
