//! Dry rough contact: pressure between zero and a limit that closes the gap where it acts.

use super::DeformationModel;
use crate::error::InputError;

/// Passes of the active set after which only the worst violators change sides, which ends cycling.
const FREE_PASSES: usize = 25;
/// Passes in which the gap error must fall, by the factor [`LEAST_GAIN`] at least, for the solve to go on.
const PATIENCE: u64 = 100;
/// Factor by which an error is lower than the lowest before for that to count.
const LEAST_GAIN: f64 = 0.9;
/// Conjugate-gradient steps within one pass.
const STEPS_PER_PASS: usize = 40;
/// Reduction of the squared residual within one pass.
const PASS_REDUCTION: f64 = 1e-4;

/// The problem: find pressure `p` and approach `delta` with `g = gap + K p - delta`, `0 <= p <= limit`, `g >= 0`
/// where `p = 0`, `g = 0` between, `g <= 0` where `p = limit`, and the sum of `p` times the cell area equal to the
/// load.
///
/// Pressure stays zero on nodes with `excluded` set.
#[derive(Debug, Clone, Copy)]
pub struct DryProblem<'a> {
    /// Undeformed gap per node \[m\].
    pub gap: &'a [f64],
    /// Load \[N\].
    pub load: f64,
    /// Largest pressure per node \[Pa\], or none.
    pub limit: Option<&'a [f64]>,
    /// Nodes that carry no pressure.
    pub excluded: &'a [bool],
}

/// How a dry solve ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DryOutcome {
    /// Mean absolute gap error on contact nodes plus penetration elsewhere, over the pressure-weighted mean
    /// displacement.
    pub gap_error: f64,
    /// Approach of the bodies \[m\].
    pub approach: f64,
    /// Elastic convolutions.
    pub convolutions: u64,
    /// Passes of the active set.
    pub passes: u64,
    /// Conjugate-gradient steps.
    pub steps: u64,
    /// Whether `gap_error` reached the tolerance with the sets settled.
    pub converged: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Open,
    Free,
    Limited,
    Excluded,
}

/// Active-set conjugate gradients with a per-node pressure limit and the load as a constraint.
///
/// Within a pass the sets are fixed and conjugate gradients, projected on constant load, close the gap of the
/// free nodes; then nodes change sides by the primal-dual rule (pressure minus gap over the self-influence leaves the
/// bounds). Polonsky and Keer (1999, Wear 231, 206-219) change sides at every step instead, which stalls once many
/// nodes sit at the limit.
#[derive(Debug, Clone)]
pub struct DrySolver {
    side: Vec<Side>,
    gap: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    displacement: Vec<f64>,
}

impl DrySolver {
    /// Solver for fields of `n` nodes.
    pub fn new(n: usize) -> Self {
        let zeros = || vec![0.0; n];
        Self {
            side: vec![Side::Open; n],
            gap: zeros(),
            residual: zeros(),
            direction: zeros(),
            displacement: zeros(),
        }
    }

    /// Solves `problem`, starting from `pressure`, which must carry some load. Ends when the gap error is at most
    /// `tolerance` with no node changing sides, after `max_passes` passes, or when a hundred passes have brought nothing,
    /// as rounding bounds what can be reached.
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
        for (field, len) in [
            ("gap", problem.gap.len()),
            ("pressure", pressure.len()),
            ("excluded", problem.excluded.len()),
            ("dry solver", self.gap.len()),
            ("limit", problem.limit.map_or(grid.len(), <[f64]>::len)),
        ] {
            if len != grid.len() {
                return Err(InputError::Shape { field: field.to_owned(), expected: grid.len(), found: len });
            }
        }
        self.start(problem, pressure, problem.load / grid.cell_area());
        let mut outcome = DryOutcome {
            gap_error: f64::INFINITY,
            approach: 0.0,
            convolutions: 0,
            passes: 0,
            steps: 0,
            converged: false,
        };
        let stiffness = 1.0 / deformation.influence(0, 0);
        let (mut lowest, mut last_gain) = (f64::INFINITY, 0);
        while outcome.passes < max_passes && outcome.passes - last_gain < PATIENCE {
            outcome.passes += 1;
            self.relax(problem, deformation, pressure, tolerance, &mut outcome)?;
            let cautious = outcome.passes as usize > FREE_PASSES;
            let changes = self.update_sides(problem, pressure, stiffness, outcome.approach, cautious);
            self.restore_load(problem, pressure, problem.load / grid.cell_area());
            if changes == 0 && outcome.gap_error <= tolerance {
                outcome.converged = true;
                break;
            }
            if outcome.gap_error < LEAST_GAIN * lowest {
                (lowest, last_gain) = (outcome.gap_error, outcome.passes);
            }
        }
        Ok(outcome)
    }

    /// Undeformed gap plus displacement at the end of the last solve \[m\]; less the approach it is the gap.
    pub fn deformed_gap(&self) -> &[f64] {
        &self.gap
    }

    fn limit_of(problem: &DryProblem<'_>, k: usize) -> f64 {
        problem.limit.map_or(f64::INFINITY, |limit| limit[k])
    }

    fn start(&mut self, problem: &DryProblem<'_>, pressure: &mut [f64], target: f64) {
        for (k, p) in pressure.iter_mut().enumerate() {
            let limit = Self::limit_of(problem, k);
            (self.side[k], *p) = if problem.excluded[k] {
                (Side::Excluded, 0.0)
            } else if *p >= limit && limit.is_finite() {
                (Side::Limited, limit)
            } else if *p > 0.0 && p.is_finite() {
                (Side::Free, *p)
            } else {
                (Side::Open, 0.0)
            };
        }
        if !self.side.iter().any(|side| matches!(side, Side::Free | Side::Limited)) {
            self.seed(problem, pressure);
        }
        self.restore_load(problem, pressure, target);
    }

    /// Without any pressure to start from, the lowest point of the gap touches first.
    fn seed(&mut self, problem: &DryProblem<'_>, pressure: &mut [f64]) {
        let lowest = (0..pressure.len())
            .filter(|&k| !problem.excluded[k])
            .min_by(|&a, &b| problem.gap[a].total_cmp(&problem.gap[b]));
        if let Some(k) = lowest {
            self.side[k] = Side::Free;
            pressure[k] = 1.0;
        }
    }

    /// Conjugate gradients on the free nodes at constant load, until the residual has fallen enough for this pass.
    fn relax(
        &mut self,
        problem: &DryProblem<'_>,
        deformation: &mut dyn DeformationModel,
        pressure: &mut [f64],
        tolerance: f64,
        outcome: &mut DryOutcome,
    ) -> Result<(), InputError> {
        deformation.displacement(pressure, &mut self.displacement)?;
        outcome.convolutions += 1;
        for (g, (z, u)) in self.gap.iter_mut().zip(problem.gap.iter().zip(&self.displacement)) {
            *g = z + u;
        }
        let scale = weighted_mean(&self.displacement, pressure);
        let mut mean = self.free_mean(&self.gap);
        let mut squared = 0.0;
        let mut n_free = 0_usize;
        for k in 0..pressure.len() {
            self.direction[k] = 0.0;
            self.residual[k] = if self.side[k] == Side::Free { mean - self.gap[k] } else { 0.0 };
            squared += self.residual[k] * self.residual[k];
            n_free += usize::from(self.side[k] == Side::Free);
        }
        let floor = (0.1 * tolerance * scale).powi(2) * n_free as f64;
        let goal = (PASS_REDUCTION * squared).max(floor);
        let mut previous = f64::INFINITY;
        for _ in 0..STEPS_PER_PASS {
            if squared <= goal || n_free < 2 {
                break;
            }
            let beta = squared / previous;
            for k in 0..pressure.len() {
                if self.side[k] == Side::Free {
                    self.direction[k] = self.residual[k] + beta * self.direction[k];
                }
            }
            deformation.displacement(&self.direction, &mut self.displacement)?;
            outcome.convolutions += 1;
            outcome.steps += 1;
            let shift = self.free_mean(&self.displacement);
            let curvature: f64 = self.direction.iter().zip(&self.displacement).map(|(d, u)| d * u).sum();
            if curvature <= 0.0 {
                break;
            }
            let step = squared / curvature;
            previous = squared;
            squared = 0.0;
            for (k, p) in pressure.iter_mut().enumerate() {
                self.gap[k] += step * self.displacement[k];
                if self.side[k] == Side::Free {
                    *p += step * self.direction[k];
                    self.residual[k] -= step * (self.displacement[k] - shift);
                    squared += self.residual[k] * self.residual[k];
                }
            }
        }
        mean = self.free_mean(&self.gap);
        outcome.approach = mean;
        outcome.gap_error = self.gap_error(mean, scale);
        Ok(())
    }

    fn free_mean(&self, field: &[f64]) -> f64 {
        let (mut sum, mut n) = (0.0, 0_usize);
        for (side, value) in self.side.iter().zip(field) {
            if *side == Side::Free {
                sum += value;
                n += 1;
            }
        }
        if n == 0 { self.fallback_level(field) } else { sum / n as f64 }
    }

    /// With every touching node at its limit, the approach lies between the open and the limited gaps.
    fn fallback_level(&self, field: &[f64]) -> f64 {
        let open = self.side.iter().zip(field).filter(|(s, _)| **s == Side::Open).map(|(_, &g)| g);
        open.fold(f64::INFINITY, f64::min)
    }

    fn gap_error(&self, level: f64, scale: f64) -> f64 {
        let (mut error, mut n) = (0.0, 0_usize);
        for (side, g) in self.side.iter().zip(&self.gap) {
            let violation = match side {
                Side::Free => (g - level).abs(),
                Side::Open => (level - g).max(0.0),
                Side::Limited => (g - level).max(0.0),
                Side::Excluded => 0.0,
            };
            error += violation;
            n += usize::from(matches!(side, Side::Free | Side::Limited));
        }
        error / (n.max(1) as f64 * scale)
    }

    /// Moves nodes between the sets; in cautious mode only those that violate their side by at least half of the worst.
    fn update_sides(
        &mut self,
        problem: &DryProblem<'_>,
        pressure: &mut [f64],
        stiffness: f64,
        level: f64,
        cautious: bool,
    ) -> usize {
        let wish = |side: Side, k: usize, p: f64, g: f64| -> (Side, f64) {
            let limit = Self::limit_of(problem, k);
            match side {
                Side::Free if p < 0.0 => (Side::Open, -p),
                Side::Free if p > limit => (Side::Limited, p - limit),
                Side::Open if g < level => (Side::Free, (level - g) * stiffness),
                Side::Limited if g > level => (Side::Free, (g - level) * stiffness),
                _ => (side, 0.0),
            }
        };
        let mut worst = 0.0_f64;
        if cautious {
            for (k, &p) in pressure.iter().enumerate() {
                worst = worst.max(wish(self.side[k], k, p, self.gap[k]).1);
            }
        }
        let mut changes = 0;
        for (k, p) in pressure.iter_mut().enumerate() {
            let (side, violation) = wish(self.side[k], k, *p, self.gap[k]);
            if side != self.side[k] && violation >= 0.5 * worst {
                self.side[k] = side;
                changes += 1;
            }
            match self.side[k] {
                Side::Open | Side::Excluded => *p = 0.0,
                Side::Limited => *p = Self::limit_of(problem, k),
                Side::Free => {}
            }
        }
        changes
    }

    /// Spreads the missing load evenly over the free nodes, as often as limits get in the way.
    fn restore_load(&mut self, problem: &DryProblem<'_>, pressure: &mut [f64], target: f64) {
        for _ in 0..50 {
            let missing = target - pressure.iter().sum::<f64>();
            let room = |k: usize, p: f64| missing < 0.0 || p < Self::limit_of(problem, k);
            let n =
                (0..pressure.len()).filter(|&k| self.side[k] == Side::Free && room(k, pressure[k])).count();
            if missing.abs() <= 1e-14 * target {
                break;
            }
            if n == 0 {
                if missing > 0.0 {
                    self.widen(problem, pressure);
                } else {
                    self.release();
                }
                continue;
            }
            let share = missing / n as f64;
            for (k, p) in pressure.iter_mut().enumerate() {
                if self.side[k] == Side::Free && room(k, *p) {
                    *p += share;
                    if missing > 0.0 {
                        *p = p.min(Self::limit_of(problem, k));
                    }
                }
            }
        }
    }

    /// Frees the limited nodes when they alone carry more than the load.
    fn release(&mut self) {
        for side in &mut self.side {
            if *side == Side::Limited {
                *side = Side::Free;
            }
        }
    }

    /// Frees the open nodes with the smallest gaps when the free ones cannot take the load.
    fn widen(&mut self, problem: &DryProblem<'_>, pressure: &[f64]) {
        let lowest = (0..pressure.len())
            .filter(|&k| self.side[k] == Side::Open)
            .map(|k| problem.gap[k])
            .fold(f64::INFINITY, f64::min);
        let touching = (0..pressure.len())
            .filter(|&k| matches!(self.side[k], Side::Free | Side::Limited))
            .map(|k| problem.gap[k])
            .fold(lowest, f64::max);
        let threshold = touching.max(lowest) + 0.1 * (touching - lowest).abs();
        for k in 0..pressure.len() {
            if self.side[k] == Side::Open && problem.gap[k] <= threshold {
                self.side[k] = Side::Free;
            }
        }
    }
}

fn weighted_mean(field: &[f64], weight: &[f64]) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    for (f, w) in field.iter().zip(weight) {
        sum += f * w;
        total += w;
    }
    if total > 0.0 { sum / total } else { f64::MIN_POSITIVE }
}
