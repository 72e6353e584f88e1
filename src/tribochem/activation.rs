//! What wakes the chemistry of a node.

use crate::rubbing::RubbingPoint;

/// The condition under which a node grows and loses film; otherwise its film is frozen.
///
/// ```
/// use stribeck::RubbingPoint;
/// use stribeck::tribochem::Activation;
/// let at = RubbingPoint::new(1e9, 353.15).with_sliding_speed(0.005)
///     .with_gap(20e-9);
/// assert!(!Activation::SolidContact.is_active(&at));
/// assert!(Activation::Pressure.is_active(&at));
/// assert!(!Activation::ShearStress.is_active(&at));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Activation {
    /// The node counts as solid contact (default; boundary films on asperities).
    #[default]
    SolidContact,
    /// The node carries pressure, fluid or solid.
    Pressure,
    /// The node is sheared, whether by fluid or by contact (growth in full films).
    ShearStress,
}

impl Activation {
    /// Whether chemistry runs at a node in the state `at`.
    pub fn is_active(self, at: &RubbingPoint) -> bool {
        match self {
            Self::SolidContact => at.in_contact,
            Self::Pressure => at.pressure > 0.0,
            Self::ShearStress => at.shear_stress.abs() > 0.0,
        }
    }
}
