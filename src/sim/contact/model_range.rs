//! Whether a solution is within the range of its model.

use super::asperity_inlets::WIDE_CELLS;
use super::solution::ContactSolution;
use super::warnings::Warning;
use crate::sim::scene::SolverModel;

impl ContactSolution {
    /// Whether the contact is within the range of its model: without warnings about the smooth film or the cells of asperity
    /// inlets, always for the resolved model.
    ///
    /// ```
    /// use stribeck::sim::{Scene, scene::SolverModel, solve_contact};
    /// let mut scene = Scene::azam_2019(32); // cells of 16 um
    /// assert!(solve_contact(&scene)?.is_within_model());
    /// scene.solver.model = SolverModel::AsperityInlets;
    /// assert!(!solve_contact(&scene)?.is_within_model());
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn is_within_model(&self) -> bool {
        let is_outside =
            |warning: &Warning| warning.field == "solver.model" || warning.message.contains(WIDE_CELLS);
        self.model != Some(SolverModel::AsperityInlets) || !self.warnings.iter().any(is_outside)
    }
}
