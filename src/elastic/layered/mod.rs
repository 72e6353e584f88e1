//! The elastic half-space with a bonded layer by DC-FFT.
//!
//! `layer` holds the constants and the transform of the response, `images` approximates the transform by
//! image sources below the surface, and `buried` has the potentials of such sources on cells. They combine to
//! the influence coefficients of this file. Stresses use Fourier modes instead: `fourier_modes` computes the
//! correction of a layer for one mode, `stress` sums the modes.

mod buried;
mod fourier_modes;
mod images;
mod layer;
mod stress;

use std::f64::consts::PI;
use std::fmt;

pub use layer::Layer;
pub use stress::{LayerStressExtremes, LayeredStress, LayeredStressExtremes};

use self::images::{ImageSource, images};
use super::response::ElasticResponse;
use super::{DeformationModel, NEAR, ResponseApproximations};
use crate::analytic::{rectangle_potential, strip_potential};
use crate::error::InputError;
use crate::grid::Grid;

/// Tolerance on the compliance of the substrate against that of the pair, for rounded moduli.
const ROUNDING: f64 = 1e-3;

/// Two bodies pressed together, one of them a half-space with a bonded [`Layer`].
///
/// The compliance of the other body is the remainder `2/E' - (1 - v2^2)/E2` of the equivalent modulus `E'` of
/// the pair without layer; it is zero for a rigid body. With the compliances `c1`, `c2`, `(1 - v^2)/E` of
/// layer and substrate, a load `p` on a cell displaces the surfaces by
///
/// `u = 1/pi [(2/E' - c2 + c1) F_0 + c1 sum_k s_k F_k] p`,
///
/// with the potential `F_0` of the cell (Love 1929) and `F_k` of the cell at the depth `a_k`. The images
/// `s_k`, `a_k` approximate the transform of the layer to a relative error of 5e-6 up to a ratio of shear
/// moduli of 100 (3e-5 up to 1000). A layer of the substrate's material has no images. In plane strain the
/// potentials are twice those of bands.
///
/// Displacements are convolutions through FFTs of twice the grid, at the cost of
/// [`HalfSpace`](super::HalfSpace). Only the construction costs more: 48 images for each of the `N`
/// coefficients.
///
/// Sources: Burmister, D. M. (1945), Journal of Applied Physics 16, 89-94 (layer); Love, A. E. H. (1929),
/// Philosophical Transactions of the Royal Society A 228, 377-420 (cells).
///
/// ```
/// use stribeck::elastic::{DeformationModel, HalfSpace, Layer, LayeredHalfSpace};
/// use stribeck::Grid;
/// let grid = Grid::centred(33, 33, 1e-6, 1e-6)?;
/// let steel = [210e9, 0.3];
/// let pair = 230.77e9; // steel on steel
/// let soft = Layer::new(5e-6, [70e9, 0.3], steel)?;
/// let mut coated = LayeredHalfSpace::new(grid, pair, soft)?;
/// let mut bare = HalfSpace::new(grid, pair)?;
/// assert!(coated.influence(0, 0) > bare.influence(0, 0));
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Clone)]
pub struct LayeredHalfSpace {
    /// `E'` of the pair without the layer \[Pa\].
    equivalent_modulus: f64,
    /// The layer with its substrate.
    layer: Layer,
    /// Distance of zero displacement of a line contact \[m\]; `None` for a point contact.
    reference: Option<f64>,
    /// Influence coefficients of the nearest nodes \[m/Pa\], rows along y.
    near: [[f64; NEAR + 1]; NEAR + 1],
    /// Convolutions with all coefficients.
    response: ElasticResponse,
}

impl fmt::Debug for LayeredHalfSpace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LayeredHalfSpace")
            .field("equivalent_modulus", &self.equivalent_modulus)
            .field("layer", &self.layer)
            .field("grid", &self.grid())
            .finish_non_exhaustive()
    }
}

impl LayeredHalfSpace {
    /// Bodies on `grid` with the equivalent modulus `E'` \[Pa\] of the pair without `layer`.
    ///
    /// # Errors
    /// A modulus that is not finite and positive, or one for which the other body has a negative compliance.
    pub fn new(grid: Grid, equivalent_modulus: f64, layer: Layer) -> Result<Self, InputError> {
        let loads = Loads::new(equivalent_modulus, &layer)?;
        let half = [0.5 * grid.dx(), 0.5 * grid.dy()];
        let coefficient = |di: usize, dj: usize| {
            let (x, y) = (grid.dx() * di as f64, grid.dy() * dj as f64);
            let surface = rectangle_potential(x, y, half[0], half[1]);
            loads.sum(surface, |depth| buried::rectangle(x, y, half, depth)) / PI
        };
        Ok(Self::from_coefficients(grid, equivalent_modulus, layer, None, coefficient))
    }

    /// The plane-strain model under line loads on the single row of `grid`, with displacements relative to
    /// those at the distance `reference` \[m\], as in [`LineHalfSpace`](super::LineHalfSpace).
    ///
    /// # Errors
    /// More than one row, a reference below the length of the row, a modulus as in [`LayeredHalfSpace::new`].
    pub fn plane_strain(
        grid: Grid,
        equivalent_modulus: f64,
        layer: Layer,
        reference: f64,
    ) -> Result<Self, InputError> {
        super::line::require_row(&grid, reference)?;
        let loads = Loads::new(equivalent_modulus, &layer)?;
        let half = 0.5 * grid.dx();
        let coefficient = |di: usize, dj: usize| {
            if dj > 0 {
                return 0.0;
            }
            let x = grid.dx() * di as f64;
            let surface = strip_potential(x, half, reference);
            2.0 / PI * loads.sum(surface, |depth| buried::strip(x, half, depth, reference))
        };
        Ok(Self::from_coefficients(grid, equivalent_modulus, layer, Some(reference), coefficient))
    }

    /// The model under the [strip](Grid::strip) `grid`, with displacements relative to those at the distance `reference`
    /// \[m\], as in [`StripHalfSpace`](super::StripHalfSpace): potentials are those of a cell and of its images in all
    /// periods.
    ///
    /// # Errors
    /// A grid that is no strip, a reference below its length, a modulus as in [`LayeredHalfSpace::new`].
    ///
    /// ```
    /// use stribeck::Grid;
    /// use stribeck::elastic::{DeformationModel, Layer, LayeredHalfSpace};
    /// let (x, y) = ([-1e-4, 1e-4], [-2e-5, 2e-5]);
    /// let soft = Layer::new(10e-6, [70e9, 0.3], [210e9, 0.3])?;
    /// let mut strip = LayeredHalfSpace::strip(Grid::strip(64, 16, x, y)?, 230e9, soft, 10e-3)?;
    /// let row = Grid::from_edges(64, 1, x, [-0.5, 0.5])?;
    /// let mut line = LayeredHalfSpace::plane_strain(row, 230e9, soft, 10e-3)?;
    /// // Equal rows deflect as a line contact.
    /// let (mut rows, mut row) = ([0.0; 64 * 16], [0.0; 64]);
    /// strip.displacement(&[1e9; 64 * 16], &mut rows)?;
    /// line.displacement(&[1e9; 64], &mut row)?;
    /// assert!((rows[8 * 64 + 20] / row[20] - 1.0).abs() < 1e-7);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn strip(
        grid: Grid,
        equivalent_modulus: f64,
        layer: Layer,
        reference: f64,
    ) -> Result<Self, InputError> {
        super::strip::require_strip(&grid, reference)?;
        let loads = Loads::new(equivalent_modulus, &layer)?;
        let half = [0.5 * grid.dx(), 0.5 * grid.dy()];
        let period = grid.ny();
        let coefficient = |di: usize, dj: usize| {
            let dj = (dj % period).min(period - dj % period);
            let surface = super::strip::potential(&grid, reference, di, dj);
            let buried = |depth| {
                let cell = |x, y| buried::rectangle(x, y, half, depth);
                super::strip::buried_potential(&grid, reference, (di, dj), depth, cell)
            };
            loads.sum(surface, buried) / PI
        };
        Ok(Self::from_coefficients(grid, equivalent_modulus, layer, Some(reference), coefficient))
    }

    /// Bodies with the influence `coefficient(i, j)` \[m/Pa\] at an offset of `i` columns and `j` rows.
    fn from_coefficients(
        grid: Grid,
        equivalent_modulus: f64,
        layer: Layer,
        reference: Option<f64>,
        coefficient: impl Fn(usize, usize) -> f64,
    ) -> Self {
        let (nx, ny) = (grid.nx(), grid.ny());
        // Offsets of a strip are at most half a period.
        let rows = if grid.is_strip() { ny / 2 + 1 } else { ny };
        let table: Vec<f64> = (0..nx * rows).map(|k| coefficient(k % nx, k / nx)).collect();
        let kernel = |di: isize, dj: isize| table[dj.unsigned_abs() * nx + di.unsigned_abs()];
        let near = std::array::from_fn(|dj| std::array::from_fn(|di| coefficient(di, dj)));
        let response = ElasticResponse::new(grid, kernel);
        Self { equivalent_modulus, layer, reference, near, response }
    }
}

/// Surface load and image sources with their compliances.
struct Loads {
    /// Compliance of the load on the surface \[1/Pa\].
    surface: f64,
    /// Compliance of the layer, which multiplies the images \[1/Pa\].
    layer: f64,
    /// Image sources.
    images: Vec<ImageSource>,
}

impl Loads {
    /// Compliances of a pair; rejects a modulus for which the other body has a negative compliance.
    fn new(equivalent_modulus: f64, layer: &Layer) -> Result<Self, InputError> {
        InputError::require_positive("elastic.equivalent_modulus", equivalent_modulus)?;
        let pair = 2.0 / equivalent_modulus;
        let [own, substrate] = layer.compliances();
        InputError::require(
            substrate <= pair * (1.0 + ROUNDING),
            "elastic.equivalent_modulus",
            equivalent_modulus,
            "at most 2 E/(1 - v^2) of the layer's substrate, its value for a rigid counterbody",
        )?;
        Ok(Self { surface: pair + (own - substrate), layer: own, images: images(layer)? })
    }

    /// Sum of potentials times compliances.
    fn sum(&self, surface: f64, at_depth: impl Fn(f64) -> f64) -> f64 {
        let images: f64 = self.images.iter().map(|image| image.strength * at_depth(image.depth)).sum();
        self.surface * surface + self.layer * images
    }
}

impl DeformationModel for LayeredHalfSpace {
    fn grid(&self) -> Grid {
        self.response.grid
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.displacement(pressure, out)
    }

    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        let body = match self.reference {
            None => Self::new(grid, self.equivalent_modulus, self.layer),
            Some(reference) if grid.is_strip() => {
                Self::strip(grid, self.equivalent_modulus, self.layer, reference.max(grid.size_x()))
            }
            Some(_) => return None,
        };
        Some(Box::new(body.ok()?))
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        self.near.get(dj).and_then(|row| row.get(di)).copied().unwrap_or(0.0)
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        Some(self)
    }
}

impl ResponseApproximations for LayeredHalfSpace {
    fn displacement_single(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.displacement_single(pressure, out)
    }

    fn displacement_periodic(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        if self.grid().ny() == 1 {
            return self.response.displacement_single(pressure, out);
        }
        self.response.displacement_periodic(pressure, out)
    }

    fn pressure_estimate(&mut self, displacement: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.pressure_estimate(displacement, out)
    }

    fn set_mean_compliance(&mut self, compliance: f64) {
        self.response.set_mean_compliance(compliance);
    }
}
