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
        let (mut squared, mut n_free) = (0.0, 0_usize);
        for ((r, d), (side, g)) in
            self.residual.iter_mut().zip(&mut self.direction).zip(self.side.iter().zip(&self.gap))
        {
            let is_free = *side == Side::Free;
            (*r, *d) = (if is_free { level - g } else { 0.0 }, 0.0);
            squared += *r * *r;
            n_free += usize::from(is_free);
        }
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
            (curvature, shift) = self.curvature(n_free);
            if curvature <= 0.0 {
                break;
            }
            let length = sums.energy / curvature;
            level += length * shift;
            (squared, violation) = self.advance(problem, pressure, [length, shift, level, own]);
        }
        Ok(())
    }

    /// The sums of a step over the free nodes.
    fn sums(&self) -> Sums {
        let mut sums = Sums::default();
        let fields = self.estimate.iter().zip(&self.residual).zip(&self.displacement);
        for (((z, r), u), side) in fields.zip(&self.side) {
            if *side == Side::Free {
                sums.energy += r * z;
                sums.estimate += z;
                sums.overlap += z * u;
            }
        }
        sums
    }

    /// The next direction, which keeps the load.
    fn turn(&mut self, mean: f64, beta: f64) {
        for ((d, z), side) in self.direction.iter_mut().zip(&self.estimate).zip(&self.side) {
            *d = if *side == Side::Free { z - mean + beta * *d } else { 0.0 };
        }
    }

    /// Direction times its displacement, and the mean displacement.
    fn curvature(&self, n_free: usize) -> (f64, f64) {
        let (mut curvature, mut sum) = (0.0, 0.0);
        for ((d, u), side) in self.direction.iter().zip(&self.displacement).zip(&self.side) {
            if *side == Side::Free {
                curvature += d * u;
                sum += u;
            }
        }
        (curvature, sum / n_free as f64)
    }

    /// Takes a step; returns the squared residual and the energy of the nodes beyond their bounds.
    fn advance(
        &mut self,
        problem: &DryProblem<'_>,
        pressure: &mut [f64],
        [length, shift, level, own]: [f64; 4],
    ) -> (f64, f64) {
        let (mut squared, mut violation) = (0.0, 0.0);
        for (k, p) in pressure.iter_mut().enumerate() {
            let u = self.displacement[k];
            let g = self.gap[k] + length * u;
            self.gap[k] = g;
            violation += match self.side[k] {
                Side::Free => {
                    *p += length * self.direction[k];
                    let r = self.residual[k] - length * (u - shift);
                    self.residual[k] = r;
                    squared += r * r;
                    let beyond = (-*p).max(*p - problem.limit_of(k)).max(0.0);
                    own * beyond * beyond
                }
                Side::Open => (level - g).max(0.0).powi(2) / own,
                Side::Limited => (g - level).max(0.0).powi(2) / own,
            };
        }
        (squared, violation)
    }
}
