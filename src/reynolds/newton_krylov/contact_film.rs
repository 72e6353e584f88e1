//! The films of contact nodes between two Newton steps.

use crate::numerics::map_nodes;
use crate::reynolds::active_set::Solid;
use crate::reynolds::coupled::Coupled;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// Sets the films from elastic films and active set, clamps those of contact nodes to the contact film, which they have
/// at a solution, and evaluates the flow through them.
///
/// The linearization error leaves these films some nanometers off. The gap rows correct that; but mobilities go
/// with the cube of the film, and flows through the films as they are would drain the isolated regions whose
/// boundaries these nodes form.
pub(super) fn clamp_film_to_contact(
    coupled: &mut Coupled,
    problem: &LubricatedContact<'_>,
    state: &mut ContactState,
) {
    let Some(lubricant) = problem.lubricant else { return };
    coupled.update_film(problem, state);
    let contact_film = problem.contact_film();
    map_nodes(&mut state.film, |k, film| {
        if coupled.active_set[k].solid == Solid::Contact {
            *film = contact_film;
        }
    });
    coupled.flow(problem, lubricant, &state.fluid_pressure, &state.film);
}
