//! The multigrid cycle: relaxation on a grid and correction by the next coarser one.
//!
//! From level `l` a cycle relaxes, restricts residual and pressure to level `l - 1`, solves there by
//! [`CORRECTIONS`] cycles, adds the change of pressure, and relaxes again. Level 0 is solved by relaxation
//! alone. The approach is updated there, between two halves of the sweeps: it shifts all films at once, so no
//! finer grid needs to do it.

use super::acceleration::Acceleration;
use super::hierarchy::{Hierarchy, expected_film, pair};
use super::relax::RelaxationFactors;
use crate::error::InputError;
use crate::lubricant::Lubricant;
use crate::reynolds::inner_nodes::interior;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// Relaxation factors of the sweeps before a coarse-grid correction, for nodes dominated by entrainment. The
/// three unequal factors damp a wider range of modes than equal ones.
const PRE_SMOOTHING: [f64; 2] = [0.5, 0.4];
/// Relaxation factors of the sweeps after the correction.
const POST_SMOOTHING: [f64; 1] = [1.0];
/// Coarse-grid corrections per cycle: a W cycle.
const CORRECTIONS: usize = 2;
/// Sweeps on the coarsest grid.
const COARSEST_SWEEPS: usize = 8;
/// Relaxation factor on the coarsest grid.
const COARSEST_FACTOR: f64 = 0.3;
/// Factor of all relaxation factors for very thin films.
const VERY_THIN_FACTOR: f64 = 0.8;
/// Largest change of the approach in a step, in reference films.
const LARGEST_STEP: f64 = 0.1;
/// Largest change of a pressure in a sweep, in reference pressures.
const LARGEST_CHANGE: f64 = 0.5;

impl Hierarchy {
    /// One sweep on level `l` for each relaxation factor in `factors`, with the film updated before each.
    fn relax(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        l: usize,
        factors: &[f64],
    ) -> Result<(), InputError> {
        for share in factors {
            self.evaluate(problem, lubricant, l)?;
            // Bound the changes; very thin films are relaxed more cautiously.
            let largest = LARGEST_CHANGE * problem.reference_pressure;
            let factor = if self.is_very_thin { VERY_THIN_FACTOR } else { 1.0 };
            let factors = RelaxationFactors {
                dipole: factor * share,
                near: factor * self.near_factor,
                keeps_couplings: !self.is_very_thin,
            };
            self.relaxation.sweep(&mut self.levels[l], largest, factors);
            self.sweeps += 1;
        }
        Ok(())
    }

    /// One cycle from the finest grid.
    pub(super) fn cycle_finest(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
    ) -> Result<(), InputError> {
        self.cycle(problem, lubricant, self.top())
    }

    /// Combines the state after a cycle on the finest grid with earlier iterates; `start` is the state before
    /// it.
    pub(super) fn accelerate(
        &mut self,
        acceleration: &mut Acceleration,
        start: &ContactState,
        balance: &[f64],
    ) {
        let top = self.top();
        let pressure = &mut self.levels[top].pressure;
        acceleration.recombine(start, balance, pressure, &mut self.approach);
        self.levels[top].is_evaluated = false;
    }

    /// One cycle from level `l` down to the coarsest grid and back.
    pub(super) fn cycle(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        l: usize,
    ) -> Result<(), InputError> {
        if l == 0 {
            return self.solve_coarsest(problem, lubricant);
        }
        // pre-smoothing
        self.relax(problem, lubricant, l, &PRE_SMOOTHING)?;
        // restriction and coarse-grid correction
        self.evaluate(problem, lubricant, l)?;
        self.restrict(problem, lubricant, l)?;
        for _ in 0..CORRECTIONS {
            self.cycle(problem, lubricant, l - 1)?;
        }
        self.correct(l);
        // post-smoothing
        self.relax(problem, lubricant, l, &POST_SMOOTHING)
    }

    /// Sets up the FAS equations of the coarser grid that corrects level `l`.
    fn restrict(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        l: usize,
    ) -> Result<(), InputError> {
        let (coarse, fine) = pair(&mut self.levels, l - 1);
        let transfer = &mut self.transfers[l - 1];
        // restrict pressure, residual and load
        fine.compute_residual();
        transfer.average(&fine.pressure, &mut coarse.pressure);
        coarse.clear_boundary();
        coarse.start.copy_from_slice(&coarse.pressure);
        coarse.load = fine.load - fine.carried_load() + coarse.carried_load();
        self.displace(problem, l - 1)?;
        let (coarse, fine) = pair(&mut self.levels, l - 1);
        let transfer = &mut self.transfers[l - 1];
        // The film buffer holds the displacement; swap it into the gap.
        std::mem::swap(&mut coarse.film, &mut coarse.gap);
        // gap such that the restricted film belongs to the restricted pressure
        transfer.average(&fine.film, &mut coarse.film);
        for (gap, h) in coarse.gap.iter_mut().zip(&coarse.film) {
            *gap = h + self.approach - *gap;
        }
        coarse.update_flow(lubricant);
        // source: restricted residual plus the coarse balance
        transfer.average(&fine.residual, &mut coarse.source);
        let scale = fine.fluid.rate() / coarse.fluid.rate();
        for k in interior(&coarse.grid) {
            coarse.source[k] = scale * coarse.source[k] + coarse.balance(k);
        }
        Ok(())
    }

    /// Adds the interpolated change of the coarser grid to the pressure of level `l`.
    fn correct(&mut self, l: usize) {
        let (coarse, fine) = pair(&mut self.levels, l - 1);
        for (start, p) in coarse.start.iter_mut().zip(&coarse.pressure) {
            *start = p - *start;
        }
        self.transfers[l - 1].interpolate(&coarse.start, &mut fine.residual);
        // Nodes beside cavitated cells are skipped: a correction would shift the cavitation boundary by whole
        // coarse cells.
        fine.before.copy_from_slice(&fine.pressure);
        let nx = fine.grid.nx();
        for k in interior(&fine.grid) {
            let old = &fine.before;
            let is_inside = |o: usize| old[o] > 0.0 || fine.is_boundary[o];
            if old[k] > 0.0 && [k - 1, k + 1, k - nx, k + nx].into_iter().all(is_inside) {
                fine.pressure[k] = (old[k] + fine.residual[k]).max(0.0);
            }
        }
        fine.is_evaluated = false;
    }

    /// Solves level 0 by sweeps, with an update of the approach by the load error halfway.
    fn solve_coarsest(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
    ) -> Result<(), InputError> {
        let half = &[COARSEST_FACTOR; COARSEST_SWEEPS / 2];
        self.relax(problem, lubricant, 0, half)?;
        let level = &mut self.levels[0];
        let excess = (level.carried_load() - level.load) / problem.load;
        let most = LARGEST_STEP * expected_film(problem);
        self.approach -= (self.load_gain * excess).clamp(-most, most);
        level.is_evaluated = false;
        self.relax(problem, lubricant, 0, half)
    }
}
