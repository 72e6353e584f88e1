//! Semismooth Newton on the whole coupled problem, linear systems by preconditioned GMRES.

mod attempt;
mod coarse_films;
mod contact_distance;
mod continuation;
mod fluid_block;
mod given_films;
mod linearisation;
mod local;
mod preconditioner;
mod progress;
mod unknowns;

use attempt::{ATTEMPTS, STEADY, THOROUGH};
pub(super) use attempt::{Attempt, BY_LINES};
pub(super) use fluid_block::{FluidBlock, Method};
use linearisation::Linearisation;
use local::{Forecast, Local, Material, Settling};
use preconditioner::BlockPreconditioner;
use progress::Progress;
use unknowns::{Response, Unknowns};

use super::active_set::{Fluid, Kind, Solid};
use super::coupled::{Coupled, limit_of};
use super::dry::DryStart;
use super::flow::Cavitation;
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, ReynoldsError, StoppingRule, check_call};
use crate::grid::Grid;
use crate::numerics::{Gmres, GridLu, PreconditionedOperator};
use crate::report::{Residuals, SolveReport, Status, Work};

/// Krylov steps within one Newton step.
const MAX_KRYLOV_STEPS: usize = 100;
/// Passes of a linear solve, and the least residual that one asks for which knows elastic responses from a sketch alone.
const MAX_PASSES: u32 = 4;
const LEAST_SKETCHED: f64 = 0.01;
/// Of the tolerance: the residual of a linear solve that is good enough.
const ENOUGH: f64 = 1.5;
/// Largest pressure change of one step, in reference pressures.
const MAX_PRESSURE_CHANGE: f64 = 1.0;
/// Contact film of a Newton step over that of the step before, down to the one of the problem.
const CONTACT_FILM_REDUCTION: f64 = 0.5;
/// The residual below which the squeeze is reduced in proportion to that as well: near the solution a step in time holds back the
/// approach, and the whole contact with it.
const FREE_BELOW: f64 = 10.0;
/// Growth of the residual after which a step is taken again at [`SHORTER`] length, and how often at most: anywhere, where an
/// attempt is careful, and once it has been without a new best residual for [`PATIENCE`] steps.
const JUMP: (f64, u32) = (4.0, 1);
const CAREFUL_JUMP: (f64, u32) = (2.0, 3);
const STRICT_JUMP: (f64, u32) = (1.0, 2);
const SHORTER: f64 = 0.5;
/// Steps without a new best residual after which the largest trust is halved, no step may let the residual grow any more, and
/// linear systems are solved to the share [`TIGHTER`] of their tolerance, where that is coarser than in a thorough attempt: what
/// they leave in a pocket of one node may be all that decides whether its fluid cavitates, and it then does in every other step.
const PATIENCE: u32 = 5;
const TIGHTER: f64 = 0.2;
/// Bounds of the change of the trust from step to step, and its least value in reference pressures.
const TRUST_CHANGE: (f64, f64) = (0.3, 2.0);
const LEAST_TRUST: f64 = 0.001;

/// Semismooth Newton solver with approach and load balance inside the system.
///
/// Each step solves the linearised equations of the sides (cavitated, fluid, contact, yielded) that the nodes are on by
/// GMRES on products of a quarter of the cost of a DC-FFT convolution, and checks them by a whole one. The preconditioner is
/// triangular: sparse LU of the fluid equations in which films follow their own pressures alone, then the pressures of the
/// contact nodes by conjugate gradients on blocks of nodes and the inverse convolution, and the load balance as a border.
/// Then every node settles by its own equations, neighbours held as the step foresees them: that decides its
/// side and follows the viscosity over its orders of magnitude, where a linear step alone makes nodes go round in cycles.
///
/// A state that carries no pressure is started from the dry contact, which is close to the answer in mixed
/// lubrication: the asperities already carry their load and the fluid fills what is left. A contact that stalls from there is
/// followed in time, from the dry contact full of fluid until it rests.
#[derive(Debug)]
pub struct NewtonKrylov {
    method: Method,
    workspace: Option<Box<Workspace>>,
}

/// Sparse LU, and Krylov's method to the tolerance of the attempt.
const FACTORISED: Method = Method {
    fluid_block: |grid| Box::new(GridLu::new(grid.nx(), grid.ny())),
    directions: MAX_KRYLOV_STEPS,
    passes: MAX_PASSES,
    attempts: &ATTEMPTS,
    follows_time: true,
};

#[derive(Debug)]
struct Workspace {
    method: Method,
    coupled: Coupled,
    unknowns: Unknowns,
    linearisation: Linearisation,
    preconditioner: BlockPreconditioner,
    gmres: Gmres,
    missing: Vec<f32>,
    step: Vec<f32>,
    correction: Vec<f32>,
    start: DryStart,
    best: Snapshot,
    best_residuals: Residuals,
    progress: Progress,
    before: Snapshot,
    /// Films through which the fluid flows in a step (see [`Workspace::close_contact`]).
    flow_film: Vec<f64>,
    /// Films that the last step foresaw.
    foreseen: Vec<f64>,
}

/// A state with the sides of its nodes and the films without plastic depth, to come back to.
#[derive(Debug, Clone)]
struct Snapshot {
    state: ContactState,
    kinds: Vec<Kind>,
    elastic_film: Vec<f64>,
}

impl Snapshot {
    fn new(grid: Grid) -> Self {
        Self {
            state: ContactState::new(&grid),
            kinds: vec![Kind::BOUNDARY; grid.len()],
            elastic_film: vec![0.0; grid.len()],
        }
    }

    fn keep(&mut self, coupled: &Coupled, state: &ContactState) {
        self.state.clone_from(state);
        self.kinds.copy_from_slice(&coupled.kinds);
        self.elastic_film.copy_from_slice(&coupled.elastic_film);
    }

    /// Puts state, sides and films back.
    fn restore(&self, coupled: &mut Coupled, problem: &LubricatedContact<'_>, state: &mut ContactState) {
        state.clone_from(&self.state);
        coupled.kinds.copy_from_slice(&self.kinds);
        coupled.elastic_film.copy_from_slice(&self.elastic_film);
        coupled.settle(problem, state);
    }
}

impl Default for NewtonKrylov {
    fn default() -> Self {
        Self::by(FACTORISED)
    }
}

impl NewtonKrylov {
    /// A solver; buffers are made at the first solve and kept.
    pub fn new() -> Self {
        Self::default()
    }

    /// A solver that goes about its equations by `method`.
    pub(super) fn by(method: Method) -> Self {
        Self { method, workspace: None }
    }

    fn workspace(&mut self, problem: &LubricatedContact<'_>) -> &mut Workspace {
        let grid = problem.grid();
        let (method, length) = (self.method, Unknowns::most(&grid));
        let kept = self.workspace.take().filter(|w| w.coupled.fluid.grid == grid);
        let workspace = kept.unwrap_or_else(|| {
            Box::new(Workspace {
                method,
                coupled: Coupled::new(grid),
                unknowns: Unknowns::new(grid),
                linearisation: Linearisation::new(grid),
                preconditioner: BlockPreconditioner::new(grid, (method.fluid_block)(&grid)),
                gmres: Gmres::new(length, method.directions),
                missing: vec![0.0; length],
                step: vec![0.0; length],
                correction: vec![0.0; length],
                start: DryStart::new(grid),
                best: Snapshot::new(grid),
                best_residuals: Residuals::default(),
                progress: Progress::new(),
                before: Snapshot::new(grid),
                flow_film: vec![0.0; grid.len()],
                foreseen: vec![0.0; grid.len()],
            })
        });
        self.workspace.insert(workspace)
    }
}

impl ContactSolver for NewtonKrylov {
    fn name(&self) -> &'static str {
        "newton_krylov"
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        check_call(problem, state, stop)?;
        let name = self.name();
        if problem.is_paper() {
            let reason = "it needs fluid and solid pressure apart, which the paper's contact does not know";
            return Err(ReynoldsError::WrongSolver { solver: name, reason });
        }
        let workspace = self.workspace(problem);
        workspace.preconditioner.configure(problem)?;
        let mut work = Work::default();
        let (status, residuals) = workspace.run(problem, state, stop, &mut work)?;
        workspace.coupled.mark_contact(problem, state);
        Ok(SolveReport { solver: name, status, residuals, energy_error: None, work })
    }
}

impl Workspace {
    /// Solves from the state as it is if it carries pressure; else, and again where that stalls, from the dry contact; at last by
    /// another way. Leaves the best state.
    fn run(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        work: &mut Work,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        self.progress = Progress::new();
        let mut status = self.attempts(self.method.attempts, problem, state, stop, work)?;
        let is_stuck = matches!(status, Status::Stalled | Status::Diverged);
        let may_follow = self.method.follows_time && problem.lubricant.is_some();
        if is_stuck && may_follow && problem.entrainment_speed > 0.0 {
            let (residuals, best) = (self.best_residuals, self.best.clone());
            if self.take_another_way(problem, state, stop, work)? {
                status = Status::Converged;
            } else {
                (self.best_residuals, self.best) = (residuals, best);
                self.coupled.configure(problem);
            }
        }
        if status != Status::Converged && self.best_residuals.mass == f64::INFINITY {
            // No step with the cut-off and the condition of the problem was taken.
            self.coupled.configure(problem);
            self.coupled.begin(problem, state)?;
            work.convolutions += self.coupled.convolutions;
            self.best_residuals = self.coupled.residuals(problem, state);
            self.best.keep(&self.coupled, state);
        }
        self.coupled.fluid.set_cavitation(problem.cavitation);
        if status != Status::Converged && self.best_residuals.is_finite() {
            if status == Status::Diverged {
                // The last attempt did; an earlier one has left a state.
                status = Status::Stalled;
            }
            self.best.restore(&mut self.coupled, problem, state);
        }
        if status == Status::MaxIterations && self.progress.has_ended() {
            status = Status::Stalled;
        }
        Ok((status, self.best_residuals))
    }

    /// One attempt after the other until one does not stall, the first from the state as it is if it carries pressure, all others
    /// from the dry contact. Keeps the best state of all.
    fn attempts(
        &mut self,
        attempts: &[Attempt],
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        work: &mut Work,
    ) -> Result<Status, ReynoldsError> {
        self.best_residuals = Residuals { mass: f64::INFINITY, ..Residuals::default() };
        let mut status = Status::Stalled;
        for (index, attempt) in attempts.iter().enumerate() {
            if matches!(status, Status::Converged | Status::MaxIterations) {
                break;
            }
            let cold = index > 0 || state.pressure.iter().all(|&p| p <= 0.0);
            let film_cutoff = problem.film_cutoff;
            let ended = self.attempt(*attempt, cold, problem, state, stop, work);
            problem.film_cutoff = film_cutoff;
            status = ended?;
            work.convolutions += self.coupled.convolutions;
        }
        Ok(status)
    }

    /// One attempt, from the dry contact with an eased contact film if it is `cold`. Leaves another cut-off in the problem.
    fn attempt(
        &mut self,
        attempt: Attempt,
        cold: bool,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        work: &mut Work,
    ) -> Result<Status, ReynoldsError> {
        let film_cutoff = problem.film_cutoff;
        if cold {
            state.pressure.fill(0.0);
            let eased = attempt.first_contact_film * film_cutoff;
            if attempt.gentle {
                problem.film_cutoff = eased;
            }
            *work += self.start.run(problem, state, attempt.effort.start)?;
            problem.film_cutoff = eased;
        }
        self.coupled.configure(problem);
        let squeeze = if cold { attempt.squeeze } else { STEADY };
        let condition = if cold { Cavitation::Reynolds } else { problem.cavitation };
        self.newton(problem, state, stop, Attempt { squeeze, ..attempt }, (film_cutoff, condition), work)
    }

    /// Newton steps until `stop` or a stall, the cut-off of the problem falling to `film_cutoff`, cavitation by `condition` until the
    /// residual is below [`FREE_BELOW`]: the gaps of the dry contact are empty, and fill layer by layer where mass is conserved. Keeps
    /// the best state of all attempts.
    fn newton(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        attempt: Attempt,
        (film_cutoff, mut condition): (f64, Cavitation),
        work: &mut Work,
    ) -> Result<Status, ReynoldsError> {
        self.coupled.fluid.set_cavitation(condition);
        self.coupled.begin(problem, state)?;
        let left = stop.max_iterations.saturating_sub(work.iterations);
        let limit = left.min(attempt.most_steps);
        let mut largest_trust = attempt.trust * problem.reference_pressure;
        let (mut squeeze, squeeze_reduction) = attempt.squeeze;
        let mut settling = Settling { trust: largest_trust, opens_together: attempt.gentle };
        let mut krylov_tolerance = attempt.effort.krylov;
        let (mut lowest, mut fruitless, mut swings) = (f64::INFINITY, 0, false);
        let mut status = if limit == left { Status::MaxIterations } else { Status::Stalled };
        let mut residuals = self.coupled.residuals(problem, state);
        for iteration in 0..=limit {
            if !residuals.is_finite() {
                status = Status::Diverged;
                break;
            }
            let eased = problem.film_cutoff > film_cutoff;
            if !eased && condition != problem.cavitation && residuals.max() < FREE_BELOW {
                condition = problem.cavitation;
                self.coupled.fluid.set_cavitation(condition);
                self.coupled.refresh(problem, state);
                residuals = self.coupled.residuals(problem, state);
            }
            let eased = eased || condition != problem.cavitation;
            // Residuals with another contact film than that of the problem tell nothing of its solution.
            if !eased {
                if residuals.max() < lowest {
                    (lowest, fruitless) = (residuals.max(), 0);
                } else {
                    fruitless += 1;
                }
                if residuals.max() < self.best_residuals.max() {
                    self.best_residuals = residuals;
                    self.best.keep(&self.coupled, state);
                }
                if residuals.max() <= stop.tolerance {
                    return Ok(Status::Converged);
                }
                if self.progress.ends(residuals.max(), work, self.coupled.convolutions) {
                    // Ends all attempts, as the limit of iterations does.
                    return Ok(Status::MaxIterations);
                }
            }
            if iteration == limit {
                break;
            }
            if fruitless == PATIENCE {
                (largest_trust, fruitless, swings) = (0.5 * largest_trust, 0, true);
                krylov_tolerance = krylov_tolerance.min((TIGHTER * krylov_tolerance).max(THOROUGH.krylov));
                settling.trust = settling.trust.min(largest_trust);
            }
            work.iterations += 1;
            if eased {
                problem.film_cutoff = (CONTACT_FILM_REDUCTION * problem.film_cutoff).max(film_cutoff);
                self.coupled.fluid.configure(problem);
                self.coupled.fluid.set_cavitation(condition);
                // The flow follows below.
                self.coupled.apply_plastic_depth(problem, state);
            }
            let free = if eased { 1.0 } else { (residuals.max() / FREE_BELOW).min(1.0) };
            self.coupled.fluid.set_step_squeeze(free * squeeze);
            squeeze *= squeeze_reduction;
            self.close_contact(problem, state);
            let Some(krylov_steps) = self.newton_step(problem, state, krylov_tolerance)? else {
                status = Status::Diverged;
                break;
            };
            work.inner_iterations += krylov_steps;
            let jump = if swings {
                STRICT_JUMP
            } else if residuals.max() < attempt.caution.careful_below {
                CAREFUL_JUMP
            } else {
                JUMP
            };
            residuals = self.advance_carefully(problem, state, settling, residuals.max(), jump)?;
            let (shorter, longer) = TRUST_CHANGE;
            let change = attempt.caution.unforeseen / self.unforeseen_share(state, problem.contact_film());
            settling.trust = (settling.trust * change.clamp(shorter, longer))
                .max(LEAST_TRUST * problem.reference_pressure)
                .min(largest_trust);
        }
        Ok(status)
    }

    /// Has the fluid flow through the contact film wherever nodes are to touch, which is the film that they have at a solution.
    ///
    /// What the last step did not foresee takes them some nanometres off it. The gap rows mend that; but mobilities go with the
    /// cube of the film, and flows through those films would drain the pockets whose rims they are.
    fn close_contact(&mut self, problem: &LubricatedContact<'_>, state: &ContactState) {
        let Some(lubricant) = problem.lubricant else { return };
        let contact_film = problem.contact_film();
        for ((flow_film, film), kind) in self.flow_film.iter_mut().zip(&state.film).zip(&self.coupled.kinds) {
            *flow_film = if kind.solid == Solid::Contact { contact_film } else { *film };
        }
        self.coupled.flow(problem, lubricant, &state.fluid_pressure, &self.flow_film);
    }

    /// Takes the step, or a shorter one if the residual `before` jumps under it; returns the residuals that it leaves.
    fn advance_carefully(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        settling: Settling,
        before: f64,
        (growth, most_times): (f64, u32),
    ) -> Result<Residuals, ReynoldsError> {
        self.before.keep(&self.coupled, state);
        let mut length = 1.0;
        self.advance(problem, state, settling, length)?;
        let mut residuals = self.coupled.residuals(problem, state);
        for _ in 0..most_times {
            if residuals.max() <= growth * before {
                break;
            }
            length *= SHORTER;
            self.before.restore(&mut self.coupled, problem, state);
            self.close_contact(problem, state);
            self.advance(problem, state, Settling { trust: length * settling.trust, ..settling }, length)?;
            residuals = self.coupled.residuals(problem, state);
        }
        Ok(residuals)
    }

    /// Solves the linearised equations into `self.step`, their residual to `tolerance` of itself; returns the Krylov steps, or
    /// none where the fluid equations of this state have no finite factors.
    ///
    /// Krylov's method knows the elastic response from a sketch; what the equations then lack, the whole response tells, and
    /// where that is too much another pass takes it.
    fn newton_step(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
        tolerance: f64,
    ) -> Result<Option<u64>, ReynoldsError> {
        let passes = self.method.passes;
        let Self { coupled, unknowns, linearisation, preconditioner, gmres, .. } = self;
        unknowns.sort(coupled, problem, state);
        if problem.lubricant.is_some() {
            linearisation.update(&coupled.fluid, coupled.near.own);
        }
        if !preconditioner.prepare(coupled, linearisation, unknowns, problem) {
            return Ok(None);
        }
        preconditioner.border(unknowns, coupled, linearisation, problem)?;
        let n = unknowns.len();
        let (missing, step) = (&mut self.missing[..n], &mut self.step[..n]);
        let correction = &mut self.correction[..n];
        step.fill(0.0);
        unknowns.missing(coupled, problem, linearisation, state, step, missing)?;
        let whole = norm(missing);
        let mut response = if coupled.fluid.grid.ny() > 1 { Response::Sketch } else { Response::Whole };
        let (mut left, mut steps) = (1.0, 0);
        for _ in 0..passes {
            let least = if response == Response::Sketch { LEAST_SKETCHED } else { 0.0 };
            let wanted = (tolerance / left).max(least);
            let mut system = System { unknowns, coupled, problem, linearisation, preconditioner, response };
            steps += gmres.solve(&mut system, missing, wanted, correction).steps;
            for (step, correction) in step.iter_mut().zip(&*correction) {
                *step += correction;
            }
            unknowns.missing(coupled, problem, linearisation, state, step, missing)?;
            let now = norm(missing) / whole;
            // No number where the equations lacked nothing.
            if now.is_nan() || now <= ENOUGH * tolerance || response == Response::Whole {
                break;
            }
            if now > 0.5 * left {
                response = Response::Whole;
            }
            left = now;
        }
        Ok(Some(steps))
    }

    /// Takes at most the share `most` of the step; every node then settles by its own equations.
    fn advance(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        settling: Settling,
        most: f64,
    ) -> Result<(), ReynoldsError> {
        let Self { coupled, unknowns, .. } = self;
        let step = &self.step[..unknowns.len()];
        let largest = unknowns.largest_pressure(step);
        let length = most * (MAX_PRESSURE_CHANGE * problem.reference_pressure / largest).min(1.0);
        let (contact_film, own_influence) = (problem.contact_film(), coupled.near.own);
        for k in 0..state.pressure.len() {
            let kind = coupled.kinds[k];
            let change = unknowns.node(k);
            let material = Material { contact_film, limit: limit_of(problem, k), own_influence, settling };
            let pressure = state.pressure[k] + length * change.pressure;
            let elastic_film = coupled.elastic_film[k] + length * change.elastic_film;
            let depth = match kind.fluid {
                Fluid::AtLimit => {
                    (state.plastic_depth[k] + length * (change.film - change.elastic_film)).max(0.0)
                }
                _ => 0.0,
            };
            let node = match problem.lubricant {
                Some(lubricant) if kind.fluid != Fluid::Boundary => {
                    let local = Local::new(&coupled.fluid, lubricant, k);
                    let (share, by_pressure, by_film) = local.present_share(self.flow_film[k]);
                    let imbalance =
                        if kind.has_balance() { 0.0 } else { coupled.balance[k] + length * change.balance };
                    let own_change = by_pressure * change.fluid_pressure + by_film * change.film;
                    let share = share + length * own_change - imbalance;
                    local.settle(material, Forecast { pressure, elastic_film, depth, share })
                }
                _ => material.settle_dry(kind.fluid, pressure, elastic_film),
            };
            self.foreseen[k] = elastic_film;
            coupled.kinds[k] = node.kind;
            state.pressure[k] = node.pressure;
            state.fluid_pressure[k] = node.fluid_pressure;
            state.plastic_depth[k] = node.depth;
        }
        state.approach += length * unknowns.approach(step);
        coupled.evaluate(problem, state)?;
        Ok(())
    }

    /// Pressure-weighted root mean square of what the last step did not foresee of the films without plastic depth, over the
    /// films or the contact film.
    fn unforeseen_share(&self, state: &ContactState, contact_film: f64) -> f64 {
        let (mut sum, mut weight) = (0.0, 0.0);
        let films = self.coupled.elastic_film.iter().zip(&self.foreseen).zip(&state.film);
        for (((elastic, foreseen), film), p) in films.zip(&state.pressure) {
            sum += p * ((elastic - foreseen) / film.max(contact_film)).powi(2);
            weight += p;
        }
        (sum / weight).sqrt()
    }
}

fn norm(x: &[f32]) -> f64 {
    x.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt()
}

/// The linearised equations as GMRES sees them.
struct System<'a, 'b> {
    unknowns: &'a mut Unknowns,
    coupled: &'a mut Coupled,
    problem: &'a mut LubricatedContact<'b>,
    linearisation: &'a mut Linearisation,
    preconditioner: &'a mut BlockPreconditioner,
    response: Response,
}

impl PreconditionedOperator for System<'_, '_> {
    fn apply(&mut self, x: &[f32], out: &mut [f32]) {
        // Shapes were checked when the solve began: the product cannot fail.
        let Self { unknowns, coupled, problem, linearisation, .. } = self;
        let result = unknowns.product(coupled, problem, linearisation, x, self.response, out);
        debug_assert!(result.is_ok(), "shapes are checked by the solve");
    }

    fn precondition(&mut self, r: &[f32], out: &mut [f32]) {
        let result = self.preconditioner.apply(self.unknowns, self.coupled, self.problem, r, out);
        debug_assert!(result.is_ok(), "shapes are checked by the solve");
    }
}
