//! Conjugate gradients on the free nodes at constant load.
//!
//! Preconditioned conjugate gradients for `K d = r` on the free nodes, with the constraint that directions
//! add no load. The preconditioned residual `z` is reduced by its mean, `d = z - mean(z) + beta d'`. `beta`
//! makes the direction conjugate to the previous one by means of its computed displacement, not by a quotient
//! of residuals, which tolerates products in single precision. The energy along `d` is smallest at
//! `length = sum(r z) / sum(d K d)`. The level of the gaps, the Lagrange multiplier of the load, changes by
//! `length` times the mean displacement of `d`. Steps of damped passes end at the first bound that a free node reaches;
//! it leaves the free set, and directions start anew.

use super::active_set::NodeState;
use super::{DryOutcome, DryProblem, DrySolver};
use crate::elastic::DeformationModel;
use crate::error::InputError;

/// Largest number of steps in a pass.
const STEPS_PER_PASS: u64 = 40;
/// Reduction of the residual within a pass; products in single precision limit it.
const PASS_REDUCTION: f64 = 1e-4;
/// Ratio of the residual to the target at which a pass ends.
const MARGIN: f64 = 0.5;
/// Cost of a step in convolutions: a product and a pressure estimate.
const STEP_COST: f64 = 1.25;

/// Inner products of a step over the free nodes.
#[derive(Default)]
struct InnerProducts {
    /// Residual times preconditioned residual.
    energy: f64,
    /// Sum of the preconditioned residual.
    estimate: f64,
    /// Preconditioned residual times the displacement of the previous direction.
    overlap: f64,
}

impl DrySolver {
    /// Closes the gaps of the free nodes. A pass ends when their mean square is below that of `goal` \[m\],
    /// when it has fallen by the reduction of a pass, or, unless the pass is damped, when the bound
    /// violations hold more energy. The gaps are updated with the pressures.
    pub(super) fn relax(
        &mut self,
        problem: &DryProblem<'_>,
        deformation: &mut dyn DeformationModel,
        pressure: &mut [f64],
        (goal, damped): (f64, bool),
        outcome: &mut DryOutcome,
    ) -> Result<(), InputError> {
        let mut level = self.free_mean(&self.gap);
        let mut squared = self.collect_free_nodes(level);
        let goal = (PASS_REDUCTION.powi(2) * squared).max((MARGIN * goal).powi(2) * self.free.len() as f64);
        let own = deformation.influence(0, 0);
        let (mut curvature, mut shift, mut violation) = (f64::INFINITY, 0.0, 0.0);
        // Directions start anew at the first step and where a node has left the free set.
        let mut is_first = true;
        for _ in 0..STEPS_PER_PASS {
            let n_free = self.free.len();
            if squared <= goal || n_free < 2 {
                break;
            }
            // preconditioned residual
            deformation.pressure_estimate(&self.residual, &mut self.estimate)?;
            let products = self.inner_products();
            if products.energy <= 0.0 || (!damped && violation > products.energy) {
                outcome.convolutions += STEP_COST - 1.0;
                break;
            }
            let mean = products.estimate / n_free as f64;
            // direction conjugate to the previous one, regardless of rounding in the products
            let beta =
                if is_first { 0.0 } else { (mean * shift * n_free as f64 - products.overlap) / curvature };
            self.update_direction(mean, beta);
            // its displacement and curvature
            deformation.displacement_single(&self.direction, &mut self.displacement)?;
            outcome.convolutions += STEP_COST;
            outcome.steps += 1;
            (curvature, shift) = self.curvature();
            if curvature <= 0.0 {
                break;
            }
            // exact line search; the level moves with the mean displacement
            let mut length = products.energy / curvature;
            // A damped step ends at the first bound.
            let share = if damped { self.stop_at_bounds(problem, pressure, length) } else { 1.0 };
            is_first = share < 1.0;
            length *= share;
            level += length * shift;
            (squared, violation) = self.advance(problem, pressure, [length, shift, level, own]);
            if is_first {
                self.put_on_bounds(problem, pressure);
                level = self.free_mean(&self.gap);
                squared = self.collect_free_nodes(level);
            }
        }
        Ok(())
    }

    /// Lists the free nodes and their residuals at this level of the gaps; returns the sum of squares.
    /// Residual and direction are zero at all other nodes.
    fn collect_free_nodes(&mut self, level: f64) -> f64 {
        self.residual.fill(0.0);
        self.direction.fill(0.0);
        self.free.clear();
        let mut squared = 0.0;
        for (k, (state, g)) in self.state.iter().zip(&self.gap).enumerate() {
            if *state == NodeState::Free {
                let r = level - g;
                self.residual[k] = r;
                squared += r * r;
                self.free.push(k);
            }
        }
        squared
    }

    /// Pressures of the nodes that have left the free set in this step.
    fn put_on_bounds(&self, problem: &DryProblem<'_>, pressure: &mut [f64]) {
        for &k in &self.free {
            match self.state[k] {
                NodeState::Free => {}
                NodeState::Open => pressure[k] = 0.0,
                NodeState::Limited => pressure[k] = problem.limit_of(k),
            }
        }
    }

    /// Inner products of a step.
    fn inner_products(&self) -> InnerProducts {
        let mut products = InnerProducts::default();
        for &k in &self.free {
            let z = self.estimate[k];
            products.energy += self.residual[k] * z;
            products.estimate += z;
            products.overlap += z * self.displacement[k];
        }
        products
    }

    /// Updates the search direction, which has zero sum.
    fn update_direction(&mut self, mean: f64, beta: f64) {
        for &k in &self.free {
            self.direction[k] = self.estimate[k] - mean + beta * self.direction[k];
        }
    }

    /// Curvature `d K d` along the direction, and the mean displacement.
    fn curvature(&self) -> (f64, f64) {
        let (mut curvature, mut sum) = (0.0, 0.0);
        for &k in &self.free {
            let u = self.displacement[k];
            curvature += self.direction[k] * u;
            sum += u;
        }
        (curvature, sum / self.free.len() as f64)
    }

    /// Updates pressures, gaps and residuals; returns the squared residual and the energy of the bound
    /// violations.
    fn advance(
        &mut self,
        problem: &DryProblem<'_>,
        pressure: &mut [f64],
        [length, shift, level, own]: [f64; 4],
    ) -> (f64, f64) {
        let (mut squared, mut violation) = (0.0, 0.0);
        for ((g, u), state) in self.gap.iter_mut().zip(&self.displacement).zip(&self.state) {
            *g += length * u;
            // Gap violations of open and limited nodes; most of these have none.
            let wrong = match state {
                NodeState::Open => level - *g,
                NodeState::Limited => *g - level,
                NodeState::Free => 0.0,
            };
            if wrong > 0.0 {
                violation += wrong.powi(2) / own;
            }
        }
        // pressures and residuals of the free nodes
        for &k in &self.free {
            let p = pressure[k] + length * self.direction[k];
            let r = self.residual[k] - length * (self.displacement[k] - shift);
            (pressure[k], self.residual[k]) = (p, r);
            squared += r * r;
            let beyond = (-p).max(p - problem.limit_of(k)).max(0.0);
            violation += own * beyond * beyond;
        }
        (squared, violation)
    }
}
