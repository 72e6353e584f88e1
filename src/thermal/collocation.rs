//! Heat conduction across a film, collocated at Gauss-Legendre nodes.

/// Number of collocation points across the film.
pub(super) const POINTS: usize = 8;
/// Iteration limit of Newton's method for the roots of a Legendre polynomial; a few steps suffice.
const MAX_STEPS: usize = 50;

/// Nodes and weights on (0, 1), and the Green's function of conduction: `theta'' = -s` with
/// `theta(0) = theta(1) = 0` has the solution `theta_i = sum_j green[i][j] s_j`, exact for polynomials of
/// degree 7.
#[derive(Debug, Clone)]
pub(super) struct Collocation {
    pub(super) nodes: [f64; POINTS],
    pub(super) weights: [f64; POINTS],
    pub(super) green: Square,
}

/// A matrix of the collocation points.
pub(super) type Square = [[f64; POINTS]; POINTS];

impl Collocation {
    pub(super) fn new() -> Self {
        let (nodes, weights) = gauss();
        let mut green = [[0.0; POINTS]; POINTS];
        for (row, &z) in green.iter_mut().zip(&nodes) {
            // On either side of the node the integrand is a polynomial of degree 8.
            for (&t, &w) in nodes.iter().zip(&weights) {
                let (below, above) = (z * t, z + (1.0 - z) * t);
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry += w * z * below * (1.0 - z) * lagrange(&nodes, j, below);
                    *entry += w * (1.0 - z) * z * (1.0 - above) * lagrange(&nodes, j, above);
                }
            }
        }
        Self { nodes, weights, green }
    }

    /// Mean across the film.
    pub(super) fn mean(&self, values: &[f64; POINTS]) -> f64 {
        self.weights.iter().zip(values).map(|(w, value)| w * value).sum()
    }
}

/// Lagrange polynomial of node `j` at `x`.
fn lagrange(nodes: &[f64; POINTS], j: usize, x: f64) -> f64 {
    let others = nodes.iter().enumerate().filter(|(i, _)| *i != j);
    others.map(|(_, node)| (x - node) / (nodes[j] - node)).product()
}

/// Gauss-Legendre rule on (0, 1).
fn gauss() -> ([f64; POINTS], [f64; POINTS]) {
    let (mut nodes, mut weights) = ([0.0; POINTS], [0.0; POINTS]);
    let n = POINTS as f64;
    for (i, (node, weight)) in nodes.iter_mut().zip(&mut weights).enumerate() {
        let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..MAX_STEPS {
            let (value, before) = legendre(x);
            slope = n * (x * value - before) / (x * x - 1.0);
            let step = value / slope;
            x -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        (*node, *weight) = (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope));
    }
    (nodes, weights)
}

/// The Legendre polynomials of degree `POINTS` and one less.
fn legendre(x: f64) -> (f64, f64) {
    let (mut value, mut before) = (x, 1.0);
    for degree in 2..=POINTS {
        let m = degree as f64;
        (value, before) = (((2.0 * m - 1.0) * x * value - (m - 1.0) * before) / m, value);
    }
    (value, before)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conduction_is_exact_for_polynomials() {
        let rule = Collocation::new();
        assert!((rule.weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        // theta'' = -s for s = 1, and s = 12 (z - 1/2)^2.
        for (i, &z) in rule.nodes.iter().enumerate() {
            let theta = |heat: &dyn Fn(f64) -> f64| -> f64 {
                rule.green[i].iter().zip(&rule.nodes).map(|(green, node)| green * heat(*node)).sum()
            };
            assert!((theta(&|_| 1.0) - 0.5 * z * (1.0 - z)).abs() < 1e-14);
            let y = z - 0.5;
            assert!((theta(&|z| 12.0 * (z - 0.5).powi(2)) - (0.0625 - y.powi(4))).abs() < 1e-14);
        }
    }
}
