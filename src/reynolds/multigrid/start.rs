//! What the cycles begin with: full multigrid from a coarse grid, or a state on the finest.
//!
//! A start on a coarse grid costs next to nothing and is as good as the film formula; each finer grid then
//! begins within the discretisation error of the one before. Where the first grid lies depends on film over
//! displacement alone: thin films need fine cells from the beginning. Very coarse grids of a second-order
//! scheme hold no thin film and are of first order.

use super::hierarchy::{Hierarchy, expected_film, pair};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::dry::hertzian_on;
use crate::reynolds::flow::{FaceMobility, Scheme};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// Cells of the first grid of the start in Hertz half-widths: square root of film over displacement, within
/// bounds.
const START_CELL: (f64, f64) = (0.03, 0.12);
/// Cycles on the first grid.
const START_CYCLES: usize = 5;
/// Cycles on each finer grid, the finest included.
const CYCLES: usize = 2;
/// Expected film over displacement below which sweeps change less: coarse grids do not hold such films, and
/// larger changes would close them.
const VERY_THIN: f64 = 0.006;
/// Share of the mean elastic displacement by which the approach follows a relative load error of one.
const LOAD_GAIN: f64 = 0.12;
/// Where film over displacement is below the second number that share is lessened in proportion, to the first
/// number times itself at least.
const THIN: (f64, f64) = (0.25, 0.02);
/// Error of the central film with second-order entrainment, times radius over cell size squared.
const SECOND_ORDER_ERROR: f64 = 5.0;
/// Share of the reference film that this error may take on the coarser grids of the start; else these are
/// first order.
const LARGEST_ERROR: f64 = 0.3;

impl Hierarchy {
    /// Full multigrid: from a Hertzian pressure and the film of a formula on a coarse grid up to the finest,
    /// solved on each to about its discretisation error.
    pub(super) fn start(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
    ) -> Result<(), InputError> {
        let (a, b) = problem.reference_half_widths;
        // The displacement of the Hertz contact is known on any grid.
        let film = expected_film(problem);
        let displacement = self.guess(problem, 0, film)?;
        let thinness = film / displacement;
        let (least, most) = START_CELL;
        let cell = thinness.sqrt().clamp(least, most);
        let is_fine = |grid: &Grid| grid.dx() <= cell * a && grid.dy() <= cell * b;
        let first = self.levels.iter().position(|level| is_fine(&level.grid)).unwrap_or(self.top());
        self.guess(problem, first, film)?;
        self.set_thinness(displacement, film);
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

    /// Schemes of level `l` and of those that correct it. Coarse grids always work with reduced pressures:
    /// with means of mobilities that change by orders of magnitude from node to node their corrections are
    /// useless.
    fn discretise(&mut self, l: usize, scheme: Scheme, face_mobility: FaceMobility) {
        for level in &mut self.levels[..l] {
            level.fluid.set_scheme(scheme, FaceMobility::ReducedPressure);
        }
        self.levels[l].fluid.set_scheme(scheme, face_mobility);
    }

    /// How the approach follows load errors and how nodes are relaxed, by mean elastic displacement and
    /// expected film.
    fn set_thinness(&mut self, displacement: f64, film: f64) {
        let (least, thick) = THIN;
        self.load_gain = LOAD_GAIN * displacement * (film / (thick * displacement)).clamp(least, 1.0);
        self.is_very_thin = film < VERY_THIN * displacement;
    }

    /// Starts from a state on the finest grid.
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
        let (mut sum, mut weight) = (0.0, f64::MIN_POSITIVE);
        for (p, displacement) in finest.pressure.iter().zip(&finest.film) {
            sum += p * displacement;
            weight += p;
        }
        self.set_thinness(sum / weight, expected_film(problem));
        self.discretise(self.top(), problem.scheme, problem.face_mobility);
        Ok(())
    }

    /// Hertzian pressure and an approach that leaves the reference film at the centre; returns the
    /// displacement there.
    fn guess(&mut self, problem: &mut LubricatedContact<'_>, l: usize, film: f64) -> Result<f64, InputError> {
        let (a, b) = problem.reference_half_widths;
        let level = &mut self.levels[l];
        hertzian_on(&level.grid, problem, &mut level.pressure);
        level.clear_boundary();
        let scale = problem.load / level.carried().max(f64::MIN_POSITIVE);
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
