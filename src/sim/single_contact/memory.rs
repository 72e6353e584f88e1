//! Memory of a single contact, on its own mesh or those chosen for an accuracy.

use super::accuracy::{first_mesh, largest_mesh};
use crate::sim::contact::memory::bytes;
use crate::sim::error::SimError;
use crate::sim::scene::Scene;

impl Scene {
    /// Approximate memory of one solve of the contact \[byte\]: that of its grid. With an accuracy it is that of
    /// the finest mesh: of the first ones for a smooth contact (`grid.accuracy`), of the largest allowed one for
    /// a rough contact.
    ///
    /// # Errors
    /// Cells or a box out of range; with `grid.accuracy` any value out of range.
    ///
    /// ```
    /// use stribeck::sim::Scene;
    /// assert_eq!(Scene::azam_2019(1000).memory()?, 2e9);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn memory(&self) -> Result<f64, SimError> {
        Ok(largest_mesh(self)? as f64 * bytes(self.is_lubricated()) as f64)
    }

    /// Approximate memory with which a solve of the contact begins \[byte\]: `grid.accuracy` and `solver.accuracy` may refine the mesh of a
    /// rough contact up to [`memory`](Self::memory).
    ///
    /// # Errors
    /// As of [`memory`](Self::memory).
    ///
    /// ```
    /// use stribeck::sim::Scene;
    /// let mut scene = Scene::azam_2019(128);
    /// scene.solver.accuracy = Some(0.02);
    /// assert!(scene.first_memory()? < 0.1 * scene.memory()?);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn first_memory(&self) -> Result<f64, SimError> {
        Ok(first_mesh(self)? as f64 * bytes(self.is_lubricated()) as f64)
    }
}
