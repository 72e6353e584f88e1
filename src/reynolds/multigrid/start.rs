//! Initial states: full multigrid from a coarse grid, or a given state on the finest.
//!
//! The coarse start costs little and is as accurate as the film formula. Each finer grid then starts within
//! the discretization error of the previous one. The first grid depends on the ratio of film to displacement
//! alone: thin films need fine cells. A second-order scheme cannot represent a thin film on very coarse
//! grids, which use first order instead.

use super::hierarchy::{Hierarchy, expected_film, pair};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::dry::hertzian_on;
use crate::reynolds::flow::{FaceMobility, Scheme};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// Range of the cell size of the first grid, in Hertz half-widths. Within it the size is the square root of
/// film over displacement.
const START_CELL: (f64, f64) = (0.03, 0.12);
/// Cycles on the first grid.
const START_CYCLES: usize = 5;
/// Cycles on each finer grid, the finest included.
const CYCLES: usize = 2;
/// Ratio of film to displacement below which relaxation factors are reduced. Coarse grids do not resolve such
/// films, and larger changes would close them.
const VERY_THIN: f64 = 0.006;
/// Change of the approach per relative load error, as a share of the mean elastic displacement.
const LOAD_GAIN: f64 = 0.12;
/// Reduction of [`LOAD_GAIN`] for thin films: lower bound of the reduction, and the ratio of film to
/// displacement below which it is proportional to that ratio.
const THIN: (f64, f64) = (0.25, 0.02);
/// Error of the central film with second-order entrainment, times radius over cell size squared.
const SECOND_ORDER_ERROR: f64 = 5.0;
/// Share of the reference film above which this error makes the coarser grids of the start first order.
const LARGEST_ERROR: f64 = 0.3;

impl Hierarchy {
    /// Full multigrid from a Hertzian pressure and the formula film on a coarse grid to the finest grid, each
    /// solved to about its discretization error.
    pub(super) fn start(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
    ) -> Result<(), InputError> {
        let (a, b) = problem.reference_half_widths;
        // The displacement of a Hertz contact can be computed on any grid.
        let film = expected_film(problem);
        let displacement = self.set_hertzian_state(problem, 0, film)?;
        let thinness = film / displacement;
        let (least, most) = START_CELL;
        let cell = thinness.sqrt().clamp(least, most);
        let is_fine = |grid: &Grid| grid.dx() <= cell * a && grid.dy() <= cell * b;
        // The coarsest grid whose cells suit the film.
        let first = self.levels.iter().position(|level| is_fine(&level.grid)).unwrap_or(self.top());
        self.set_hertzian_state(problem, first, film)?;
        self.set_thinness(displacement, film);
        // from the first grid up: interpolate, choose the scheme, cycle
        for l in first..=self.top() {
            if l > first {
                let (coarse, fine) = pair(&mut self.levels, l - 1);
                self.transfers[l - 1].interpolate_cubic(&coarse.pressure, &mut fine.pressure);
                fine.clear_boundary();
                for p in &mut fine.pressure {
                    *p = p.max(0.0);
                }
                fine.is_evaluated = false;
            }
            // A coarse grid is first order where its second-order error is a large share of the film.
            let error = SECOND_ORDER_ERROR * displacement * (self.levels[l].grid.dx() / a).powi(2);
            let rough = l < self.top() && error > LARGEST_ERROR * problem.reference_film;
            let (scheme, face_mobility) = if rough {
                (Scheme::FirstOrder, FaceMobility::ReducedPressure)
            } else {
                (problem.scheme, problem.face_mobility)
            };
            self.discretise(l, scheme, face_mobility);
            for _ in 0..if l == first { START_CYCLES } else { CYCLES } {
                self.cycle(problem, lubricant, l)?;
            }
        }
        Ok(())
    }

    /// Sets the schemes of level `l` and of the levels that correct it. Coarse grids use reduced pressures:
    /// averaged mobilities, which vary by orders of magnitude from node to node, would make their corrections
    /// useless.
    fn discretise(&mut self, l: usize, scheme: Scheme, face_mobility: FaceMobility) {
        for level in &mut self.levels[..l] {
            level.fluid.set_scheme(scheme, FaceMobility::ReducedPressure);
        }
        self.levels[l].fluid.set_scheme(scheme, face_mobility);
    }

    /// Sets load gain and damping from mean elastic displacement and expected film.
    fn set_thinness(&mut self, displacement: f64, film: f64) {
        let (least, thick) = THIN;
        self.load_gain = LOAD_GAIN * displacement * (film / (thick * displacement)).clamp(least, 1.0);
        self.is_very_thin = film < VERY_THIN * displacement;
    }

    /// Warm start from a state on the finest grid.
    pub(super) fn resume(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
    ) -> Result<(), InputError> {
        let finest = self.finest_mut();
        finest.pressure.copy_from_slice(&state.fluid_pressure);
        finest.clear_boundary();
        for p in &mut finest.pressure {
            *p = p.max(0.0);
        }
        self.approach = state.approach;
        self.displace(problem, self.top())?;
        let finest = self.finest();
        // Mean displacement, weighted by pressure.
        let (mut sum, mut weight) = (0.0, f64::MIN_POSITIVE);
        for (p, displacement) in finest.pressure.iter().zip(&finest.film) {
            sum += p * displacement;
            weight += p;
        }
        self.set_thinness(sum / weight, expected_film(problem));
        self.discretise(self.top(), problem.scheme, problem.face_mobility);
        Ok(())
    }

    /// Sets a Hertzian pressure and the approach for a film of `film` at the center; returns the displacement
    /// there.
    fn set_hertzian_state(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        l: usize,
        film: f64,
    ) -> Result<f64, InputError> {
        let (a, b) = problem.reference_half_widths;
        let level = &mut self.levels[l];
        hertzian_on(&level.grid, problem, &mut level.pressure);
        level.clear_boundary();
        // Scale to the load.
        let scale = problem.load / level.carried_load().max(f64::MIN_POSITIVE);
        for p in &mut level.pressure {
            *p *= scale;
        }
        self.displace(problem, l)?;
        let level = &self.levels[l];
        let (mut height, mut displacement, mut count) = (0.0, 0.0, 0.0);
        for (k, (x, y)) in level.grid.nodes().enumerate() {
            if (x / a).powi(2) + (y / b).powi(2) < 0.25 {
                height += level.film[k] + level.gap[k];
                displacement += level.film[k];
                count += 1.0;
            }
        }
        let count = f64::max(count, 1.0);
        self.approach = height / count - film;
        Ok(displacement / count)
    }
}
