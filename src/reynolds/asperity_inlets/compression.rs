//! Fluid pressure at the front edge of an asperity by the rise of the reduced pressure in its inlet, with the density.

use super::flank::WHOLE_INLET;
use crate::lubricant::Lubricant;

/// Number of tabulated pressures.
const PRESSURES: usize = 96;
/// Lowest tabulated pressure over the largest; lower ones are proportional to the rise.
const LOWEST: f64 = 1e-4;
/// Steps along the flank.
const STEPS: usize = 240;
/// Ends of the flank, as roots of its gap over the contact film to the power 2/3. Beyond the far end are 6e-7 of the
/// integral, within the near end 1e-9.
const FLANK: [f64; 2] = [30.0, 0.02];
/// Relative error of a tabulated rise; interpolation between the rises adds 2e-3.
const RISE_TOLERANCE: f64 = 1e-8;
/// Elongation of the inlet of an elastic edge by the largest reduced pressure over the pressure behind the edge. Resolved line
/// contacts of smooth bodies whose ratio is 0.055, 0.074, 0.087, 0.12 and 0.25 have elongations of 0.066, 0.084, 0.11, 0.16 and 0.31
/// where they float.
const ELONGATION: f64 = 1.25;
/// Largest number of turns to an edge pressure.
const MAX_TURNS: usize = 50;
/// Largest number of secant steps to a rise.
const SECANT_STEPS: usize = 60;

/// The pressure at the front edge over the rise that an incompressible fluid would have in the same inlet.
///
/// In a flank `h = h_1 (1 + y^1.5)` the reduced pressure increases by
/// `dq = K (r h/h_1 - r_1)/(h/h_1)^3 dy` (`r` the density ratio, `r_1` that at the edge). For each pressure at the edge
/// the table holds the `K` with which `q` increases from zero to the reduced pressure there, times the limit of the
/// inlet integral.
///
/// The pressure of the fluid moves the edge of an elastic contact downstream, which makes the inlet longer: its rise is
/// `1 + 1.25 q_m/p_l (q/q_m)^5` times that of the dry flank. `q_m` is the largest reduced pressure and `p_l` the pressure of the
/// dry contact one flank length behind its edge.
#[derive(Debug, Default)]
pub(super) struct EdgePressures {
    /// Pressures at the edge, ascending \[Pa\].
    pressure: Vec<f64>,
    /// Reduced pressures there \[Pa\].
    reduced: Vec<f64>,
    /// Rises without density, ascending \[Pa\].
    rise: Vec<f64>,
}

impl EdgePressures {
    /// Tabulates edge pressures of `oil` up to `largest` \[Pa\].
    pub(super) fn tabulate(&mut self, oil: &Lubricant, largest: f64) {
        self.pressure.clear();
        self.rise.clear();
        // Pressures in a geometric series.
        let ratio = LOWEST.powf(-1.0 / (PRESSURES - 1) as f64);
        let pressures = (0..PRESSURES).map(|i| largest * LOWEST * ratio.powi(i as i32));
        self.pressure.extend(pressures);
        let densities = Densities::new(oil, &self.pressure);
        self.reduced.clone_from(&densities.reduced);
        let mut least = 0.0;
        for &p in &self.pressure {
            let edge = oil.at(p);
            let (target, density) = (edge.reduced_pressure, edge.density);
            let factor = densities.factor(target, density);
            least = f64::max(least, factor * WHOLE_INLET);
            self.rise.push(least);
        }
    }

    /// Fluid pressure at the edge for a `rise` \[Pa\] in front of a contact with the pressure `behind` \[Pa\] one flank length behind
    /// its edge; infinite above the table.
    pub(super) fn pressure(&self, rise: f64, behind: f64) -> f64 {
        let at = |rise: f64| interpolated(&self.rise, &self.pressure, rise).unwrap_or(f64::INFINITY);
        let mut pressure = at(rise);
        // The pressures ascend to the lowest one that agrees with its inlet.
        for _ in 0..MAX_TURNS {
            let next = at(rise * self.elongation(pressure, behind));
            if next <= (1.0 + RISE_TOLERANCE) * pressure {
                break;
            }
            pressure = next;
        }
        pressure
    }

    /// Rise without density that an edge `pressure` \[Pa\] needs.
    pub(super) fn needed_rise(&self, pressure: f64, behind: f64) -> f64 {
        let last = self.rise.last().copied().unwrap_or(f64::INFINITY);
        let rigid = interpolated(&self.pressure, &self.rise, pressure).unwrap_or(last);
        rigid / self.elongation(pressure, behind)
    }

    /// Rise in the inlet of an elastic edge over that of the dry flank.
    fn elongation(&self, pressure: f64, behind: f64) -> f64 {
        let largest = self.reduced.last().copied().unwrap_or(0.0);
        let reduced = interpolated(&self.pressure, &self.reduced, pressure).unwrap_or(largest);
        1.0 + ELONGATION * largest / behind * (reduced / largest).powi(5)
    }
}

/// Linear interpolation of `values` over ascending `knots`, through zero below the first; `None` above the last.
fn interpolated(knots: &[f64], values: &[f64], x: f64) -> Option<f64> {
    interpolated_below(knots.partition_point(|knot| *knot < x), knots, values, x)
}

/// The interpolation between the knot `above` the place `x` and the one before.
fn interpolated_below(above: usize, knots: &[f64], values: &[f64], x: f64) -> Option<f64> {
    let (x1, v1) = (*knots.get(above)?, *values.get(above)?);
    let (x0, v0) = match above.checked_sub(1) {
        Some(below) => (knots[below], values[below]),
        None => (0.0, 0.0),
    };
    Some(if x1 > x0 { v0 + (v1 - v0) * (x - x0) / (x1 - x0) } else { v1 })
}

/// Density ratios over the reduced pressure.
struct Densities {
    /// Reduced pressures, ascending \[Pa\].
    reduced: Vec<f64>,
    /// Excess of the density ratio over one.
    excess: Vec<f64>,
}

impl Densities {
    fn new(oil: &Lubricant, pressures: &[f64]) -> Self {
        let points: Vec<_> = pressures.iter().map(|p| oil.at(*p)).collect();
        Self {
            reduced: points.iter().map(|point| point.reduced_pressure).collect(),
            excess: points.iter().map(|point| point.density - 1.0).collect(),
        }
    }

    /// The factor for which the reduced pressure at the edge is `target`, by the Illinois method; `edge` is the density
    /// ratio there.
    fn factor(&self, target: f64, edge: f64) -> f64 {
        let excess = |k: f64| self.edge(k, edge) / target - 1.0;
        // An incompressible fluid needs the least.
        let (mut low, mut high) = (target / WHOLE_INLET, 2.0 * target / WHOLE_INLET);
        let (mut below, mut above) = (excess(low).min(0.0), excess(high));
        while above < 0.0 && high < 1e3 * low {
            high *= 2.0;
            above = excess(high);
        }
        for _ in 0..SECANT_STEPS {
            let middle = (low * above - high * below) / (above - below);
            let found = excess(middle);
            if found.abs() <= RISE_TOLERANCE || high - low <= RISE_TOLERANCE * high || !found.is_finite() {
                return middle;
            }
            // The end that stays counts half, so that both move.
            if found < 0.0 {
                (low, below, above) = (middle, found, 0.5 * above);
            } else {
                (high, above, below) = (middle, found, 0.5 * below);
            }
        }
        0.5 * (low + high)
    }

    /// Reduced pressure at the edge for the factor `k` and the density ratio `edge` there, by the midpoint rule in
    /// `s = sqrt(y)`. The density in the inlet is at most that at the edge.
    fn edge(&self, k: f64, edge: f64) -> f64 {
        let [far, near] = FLANK;
        let factor = (near / far).powf(1.0 / STEPS as f64);
        let (mut reduced, mut s) = (0.0, far);
        // The reduced pressure rises along the flank, and with it the tabulated one above it.
        let mut above = 0;
        // Midpoint rule along the flank.
        for _ in 0..STEPS {
            let next = s * factor;
            let mut slope = |reduced: f64, s: f64| {
                let film = 1.0 + s.powi(3);
                while self.reduced.get(above).is_some_and(|knot| *knot < reduced) {
                    above += 1;
                }
                let excess =
                    interpolated_below(above, &self.reduced, &self.excess, reduced).unwrap_or(edge - 1.0);
                let density = (1.0 + excess).min(edge);
                2.0 * s * k * (density * film - edge).max(0.0) / film.powi(3)
            };
            let half = reduced + 0.5 * (s - next) * slope(reduced, s);
            reduced += (s - next) * slope(half, 0.5 * (s + next));
            s = next;
        }
        reduced
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lubricant::{Barus, DowsonHigginson, Incompressible};

    #[test]
    fn edge_pressure_of_an_incompressible_barus_oil_is_its_closed_form() {
        let alpha = 15e-9;
        let oil = Lubricant::new(Barus::new(0.01, alpha).unwrap(), Incompressible);
        let mut edges = EdgePressures::default();
        edges.tabulate(&oil, 2e9);
        for rise in [1e5, 1e7, 3e7, 6e7] {
            let exact = -(-alpha * rise).ln_1p() / alpha;
            assert!(
                (edges.pressure(rise, f64::INFINITY) / exact - 1.0).abs() < 4e-3,
                "{rise}: {}",
                edges.pressure(rise, f64::INFINITY)
            );
        }
        assert!(edges.pressure(1.01 / alpha, f64::INFINITY).is_infinite());
        assert!((edges.needed_rise(1e8, f64::INFINITY) * alpha - (1.0 - (-1.5_f64).exp())).abs() < 2e-3);
    }

    #[test]
    fn density_reduces_the_edge_pressure_and_the_rise_is_largest_at_high_pressure() {
        let barus = || Barus::new(0.01, 15e-9).unwrap();
        let mut stiff = EdgePressures::default();
        stiff.tabulate(&Lubricant::new(barus(), Incompressible), 2e9);
        let mut soft = EdgePressures::default();
        soft.tabulate(&Lubricant::new(barus(), DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap()), 2e9);
        assert!(soft.pressure(5e7, f64::INFINITY) < stiff.pressure(5e7, f64::INFINITY));
        // The density takes at most a third of the rise of this oil.
        let share = |p: f64| soft.needed_rise(p, f64::INFINITY) / stiff.needed_rise(p, f64::INFINITY);
        assert!(share(1e8) > 1.0 && share(1e9) > share(1e8) && share(2e9) < 1.5, "{}", share(2e9));
    }
}
