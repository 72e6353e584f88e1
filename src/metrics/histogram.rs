//! Distribution of heights.

use super::roughness::require_heights;
use crate::error::InputError;

/// Probability density of heights in classes of equal width.
///
/// # Examples
///
/// ```
/// use stribeck::metrics::height_histogram;
/// let steps = [0.0, 0.0, 0.0, 1e-6];
/// assert!(height_histogram(&steps, 2).is_ok());
/// assert!(height_histogram(&steps, 0).is_err()); // no classes
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct HeightHistogram {
    /// Lower edge of the first class \[m\].
    pub lowest: f64,
    /// Width of a class \[m\].
    pub width: f64,
    /// Density of each class \[1/m\]; the sum times the width is 1.
    pub density: Vec<f64>,
}

/// Histogram of `heights` \[m\] in `classes` classes from the lowest to the highest.
///
/// # Errors
/// No heights, a height that is not finite, equal heights, no classes or more than 2^20.
///
/// ```
/// let histogram = stribeck::metrics::height_histogram(&[0.0, 1.0, 1.5, 4.0], 2)?;
/// assert_eq!((histogram.width, histogram.density), (2.0, vec![0.375, 0.125]));
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn height_histogram(heights: &[f64], classes: usize) -> Result<HeightHistogram, InputError> {
    require_heights(heights)?;
    let range = "between 1 and 2^20 (a million)";
    InputError::require((1..=1 << 20).contains(&classes), "classes", classes as f64, range)?;
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let width = (highest - lowest) / classes as f64;
    if !(width > 0.0 && width.is_finite()) {
        return Err(InputError::Conflict {
            field: "heights".to_owned(),
            reason: "equal heights have no distribution".to_owned(),
        });
    }
    let mut density = vec![0.0; classes];
    let share = 1.0 / (heights.len() as f64 * width);
    for height in heights {
        density[(((height - lowest) / width) as usize).min(classes - 1)] += share;
    }
    Ok(HeightHistogram { lowest, width, density })
}
