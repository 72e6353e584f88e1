//! Heat balance of a bearing.
//!
//! The through-flow `Q` carries the share `k` of the power loss: `k P = c Q (T_outlet - T_supply)` with the heat capacity `c` of a
//! volume of oil. The oil has the mean of both temperatures (ISO 7902-1). `P` and `Q` depend on that temperature by the viscosity;
//! it is found by false position (Illinois).

use super::{BearingSolution, RigidBearing};
use crate::error::InputError;
use crate::numerics::FalsePosition;
use crate::sim::contact::warnings::reject_oil_temperature;
use crate::sim::error::SimError;
use crate::sim::scene::{BearingSpec, HeatBalance};

/// Error of the temperature \[K\].
const TOLERANCE: f64 = 1e-3;
/// Flow over that along the film below which it is rounding.
const ROUNDING: f64 = 1e-8;
/// Most solves.
const MOST_SOLVES: usize = 40;

/// Solves `bearing` at the temperature of the heat balance.
pub(super) fn solve(
    bearing: &RigidBearing,
    balance: &HeatBalance,
    interrupted: &dyn Fn() -> bool,
) -> Result<BearingSolution, SimError> {
    let supply = balance.supply_temperature;
    InputError::require_positive("given_film.supply_temperature", supply)?;
    reject_oil_temperature("given_film.supply_temperature", supply)?;
    InputError::require_positive("given_film.heat_capacity", balance.heat_capacity)?;
    let share = balance.share;
    let requirement = "above 0 and at most 1: the share of the power loss that the oil carries";
    InputError::require(share > 0.0 && share <= 1.0, "given_film.heat_share", share, requirement)?;
    let at = |temperature: f64| {
        let mut solution = bearing.solve_at(temperature, interrupted)?;
        let flow = through_flow(bearing, &solution);
        if flow <= ROUNDING * solution.film.flow.inflow {
            return Err(InputError::Conflict {
                field: "given_film.supply_temperature".to_owned(),
                reason: "no oil flows through the film, which could carry the heat; a feed pressure, or an eccentricity above 0"
                    .to_owned(),
            }
            .into());
        }
        let numbers = &mut solution.numbers;
        let rise = balance.rise(numbers.power_loss, flow);
        numbers.supply_temperature = Some(supply);
        numbers.outlet_temperature = Some(supply + rise);
        numbers.carried_heat = Some(share * numbers.power_loss);
        let excess = supply + 0.5 * rise - temperature;
        Ok::<_, SimError>((solution, excess))
    };
    // The rise falls with the temperature where the oil thins: its first value is a bound.
    let (first, excess) = at(supply)?;
    if excess.abs() < TOLERANCE {
        return Ok(first);
    }
    let (mut low, mut bracket) = ([supply, excess], None::<FalsePosition>);
    for _ in 0..MOST_SOLVES {
        let temperature = bracket.map_or(low[0] + low[1], |bracket| bracket.next(0.0));
        let (solution, excess) = at(temperature)?;
        if excess.abs() < TOLERANCE {
            return Ok(solution);
        }
        match &mut bracket {
            Some(bracket) => bracket.add(temperature, excess),
            None if excess > 0.0 => low = [temperature, excess],
            None => bracket = Some(FalsePosition::new(low, [temperature, excess], Some(false))),
        }
    }
    let [low, high] = bracket.map_or([low[0], low[0] + low[1]], |bracket| bracket.ends());
    Err(InputError::Conflict {
        field: "given_film.supply_temperature".to_owned(),
        reason: format!(
            "the heat balance does not settle between {low:.1} and {high:.1} K; more flow, or a smaller heat_share"
        ),
    }
    .into())
}

/// The oil that leaves with the heat \[m^3/s\]: through the sides of a journal, through all edges of a pad.
fn through_flow(bearing: &RigidBearing, solution: &BearingSolution) -> f64 {
    match bearing.bearing {
        BearingSpec::Journal { .. } => solution.film.side_flow,
        // Oil that goes around a ring does not leave it.
        _ if bearing.is_periodic => solution.film.edge_flows[2..].iter().map(|flow| flow.max(0.0)).sum(),
        _ => solution.film.flow.outflow,
    }
}
