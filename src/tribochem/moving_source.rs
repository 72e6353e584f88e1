//! Steady surface temperature of a half-space under a moving heat source.
//!
//! The steady temperature of a moving point source has the kernel of Carslaw and Jaeger. It is integrated
//! over cells, in closed form for a body at rest. `flash_temperature` sums the coefficients by convolution.

use std::f64::consts::PI;

use super::cell_heat::{cell_integral, heat_of_cell, is_cold};
use crate::error::InputError;
use crate::grid::Grid;

/// Thermal properties of a body.
///
/// # Examples
///
/// ```
/// use stribeck::tribochem::ThermalBody;
/// assert_eq!(ThermalBody::default(), ThermalBody::STEEL);
/// let bad = ThermalBody { conductivity: 0.0, ..ThermalBody::STEEL };
/// assert!(bad.validate().unwrap_err().to_string().starts_with("conductivity"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThermalBody {
    /// Thermal conductivity \[W/(m K)\].
    pub conductivity: f64,
    /// Thermal diffusivity \[m^2/s\].
    pub diffusivity: f64,
}

impl ThermalBody {
    /// Bearing steel: 46 W/(m K), 1.27e-5 m^2/s.
    pub const STEEL: Self = Self { conductivity: 46.0, diffusivity: 1.27e-5 };

    /// Checks both properties.
    ///
    /// # Errors
    /// A property that is not finite and positive.
    pub fn validate(&self) -> Result<(), InputError> {
        InputError::require_positive("conductivity", self.conductivity)?;
        InputError::require_positive("diffusivity", self.diffusivity)
    }
}

impl Default for ThermalBody {
    fn default() -> Self {
        Self::STEEL
    }
}

/// Influence coefficients \[K m^2/W\] of uniformly heated cells, on a strip with their images along y: temperature at a node for a unit flux into
/// the cell at an offset, tabulated for `-nx < di < nx` and `0 <= dj < ny` (symmetric in y).
#[derive(Debug)]
pub(super) struct MovingSource {
    /// Columns of the grid.
    nx: usize,
    /// Rise by offset under a unit flux on one cell \[K m^2/W\].
    table: Vec<f64>,
}

impl MovingSource {
    /// Kernel `exp[-(|V| r - V x) / (2 kappa)] / (2 pi k r)` (Carslaw and Jaeger 1959), integrated over
    /// source cells, for a body whose surface moves at `speed` \[m/s\] along x.
    pub(super) fn new(grid: &Grid, body: ThermalBody, speed: f64) -> Self {
        let (nx, ny, dx, dy) = (grid.nx(), grid.ny(), grid.dx(), grid.dy());
        let decay = 0.5 * speed.abs() / body.diffusivity;
        let direction = if speed < 0.0 { -1.0 } else { 1.0 };
        let scale = 1.0 / (2.0 * PI * body.conductivity);
        let mut table = Vec::with_capacity((2 * nx - 1) * ny);
        if grid.is_strip() {
            let periodic = PeriodicSource::new(grid, decay, direction);
            let rows: Vec<Vec<f64>> = (0..=ny / 2).map(|dj| periodic.row(dj)).collect();
            for dj in 0..ny {
                table.extend(rows[dj.min(ny - dj)].iter().map(|integral| scale * integral));
            }
            return Self { nx, table };
        }
        for dj in 0..ny {
            for column in 0..2 * nx - 1 {
                let x = direction * (column as f64 - (nx - 1) as f64) * dx;
                table.push(scale * heat_of_cell(x, dj as f64 * dy, [0.5 * dx, 0.5 * dy], decay));
            }
        }
        Self { nx, table }
    }

    /// Coefficient at the offset of target less source, within the range of the table.
    pub(super) fn at(&self, di: isize, dj: isize) -> f64 {
        let column = (di + self.nx as isize - 1).unsigned_abs();
        self.table[dj.unsigned_abs() * (2 * self.nx - 1) + column]
    }
}

/// Images of a cell on each side of a strip that are summed one by one.
const NEAR_PERIODS: i32 = 8;
/// Half of the length over which a strip is heated \[m\], as a line contact is.
const HALF_LENGTH: f64 = 0.5;

/// Integrals over a cell of a strip and all of its images along y: near ones one by one, further ones as heat that is
/// uniform along y.
struct PeriodicSource {
    /// Half sides of a cell \[m\].
    half: [f64; 2],
    /// Period along y \[m\].
    period: f64,
    /// `|V| / (2 kappa)` \[1/m\].
    decay: f64,
    /// Positions of the columns downstream of the cell \[m\].
    columns: Vec<f64>,
    /// Integrals of all columns over the whole length; zero where heat does not arrive from beyond the near images.
    length: Vec<f64>,
}

impl PeriodicSource {
    /// For motion in this `direction` along x.
    fn new(grid: &Grid, decay: f64, direction: f64) -> Self {
        let (nx, half) = (grid.nx(), [0.5 * grid.dx(), 0.5 * grid.dy()]);
        let position = |column: usize| direction * (column as f64 - (nx - 1) as f64) * grid.dx();
        let columns = (0..2 * nx - 1).map(position).collect();
        let mut source = Self { half, period: grid.size_y(), decay, columns, length: Vec::new() };
        let reach = HALF_LENGTH.max(source.near());
        let whole = |x: &f64| {
            // The nearest heat beyond the images.
            if is_cold(*x, source.near() - source.period, half, decay) {
                0.0
            } else {
                cell_integral(*x, 0.0, [half[0], reach], decay)
            }
        };
        source.length = source.columns.iter().map(whole).collect();
        source
    }

    /// Half of the length along y that the images cover \[m\].
    fn near(&self) -> f64 {
        (f64::from(NEAR_PERIODS) + 0.5) * self.period
    }

    /// Integrals of all columns at an offset of `dj` rows.
    fn row(&self, dj: usize) -> Vec<f64> {
        let Self { half: [half_x, half_y], period, decay, .. } = *self;
        let y = 2.0 * half_y * dj as f64;
        let columns = self.columns.iter().zip(&self.length).map(|(&x, &length)| {
            let images: f64 = (-NEAR_PERIODS..=NEAR_PERIODS)
                .map(|q| heat_of_cell(x, y + f64::from(q) * period, self.half, decay))
                .sum();
            let beyond =
                if length > 0.0 { length - cell_integral(x, y, [half_x, self.near()], decay) } else { 0.0 };
            images + 2.0 * half_y / period * beyond
        });
        columns.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip sums the images of a cell along y: slow and fast bodies beside the plain sum of many images. Heat that is
    /// uniform along y beyond 8.5 periods errs by a twelfth of the slope there, `1/(12 * 8.5^2)` in units in which the cell
    /// itself has about 30.
    #[test]
    fn strip_coefficients_are_sums_of_images() {
        let grid = Grid::strip(8, 6, [-4e-5, 4e-5], [-3e-5, 3e-5]).unwrap();
        for speed in [-0.02, 0.3, 4.0] {
            let source = MovingSource::new(&grid, ThermalBody::STEEL, speed);
            let decay = 0.5 * f64::abs(speed) / ThermalBody::STEEL.diffusivity;
            for (di, dj) in [(0, 0), (5, 1), (-6, 2), (7, 2)] {
                let x = f64::signum(speed) * di as f64 * 1e-5;
                let images = (-8333..=8333_i32)
                    .map(|q| cell_integral(x, dj as f64 * 1e-5 + f64::from(q) * 6e-5, [5e-6; 2], decay));
                let expected = images.sum::<f64>() / (2.0 * PI * ThermalBody::STEEL.conductivity);
                let found = source.at(di, dj);
                let error = (found - expected).abs() / source.at(0, 0);
                assert!(error < 5e-5, "{speed} {di} {dj}: {found} {expected}");
            }
        }
    }
}
