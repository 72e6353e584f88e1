//! The pressure that causes wear.

use crate::surface_state::SurfaceState;

/// The pressure that causes wear.
///
/// # Examples
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::wear::{Archard, WearLaw, WearPressure};
/// let fluid = SurfaceState::new(1e9, 353.15).with_sliding_speed(0.1); // no solid contact
/// let solid = Archard::new(5.45e-8, 5.45e-9, 200e-9, 6e9)?;
/// assert_eq!(solid.depth_rate(&fluid, 0.0), 0.0);
/// assert!(solid.with_pressure(WearPressure::Total).depth_rate(&fluid, 0.0) > 0.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum WearPressure {
    /// Solid pressure only (default): a full film prevents wear.
    #[default]
    Solid,
    /// Total pressure, fluid plus solid.
    Total,
}

impl WearPressure {
    /// Wear pressure at a node in the state `at` \[Pa\].
    pub(super) fn at(self, at: &SurfaceState) -> f64 {
        match self {
            Self::Solid => at.solid_pressure,
            Self::Total => at.pressure,
        }
    }
}
