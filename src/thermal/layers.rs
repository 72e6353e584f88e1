//! Temperatures of the layers of a film from the heat in them.

use super::advection::LayerAdvection;
use super::collocation::{Collocation, POINTS, Square};

/// Columns of the linear system: its matrix, the identity, the right-hand side.
const COLUMNS: usize = 2 * POINTS + 1;

/// Linear response of a film between its surfaces: layers `T_i = base_i + sum_j by_heat_ij s_j` under the heat `s`
/// \[W/m^2\], with conduction, advection and the response of the surfaces.
#[derive(Debug, Clone, Copy)]
pub(super) struct LayerResponse {
    base: [f64; POINTS],
    by_heat: Square,
    /// Heat conducted to the surfaces: without heat in the film, and its part of the heat of each layer.
    conducted: (f64, [f64; POINTS]),
}

impl LayerResponse {
    /// With the film over its conductivity `film` \[K m^2/W\], the `surfaces` \[K\] at the heat flow `response.1` and
    /// their response `response.0`.
    pub(super) fn new(
        rule: &Collocation,
        film: f64,
        surfaces: [f64; 2],
        response: (f64, f64),
        advection: &LayerAdvection,
    ) -> Self {
        // T = line + K (s - a) with the heat a = A T - c T_a that the layers lose by advection.
        let [first, second] = surfaces;
        let line: [f64; POINTS] =
            std::array::from_fn(|i| first + rule.nodes[i] * (second - first) - response.0 * response.1);
        let conduction: Square = std::array::from_fn(|i| {
            std::array::from_fn(|j| film * rule.green[i][j] + response.0 * rule.weights[j])
        });
        // (1 + A K) (s - a) = s - A line + c T_a
        let mut system = [[0.0; COLUMNS]; POINTS];
        for (i, row) in system.iter_mut().enumerate() {
            let [below, above] = advection.exchange(rule, film, i);
            let (capacity, inflow) = (advection.capacity[i], advection.inflow[i]);
            let lost = |of: &dyn Fn(usize) -> f64, outside: f64| {
                let here = of(i);
                let neighbour =
                    |share: f64, j: usize| if share == 0.0 { 0.0 } else { share * (here - of(j)) };
                capacity * (here - outside) + neighbour(below, i.wrapping_sub(1)) + neighbour(above, i + 1)
            };
            for j in 0..POINTS {
                row[j] = lost(&|l| conduction[l][j], 0.0);
            }
            row[i] += 1.0;
            row[POINTS + i] = 1.0;
            row[2 * POINTS] = -lost(&|l| line[l], inflow);
        }
        eliminate(&mut system);
        let kept = |i: usize, column: usize| -> f64 {
            (0..POINTS).map(|j| conduction[i][j] * system[j][column]).sum()
        };
        let sum = |column: usize| -> f64 { (0..POINTS).map(|j| rule.weights[j] * system[j][column]).sum() };
        Self {
            base: std::array::from_fn(|i| line[i] + kept(i, 2 * POINTS)),
            by_heat: std::array::from_fn(|i| std::array::from_fn(|j| kept(i, POINTS + j))),
            conducted: (sum(2 * POINTS), std::array::from_fn(|j| sum(POINTS + j))),
        }
    }

    /// Temperatures of the layers under the heat `s`.
    pub(super) fn temperatures(&self, heat: &[f64; POINTS]) -> [f64; POINTS] {
        let row = |i: usize| -> f64 { self.by_heat[i].iter().zip(heat).map(|(a, b)| a * b).sum() };
        std::array::from_fn(|i| self.base[i] + row(i))
    }

    /// Heat conducted to the surfaces under the heat `s` \[W/m^2\].
    pub(super) fn conducted(&self, heat: &[f64; POINTS]) -> f64 {
        self.conducted.1.iter().zip(heat).map(|(a, b)| a * b).sum::<f64>() + self.conducted.0
    }
}

/// Gauss-Jordan elimination with partial pivoting: the columns after the square part become those of the solution.
fn eliminate(system: &mut [[f64; COLUMNS]; POINTS]) {
    for k in 0..POINTS {
        let pivot =
            (k..POINTS).max_by(|a, b| system[*a][k].abs().total_cmp(&system[*b][k].abs())).unwrap_or(k);
        system.swap(k, pivot);
        let scale = 1.0 / system[k][k];
        let row = system[k].map(|value| value * scale);
        system[k] = row;
        for (_, other) in system.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = other[k];
            for (value, own) in other.iter_mut().zip(&row).skip(k) {
                *value -= factor * own;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_is_conducted_or_advected() {
        let rule = Collocation::new();
        let mut advection = LayerAdvection::uniform(2e5, 290.0);
        advection.across = [1e4, 2e4, 3e4, 0.0, -3e4, -2e4, -1e4];
        let heat = rule.nodes.map(|z| 1e8 * z * z);
        let found = LayerResponse::new(&rule, 1e-5, [300.0, 305.0], (1e-7, 2e7), &advection);
        let layers = found.temperatures(&heat);
        let mut lost = [0.0; POINTS];
        for (i, lost) in lost.iter_mut().enumerate() {
            *lost = advection.capacity[i] * (layers[i] - advection.inflow[i]);
            let neighbours = [i.checked_sub(1), Some(i + 1).filter(|j| *j < POINTS)];
            for (share, j) in advection.exchange(&rule, 1e-5, i).into_iter().zip(neighbours) {
                *lost += j.map_or(0.0, |j| share * (layers[i] - layers[j]));
            }
        }
        let balance = rule.mean(&heat) - rule.mean(&lost) - found.conducted(&heat);
        assert!(balance.abs() < 1e-9 * rule.mean(&heat), "{balance}");
        // A film as warm as its surfaces and its inflow stays so.
        let still = LayerResponse::new(&rule, 1e-5, [290.0; 2], (0.0, 0.0), &advection);
        assert!(still.temperatures(&[0.0; POINTS]).iter().all(|layer| (layer - 290.0).abs() < 1e-9));
    }
}
