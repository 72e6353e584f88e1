//! The cycles: sweeps on a grid, and the correction by the next coarser one.
//!
//! From level `l` a cycle relaxes, takes residual and pressure to level `l - 1`, solves there by
//! [`CORRECTIONS`] cycles, adds the change of pressure that this makes, and relaxes again. Level 0 is swept
//! alone, and there, in the middle of the sweeps, the approach follows the load error: it moves all films at
//! once, which no finer grid has to do.

use super::acceleration::Acceleration;
use super::hierarchy::{Hierarchy, expected_film, pair};
use super::relax::Shares;
use crate::error::InputError;
use crate::lubricant::Lubricant;
use crate::reynolds::problem::{LubricatedContact, interior};
use crate::reynolds::state::ContactState;

/// Sweeps before and after a coarse-grid correction, each with the share of a change that nodes take which
/// entrainment dominates. Together they damp more modes than three equal shares.
const SHARES_BEFORE: [f64; 2] = [0.5, 0.4];
/// After the correction.
const SHARES_AFTER: [f64; 1] = [1.0];
/// Corrections from the next coarser grid in a cycle: a W cycle.
const CORRECTIONS: usize = 2;
/// Sweeps on the coarsest grid.
const COARSEST_SWEEPS: usize = 8;
/// Share of a change that nodes take there.
const COARSEST_SHARE: f64 = 0.3;
/// Factor of all these shares where the film is very thin.
const VERY_THIN_FACTOR: f64 = 0.8;
/// Largest change of the approach at once, in reference films.
const LARGEST_STEP: f64 = 0.1;
/// Largest pressure change of a sweep, in reference pressures.
const LARGEST_CHANGE: f64 = 0.5;

impl Hierarchy {
    /// One sweep on level `l` for each of `shares`, its film brought up to date before each.
    fn relax(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        l: usize,
        shares: &[f64],
    ) -> Result<(), InputError> {
        for share in shares {
            self.evaluate(problem, lubricant, l)?;
            let largest = LARGEST_CHANGE * problem.reference_pressure;
            let factor = if self.is_very_thin { VERY_THIN_FACTOR } else { 1.0 };
            let shares = Shares {
                dipole: factor * share,
                near: factor * self.near_share,
                keeps_neighbours: !self.is_very_thin,
            };
            self.relaxation.sweep(&mut self.levels[l], largest, shares);
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

    /// Combines the state after a cycle on the finest grid with earlier ones; `start` is the state before it.
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

    /// One cycle from level `l` down and back.
    pub(super) fn cycle(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        l: usize,
    ) -> Result<(), InputError> {
        if l == 0 {
            return self.solve_coarsest(problem, lubricant);
        }
        self.relax(problem, lubricant, l, &SHARES_BEFORE)?;
        self.evaluate(problem, lubricant, l)?;
        self.descend(problem, lubricant, l)?;
        for _ in 0..CORRECTIONS {
            self.cycle(problem, lubricant, l - 1)?;
        }
        self.correct(l);
        self.relax(problem, lubricant, l, &SHARES_AFTER)
    }

    /// The equations of the coarser grid whose solution corrects level `l`.
    fn descend(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        l: usize,
    ) -> Result<(), InputError> {
        let (coarse, fine) = pair(&mut self.levels, l - 1);
        let transfer = &mut self.transfers[l - 1];
        fine.find_residual();
        transfer.average(&fine.pressure, &mut coarse.pressure);
        coarse.clear_boundary();
        coarse.start.copy_from_slice(&coarse.pressure);
        coarse.load = fine.load - fine.carried() + coarse.carried();
        self.displace(problem, l - 1)?;
        let (coarse, fine) = pair(&mut self.levels, l - 1);
        let transfer = &mut self.transfers[l - 1];
        // For the moment the displacement.
        std::mem::swap(&mut coarse.film, &mut coarse.gap);
        transfer.average(&fine.film, &mut coarse.film);
        for (gap, h) in coarse.gap.iter_mut().zip(&coarse.film) {
            *gap = h + self.approach - *gap;
        }
        coarse.take_film(lubricant);
        transfer.average(&fine.residual, &mut coarse.source);
        let scale = fine.fluid.rate() / coarse.fluid.rate();
        for k in interior(&coarse.grid) {
            coarse.source[k] = scale * coarse.source[k] + coarse.balance(k);
        }
        Ok(())
    }

    /// Adds the change of the coarser grid to the pressure of level `l`.
    fn correct(&mut self, l: usize) {
        let (coarse, fine) = pair(&mut self.levels, l - 1);
        for (start, p) in coarse.start.iter_mut().zip(&coarse.pressure) {
            *start = p - *start;
        }
        self.transfers[l - 1].interpolate(&coarse.start, &mut fine.residual);
        // A correction next to cavitated cells would move the border of the film by whole coarse cells.
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

    /// Sweeps on level 0, half of them before and half after the approach has followed the load error.
    fn solve_coarsest(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
    ) -> Result<(), InputError> {
        let half = &[COARSEST_SHARE; COARSEST_SWEEPS / 2];
        self.relax(problem, lubricant, 0, half)?;
        let level = &mut self.levels[0];
        let excess = (level.carried() - level.load) / problem.load;
        let most = LARGEST_STEP * expected_film(problem);
        self.approach -= (self.load_gain * excess).clamp(-most, most);
        level.is_evaluated = false;
        self.relax(problem, lubricant, 0, half)
    }
}
