//! Steady surface temperature of a half-space under a moving heat source.
//!
//! The steady temperature of a moving point source has the kernel of Carslaw and Jaeger. It is integrated
//! over cells, in closed form for a body at rest. `flash_temperature` sums the coefficients by convolution.

use std::f64::consts::PI;

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
                table.push(scale * cell_integral(x, dj as f64 * dy, [0.5 * dx, 0.5 * dy], decay));
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
/// Distance along y, in half sides of a cell, beyond which four points represent the cell.
const FAR: f64 = 16.0;
/// Exponent of the decay beyond which heat does not arrive: `e^-40` is below rounding.
const NO_HEAT: f64 = 40.0;

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
            if source.is_cold(*x, source.near() - source.period) {
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

    /// Whether no heat arrives from a cell at `x` and at least the distance `y` along y.
    fn is_cold(&self, x: f64, y: f64) -> bool {
        let (x, y) = (x + self.half[0], (y - self.half[1]).max(0.0));
        self.decay * lag(x, y, x.hypot(y)) > NO_HEAT
    }

    /// Integrals of all columns at an offset of `dj` rows.
    fn row(&self, dj: usize) -> Vec<f64> {
        let Self { half: [half_x, half_y], period, decay, .. } = *self;
        let y = 2.0 * half_y * dj as f64;
        let columns = self.columns.iter().zip(&self.length).map(|(&x, &length)| {
            let images: f64 =
                (-NEAR_PERIODS..=NEAR_PERIODS).map(|q| self.image(x, y + f64::from(q) * period)).sum();
            let beyond =
                if length > 0.0 { length - cell_integral(x, y, [half_x, self.near()], decay) } else { 0.0 };
            images + 2.0 * half_y / period * beyond
        });
        columns.collect()
    }

    /// Integral over the cell at `(x, y)`; of a far one by Gauss' rule with two points along each axis.
    fn image(&self, x: f64, y: f64) -> f64 {
        let [half_x, half_y] = self.half;
        if self.is_cold(x, y.abs()) {
            return 0.0;
        }
        if y.abs() < FAR * half_x.max(half_y) {
            return cell_integral(x, y, self.half, self.decay);
        }
        let at = 1.0 / 3.0_f64.sqrt();
        let points = [[-at, -at], [-at, at], [at, -at], [at, at]].map(|[s, t]| {
            let (x, y) = (x + s * half_x, y + t * half_y);
            let radius = x.hypot(y);
            (-self.decay * lag(x, y, radius)).exp() / radius
        });
        points.iter().sum::<f64>() * half_x * half_y
    }
}

/// Integral of `exp[-decay (r - x)] / r` over the rectangle centred on `(x, y)` with half sides `half`.
///
/// In polar coordinates the radial integral is `R phi(decay (R - x))`, `phi(s) = (1 - e^-s)/s`, at the
/// boundary of the cell. One regular integral remains for each side, signed by its distance `d` from the
/// origin. With `t = |d| sinh(u)` along the side it is `d int phi du`, exact for a body at rest and without
/// singularity.
fn cell_integral(x: f64, y: f64, half: [f64; 2], decay: f64) -> f64 {
    let (x0, x1, y0, y1) = (x - half[0], x + half[0], y - half[1], y + half[1]);
    let vertical = |d: f64| side(d, [y0, y1], |t, radius| phi(decay * lag(d, t, radius)));
    let horizontal = |d: f64| side(d, [x0, x1], |t, radius| phi(decay * lag(t, d, radius)));
    vertical(x1) - vertical(x0) + horizontal(y1) - horizontal(y0)
}

/// `d int f(t, R)/R dt` along a side at signed distance `d`, `R^2 = d^2 + t^2`.
fn side(d: f64, ends: [f64; 2], f: impl Fn(f64, f64) -> f64) -> f64 {
    let distance = d.abs();
    if distance <= 0.0 {
        return 0.0;
    }
    let along = |u: f64| {
        let growing = u.exp();
        let t = 0.5 * distance * (growing - 1.0 / growing);
        f(t, t.hypot(distance))
    };
    d * adaptive(&along, (ends[0] / distance).asinh(), (ends[1] / distance).asinh(), MAX_DEPTH)
}

/// `r - x` without cancellation downstream.
fn lag(x: f64, y: f64, radius: f64) -> f64 {
    if x > 0.0 { y * y / (radius + x) } else { radius - x }
}

/// `(1 - e^-s)/s`.
fn phi(s: f64) -> f64 {
    if s < 1e-12 { 1.0 } else { -(-s).exp_m1() / s }
}

/// Largest recursion depth of the quadrature.
const MAX_DEPTH: usize = 14;
/// Accepted difference of the two rules, relative to the length of the interval (integrands are at most 1).
const QUADRATURE_TOLERANCE: f64 = 1e-10;

/// Nodes and weights of the Gauss (7) and Kronrod (15) pair: node, Kronrod weight, Gauss weight.
const RULE: [(f64, f64, f64); 8] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0),
    (0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_67),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
    (0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4),
];

/// Adaptive Gauss-Kronrod quadrature of `f` from `a` to `b`.
fn adaptive(f: &impl Fn(f64) -> f64, a: f64, b: f64, depth: usize) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let (mut fine, mut coarse) = (0.0, 0.0);
    for (node, kronrod, gauss) in RULE {
        let value = if node > 0.0 { f(middle - half * node) + f(middle + half * node) } else { f(middle) };
        fine += kronrod * value;
        coarse += gauss * value;
    }
    if depth == 0 || (fine - coarse).abs() <= QUADRATURE_TOLERANCE {
        half * fine
    } else {
        adaptive(f, a, middle, depth - 1) + adaptive(f, middle, b, depth - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resting_cell_matches_the_closed_form() {
        let expected = 8.0 * 0.5 * 1.0_f64.asinh();
        assert!((cell_integral(0.0, 0.0, [0.5, 0.5], 0.0) - expected).abs() < 1e-14);
        let far = cell_integral(300.0, 40.0, [0.5, 0.5], 0.0);
        let monopole = 1.0 / 300.0_f64.hypot(40.0);
        assert!((far / monopole - 1.0).abs() < 1e-6, "{far} {monopole}");
    }

    /// Compared with midpoint sums on a fine mesh away from the singular point.
    #[test]
    fn moving_cell_matches_a_fine_sum() {
        for decay in [0.1, 3.0, 50.0] {
            for (x, y) in [(2.0, 0.0), (2.0, 1.0), (-2.0, 1.0), (0.0, 1.0), (30.0, 2.0)] {
                let n = 800;
                let mut sum = 0.0;
                for j in 0..n {
                    for i in 0..n {
                        let xs: f64 = x - 0.5 + (i as f64 + 0.5) / n as f64;
                        let ys: f64 = y - 0.5 + (j as f64 + 0.5) / n as f64;
                        let r = xs.hypot(ys);
                        sum += (-decay * lag(xs, ys, r)).exp() / r;
                    }
                }
                sum /= (n * n) as f64;
                let found = cell_integral(x, y, [0.5, 0.5], decay);
                assert!((found - sum).abs() < 1e-4 * sum + 1e-9, "{decay} {x} {y}: {found} {sum}");
            }
        }
    }

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

    /// The integral is additive over the quarters of a cell.
    #[test]
    fn quarters_add_up_to_the_cell_under_the_node() {
        for decay in [0.0, 0.5, 20.0, 400.0] {
            let whole = cell_integral(0.1, 0.2, [0.5, 0.5], decay);
            let mut parts = 0.0;
            for (i, j) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
                parts += cell_integral(0.1 + 0.25 * i, 0.2 + 0.25 * j, [0.25, 0.25], decay);
            }
            assert!((whole / parts - 1.0).abs() < 1e-8, "{decay}: {whole} {parts}");
        }
    }
}
