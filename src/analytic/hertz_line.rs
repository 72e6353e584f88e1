//! Hertz contact of two parallel cylinders.

use std::f64::consts::PI;

use crate::error::InputError;

/// A dry, smooth, frictionless line contact of bodies whose gap is `x^2/(2 R)`, plane strain.
///
/// Pressure `p = pressure sqrt(1 - (x/a)^2)`, with the load per length `w` \[N/m\]:
/// `a^2 = 8 w R/(pi E')`, `pressure = 2 w/(pi a) = a E'/(4 R)`. For two cylinders `1/R = 1/R1 + 1/R2`.
///
/// Source: Hertz, H. (1882), Journal fuer die reine und angewandte Mathematik 92, 156-171; Johnson, K. L.
/// (1985), Contact Mechanics, section 4.2.
///
/// ```
/// use stribeck::analytic::HertzLine;
/// let roller = HertzLine::from_load(10e-3, 230e9, 1e5)?;
/// assert!((roller.half_width - 105.2e-6).abs() < 0.1e-6);
/// assert!((roller.pressure - 605.1e6).abs() < 0.1e6);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct HertzLine {
    /// Radius of curvature \[m\].
    pub radius: f64,
    /// Equivalent modulus `E'` \[Pa\].
    pub equivalent_modulus: f64,
    /// Load per length \[N/m\].
    pub force: f64,
    /// Maximum pressure \[Pa\].
    pub pressure: f64,
    /// Half-width `a` of the contact \[m\].
    pub half_width: f64,
}

impl HertzLine {
    /// Contact of radius `radius` \[m\] and equivalent modulus `E'` \[Pa\] under `load` per length \[N/m\].
    ///
    /// # Errors
    /// An argument that is not finite and positive, or a result that overflows.
    ///
    /// ```
    /// use stribeck::analytic::HertzLine;
    /// let contact = HertzLine::from_load(10e-3, 230e9, 2e5)?;
    /// assert!((contact.pressure / (contact.half_width * 230e9 / 40e-3) - 1.0).abs() < 1e-14);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn from_load(radius: f64, equivalent_modulus: f64, load: f64) -> Result<Self, InputError> {
        InputError::require_positive("radius", radius)?;
        InputError::require_positive("equivalent_modulus", equivalent_modulus)?;
        InputError::require_positive("load", load)?;
        Self::of(radius, equivalent_modulus, (8.0 * load / (PI * equivalent_modulus) * radius).sqrt())
    }

    /// Contact of radius `radius` \[m\] and equivalent modulus `E'` \[Pa\] whose maximum pressure is
    /// `max_pressure` \[Pa\].
    ///
    /// # Errors
    /// As [`HertzLine::from_load`].
    ///
    /// ```
    /// use stribeck::analytic::HertzLine;
    /// let contact = HertzLine::from_max_pressure(10e-3, 230e9, 1e9)?;
    /// let same = HertzLine::from_load(10e-3, 230e9, contact.force)?;
    /// assert!((same.pressure / 1e9 - 1.0).abs() < 1e-14);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn from_max_pressure(
        radius: f64,
        equivalent_modulus: f64,
        max_pressure: f64,
    ) -> Result<Self, InputError> {
        InputError::require_positive("radius", radius)?;
        InputError::require_positive("equivalent_modulus", equivalent_modulus)?;
        InputError::require_positive("max_pressure", max_pressure)?;
        Self::of(radius, equivalent_modulus, 4.0 * radius * (max_pressure / equivalent_modulus))
    }

    /// The contact of half-width `half_width`.
    fn of(radius: f64, equivalent_modulus: f64, half_width: f64) -> Result<Self, InputError> {
        let pressure = half_width / radius * equivalent_modulus / 4.0;
        let load = 0.5 * PI * half_width * pressure;
        for (field, value) in [("contact half-width", half_width), ("max_pressure", pressure), ("load", load)]
        {
            InputError::require_positive(field, value)?;
        }
        Ok(Self { radius, equivalent_modulus, force: load, pressure, half_width })
    }

    /// Pressure \[Pa\] at the distance `x` \[m\] from the center; zero outside the contact.
    ///
    /// ```
    /// use stribeck::analytic::HertzLine;
    /// let contact = HertzLine::from_max_pressure(10e-3, 230e9, 1e9)?;
    /// assert!((contact.pressure_at(0.6 * contact.half_width) / 0.8e9 - 1.0).abs() < 1e-14);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    #[must_use]
    pub fn pressure_at(&self, x: f64) -> f64 {
        self.pressure * (1.0 - (x / self.half_width).powi(2)).max(0.0).sqrt()
    }

    /// Approach \[m\] of the two bodies, relative to the distance `reference` \[m\] as in
    /// [`strip_potential`](super::strip_potential): `4 w/(pi E') (ln(2 reference/a) + 1/2)`.
    ///
    /// # Errors
    /// A reference that is not finite and positive.
    ///
    /// ```
    /// use stribeck::analytic::HertzLine;
    /// let contact = HertzLine::from_load(10e-3, 230e9, 1e5)?;
    /// assert!((contact.approach(10e-3)? - 3.182e-6).abs() < 0.001e-6);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn approach(&self, reference: f64) -> Result<f64, InputError> {
        InputError::require_positive("reference", reference)?;
        let logarithm = (2.0 * reference / self.half_width).ln();
        Ok(4.0 * self.force / (PI * self.equivalent_modulus) * (logarithm + 0.5))
    }
}
