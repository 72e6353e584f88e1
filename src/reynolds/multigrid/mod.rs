//! Full multigrid for smooth full films: the full approximation scheme on a hierarchy of grids.
//!
//! A smooth error is cheap to remove on a coarse grid, a rough one by sweeps on the fine grid; with both, a
//! cycle leaves a fixed share of any error, whatever the number of nodes. In full approximation every grid
//! solves for pressures, not for corrections, so that complementarity (no pressure below zero) holds on each.
//!
//! This file is the solver as others see it, and its loop: a cycle, a look at the residuals of the unreduced
//! problem, an end. What a grid holds is `level`, how it is swept `relax`, how fields pass between two grids
//! `transfer`, in which order `cycle`, what a solve begins with `start`; `acceleration` combines cycles. It
//! rests on the discretisation of `flow`, the same as that of the other solvers: a converged state is theirs
//! too, to the tolerance.

mod acceleration;
mod cycle;
mod full_film;
mod hierarchy;
mod level;
mod relax;
mod start;
mod transfer;

use acceleration::Acceleration;
pub(super) use full_film::expects_full_film;
use hierarchy::Hierarchy;

use super::coupled::Coupled;
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, ReynoldsError, StoppingRule, check_call};
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::report::{Residuals, SolveReport, Status, Work};
use crate::solver_id::SolverId;

/// Cycles without a better residual after which the solve has stalled.
const PATIENCE: u64 = 3;
/// A residual is better if it is below this share of the best one.
const GAIN: f64 = 0.8;
/// Share of a residual left by a cycle above which relaxation becomes more careful, from the cycle
/// [`SETTLED`] on.
const SLOW: f64 = 0.6;
/// First cycle that is judged by [`SLOW`].
const SETTLED: u64 = 3;
/// Cycles over which the rate of convergence is taken.
const RATE_CYCLES: usize = 3;
/// Cycles in which the film may touch before the solve ends.
const TOUCHING_CYCLES: u64 = 8;
/// Expected film over contact film above which films that touch are the fault of the mesh.
const EXPECTED_OVER_CONTACT: f64 = 2.0;
/// Nodes along each axis below which there is nothing to coarsen.
const SMALLEST_GRID: usize = 32;
/// Why a model without coarser grids is refused.
const ONE_GRID: &str = "the deformation model lives on one grid alone";

/// Full multigrid in the manner of Lubrecht, Venner and Brandt: W cycles of the full approximation scheme,
/// hybrid line relaxation, the approach balanced on the coarsest grid alone.
///
/// A state without pressure is started on a coarse grid from a Hertzian pressure and the reference film of
/// the problem, and carried up, two cycles a grid: the answer is then within its discretisation error, after
/// about 24 convolutions of the finest grid. Each further cycle costs eight convolutions; seven to ten of
/// them, of which each is recombined with the one before, bring all residuals to 1e-6, nearly independent of
/// load and grid.
///
/// Made for full films: it knows neither solid contact nor the pressure limit. A solve whose films fall below
/// the contact film ends as [`Status::MeshTooCoarse`] where the reference film is well above that, and as
/// [`Status::Stalled`] otherwise or where pressures exceed the limit. The deformation model must exist on
/// coarser grids ([`DeformationModel::on_grid`](crate::elastic::DeformationModel::on_grid)).
///
/// Source: Venner, C. H. and Lubrecht, A. A. (2000), Multilevel Methods in Lubrication, Elsevier.
///
/// # Examples
///
/// ```
/// use stribeck::SolverId;
/// use stribeck::sim::scene::{Load, Motion, Roughness, SolverKind};
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(64);
/// (scene.roughness.ball, scene.roughness.disc) = (Roughness::None, Roughness::None);
/// (scene.load, scene.motion) = (Load::hertz_pressure(0.5e9), Motion::new(5.0, 0.0));
/// scene.solver.kind = SolverKind::Multigrid;
/// let solution = solve_contact(&scene)?;
/// assert_eq!(solution.report.solver, SolverId::Multigrid);
/// solution.report.require_converged().map_err(|error| error.to_string())?;
/// assert!(solution.film.minimum > 0.0 && solution.film.minimum < solution.film.central);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Multigrid {
    /// Where another solver takes over.
    hand_over: Option<HandOver>,
    /// Buffers, made at the first solve on a grid.
    workspace: Option<Box<Workspace>>,
}

/// A solve whose residuals are below `residual` ends as stalled as soon as more than this number of cycles is
/// foreseen.
#[derive(Debug, Clone, Copy)]
pub(super) struct HandOver {
    /// Cycles that may be foreseen.
    pub(super) cycles: u64,
    /// Residual from which foresight counts.
    pub(super) residual: f64,
}

/// What a solve writes to, kept from solve to solve.
#[derive(Debug)]
struct Workspace {
    /// Where another solver takes over.
    hand_over: Option<HandOver>,
    /// Grids with their fields.
    hierarchy: Hierarchy,
    /// What is known of the last cycle.
    acceleration: Acceleration,
    /// Films, balances and residuals on the finest grid, as all solvers have them.
    coupled: Coupled,
    /// State of the lowest residual.
    best: ContactState,
    /// Residuals of the start and after each cycle.
    history: Vec<Residuals>,
}

impl Clone for Multigrid {
    /// The copy makes buffers of its own at its first solve.
    fn clone(&self) -> Self {
        Self { hand_over: self.hand_over, workspace: None }
    }
}

impl Multigrid {
    /// A solver; buffers are made at the first solve and kept.
    pub fn new() -> Self {
        Self::default()
    }

    /// A solver that leaves the end of slow solves to another one.
    pub(super) fn handing_over(hand_over: HandOver) -> Self {
        Self { hand_over: Some(hand_over), workspace: None }
    }

    /// Whether the problem is a smooth full film behind a flooded inlet on a grid that can be coarsened: a
    /// meniscus in front of the contact is none of Reynolds' condition, which is that of the cycles.
    pub(super) fn suits(problem: &LubricatedContact<'_>) -> bool {
        let grid = problem.grid();
        grid.nx().min(grid.ny()) >= SMALLEST_GRID
            && problem.supplied_film.is_none()
            && problem.spin_radius.is_none()
            && problem.edge_pressure.is_none()
            && expects_full_film(problem, EXPECTED_OVER_CONTACT)
    }

    /// Refuses what no hierarchy of grids changes; the lubricant of the problem.
    fn checked<'a>(
        &self,
        problem: &LubricatedContact<'a>,
        state: &ContactState,
        stop: &StoppingRule,
    ) -> Result<&'a Lubricant, ReynoldsError> {
        check_call(problem, state, stop)?;
        if problem.grid().ny() == 1 {
            return Err(self.wrong("a line contact has no second axis to coarsen"));
        }
        if problem.spin_radius.is_some() {
            return Err(
                self.wrong("its relaxations sweep along x, and turning surfaces carry fluid along y too")
            );
        }
        if problem.edge_pressure.is_some() {
            return Err(self.wrong("its grids have ambient pressure at the edge of the box: take another solver, a wider box or lubricant.inlet = \"box_edge\""));
        }
        problem.lubricant.ok_or_else(|| self.wrong("the problem has no lubricant"))
    }

    /// The error of a problem that is not for this solver.
    fn wrong(&self, reason: &'static str) -> ReynoldsError {
        ReynoldsError::WrongSolver { solver: self.id(), reason }
    }

    /// The kept workspace where it is of this body, else a new one.
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
                    return Err(self.wrong(ONE_GRID));
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

    fn check(
        &self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        stop: &StoppingRule,
    ) -> Result<(), ReynoldsError> {
        self.checked(problem, state, stop)?;
        if Hierarchy::has_bodies(&*problem.deformation) { Ok(()) } else { Err(self.wrong(ONE_GRID)) }
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
        workspace.coupled.mark_contact(problem, state);
        work.inner_iterations = workspace.hierarchy.sweeps;
        work.convolutions += workspace.hierarchy.convolutions + workspace.coupled.convolutions;
        Ok(SolveReport::new(solver, status, residuals)
            .with_work(work)
            .with_residual_history(workspace.history.clone()))
    }
}

impl Workspace {
    /// Cycles until one of the ends of a solve; leaves the best state in `state`, evaluated, and returns its
    /// status and residuals. Sweeps become careful where a settled cycle leaves more than [`SLOW`] of the
    /// residual.
    fn run(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        state: &mut ContactState,
        stop: &StoppingRule,
        work: &mut Work,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        self.coupled.configure(problem);
        self.hierarchy.configure(problem);
        self.acceleration.forget();
        self.history.clear();
        if state.pressure.iter().all(|&p| p <= 0.0) {
            self.hierarchy.start(problem, lubricant)?;
        } else {
            self.hierarchy.resume(problem, state)?;
        }
        let mut best = Residuals::UNKNOWN;
        let (mut mark, mut fruitless, mut touching) = (f64::INFINITY, 0, 0);
        let mut last = [f64::INFINITY; RATE_CYCLES];
        let mut status = Status::MaxIterations;
        for cycle in 0..=stop.max_iterations {
            self.take_over(problem, lubricant, state)?;
            let residuals = self.coupled.residuals(problem, state);
            self.history.push(residuals);
            if !residuals.is_finite() {
                status = Status::Diverged;
                break;
            }
            if residuals.max() < best.max() {
                best = residuals;
                self.best.clone_from(state);
            }
            let touches = touches(problem, state);
            if residuals.max() <= stop.tolerance && within_limit(problem, state) && !touches {
                return Ok((Status::Converged, residuals));
            }
            if best.max() < GAIN * mark {
                (mark, fruitless) = (best.max(), 0);
            } else {
                fruitless += 1;
            }
            if cycle >= SETTLED && residuals.max() > SLOW * last[0] && self.hierarchy.relax_carefully() {
                self.acceleration.forget();
                fruitless = 0;
            }
            let needed = cycles_needed(residuals.max(), last[RATE_CYCLES - 1], stop.tolerance);
            last.rotate_right(1);
            last[0] = residuals.max();
            if self
                .hand_over
                .is_some_and(|h| residuals.max() < h.residual && cycle as f64 + needed > h.cycles as f64)
            {
                status = Status::Stalled;
                break;
            }
            touching = if touches { touching + 1 } else { 0 };
            if fruitless > PATIENCE || touching > TOUCHING_CYCLES {
                status = Status::Stalled;
                break;
            }
            if cycle < stop.max_iterations {
                self.hierarchy.cycle_finest(problem, lubricant)?;
                self.hierarchy.accelerate(&mut self.acceleration, state, &self.coupled.balance);
                work.iterations += 1;
            }
        }
        if best.is_finite() {
            state.clone_from(&self.best);
            self.coupled.evaluate(problem, state)?;
        }
        let is_thick = problem.reference_film > EXPECTED_OVER_CONTACT * problem.contact_film();
        if status == Status::Stalled && is_thick && touches(problem, state) {
            status = Status::MeshTooCoarse;
        }
        Ok((status, best))
    }

    /// The finest grid's pressure as a state, evaluated, and its film back.
    fn take_over(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        state: &mut ContactState,
    ) -> Result<(), ReynoldsError> {
        state.approach = self.hierarchy.approach;
        let finest = self.hierarchy.finest_mut();
        state.pressure.copy_from_slice(&finest.pressure);
        state.fluid_pressure.copy_from_slice(&finest.pressure);
        self.coupled.evaluate(problem, state)?;
        finest.film.copy_from_slice(&self.coupled.elastic_film);
        finest.take_film(lubricant);
        Ok(())
    }
}

/// Cycles from `residual` to `tolerance` at the rate since `earlier`, [`RATE_CYCLES`] cycles ago; zero
/// before.
fn cycles_needed(residual: f64, earlier: f64, tolerance: f64) -> f64 {
    if !earlier.is_finite() {
        return 0.0;
    }
    let gained = (earlier / residual).ln() / RATE_CYCLES as f64;
    if gained > 0.0 { (residual / tolerance).ln() / gained } else { f64::INFINITY }
}

/// Whether films under pressure are below the contact film.
fn touches(problem: &LubricatedContact<'_>, state: &ContactState) -> bool {
    let contact_film = problem.contact_film();
    state.film.iter().zip(&state.pressure).any(|(h, p)| *p > 0.0 && *h < contact_film)
}

/// Whether no pressure exceeds its limit.
fn within_limit(problem: &LubricatedContact<'_>, state: &ContactState) -> bool {
    state.pressure.iter().enumerate().all(|(k, p)| *p <= problem.limit_at(k))
}
