//! The elastic half-space by DC-FFT.
//!
//! Exact for a pressure that is constant in each cell; the discretization error is that of piecewise constant
//! pressure. The kernel decays as `1/r`, so all pairs of nodes interact.

use std::f64::consts::PI;
use std::fmt;

use super::response::ElasticResponse;
use super::{DeformationModel, NEAR, ResponseApproximations};
use crate::analytic::rectangle_potential;
use crate::error::InputError;
use crate::grid::Grid;

/// Two half-spaces pressed together: `u(x, y) = 2/(pi E') * integral of p / r` with the pressure constant in
/// each cell (influence coefficients of Love 1929), summed as a discrete convolution through FFTs of the
/// doubled size.
///
/// `E'` is the equivalent modulus, `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`. Cost: one forward and one inverse
/// real FFT of 4 N points for N nodes. Memory: about 100 bytes per node for the shared plan and 100 for each
/// clone's buffers. Cloning shares the plan.
///
/// ```
/// use stribeck::elastic::{DeformationModel, HalfSpace};
/// use stribeck::Grid;
/// let grid = Grid::centred(33, 33, 1e-6, 1e-6)?;
/// let mut body = HalfSpace::new(grid, 230e9)?;
/// let mut pressure = vec![0.0; grid.len()];
/// pressure[16 * 33 + 16] = 1e9;
/// let mut displacement = vec![0.0; grid.len()];
/// body.displacement(&pressure, &mut displacement)?;
/// // centre of a uniformly loaded square of side s: 2/(pi E') p * 4 s ln(1 + sqrt 2)
/// let exact = 2.0 / (std::f64::consts::PI * 230e9) * 1e9 * 4e-6 * (1.0 + 2.0_f64.sqrt()).ln();
/// assert!((displacement[16 * 33 + 16] / exact - 1.0).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Clone)]
pub struct HalfSpace {
    /// `E'` \[Pa\].
    equivalent_modulus: f64,
    /// Influence coefficients by rows and columns of offset \[m/Pa\].
    near: [[f64; NEAR + 1]; NEAR + 1],
    /// Convolution with all influence coefficients.
    response: ElasticResponse,
}

impl fmt::Debug for HalfSpace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("HalfSpace")
            .field("equivalent_modulus", &self.equivalent_modulus)
            .field("grid", &self.grid())
            .finish_non_exhaustive()
    }
}

impl HalfSpace {
    /// Half-space on `grid` with equivalent modulus `E'` \[Pa\].
    ///
    /// # Errors
    /// A modulus that is not finite and positive.
    pub fn new(grid: Grid, equivalent_modulus: f64) -> Result<Self, InputError> {
        InputError::require_positive("elastic.equivalent_modulus", equivalent_modulus)?;
        let table = influence_table(&grid, equivalent_modulus);
        let nx = grid.nx();
        let kernel = |di: isize, dj: isize| table[dj.unsigned_abs() * nx + di.unsigned_abs()];
        let near = std::array::from_fn(|dj| {
            std::array::from_fn(|di| influence_coefficient(&grid, equivalent_modulus, di, dj))
        });
        Ok(Self { equivalent_modulus, near, response: ElasticResponse::new(grid, kernel) })
    }
}

/// Displacement \[m/Pa\] at an offset of `di` columns and `dj` rows from a cell under unit pressure (Love
/// 1929).
pub(super) fn influence_coefficient(grid: &Grid, equivalent_modulus: f64, di: usize, dj: usize) -> f64 {
    2.0 / (PI * equivalent_modulus)
        * rectangle_potential(grid.dx() * di as f64, grid.dy() * dj as f64, 0.5 * grid.dx(), 0.5 * grid.dy())
}

/// The coefficients at all offsets 0..nx, 0..ny, row-major.
pub(super) fn influence_table(grid: &Grid, equivalent_modulus: f64) -> Vec<f64> {
    let mut table = Vec::with_capacity(grid.len());
    for dj in 0..grid.ny() {
        for di in 0..grid.nx() {
            table.push(influence_coefficient(grid, equivalent_modulus, di, dj));
        }
    }
    table
}

impl DeformationModel for HalfSpace {
    fn grid(&self) -> Grid {
        self.response.grid
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.displacement(pressure, out)
    }

    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        let body = Self::new(grid, self.equivalent_modulus).ok()?;
        Some(Box::new(body))
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        self.near.get(dj).and_then(|row| row.get(di)).copied().unwrap_or(0.0)
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        Some(self)
    }
}

impl ResponseApproximations for HalfSpace {
    fn displacement_single(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.displacement_single(pressure, out)
    }

    fn displacement_periodic(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.displacement_periodic(pressure, out)
    }

    fn pressure_estimate(&mut self, displacement: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.pressure_estimate(displacement, out)
    }

    fn set_mean_compliance(&mut self, compliance: f64) {
        self.response.set_mean_compliance(compliance);
    }
}
