//! Which condition holds at a node, and who changes it.
//!
//! Sides change between passes, in both directions at once: nodes beyond their bounds leave the free set,
//! nodes with a gap of the wrong sign enter it. In cautious passes only the worst do, which ends cycles of
//! nodes that change sides for each other. The load is kept by an equal change on all free nodes, as often as
//! bounds get in the way.

use super::{DryProblem, DrySolver};

/// The condition that a node fulfils.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// No pressure, a gap.
    Open,
    /// No gap, pressure between zero and the limit.
    Free,
    /// Pressure at the limit, an overlap.
    Limited,
}

/// Share of the worst violation from which nodes change sides in cautious passes.
const WORST: f64 = 0.5;

impl DrySolver {
    /// Sorts the nodes by the pressure of a start and scales it to the load.
    pub(super) fn start(&mut self, problem: &DryProblem<'_>, pressure: &mut [f64], target: f64) {
        for (k, p) in pressure.iter_mut().enumerate() {
            let limit = problem.limit_of(k);
            (self.side[k], *p) = if *p >= limit && limit.is_finite() {
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
        let lowest = (0..pressure.len()).min_by(|&a, &b| problem.gap[a].total_cmp(&problem.gap[b]));
        if let Some(k) = lowest {
            self.side[k] = Side::Free;
            pressure[k] = 1.0;
        }
    }

    /// Mean of `field` over the free nodes; where there are none, its smallest value at an open one.
    pub(super) fn free_mean(&self, field: &[f64]) -> f64 {
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

    /// Frees the nodes whose gaps are on the wrong side of `level`; of them only those with at least half of
    /// the worst violation in a cautious pass.
    pub(super) fn touch(&mut self, level: f64, cautious: bool) {
        let violation = |side: Side, g: f64| match side {
            Side::Open => level - g,
            Side::Limited => g - level,
            Side::Free => 0.0,
        };
        let least = if cautious {
            let violations = self.side.iter().zip(&self.gap).map(|(side, &g)| violation(*side, g));
            WORST * violations.fold(0.0, f64::max)
        } else {
            0.0
        };
        for (side, &g) in self.side.iter_mut().zip(&self.gap) {
            let violation = violation(*side, g);
            if violation > 0.0 && violation >= least {
                *side = Side::Free;
            }
        }
    }

    /// Opens the free nodes with tension and holds those beyond the limit at it; of them only those with at
    /// least half of the worst violation in a cautious pass.
    pub(super) fn clip(&mut self, problem: &DryProblem<'_>, pressure: &mut [f64], cautious: bool) {
        let beyond = |k: usize, p: f64| (-p).max(p - problem.limit_of(k));
        let mut least = 0.0_f64;
        if cautious {
            for (k, &p) in pressure.iter().enumerate() {
                if self.side[k] == Side::Free {
                    least = least.max(WORST * beyond(k, p));
                }
            }
        }
        for (k, p) in pressure.iter_mut().enumerate() {
            let violation = beyond(k, *p);
            if self.side[k] == Side::Free && violation > 0.0 && violation >= least {
                (self.side[k], *p) =
                    if *p < 0.0 { (Side::Open, 0.0) } else { (Side::Limited, problem.limit_of(k)) };
            }
        }
    }

    /// Spreads the missing load evenly over the free nodes, as often as limits get in the way.
    pub(super) fn restore_load(&mut self, problem: &DryProblem<'_>, pressure: &mut [f64], target: f64) {
        for _ in 0..50 {
            let missing = target - pressure.iter().sum::<f64>();
            if missing.abs() <= 1e-14 * target {
                break;
            }
            let room = |k: usize, p: f64| missing < 0.0 || p < problem.limit_of(k);
            let n =
                (0..pressure.len()).filter(|&k| self.side[k] == Side::Free && room(k, pressure[k])).count();
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
                        *p = p.min(problem.limit_of(k));
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
