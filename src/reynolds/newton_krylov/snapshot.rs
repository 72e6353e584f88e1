//! States to come back to.

use crate::grid::Grid;
use crate::reynolds::active_set::Kind;
use crate::reynolds::coupled::Coupled;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// A state with the sides of its nodes and the films without plastic depth, to come back to.
#[derive(Debug, Clone)]
pub(super) struct Snapshot {
    pub(super) state: ContactState,
    kinds: Vec<Kind>,
    elastic_film: Vec<f64>,
}

impl Snapshot {
    pub(super) fn new(grid: Grid) -> Self {
        Self {
            state: ContactState::new(&grid),
            kinds: vec![Kind::BOUNDARY; grid.len()],
            elastic_film: vec![0.0; grid.len()],
        }
    }

    pub(super) fn keep(&mut self, coupled: &Coupled, state: &ContactState) {
        self.state.clone_from(state);
        self.kinds.copy_from_slice(&coupled.kinds);
        self.elastic_film.copy_from_slice(&coupled.elastic_film);
    }

    /// Puts state, sides and films back.
    pub(super) fn restore(
        &self,
        coupled: &mut Coupled,
        problem: &LubricatedContact<'_>,
        state: &mut ContactState,
    ) {
        state.clone_from(&self.state);
        coupled.kinds.copy_from_slice(&self.kinds);
        coupled.elastic_film.copy_from_slice(&self.elastic_film);
        coupled.update(problem, state);
    }
}
