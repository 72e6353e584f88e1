//! Random roughness of a given autocorrelation by filtering white noise.

use num_complex::Complex64;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rustfft::FftDirection;

use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::Fft2;

/// Shape of the autocorrelation function, with `s^2 = (x/length_x)^2 + (y/length_y)^2`.
///
/// The lengths are where the function has fallen to 10 %, hence the factor `ln 10` (2.3 in the literature).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Autocorrelation {
    /// `Rq^2 exp(-ln(10) s^2)`: smooth slopes; contact results converge with the mesh.
    #[default]
    Gaussian,
    /// `Rq^2 exp(-ln(10) s)`: ground surfaces, rough at every scale; slopes and peak pressures grow without bound
    /// as the mesh is refined.
    Exponential,
}

impl Autocorrelation {
    fn at(self, squared: f64) -> f64 {
        let exponent = match self {
            Self::Gaussian => squared,
            Self::Exponential => squared.sqrt(),
        };
        (-std::f64::consts::LN_10 * exponent).exp()
    }
}

/// A random rough surface with normally distributed heights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughnessSpec {
    /// Shape of the autocorrelation function.
    pub autocorrelation: Autocorrelation,
    /// Root mean square height \[m\]; 0 for a smooth surface.
    pub rq: f64,
    /// Length along x at which the autocorrelation is 10 % \[m\], at most the size of the grid.
    ///
    /// Far below the spacing the surface is white noise.
    pub length_x: f64,
    /// The same along y \[m\].
    pub length_y: f64,
    /// Seed: equal seeds give equal surfaces.
    pub seed: u64,
}

impl RoughnessSpec {
    /// Checks the fields against the grid that they are meant for.
    ///
    /// # Errors
    /// A negative `rq`, a length that is not positive or exceeds the size of the grid, a value that is not finite.
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
/// White noise (`ChaCha8`, normal deviates, in the order of the field) is convolved with the filter whose spectrum
/// is the root of the transform of the periodic autocorrelation; small negative parts of that transform, which
/// wrapping can leave, are cut. Opposite edges fit together, so the surface may be shifted around
/// ([`super::RoughnessMotion`]). The same seed gives the same surface everywhere, to the rounding of the transforms.
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
    spec.validate(grid)?;
    if spec.rq == 0.0 {
        return Ok(vec![0.0; grid.len()]);
    }
    let mut transform = Fft2::new(grid.nx(), grid.ny());
    let mut field = white_noise(grid.len(), spec.seed);
    transform.process(&mut field, FftDirection::Forward);
    let mut filter = autocorrelation_field(grid, spec);
    transform.process(&mut filter, FftDirection::Forward);
    for (value, density) in field.iter_mut().zip(&filter) {
        *value *= density.re.max(0.0).sqrt();
    }
    if let Some(mean) = field.first_mut() {
        *mean = Complex64::default();
    }
    transform.process(&mut field, FftDirection::Inverse);
    let mut heights: Vec<f64> = field.into_iter().map(|value| value.re).collect();
    rescale(&mut heights, spec.rq)?;
    Ok(heights)
}

fn white_noise(count: usize, seed: u64) -> Vec<Complex64> {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let mut generator = ChaCha8Rng::from_seed(bytes);
    (0..count).map(|_| Complex64::new(StandardNormal.sample(&mut generator), 0.0)).collect()
}

/// The autocorrelation at the shortest periodic distances from node 0.
fn autocorrelation_field(grid: &Grid, spec: &RoughnessSpec) -> Vec<Complex64> {
    let (nx, ny) = (grid.nx(), grid.ny());
    let mut field = Vec::with_capacity(grid.len());
    for j in 0..ny {
        let y = j.min(ny - j) as f64 * grid.dy() / spec.length_y;
        for i in 0..nx {
            let x = i.min(nx - i) as f64 * grid.dx() / spec.length_x;
            field.push(Complex64::new(spec.autocorrelation.at(x * x + y * y), 0.0));
        }
    }
    field
}

/// Removes the mean and scales to the root mean square `rq`.
fn rescale(heights: &mut [f64], rq: f64) -> Result<(), InputError> {
    let count = heights.len() as f64;
    let mean = heights.iter().sum::<f64>() / count;
    heights.iter_mut().for_each(|h| *h -= mean);
    let square = heights.iter().map(|h| h * h).sum::<f64>() / count;
    let factor = rq / square.sqrt();
    if !factor.is_finite() {
        return Err(InputError::Conflict {
            field: "roughness.rq".to_owned(),
            reason: "the grid has too few nodes for a rough surface".to_owned(),
        });
    }
    heights.iter_mut().for_each(|h| *h *= factor);
    Ok(())
}
