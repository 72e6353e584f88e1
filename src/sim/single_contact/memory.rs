//! Memory of a single contact, on its own mesh or on those of its accuracy.

use super::accuracy::largest_mesh;
use crate::sim::contact::memory::bytes;
use crate::sim::error::SimError;
use crate::sim::scene::Scene;

impl Scene {
    /// Memory that one solve of the contact needs \[byte\], about: that of its grid. With an accuracy it is that of
    /// the finest mesh: of the first ones in a smooth contact (`grid.accuracy`), of the largest that is ever tried
    /// in a rough one.
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
}
