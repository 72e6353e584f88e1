//! The hierarchy of grids: levels, transfers between them, and films consistent with the pressures.
//!
//! Each grid has half of the nodes of the next along both axes over the same box, rounded up, down to
//! [`SMALLEST`]. Bodies on coarser grids come from [`DeformationModel::on_grid`]. A level is evaluated if its
//! film and flow quantities belong to its pressure. A change of pressure clears `is_evaluated`, and the next
//! evaluation costs a convolution.

use super::level::{Influence, Level};
use super::relax::LineRelaxation;
use super::transfer::Transfer;
use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::flow::Cavitation;
use crate::reynolds::problem::LubricatedContact;

/// Number of nodes along an axis below which a grid is not coarsened.
const SMALLEST: usize = 24;
/// Initial relaxation factor of nodes where pressure flow dominates weakly. On fine grids the pressure spike
/// oscillates with it, and slow cycles switch to [`DAMPED_FACTOR`].
const INITIAL_FACTOR: f64 = 0.5;
/// Relaxation factor of these nodes after slow cycles.
const DAMPED_FACTOR: f64 = 0.3;

/// Grids from the coarsest to that of the problem.
#[derive(Debug)]
pub(super) struct Hierarchy {
    /// Levels, coarsest first.
    pub(super) levels: Vec<Level>,
    /// Transfers between levels `l` and `l + 1`.
    pub(super) transfers: Vec<Transfer>,
    /// Bodies on all grids except the finest.
    bodies: Vec<Box<dyn DeformationModel>>,
    /// Buffers of the relaxation, for all levels.
    pub(super) relaxation: LineRelaxation,
    /// Approach of the undeformed bodies, common to all levels \[m\].
    pub(super) approach: f64,
    /// Change of the approach per relative load error \[m\].
    pub(super) load_gain: f64,
    /// Relaxation factor where pressure flow dominates weakly.
    pub(super) near_factor: f64,
    /// Whether the ratio of film to displacement requires smaller relaxation factors.
    pub(super) is_very_thin: bool,
    /// Convolutions in equivalents of the finest grid.
    pub(super) convolutions: f64,
    /// Sweeps on all levels since the problem was configured.
    pub(super) sweeps: u64,
}

impl Hierarchy {
    /// Whether a model exists on the coarsest of its grids.
    pub(super) fn has_bodies(body: &dyn DeformationModel) -> bool {
        match grids(body.grid()).as_slice() {
            [coarsest, _, ..] => body.on_grid(*coarsest).is_some(),
            _ => true,
        }
    }

    /// Hierarchy for a body; `None` where the model exists on one grid only.
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
            near_factor: INITIAL_FACTOR,
            is_very_thin: false,
            convolutions: 0.0,
            sweeps: 0,
        })
    }

    /// Whether the hierarchy was built for this body.
    pub(super) fn fits(&self, body: &dyn DeformationModel) -> bool {
        let finest = self.finest();
        finest.grid == body.grid() && finest.influence == Influence::new(body)
    }

    /// Reduces the relaxation factor beside the pressure spike; returns whether it was larger.
    pub(super) fn damp_relaxation(&mut self) -> bool {
        let is_new = self.near_factor > DAMPED_FACTOR;
        self.near_factor = DAMPED_FACTOR;
        is_new
    }

    /// Index of the finest level.
    pub(super) fn top(&self) -> usize {
        self.levels.len() - 1
    }

    /// The level of the problem's grid.
    pub(super) fn finest(&self) -> &Level {
        &self.levels[self.top()]
    }

    /// Mutable access to the finest level.
    pub(super) fn finest_mut(&mut self) -> &mut Level {
        let top = self.top();
        &mut self.levels[top]
    }

    /// Copies gaps, load, speeds and schemes of the problem.
    pub(super) fn configure(&mut self, problem: &LubricatedContact<'_>) {
        self.convolutions = 0.0;
        self.sweeps = 0;
        self.near_factor = INITIAL_FACTOR;
        for level in &mut self.levels {
            level.fluid.configure(problem);
            // Smooth full films do not reform. If the film does, the residuals stay high and another solver
            // takes over.
            level.fluid.set_cavitation(Cavitation::Reynolds);
            level.source.fill(0.0);
            level.load = problem.load;
            level.is_evaluated = false;
        }
        // Gap and previous masses on the finest grid.
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
        // And restricted to the coarser ones.
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

    /// Writes `K p` of level `l` to its film.
    pub(super) fn displace(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        l: usize,
    ) -> Result<(), InputError> {
        let top = self.top();
        let cost = self.levels[l].grid.len() as f64 / self.levels[top].grid.len() as f64;
        self.convolutions += cost;
        let body = self.bodies.get_mut(l).map_or(&mut *problem.deformation, |body| &mut **body);
        let level = &mut self.levels[l];
        body.displacement(&level.pressure, &mut level.film)
    }

    /// Updates film and flow quantities of level `l` if they are outdated.
    pub(super) fn evaluate(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        lubricant: &Lubricant,
        l: usize,
    ) -> Result<(), InputError> {
        if self.levels[l].is_evaluated {
            return Ok(());
        }
        // Elastic film: displacement plus gap minus approach.
        self.displace(problem, l)?;
        let (level, approach) = (&mut self.levels[l], self.approach);
        for (h, gap) in level.film.iter_mut().zip(&level.gap) {
            *h += gap - approach;
        }
        level.update_flow(lubricant);
        Ok(())
    }
}

/// Film for initial states: the reference film, or a value above the contact film without a film formula.
pub(super) fn expected_film(problem: &LubricatedContact<'_>) -> f64 {
    problem.reference_film.max(2.0 * problem.contact_film())
}

/// Mutable access to levels `l` and `l + 1`.
pub(super) fn pair(levels: &mut [Level], l: usize) -> (&mut Level, &mut Level) {
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

/// The grid with half of the nodes along both axes over the same box; `None` below [`SMALLEST`].
pub(in crate::reynolds) fn coarser(grid: &Grid) -> Option<Grid> {
    if grid.nx().min(grid.ny()) < SMALLEST {
        return None;
    }
    let (nx, ny) = (grid.nx().div_ceil(2), grid.ny().div_ceil(2));
    let (left, low) = (grid.x(0) - 0.5 * grid.dx(), grid.y(0) - 0.5 * grid.dy());
    Grid::from_edges(nx, ny, [left, left + grid.size_x()], [low, low + grid.size_y()]).ok()
}
