//! A random surface by its autocorrelation.

use super::autocorrelation::Autocorrelation;
use crate::error::InputError;
use crate::grid::Grid;

/// A random rough surface with normally distributed heights.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::surface::{Autocorrelation, RoughnessSpec};
/// let (autocorrelation, rq) = (Autocorrelation::Gaussian, 1e-7);
/// let spec = RoughnessSpec { autocorrelation, rq, length_x: 2e-5, length_y: 1e-3, seed: 1 };
/// let error = spec.validate(&Grid::centred(64, 64, 1e-6, 1e-6)?).unwrap_err();
/// assert!(error.to_string().starts_with("roughness.length_y"));
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughnessSpec {
    /// Shape of the autocorrelation function.
    pub autocorrelation: Autocorrelation,
    /// Root mean square height \[m\]; 0 for a smooth surface.
    pub rq: f64,
    /// Length along x at which the autocorrelation is 10 % \[m\], at most the size of the grid.
    ///
    /// For lengths much smaller than the spacing the surface is white noise.
    pub length_x: f64,
    /// Length along y at which the autocorrelation is 10 % \[m\].
    pub length_y: f64,
    /// Seed: equal seeds give equal surfaces.
    pub seed: u64,
}

impl RoughnessSpec {
    /// Checks the fields for a grid.
    ///
    /// # Errors
    /// A negative `rq`, a length that is not positive or exceeds the size of the grid, a value that is not
    /// finite.
    pub fn validate(&self, grid: &Grid) -> Result<(), InputError> {
        InputError::require_non_negative("roughness.rq", self.rq)?;
        let lengths = [
            ("roughness.length_x", self.length_x, grid.size_x()),
            ("roughness.length_y", self.length_y, grid.size_y()),
        ];
        for (field, length, size) in lengths {
            InputError::require_positive(field, length)?;
            let fits = length <= size * (1.0 + 1e-9);
            InputError::require(fits, field, length, "at most the size of the grid in that direction")?;
        }
        Ok(())
    }
}
