//! What lies beyond the edges of a field.
//!
//! Means, spectra and patches of solid contact are counted otherwise on a field that repeats than on one that
//! ends.

/// What lies beyond the edges of a surface or a grid.
///
/// # Examples
///
/// ```
/// use stribeck::metrics::contact_patches;
/// use stribeck::{Boundary, Grid};
/// let grid = Grid::centred(8, 1, 1e-6, 1e-6)?;
/// let contact = [true, true, false, false, false, false, true, true];
/// // Across opposite edges it is one patch where the field repeats.
/// assert_eq!(contact_patches(&grid, &contact, Boundary::Periodic)?.areas.len(), 1);
/// assert_eq!(contact_patches(&grid, &contact, Boundary::Open)?.areas.len(), 2);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Boundary {
    /// The field repeats: opposite edges fit together.
    #[default]
    Periodic,
    /// Nothing is known, as of a measured surface.
    Open,
}
