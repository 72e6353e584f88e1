//! Recombination of the last two iterates.
//!
//! With the residuals `r` and `r'` before the last two cycles the share `s` that makes `|r + s (r' - r)|`
//! least mixes what both cycles ended with, pressures and approach: `p + s (p' - p)`. In cavitated cells only
//! a deficit counts as residual.

use crate::reynolds::state::ContactState;

/// Largest weight of the earlier cycle: that which an error needs of which a cycle leaves nine tenths.
const LARGEST_SHARE: f64 = 9.0;

/// Anderson mixing over two cycles: the combination of their results whose starts, combined in the same way,
/// leave the least mass residual. Cycles that are slow by one error alone, or swing, become fast ones,
/// without a further convolution.
///
/// Source: Oosterlee, C. W. and Washio, T. (2000), Krylov subspace acceleration of nonlinear multigrid with
/// application to recirculating flows, SIAM J. Sci. Comput. 21, 1670-1690.
#[derive(Debug)]
pub(super) struct Acceleration {
    /// Mass residuals before the last cycle.
    residual: Vec<f64>,
    /// Pressures that it ended with \[Pa\].
    pressure: Vec<f64>,
    /// Approach that it ended with \[m\].
    approach: f64,
    /// Whether there was a cycle to combine with.
    is_known: bool,
}

impl Acceleration {
    /// For fields of so many nodes, without a memory.
    pub(super) fn new(nodes: usize) -> Self {
        Self { residual: vec![0.0; nodes], pressure: vec![0.0; nodes], approach: 0.0, is_known: false }
    }

    /// Leaves out what earlier cycles did: those to come are of another kind.
    pub(super) fn forget(&mut self) {
        self.is_known = false;
    }

    /// Combines pressure and approach after a cycle with those after the cycle before. `start` is the state
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
        let share = product / square;
        let share =
            if self.is_known && share.is_finite() { share.clamp(-LARGEST_SHARE, LARGEST_SHARE) } else { 0.0 };
        let mix = |last: &mut f64, value: f64| {
            let mixed = value + share * (*last - value);
            *last = value;
            mixed
        };
        for (last, p) in self.pressure.iter_mut().zip(pressure) {
            *p = mix(last, *p).max(0.0);
        }
        *approach = mix(&mut self.approach, *approach);
        self.is_known = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;

    #[test]
    fn one_slow_error_is_gone_after_two_cycles() -> Result<(), crate::error::InputError> {
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
