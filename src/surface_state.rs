//! The state of a surface node during a step: the input of film growth and wear laws.
//!
//! States are computed for every node and step from the solved contact. A new quantity for laws is a field here and a
//! line where `sim` sets it.

use crate::with_fields::with_fields;

/// The state of a surface node during a step in SI units, as input of laws.
///
/// # Examples
///
/// ```
/// use stribeck::SurfaceState;
/// let fluid = SurfaceState::new(5e8, 353.15);
/// assert!(!fluid.in_contact && fluid.solid_pressure == 0.0);
/// let solid = fluid.with_solid_pressure(5e8).with_shear_stress(5.75e7).with_in_contact(true);
/// assert!((solid.shear_stress / solid.solid_pressure - 0.115).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SurfaceState {
    /// Total pressure, fluid and solid \[Pa\].
    pub pressure: f64,
    /// Pressure of solid contact \[Pa\].
    pub solid_pressure: f64,
    /// Shear stress on the surface \[Pa\].
    pub shear_stress: f64,
    /// Surface temperature, bulk plus flash \[K\].
    pub temperature: f64,
    /// Sliding speed, non-negative \[m/s\].
    pub sliding_speed: f64,
    /// Gap between the surfaces \[m\].
    pub gap: f64,
    /// Whether the node counts as solid contact.
    pub in_contact: bool,
}

with_fields!(SurfaceState {
    with_pressure pressure: f64,
    with_solid_pressure solid_pressure: f64,
    with_shear_stress shear_stress: f64,
    with_temperature temperature: f64,
    with_sliding_speed sliding_speed: f64,
    with_gap gap: f64,
    with_in_contact in_contact: bool,
});

impl SurfaceState {
    /// A node under the fluid pressure `pressure` \[Pa\] at `temperature` \[K\], without solid contact, film
    /// or sliding.
    pub const fn new(pressure: f64, temperature: f64) -> Self {
        Self {
            pressure,
            solid_pressure: 0.0,
            shear_stress: 0.0,
            temperature,
            sliding_speed: 0.0,
            gap: 0.0,
            in_contact: false,
        }
    }

    /// Linear interpolation from this node to `other` at the fraction `share`; the nearer one determines
    /// contact.
    pub(crate) fn towards(&self, other: &Self, share: f64) -> Self {
        let mix = |here: f64, there: f64| here + share * (there - here);
        Self {
            pressure: mix(self.pressure, other.pressure),
            solid_pressure: mix(self.solid_pressure, other.solid_pressure),
            shear_stress: mix(self.shear_stress, other.shear_stress),
            temperature: mix(self.temperature, other.temperature),
            sliding_speed: mix(self.sliding_speed, other.sliding_speed),
            gap: mix(self.gap, other.gap),
            in_contact: if share < 0.5 { self.in_contact } else { other.in_contact },
        }
    }
}
