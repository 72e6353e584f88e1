//! Anderson mixing of a fixed-point iteration.

use crate::numerics::{add_scaled, dot};

/// Number of stored steps.
const DEPTH: usize = 5;
/// Independent fraction of a residual change required to keep it.
const INDEPENDENT: f64 = 1e-3;

/// Mixes the steps of `x <- g(x)`: the combination of the last ones with the smallest residual `g(x) - x`.
///
///
/// Source: Walker, H. F. and Ni, P. (2011), Anderson acceleration for fixed-point iterations, SIAM Journal on
/// Numerical Analysis 49, 1715-1735.
#[derive(Debug, Default)]
pub(in crate::sim) struct Mixing {
    /// Point and residual of the previous call.
    last: Option<(Vec<f64>, Vec<f64>)>,
    /// Changes of point and residual; the residuals are orthogonal to each other.
    changes: Vec<(Vec<f64>, Vec<f64>)>,
}

impl Mixing {
    /// Moves `point` along its residual `g(x) - x`, with the step `share` in directions without stored changes.
    pub(in crate::sim) fn advance(&mut self, point: &mut [f64], residual: &[f64], share: f64) {
        if let Some((last_point, last_residual)) = self.last.take() {
            let minus = |new: &[f64], old: &[f64]| new.iter().zip(old).map(|(n, o)| n - o).collect();
            self.remember(minus(point, &last_point), minus(residual, &last_residual));
        }
        self.last = Some((point.to_vec(), residual.to_vec()));
        let mut rest = residual.to_vec();
        for (moved, change) in &self.changes {
            let weight = dot(&rest, change) / dot(change, change);
            add_scaled(&mut rest, -weight, change);
            add_scaled(point, -weight, moved);
        }
        add_scaled(point, share, &rest);
    }

    /// Stores the last change of point and residual, and drops old or dependent ones.
    fn remember(&mut self, moved: Vec<f64>, change: Vec<f64>) {
        let size = dot(&change, &change);
        let kept = std::mem::take(&mut self.changes);
        // The newest is kept; older ones are orthogonalized against it in turn.
        if size > 0.0 {
            self.changes.push((moved, change));
        }
        for (mut moved, mut change) in kept {
            let before = dot(&change, &change);
            for (other_moved, other) in &self.changes {
                let weight = dot(&change, other) / dot(other, other);
                add_scaled(&mut change, -weight, other);
                add_scaled(&mut moved, -weight, other_moved);
            }
            if dot(&change, &change) > INDEPENDENT * INDEPENDENT * before && self.changes.len() < DEPTH {
                self.changes.push((moved, change));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_iteration_converges_in_as_many_steps_as_modes() {
        // g(x) = A x + b with eigenvalues far outside the unit circle.
        let rates = [-3.0, 0.5, 1.8, 0.0];
        let fixed = [1.0, -2.0, 3.0, 4.0];
        let mut point = [0.0; 4];
        let mut mixing = Mixing::default();
        for _ in 0..6 {
            let residual: Vec<f64> = (0..4).map(|i| (rates[i] - 1.0) * (point[i] - fixed[i])).collect();
            mixing.advance(&mut point, &residual, 0.5);
        }
        for (x, exact) in point.iter().zip(fixed) {
            assert!((x - exact).abs() < 1e-9, "{point:?}");
        }
    }
}
