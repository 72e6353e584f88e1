//! Stresses below the surface under given pressures and tractions.

mod corners;
pub(super) mod extremes;
mod rectangle;

use std::sync::Arc;

pub use extremes::{Extreme, StressExtremes, stress_extremes};

use self::corners::{COMPONENTS, Parities, UNDER_PRESSURE, UNDER_TRACTION, under_pressure, under_traction};
use self::rectangle::Rectangle;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Convolution, ConvolutionPlan};

/// Stresses \[Pa\] at one depth below the nodes of a grid, tension positive; z points into the body.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::elastic::subsurface_stress;
/// let grid = Grid::centred(33, 33, 1e-5, 1e-5)?;
/// let stress = subsurface_stress(&grid, 0.3, 0.0, &vec![1e9; grid.len()], None)?;
/// let middle = 16 * 33 + 16;
/// assert!((stress.zz[middle] + 1e9).abs() < 1.0); // minus the pressure at the surface
/// assert!(stress.xy[middle].abs() < 1.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct StressField {
    /// Normal stress along x.
    pub xx: Vec<f64>,
    /// Normal stress along y.
    pub yy: Vec<f64>,
    /// Normal stress into the body, minus the pressure at the surface.
    pub zz: Vec<f64>,
    /// Shear stress in planes parallel to the surface.
    pub xy: Vec<f64>,
    /// Orthogonal shear stress, along x on planes parallel to the surface.
    pub xz: Vec<f64>,
    /// The same along y.
    pub yz: Vec<f64>,
}

impl StressField {
    /// Zero stress at `n` nodes.
    fn zeros(n: usize) -> Self {
        let [xx, yy, zz, xy, xz, yz] = std::array::from_fn(|_| vec![0.0; n]);
        Self { xx, yy, zz, xy, xz, yz }
    }

    /// The six components in the order of the fields.
    pub(super) fn components(&mut self) -> [&mut Vec<f64>; COMPONENTS] {
        [&mut self.xx, &mut self.yy, &mut self.zz, &mut self.xy, &mut self.xz, &mut self.yz]
    }

    /// Von Mises stress \[Pa\] under each node:
    /// `sqrt{[(xx - yy)^2 + (yy - zz)^2 + (zz - xx)^2]/2 + 3 (xy^2 + xz^2 + yz^2)}`.
    pub fn von_mises(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.xx.len()).map(|k| {
            let (xx, yy, zz) = (self.xx[k], self.yy[k], self.zz[k]);
            let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
            let shear = self.xy[k].powi(2) + self.xz[k].powi(2) + self.yz[k].powi(2);
            (0.5 * normal + 3.0 * shear).sqrt()
        })
    }
}

/// Stresses at `depth` \[m\] of a half-space of Poisson's ratio `poisson` under `pressure` \[Pa\] and the
/// `traction` \[Pa\] along +x on its surface, both constant in each cell of `grid`; `None` for no traction.
///
/// Stresses under a uniformly loaded rectangle have closed forms, which are summed as convolutions through
/// FFTs of twice the grid, without periodic images; on a strip with its images in all periods along y, to 1e-6 of the
/// pressure. At depth zero the stresses are those just below the
/// surface. Under a line contact (a row of cells one metre wide) they are the plane-strain stresses to
/// `4 (1 - 2 v) b/pi` of the pressure, with the half-width `b` in metres. Cost: twelve convolutions and the
/// transforms of their kernels, six without traction.
///
/// Sources: Love, A. E. H. (1929), Philosophical Transactions of the Royal Society A 228, 377-420 (pressure);
/// Johnson, K. L. (1985), Contact Mechanics, section 3.6 (point traction).
///
/// # Errors
/// Slices that do not fit the grid, a depth that is not finite or below zero, a ratio not above -1 or above
/// 0.5.
///
/// ```
/// use stribeck::elastic::subsurface_stress;
/// use stribeck::Grid;
/// // 0.48 radii below the centre of a Hertz contact: von Mises 0.62 of the largest pressure.
/// let grid = Grid::centred(65, 65, 1.0 / 30.0, 1.0 / 30.0)?;
/// let pressure: Vec<f64> = grid.nodes().map(|(x, y)| 1e9 * (1.0 - x * x - y * y).max(0.0).sqrt()).collect();
/// let stress = subsurface_stress(&grid, 0.3, 0.48, &pressure, None)?;
/// let centre = stress.von_mises().nth(32 * 65 + 32).unwrap();
/// assert!((centre / 1e9 - 0.62).abs() < 2e-3);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn subsurface_stress(
    grid: &Grid,
    poisson: f64,
    depth: f64,
    pressure: &[f64],
    traction: Option<&[f64]>,
) -> Result<StressField, InputError> {
    InputError::require(-1.0 < poisson && poisson <= 0.5, "poisson", poisson, "above -1 and at most 0.5")?;
    InputError::require_non_negative("depth", depth)?;
    InputError::require_len("pressure", pressure, grid.len())?;
    if let Some(traction) = traction {
        InputError::require_len("traction", traction, grid.len())?;
    }
    let mut stress = StressField::zeros(grid.len());
    let mut scratch = vec![0.0; grid.len()];
    let mut add = |field: &[f64], parities: &Parities, corner: fn(f64, [f64; 3]) -> [f64; COMPONENTS]| {
        let cell = Rectangle::new(grid, |[x, y]| corner(poisson, [x, y, depth]));
        for (component, out) in stress.components().into_iter().enumerate() {
            let kernel = |di, dj| cell.stress(component, parities[component], [di, dj]);
            let make = if grid.is_strip() { ConvolutionPlan::periodic_across } else { ConvolutionPlan::new };
            let plan = make(grid.nx(), grid.ny(), kernel);
            Convolution::new(Arc::new(plan)).apply(field, &mut scratch);
            out.iter_mut().zip(&scratch).for_each(|(sum, part)| *sum += part);
        }
    };
    add(pressure, &UNDER_PRESSURE, under_pressure);
    if let Some(traction) = traction {
        add(traction, &UNDER_TRACTION, under_traction);
    }
    Ok(stress)
}
