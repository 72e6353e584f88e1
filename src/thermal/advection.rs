//! Heat that the layers of a film carry.

use super::collocation::{Collocation, POINTS};

/// Advection in the layers of a film, at the eight nodes of Gauss-Legendre's rule across it.
///
/// A layer loses the heat `c (T - T_a)` \[W/m^2\] to the flow along the film, which enters it with the temperature
/// `T_a`. The velocity profile changes along the film: the flow across it that this causes takes heat from layer to
/// layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerAdvection {
    /// Heat capacity of the inflow `c` \[W/(m^2 K)\], not negative.
    pub capacity: [f64; POINTS],
    /// Temperature of the inflow `T_a` \[K\].
    pub inflow: [f64; POINTS],
    /// Heat capacity of the flow across the film from each layer to the next one \[W/(m^2 K)\].
    pub across: [f64; POINTS - 1],
}

impl LayerAdvection {
    /// The same capacity \[W/(m^2 K)\] and inflow temperature \[K\] in all layers.
    pub fn uniform(capacity: f64, inflow: f64) -> Self {
        Self { capacity: [capacity; POINTS], inflow: [inflow; POINTS], across: [0.0; POINTS - 1] }
    }

    /// Of a node with the `flows` \[m^2/s\] through the layers of the node before, of itself and of the next one, their
    /// heat capacity `per_flow` \[J/(m^4 K)\], and the layer temperatures of the node before and of the next one \[K\].
    /// First-order upwind; the flow through a face is the mean of its nodes.
    pub(super) fn between(
        rule: &Collocation,
        per_flow: f64,
        flows: [&[f64; POINTS]; 3],
        [before, after]: [&[f64; POINTS]; 2],
    ) -> Self {
        let mut found = Self::uniform(0.0, 0.0);
        let mut gained = [0.0; POINTS];
        for i in 0..POINTS {
            let [west, here, east] = flows.map(|flow| per_flow * flow[i]);
            let forward = (0.5 * (west + here)).max(0.0);
            let backward = (-0.5 * (here + east)).max(0.0);
            let all = forward + backward;
            found.capacity[i] = all;
            found.inflow[i] =
                if all > 0.0 { (forward * before[i] + backward * after[i]) / all } else { before[i] };
            gained[i] = 0.5 * (west - east);
        }
        // Flow to the sides leaves all layers alike.
        let mean = rule.mean(&gained);
        let mut sum = 0.0;
        for ((across, gain), weight) in found.across.iter_mut().zip(&gained).zip(&rule.weights) {
            sum += weight * (gain - mean);
            *across = sum;
        }
        found
    }

    /// Coefficients of the heat that layer `i` loses: `below (T_i - T_(i-1)) + above (T_i - T_(i+1))` \[W/(m^2 K)\] by the
    /// flow across the film, by central differences. In a thick film, of the resistance `film` \[K m^2/W\], they include
    /// as much conduction between the layers that none is negative together with that of the fluid.
    pub(super) fn exchange(&self, rule: &Collocation, film: f64, i: usize) -> [f64; 2] {
        let of = |first: usize, sign: f64| {
            let between = rule.nodes[first + 1] - rule.nodes[first];
            let (flow, least) = (0.5 * self.across[first], film.recip() / between);
            (sign * flow + (flow.abs() - least).max(0.0)) / rule.weights[i]
        };
        [if i > 0 { of(i - 1, 1.0) } else { 0.0 }, if i + 1 < POINTS { of(i, -1.0) } else { 0.0 }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_of_equal_speed_exchange_no_flow() {
        let rule = Collocation::new();
        let [west, here, east] = [2.0, 1.5, 1.0].map(|flow| [flow; POINTS]);
        let found =
            LayerAdvection::between(&rule, 3.0, [&west, &here, &east], [&[300.0; POINTS], &[310.0; POINTS]]);
        for i in 0..POINTS {
            assert!((found.capacity[i] - 3.0 * 1.75).abs() < 1e-12 && (found.inflow[i] - 300.0).abs() < 1e-9);
            assert!(found.exchange(&rule, 1e-6, i).iter().all(|share| share.abs() < 1e-12));
        }
    }

    #[test]
    fn flow_across_the_film_balances_each_layer() {
        let rule = Collocation::new();
        let parabola = rule.nodes.map(|z| 1.0 - 8.0 * z * (1.0 - z));
        let [west, here, east] = [2.0, 1.5, 1.0].map(|flow| parabola.map(|profile| flow * profile + 1.0));
        let temperature = rule.nodes.map(|z| 300.0 + 10.0 * z);
        let found = LayerAdvection::between(&rule, 1.0, [&west, &here, &east], [&temperature, &temperature]);
        for i in 0..POINTS {
            // Inflow along the film less the mean outflow of the section stays in the layer or crosses it.
            let gained =
                0.5 * (west[i] - east[i]) - rule.mean(&std::array::from_fn(|j| 0.5 * (west[j] - east[j])));
            let below = if i > 0 { found.across[i - 1] } else { 0.0 };
            let above = if i + 1 < POINTS { found.across[i] } else { 0.0 };
            assert!((rule.weights[i] * gained + below - above).abs() < 1e-12);
            for film in [1e-3, 1e3, 1e6] {
                let [below, above] = found.exchange(&rule, film, i);
                let conducted =
                    |to: usize| 1.0 / (film * (rule.nodes[to] - rule.nodes[i]).abs() * rule.weights[i]);
                assert!(i == 0 || below + conducted(i - 1) > -1e-12);
                assert!(i + 1 == POINTS || above + conducted(i + 1) > -1e-12);
            }
        }
        // Reversed layers bring the temperature of the node after them.
        let reversed =
            LayerAdvection::between(&rule, 1.0, [&[-1.0; POINTS]; 3], [&[300.0; POINTS], &temperature]);
        let bits = |values: [f64; POINTS]| values.map(f64::to_bits);
        assert_eq!([reversed.inflow, reversed.capacity].map(bits), [temperature, [1.0; POINTS]].map(bits));
    }
}
