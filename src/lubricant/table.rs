//! Tabulated lubricant: reduced pressure and density as smooth functions of pressure.

use super::{DensityLaw, ViscosityLaw};

/// Width of a table interval \[Pa\].
const INTERVAL: f64 = 2.5e6;
/// Number of intervals: the table ends at 20.48 GPa.
const INTERVALS: usize = 8192;
/// Abscissas of the three-point Gauss rule on (0, 1).
const ABSCISSAS: [f64; 3] = [0.112_701_665_379_258_3, 0.5, 0.887_298_334_620_741_7];
/// Its weights.
const WEIGHTS: [f64; 3] = [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0];

/// What the Reynolds equation needs to know of a lubricant at one pressure.
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

/// Piecewise cubics through exact values and slopes, `INTERVAL` apart; linear beyond the last.
///
/// The increments of the reduced pressure come from quadrature of the laws, so that slopes keep their digits
/// where the reduced pressure saturates.
#[derive(Clone)]
pub(super) struct FluidTable {
    /// Reduced pressure, one cubic an interval.
    reduced: Vec<Cubic>,
    /// Density ratio, one cubic an interval.
    density: Vec<Cubic>,
}

/// `value + t (a + t (b + t c))` with `t` in 0..1.
#[derive(Debug, Clone, Copy)]
struct Cubic {
    value: f64,
    a: f64,
    b: f64,
    c: f64,
}

impl Cubic {
    /// From the value at the start, the increment over the interval and the slopes at its ends times its
    /// width.
    fn hermite(value: f64, increment: f64, start: f64, end: f64) -> Self {
        Self { value, a: start, b: 3.0 * increment - 2.0 * start - end, c: start + end - 2.0 * increment }
    }

    #[inline]
    fn at(&self, t: f64) -> (f64, f64) {
        (
            self.value + t * (self.a + t * (self.b + t * self.c)),
            (self.a + t * (2.0 * self.b + t * 3.0 * self.c)) / INTERVAL,
        )
    }

    #[inline]
    fn curvature(&self, t: f64) -> f64 {
        (2.0 * self.b + t * 6.0 * self.c) / (INTERVAL * INTERVAL)
    }

    /// The straight line that goes on at the end.
    fn tail(&self) -> Self {
        let (value, slope) = self.at(1.0);
        Self { value, a: slope * INTERVAL, b: 0.0, c: 0.0 }
    }
}

impl std::fmt::Debug for FluidTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FluidTable").field("intervals", &self.reduced.len()).finish_non_exhaustive()
    }
}

impl FluidTable {
    /// The table of two laws, asked at the ends of the intervals and in between.
    pub(super) fn new(viscosity: &dyn ViscosityLaw, density: &dyn DensityLaw) -> Self {
        let filled = |pressure: &[f64], fill: &dyn Fn(&[f64], &mut [f64])| {
            let mut values = vec![0.0; pressure.len()];
            fill(pressure, &mut values);
            values
        };
        let start = |i: usize| i as f64 * INTERVAL;
        let nodes: Vec<f64> = (0..=INTERVALS).map(start).collect();
        let within: Vec<f64> =
            (0..INTERVALS).flat_map(|i| ABSCISSAS.map(|t| start(i) + t * INTERVAL)).collect();
        let ratios = filled(&nodes, &|p, out| density.fill(p, out));
        let ratio_slopes = filled(&nodes, &|p, out| density.fill_slopes(p, out));
        let viscosities = filled(&nodes, &|p, out| viscosity.fill(p, out));
        let ambient = viscosities[0];
        let reduced_slopes = |ratios: &[f64], viscosities: &[f64]| -> Vec<f64> {
            ratios.iter().zip(viscosities).map(|(ratio, eta)| ratio * ambient / eta).collect()
        };
        let at_nodes = reduced_slopes(&ratios, &viscosities);
        let inside = reduced_slopes(
            &filled(&within, &|p, out| density.fill(p, out)),
            &filled(&within, &|p, out| viscosity.fill(p, out)),
        );
        let mut table = Self { reduced: Vec::new(), density: Vec::new() };
        let mut reduced = 0.0;
        for (i, inside) in inside.chunks_exact(ABSCISSAS.len()).enumerate() {
            let mean: f64 = inside.iter().zip(WEIGHTS).map(|(slope, w)| w * slope).sum();
            let ends = |values: &[f64]| (values[i] * INTERVAL, values[i + 1] * INTERVAL);
            let (first, last) = ends(&at_nodes);
            table.reduced.push(Cubic::hermite(reduced, mean * INTERVAL, first, last));
            let (first, last) = ends(&ratio_slopes);
            table.density.push(Cubic::hermite(ratios[i], ratios[i + 1] - ratios[i], first, last));
            reduced += mean * INTERVAL;
        }
        let tails = (table.reduced[INTERVALS - 1].tail(), table.density[INTERVALS - 1].tail());
        table.reduced.push(tails.0);
        table.density.push(tails.1);
        table
    }

    /// Value and slopes by the cubic of the interval, linear above the last.
    #[inline]
    pub(super) fn at(&self, pressure: f64) -> FluidPoint {
        let position = pressure.max(0.0) / INTERVAL;
        // A cast of a number that is too large or not one saturates.
        let i = (position as usize).min(INTERVALS);
        let t = position - i as f64;
        let (reduced_pressure, reduced_slope) = self.reduced[i].at(t);
        let (density, density_slope) = self.density[i].at(t);
        let reduced_curvature = self.reduced[i].curvature(t);
        FluidPoint { reduced_pressure, reduced_slope, reduced_curvature, density, density_slope }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lubricant::{DowsonHigginson, Roelands};

    #[test]
    fn values_and_slopes_are_those_of_the_laws() {
        let viscosity = Roelands::new(0.004, 0.68, 1.96e8).unwrap();
        let density = DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap();
        let table = FluidTable::new(&viscosity, &density);
        let slope = |p: f64| density.ratio(p) * 0.004 / viscosity.viscosity(p);
        for p in [0.0, 1.1e6, 2.5e6, 3.3e7, 4.1e8, 1.15e9, 3.7e9] {
            let point = table.at(p);
            assert!((point.reduced_slope / slope(p) - 1.0).abs() < 1e-4, "slope at {p:e}");
            assert!((point.density / density.ratio(p) - 1.0).abs() < 1e-10, "density at {p:e}");
            assert!((point.density_slope / density.slope(p) - 1.0).abs() < 1e-5, "its slope at {p:e}");
        }
        // Simpson's rule in steps of 10 kPa.
        let sum: f64 = (0..10_000)
            .map(|i| f64::from(i) * 1e4)
            .fold(0.0, |sum, p| sum + (slope(p) + 4.0 * slope(p + 5e3) + slope(p + 1e4)) * 1e4 / 6.0);
        assert!((table.at(1e8).reduced_pressure / sum - 1.0).abs() < 1e-8);
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
