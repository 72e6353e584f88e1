//! The contact of the unified Reynolds model, as published by Azam et al. (2019).
//!
//! One pressure satisfies a Reynolds equation without pressure flow below the cut-off film. It is clipped at the
//! limit, where the overlap is plastic depth. Pressure below the cut-off film counts as solid pressure after the
//! solve.

use super::problem::LubricatedContact;
use super::state::ContactState;

/// Relative distance below which a pressure counts as at the limit. Steps relaxed by `w` stop short of the limit by
/// `2^-53 / w`, where further ones are lost to rounding; this tolerance holds for `w` down to 1.1e-4.
const LIMIT_ROUNDING: f64 = 1e-12;

/// Makes the total pressure the pressure of the Reynolds equation.
pub(super) fn merge_pressures(state: &mut ContactState) {
    state.fluid_pressure.copy_from_slice(&state.pressure);
}

/// Overwrites films and plastic depths with those of `elastic_film`. The overlap of nodes at the limit is flattened
/// after the solve and not part of the film.
pub(super) fn update_film(problem: &LubricatedContact<'_>, elastic_film: &[f64], state: &mut ContactState) {
    for (k, &film) in elastic_film.iter().enumerate() {
        let at_limit = is_at_limit(problem, k, state.pressure[k]);
        state.plastic_depth[k] = if at_limit { (-film).max(0.0) } else { 0.0 };
        state.film[k] = film;
    }
}

/// Divides the pressure into that of the fluid and, at nodes below the cut-off film, that of solids.
pub(super) fn mark_contact(problem: &LubricatedContact<'_>, state: &mut ContactState) {
    for (k, flag) in state.in_contact.iter_mut().enumerate() {
        *flag = state.pressure[k] > 0.0 && state.film[k] < problem.contact_film();
        state.fluid_pressure[k] = if *flag { 0.0 } else { state.pressure[k] };
    }
}

/// Whether pressure `p` is at the limit of node `k` within [`LIMIT_ROUNDING`].
pub(super) fn is_at_limit(problem: &LubricatedContact<'_>, k: usize, p: f64) -> bool {
    problem.pressure_limit.is_some_and(|limit| reaches_limit(p, limit[k]))
}

/// Whether pressure `p` is at `limit` within rounding.
pub(crate) fn reaches_limit(p: f64, limit: f64) -> bool {
    p >= limit * (1.0 - LIMIT_ROUNDING)
}
