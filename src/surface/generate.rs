//! Random roughness of a given autocorrelation by filtering white noise.

use num_complex::Complex64;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rustfft::FftDirection;

use super::johnson::Johnson;
use crate::boundary::Boundary;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Fft2, fast_length};

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
    RandomSurface::from(*spec).generate(grid)
}

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

/// A spectrum that falls as `q^(-2 (1 + hurst))` from the roll-off on, `q = 2 pi / wavelength`; constant above the roll-off
/// wavelength, zero outside the cut-offs.
///
/// Source: Jacobs, T. D. B., Junge, T. and Pastewka, L. (2017), Surface Topography: Metrology and Properties 5, 013001.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfAffine {
    /// Hurst exponent, above 0 and at most 1: 1 is smoothest.
    pub hurst: f64,
    /// Longest wavelength \[m\]; infinite for the size of the grid.
    pub longest: f64,
    /// Wavelength where the spectrum starts to fall \[m\], at most `longest`.
    pub roll_off: f64,
    /// Shortest wavelength \[m\], below `roll_off`; 0 for that of the grid.
    pub shortest: f64,
    /// Where randomness enters.
    pub synthesis: Synthesis,
}

/// How modes are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Synthesis {
    /// Amplitude and phase of every mode are random: white noise filtered.
    #[default]
    FilteredNoise,
    /// Phases alone are random: every surface has exactly the spectrum asked for.
    RandomPhase,
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
        let mut transform = Fft2::new(period.nx(), period.ny());
        let mut filter = self.shape.density(&period, &mut transform);
        if let Some(johnson) = &johnson {
            precorrect(&mut filter, &johnson.correlations(), &mut transform);
        }
        let mut field = white_noise(period.len(), self.seed);
        transform.process(&mut field, FftDirection::Forward);
        let phases_only = matches!(
            self.shape,
            RandomShape::SelfAffine(SelfAffine { synthesis: Synthesis::RandomPhase, .. })
        );
        let mut power = 0.0;
        for (k, (value, density)) in field.iter_mut().zip(&filter).enumerate() {
            let density = if k == 0 { 0.0 } else { density.re.max(0.0) };
            power += density;
            if phases_only {
                let size = value.norm();
                *value = if size > 0.0 { *value / size } else { Complex64::new(1.0, 0.0) };
                *value *= (period.len() as f64).sqrt();
            }
            *value *= density.sqrt();
        }
        transform.process(&mut field, FftDirection::Inverse);
        let mut heights = cut(&field, &period, grid);
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
}

impl RandomShape {
    fn validate(&self, rq: f64, seed: u64, grid: &Grid) -> Result<(), InputError> {
        match *self {
            Self::Correlated { autocorrelation, length_x, length_y } => {
                RoughnessSpec { autocorrelation, rq, length_x, length_y, seed }.validate(grid)
            }
            Self::SelfAffine(SelfAffine { hurst, longest, roll_off, shortest, .. }) => {
                InputError::require_non_negative("roughness.rq", rq)?;
                let exists = hurst > 0.0 && hurst <= 1.0;
                InputError::require(exists, "roughness.hurst", hurst, "above 0 and at most 1")?;
                InputError::require(longest > 0.0, "roughness.longest", longest, "> 0")?;
                let ordered = roll_off > 0.0 && roll_off <= longest && roll_off.is_finite();
                InputError::require(
                    ordered,
                    "roughness.roll_off",
                    roll_off,
                    "> 0 and at most the longest wavelength",
                )?;
                let ordered = shortest >= 0.0 && shortest < roll_off;
                InputError::require(
                    ordered,
                    "roughness.shortest",
                    shortest,
                    ">= 0 and below the roll-off wavelength",
                )
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

    /// Spectral density of any scale, in the order of the transform.
    fn density(&self, grid: &Grid, transform: &mut Fft2) -> Vec<Complex64> {
        match *self {
            Self::Correlated { autocorrelation, length_x, length_y } => {
                let mut field = autocorrelation_field(grid, autocorrelation, [length_x, length_y]);
                transform.process(&mut field, FftDirection::Forward);
                field
            }
            Self::SelfAffine(spectrum) => spectrum.density(grid),
        }
    }
}

impl SelfAffine {
    fn density(&self, grid: &Grid) -> Vec<Complex64> {
        let (nx, ny) = (grid.nx(), grid.ny());
        let frequency = |k: usize, n: usize, size: f64| k.min(n - k) as f64 / size;
        // relative slack, so that modes on a cut-off are not lost to rounding
        let (lowest, highest) = ((1.0 - 1e-9) / self.longest, (1.0 + 1e-9) / self.shortest);
        let mut field = Vec::with_capacity(grid.len());
        for j in 0..ny {
            let y = frequency(j, ny, grid.size_y());
            for i in 0..nx {
                let frequency = frequency(i, nx, grid.size_x()).hypot(y);
                let inside = (lowest..=highest).contains(&frequency);
                let falling = (frequency * self.roll_off).max(1.0).powf(-2.0 * (1.0 + self.hurst));
                field.push(Complex64::new(if inside { falling } else { 0.0 }, 0.0));
            }
        }
        field
    }
}

/// Replaces a spectral density by that of normal deviates which the curve of the table turns into the one asked for.
fn precorrect(density: &mut [Complex64], table: &[(f64, f64)], transform: &mut Fft2) {
    if let Some(mean) = density.first_mut() {
        *mean = Complex64::default();
    }
    density.iter_mut().for_each(|value| *value = Complex64::new(value.re.max(0.0), 0.0));
    transform.process(density, FftDirection::Inverse);
    let variance = density.first().map_or(0.0, |value| value.re);
    if variance > 0.0 {
        density
            .iter_mut()
            .for_each(|value| *value = Complex64::new(interpolate(table, value.re / variance), 0.0));
    }
    transform.process(density, FftDirection::Forward);
}

/// Linear between the pairs of a table with rising first entries, constant beyond its ends.
fn interpolate(table: &[(f64, f64)], x: f64) -> f64 {
    let high = table.partition_point(|pair| pair.0 < x).clamp(1, table.len() - 1);
    let ((x0, y0), (x1, y1)) = (table[high - 1], table[high]);
    y0 + (y1 - y0) * ((x - x0) / (x1 - x0)).clamp(0.0, 1.0)
}

/// The corner of the larger field that lies on `grid`.
fn cut(field: &[Complex64], period: &Grid, grid: &Grid) -> Vec<f64> {
    let rows = field.chunks_exact(period.nx()).take(grid.ny());
    rows.flat_map(|row| &row[..grid.nx()]).map(|value| value.re).collect()
}

fn white_noise(count: usize, seed: u64) -> Vec<Complex64> {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let mut generator = ChaCha8Rng::from_seed(bytes);
    (0..count).map(|_| Complex64::new(StandardNormal.sample(&mut generator), 0.0)).collect()
}

/// The autocorrelation at the shortest periodic distances from node 0.
fn autocorrelation_field(
    grid: &Grid,
    autocorrelation: Autocorrelation,
    [length_x, length_y]: [f64; 2],
) -> Vec<Complex64> {
    let (nx, ny) = (grid.nx(), grid.ny());
    let mut field = vec![Complex64::default(); grid.len()];
    // a quarter is computed, the others mirror it
    for j in 0..=ny / 2 {
        let y = j as f64 * grid.dy() / length_y;
        let row = &mut field[j * nx..(j + 1) * nx];
        for (i, node) in row[..=nx / 2].iter_mut().enumerate() {
            let x = i as f64 * grid.dx() / length_x;
            *node = Complex64::new(autocorrelation.at(x * x + y * y), 0.0);
        }
        for i in nx / 2 + 1..nx {
            row[i] = row[nx - i];
        }
    }
    for j in ny / 2 + 1..ny {
        field.copy_within((ny - j) * nx..(ny - j + 1) * nx, j * nx);
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
