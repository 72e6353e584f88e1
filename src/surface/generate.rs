//! Random roughness of a given autocorrelation by filtering white noise.

use super::random::RandomSurface;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::map_lines;

/// Shape of the autocorrelation function, with `s^2 = (x/length_x)^2 + (y/length_y)^2`.
///
/// The lengths are those at which the function is 10 %, hence the factor `ln 10` (2.3 in the literature).
///
/// # Examples
///
/// ```
/// use stribeck::metrics::hybrid_parameters;
/// use stribeck::Grid;
/// use stribeck::surface::{Autocorrelation, RoughnessSpec, generate};
/// let grid = Grid::centred(128, 128, 1e-6, 1e-6)?;
/// let slope = |autocorrelation| -> Result<f64, stribeck::InputError> {
///     let spec = RoughnessSpec { autocorrelation, rq: 1e-7, length_x: 2e-5, length_y: 2e-5, seed: 1 };
///     Ok(hybrid_parameters(&grid, &generate(&grid, &spec)?, None)?.sdq)
/// };
/// assert!(slope(Autocorrelation::Exponential)? > 1.5 * slope(Autocorrelation::Gaussian)?);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Autocorrelation {
    /// `Rq^2 exp(-ln(10) s^2)`: smooth slopes; contact results converge with the mesh.
    #[default]
    Gaussian,
    /// `Rq^2 exp(-ln(10) s)`: ground surfaces, rough at all scales; slopes and peak pressures grow without bound under
    /// mesh refinement.
    Exponential,
}

impl Autocorrelation {
    /// The function of `s^2`.
    pub(super) fn at(self, squared: f64) -> f64 {
        let exponent = match self {
            Self::Gaussian => squared,
            Self::Exponential => squared.sqrt(),
        };
        (-std::f64::consts::LN_10 * exponent).exp()
    }

    /// Values at lags of 0 to `nx / 2` by 0 to `ny / 2` nodes, the shortest periodic distances from node 0.
    pub(super) fn quarter(self, grid: &Grid, [length_x, length_y]: [f64; 2]) -> Vec<f64> {
        let width = grid.nx() / 2 + 1;
        let mut quarter = vec![0.0; width * (grid.ny() / 2 + 1)];
        map_lines(&mut quarter, width, |j, row| {
            let y = j as f64 * grid.dy() / length_y;
            for (i, value) in row.iter_mut().enumerate() {
                let x = i as f64 * grid.dx() / length_x;
                *value = self.at(x * x + y * y);
            }
        });
        quarter
    }
}

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
