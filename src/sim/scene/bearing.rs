//! The rolling bearing that the contact belongs to: the table `bearing`.

use std::f64::consts::TAU;

use crate::error::InputError;

/// A rolling bearing, for the viscosity ratio kappa of ISO 281. It has no effect on the contact.
///
/// # Examples
///
/// ```
/// use std::f64::consts::TAU;
/// use stribeck::sim::scene::RollingBearingSpec;
/// // 1500 rpm and 40 mm: 4500/sqrt(1500 40) = 18.4 mm^2/s.
/// let bearing = RollingBearingSpec::new(1500.0 * TAU / 60.0, 40e-3);
/// assert!((bearing.rated_viscosity()? / 18.37e-6 - 1.0).abs() < 1e-3);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct RollingBearingSpec {
    /// Rate of rotation \[rad/s\].
    pub rotation: f64,
    /// Mean of bore and outer diameter, or diameter of the pitch circle \[m\].
    pub mean_diameter: f64,
}

impl RollingBearingSpec {
    /// A bearing at a `rotation` \[rad/s\] with this mean diameter \[m\].
    pub const fn new(rotation: f64, mean_diameter: f64) -> Self {
        Self { rotation, mean_diameter }
    }

    /// Viscosity that the bearing needs for an adequate film \[m^2/s\]:
    ///
    /// `nu_1 = 45000 n^-0.83 D^-0.5` below 1000 rpm and `4500 n^-0.5 D^-0.5` above, in mm^2/s, with `n` in rpm and `D` in
    /// mm. Kappa is the viscosity of the oil over it.
    ///
    /// Source: ISO 281:2007, 9.3.3.3.2.
    ///
    /// # Errors
    /// Values that are not finite and positive.
    pub fn rated_viscosity(&self) -> Result<f64, InputError> {
        InputError::require_positive("bearing.rotation", self.rotation)?;
        InputError::require_positive("bearing.mean_diameter", self.mean_diameter)?;
        let (rpm, millimetres) = (60.0 * self.rotation / TAU, 1e3 * self.mean_diameter);
        let by_speed = if rpm < 1000.0 { 45_000.0 * rpm.powf(-0.83) } else { 4500.0 * rpm.powf(-0.5) };
        Ok(1e-6 * by_speed / millimetres.sqrt())
    }
}
