//! Velocity of the layers of a film.

use super::collocation::{Collocation, POINTS};

/// Shear rates at the collocation points of a film whose layers have the relative `fluidity` \[-\], mean 1, under a
/// uniform shear stress and under a pressure gradient.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShearRates {
    /// `du/dz` of surfaces that slide with speed one; mean 1.
    pub(super) sliding: [f64; POINTS],
    /// `du/dz` of a backflow of one against the direction of motion; mean 0. The shear stress of pressure flow grows
    /// linearly from the layer where it vanishes.
    pub(super) pressure: [f64; POINTS],
    /// Heat of pressure flow over its mean.
    pub(super) heat: [f64; POINTS],
}

impl ShearRates {
    pub(super) fn new(rule: &Collocation, fluidity: &[f64; POINTS]) -> Self {
        let level: f64 = moment(rule, fluidity, |z| z);
        let square = moment(rule, fluidity, |z| (z - level) * (z - level));
        let pressure = std::array::from_fn(|i| fluidity[i] * (rule.nodes[i] - level) / square);
        let heat = std::array::from_fn(|i| pressure[i] * (rule.nodes[i] - level));
        Self { sliding: *fluidity, pressure, heat }
    }

    /// Velocity `v_0 + v_1 S(z) - v_2 P(z)` of the layers; `S` has the mean 0 and a difference of 1 between the
    /// surfaces, `P` vanishes at both and has the mean 1.
    pub(super) fn velocity(&self, rule: &Collocation, [even, skew, back]: [f64; 3]) -> [f64; POINTS] {
        let integral = |rates: &[f64; POINTS]| -> [f64; POINTS] {
            std::array::from_fn(|i| rule.integral[i].iter().zip(rates).map(|(a, b)| a * b).sum())
        };
        let (sliding, pressure) = (integral(&self.sliding), integral(&self.pressure));
        let middle = rule.mean(&sliding);
        std::array::from_fn(|i| even + skew * (sliding[i] - middle) + back * pressure[i])
    }
}

/// Mean of a function of the height weighted by the fluidity.
fn moment(rule: &Collocation, fluidity: &[f64; POINTS], of: impl Fn(f64) -> f64) -> f64 {
    let terms = fluidity.iter().zip(rule.nodes.iter().zip(&rule.weights));
    terms.map(|(f, (z, w))| w * f * of(*z)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocity_of_a_uniform_viscosity_is_a_parabola() {
        let rule = Collocation::new();
        let rates = ShearRates::new(&rule, &[1.0; POINTS]);
        let velocity = rates.velocity(&rule, [1.0, 0.5, 0.8]);
        for (u, z) in velocity.iter().zip(&rule.nodes) {
            let y = z - 0.5;
            assert!((u - (1.0 + 0.5 * y - 0.8 * 6.0 * (0.25 - y * y))).abs() < 1e-13, "{u} at {z}");
        }
    }

    #[test]
    fn fluid_layers_take_the_flow() {
        let rule = Collocation::new();
        // Fluidity (1 + 2 z)/2: between the surfaces S = (z + z^2)/2 - 5/12.
        let rates = ShearRates::new(&rule, &rule.nodes.map(|z| 0.5 * (1.0 + 2.0 * z)));
        for (u, z) in rates.velocity(&rule, [0.0, 1.0, 0.0]).iter().zip(&rule.nodes) {
            assert!((u - (0.5 * (z + z * z) - 5.0 / 12.0)).abs() < 1e-13, "{u} at {z}");
        }
        let back = rates.velocity(&rule, [0.0, 0.0, 1.0]);
        assert!((rule.mean(&back) + 1.0).abs() < 1e-13);
        assert!((rule.mean(&rates.heat) - 1.0).abs() < 1e-13 && rule.mean(&rates.pressure).abs() < 1e-13);
        // The slope of the velocity vanishes where the shear stress of pressure flow does.
        assert!(back[7].abs() > back[0].abs());
    }
}
