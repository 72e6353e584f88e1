//! The contact of the unified Reynolds model, as published by Azam et al. (2019): evaluation and residuals of a state.
//!
//! One pressure satisfies a Reynolds equation without pressure flow below the cut-off film. It is clipped at the
//! limit, where the overlap is plastic depth. Pressure below the cut-off film counts as solid pressure after the
//! solve. `sweeps` solves it.

mod sweeps;

pub(super) use sweeps::{Damping, Sweeps};

use super::active_set::{Fluid, Solid};
use super::coupled::{Changed, Coupled};
use super::problem::LubricatedContact;
use super::state::ContactState;
use crate::error::InputError;
use crate::report::Residuals;

/// Relative distance below which a pressure counts as at the limit. Steps relaxed by `w` stop short of the limit by
/// `2^-53 / w`, where further ones are lost to rounding; this tolerance holds for `w` down to 1.1e-4.
const LIMIT_ROUNDING: f64 = 1e-12;

/// Sets schemes and elastic response of `problem`; pressure flow ends below the contact film.
pub(super) fn configure(coupled: &mut Coupled, problem: &LubricatedContact<'_>) {
    coupled.configure(problem);
    coupled.fluid.close_below(problem.contact_film());
}

/// Evaluates `state` from the quantity that has `changed` on, as [`Coupled::evaluate`] does the hard contact.
pub(super) fn evaluate(
    coupled: &mut Coupled,
    problem: &mut LubricatedContact<'_>,
    state: &mut ContactState,
    changed: Changed,
) -> Result<Residuals, InputError> {
    if matches!(changed, Changed::Everything | Changed::Pressures) {
        // The total pressure is that of the Reynolds equation.
        state.fluid_pressure.copy_from_slice(&state.pressure);
        coupled.displace(problem, state)?;
    }
    if changed != Changed::Film {
        update_film(problem, &coupled.elastic_film, state);
    }
    coupled.update_flow(problem, state);
    if changed == Changed::Everything {
        classify(coupled, problem, state);
    }
    Ok(residuals(coupled, problem, state))
}

/// Overwrites films and plastic depths with those of `elastic_film`. The overlap of nodes at the limit is flattened
/// after the solve and not part of the film.
fn update_film(problem: &LubricatedContact<'_>, elastic_film: &[f64], state: &mut ContactState) {
    for (k, &film) in elastic_film.iter().enumerate() {
        let at_limit = reaches_limit(state.pressure[k], problem.limit_at(k));
        state.plastic_depth[k] = if at_limit { (-film).max(0.0) } else { 0.0 };
        state.film[k] = film;
    }
}

/// Determines the active set. Solids carry no pressure of their own.
fn classify(coupled: &mut Coupled, problem: &LubricatedContact<'_>, state: &ContactState) {
    coupled.classify(problem, state);
    for node in &mut coupled.active_set {
        node.solid = Solid::Open;
    }
}

/// Residuals of the evaluated `state`. Films are not bounded, so that no gap has an error.
fn residuals(coupled: &Coupled, problem: &LubricatedContact<'_>, state: &ContactState) -> Residuals {
    let (mut mass, mut build_up) = (0.0, 0.0);
    for k in 0..state.pressure.len() {
        let is_inside = coupled.active_set[k].fluid != Fluid::Boundary;
        if is_inside && reaches_limit(state.pressure[k], problem.limit_at(k)) {
            // Clipped at the limit: the pressure of the equation would be higher.
            mass += coupled.balance[k].max(0.0);
        } else {
            let [imbalance, accumulation] = coupled.mass_errors(problem, state, k);
            mass += imbalance;
            build_up += accumulation;
        }
    }
    coupled.scaled(problem, state, [mass, build_up, 0.0])
}

/// Divides the pressure into that of the fluid and, at nodes below the cut-off film, that of solids.
pub(super) fn mark_contact(problem: &LubricatedContact<'_>, state: &mut ContactState) {
    for (k, flag) in state.in_contact.iter_mut().enumerate() {
        *flag = state.pressure[k] > 0.0 && state.film[k] < problem.contact_film();
        state.fluid_pressure[k] = if *flag { 0.0 } else { state.pressure[k] };
    }
}

/// Whether pressure `p` is at `limit` within [`LIMIT_ROUNDING`].
pub(crate) fn reaches_limit(p: f64, limit: f64) -> bool {
    p >= limit * (1.0 - LIMIT_ROUNDING)
}
