//! Conjugate gradients on the free nodes at constant load.
//!
//! Steps of conjugate gradients for `K d = r` on the free nodes under the constraint that directions add no
//! load. The preconditioned residual `z` has its mean taken out, `d = z - mean(z) + beta d'`; `beta` makes
//! the direction conjugate to the last one by its displacement itself, not by a quotient of residuals, so
//! that products of single precision do. Along `d` the energy is least at `length = sum(r z) / sum(d K d)`;
//! the level of the gaps, which is the multiplier of the load, moves by `length` times the mean displacement
//! of `d`.

use super::sides::Side;
use super::{DryOutcome, DryProblem, DrySolver};
use crate::elastic::DeformationModel;
use crate::error::InputError;

/// Steps within one pass.
const STEPS_PER_PASS: u64 = 40;
/// Reduction of the residual within one pass: what products in single precision allow.
const PASS_REDUCTION: f64 = 1e-4;
/// Residual over the one asked for at which a pass ends.
const MARGIN: f64 = 0.5;
/// Cost of a step in convolutions: a product and a pressure estimate.
const STEP_COST: f64 = 1.25;

/// What one step is made of, over the free nodes.
#[derive(Default)]
struct Sums {
    /// Residual times estimate.
    energy: f64,
    /// Sum of the estimate, for its mean.
    estimate: f64,
    /// Estimate times the displacement of the last direction.
    overlap: f64,
}

impl DrySolver {
    /// Closes the gaps of the free nodes: until their mean square is below that of `goal` \[m\] or has fallen
    /// enough for this pass, or, unless the pass is cautious, until the nodes beyond their bounds matter
    /// more. Gaps follow.
    pub(super) fn relax(
        &mut self,
        problem: &DryProblem<'_>,
        deformation: &mut dyn DeformationModel,
        pressure: &mut [f64],
        (goal, cautious): (f64, bool),
        outcome: &mut DryOutcome,
    ) -> Result<(), InputError> {
        let mut level = self.free_mean(&self.gap);
        let mut squared = self.list_free(level);
        let n_free = self.free.len();
        let goal = (PASS_REDUCTION.powi(2) * squared).max((MARGIN * goal).powi(2) * n_free as f64);
        let own = deformation.influence(0, 0);
        let (mut curvature, mut shift, mut violation) = (f64::INFINITY, 0.0, 0.0);
        for step in 0..STEPS_PER_PASS {
            if squared <= goal || n_free < 2 {
                break;
            }
            deformation.pressure_estimate(&self.residual, &mut self.estimate)?;
            let sums = self.sums();
            if sums.energy <= 0.0 || (!cautious && violation > sums.energy) {
                outcome.convolutions += STEP_COST - 1.0;
                break;
            }
            let mean = sums.estimate / n_free as f64;
            // Conjugate to the last direction, whatever the rounding of the products.
            let beta =
                if step == 0 { 0.0 } else { (mean * shift * n_free as f64 - sums.overlap) / curvature };
            self.turn(mean, beta);
            deformation.displacement_single(&self.direction, &mut self.displacement)?;
            outcome.convolutions += STEP_COST;
            outcome.steps += 1;
            (curvature, shift) = self.curvature();
            if curvature <= 0.0 {
                break;
            }
            let length = sums.energy / curvature;
            level += length * shift;
            (squared, violation) = self.advance(problem, pressure, [length, shift, level, own]);
        }
        Ok(())
    }

    /// Finds the free nodes and their residuals at this level of the gaps; returns the squared residual. No
    /// residual and no direction is left elsewhere.
    fn list_free(&mut self, level: f64) -> f64 {
        self.residual.fill(0.0);
        self.direction.fill(0.0);
        self.free.clear();
        let mut squared = 0.0;
        for (k, (side, g)) in self.side.iter().zip(&self.gap).enumerate() {
            if *side == Side::Free {
                let r = level - g;
                self.residual[k] = r;
                squared += r * r;
                self.free.push(k);
            }
        }
        squared
    }

    /// The sums of a step over the free nodes.
    fn sums(&self) -> Sums {
        let mut sums = Sums::default();
        for &k in &self.free {
            let z = self.estimate[k];
            sums.energy += self.residual[k] * z;
            sums.estimate += z;
            sums.overlap += z * self.displacement[k];
        }
        sums
    }

    /// The next direction, which keeps the load.
    fn turn(&mut self, mean: f64, beta: f64) {
        for &k in &self.free {
            self.direction[k] = self.estimate[k] - mean + beta * self.direction[k];
        }
    }

    /// Direction times its displacement, and the mean displacement.
    fn curvature(&self) -> (f64, f64) {
        let (mut curvature, mut sum) = (0.0, 0.0);
        for &k in &self.free {
            let u = self.displacement[k];
            curvature += self.direction[k] * u;
            sum += u;
        }
        (curvature, sum / self.free.len() as f64)
    }

    /// Takes a step; returns the squared residual and the energy of the nodes beyond their bounds.
    fn advance(
        &mut self,
        problem: &DryProblem<'_>,
        pressure: &mut [f64],
        [length, shift, level, own]: [f64; 4],
    ) -> (f64, f64) {
        let (mut squared, mut violation) = (0.0, 0.0);
        for ((g, u), side) in self.gap.iter_mut().zip(&self.displacement).zip(&self.side) {
            *g += length * u;
            // Free nodes follow below; of the others nearly all are on the right side.
            let wrong = match side {
                Side::Open => level - *g,
                Side::Limited => *g - level,
                Side::Free => 0.0,
            };
            if wrong > 0.0 {
                violation += wrong.powi(2) / own;
            }
        }
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
