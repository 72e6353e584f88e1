//! Conditions for tribochemical activity of a node.

use crate::surface_state::SurfaceState;

/// Condition under which the film of a node grows and is removed; the film of an inactive node is frozen.
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::tribochem::Activation;
/// let at = SurfaceState::new(1e9, 353.15).with_sliding_speed(0.005)
///     .with_gap(20e-9);
/// assert!(!Activation::SolidContact.is_active(&at));
/// assert!(Activation::Pressure.is_active(&at));
/// assert!(!Activation::ShearStress.is_active(&at));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Activation {
    /// Solid contact (default; boundary films on asperities).
    #[default]
    SolidContact,
    /// Pressure, of fluid or solid contact.
    Pressure,
    /// Shear stress, of fluid or solid contact (growth in full films).
    ShearStress,
}

impl Activation {
    /// Whether a node in the state `at` is active.
    pub fn is_active(self, at: &SurfaceState) -> bool {
        match self {
            Self::SolidContact => at.in_contact,
            Self::Pressure => at.pressure > 0.0,
            Self::ShearStress => at.shear_stress.abs() > 0.0,
        }
    }
}
