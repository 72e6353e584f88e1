//! Progress of the cycles: stall, and the predicted number of cycles.

/// Stall window: cycles without progress after which the solve has stalled.
const STALL_WINDOW: u64 = 3;
/// Ratio of a residual to the best one that counts as progress.
const SUFFICIENT_DECREASE: f64 = 0.8;
/// Number of cycles over which the convergence rate is averaged.
const RATE_CYCLES: usize = 3;
/// Consecutive cycles with films below the contact film that end the solve.
const MAX_TOUCHING_CYCLES: u64 = 8;

/// Reduction of the residual over the cycles so far.
pub(super) struct Progress {
    /// Smallest residual at the last sufficient decrease.
    reference: f64,
    /// Cycles since then.
    pub(super) stalled_cycles: u64,
    /// Cycles in a row whose film touches.
    touching: u64,
    /// Residuals of the last cycles, newest first.
    pub(super) last: [f64; RATE_CYCLES],
}

impl Default for Progress {
    fn default() -> Self {
        let last = [f64::INFINITY; RATE_CYCLES];
        Self { reference: f64::INFINITY, stalled_cycles: 0, touching: 0, last }
    }
}

impl Progress {
    /// Takes in the smallest residual so far.
    pub(super) fn see_best(&mut self, best: f64) {
        if best < SUFFICIENT_DECREASE * self.reference {
            (self.reference, self.stalled_cycles) = (best, 0);
        } else {
            self.stalled_cycles += 1;
        }
    }

    /// Takes in the `residual` of a cycle. Predicted number of cycles from it to the `tolerance` at the mean rate of the last
    /// [`RATE_CYCLES`]; zero without so many.
    pub(super) fn cycles_needed(&mut self, residual: f64, tolerance: f64) -> f64 {
        let earlier = self.last[RATE_CYCLES - 1];
        self.last.rotate_right(1);
        self.last[0] = residual;
        if !earlier.is_finite() {
            return 0.0;
        }
        let gained = (earlier / residual).ln() / RATE_CYCLES as f64;
        if gained > 0.0 { (residual / tolerance).ln() / gained } else { f64::INFINITY }
    }

    /// Whether the residual no longer falls, or the film has touched for too many cycles.
    pub(super) fn is_stalled(&mut self, touches: bool) -> bool {
        self.touching = if touches { self.touching + 1 } else { 0 };
        self.stalled_cycles > STALL_WINDOW || self.touching > MAX_TOUCHING_CYCLES
    }
}
