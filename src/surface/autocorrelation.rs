//! Autocorrelation functions of random surfaces.

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
