//! Continuation of a field beyond its edges.
//!
//! Means, spectra and contact patches differ between periodic and bounded fields.

/// Continuation of a surface or field beyond its edges.
///
/// # Examples
///
/// ```
/// use stribeck::metrics::contact_patches;
/// use stribeck::{Boundary, Grid};
/// let grid = Grid::centred(8, 1, 1e-6, 1e-6)?;
/// let contact = [true, true, false, false, false, false, true, true];
/// // On a periodic field a patch may extend across opposite edges.
/// assert_eq!(contact_patches(&grid, &contact, Boundary::Periodic)?.areas.len(), 1);
/// assert_eq!(contact_patches(&grid, &contact, Boundary::Open)?.areas.len(), 2);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Boundary {
    /// Periodic: opposite edges join.
    #[default]
    Periodic,
    /// Unknown, as for a measured surface.
    Open,
}
