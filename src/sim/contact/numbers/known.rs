//! States that have numbers.

use crate::reynolds::ContactState;

/// Whether a state is valid; that of a solve that diverged may not be.
pub(in crate::sim) fn is_known(state: &ContactState) -> bool {
    state.pressure.iter().chain(&state.film).all(|value| value.is_finite())
}
