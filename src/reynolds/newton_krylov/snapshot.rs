//! States to come back to.

use crate::grid::Grid;
use crate::reynolds::active_set::Kind;
use crate::reynolds::coupled::Coupled;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// What a state follows from: pressures, approach, sides of the nodes, films without plastic depth, and plastic
/// depths, which are unknowns where the fluid is at the limit.
#[derive(Debug, Clone)]
pub(super) struct Snapshot {
    pressure: Vec<f64>,
    fluid_pressure: Vec<f64>,
    plastic_depth: Vec<f64>,
    approach: f64,
    kinds: Vec<Kind>,
    elastic_film: Vec<f64>,
}

impl Snapshot {
    pub(super) fn new(grid: Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        Self {
            pressure: zeros(),
            fluid_pressure: zeros(),
            plastic_depth: zeros(),
            approach: 0.0,
            kinds: vec![Kind::BOUNDARY; grid.len()],
            elastic_film: zeros(),
        }
    }

    pub(super) fn keep(&mut self, coupled: &Coupled, state: &ContactState) {
        self.pressure.copy_from_slice(&state.pressure);
        self.fluid_pressure.copy_from_slice(&state.fluid_pressure);
        self.plastic_depth.copy_from_slice(&state.plastic_depth);
        self.approach = state.approach;
        self.kinds.copy_from_slice(&coupled.kinds);
        self.elastic_film.copy_from_slice(&coupled.elastic_film);
    }

    /// Puts the state back, with all that follows from it.
    pub(super) fn restore(
        &self,
        coupled: &mut Coupled,
        problem: &LubricatedContact<'_>,
        state: &mut ContactState,
    ) {
        state.pressure.copy_from_slice(&self.pressure);
        state.fluid_pressure.copy_from_slice(&self.fluid_pressure);
        state.plastic_depth.copy_from_slice(&self.plastic_depth);
        state.approach = self.approach;
        coupled.kinds.copy_from_slice(&self.kinds);
        coupled.elastic_film.copy_from_slice(&self.elastic_film);
        coupled.update(problem, state);
    }
}
