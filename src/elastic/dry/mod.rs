//! Dry rough contact: pressure between zero and a limit that closes the gap where it acts.
//!
//! The minimum of the energy `1/2 p K p + gap p` under a load, pressures between zero and the limit. It is
//! unique where `K` is positive definite.
//!
//! In words: where bodies touch below the limit the gap is closed, where they do not touch there is no
//! pressure, and where the limit is reached the bodies overlap, which is what has been flattened. A pressure
//! that is not quite the solution has more energy than the minimum; `energy_error` bounds by how much.
//!
//! `sides` sorts the nodes by the condition that they fulfil, `relax` closes the gaps of the free ones for a
//! fixed sorting, and `coarser` starts from the contact on half of the cells. The room rests on
//! [`DeformationModel`] alone: any model that implements it will do. [`reynolds::Dry`](crate::reynolds::Dry)
//! is this solver under the trait of contact solvers.

mod coarser;
mod problem;
mod relax;
mod sides;

use super::DeformationModel;
use crate::error::InputError;
use crate::grid::Grid;
use coarser::Coarser;
pub use problem::{DryOutcome, DryProblem};
use sides::Side;

/// Passes of the active set after which only the worst violators change sides, which ends cycling.
const FREE_PASSES: u64 = 25;
/// Passes in which the gap error must fall, by the factor [`LEAST_GAIN`] at least, for the solve to go on.
const PATIENCE: u64 = 100;
/// Factor by which an error is lower than the lowest before for that to count.
const LEAST_GAIN: f64 = 0.9;
/// Gap error above which a start is no better than that of a coarser grid, whose pressures leave this much.
const COARSE_START: f64 = 0.02;

/// What a solve is asked for.
struct Task<'a> {
    /// What is to be solved.
    problem: &'a DryProblem<'a>,
    /// Sum of the pressures \[Pa\].
    target: f64,
    /// What gaps are counted from \[m\].
    datum: f64,
    /// Gap error to stop at.
    tolerance: f64,
    /// Passes at most.
    max_passes: u64,
}

/// Active-set conjugate gradients with a per-node pressure limit and the load as a constraint, on nested
/// grids.
///
/// Within a pass the sets are fixed, and conjugate gradients at constant load close the gap of the free
/// nodes, preconditioned by the pressure estimate of the model (`|q|` on the periodic grid for the
/// half-space) masked to them. A pass ends as soon as the nodes beyond their bounds hold as much energy as
/// the gaps of the free ones. Then nodes beyond their bounds change sides, and nodes whose gaps are on the
/// wrong side become free once these gaps outweigh those of the free nodes (proportioning: Dostal 1997, SIAM
/// J. Optim. 7, 871-887). Polonsky and Keer (1999, Wear 231, 206-219) change sides at every step instead,
/// which stalls once many nodes sit at the limit.
///
/// The products within a pass are those of
/// [`ResponseApproximations::displacement_single`](super::ResponseApproximations::displacement_single), the
/// gaps that decide are of [`DeformationModel::displacement`]. A start whose gap error exceeds 2 % is solved
/// to 0.1 % on half the cells first, where the model lives on other grids ([`DeformationModel::on_grid`]),
/// down to 16 cells.
///
/// # Examples
///
/// A ball that is pressed until its middle yields:
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
    /// Which condition holds at each node.
    side: Vec<Side>,
    /// The free nodes of a pass.
    free: Vec<usize>,
    /// `gap + K p` less a datum \[m\].
    gap: Vec<f64>,
    /// Gap error of the free nodes, zero elsewhere \[m\].
    residual: Vec<f64>,
    /// Preconditioned residual.
    estimate: Vec<f64>,
    /// Search direction \[Pa\].
    direction: Vec<f64>,
    /// Its displacement \[m\].
    displacement: Vec<f64>,
    /// Pressure of the lowest gap error.
    best: Vec<f64>,
    /// The contact on half the cells, made when it is first needed.
    coarser: Option<Box<Coarser>>,
}

impl DrySolver {
    /// Solver for fields of `n` nodes. What it needs of coarser grids is made when they are first used.
    pub fn new(n: usize) -> Self {
        let zeros = || vec![0.0; n];
        Self {
            side: vec![Side::Open; n],
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

    /// Solves `problem`, starting from `pressure`. Ends when the gap error is at most `tolerance`, after
    /// `max_passes` passes, or when a hundred passes have brought nothing, as rounding bounds what can be
    /// reached; then with the best pressure found.
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
        // Gaps are counted from the lowest, so that no offset of the bodies costs digits.
        let datum = problem.gap.iter().copied().fold(f64::INFINITY, f64::min);
        let task = Task { problem, target: problem.load / grid.cell_area(), datum, tolerance, max_passes };
        let mut outcome = DryOutcome {
            gap_error: f64::INFINITY,
            energy_error: f64::INFINITY,
            approach: 0.0,
            convolutions: 0.0,
            passes: 0,
            steps: 0,
            converged: false,
        };
        let level = self.iterate(&task, deformation, pressure, &mut outcome)?;
        if outcome.gap_error.is_finite() {
            outcome.energy_error = self.energy_error(problem, pressure);
        }
        outcome.approach = level + datum;
        self.gap.iter_mut().for_each(|g| *g -= level);
        Ok(outcome)
    }

    /// Refuses slices that do not fit `grid`, the first by name.
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

    /// Passes until one of the ends of a solve; returns the level of the gaps and leaves the best pressure.
    fn iterate(
        &mut self,
        task: &Task<'_>,
        deformation: &mut dyn DeformationModel,
        pressure: &mut [f64],
        outcome: &mut DryOutcome,
    ) -> Result<f64, InputError> {
        let problem = task.problem;
        self.start(problem, pressure, task.target);
        let (mut lowest, mut best, mut last_gain) = (f64::INFINITY, f64::INFINITY, 0);
        loop {
            outcome.passes += 1;
            let (level, scale, is_settled) = self.evaluate(task, deformation, pressure, outcome)?;
            outcome.converged = outcome.gap_error <= task.tolerance;
            if outcome.gap_error < LEAST_GAIN * lowest {
                (lowest, last_gain) = (outcome.gap_error, outcome.passes);
            }
            if outcome.gap_error < best {
                best = outcome.gap_error;
                self.best.copy_from_slice(pressure);
            }
            if outcome.converged {
                return Ok(level);
            }
            if outcome.passes >= task.max_passes || outcome.passes - last_gain >= PATIENCE {
                break;
            }
            if outcome.passes == 1 && outcome.gap_error > COARSE_START {
                let cost = self.start_from_coarser(problem, deformation, pressure, task.tolerance)?;
                outcome.convolutions += cost;
                if cost > 0.0 {
                    self.start(problem, pressure, task.target);
                    continue;
                }
            }
            let cautious = outcome.passes > FREE_PASSES;
            if cautious || is_settled {
                self.touch(level, cautious);
            }
            self.relax(problem, deformation, pressure, (task.tolerance * scale, cautious), outcome)?;
            self.clip(problem, pressure, cautious);
            self.restore_load(problem, pressure, task.target);
        }
        if outcome.gap_error > best {
            pressure.copy_from_slice(&self.best);
            self.start(problem, pressure, task.target);
        }
        Ok(self.evaluate(task, deformation, pressure, outcome)?.0)
    }

    /// Gap under the pressure that the last solve returned \[m\], negative where nodes at their limit
    /// overlap.
    pub fn gap(&self) -> &[f64] {
        &self.gap
    }

    /// Deformed gaps over the datum and their error; returns the level of the free ones, the mean
    /// displacement, and whether the gaps of the free nodes are closed so far that those of the others tell
    /// who is next to touch.
    fn evaluate(
        &mut self,
        task: &Task<'_>,
        deformation: &mut dyn DeformationModel,
        pressure: &[f64],
        outcome: &mut DryOutcome,
    ) -> Result<(f64, f64, bool), InputError> {
        deformation.displacement(pressure, &mut self.displacement)?;
        outcome.convolutions += 1.0;
        let (mut work, mut sum) = (0.0, 0.0);
        for ((g, z), (u, p)) in
            self.gap.iter_mut().zip(task.problem.gap).zip(self.displacement.iter().zip(pressure))
        {
            *g = (z - task.datum) + u;
            work += u * p;
            sum += p;
        }
        let scale = if sum > 0.0 { work / sum } else { f64::MIN_POSITIVE };
        let level = self.free_mean(&self.gap);
        let (error, is_settled) = self.gap_error(task.problem, pressure, level);
        outcome.gap_error = error / scale;
        Ok((level, scale, is_settled))
    }

    /// Mean gap error \[m\], and whether the gaps on the wrong side have the larger sum of squares than those
    /// of the free nodes.
    fn gap_error(&self, problem: &DryProblem<'_>, pressure: &[f64], level: f64) -> (f64, bool) {
        let (mut error, mut n, mut free, mut wrong) = (0.0, 0_usize, 0.0, 0.0);
        for (k, (side, g)) in self.side.iter().zip(&self.gap).enumerate() {
            let violation = match side {
                // Cautious passes leave some of these beyond their bounds.
                Side::Free if pressure[k] < 0.0 || pressure[k] > problem.limit_of(k) => f64::INFINITY,
                Side::Free => (g - level).abs(),
                Side::Open => (level - g).max(0.0),
                Side::Limited => (g - level).max(0.0),
            };
            error += violation;
            *(if *side == Side::Free { &mut free } else { &mut wrong }) += violation * violation;
            n += usize::from(matches!(side, Side::Free | Side::Limited));
        }
        (error / n.max(1) as f64, wrong > free)
    }

    /// The duality gap over the elastic energy, from pressures, gaps and displacements as evaluated.
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
