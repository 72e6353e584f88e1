//! Check of a state that a contestant calls converged, from the state alone.

use crate::report::Residuals;
use crate::reynolds::{ContactState, Evaluation, LubricatedContact, ReynoldsError};

/// Residual over tolerance up to which a state counts as converged: films may be rounded differently.
const ACCEPTED: f64 = 2.0;
/// Distance from the contact film that a gap may have at a tolerance of [`TIGHT`] or less \[m\]; in proportion
/// to larger tolerances.
const SLACK: f64 = 0.1e-9;
/// Tolerance of [`SLACK`].
const TIGHT: f64 = 1e-6;

/// The contradiction of `state` to a solution of `problem` within `tolerance`; `None` if it is one.
pub(super) fn contradiction(
    problem: &mut LubricatedContact<'_>,
    state: &ContactState,
    tolerance: f64,
) -> Result<Option<String>, ReynoldsError> {
    let fields = [&state.pressure, &state.fluid_pressure, &state.film];
    if fields.into_iter().flatten().any(|value| !value.is_finite()) || !state.approach.is_finite() {
        return Ok(Some("a field is not finite".to_owned()));
    }
    let mut evaluated = state.clone();
    let residuals = Evaluation::new(problem.grid()).evaluate(problem, &mut evaluated)?;
    Ok(of_residuals(residuals, tolerance)
        .or_else(|| of_fields(problem, &evaluated, tolerance))
        .or_else(|| of_load(problem, &evaluated, tolerance)))
}

fn of_residuals(residuals: Residuals, tolerance: f64) -> Option<String> {
    let holds = residuals.max() <= ACCEPTED * tolerance;
    (!holds).then(|| format!("evaluated residuals are {residuals} at a tolerance of {tolerance:.0e}"))
}

/// Signs of pressures and gaps, and the contact film under solid contact.
fn of_fields(problem: &LubricatedContact<'_>, state: &ContactState, tolerance: f64) -> Option<String> {
    let slack = SLACK * (tolerance / TIGHT).max(1.0);
    let least = |field: &[f64]| field.iter().copied().fold(f64::INFINITY, f64::min);
    let (pressure, gap) = (least(&state.fluid_pressure).min(least(&state.pressure)), least(&state.film));
    let contact_film = problem.contact_film();
    if pressure < 0.0 {
        return Some(format!("a pressure of {pressure:.3e} Pa"));
    }
    if gap < contact_film - slack {
        return Some(format!("a gap of {gap:.3e} m"));
    }
    let touching = state.in_contact.iter().zip(&state.film).filter(|(touches, _)| **touches);
    let furthest = touching.fold(0.0_f64, |most, (_, film)| most.max((film - contact_film).abs()));
    if furthest > slack {
        return Some(format!("solid contact {furthest:.3e} m off the contact film"));
    }
    let limits = problem.pressure_limit.into_iter().flatten();
    let excess =
        state.pressure.iter().zip(limits).fold(0.0_f64, |most, (p, limit)| most.max(p / limit - 1.0));
    (excess > ACCEPTED * tolerance).then(|| format!("a pressure {excess:.1e} above its limit"))
}

fn of_load(problem: &LubricatedContact<'_>, state: &ContactState, tolerance: f64) -> Option<String> {
    let load = problem.box_load()?;
    let carried = state.pressure.iter().sum::<f64>() * problem.grid().cell_area();
    let error = (carried / load - 1.0).abs();
    let holds = error <= ACCEPTED * tolerance;
    (!holds).then(|| format!("a relative load error of {error:.1e}"))
}
