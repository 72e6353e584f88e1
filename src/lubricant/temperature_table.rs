//! Viscosity and density at film temperatures, relative to the laws at the bulk temperature.

use super::{DensityLaw, ViscosityLaw};

/// Pressure interval \[Pa\] and number of intervals: the table ends at 20.48 GPa.
const INTERVAL: f64 = 1e7;
const INTERVALS: usize = 2048;
/// Temperature interval \[K\] and number of temperatures.
const STEP: f64 = 10.0;
const LEVELS: usize = 64;
/// Lowest temperature of the table below that of the laws \[K\].
const BELOW: f64 = 30.0;
/// Lowest temperature at which laws are evaluated \[K\].
pub(crate) const LEAST_TEMPERATURE: f64 = 1.0;
/// Temperatures per interpolation.
const POINTS: usize = 4;
/// Bisections to the saturation pressure of a viscosity.
const HALVINGS: usize = 60;

/// Logarithmic ratios of viscosity and density to those of the laws: cubic in temperature over 10 K, and in
/// pressure over 10 MPa. The range is 20 K below to 590 K above the temperature of the laws; other
/// temperatures are clamped to it. Above the pressure at which the viscosity saturates ([`Saturating`]) the
/// ratios are constant.
#[derive(Clone)]
pub(super) struct TemperatureTable {
    /// Temperature of the laws \[K\].
    pub(super) bulk: f64,
    /// Volumetric expansivity \[1/K\], for a density without temperature dependence.
    pub(super) expansivity: f64,
    /// Logarithmic viscosity ratios, with the temperatures of a pressure contiguous.
    viscosity: Vec<f64>,
    /// Logarithmic density ratios.
    density: Vec<f64>,
}

impl std::fmt::Debug for TemperatureTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TemperatureTable").field("bulk", &self.bulk).finish_non_exhaustive()
    }
}

/// Interpolation in temperature: the first entry and the weights.
#[derive(Debug, Clone, Copy)]
struct Level {
    /// Index of the first entry.
    first: usize,
    /// Lagrange weights of the entries; their sum is one.
    weights: [f64; POINTS],
}

/// Film temperatures at a node, for viscosity and density.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NodeTemperature {
    /// Temperature of the effective viscosity of pressure flow.
    viscosity: Level,
    /// Temperature of the density, the mean across the film.
    density: Level,
}

/// Viscosity and density of a film relative to those of the laws, with the pressure derivatives of their
/// logarithms \[1/Pa\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct ThermalRatios {
    /// `eta(p, T) / eta(p, T_bulk)`.
    pub(crate) viscosity: f64,
    /// Its logarithmic slope \[1/Pa\].
    pub(crate) viscosity_slope: f64,
    /// `rho(p, T) / rho(p, T_bulk)`.
    pub(crate) density: f64,
    /// Its logarithmic slope \[1/Pa\].
    pub(crate) density_slope: f64,
}

impl TemperatureTable {
    /// The table of laws at the temperature `bulk` \[K\]. A viscosity without temperature dependence has
    /// ratios of one; a density without it follows `expansivity` \[1/K\]. Each law is evaluated once per
    /// entry, about 130 000 times.
    pub(super) fn new(
        viscosity: &dyn ViscosityLaw,
        density: &dyn DensityLaw,
        bulk: f64,
        expansivity: f64,
    ) -> Self {
        let end = Saturating::new(viscosity).end;
        let pressures: Vec<f64> = (0..=INTERVALS).map(|i| (i as f64 * INTERVAL).min(end)).collect();
        let mut table = Self {
            bulk,
            expansivity,
            viscosity: vec![0.0; pressures.len() * LEVELS],
            density: vec![0.0; pressures.len() * LEVELS],
        };
        let (mut cool, mut warm) = (vec![0.0; pressures.len()], vec![0.0; pressures.len()]);
        viscosity.fill(&pressures, &mut cool);
        for level in 0..LEVELS {
            let temperature = (bulk - BELOW + STEP * level as f64).max(LEAST_TEMPERATURE);
            if let Some(law) = viscosity.at_temperature(temperature) {
                law.fill(&pressures, &mut warm);
                for (i, (warm, cool)) in warm.iter().zip(&cool).enumerate() {
                    table.viscosity[i * LEVELS + level] = (warm / cool).ln();
                }
            }
            for (i, &pressure) in pressures.iter().enumerate() {
                let known = density.ratio_at(pressure, temperature);
                let ratio = known.map(|ratio| (ratio / density.ratio(pressure)).ln());
                table.density[i * LEVELS + level] = ratio.unwrap_or(expansivity * (bulk - temperature));
            }
        }
        table
    }

    /// Interpolation data of a film with the temperatures `flow` \[K\] for viscosity and `mean` \[K\] for
    /// density; any finite values, clamped to the range of the table.
    pub(super) fn node(&self, flow: f64, mean: f64) -> NodeTemperature {
        let level = |temperature: f64| {
            let position = (temperature - self.bulk + BELOW) / STEP;
            let position = position.clamp(1.0, (LEVELS - 3) as f64);
            let first = (position as usize).min(LEVELS - 4 + 1) - 1;
            Level { first, weights: lagrange(position - first as f64) }
        };
        NodeTemperature { viscosity: level(flow), density: level(mean) }
    }

    /// Ratios of a film at `pressure` \[Pa\], clamped to the range of the table. They are continuous; their
    /// slopes jump between intervals.
    #[inline]
    pub(super) fn at(&self, node: &NodeTemperature, pressure: f64) -> ThermalRatios {
        let position = (pressure.max(0.0) / INTERVAL).min(INTERVALS as f64);
        let first = (position as usize).clamp(1, INTERVALS + 2 - POINTS) - 1;
        let t = position - first as f64;
        let (weights, slopes) = (lagrange(t), lagrange_slopes(t));
        let value = |field: &[f64], level: &Level| {
            let (mut logarithm, mut slope) = (0.0, 0.0);
            for (row, (weight, by_position)) in weights.iter().zip(slopes).enumerate() {
                let start = (first + row) * LEVELS + level.first;
                let entries = field[start..start + POINTS].iter().zip(level.weights);
                let entry: f64 = entries.map(|(entry, weight)| entry * weight).sum();
                logarithm += weight * entry;
                slope += by_position * entry;
            }
            (logarithm.exp(), slope / INTERVAL)
        };
        let (viscosity, viscosity_slope) = value(&self.viscosity, &node.viscosity);
        let (density, density_slope) = value(&self.density, &node.density);
        ThermalRatios { viscosity, viscosity_slope, density, density_slope }
    }
}

/// Lagrange polynomials through 0, 1, 2 and 3, at `t`.
#[inline]
fn lagrange(t: f64) -> [f64; POINTS] {
    let [a, b, c, d] = [t, t - 1.0, t - 2.0, t - 3.0];
    [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0]
}

/// Slopes of the polynomials.
#[inline]
fn lagrange_slopes(t: f64) -> [f64; POINTS] {
    let [a, b, c, d] = [t, t - 1.0, t - 2.0, t - 3.0];
    [
        -(c * d + b * d + b * c) / 6.0,
        (c * d + a * d + a * c) / 2.0,
        -(b * d + a * d + a * b) / 2.0,
        (b * c + a * c + a * b) / 6.0,
    ]
}

/// A viscosity law at any temperature with a common saturation pressure: above the pressure at which the law
/// reaches its largest value, the viscosity at other temperatures is constant too. Otherwise the ratio of
/// viscosities would jump by orders of magnitude where one of them saturates before the other.
#[derive(Debug)]
pub(crate) struct Saturating<'a> {
    /// The law at the bulk temperature.
    law: &'a dyn ViscosityLaw,
    /// Saturation pressure \[Pa\].
    end: f64,
}

impl<'a> Saturating<'a> {
    /// Computes the saturation pressure of `law` by bisection.
    pub(crate) fn new(law: &'a dyn ViscosityLaw) -> Self {
        let last = INTERVAL * INTERVALS as f64;
        let most = law.viscosity(last);
        let (mut below, mut end) = (0.0, last);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (below + end);
            if law.viscosity(middle) < most {
                below = middle;
            } else {
                end = middle;
            }
        }
        Self { law, end }
    }
}

impl ViscosityLaw for Saturating<'_> {
    fn viscosity(&self, pressure: f64) -> f64 {
        self.law.viscosity(pressure)
    }

    fn viscosity_at(&self, pressure: f64, temperature: f64) -> Option<f64> {
        self.law.viscosity_at(pressure.min(self.end), temperature)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lubricant::{DowsonHigginson, Roelands, ThermalRoelands};

    #[test]
    fn ratios_match_the_laws_and_their_slopes() {
        let law = ThermalRoelands::new(Roelands::new(0.04, 0.68, 1.96e8).unwrap(), 313.15, 1.1).unwrap();
        let density = DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap();
        let table = TemperatureTable::new(&law, &density, 313.15, 6.5e-4);
        for temperature in [300.0, 313.15, 317.0, 361.3, 480.0] {
            let node = table.node(temperature, temperature);
            for pressure in [0.0, 3e6, 2.1e8, 1.234e9] {
                let exact = |p: f64| (law.viscosity_at(p, temperature).unwrap() / law.viscosity(p)).ln();
                let at = table.at(&node, pressure);
                let error = (at.viscosity.ln() - exact(pressure)).abs();
                assert!(error < 1e-3, "{temperature} K, {pressure:e} Pa: {error:e}");
                let slope = (exact(pressure + 1e6) - exact((pressure - 1e6).max(0.0))) / 2e6;
                assert!(pressure == 0.0 || (at.viscosity_slope - slope).abs() < 0.03 * slope.abs() + 1e-13);
                assert!((at.density / (-6.5e-4 * (temperature - 313.15)).exp() - 1.0).abs() < 1e-13);
                assert!(at.density_slope.abs() < 1e-20);
            }
        }
        // At a temperature of the table the error is that between pressures, which leaves residuals in cells.
        let node = table.node(333.15, 333.15);
        for pressure in [4e6, 1.06e8, 2.15e8, 9.333e8] {
            let exact = (law.viscosity_at(pressure, 333.15).unwrap() / law.viscosity(pressure)).ln();
            let error = (table.at(&node, pressure).viscosity.ln() - exact).abs();
            assert!(error < 3e-7, "{pressure:e} Pa: {error:e}");
        }
        let (cool, far) = (table.node(313.15, 313.15), table.node(1e9, -1e9));
        assert!((table.at(&cool, 5e8).viscosity - 1.0).abs() < 1e-14);
        assert!(table.at(&far, 1e300).viscosity > 0.0 && table.at(&far, 0.0).density.is_finite());
        // Ratios are constant above the saturation pressure.
        let node = table.node(360.0, 360.0);
        let [near, far] = [1e10, 1.9e10].map(|pressure| table.at(&node, pressure).viscosity.to_bits());
        assert_eq!(near, far);
    }
}
