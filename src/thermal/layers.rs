//! Flow-weighted temperatures of the layers of a film.

use super::collocation::{Collocation, POINTS};

/// Weights of the collocation points in the means of the layers that move forward, of those that move backward, and
/// of all, by the magnitude of their velocities. Layers without flow have the weights of `all`, and a film at rest
/// those of the mean across it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layers {
    pub(super) all: [f64; POINTS],
    pub(super) forward: [f64; POINTS],
    pub(super) backward: [f64; POINTS],
}

impl Layers {
    /// Of the velocity `v_0 + v_1 y - 6 v_2 (1/4 - y^2)`, `y` from -1/2 to 1/2 across the film; exact for temperatures
    /// that are polynomials through the collocation points.
    pub(super) fn new(rule: &Collocation, velocity: [f64; 3]) -> Self {
        let [even, skew, back] = velocity;
        let (mut ahead, mut behind) = ([0.0; POINTS], [0.0; POINTS]);
        // Between the roots of the velocity it is a polynomial of one sign.
        let [first, second] = roots([6.0 * back, skew, even - 1.5 * back]);
        for [from, to] in [[-0.5, first], [first, second], [second, 0.5]] {
            for (node, weight) in rule.nodes.iter().zip(&rule.weights).filter(|_| to > from) {
                let y = from + (to - from) * node;
                let flow = weight * (to - from) * (even + skew * y - 6.0 * back * (0.25 - y * y));
                let weights = if flow > 0.0 { &mut ahead } else { &mut behind };
                rule.add_interpolation(y + 0.5, flow.abs(), weights);
            }
        }
        let mean = |flows: [f64; POINTS], without: [f64; POINTS]| {
            let sum: f64 = flows.iter().sum();
            if sum > 0.0 { flows.map(|flow| flow / sum) } else { without }
        };
        let all = mean(std::array::from_fn(|i| ahead[i] + behind[i]), rule.weights);
        Self { all, forward: mean(ahead, all), backward: mean(behind, all) }
    }

    /// Mean of `values` at the collocation points under the weights of some layers.
    pub(super) fn mean(weights: &[f64; POINTS], values: &[f64; POINTS]) -> f64 {
        weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
    }
}

/// Roots of `a y^2 + b y + c` between -1/2 and 1/2 in ascending order; 1/2 for those that do not exist.
fn roots([a, b, c]: [f64; 3]) -> [f64; 2] {
    let inside = |y: f64| if y > -0.5 && y < 0.5 { y } else { 0.5 };
    let square = b * b - 4.0 * a * c;
    if square <= 0.0 {
        return [0.5; 2];
    }
    // The root of larger magnitude first: no digits cancel.
    let sum = -0.5 * (b + square.sqrt().copysign(b));
    let [first, second] = [inside(sum / a), inside(c / sum)];
    [first.min(second), first.max(second)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Weighted heights `4 z (1 - z)` beside sums over thin layers, with all kinds of flow.
    #[test]
    fn means_equal_sums_over_layers() {
        let rule = Collocation::new();
        let height = rule.nodes.map(|z| 4.0 * z * (1.0 - z));
        for velocity in [
            [1.0, 0.0, 0.0],
            [1.0, 0.0, 0.35],
            [1.0, 0.0, 1.0],
            [1.0, 0.5, 0.8],
            [1.0, -3.0, 0.0],
            [1.0, 3.0, -0.3],
            [0.0, 0.0, -1.0],
            [0.0, 0.0, 1.0],
        ] {
            let layers = Layers::new(&rule, velocity);
            let n = 100_000;
            let (mut flows, mut heights) = ([0.0; 3], [0.0; 3]);
            for y in (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n) - 0.5) {
                let u = velocity[0] + velocity[1] * y - 6.0 * velocity[2] * (0.25 - y * y);
                for (slot, flow) in [u.abs(), u.max(0.0), (-u).max(0.0)].into_iter().enumerate() {
                    flows[slot] += flow;
                    heights[slot] += flow * (1.0 - 4.0 * y * y);
                }
            }
            let of_all = heights[0] / flows[0];
            for (slot, weights) in [&layers.all, &layers.forward, &layers.backward].into_iter().enumerate() {
                let exact = if flows[slot] > 0.0 { heights[slot] / flows[slot] } else { of_all };
                let found = Layers::mean(weights, &height);
                assert!((found - exact).abs() < 1e-8, "{velocity:?}, {slot}: {found}, {exact}");
            }
        }
        // A film at rest: the mean across it.
        assert!((Layers::mean(&Layers::new(&rule, [0.0; 3]).all, &height) - 2.0 / 3.0).abs() < 1e-14);
    }
}
