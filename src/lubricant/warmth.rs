//! Viscosity and density of films that are warmer than the law, by pressure and temperature.

use super::{DensityLaw, ViscosityLaw};

/// Pressure between entries \[Pa\], and how many intervals there are: the table ends at 20.48 GPa.
const INTERVAL: f64 = 1e7;
const INTERVALS: usize = 2048;
/// Temperature between entries \[K\], and how many there are.
const STEP: f64 = 10.0;
const LEVELS: usize = 64;
/// The lowest entry below the temperature of the law \[K\].
const BELOW: f64 = 30.0;
/// Least temperature that a law is asked for \[K\].
pub(crate) const LEAST_TEMPERATURE: f64 = 1.0;
/// Entries that a value is interpolated from.
const POINTS: usize = 4;
/// Halvings to the pressure at which a viscosity ends.
const HALVINGS: usize = 60;

/// Logarithms of viscosity and of density at other temperatures over those of the laws: cubic in temperature,
/// 10 K apart, straight in pressure, 10 MPa apart. Temperatures from 20 K below that of the laws to 590 K
/// above it; further ones count as these. Beyond the pressure at which the viscosity ends
/// ([`Saturating`]) all stays as it is there.
#[derive(Clone)]
pub(super) struct WarmTable {
    /// Temperature of the laws \[K\].
    pub(super) bulk: f64,
    /// Thermal expansion of the volume \[1/K\] of a density that does not know temperature.
    pub(super) expansivity: f64,
    /// Logarithms of the ratios of viscosity, temperatures of one pressure side by side.
    viscosity: Vec<f64>,
    /// Those of density.
    density: Vec<f64>,
}

impl std::fmt::Debug for WarmTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("WarmTable").field("bulk", &self.bulk).finish_non_exhaustive()
    }
}

/// A temperature in the table: the first of its entries and the weights of all.
#[derive(Debug, Clone, Copy)]
struct Level {
    /// The lowest of the entries.
    first: usize,
    /// Lagrange's weights of the entries, which add up to one.
    weights: [f64; POINTS],
}

/// The temperatures of the film at a node, for its viscosity and for its density.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NodeWarmth {
    /// That of its viscosity in the flow by pressure.
    viscosity: Level,
    /// That of its density, the mean across the film.
    density: Level,
}

/// Viscosity and density of a warm film over those of the laws, and the slopes of their logarithms by
/// pressure \[1/Pa\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct WarmPoint {
    /// `eta(p, T) / eta(p, T_bulk)`.
    pub(crate) viscosity: f64,
    /// `d ln/dp` of that \[1/Pa\].
    pub(crate) viscosity_slope: f64,
    /// `rho(p, T) / rho(p, T_bulk)`.
    pub(crate) density: f64,
    /// `d ln/dp` of that \[1/Pa\].
    pub(crate) density_slope: f64,
}

impl WarmTable {
    /// The table of laws that hold at the temperature `bulk` \[K\]. A viscosity that does not know temperature
    /// has ratios of one, a density that does not those of its `expansivity` \[1/K\]. Asks each law once an
    /// entry, some 130 000 times.
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

    /// A film of the temperature `flow` \[K\] for its viscosity and `mean` \[K\] for its density, any finite
    /// numbers: those beyond the table count as its first and last inner ones.
    pub(super) fn node(&self, flow: f64, mean: f64) -> NodeWarmth {
        let level = |temperature: f64| {
            let position = (temperature - self.bulk + BELOW) / STEP;
            let position = position.clamp(1.0, (LEVELS - 3) as f64);
            let first = (position as usize).min(LEVELS - 4 + 1) - 1;
            let t = position - first as f64;
            // Lagrange's polynomials through 0, 1, 2 and 3.
            let [a, b, c, d] = [t, t - 1.0, t - 2.0, t - 3.0];
            Level { first, weights: [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0] }
        };
        NodeWarmth { viscosity: level(flow), density: level(mean) }
    }

    /// Ratios of a film at `pressure` \[Pa\], any number: below zero as at zero, beyond the last entry as there.
    /// They are continuous, their slopes jump from interval to interval.
    #[inline]
    pub(super) fn at(&self, node: &NodeWarmth, pressure: f64) -> WarmPoint {
        let position = (pressure.max(0.0) / INTERVAL).min(INTERVALS as f64);
        let i = (position as usize).min(INTERVALS - 1);
        let t = position - i as f64;
        let value = |field: &[f64], level: &Level| {
            let sum = |row: usize| {
                let start = row * LEVELS + level.first;
                let entries = field[start..start + POINTS].iter().zip(level.weights);
                entries.map(|(entry, weight)| entry * weight).sum::<f64>()
            };
            let (below, above) = (sum(i), sum(i + 1));
            ((below + t * (above - below)).exp(), (above - below) / INTERVAL)
        };
        let (viscosity, viscosity_slope) = value(&self.viscosity, &node.viscosity);
        let (density, density_slope) = value(&self.density, &node.density);
        WarmPoint { viscosity, viscosity_slope, density, density_slope }
    }
}

/// A viscosity at any temperature up to the pressure at which that of the law ends, where it reaches its
/// largest value: beyond, warm films keep the viscosity that they have there. A ratio of viscosities would
/// otherwise jump by orders of magnitude where first one and then the other reaches its largest value.
#[derive(Debug)]
pub(crate) struct Saturating<'a> {
    /// The law at the temperature of the bulk.
    law: &'a dyn ViscosityLaw,
    /// That pressure \[Pa\].
    end: f64,
}

impl<'a> Saturating<'a> {
    /// A `law` as it holds at its temperature.
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
    fn ratios_are_those_of_the_laws_with_their_slopes() {
        let law = ThermalRoelands::new(Roelands::new(0.04, 0.68, 1.96e8).unwrap(), 313.15, 1.1).unwrap();
        let density = DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap();
        let table = WarmTable::new(&law, &density, 313.15, 6.5e-4);
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
        let (cool, far) = (table.node(313.15, 313.15), table.node(1e9, -1e9));
        assert!((table.at(&cool, 5e8).viscosity - 1.0).abs() < 1e-14);
        assert!(table.at(&far, 1e300).viscosity > 0.0 && table.at(&far, 0.0).density.is_finite());
        // Beyond the end of the law nothing changes any more.
        let node = table.node(360.0, 360.0);
        let [near, far] = [1e10, 1.9e10].map(|pressure| table.at(&node, pressure).viscosity.to_bits());
        assert_eq!(near, far);
    }
}
