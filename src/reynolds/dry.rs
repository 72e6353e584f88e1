//! Dry contact: a solver, and the start of lubricated solvers.
//!
//! The solver in `elastic` gets gap, load and pressure limit of the problem, and its result is written to a
//! `ContactState`. As a start of a lubricated solve the bodies are moved apart by the contact film. If the expected
//! film exceeds twice the mean dry gap, they are moved apart by that film, with all pressure in the fluid.

use super::coupled::{Changed, Coupled};
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, ReynoldsError, StoppingRule};
use crate::elastic::{DryOutcome, DryProblem, DrySolver};
use crate::grid::Grid;
use crate::report::{SolveReport, Status, Work};
use crate::reynolds::inner_nodes::interior;
use crate::solver_id::SolverId;

/// Expected film over mean dry gap above which a start has fluid pressure only.
const FILM_OVER_GAP: f64 = 2.0;
/// Active-set passes of a start.
const START_PASSES: u64 = 40;

/// The dry contact of a problem with or without lubricant, written to a state.
#[derive(Debug)]
pub(super) struct DryStart {
    /// Active-set conjugate gradients.
    solver: DrySolver,
}

impl DryStart {
    /// Buffers for `grid`.
    pub(super) fn new(grid: Grid) -> Self {
        Self { solver: DrySolver::new(grid.len()) }
    }

    /// Solves to a gap error of `tolerance`: the lubricated solve changes the active set anyway.
    pub(super) fn run(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        tolerance: f64,
    ) -> Result<Work, ReynoldsError> {
        let outcome = self.solve(problem, state, tolerance, START_PASSES)?;
        if problem.reference_film > FILM_OVER_GAP * self.mean_gap(problem) {
            // The expected film is thicker than the dry gap: the fluid carries the load.
            for k in interior(&problem.grid()) {
                state.fluid_pressure[k] = state.pressure[k];
            }
            state.approach -= problem.reference_film - problem.contact_film();
        }
        Ok(Work { convolutions: outcome.convolutions, ..Work::default() })
    }

    /// Mean gap of the dry contact inside the reference ellipse \[m\].
    fn mean_gap(&self, problem: &LubricatedContact<'_>) -> f64 {
        let grid = problem.grid();
        let (mut sum, mut n) = (0.0, 0_usize);
        for (k, point) in grid.nodes().enumerate() {
            let [along, across] = problem.reference_distances(&grid, point);
            if along + across <= 1.0 {
                sum += self.solver.gap()[k].max(0.0);
                n += 1;
            }
        }
        sum / n.max(1) as f64
    }

    /// Solves the dry problem and writes pressures and approach. If `state` has no pressure, the start is Hertzian.
    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        tolerance: f64,
        max_passes: u64,
    ) -> Result<DryOutcome, ReynoldsError> {
        if state.pressure.iter().all(|&p| p <= 0.0) {
            hertzian(problem, &mut state.pressure);
        }
        let load = problem.box_load().unwrap_or(problem.load);
        let dry = DryProblem { gap: problem.gap, load, limit: problem.pressure_limit };
        let outcome =
            self.solver.solve(&dry, problem.deformation, &mut state.pressure, tolerance, max_passes)?;
        for (k, p) in state.pressure.iter_mut().enumerate() {
            *p = p.clamp(0.0, problem.limit_at(k));
        }
        state.fluid_pressure.fill(0.0);
        state.plastic_depth.fill(0.0);
        // The lubricated film is measured from the contact film: move the bodies apart by it.
        state.approach = outcome.approach - problem.contact_film();
        Ok(outcome)
    }
}

/// A Hertzian pressure of the reference size as the first guess.
pub(super) fn hertzian(problem: &LubricatedContact<'_>, pressure: &mut [f64]) {
    hertzian_on(&problem.grid(), problem, pressure);
}

/// The same on another grid.
pub(super) fn hertzian_on(grid: &Grid, problem: &LubricatedContact<'_>, pressure: &mut [f64]) {
    for (p, point) in pressure.iter_mut().zip(grid.nodes()) {
        let [along, across] = problem.reference_distances(grid, point);
        let inside = 1.0 - along - across;
        *p = problem.reference_pressure * inside.max(0.0).sqrt();
    }
}

/// Dry contact by active-set conjugate gradients. A lubricant in the problem is an error. So is a contact at the
/// edge of the box, because the contact outside of it would be missing.
///
/// # Examples
///
/// Hertz' contact of a ball on a plane:
///
/// ```
/// use stribeck::analytic::HertzPoint;
/// use stribeck::elastic::HalfSpace;
/// use stribeck::reynolds::{ContactSolver, ContactState, Dry, LubricatedContact, StoppingRule};
/// use stribeck::Grid;
/// let hertz = HertzPoint::from_max_pressure(1e-2, 1e-2, 230e9, 1e9)?;
/// let grid = Grid::centred(64, 64, 3.0 * hertz.half_width_x / 64.0, 3.0 * hertz.half_width_x / 64.0)?;
/// let gap: Vec<f64> = grid.nodes().map(|(x, y)| (x * x + y * y) / 0.02).collect();
/// let mut body = HalfSpace::new(grid, 230e9)?;
/// let mut problem = LubricatedContact::new(&gap, &mut body, hertz.force, (hertz.half_width_x, hertz.half_width_y), hertz.pressure);
/// let mut state = ContactState::new(&grid);
/// Dry::new().solve(&mut problem, &mut state, &StoppingRule::default())?.require_converged()?;
/// let peak = state.pressure.iter().copied().fold(0.0, f64::max);
/// assert!((peak / hertz.pressure - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Dry {
    /// Whether contact at the edge of the box is accepted.
    edge_contact: bool,
    /// Buffers, allocated at the first solve.
    workspace: Option<Box<(DryStart, Coupled)>>,
}

impl Clone for Dry {
    /// The clone allocates its buffers at its first solve.
    fn clone(&self) -> Self {
        Self { edge_contact: self.edge_contact, workspace: None }
    }
}

impl Dry {
    /// A solver; buffers are allocated at the first solve and kept.
    pub fn new() -> Self {
        Self::default()
    }

    /// A solver that accepts contact at the edge of the box.
    pub fn allowing_edge_contact() -> Self {
        Self { edge_contact: true, workspace: None }
    }
}

/// Error if a node of the two outermost rings carries pressure.
fn reject_edge_contact(grid: &Grid, state: &ContactState) -> Result<(), ReynoldsError> {
    let (nx, ny) = (grid.nx(), grid.ny());
    for k in 0..grid.len() {
        let (i, j) = (k % nx, k / nx);
        let at_edge = i <= 1 || i + 2 >= nx || (grid.has_side_edges() && (j <= 1 || j + 2 >= ny));
        if at_edge && state.pressure[k] > 0.0 {
            return Err(ReynoldsError::EdgeContact { x: grid.x(i), y: grid.y(j) });
        }
    }
    Ok(())
}

impl ContactSolver for Dry {
    fn id(&self) -> SolverId {
        SolverId::Dry
    }

    fn unsupported(&self, problem: &LubricatedContact<'_>) -> Option<&'static str> {
        problem.lubricant.is_some().then_some("the problem has a lubricant")
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        self.check(problem, state, stop)?;
        let grid = problem.grid();
        let kept = self.workspace.take().filter(|w| w.1.fluid.grid == grid);
        let workspace = kept.unwrap_or_else(|| Box::new((DryStart::new(grid), Coupled::new(grid))));
        let (start, coupled) = &mut **self.workspace.insert(workspace);
        // The report averages gap errors over the reference ellipse, the solver over the real contact, which may be
        // larger.
        let (half_x, half_y) = problem.reference_half_widths;
        let share = std::f64::consts::PI * half_x * half_y / (grid.size_x() * grid.size_y());
        let tolerance = stop.tolerance * share.min(1.0);
        let outcome = start.solve(problem, state, tolerance, stop.max_iterations)?;
        coupled.configure(problem);
        let residuals = coupled.evaluate(problem, state, Changed::Everything)?;
        coupled.mark_contact(state);
        let status = if !residuals.is_finite() {
            Status::Diverged
        } else if outcome.converged && residuals.max() <= stop.tolerance {
            Status::Converged
        } else if outcome.passes < stop.max_iterations {
            Status::Stalled
        } else {
            Status::MaxIterations
        };
        if status == Status::Converged && !self.edge_contact {
            reject_edge_contact(&grid, state)?;
        }
        let work = Work {
            convolutions: outcome.convolutions + coupled.convolutions,
            iterations: outcome.passes,
            inner_iterations: outcome.steps,
        };
        Ok(SolveReport::new(self.id(), status, residuals)
            .with_energy_error(outcome.energy_error)
            .with_work(work))
    }
}
