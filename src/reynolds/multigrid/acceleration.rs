//! Recombination of the last two iterates.
//!
//! With the residuals `r` and `r'` before the last two cycles, the weight `s` that minimizes
//! `|r + s (r' - r)|` combines the results of both cycles, pressures and approach: `p + s (p' - p)`. In
//! cavitated cells only a deficit counts as residual.

use crate::reynolds::state::ContactState;

/// Largest weight of the earlier cycle, the optimum for an error that a cycle reduces by a tenth.
const LARGEST_WEIGHT: f64 = 9.0;

/// Anderson acceleration of depth one: the combination of the last two results for which the same combination
/// of their initial states has the smallest mass residual. It removes a single slow or oscillating error
/// component without a further convolution.
///
/// Source: Oosterlee, C. W. and Washio, T. (2000), Krylov subspace acceleration of nonlinear multigrid with
/// application to recirculating flows, SIAM J. Sci. Comput. 21, 1670-1690.
#[derive(Debug)]
pub(super) struct Acceleration {
    /// Mass residuals before the last cycle.
    residual: Vec<f64>,
    /// Pressures after the last cycle \[Pa\].
    pressure: Vec<f64>,
    /// Approach after the last cycle \[m\].
    approach: f64,
    /// Whether a previous cycle is stored.
    has_previous: bool,
}

impl Acceleration {
    /// Buffers for fields of `nodes` values, without a stored cycle.
    pub(super) fn new(nodes: usize) -> Self {
        Self { residual: vec![0.0; nodes], pressure: vec![0.0; nodes], approach: 0.0, has_previous: false }
    }

    /// Discards the stored cycle, for a change of the iteration.
    pub(super) fn reset(&mut self) {
        self.has_previous = false;
    }

    /// Combines pressure and approach after a cycle with those after the previous one. `start` is the state
    /// before the cycle and `balance` its mass balance.
    pub(super) fn recombine(
        &mut self,
        start: &ContactState,
        balance: &[f64],
        pressure: &mut [f64],
        approach: &mut f64,
    ) {
        let (mut product, mut square) = (0.0, 0.0);
        for ((last, f), p) in self.residual.iter_mut().zip(balance).zip(&start.fluid_pressure) {
            let residual = if *p > 0.0 { *f } else { f.min(0.0) };
            let change = residual - *last;
            product += change * residual;
            square += change * change;
            *last = residual;
        }
        let weight = product / square;
        let weight = if self.has_previous && weight.is_finite() {
            weight.clamp(-LARGEST_WEIGHT, LARGEST_WEIGHT)
        } else {
            0.0
        };
        let mix = |last: &mut f64, value: f64| {
            let mixed = value + weight * (*last - value);
            *last = value;
            mixed
        };
        for (last, p) in self.pressure.iter_mut().zip(pressure) {
            *p = mix(last, *p).max(0.0);
        }
        *approach = mix(&mut self.approach, *approach);
        self.has_previous = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;

    #[test]
    fn single_slow_error_vanishes_after_two_cycles() -> Result<(), crate::error::InputError> {
        let grid = Grid::centred(5, 5, 1.0, 1.0)?;
        let exact = |k: usize| 1.0 + k as f64;
        for rate in [0.8, -0.9] {
            let mut acceleration = Acceleration::new(grid.len());
            let mut state = ContactState::new(&grid);
            let mut error = 0.3;
            for _ in 0..2 {
                for k in 0..grid.len() {
                    state.fluid_pressure[k] = exact(k) + error * (k as f64).sin();
                }
                let balance: Vec<f64> = (0..grid.len()).map(|k| state.fluid_pressure[k] - exact(k)).collect();
                error *= rate;
                let mut approach = 2.0 + error;
                let mut pressure: Vec<f64> =
                    (0..grid.len()).map(|k| exact(k) + error * (k as f64).sin()).collect();
                acceleration.recombine(&state, &balance, &mut pressure, &mut approach);
                state.approach = approach;
                state.pressure = pressure;
            }
            for k in 0..grid.len() {
                assert!((state.pressure[k] - exact(k)).abs() < 1e-12, "rate {rate}: {}", state.pressure[k]);
            }
            assert!((state.approach - 2.0).abs() < 1e-12, "rate {rate}: {}", state.approach);
        }
        Ok(())
    }
}
