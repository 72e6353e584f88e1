//! Random roughness of a given autocorrelation by filtering white noise.

use super::random::RandomSurface;
use super::roughness_spec::RoughnessSpec;
use crate::error::InputError;
use crate::grid::Grid;

/// A periodic random surface \[m\] on `grid`, with zero mean and root mean square height exactly `rq`.
///
/// White noise (`ChaCha8`, normal deviates, in field order) is convolved with a filter whose spectrum is the square root
/// of the transform of the periodic autocorrelation; small negative values of that transform, from wrapping, are set
/// to zero. Opposite edges match, so the surface may be shifted periodically ([`super::RoughnessMotion`]). Equal seeds
/// give equal surfaces: exactly on one processor with any number of threads, to about 1e-9 of `rq` on others, whose
/// transforms round differently.
///
/// Source: Hu, Y. Z. and Tonder, K. (1992), International Journal of Machine Tools and Manufacture 32, 83-90.
///
/// # Errors
/// See [`RoughnessSpec::validate`]; `rq` above zero on a grid of a single node.
///
/// ```
/// use stribeck::{Grid, metrics::height_statistics};
/// use stribeck::surface::{Autocorrelation, RoughnessSpec, generate};
/// let grid = Grid::centred(64, 64, 4e-6, 4e-6)?;
/// let spec = RoughnessSpec {
///     autocorrelation: Autocorrelation::Gaussian,
///     rq: 130e-9,
///     length_x: 20e-6,
///     length_y: 20e-6,
///     seed: 1,
/// };
/// let surface = generate(&grid, &spec)?;
/// assert!((height_statistics(&surface)?.sq / 130e-9 - 1.0).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn generate(grid: &Grid, spec: &RoughnessSpec) -> Result<Vec<f64>, InputError> {
    RandomSurface::from(*spec).generate(grid)
}
