//! First-order approach to a limit.

/// `state` after relaxing towards `limit` at `rate` \[1/s\] for `time` \[s\], exactly.
pub(super) fn relax(state: f64, limit: f64, rate: f64, time: f64) -> f64 {
    state - (limit - state) * (-rate * time).exp_m1()
}
