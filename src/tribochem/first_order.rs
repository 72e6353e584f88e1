//! First-order kinetics.

/// Exact first-order relaxation of `state` to `limit` at `rate` \[1/s\] over `time` \[s\].
pub(super) fn relax(state: f64, limit: f64, rate: f64, time: f64) -> f64 {
    state - (limit - state) * (-rate * time).exp_m1()
}
