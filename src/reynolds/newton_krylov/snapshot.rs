//! Saved states: the start of a step, and the best state of a solve.

use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::active_set::NodeState;
use crate::reynolds::coupled::{Changed, Coupled};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// The fields that determine a state: pressures, approach, active set, films without plastic depth, and plastic
/// depths, which are unknowns where the fluid is at the limit.
#[derive(Debug, Clone)]
pub(super) struct Snapshot {
    pressure: Vec<f64>,
    fluid_pressure: Vec<f64>,
    plastic_depth: Vec<f64>,
    approach: f64,
    active_set: Vec<NodeState>,
    elastic_film: Vec<f64>,
}

/// One node of a [`Snapshot`].
#[derive(Debug, Clone, Copy)]
pub(super) struct SavedNode {
    pub(super) pressure: f64,
    pub(super) fluid_pressure: f64,
    pub(super) plastic_depth: f64,
    pub(super) elastic_film: f64,
}

impl Snapshot {
    pub(super) fn new(grid: Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        Self {
            pressure: zeros(),
            fluid_pressure: zeros(),
            plastic_depth: zeros(),
            approach: 0.0,
            active_set: vec![NodeState::BOUNDARY; grid.len()],
            elastic_film: zeros(),
        }
    }

    /// Copies the present state.
    pub(super) fn save(&mut self, coupled: &Coupled, state: &ContactState) {
        self.pressure.copy_from_slice(&state.pressure);
        self.fluid_pressure.copy_from_slice(&state.fluid_pressure);
        self.plastic_depth.copy_from_slice(&state.plastic_depth);
        self.approach = state.approach;
        self.active_set.copy_from_slice(&coupled.active_set);
        self.elastic_film.copy_from_slice(&coupled.elastic_film);
    }

    /// Restores the state with its films and balances; no convolution.
    pub(super) fn restore(
        &self,
        coupled: &mut Coupled,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<(), InputError> {
        state.pressure.copy_from_slice(&self.pressure);
        state.fluid_pressure.copy_from_slice(&self.fluid_pressure);
        state.plastic_depth.copy_from_slice(&self.plastic_depth);
        state.approach = self.approach;
        coupled.active_set.copy_from_slice(&self.active_set);
        coupled.elastic_film.copy_from_slice(&self.elastic_film);
        // The elastic film is saved: no convolution.
        coupled.evaluate(problem, state, Changed::ElasticFilm)?;
        Ok(())
    }

    /// Node `k` as it was saved.
    pub(super) fn node(&self, k: usize) -> SavedNode {
        SavedNode {
            pressure: self.pressure[k],
            fluid_pressure: self.fluid_pressure[k],
            plastic_depth: self.plastic_depth[k],
            elastic_film: self.elastic_film[k],
        }
    }
}
