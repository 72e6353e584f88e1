//! Best state, history of residuals and work of a solve.

use super::snapshot::Snapshot;
use crate::grid::Grid;
use crate::report::{Residuals, Work};
use crate::reynolds::coupled::Coupled;
use crate::reynolds::state::ContactState;
use crate::strategy::Strategy;

/// Residuals for which there is room at first.
const HISTORY: usize = 256;

/// The record of one solve.
#[derive(Debug)]
pub(super) struct Record {
    /// Residuals of all states.
    pub(super) history: Vec<Residuals>,
    /// Work without the convolutions since the last evaluation of a state of unknown origin.
    pub(super) work: Work,
    /// Strategy of the present attempt.
    pub(super) strategy: Strategy,
    pub(super) best: Best,
}

/// The best state so far.
#[derive(Debug, Clone)]
pub(super) struct Best {
    pub(super) state: Snapshot,
    /// [`Residuals::UNKNOWN`] before there is one.
    pub(super) residuals: Residuals,
    /// The strategy that found it.
    pub(super) strategy: Strategy,
}

impl Record {
    pub(super) fn new(grid: Grid) -> Self {
        Self {
            history: Vec::with_capacity(HISTORY),
            work: Work::default(),
            strategy: Strategy::Attempt,
            best: Best {
                state: Snapshot::new(grid),
                residuals: Residuals::UNKNOWN,
                strategy: Strategy::Attempt,
            },
        }
    }

    /// Begins the record of another solve.
    pub(super) fn clear(&mut self) {
        self.work = Work::default();
        self.history.clear();
        (self.strategy, self.best.strategy) = (Strategy::Attempt, Strategy::Attempt);
        self.best.residuals = Residuals::UNKNOWN;
    }

    /// Saves the state if its residuals are the lowest so far.
    pub(super) fn keep_if_best(&mut self, residuals: Residuals, coupled: &Coupled, state: &ContactState) {
        if residuals.max() < self.best.residuals.max() {
            (self.best.residuals, self.best.strategy) = (residuals, self.strategy);
            self.best.state.save(coupled, state);
        }
    }
}
