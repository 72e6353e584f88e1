//! Dry rough contact with a pressure limit.
//!
//! The pressure minimizes the energy `1/2 p K p + gap p` at a prescribed load, subject to `0 <= p <= limit`.
//! The minimum is unique where `K` is positive definite.
//!
//! The optimality conditions are those of contact: the gap is closed where the pressure lies between its
//! bounds, the pressure is zero where the gap is open, and the bodies overlap where the pressure is at its
//! limit. The overlap is the depth of plastic flattening. `energy_error` bounds the distance of an
//! approximate pressure from the minimum.
//!
//! `active_set` assigns a state to each node, `relax` closes the gaps of the free nodes for fixed states, and
//! `coarser` computes a start on a grid of half as many cells per axis. The module depends on
//! [`DeformationModel`] alone. [`reynolds::Dry`](crate::reynolds::Dry) is the same solver behind the trait of
//! contact solvers.

mod active_set;
mod coarser;
mod problem;
mod relax;

use super::DeformationModel;
use crate::error::InputError;
use crate::grid::Grid;
use active_set::NodeState;
use coarser::Coarser;
pub use problem::{DryOutcome, DryProblem};

/// Pass after which updates of the active set are damped, to end cycling.
const UNDAMPED_PASSES: u64 = 25;
/// Stall window: passes within which the gap error must fall by the factor [`SUFFICIENT_DECREASE`].
const STALL_WINDOW: u64 = 100;
/// Ratio of the gap error to the lowest one so far that counts as progress.
const SUFFICIENT_DECREASE: f64 = 0.9;
/// Gap error above which the start is recomputed on a coarser grid. Pressures interpolated from that grid
/// have an error of this order.
const POOR_START: f64 = 0.02;

/// Problem and stopping criteria of a solve.
struct SolveParameters<'a> {
    /// The contact problem.
    problem: &'a DryProblem<'a>,
    /// Sum of the pressures \[Pa\].
    target: f64,
    /// Reference that gaps are relative to \[m\]: the smallest undeformed gap.
    reference_gap: f64,
    /// Gap error at convergence.
    tolerance: f64,
    /// Largest number of passes.
    max_passes: u64,
}

/// Active-set conjugate gradients with a pressure limit at each node and the load as a constraint, on nested
/// grids.
///
/// Within a pass the active set is fixed. Conjugate gradients at constant load close the gap of the free
/// nodes, preconditioned by the pressure estimate of the model (for the half-space `|q|` on the periodic
/// grid) restricted to the free nodes. A pass ends as soon as the bound violations of free nodes hold as much
/// energy as their gap errors. Nodes beyond their bounds then leave the free set. Nodes whose gap has the
/// wrong sign enter it once these gaps outweigh the gap errors of the free nodes (proportioning: Dostal 1997,
/// SIAM J. Optim. 7, 871-887). Polonsky and Keer (1999, Wear 231, 206-219) update the active set in every
/// step instead, which stalls when many nodes are at the limit.
///
/// Products within a pass are
/// [`ResponseApproximations::displacement_single`](super::ResponseApproximations::displacement_single); gaps
/// that decide on convergence and the active set use [`DeformationModel::displacement`]. A start whose gap
/// error exceeds 2 % is first solved to 0.1 % on half of the cells per axis, recursively down to 16 cells, if
/// the model exists on other grids ([`DeformationModel::on_grid`]).
///
/// # Examples
///
/// A ball that yields at its center:
///
/// ```
/// use stribeck::Grid;
/// use stribeck::elastic::{DryProblem, DrySolver, HalfSpace};
/// let grid = Grid::centred(48, 48, 1e-5, 1e-5)?;
/// let gap: Vec<f64> = grid.nodes().map(|(x, y)| (x * x + y * y) / 0.02).collect();
/// let limit = vec![0.8e9; grid.len()];
/// let problem = DryProblem { gap: &gap, load: 30.0, limit: Some(&limit) };
/// let mut pressure = vec![0.0; grid.len()];
/// let mut body = HalfSpace::new(grid, 230e9)?;
/// let outcome = DrySolver::new(grid.len()).solve(&problem, &mut body, &mut pressure, 1e-6, 500)?;
/// assert!(outcome.converged && outcome.energy_error < 1e-3);
/// assert_eq!(pressure.iter().copied().fold(0.0, f64::max), 0.8e9);
/// assert!((pressure.iter().sum::<f64>() * grid.cell_area() / 30.0 - 1.0).abs() < 1e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug)]
pub struct DrySolver {
    /// State of each node.
    state: Vec<NodeState>,
    /// The free nodes of a pass.
    free: Vec<usize>,
    /// `gap + K p` less the reference gap \[m\].
    gap: Vec<f64>,
    /// Gap error of the free nodes, zero elsewhere \[m\].
    residual: Vec<f64>,
    /// Preconditioned residual.
    estimate: Vec<f64>,
    /// Search direction \[Pa\].
    direction: Vec<f64>,
    /// Its displacement \[m\].
    displacement: Vec<f64>,
    /// Pressure with the lowest gap error so far.
    best: Vec<f64>,
    /// The contact on half of the cells, created at first use.
    coarser: Option<Box<Coarser>>,
}

impl DrySolver {
    /// Solver for fields of `n` nodes. Coarser grids are allocated at first use.
    pub fn new(n: usize) -> Self {
        let zeros = || vec![0.0; n];
        Self {
            state: vec![NodeState::Open; n],
            free: Vec::with_capacity(n),
            gap: zeros(),
            residual: zeros(),
            estimate: zeros(),
            direction: zeros(),
            displacement: zeros(),
            best: zeros(),
            coarser: None,
        }
    }

    /// Solves `problem`, starting from `pressure`. Stops when the gap error is at most `tolerance`, after
    /// `max_passes` passes, or when a hundred passes have brought no progress, as rounding bounds the
    /// attainable error. In the last two cases `pressure` is the best one found.
    ///
    /// # Errors
    /// Slices that do not fit the grid of `deformation` or this solver.
    pub fn solve(
        &mut self,
        problem: &DryProblem<'_>,
        deformation: &mut dyn DeformationModel,
        pressure: &mut [f64],
        tolerance: f64,
        max_passes: u64,
    ) -> Result<DryOutcome, InputError> {
        let grid = deformation.grid();
        self.check(problem, pressure, &grid)?;
        // Gaps relative to the smallest one avoid cancellation with the rigid offset of the bodies.
        let reference_gap = problem.gap.iter().copied().fold(f64::INFINITY, f64::min);
        let parameters = SolveParameters {
            problem,
            target: problem.load / grid.cell_area(),
            reference_gap,
            tolerance,
            max_passes,
        };
        let mut outcome = DryOutcome {
            gap_error: f64::INFINITY,
            energy_error: f64::INFINITY,
            approach: 0.0,
            convolutions: 0.0,
            passes: 0,
            steps: 0,
            converged: false,
        };
        let level = self.iterate(&parameters, deformation, pressure, &mut outcome)?;
        if outcome.gap_error.is_finite() {
            outcome.energy_error = self.energy_error(problem, pressure);
        }
        outcome.approach = level + reference_gap;
        self.gap.iter_mut().for_each(|g| *g -= level);
        Ok(outcome)
    }

    /// Rejects slices that do not fit `grid`, the first one by name.
    fn check(&self, problem: &DryProblem<'_>, pressure: &[f64], grid: &Grid) -> Result<(), InputError> {
        for (field, len) in [
            ("gap", problem.gap.len()),
            ("pressure", pressure.len()),
            ("dry solver", self.gap.len()),
            ("limit", problem.limit.map_or(grid.len(), <[f64]>::len)),
        ] {
            if len != grid.len() {
                return Err(InputError::Shape { field: field.to_owned(), expected: grid.len(), found: len });
            }
        }
        Ok(())
    }

    /// Active-set passes until convergence, stall or the pass limit; returns the level of the gaps and leaves
    /// the best pressure.
    fn iterate(
        &mut self,
        parameters: &SolveParameters<'_>,
        deformation: &mut dyn DeformationModel,
        pressure: &mut [f64],
        outcome: &mut DryOutcome,
    ) -> Result<f64, InputError> {
        let problem = parameters.problem;
        self.start(problem, pressure, parameters.target);
        let (mut lowest, mut best, mut last_progress) = (f64::INFINITY, f64::INFINITY, 0);
        loop {
            // gaps and their error under the exact displacement
            outcome.passes += 1;
            let (level, scale, may_update) = self.evaluate(parameters, deformation, pressure, outcome)?;
            outcome.converged = outcome.gap_error <= parameters.tolerance;
            // progress, and the best pressure so far
            if outcome.gap_error < SUFFICIENT_DECREASE * lowest {
                (lowest, last_progress) = (outcome.gap_error, outcome.passes);
            }
            if outcome.gap_error < best {
                best = outcome.gap_error;
                self.best.copy_from_slice(pressure);
            }
            if outcome.converged {
                return Ok(level);
            }
            if outcome.passes >= parameters.max_passes || outcome.passes - last_progress >= STALL_WINDOW {
                break;
            }
            // a poor start is replaced by the solution on half of the cells
            if outcome.passes == 1 && outcome.gap_error > POOR_START {
                let cost = self.start_from_coarser(problem, deformation, pressure, parameters.tolerance)?;
                outcome.convolutions += cost;
                if cost > 0.0 {
                    self.start(problem, pressure, parameters.target);
                    continue;
                }
            }
            let damped = outcome.passes > UNDAMPED_PASSES;
            // open and limited nodes with the wrong gap become free
            if may_update {
                self.free_violators(level, damped);
            }
            // close the gaps of the free nodes, then enforce bounds and load
            self.relax(problem, deformation, pressure, (parameters.tolerance * scale, damped), outcome)?;
            self.enforce_bounds(problem, pressure);
            self.restore_load(problem, pressure, parameters.target);
        }
        if outcome.gap_error > best {
            pressure.copy_from_slice(&self.best);
            self.start(problem, pressure, parameters.target);
        }
        Ok(self.evaluate(parameters, deformation, pressure, outcome)?.0)
    }

    /// Gap under the pressure of the last solve \[m\], negative where nodes at their limit overlap.
    pub fn gap(&self) -> &[f64] {
        &self.gap
    }

    /// Evaluates deformed gaps relative to the reference gap, and their error. Returns the level of the free
    /// gaps, the mean displacement, and whether the free gaps are closed far enough to update the active set.
    fn evaluate(
        &mut self,
        parameters: &SolveParameters<'_>,
        deformation: &mut dyn DeformationModel,
        pressure: &[f64],
        outcome: &mut DryOutcome,
    ) -> Result<(f64, f64, bool), InputError> {
        deformation.displacement(pressure, &mut self.displacement)?;
        outcome.convolutions += 1.0;
        let (mut work, mut sum) = (0.0, 0.0);
        for ((g, z), (u, p)) in
            self.gap.iter_mut().zip(parameters.problem.gap).zip(self.displacement.iter().zip(pressure))
        {
            *g = (z - parameters.reference_gap) + u;
            work += u * p;
            sum += p;
        }
        let scale = if sum > 0.0 { work / sum } else { f64::MIN_POSITIVE };
        let level = self.free_mean(&self.gap);
        let (error, may_update) = self.gap_error(parameters.problem, pressure, level);
        outcome.gap_error = error / scale;
        Ok((level, scale, may_update))
    }

    /// Mean gap error \[m\], and whether the sum of squares of the gaps with the wrong sign exceeds that of
    /// the errors of the free nodes.
    fn gap_error(&self, problem: &DryProblem<'_>, pressure: &[f64], level: f64) -> (f64, bool) {
        let (mut error, mut n, mut free, mut wrong) = (0.0, 0_usize, 0.0, 0.0);
        for (k, (state, g)) in self.state.iter().zip(&self.gap).enumerate() {
            let violation = match state {
                // Damped passes leave some free nodes beyond their bounds.
                NodeState::Free if pressure[k] < 0.0 || pressure[k] > problem.limit_of(k) => f64::INFINITY,
                NodeState::Free => (g - level).abs(),
                NodeState::Open => (level - g).max(0.0),
                NodeState::Limited => (g - level).max(0.0),
            };
            error += violation;
            *(if *state == NodeState::Free { &mut free } else { &mut wrong }) += violation * violation;
            n += usize::from(matches!(state, NodeState::Free | NodeState::Limited));
        }
        (error / n.max(1) as f64, wrong > free)
    }

    /// The duality gap over the elastic energy, from the evaluated pressures, gaps and displacements.
    fn energy_error(&self, problem: &DryProblem<'_>, pressure: &[f64]) -> f64 {
        let lowest = (0..pressure.len())
            .filter(|&k| pressure[k] < problem.limit_of(k))
            .map(|k| self.gap[k])
            .fold(f64::INFINITY, f64::min);
        if lowest == f64::INFINITY {
            return 0.0;
        }
        let (mut excess, mut work) = (0.0, 0.0);
        for (k, &p) in pressure.iter().enumerate() {
            excess += p * (self.gap[k] - lowest).max(0.0);
            work += p * self.displacement[k];
        }
        excess / (0.5 * work)
    }
}
