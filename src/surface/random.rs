//! Random surfaces: a shape across the plane, a distribution and a scale of heights.

use rand_distr::{Distribution, StandardNormal};

use super::amplitudes::{Amplitudes, Mean};
use super::deviates::{cipher, phase};
use super::fourier_resampling::series_at_nodes;
use super::johnson::Johnson;
use super::patch;
use super::random_shape::RandomShape;
use super::rescale::rescale;
use super::roughness_spec::RoughnessSpec;
use super::self_affine::{SelfAffine, Synthesis};
use crate::boundary::Boundary;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{RealFft2, join, map_lines};
use crate::with_fields::with_fields;

/// Definition of the root mean square height of a random surface.
///
/// # Examples
///
/// ```
/// use stribeck::surface::{Autocorrelation, HeightScale, RandomSurface, RoughnessSpec};
/// use stribeck::{Grid, metrics::height_statistics};
/// let (autocorrelation, rq, length_x, length_y) = (Autocorrelation::Gaussian, 1e-7, 4e-5, 4e-5);
/// let spec = RoughnessSpec { autocorrelation, rq, length_x, length_y, seed: 1 };
/// let grid = Grid::centred(32, 32, 4e-6, 4e-6)?;
/// let sq = |height| -> Result<f64, stribeck::InputError> {
///     let surface = RandomSurface::from(spec).with_height(height).generate(&grid)?;
///     Ok(height_statistics(&surface)?.sq)
/// };
/// assert!((sq(HeightScale::Exact)? / 1e-7 - 1.0).abs() < 1e-9);
/// assert!((sq(HeightScale::Ensemble)? / 1e-7 - 1.0).abs() > 1e-6); // few hills: it scatters
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum HeightScale {
    /// Each surface has exactly this Rq, as in standard parameters of one surface. Removes the mean.
    #[default]
    Exact,
    /// The mean square over all seeds, as for patches of one large surface; single surfaces scatter about it.
    Ensemble,
}

/// Distribution of the heights.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::surface::{Autocorrelation, HeightDistribution, RandomShape, RandomSurface};
/// let (autocorrelation, length_x, length_y) = (Autocorrelation::Gaussian, 2e-5, 2e-5);
/// let shape = RandomShape::Correlated { autocorrelation, length_x, length_y };
/// let grid = Grid::centred(32, 32, 4e-6, 4e-6)?;
/// // No distribution has a kurtosis below skewness^2 + 1.
/// let impossible = HeightDistribution::Johnson { skewness: -2.0, kurtosis: 4.0 };
/// assert!(RandomSurface::new(shape, 1e-7, 1).with_distribution(impossible).generate(&grid).is_err());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
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
/// let surface = RandomSurface::new(RandomShape::SelfAffine(fractal), 100e-9, 7)
///     .with_distribution(HeightDistribution::Johnson { skewness: -1.0, kurtosis: 5.0 });
/// let statistics = height_statistics(&surface.generate(&grid)?)?;
/// assert!((statistics.sq / 100e-9 - 1.0).abs() < 1e-12 && statistics.ssk < -0.5);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RandomSurface {
    /// Shape across the plane.
    pub shape: RandomShape,
    /// Root mean square height \[m\]; 0 for a smooth surface.
    pub rq: f64,
    /// Seed: equal seeds give equal surfaces.
    pub seed: u64,
    /// Definition of `rq`.
    pub height: HeightScale,
    /// Distribution of the heights.
    pub distribution: HeightDistribution,
    /// Whether opposite edges match. An open surface is cut out of a larger periodic one.
    pub boundary: Boundary,
    /// Cells along x and y of the mesh on which the heights are drawn. Other meshes of the same box have the Fourier
    /// series of these heights at their nodes. `None`: the cells of the grid, another surface on each mesh.
    pub cells: Option<[usize; 2]>,
}

with_fields!(RandomSurface {
    with_shape shape: RandomShape,
    with_rq rq: f64,
    with_seed seed: u64,
    with_height height: HeightScale,
    with_distribution distribution: HeightDistribution,
    with_boundary boundary: Boundary,
    with_cells cells: Option<[usize; 2]>,
});

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
        Self { shape, rq, seed, height, distribution, boundary, cells: None }
    }

    /// The surface on `grid` \[m\]. A periodic surface has zero mean.
    ///
    /// Heights of a Johnson distribution are transformed from normal ones node by node; the autocorrelation of the normal
    /// ones is chosen to give the requested one (translation process). Skewness and kurtosis are exact in the mean over
    /// seeds; single surfaces scatter about them depending on their number of correlation lengths.
    ///
    /// Sources: Hu, Y. Z. and Tonder, K. (1992), International Journal of Machine Tools and Manufacture 32,
    /// 83-90; Johnson, N. L. (1949), Biometrika 36, 149-176.
    ///
    /// # Errors
    /// A negative `rq`, lengths that are not positive or exceed the grid, a Hurst exponent or cut-offs out of range, an
    /// impossible pair of skewness and kurtosis (the error gives the range), a grid with too few nodes; `cells` of an open
    /// surface, of more than [`Grid::MAX_NODES`] nodes, or of one row where the grid has more.
    pub fn generate(&self, grid: &Grid) -> Result<Vec<f64>, InputError> {
        match self.cells {
            Some(cells) if cells != [grid.nx(), grid.ny()] => {
                let heights = self.draw(&self.own_mesh(grid)?)?;
                series_at_nodes(&heights, cells, [grid.nx(), grid.ny()])
            }
            _ => self.draw(grid),
        }
    }

    /// The mesh of the box of `grid` on which the heights are drawn.
    pub(crate) fn own_mesh(&self, grid: &Grid) -> Result<Grid, InputError> {
        let Some([nx, ny]) = self.cells else { return Ok(*grid) };
        let conflict = |reason: &str| {
            Err(InputError::Conflict {
                field: format!("roughness.cells = [{nx}, {ny}]"),
                reason: reason.to_owned(),
            })
        };
        if self.boundary == Boundary::Open {
            return conflict("a Fourier series needs boundary = \"periodic\"");
        }
        if (ny == 1) != (grid.ny() == 1) {
            return conflict("one row of cells belongs to a line contact of one row, and to no other grid");
        }
        if nx < 2 || ny < 1 || nx.saturating_mul(ny) > Grid::MAX_NODES {
            return conflict("at least 2 along x and at least 1 along y, at most 2^26 (67 million) in all");
        }
        Ok(grid.with_cells(nx, ny))
    }

    /// Heights drawn on the cells of `grid`.
    fn draw(&self, grid: &Grid) -> Result<Vec<f64>, InputError> {
        self.shape.validate(self.rq, self.seed, grid)?;
        let johnson = match self.distribution {
            HeightDistribution::Normal => None,
            HeightDistribution::Johnson { skewness, kurtosis } => Some(Johnson::new(skewness, kurtosis)?),
        };
        if self.rq == 0.0 {
            return Ok(vec![0.0; grid.len()]);
        }
        let (mut heights, deviation) = self.deviates(grid, johnson.as_ref())?;
        if let Some(johnson) = &johnson {
            let curve = johnson.tabulated();
            map_lines(&mut heights, grid.nx(), |_, row| {
                row.iter_mut().for_each(|z| *z = curve.at(*z / deviation));
            });
        }
        let factor = match (self.height, johnson) {
            (HeightScale::Exact, _) => {
                rescale(&mut heights, grid.nx(), |_| true, self.rq).ok_or_else(too_few_nodes)?;
                return Ok(heights);
            }
            (HeightScale::Ensemble, Some(_)) => self.rq,
            (HeightScale::Ensemble, None) => self.rq / deviation,
        };
        if !factor.is_finite() {
            return Err(too_few_nodes());
        }
        map_lines(&mut heights, grid.nx(), |_, row| row.iter_mut().for_each(|z| *z *= factor));
        Ok(heights)
    }

    /// Normal deviates with the requested autocorrelation, and their standard deviation over all seeds.
    fn deviates(&self, grid: &Grid, johnson: Option<&Johnson>) -> Result<(Vec<f64>, f64), InputError> {
        let phases_alone = matches!(
            self.shape,
            RandomShape::SelfAffine(SelfAffine { synthesis: Synthesis::RandomPhase, .. })
        );
        if self.boundary == Boundary::Open {
            return patch::deviates(&self.shape, johnson, grid, self.seed, phases_alone);
        }
        let transform = RealFft2::new(grid.nx(), grid.ny());
        let amplitudes = || Amplitudes::new(&self.shape, johnson, grid, &transform, Mean::Zero);
        let mut made = None;
        let mut field = join(|| white_noise(grid.len(), self.seed), || made = Some(amplitudes()));
        let amplitudes = made.unwrap_or_else(amplitudes);
        let length = (grid.len() as f64).sqrt();
        transform.filter(&mut field, |wave, value| {
            if phases_alone {
                *value = phase(*value) * length;
            }
            *value *= amplitudes.waves[wave];
        });
        // normalization of the transforms
        Ok((field, (amplitudes.power * grid.len() as f64).sqrt()))
    }
}

impl RandomShape {
    /// Checks shape, distribution and scale against `grid`.
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
}

/// Normal deviates in the order of the field.
fn white_noise(count: usize, seed: u64) -> Vec<f64> {
    let mut generator = cipher(seed);
    (0..count).map(|_| StandardNormal.sample(&mut generator)).collect()
}

/// The error of a grid of a single node.
fn too_few_nodes() -> InputError {
    InputError::Conflict {
        field: "roughness.rq".to_owned(),
        reason: "the grid has too few nodes for a rough surface".to_owned(),
    }
}
