//! Memory of a contact.

use super::SimError;
use super::accuracy::largest_mesh;
use super::scene::Scene;
use crate::error::InputError;
use crate::grid::Grid;

/// Memory of a lubricated contact per node \[byte\].
const LUBRICATED_BYTES: usize = 2000;
/// Memory of a dry contact per node \[byte\].
const DRY_BYTES: usize = 400;

/// Memory per node \[byte\].
fn bytes(lubricated: bool) -> usize {
    if lubricated { LUBRICATED_BYTES } else { DRY_BYTES }
}

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

/// Checks that the system grants the memory of a contact on `grid`: where it runs out later the process is
/// ended.
pub(super) fn validate_memory(grid: &Grid, lubricated: bool) -> Result<(), InputError> {
    grid.require_memory(bytes(lubricated))
}
