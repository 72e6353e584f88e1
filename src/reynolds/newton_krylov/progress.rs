//! Whether a solve still gets anywhere.

use crate::grid::Grid;
use crate::report::Work;

/// Work without progress after which a solve has stalled, in convolutions: 6 to 8 s on 64 x 64 nodes and one
/// thread. Scenes that converge late, from an Rq of 13 um or with a pressure-viscosity coefficient of 15 1/Pa
/// between smooth bodies, take 19 000 and 16 000 in all.
const PATIENCE: f64 = 25_000.0;
/// On a row pockets are closed on all sides and fill slowly, and convolutions are cheap: below the second of
/// these numbers of nodes its patience is more in proportion, down to the first.
const NODES: [usize; 2] = [512, 4096];
/// Cost of a Newton step beside its convolutions: factorisation, and the sides of all nodes.
const STEP: f64 = 9.0;
/// Residual over the lowest before that is progress.
pub(super) const PROGRESS: f64 = 0.5;

/// The residual at the last progress, and the work until then.
#[derive(Debug, Clone, Copy)]
pub(super) struct Progress {
    patience: f64,
    residual: f64,
    cost: f64,
    ended: bool,
}

impl Progress {
    /// Of a solve on `grid`.
    pub(super) fn new(grid: &Grid) -> Self {
        let [few, many] = NODES;
        let nodes = if grid.ny() > 1 { many } else { grid.nx().clamp(few, many) };
        let patience = PATIENCE * many as f64 / nodes as f64;
        Self { patience, residual: f64::INFINITY, cost: 0.0, ended: false }
    }

    /// Whether the solve has stalled for good at `residual`, after `work` and the `convolutions` that it does
    /// not count yet.
    pub(super) fn ends(&mut self, residual: f64, work: &Work, convolutions: f64) -> bool {
        let cost = work.convolutions + convolutions + STEP * work.iterations as f64;
        if residual < PROGRESS * self.residual {
            (self.residual, self.cost) = (residual, cost);
        }
        self.ended = cost - self.cost > self.patience;
        self.ended
    }

    /// Whether [`Progress::ends`] has said so.
    pub(super) fn has_ended(&self) -> bool {
        self.ended
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_without_progress_ends_a_solve() {
        let grid = Grid::centred(16, 16, 1e-6, 1e-6).unwrap();
        let mut progress = Progress::new(&grid);
        let work = |convolutions, iterations| Work { convolutions, iterations, inner_iterations: 0 };
        assert!(!progress.ends(1.0, &work(0.0, 0), 0.0));
        assert!(!progress.ends(0.6, &work(0.9 * PATIENCE, 0), 0.0));
        assert!(!progress.ends(0.4, &work(1.1 * PATIENCE, 0), 0.0), "less than half");
        assert!(!progress.ends(0.3, &work(2.0 * PATIENCE, 0), 0.0) && !progress.has_ended());
        assert!(progress.ends(0.3, &work(2.0 * PATIENCE, 0), 0.2 * PATIENCE) && progress.has_ended());
        let steps = (PATIENCE / STEP) as u64;
        let mut progress = Progress::new(&grid);
        assert!(!progress.ends(1.0, &work(0.0, 0), 0.0) && !progress.ends(1.0, &work(0.0, steps), 0.0));
        assert!(progress.ends(1.0, &work(0.0, steps + 1), 0.0), "steps count too");
        let row = Grid::centred(512, 1, 1e-6, 1e-6).unwrap();
        let mut row = Progress::new(&row);
        assert!(!row.ends(1.0, &work(0.0, 0), 0.0) && !row.ends(1.0, &work(7.9 * PATIENCE, 0), 0.0));
        assert!(row.ends(1.0, &work(8.1 * PATIENCE, 0), 0.0), "a row has few nodes");
    }
}
