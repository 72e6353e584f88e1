//! Duty factor of a track.

use crate::error::InputError;

/// Fraction of the time that a point on a circular track of radius `track_radius` \[m\] spends in a contact of half-width
/// `half_width` \[m\], `2 a / (2 pi r)`, at most 1.
///
/// Wear coefficients fitted as if the contact were permanent already contain it.
///
/// # Errors
/// A length that is not finite and positive.
///
/// ```
/// let share = stribeck::wear::track_duty_factor(149.83e-6, 23e-3)?;
/// assert!((share - 0.00207).abs() < 1e-5);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn track_duty_factor(half_width: f64, track_radius: f64) -> Result<f64, InputError> {
    InputError::require_positive("half_width", half_width)?;
    InputError::require_positive("track_radius", track_radius)?;
    Ok((half_width / (std::f64::consts::PI * track_radius)).min(1.0))
}
