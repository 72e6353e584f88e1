//! Lateral shapes of random surfaces.

use super::autocorrelation::Autocorrelation;
use super::self_affine::SelfAffine;

/// Lateral shape of a random surface.
///
/// # Examples
///
/// ```
/// use stribeck::surface::{Autocorrelation, RandomShape, RandomSurface};
/// use stribeck::{Grid, metrics::height_statistics};
/// // A ground surface: scratches along x, five times as long as wide.
/// let ground = RandomShape::Correlated {
///     autocorrelation: Autocorrelation::Exponential,
///     length_x: 100e-6,
///     length_y: 20e-6,
/// };
/// let grid = Grid::centred(128, 128, 2e-6, 2e-6)?;
/// let heights = RandomSurface::new(ground, 200e-9, 3).generate(&grid)?;
/// assert!((height_statistics(&heights)?.sq / 200e-9 - 1.0).abs() < 1e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum RandomShape {
    /// White noise filtered to an autocorrelation function (Hu and Tonder 1992).
    Correlated {
        /// Shape of the autocorrelation function.
        autocorrelation: Autocorrelation,
        /// Length along x at which the autocorrelation is 10 % \[m\], at most the size of the grid.
        length_x: f64,
        /// Length along y at which the autocorrelation is 10 % \[m\].
        length_y: f64,
    },
    /// Self-affine between two wavelengths.
    SelfAffine(SelfAffine),
}
