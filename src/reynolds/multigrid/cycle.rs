//! The hierarchy of grids, its cycles and the full multigrid start.

use super::acceleration::Acceleration;
use super::level::{Influence, Level};
use super::relax::{LineRelaxation, Shares};
use super::transfer::Transfer;
use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::dry::hertzian_on;
use crate::reynolds::flow::{Cavitation, FaceMobility, Scheme};
use crate::reynolds::problem::{LubricatedContact, interior};
use crate::reynolds::state::ContactState;

/// Sweeps before and after a coarse-grid correction, each with the share of a change that nodes take which
/// entrainment dominates. Together they damp more modes than three equal shares.
const SHARES_BEFORE: [f64; 2] = [0.5, 0.4];
const SHARES_AFTER: [f64; 1] = [1.0];
/// Share of a change that nodes take where pressure flow dominates a little, at first and once cycles have
/// become slow: on fine grids the pressure spike swings with the first.
const NEAR_SHARE: f64 = 0.5;
const CAREFUL_SHARE: f64 = 0.3;
/// Corrections from the next coarser grid in a cycle: a W cycle.
const CORRECTIONS: usize = 2;
/// Sweeps on the coarsest grid.
const COARSEST_SWEEPS: usize = 8;
const COARSEST_SHARE: f64 = 0.3;
/// Nodes along an axis below which a grid is not coarsened.
const SMALLEST: usize = 24;
/// Cells of the first grid of the start in Hertz half-widths: square root of film over displacement, within
/// bounds.
const START_CELL: (f64, f64) = (0.03, 0.12);
/// Cycles on the grid of the start, and on the finer ones before the finest.
const START_CYCLES: usize = 5;
const CYCLES: usize = 2;
/// Expected film over displacement below which all of these shares are smaller, by the factor that follows:
/// coarse grids do not hold such films, and larger changes would close them.
const VERY_THIN: f64 = 0.006;
const VERY_THIN_FACTOR: f64 = 0.8;
/// Share of the mean elastic displacement by which the approach follows a relative load error of one.
const LOAD_GAIN: f64 = 0.12;
/// That share is smaller, but not below the first number, where film over displacement is below the second.
const THIN: (f64, f64) = (0.25, 0.02);
/// Largest change of the approach at once, in reference films.
const LARGEST_STEP: f64 = 0.1;
/// Largest pressure change of a sweep, in reference pressures.
const LARGEST_CHANGE: f64 = 0.5;
/// Error of the central film with second-order entrainment, times radius over cell size squared.
const SECOND_ORDER_ERROR: f64 = 5.0;
/// Share of the reference film that this error may take on the coarser grids of the start; else these are
/// first order.
const LARGEST_ERROR: f64 = 0.3;

/// Grids from the coarsest to that of the problem.
#[derive(Debug)]
pub(super) struct Hierarchy {
    levels: Vec<Level>,
    /// Between the grids `l` and `l + 1`.
    transfers: Vec<Transfer>,
    /// Bodies on all grids but the finest.
    bodies: Vec<Box<dyn DeformationModel>>,
    relaxation: LineRelaxation,
    pub(super) approach: f64,
    /// Change of the approach for a relative load error of one \[m\].
    load_gain: f64,
    /// Share of a change that nodes take where pressure flow dominates a little.
    near_share: f64,
    is_very_thin: bool,
    /// In equivalents of the finest grid.
    pub(super) convolutions: f64,
    pub(super) sweeps: u64,
}

impl Hierarchy {
    /// Whether a model knows the bodies on the coarsest of its grids.
    pub(super) fn has_bodies(body: &dyn DeformationModel) -> bool {
        match grids(body.grid()).as_slice() {
            [coarsest, _, ..] => body.on_grid(*coarsest).is_some(),
            _ => true,
        }
    }

    /// Grids for a body; none where the model lives on one grid alone.
    pub(super) fn new(body: &dyn DeformationModel) -> Option<Self> {
        let grids = grids(body.grid());
        let coarse = grids.len() - 1;
        let bodies = grids[..coarse].iter().map(|grid| body.on_grid(*grid)).collect::<Option<Vec<_>>>()?;
        let mut levels: Vec<Level> = grids.iter().map(|grid| Level::new(*grid)).collect();
        for (level, body) in levels.iter_mut().zip(bodies.iter().map(AsRef::as_ref).chain([body])) {
            level.influence = Influence::new(body);
        }
        Some(Self {
            levels,
            transfers: grids.windows(2).map(|pair| Transfer::new(&pair[1], &pair[0])).collect(),
            bodies,
            relaxation: LineRelaxation::new(&body.grid()),
            approach: 0.0,
            load_gain: 0.0,
            near_share: NEAR_SHARE,
            is_very_thin: false,
            convolutions: 0.0,
            sweeps: 0,
        })
    }

    /// Whether the grids are those of this body.
    pub(super) fn fits(&self, body: &dyn DeformationModel) -> bool {
        let finest = self.finest();
        finest.grid == body.grid() && finest.influence == Influence::new(body)
    }

    /// Relaxes the nodes beside the pressure spike more carefully from now on; says whether that is new.
    pub(super) fn relax_carefully(&mut self) -> bool {
        let is_new = self.near_share > CAREFUL_SHARE;
        self.near_share = CAREFUL_SHARE;
        is_new
    }

    fn top(&self) -> usize {
        self.levels.len() - 1
    }

    pub(super) fn finest(&self) -> &Level {
        &self.levels[self.top()]
    }

    pub(super) fn finest_mut(&mut self) -> &mut Level {
        let top = self.top();
        &mut self.levels[top]
    }

    /// Takes gaps, load, speeds and schemes from the problem.
    pub(super) fn configure(&mut self, problem: &LubricatedContact<'_>) {
        self.convolutions = 0.0;
        self.sweeps = 0;
        self.near_share = NEAR_SHARE;
        for level in &mut self.levels {
            level.fluid.configure(problem);
            // Nothing reforms in a smooth film; where it does, the residuals tell, and another solver
            // finishes.
            level.fluid.set_cavitation(Cavitation::Reynolds);
            level.source.fill(0.0);
            level.load = problem.load;
            level.is_evaluated = false;
        }
        let finest = self.finest_mut();
        finest.gap.copy_from_slice(problem.gap);
        match problem.squeeze {
            None => self.levels.iter_mut().for_each(|level| level.previous = None),
            Some(squeeze) => {
                for level in &mut self.levels {
                    level.previous.get_or_insert_with(|| vec![0.0; level.grid.len()]);
                }
                if let Some(previous) = &mut self.finest_mut().previous {
                    previous.copy_from_slice(squeeze.previous_mass);
                }
            }
        }
        for l in (0..self.top()).rev() {
            let Self { levels, transfers, .. } = self;
            let (coarse, fine) = pair(levels, l);
            let transfer = &mut transfers[l];
            transfer.sample(&fine.gap, &mut coarse.gap);
            if let (Some(fine), Some(coarse)) = (&fine.previous, &mut coarse.previous) {
                transfer.average(fine, coarse);
            }
        }
    }

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

    /// `K p` of level `l` in place of its film.
    fn displace(&mut self, problem: &mut LubricatedContact<'_>, l: usize) -> Result<(), InputError> {
        let top = self.top();
        let share = self.levels[l].grid.len() as f64 / self.levels[top].grid.len() as f64;
        self.convolutions += share;
        let body = self.bodies.get_mut(l).map_or(&mut *problem.deformation, |body| &mut **body);
        let level = &mut self.levels[l];
        body.displacement(&level.pressure, &mut level.film)
    }

    /// Film and flow quantities of level `l`, unless they are there.
    fn evaluate(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        l: usize,
    ) -> Result<(), InputError> {
        if self.levels[l].is_evaluated {
            return Ok(());
        }
        self.displace(problem, l)?;
        let (level, approach) = (&mut self.levels[l], self.approach);
        for (h, gap) in level.film.iter_mut().zip(&level.gap) {
            *h += gap - approach;
        }
        level.take_film(lubricant);
        Ok(())
    }

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
    fn cycle(
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

/// The film that starts are built from, where no formula gives one a little above the contact film.
fn expected_film(problem: &LubricatedContact<'_>) -> f64 {
    problem.reference_film.max(2.0 * problem.contact_film())
}

/// Levels `l` and `l + 1`.
fn pair(levels: &mut [Level], l: usize) -> (&mut Level, &mut Level) {
    let (coarse, fine) = levels.split_at_mut(l + 1);
    (&mut coarse[l], &mut fine[0])
}

/// The grids over the box of `finest`, coarsest first.
fn grids(finest: Grid) -> Vec<Grid> {
    let mut grids = vec![finest];
    while let Some(next) = grids.last().and_then(coarser) {
        grids.push(next);
    }
    grids.reverse();
    grids
}

/// The grid of half the nodes along both axes over the same box; none below [`SMALLEST`].
fn coarser(grid: &Grid) -> Option<Grid> {
    if grid.nx().min(grid.ny()) < SMALLEST {
        return None;
    }
    let (nx, ny) = (grid.nx().div_ceil(2), grid.ny().div_ceil(2));
    let (left, low) = (grid.x(0) - 0.5 * grid.dx(), grid.y(0) - 0.5 * grid.dy());
    Grid::from_edges(nx, ny, [left, left + grid.size_x()], [low, low + grid.size_y()]).ok()
}
