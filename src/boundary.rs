//! What lies beyond the edges of a field.

/// What lies beyond the edges of a surface or a grid.
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
