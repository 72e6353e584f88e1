//! Random surfaces: a shape across the plane, a distribution and a scale of heights.

use num_complex::Complex64;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use super::generate::{Autocorrelation, RoughnessSpec, autocorrelation_quarter};
use super::johnson::Johnson;
use super::self_affine::{SelfAffine, Synthesis};
use crate::boundary::Boundary;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{RealFft2, fast_length};

/// What the root mean square height of a random surface refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HeightScale {
    /// Each surface has exactly that height: what the standard parameters of one surface call for. Removes the mean.
    #[default]
    Exact,
    /// The mean square over all seeds has it, as of patches of one large surface; single surfaces scatter about it.
    Ensemble,
}

/// What a random surface looks like across the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RandomShape {
    /// White noise filtered to an autocorrelation function (Hu and Tonder 1992).
    Correlated {
        /// Shape of the autocorrelation function.
        autocorrelation: Autocorrelation,
        /// Length along x at which the autocorrelation is 10 % \[m\], at most the size of the grid.
        length_x: f64,
        /// The same along y \[m\].
        length_y: f64,
    },
    /// Self-affine between two wavelengths.
    SelfAffine(SelfAffine),
}

/// Distribution of the heights.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum HeightDistribution {
    /// Normal: skewness 0, kurtosis 3.
    #[default]
    Normal,
    /// The member of the Johnson system with these moments.
    Johnson {
        /// Skewness Ssk, between -5 and 5; negative for plateaus with valleys.
        skewness: f64,
        /// Kurtosis Sku, from `skewness^2 + 1.2` to 100.
        kurtosis: f64,
    },
}

/// A random surface: shape across the plane, distribution and scale of heights, seed.
///
/// ```
/// use stribeck::{Grid, metrics::height_statistics};
/// use stribeck::surface::{HeightDistribution, RandomShape, RandomSurface, SelfAffine, Synthesis};
/// let grid = Grid::centred(128, 128, 1e-6, 1e-6)?;
/// let fractal = SelfAffine {
///     hurst: 0.8,
///     longest: f64::INFINITY,
///     roll_off: 40e-6,
///     shortest: 4e-6,
///     synthesis: Synthesis::RandomPhase,
/// };
/// let surface = RandomSurface {
///     distribution: HeightDistribution::Johnson { skewness: -1.0, kurtosis: 5.0 },
///     ..RandomSurface::new(RandomShape::SelfAffine(fractal), 100e-9, 7)
/// };
/// let statistics = height_statistics(&surface.generate(&grid)?)?;
/// assert!((statistics.sq / 100e-9 - 1.0).abs() < 1e-12 && statistics.ssk < -0.5);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RandomSurface {
    /// Shape across the plane.
    pub shape: RandomShape,
    /// Root mean square height \[m\]; 0 for a smooth surface.
    pub rq: f64,
    /// Seed: equal seeds give equal surfaces.
    pub seed: u64,
    /// What `rq` refers to.
    pub height: HeightScale,
    /// Distribution of the heights.
    pub distribution: HeightDistribution,
    /// Whether opposite edges fit together. An open surface is cut out of a larger periodic one.
    pub boundary: Boundary,
}

impl From<RoughnessSpec> for RandomSurface {
    fn from(spec: RoughnessSpec) -> Self {
        let RoughnessSpec { autocorrelation, rq, length_x, length_y, seed } = spec;
        Self::new(RandomShape::Correlated { autocorrelation, length_x, length_y }, rq, seed)
    }
}

impl RandomSurface {
    /// Normal heights of exactly the root mean square height `rq` \[m\], periodic.
    #[must_use]
    pub fn new(shape: RandomShape, rq: f64, seed: u64) -> Self {
        let (height, distribution, boundary) = Default::default();
        Self { shape, rq, seed, height, distribution, boundary }
    }

    /// The surface on `grid` \[m\]. Of a periodic one no part of its spectrum is constant, so its mean is zero.
    ///
    /// Heights of a Johnson distribution are turned out of normal ones node by node; the normal ones have the autocorrelation
    /// that leads to the one asked for (a translation process). Skewness and kurtosis are met by the mean over seeds; a
    /// single surface scatters about them with the number of correlation lengths that it holds.
    ///
    /// Sources: Hu, Y. Z. and Tonder, K. (1992), International Journal of Machine Tools and Manufacture 32, 83-90; Johnson,
    /// N. L. (1949), Biometrika 36, 149-176.
    ///
    /// # Errors
    /// A negative `rq`, lengths that are not positive or exceed the grid, a Hurst exponent or cut-offs out of order, a pair of
    /// skewness and kurtosis that does not exist (the range is named), a grid with too few nodes.
    pub fn generate(&self, grid: &Grid) -> Result<Vec<f64>, InputError> {
        self.shape.validate(self.rq, self.seed, grid)?;
        let johnson = match self.distribution {
            HeightDistribution::Normal => None,
            HeightDistribution::Johnson { skewness, kurtosis } => Some(Johnson::new(skewness, kurtosis)?),
        };
        if self.rq == 0.0 {
            return Ok(vec![0.0; grid.len()]);
        }
        let period = match self.boundary {
            Boundary::Periodic => *grid,
            Boundary::Open => self.shape.period(grid)?,
        };
        let mut transform = RealFft2::new(period.nx(), period.ny());
        let mut density = self.shape.density(&period, &mut transform);
        if let Some(johnson) = &johnson {
            density = corrected(&density, &johnson.correlations(), &mut transform);
        }
        let mut field = white_noise(period.len(), self.seed);
        let power = self.impose(&density, &mut field, &mut transform);
        let mut heights = cut(field, &period, grid);
        // standard deviation over all seeds of what the transforms leave unnormalised
        let deviation = (power * period.len() as f64).sqrt();
        if let Some(johnson) = &johnson {
            heights.iter_mut().for_each(|z| *z = johnson.at(*z / deviation));
        }
        match (self.height, johnson) {
            (HeightScale::Exact, _) => rescale(&mut heights, self.rq)?,
            (HeightScale::Ensemble, Some(_)) => heights.iter_mut().for_each(|z| *z *= self.rq),
            (HeightScale::Ensemble, None) => {
                require_scale(self.rq / deviation)?;
                heights.iter_mut().for_each(|z| *z *= self.rq / deviation);
            }
        }
        Ok(heights)
    }

    /// Gives noise the density (a quarter of the waves, the others mirror it) and returns the sum of the density, its mean
    /// left out.
    fn impose(&self, density: &[f64], field: &mut [f64], transform: &mut RealFft2) -> f64 {
        let phase_only = match self.shape {
            RandomShape::SelfAffine(SelfAffine { synthesis: Synthesis::RandomPhase, .. }) => {
                Some((field.len() as f64).sqrt())
            }
            _ => None,
        };
        let mut power = 0.0;
        transform.filter(field, |wave, waves, value| {
            if wave == 0 {
                *value = Complex64::default();
                return;
            }
            let density = density[wave].max(0.0);
            power += waves * density;
            if let Some(amplitude) = phase_only {
                let size = value.norm();
                *value =
                    if size > 0.0 { *value * (amplitude / size) } else { Complex64::new(amplitude, 0.0) };
            }
            *value *= density.sqrt();
        });
        power
    }
}

impl RandomShape {
    fn validate(&self, rq: f64, seed: u64, grid: &Grid) -> Result<(), InputError> {
        match *self {
            Self::Correlated { autocorrelation, length_x, length_y } => {
                RoughnessSpec { autocorrelation, rq, length_x, length_y, seed }.validate(grid)
            }
            Self::SelfAffine(spectrum) => {
                InputError::require_non_negative("roughness.rq", rq)?;
                spectrum.validate()
            }
        }
    }

    /// A grid so much larger than `grid` that the edges of a part of its size do not know each other.
    fn period(&self, grid: &Grid) -> Result<Grid, InputError> {
        let margins = match *self {
            Self::Correlated { length_x, length_y, .. } => [2.0 * length_x, 2.0 * length_y],
            Self::SelfAffine(_) => [grid.size_x(), grid.size_y()],
        };
        let longer = |n: usize, d: f64, margin: f64| {
            if n == 1 { 1 } else { fast_length(n + (margin / d) as usize + 1) }
        };
        let (nx, ny) = (longer(grid.nx(), grid.dx(), margins[0]), longer(grid.ny(), grid.dy(), margins[1]));
        Grid::centred(nx, ny, grid.dx(), grid.dy())
    }

    /// Density of 0 to `nx / 2` by 0 to `ny / 2` waves; small negative values, which rounding and wrapping leave, count as zero.
    fn density(&self, grid: &Grid, transform: &mut RealFft2) -> Vec<f64> {
        match *self {
            Self::Correlated { autocorrelation, length_x, length_y } => {
                let quarter = autocorrelation_quarter(grid, autocorrelation, [length_x, length_y]);
                transform.symmetric(&quarter)
            }
            Self::SelfAffine(spectrum) => spectrum.density_quarter(grid),
        }
    }
}

/// The density that normal deviates need so that the curve of the table gives them the present one.
fn corrected(density: &[f64], table: &[(f64, f64)], transform: &mut RealFft2) -> Vec<f64> {
    let density: Vec<f64> = density.iter().map(|value| value.max(0.0)).collect();
    let mut correlation = transform.symmetric(&density);
    let variance = correlation.first().copied().unwrap_or(1.0);
    correlation.iter_mut().for_each(|value| *value = interpolate(table, *value / variance));
    transform.symmetric(&correlation)
}

/// Linear between the pairs of a table with rising first entries, constant beyond its ends.
fn interpolate(table: &[(f64, f64)], x: f64) -> f64 {
    let high = table.partition_point(|pair| pair.0 < x).clamp(1, table.len() - 1);
    let ((x0, y0), (x1, y1)) = (table[high - 1], table[high]);
    y0 + (y1 - y0) * ((x - x0) / (x1 - x0)).clamp(0.0, 1.0)
}

/// The corner of the larger field that lies on `grid`.
fn cut(field: Vec<f64>, period: &Grid, grid: &Grid) -> Vec<f64> {
    if field.len() == grid.len() {
        return field;
    }
    field.chunks_exact(period.nx()).take(grid.ny()).flat_map(|row| &row[..grid.nx()]).copied().collect()
}

fn white_noise(count: usize, seed: u64) -> Vec<f64> {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let mut generator = ChaCha8Rng::from_seed(bytes);
    (0..count).map(|_| StandardNormal.sample(&mut generator)).collect()
}

/// Removes the mean and scales to the root mean square `rq`.
fn rescale(heights: &mut [f64], rq: f64) -> Result<(), InputError> {
    let count = heights.len() as f64;
    let mean = heights.iter().sum::<f64>() / count;
    let mut square = 0.0;
    for height in heights.iter_mut() {
        *height -= mean;
        square += *height * *height;
    }
    let factor = rq / (square / count).sqrt();
    require_scale(factor)?;
    heights.iter_mut().for_each(|h| *h *= factor);
    Ok(())
}

/// Error unless the factor to the height asked for is finite.
fn require_scale(factor: f64) -> Result<(), InputError> {
    if factor.is_finite() {
        return Ok(());
    }
    Err(InputError::Conflict {
        field: "roughness.rq".to_owned(),
        reason: "the grid has too few nodes for a rough surface".to_owned(),
    })
}
