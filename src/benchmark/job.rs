//! One combination of a benchmark.

use std::sync::Arc;

use super::case::Case;
use super::contestant::Contestant;
use crate::sim::Scene;

/// One combination.
#[derive(Debug, Clone)]
pub(super) struct Job {
    pub(super) case: Arc<Case>,
    pub(super) contestant: Contestant,
    pub(super) tolerance: f64,
    /// Cells along x; `None` for those of the case.
    pub(super) mesh: Option<usize>,
}

impl Job {
    /// The scene that is solved, on one mesh: without an estimate of mesh errors.
    pub(super) fn scene(&self) -> Scene {
        let mut scene = self.case.scene.clone();
        scene.solver.tolerance = self.tolerance;
        (scene.solver.estimate, scene.solver.accuracy) = (false, None);
        if let Some(cells) = self.mesh {
            scene.grid = scene.grid.with_nx(cells);
        }
        self.contestant.changed(scene)
    }
}
