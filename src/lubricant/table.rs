//! Tabulated lubricant: reduced pressure and density as smooth functions of pressure.

use super::{DensityLaw, ViscosityLaw};

/// Width of a table interval \[Pa\].
const INTERVAL: f64 = 2.5e6;
/// One over it \[1/Pa\].
const PER_INTERVAL: f64 = 1.0 / INTERVAL;
/// Number of intervals: the table ends at 20.48 GPa.
const INTERVALS: usize = 8192;
/// Distance of the second and the fourth Lobatto point from the middle of (0, 1), `sqrt(3/7)/2`.
const INNER: f64 = 0.327_326_835_353_988_57;
/// Lobatto points inside an interval.
const INSIDE: [f64; 3] = [0.5 - INNER, 0.5, 0.5 + INNER];

/// Properties of a lubricant at one pressure, as the Reynolds equation needs them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FluidPoint {
    /// Reduced pressure `q = integral from 0 to p of (rho/rho_0) (eta_0/eta) dp` \[Pa\].
    pub reduced_pressure: f64,
    /// `dq/dp = (rho/rho_0) (eta_0/eta)`.
    pub reduced_slope: f64,
    /// `d2q/dp2` \[1/Pa\].
    pub reduced_curvature: f64,
    /// Density ratio `rho/rho_0`.
    pub density: f64,
    /// Its slope \[1/Pa\].
    pub density_slope: f64,
}

/// Piecewise polynomials, `INTERVAL` apart; linear beyond the last.
///
/// The slope of the reduced pressure is the quartic through the laws at the five Lobatto points of the
/// interval, and the reduced pressure its integral. Both are thereby consistent to rounding, and the slope
/// keeps its digits where the reduced pressure saturates. A smooth error of the slope would do no harm; one
/// that changes within each interval leaves a residual in every cell, as the balance of a cell is the small
/// difference of large flows.
#[derive(Clone)]
pub(super) struct FluidTable {
    pieces: Vec<Piece>,
}

/// One interval, with `t` in 0..1 along it.
#[derive(Debug, Clone, Copy)]
struct Piece {
    /// Reduced pressure: coefficients of 1, t, ..., t^5.
    reduced: [f64; 6],
    /// Density ratio: coefficients of 1, t, t^2, t^3.
    density: [f64; 4],
}

/// The polynomial that begins with `value` and whose slope over the interval is the quartic through `slopes`
/// at the Lobatto points.
fn integral_of_quartic(value: f64, slopes: [f64; 5]) -> [f64; 6] {
    let [first, second, middle, fourth, last] = slopes;
    // The quartic about the middle: its even and its odd part are found apart.
    let even = [0.5 * (first + last) - middle, 0.5 * (second + fourth) - middle];
    let odd = [0.5 * (last - first), 0.5 * (fourth - second) / INNER];
    let square = (49.0 * even[1] - 9.0 * even[0]) / 3.0;
    let fourth_power = 28.0 * even[0] - 196.0 / 3.0 * even[1];
    let cube = 14.0 * odd[0] - 7.0 * odd[1];
    let linear = 1.75 * odd[1] - 1.5 * odd[0];
    // The same about the beginning, integrated.
    [
        value,
        first,
        (linear - square + 0.75 * cube - 0.5 * fourth_power) / 2.0,
        (square - 1.5 * cube + 1.5 * fourth_power) / 3.0,
        (cube - 2.0 * fourth_power) / 4.0,
        fourth_power / 5.0,
    ]
}

/// The cubic with these values at the ends of the interval and these slopes over it.
fn hermite(values: [f64; 2], slopes: [f64; 2]) -> [f64; 4] {
    let ([first, last], [start, end]) = (values, slopes);
    let rise = last - first;
    [first, start, 3.0 * rise - 2.0 * start - end, start + end - 2.0 * rise]
}

impl Piece {
    #[inline]
    fn at(&self, t: f64) -> FluidPoint {
        let [q0, q1, q2, q3, q4, q5] = self.reduced;
        let [r0, r1, r2, r3] = self.density;
        FluidPoint {
            reduced_pressure: q0 + t * (q1 + t * (q2 + t * (q3 + t * (q4 + t * q5)))),
            reduced_slope: (q1 + t * (2.0 * q2 + t * (3.0 * q3 + t * (4.0 * q4 + t * (5.0 * q5)))))
                * PER_INTERVAL,
            reduced_curvature: (2.0 * q2 + t * (6.0 * q3 + t * (12.0 * q4 + t * (20.0 * q5))))
                * (PER_INTERVAL * PER_INTERVAL),
            density: r0 + t * (r1 + t * (r2 + t * r3)),
            density_slope: (r1 + t * (2.0 * r2 + t * (3.0 * r3))) * PER_INTERVAL,
        }
    }

    /// The straight lines that go on at the end.
    fn tail(&self) -> Self {
        let FluidPoint { reduced_pressure, reduced_slope, density, density_slope, .. } = self.at(1.0);
        Self {
            reduced: [reduced_pressure, reduced_slope * INTERVAL, 0.0, 0.0, 0.0, 0.0],
            density: [density, density_slope * INTERVAL, 0.0, 0.0],
        }
    }
}

impl std::fmt::Debug for FluidTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FluidTable").field("intervals", &self.pieces.len()).finish_non_exhaustive()
    }
}

/// The values with which a law fills a slice for these pressures.
fn filled(pressure: &[f64], fill: impl Fn(&[f64], &mut [f64])) -> Vec<f64> {
    let mut values = vec![0.0; pressure.len()];
    fill(pressure, &mut values);
    values
}

impl FluidTable {
    /// The table of two laws, evaluated at the ends of the intervals and at three points inside each.
    pub(super) fn new(viscosity: &dyn ViscosityLaw, density: &dyn DensityLaw) -> Self {
        let start = |i: usize| i as f64 * INTERVAL;
        let ends: Vec<f64> = (0..=INTERVALS).map(start).collect();
        let inside: Vec<f64> = (0..INTERVALS).flat_map(|i| INSIDE.map(|t| start(i) + t * INTERVAL)).collect();
        let ratios = filled(&ends, |p, out| density.fill(p, out));
        let ratio_slopes = filled(&ends, |p, out| density.fill_slopes(p, out));
        let viscosities = filled(&ends, |p, out| viscosity.fill(p, out));
        let ambient = viscosities[0];
        // Increase of the reduced pressure over an interval at these slopes.
        let increases = |ratios: &[f64], viscosities: &[f64]| -> Vec<f64> {
            ratios.iter().zip(viscosities).map(|(ratio, eta)| ratio * ambient / eta * INTERVAL).collect()
        };
        let at_ends = increases(&ratios, &viscosities);
        let at_inside = increases(
            &filled(&inside, |p, out| density.fill(p, out)),
            &filled(&inside, |p, out| viscosity.fill(p, out)),
        );
        let mut pieces = Vec::with_capacity(INTERVALS + 1);
        let mut reduced = 0.0;
        for (i, inside) in at_inside.chunks_exact(INSIDE.len()).enumerate() {
            let slopes = [at_ends[i], inside[0], inside[1], inside[2], at_ends[i + 1]];
            let piece = Piece {
                reduced: integral_of_quartic(reduced, slopes),
                density: hermite(
                    [ratios[i], ratios[i + 1]],
                    [ratio_slopes[i] * INTERVAL, ratio_slopes[i + 1] * INTERVAL],
                ),
            };
            reduced = piece.at(1.0).reduced_pressure;
            pieces.push(piece);
        }
        pieces.push(pieces[INTERVALS - 1].tail());
        Self { pieces }
    }

    /// Values and slopes by the polynomials of the interval, linear above the last.
    #[inline]
    pub(super) fn at(&self, pressure: f64) -> FluidPoint {
        let position = pressure.max(0.0) * PER_INTERVAL;
        // A cast of a number that is too large or NaN saturates.
        let i = (position as usize).min(INTERVALS);
        self.pieces[i].at(position - i as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lubricant::{Barus, DowsonHigginson, Incompressible, Roelands};

    #[test]
    fn values_and_slopes_are_those_of_the_laws_between_the_nodes() {
        let viscosity = Roelands::new(0.004, 0.68, 1.96e8).unwrap();
        let density = DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap();
        let table = FluidTable::new(&viscosity, &density);
        let slope = |p: f64| density.ratio(p) * 0.004 / viscosity.viscosity(p);
        for p in [0.0, 1.1e6, 2.5e6, 3.3e7, 4.1e8, 1.15e9, 1.7e9] {
            let point = table.at(p);
            assert!((point.reduced_slope / slope(p) - 1.0).abs() < 1e-11, "slope at {p:e}");
            assert!((point.density / density.ratio(p) - 1.0).abs() < 1e-10, "density at {p:e}");
            assert!((point.density_slope / density.slope(p) - 1.0).abs() < 1e-5, "its slope at {p:e}");
        }
        // Simpson's rule in steps of 10 kPa.
        let sum: f64 = (0..10_000)
            .map(|i| f64::from(i) * 1e4)
            .fold(0.0, |sum, p| sum + (slope(p) + 4.0 * slope(p + 5e3) + slope(p + 1e4)) * 1e4 / 6.0);
        assert!((table.at(1e8).reduced_pressure / sum - 1.0).abs() < 1e-12);
    }

    /// `q = (1 - exp(-alpha p))/alpha`, at the largest coefficient of real oils.
    #[test]
    fn reduced_pressure_of_barus_is_its_closed_form() {
        let alpha = 40e-9;
        let table = FluidTable::new(&Barus::new(0.1, alpha).unwrap(), &Incompressible);
        for step in 1..4000 {
            let p = f64::from(step) * 0.137e6;
            let point = table.at(p);
            let (exact, slope) = (-(-alpha * p).exp_m1() / alpha, (-alpha * p).exp());
            // The slope errs by `(alpha I/2)^5/5!` times the largest product of distances from the Lobatto points, 0.0941:
            // 2.45e-10. The reduced pressure is exact at the ends of pieces and off by its integral between them.
            let bound = 1e-12 * exact + 2.5e-10 * INTERVAL;
            assert!((point.reduced_pressure - exact).abs() < bound, "q at {p:e}");
            assert!((point.reduced_slope / slope - 1.0).abs() < 2.5e-10, "slope at {p:e}");
            assert!((point.reduced_curvature / (-alpha * slope) - 1.0).abs() < 1e-7, "curvature at {p:e}");
        }
    }

    #[test]
    fn goes_on_straight_beyond_its_end_and_takes_any_number() {
        let table = FluidTable::new(
            &Roelands::new(0.04, 0.6, 1.96e8).unwrap(),
            &DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
        );
        let end = INTERVALS as f64 * INTERVAL;
        let (a, b, c) = (table.at(end), table.at(2.0 * end), table.at(3.0 * end));
        let (first, second) =
            (b.reduced_pressure - a.reduced_pressure, c.reduced_pressure - b.reduced_pressure);
        assert!((first - second).abs() <= 1e-9 * a.reduced_pressure);
        assert_eq!(table.at(-1e9), table.at(0.0));
        for p in [1e300, f64::INFINITY, f64::NAN] {
            let _ = table.at(p);
        }
    }
}
