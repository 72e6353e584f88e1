//! The state of each node, and the updates of the active set.
//!
//! The active set changes between passes, in both directions at once: nodes beyond their pressure bounds
//! leave the free set, nodes whose gap has the wrong sign enter it. In damped passes only the worst violators
//! enter it, and steps end at the first bound, so that the energy decreases from pass to pass: no set comes twice. A uniform
//! correction on the free nodes keeps the load, repeated as long as bounds are hit.

use super::{DryProblem, DrySolver};

/// Condition that holds at a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NodeState {
    /// Zero pressure, open gap.
    Open,
    /// Closed gap, pressure between zero and the limit.
    Free,
    /// Pressure at the limit, overlap.
    Limited,
}

/// Share of the worst violation from which nodes become free in damped passes.
const DAMPING: f64 = 0.5;

impl DrySolver {
    /// Initial states from the pressure of a start, which is scaled to the load.
    pub(super) fn start(&mut self, problem: &DryProblem<'_>, pressure: &mut [f64], target: f64) {
        for (k, p) in pressure.iter_mut().enumerate() {
            let limit = problem.limit_of(k);
            (self.state[k], *p) = if *p >= limit && limit.is_finite() {
                (NodeState::Limited, limit)
            } else if *p > 0.0 && p.is_finite() {
                (NodeState::Free, *p)
            } else {
                (NodeState::Open, 0.0)
            };
        }
        if !self.state.iter().any(|state| matches!(state, NodeState::Free | NodeState::Limited)) {
            self.seed(problem, pressure);
        }
        self.restore_load(problem, pressure, target);
    }

    /// Frees the node with the smallest gap; the start for zero pressure.
    fn seed(&mut self, problem: &DryProblem<'_>, pressure: &mut [f64]) {
        let lowest = (0..pressure.len()).min_by(|&a, &b| problem.gap[a].total_cmp(&problem.gap[b]));
        if let Some(k) = lowest {
            self.state[k] = NodeState::Free;
            pressure[k] = 1.0;
        }
    }

    /// Mean of `field` over the free nodes; without free nodes its smallest value at open ones.
    pub(super) fn free_mean(&self, field: &[f64]) -> f64 {
        let (mut sum, mut n) = (0.0, 0_usize);
        for (state, value) in self.state.iter().zip(field) {
            if *state == NodeState::Free {
                sum += value;
                n += 1;
            }
        }
        if n == 0 { self.fallback_level(field) } else { sum / n as f64 }
    }

    /// Level of the gaps without free nodes: the smallest gap of the open nodes, so that none penetrates.
    fn fallback_level(&self, field: &[f64]) -> f64 {
        let open = self.state.iter().zip(field).filter(|(s, _)| **s == NodeState::Open).map(|(_, &g)| g);
        open.fold(f64::INFINITY, f64::min)
    }

    /// Frees the nodes whose gap violates `level`. A damped pass frees only those with at least half of the
    /// worst violation.
    pub(super) fn free_violators(&mut self, level: f64, damped: bool) {
        let violation = |state: NodeState, g: f64| match state {
            NodeState::Open => level - g,
            NodeState::Limited => g - level,
            NodeState::Free => 0.0,
        };
        let least = if damped {
            let violations = self.state.iter().zip(&self.gap).map(|(state, &g)| violation(*state, g));
            DAMPING * violations.fold(0.0, f64::max)
        } else {
            0.0
        };
        for (state, &g) in self.state.iter_mut().zip(&self.gap) {
            let violation = violation(*state, g);
            if violation > 0.0 && violation >= least {
                *state = NodeState::Free;
            }
        }
    }

    /// Opens free nodes with tension and sets those above the limit to it.
    pub(super) fn enforce_bounds(&mut self, problem: &DryProblem<'_>, pressure: &mut [f64]) {
        for (k, p) in pressure.iter_mut().enumerate() {
            match self.state[k] {
                NodeState::Free if *p < 0.0 => (self.state[k], *p) = (NodeState::Open, 0.0),
                NodeState::Free if *p > problem.limit_of(k) => {
                    (self.state[k], *p) = (NodeState::Limited, problem.limit_of(k));
                }
                _ => {}
            }
        }
    }

    /// Largest share of a step of this `length` along the direction that keeps the free nodes within their bounds. Nodes that
    /// reach their bound there leave the free set.
    pub(super) fn stop_at_bounds(&mut self, problem: &DryProblem<'_>, pressure: &[f64], length: f64) -> f64 {
        let share_of = |k: usize, step: f64| {
            let distance = if step < 0.0 { -pressure[k] } else { problem.limit_of(k) - pressure[k] };
            // A node that does not move bounds nothing.
            if step == 0.0 { f64::INFINITY } else { (distance / step).max(0.0) }
        };
        let steps = self.free.iter().map(|&k| (k, length * self.direction[k]));
        let share = steps.clone().map(|(k, step)| share_of(k, step)).fold(1.0, f64::min);
        if share < 1.0 {
            for (k, step) in steps.filter(|&(k, step)| share_of(k, step) <= share) {
                self.state[k] = if step < 0.0 { NodeState::Open } else { NodeState::Limited };
            }
        }
        share
    }

    /// Distributes the load deficit evenly over the free nodes, repeatedly where limits are reached.
    pub(super) fn restore_load(&mut self, problem: &DryProblem<'_>, pressure: &mut [f64], target: f64) {
        for _ in 0..50 {
            let deficit = target - pressure.iter().sum::<f64>();
            if deficit.abs() <= 1e-14 * target {
                break;
            }
            let can_change = |k: usize, p: f64| deficit < 0.0 || p < problem.limit_of(k);
            let n = (0..pressure.len())
                .filter(|&k| self.state[k] == NodeState::Free && can_change(k, pressure[k]))
                .count();
            if n == 0 {
                if deficit > 0.0 {
                    self.free_smallest_gaps(problem, pressure);
                } else {
                    self.free_limited();
                }
                continue;
            }
            let share = deficit / n as f64;
            for (k, p) in pressure.iter_mut().enumerate() {
                if self.state[k] == NodeState::Free && can_change(k, *p) {
                    *p += share;
                    if deficit > 0.0 {
                        *p = p.min(problem.limit_of(k));
                    }
                }
            }
        }
    }

    /// Frees the limited nodes; for limited nodes that carry more than the load.
    fn free_limited(&mut self) {
        for state in &mut self.state {
            if *state == NodeState::Limited {
                *state = NodeState::Free;
            }
        }
    }

    /// Frees the open nodes with the smallest gaps; for free nodes that cannot carry the load.
    fn free_smallest_gaps(&mut self, problem: &DryProblem<'_>, pressure: &[f64]) {
        let lowest = (0..pressure.len())
            .filter(|&k| self.state[k] == NodeState::Open)
            .map(|k| problem.gap[k])
            .fold(f64::INFINITY, f64::min);
        let touching = (0..pressure.len())
            .filter(|&k| matches!(self.state[k], NodeState::Free | NodeState::Limited))
            .map(|k| problem.gap[k])
            .fold(lowest, f64::max);
        let threshold = touching.max(lowest) + 0.1 * (touching - lowest).abs();
        for k in 0..pressure.len() {
            if self.state[k] == NodeState::Open && problem.gap[k] <= threshold {
                self.state[k] = NodeState::Free;
            }
        }
    }
}
