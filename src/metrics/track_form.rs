//! Roughness on a track: heights without the groove that rubbing makes.

use crate::error::InputError;

/// Heights \[m\] of a surface of rows of `nx` nodes along the track without the form of the track, which is the mean of each row.
///
/// A groove is the same all along the track, so that the mean along it takes the groove away whatever its profile is. It takes
/// roughness away that is as long as the patch too: of isotropic roughness with the correlation length `b` in a patch of length
/// `L` a share of the order of `b/L` of the square of Rq.
///
/// ```
/// let heights = stribeck::metrics::without_track_form(&[1.0, 3.0, -5.0, -7.0], 2);
/// assert_eq!(heights, [-1.0, 1.0, 1.0, -1.0]);
/// ```
#[must_use]
pub fn without_track_form(heights: &[f64], nx: usize) -> Vec<f64> {
    let mut out = heights.to_vec();
    for row in out.chunks_mut(nx.max(1)) {
        let mean = row.iter().sum::<f64>() / row.len() as f64;
        row.iter_mut().for_each(|z| *z -= mean);
    }
    out
}

/// Root mean square height \[m\] of [`without_track_form`], without a copy of the field.
///
/// # Errors
/// No heights, one that is not finite, rows that do not fill up.
///
/// ```
/// assert_eq!(stribeck::metrics::track_rq(&[1.0, 3.0, -5.0, -7.0], 2)?, 1.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn track_rq(heights: &[f64], nx: usize) -> Result<f64, InputError> {
    let rows = heights.len().checked_div(nx).unwrap_or(0);
    InputError::require_len("heights", heights, rows.max(1) * nx)?;
    InputError::require_positive("number of heights", heights.len() as f64)?;
    InputError::require_finite("heights", heights)?;
    let mut square = 0.0;
    for row in heights.chunks_exact(nx) {
        let mean = row.iter().sum::<f64>() / nx as f64;
        square += row.iter().map(|z| (z - mean).powi(2)).sum::<f64>();
    }
    Ok((square / heights.len() as f64).sqrt())
}
