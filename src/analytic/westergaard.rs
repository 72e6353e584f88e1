//! Dry contact of a sinusoidal surface with a flat one.

use std::f64::consts::PI;

use crate::error::InputError;

/// A surface `z = amplitude cos(2 pi x/wavelength)` pressed without friction against a flat one, plane
/// strain.
///
/// Contact is complete at the mean pressure `p* = pi E' A/(2 wavelength)`, which is `pi E* A/wavelength` with
/// the contact modulus `E* = E'/2` (the literature's usual symbol) and `A` the amplitude, half the height
/// from valley to crest. Below it, strips of half-width `c` touch at the crests,
/// `p/p* = sin^2(pi c/wavelength)`.
///
/// Source: Westergaard, H. M. (1939), Journal of Applied Mechanics 6, A49-A53; Johnson, K. L. (1985), Contact
/// Mechanics, chapter 13.
///
/// ```
/// use stribeck::analytic::Westergaard;
/// let wave = Westergaard { amplitude: 0.1e-6, wavelength: 20e-6, equivalent_modulus: 230e9 };
/// let half = 0.5 * wave.full_contact_pressure()?;
/// assert!((wave.contact_half_width(half)? - 5e-6).abs() < 1e-18);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Westergaard {
    /// Amplitude, half the height from valley to crest \[m\].
    pub amplitude: f64,
    /// Wavelength \[m\].
    pub wavelength: f64,
    /// Equivalent modulus `E'` \[Pa\], `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`.
    pub equivalent_modulus: f64,
}

impl Westergaard {
    /// Checks every field.
    ///
    /// # Errors
    /// [`InputError::Value`] naming the first field that is not finite and positive.
    pub fn validate(&self) -> Result<(), InputError> {
        InputError::require_positive("amplitude", self.amplitude)?;
        InputError::require_positive("wavelength", self.wavelength)?;
        InputError::require_positive("equivalent_modulus", self.equivalent_modulus)
    }

    /// Mean pressure `p*` \[Pa\] of complete contact.
    ///
    /// # Errors
    /// See [`Westergaard::validate`].
    ///
    /// ```
    /// # use stribeck::analytic::Westergaard;
    /// let wave = Westergaard { amplitude: 1e-6, wavelength: 100e-6, equivalent_modulus: 200e9 };
    /// assert!((wave.full_contact_pressure()? - std::f64::consts::PI * 1e9).abs() < 1.0);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn full_contact_pressure(&self) -> Result<f64, InputError> {
        self.validate()?;
        Ok(0.5 * PI * self.equivalent_modulus * self.amplitude / self.wavelength)
    }

    /// Half-width of a contact strip \[m\] under `mean_pressure` \[Pa\]; half of the wavelength for complete
    /// contact.
    ///
    /// # Errors
    /// See [`Westergaard::validate`]; a mean pressure that is negative or not finite.
    ///
    /// ```
    /// # use stribeck::analytic::Westergaard;
    /// let wave = Westergaard { amplitude: 1e-6, wavelength: 100e-6, equivalent_modulus: 200e9 };
    /// assert!((wave.contact_half_width(1e12)? - 50e-6).abs() < 1e-18);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn contact_half_width(&self, mean_pressure: f64) -> Result<f64, InputError> {
        let ratio = self.pressure_ratio(mean_pressure)?;
        Ok(self.wavelength / PI * ratio.min(1.0).sqrt().asin())
    }

    /// Mean gap \[m\] under `mean_pressure` \[Pa\], `A (1 - r + r ln r)` with `r = p/p*`; zero for complete contact. Its
    /// derivative is that of strip punches at the crests, `d(gap)/dp = 2 wavelength/(pi E') ln(p/p*)`.
    ///
    /// # Errors
    /// See [`Westergaard::contact_half_width`].
    ///
    /// ```
    /// # use stribeck::analytic::Westergaard;
    /// let wave = Westergaard { amplitude: 1e-6, wavelength: 100e-6, equivalent_modulus: 200e9 };
    /// let half = 0.5 * wave.full_contact_pressure()?;
    /// assert!((wave.mean_gap(half)? / 0.15343e-6 - 1.0).abs() < 1e-4);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn mean_gap(&self, mean_pressure: f64) -> Result<f64, InputError> {
        let ratio = self.pressure_ratio(mean_pressure)?;
        let share = if ratio >= 1.0 || ratio == 0.0 { 0.0 } else { ratio * ratio.ln() };
        Ok(self.amplitude * (1.0 - ratio.min(1.0) + share))
    }

    /// Pressure \[Pa\] at the distance `x` \[m\] from a crest under `mean_pressure` \[Pa\]:
    /// `p(x) = 2 p_mean cos(t)/sin^2(t_c) sqrt(sin^2(t_c) - sin^2(t))` with `t = pi x/wavelength`,
    /// `t_c = pi c/wavelength`; with complete contact `p(x) = p_mean + p* cos(2 t)`.
    ///
    /// # Errors
    /// See [`Westergaard::contact_half_width`]; an `x` that is not finite.
    ///
    /// ```
    /// # use stribeck::analytic::Westergaard;
    /// let wave = Westergaard { amplitude: 1e-6, wavelength: 100e-6, equivalent_modulus: 200e9 };
    /// let full = wave.full_contact_pressure()?;
    /// assert!((wave.pressure_at(0.0, full)? / (2.0 * full) - 1.0).abs() < 1e-14);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn pressure_at(&self, x: f64, mean_pressure: f64) -> Result<f64, InputError> {
        let ratio = self.pressure_ratio(mean_pressure)?;
        InputError::require(x.is_finite(), "x", x, "finite")?;
        let angle = PI * (x / self.wavelength - (x / self.wavelength).round());
        if ratio >= 1.0 {
            return Ok(mean_pressure * (1.0 + (2.0 * angle).cos() / ratio));
        }
        let inside = ratio - angle.sin().powi(2);
        if inside <= 0.0 {
            return Ok(0.0);
        }
        Ok(2.0 * mean_pressure * angle.cos() * inside.sqrt() / ratio)
    }

    fn pressure_ratio(&self, mean_pressure: f64) -> Result<f64, InputError> {
        InputError::require_non_negative("mean_pressure", mean_pressure)?;
        Ok(mean_pressure / self.full_contact_pressure()?)
    }
}
