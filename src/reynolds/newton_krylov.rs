//! Semismooth Newton on the whole coupled problem, linear systems by preconditioned GMRES.

use super::active_set::{Fluid, Kind, Solid};
use super::coupled::{Coupled, limit_of};
use super::dry::DryStart;
use super::preconditioner::{BlockPreconditioner, Unknowns};
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, ReynoldsError, StoppingRule, check_call};
use crate::numerics::{Gmres, PreconditionedOperator};
use crate::report::{Residuals, SolveReport, Status, Work};

/// Newton steps after which the solve has stalled: those that converge do so in half as many.
const MAX_NEWTON_STEPS: u64 = 60;
/// Krylov steps within one Newton step.
const MAX_KRYLOV_STEPS: usize = 100;
/// Largest pressure change of one step, in reference pressures.
const MAX_PRESSURE_CHANGE: f64 = 1.0;
/// Share of the film (plus [`FILM_MARGIN`]) that one step may take away.
const MAX_FILM_LOSS: f64 = 0.9;
/// Length added to the film in that rule, so that films near zero do not block the step \[m\].
const FILM_MARGIN: f64 = 5e-9;
/// Steps without a new best residual after which the steps are halved, which breaks cycles of the node sides.
const PATIENCE: u32 = 5;
/// Smallest damping from that rule.
const MIN_DAMPING: f64 = 0.1;
/// Scale of the inertia that goes with damping.
const INERTIA: f64 = 4.0;
/// Growth of the residuals over the largest of the last [`MEMORY`] that a step may cause.
const MAX_GROWTH: f64 = 1.5;
/// Steps that this comparison looks back.
const MEMORY: usize = 3;
/// Steps at the start that are taken whatever the residuals do.
const FREE_STEPS: u32 = 6;
/// Halvings of a step whose residuals leap.
const MAX_HALVINGS: u32 = 3;
/// Smallest step length.
const MIN_STEP: f64 = 0.05;

/// Semismooth Newton solver with approach and load balance inside the system.
///
/// Each step sorts the nodes by the primal-dual rule into cavitated, fluid, contact and yielded ones and solves the
/// linearised equations of those sides by GMRES on DC-FFT products. The preconditioner is a block one: sparse LU of the
/// fluid equations with the elastic response cut off after the next neighbours, inverse convolution masked to the
/// contact nodes, and the load balance as a border. Steps are shortened only where a film would vanish.
///
/// A state that carries no pressure is started from the dry contact, which is close to the answer in mixed
/// lubrication: the asperities already carry their load and the fluid fills what is left.
#[derive(Debug, Default)]
pub struct NewtonKrylov {
    workspace: Option<Box<Workspace>>,
}

#[derive(Debug)]
struct Workspace {
    coupled: Coupled,
    unknowns: Unknowns,
    preconditioner: BlockPreconditioner,
    gmres: Gmres,
    rhs: Vec<f64>,
    step: Vec<f64>,
    pinned: Vec<f64>,
    start: DryStart,
    best: ContactState,
    before: ContactState,
}

impl NewtonKrylov {
    /// A solver; buffers are made at the first solve and kept.
    pub fn new() -> Self {
        Self::default()
    }

    fn workspace(&mut self, problem: &LubricatedContact<'_>) -> Result<&mut Workspace, ReynoldsError> {
        let grid = problem.grid();
        let fits = self.workspace.as_ref().is_some_and(|w| w.coupled.fluid.grid == grid);
        if !fits {
            let length = 2 * grid.len() + 1;
            self.workspace = Some(Box::new(Workspace {
                coupled: Coupled::new(grid),
                unknowns: Unknowns::new(grid),
                preconditioner: BlockPreconditioner::new(grid)?,
                gmres: Gmres::new(length, MAX_KRYLOV_STEPS),
                rhs: vec![0.0; length],
                step: vec![0.0; length],
                pinned: vec![0.0; length],
                start: DryStart::new(grid),
                best: ContactState::new(&grid),
                before: ContactState::new(&grid),
            }));
        }
        self.workspace.as_deref_mut().ok_or(ReynoldsError::Memory { nodes: grid.len() })
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
        let workspace = self.workspace(problem)?;
        let mut work = Work::default();
        if state.pressure.iter().all(|&p| p <= 0.0) {
            work += workspace.start.run(problem, state)?;
        }
        let (status, residuals) = workspace.iterate(problem, state, stop, &mut work)?;
        workspace.coupled.mark_contact(state);
        Ok(SolveReport { solver: name, status, residuals, work })
    }
}

impl Workspace {
    fn iterate(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        work: &mut Work,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        self.coupled.configure(problem);
        let before = self.coupled.convolutions;
        let outcome = self.newton(problem, state, stop, work);
        work.convolutions += (self.coupled.convolutions - before) as f64;
        outcome
    }

    fn newton(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        work: &mut Work,
    ) -> Result<(Status, Residuals), ReynoldsError> {
        self.coupled.evaluate(problem, state)?;
        self.coupled.classify(problem, state);
        self.coupled.settle(problem, state);
        let mut best = Residuals { mass: f64::INFINITY, ..Residuals::default() };
        let limit = stop.max_iterations.min(MAX_NEWTON_STEPS);
        let mut damper = Damper::default();
        for iteration in 0.. {
            let residuals = self.coupled.residuals(problem, state);
            if !residuals.is_finite() {
                state.clone_from(&self.best);
                return Ok((Status::Diverged, best));
            }
            if residuals.max() < best.max() {
                best = residuals;
                self.best.clone_from(state);
            }
            damper.update(residuals.max());
            if residuals.max() <= stop.tolerance {
                return Ok((Status::Converged, residuals));
            }
            if iteration == limit {
                break;
            }
            self.coupled.classify(problem, state);
            work.iterations += 1;
            self.coupled.fluid.inertia = INERTIA * (1.0 / damper.length - 1.0);
            work.inner_iterations += self.newton_step(problem, state)?;
            self.search(problem, state, &damper)?;
        }
        state.clone_from(&self.best);
        self.coupled.evaluate(problem, state)?;
        let status = if limit == stop.max_iterations { Status::MaxIterations } else { Status::Stalled };
        Ok((status, best))
    }

    /// Solves the linearised equations into `self.step`; returns the Krylov steps.
    fn newton_step(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
    ) -> Result<u64, ReynoldsError> {
        let n = state.pressure.len();
        let contact_film = problem.contact_film();
        self.pinned.fill(0.0);
        let mut any_pinned = false;
        for (k, kind) in self.coupled.kinds.iter().enumerate() {
            let wanted = pinned_pressure(*kind, limit_of(problem, k));
            let change = wanted.map_or(0.0, |p| p - state.pressure[k]);
            self.pinned[k] = change;
            any_pinned |= change != 0.0;
        }
        let coupled = &mut self.coupled;
        let mut system = System {
            unknowns: &mut self.unknowns,
            coupled,
            problem,
            state,
            preconditioner: &mut self.preconditioner,
        };
        system.preconditioner.prepare(system.coupled, state, system.problem)?;
        if any_pinned {
            system.unknowns.product(system.coupled, system.problem, state, &self.pinned, &mut self.rhs)?;
        } else {
            self.rhs.fill(0.0);
        }
        let load: f64 = state.pressure.iter().sum::<f64>() * system.coupled.fluid.grid.cell_area();
        for k in 0..n {
            let kind = system.coupled.kinds[k];
            let balance = if kind.has_balance() { system.coupled.balance[k] } else { 0.0 };
            let (first, second) = match kind.solid {
                Solid::Open => (balance, 0.0),
                Solid::Contact => (system.coupled.elastic_film[k] - contact_film, balance),
                Solid::Yielded => (0.0, balance),
            };
            self.rhs[k] = -(self.rhs[k] + first);
            self.rhs[n + k] = -(self.rhs[n + k] + second);
        }
        let missing = Unknowns::load_row(system.problem, system.coupled.near, load - system.problem.load);
        self.rhs[2 * n] = -(self.rhs[2 * n] + missing);
        system.preconditioner.border(system.unknowns, system.coupled, system.problem, state)?;
        let outcome = self.gmres.solve(&mut system, &self.rhs, KRYLOV_TOLERANCE, &mut self.step);
        for (s, p) in self.step.iter_mut().zip(&self.pinned) {
            *s += p;
        }
        Ok(outcome.steps)
    }

    /// Takes the step, shortened where a film would vanish, and halves it while the residuals leap.
    fn search(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        damper: &Damper,
    ) -> Result<(), ReynoldsError> {
        let mut length = damper.length.sqrt() * self.step_length(problem, state)?;
        self.before.clone_from(state);
        for trial in 0..=MAX_HALVINGS {
            self.advance(problem, state, length)?;
            let size = self.coupled.residuals(problem, state).max();
            if trial == MAX_HALVINGS || damper.accepts(size) {
                break;
            }
            state.clone_from(&self.before);
            length *= 0.5;
        }
        Ok(())
    }

    /// Adds `length` times the step to the state.
    fn advance(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        length: f64,
    ) -> Result<(), ReynoldsError> {
        let n = state.pressure.len();
        for k in 0..n {
            let limit = limit_of(problem, k);
            let kind = self.coupled.kinds[k];
            let change = length * self.step[k];
            match kind.solid {
                Solid::Open if kind.fluid == Fluid::AtLimit => {
                    state.pressure[k] = limit;
                    state.fluid_pressure[k] = limit;
                    state.plastic_depth[k] += self.coupled.near.own * change;
                    self.coupled.overflow[k] = state.plastic_depth[k] > 0.0;
                }
                Solid::Open => {
                    let wanted = state.pressure[k] + change;
                    self.coupled.overflow[k] = wanted > limit;
                    state.pressure[k] = wanted.clamp(0.0, limit);
                    state.fluid_pressure[k] = state.pressure[k];
                }
                Solid::Contact | Solid::Yielded => {
                    state.pressure[k] = (state.pressure[k] + change).clamp(0.0, limit);
                    let fluid = if kind.fluid == Fluid::Active {
                        state.fluid_pressure[k] + length * self.step[n + k]
                    } else {
                        0.0
                    };
                    self.coupled.overflow[k] = kind.solid == Solid::Yielded && fluid > limit;
                    state.fluid_pressure[k] = fluid.clamp(0.0, limit);
                }
            }
        }
        state.approach += length * self.step[2 * n];
        self.coupled.evaluate(problem, state)?;
        Ok(())
    }

    fn step_length(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
    ) -> Result<f64, ReynoldsError> {
        let mut length: f64 = 1.0;
        let mut largest = 0.0_f64;
        for (k, kind) in self.coupled.kinds.iter().enumerate() {
            if kind.fluid != Fluid::AtLimit {
                largest = largest.max(self.step[k].abs());
            }
        }
        if largest > 0.0 {
            length = length.min(MAX_PRESSURE_CHANGE * problem.reference_pressure / largest);
        }
        let floor = MIN_STEP * length;
        let film_change = self.unknowns.film_change(&mut self.coupled, problem, &self.step)?;
        let nodes = self.coupled.kinds.iter().zip(state.film.iter().zip(film_change));
        for (kind, (film, change)) in nodes {
            if kind.is_open_fluid() && *change < 0.0 && *film > 0.0 {
                length = length.min(-MAX_FILM_LOSS * (film + FILM_MARGIN) / change);
            }
        }
        Ok(length.max(floor))
    }
}

/// Decides how much of a Newton step is taken from the residuals of the steps before.
#[derive(Debug)]
struct Damper {
    length: f64,
    best: f64,
    fruitless: u32,
    recent: [f64; MEMORY],
    falls: u32,
    steps: u32,
}

impl Default for Damper {
    fn default() -> Self {
        Self {
            length: 1.0,
            best: f64::INFINITY,
            fruitless: 0,
            recent: [f64::INFINITY; MEMORY],
            falls: 0,
            steps: 0,
        }
    }
}

impl Damper {
    /// Halves the length after [`PATIENCE`] steps without a new best, doubles it after two falls in a row.
    fn update(&mut self, size: f64) {
        self.steps += 1;
        self.falls = if size < self.recent[0] { self.falls + 1 } else { 0 };
        self.recent.rotate_right(1);
        self.recent[0] = size;
        if size < self.best {
            self.best = size;
            self.fruitless = 0;
        } else {
            self.fruitless += 1;
        }
        if self.falls >= 2 {
            self.length = (2.0 * self.length).min(1.0);
        } else if self.fruitless > 0 && self.fruitless.is_multiple_of(PATIENCE) {
            self.length = (0.5 * self.length).max(MIN_DAMPING);
        }
    }

    /// Whether a step that leads to residuals of `size` is taken as it is.
    ///
    /// The first steps always are: residuals of a start say little, since its sets are not those of the answer.
    fn accepts(&self, size: f64) -> bool {
        self.steps <= FREE_STEPS || size <= MAX_GROWTH * self.recent.iter().copied().fold(0.0, f64::max)
    }
}

/// Reduction of the linear residual in each Newton step.
const KRYLOV_TOLERANCE: f64 = 0.003;

/// The pressure a node is held at, if its pressure is not an unknown.
fn pinned_pressure(kind: Kind, limit: f64) -> Option<f64> {
    match (kind.fluid, kind.solid) {
        (Fluid::Boundary, _) | (Fluid::Cavitated, Solid::Open) => Some(0.0),
        (_, Solid::Yielded) => Some(limit),
        _ => None,
    }
}

/// The linearised equations as GMRES sees them.
struct System<'a, 'b, 'c> {
    unknowns: &'a mut Unknowns,
    coupled: &'a mut Coupled,
    problem: &'a mut LubricatedContact<'b>,
    state: &'c ContactState,
    preconditioner: &'a mut BlockPreconditioner,
}

impl PreconditionedOperator for System<'_, '_, '_> {
    fn apply(&mut self, x: &[f64], out: &mut [f64]) {
        // Shapes were checked when the solve began: the product cannot fail.
        let result = self.unknowns.product(self.coupled, self.problem, self.state, x, out);
        debug_assert!(result.is_ok(), "shapes are checked by the solve");
    }

    fn precondition(&mut self, r: &[f64], out: &mut [f64]) {
        let result = self.preconditioner.apply(self.coupled, self.problem, r, out);
        debug_assert!(result.is_ok(), "shapes are checked by the solve");
    }
}
