//! The elastic half-space under line loads, plane strain, by DC-FFT.
//!
//! The grid has one row; forces are per metre of contact length. The kernel is logarithmic and has no limit
//! at infinity, hence the reference distance.

use super::response::ElasticResponse;
use super::{DeformationModel, NEAR, ResponseApproximations};
use crate::analytic::strip_displacement;
use crate::error::InputError;
use crate::grid::Grid;

/// Two half-spaces pressed together along lines: `u(x) = 4/(pi E') * integral of p ln(reference/|x - s|) ds`
/// with the pressure constant in each cell, the influence coefficients of the strips exact, summed through
/// FFTs of twice the line.
///
/// Plane-strain displacements have no finite limit at infinity: `u`, and the approach of the bodies with it,
/// are zero at the distance `reference` from a line load. Another reference shifts `u` and the approach by
/// `4 w/(pi E')` times the logarithm of the ratio of references, with the load per length `w`, and changes
/// neither pressure nor gap.
///
/// The grid has one row. `E'` is the equivalent modulus, `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`. Cost: one
/// forward and one inverse real FFT of 2 N points for N nodes. Memory: about 200 bytes per node. Cloning
/// shares the plan.
///
/// ```
/// use stribeck::analytic::HertzLine;
/// use stribeck::elastic::{DeformationModel, LineHalfSpace};
/// use stribeck::Grid;
/// // The displacement under a Hertz pressure follows the parabola of the bodies: 4 w/(pi E') (ln(2 D/a) + 1/2) - x^2/(2 R).
/// let hertz = HertzLine::from_load(10e-3, 230e9, 1e5)?;
/// let grid = Grid::from_edges(1001, 1, [-2.0 * hertz.half_width, 2.0 * hertz.half_width], [-0.5, 0.5])?;
/// let mut body = LineHalfSpace::new(grid, 230e9, 10e-3)?;
/// let pressure: Vec<f64> = grid.nodes().map(|(x, _)| hertz.pressure_at(x)).collect();
/// let mut displacement = vec![0.0; grid.len()];
/// body.displacement(&pressure, &mut displacement)?;
/// assert!((displacement[500] / hertz.approach(10e-3)? - 1.0).abs() < 1e-4);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone)]
pub struct LineHalfSpace {
    /// Influence coefficients by columns of offset \[m/Pa\].
    near: [f64; NEAR + 1],
    /// Convolution with all influence coefficients.
    response: ElasticResponse,
}

impl LineHalfSpace {
    /// Half-space under the single row of `grid` with equivalent modulus `E'` \[Pa\] and displacements
    /// relative to those at the distance `reference` \[m\].
    ///
    /// # Errors
    /// More than one row. A modulus that is not finite and positive. A reference below the length of the row,
    /// which would make the influence of distant nodes negative.
    pub fn new(grid: Grid, equivalent_modulus: f64, reference: f64) -> Result<Self, InputError> {
        require_row(&grid, reference)?;
        InputError::require_positive("elastic.equivalent_modulus", equivalent_modulus)?;
        let coefficient = |offset: usize| {
            let x = grid.dx() * offset as f64;
            strip_displacement(x, 0.5 * grid.dx(), reference, 1.0, equivalent_modulus)
        };
        let kernel = |di: isize, _| coefficient(di.unsigned_abs());
        Ok(Self { near: std::array::from_fn(coefficient), response: ElasticResponse::new(grid, kernel) })
    }
}

/// Checks that `grid` has one row and that the reference distance \[m\] is at least its length.
pub(super) fn require_row(grid: &Grid, reference: f64) -> Result<(), InputError> {
    InputError::require(grid.ny() == 1, "grid.ny", grid.ny() as f64, "1 for a line contact")?;
    require_reference(grid, reference)
}

/// Checks that the reference distance \[m\] is at least the length of `grid` along x.
pub(super) fn require_reference(grid: &Grid, reference: f64) -> Result<(), InputError> {
    InputError::require(
        reference.is_finite() && reference >= grid.size_x(),
        "reference",
        reference,
        "finite and not below the length of the row",
    )
}

impl DeformationModel for LineHalfSpace {
    fn grid(&self) -> Grid {
        self.response.grid
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.displacement(pressure, out)
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        if dj == 0 { self.near.get(di).copied().unwrap_or(0.0) } else { 0.0 }
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        Some(self)
    }
}

impl ResponseApproximations for LineHalfSpace {
    fn displacement_single(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.displacement_single(pressure, out)
    }

    fn pressure_estimate(&mut self, displacement: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.pressure_estimate(displacement, out)
    }

    fn set_mean_compliance(&mut self, compliance: f64) {
        self.response.set_mean_compliance(compliance);
    }
}
