//! A cell of two rough surfaces under a mean pressure or at a mean gap.

use crate::elastic::{DryOutcome, DryProblem, DrySolver, PeriodicHalfSpace};
use crate::error::InputError;
use crate::grid::Grid;

/// Relative step of the mean pressure for the stiffness, up and down.
const STEP: f64 = 0.01;
/// Factor between trial pressures until two enclose the mean gap.
const WIDENING: f64 = 8.0;
/// Trial pressures on each side.
const TRIALS: usize = 24;
/// Relative error of a mean gap.
const GAP_TOLERANCE: f64 = 1e-6;
/// Secant steps to a mean gap.
const SECANT_STEPS: usize = 60;

/// Dry contact of a cell that repeats along both axes.
pub(super) struct Cell {
    grid: Grid,
    body: PeriodicHalfSpace,
    solver: DrySolver,
    /// Undeformed gap \[m\].
    pub(super) gap: Vec<f64>,
    /// Pressure limit per node \[Pa\].
    limit: Option<Vec<f64>>,
    /// Pressure of the last solve \[Pa\].
    pub(super) pressure: Vec<f64>,
    /// Gap error at convergence and largest number of passes.
    stop: (f64, u64),
}

/// The cell under one mean pressure.
#[derive(Clone, Copy)]
pub(super) struct Solved {
    /// Mean pressure \[Pa\].
    pub(super) mean_pressure: f64,
    /// Mean gap \[m\].
    pub(super) mean_gap: f64,
    pub(super) outcome: DryOutcome,
}

impl Cell {
    /// A cell with the undeformed `gap` \[m\] and one `hardness` \[Pa\].
    pub(super) fn new(
        grid: Grid,
        modulus: f64,
        gap: Vec<f64>,
        hardness: Option<f64>,
        stop: (f64, u64),
    ) -> Result<Self, InputError> {
        let n = grid.len();
        Ok(Self {
            grid,
            body: PeriodicHalfSpace::new(grid, modulus)?,
            solver: DrySolver::new(n),
            gap,
            limit: hardness.map(|hardness| vec![hardness; n]),
            pressure: vec![0.0; n],
            stop,
        })
    }

    /// Solves under a mean pressure \[Pa\], starting from the last solution.
    pub(super) fn under_pressure(&mut self, mean_pressure: f64) -> Result<Solved, InputError> {
        let n = self.pressure.len() as f64;
        let before = self.pressure.iter().sum::<f64>() / n;
        if before > 0.0 {
            self.pressure.iter_mut().for_each(|p| *p *= mean_pressure / before);
        }
        let load = mean_pressure * self.grid.size_x() * self.grid.size_y();
        let problem = DryProblem { gap: &self.gap, load, limit: self.limit.as_deref() };
        let (tolerance, passes) = self.stop;
        let outcome = self.solver.solve(&problem, &mut self.body, &mut self.pressure, tolerance, passes)?;
        let mean_gap = self.solver.gap().iter().map(|gap| gap.max(0.0)).sum::<f64>() / n;
        Ok(Solved { mean_pressure, mean_gap, outcome })
    }

    /// Solves at a mean gap \[m\] below that of first touch, by secants of the gap over the logarithm of the pressure.
    /// `scale` \[Pa\] is the first trial pressure, `highest` the largest one.
    pub(super) fn at_gap(
        &mut self,
        mean_gap: f64,
        [scale, highest]: [f64; 2],
        interrupted: &dyn Fn() -> bool,
    ) -> Result<Option<Solved>, InputError> {
        let mut here = self.under_pressure(scale.min(0.5 * highest))?;
        let mut sides = [None, None];
        for _ in 0..2 * TRIALS + SECANT_STEPS {
            if interrupted() || (here.mean_gap / mean_gap - 1.0).abs() <= GAP_TOLERANCE {
                return Ok(Some(here));
            }
            sides[usize::from(here.mean_gap < mean_gap)] = Some(here);
            let next = match sides {
                [Some(wide), Some(narrow)] => {
                    let share = (wide.mean_gap - mean_gap) / (wide.mean_gap - narrow.mean_gap);
                    let [low, high] = [wide.mean_pressure, narrow.mean_pressure].map(f64::ln);
                    // The curve is nearly straight; margins keep a bend from stalling one side.
                    (low + (high - low) * share.clamp(0.02, 0.98)).exp()
                }
                [Some(wide), None] => {
                    (WIDENING * wide.mean_pressure).min(0.5 * (wide.mean_pressure + highest))
                }
                _ => here.mean_pressure / WIDENING,
            };
            here = self.under_pressure(next)?;
        }
        Ok(None)
    }

    /// Increase of the mean pressure over the decrease of the mean gap of further loading \[Pa/m\], at `solved`; `None`
    /// where the gap does not change. The last solution is then that of `solved` again.
    pub(super) fn stiffness(&mut self, solved: &Solved, highest: f64) -> Result<Option<f64>, InputError> {
        let above = (solved.mean_pressure * (1.0 + STEP)).min(0.5 * (solved.mean_pressure + highest));
        let ends = [solved.mean_pressure * (1.0 - STEP), above];
        let low = self.under_pressure(ends[0])?;
        let high = self.under_pressure(ends[1])?;
        self.under_pressure(solved.mean_pressure)?;
        let closed = low.mean_gap - high.mean_gap;
        Ok((closed > 0.0).then(|| (ends[1] - ends[0]) / closed))
    }

    /// Deformed gap and overlap of nodes at the limit \[m\].
    pub(super) fn films(&self) -> [Vec<f64>; 2] {
        let part = |sign: f64| self.solver.gap().iter().map(|gap| (sign * gap).max(0.0)).collect();
        let overlap: Vec<f64> = match self.limit {
            Some(_) => part(-1.0),
            None => vec![0.0; self.gap.len()],
        };
        [part(1.0), overlap]
    }
}
