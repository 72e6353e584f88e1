//! The contract of wear.

use super::{Contract, Violation, same, surface_states};
use crate::surface_state::SurfaceState;
use crate::wear::WearLaw;

/// Films \[m\] of the check.
const FILMS: [f64; 4] = [0.0, 20e-9, 200e-9, 1e-6];

/// Checks `law` against the contract of [`WearLaw`]: rates are finite and non-negative, zero at rest and
/// without load; they do not decrease with the sliding speed or, in contact, with the load; field values
/// equal node values.
///
/// # Errors
/// The first violation.
///
/// ```
/// stribeck::testing::wear_law(&stribeck::wear::Archard::azam_2019())?;
/// # Ok::<(), stribeck::testing::Violation>(())
/// ```
pub fn wear_law(law: &dyn WearLaw) -> Result<(), Violation> {
    let contract = Contract::of(law);
    for at in surface_states() {
        for film in FILMS {
            check_at(&contract, law, &at, film)?;
        }
    }
    let (points, films): (Vec<SurfaceState>, Vec<f64>) =
        surface_states().into_iter().flat_map(|at| FILMS.map(|film| (at, film))).unzip();
    let mut rates = vec![0.0; points.len()];
    law.depth_rates(&points, &films, &mut rates);
    for (rate, (at, film)) in rates.into_iter().zip(points.iter().zip(films)) {
        let single = law.depth_rate(at, film);
        contract.require(same(rate, single), "fields have the rates of their nodes", || {
            format!("{rate} and {single} m/s under {film} m of film at {at:?}")
        })?;
    }
    Ok(())
}

/// Checks all clauses at one node under `film` \[m\].
fn check_at(contract: &Contract, law: &dyn WearLaw, at: &SurfaceState, film: f64) -> Result<(), Violation> {
    let rate = law.depth_rate(at, film);
    contract.require(rate.is_finite() && rate >= 0.0, "rates are finite and never negative", || {
        format!("{rate} m/s under {film} m of film at {at:?}")
    })?;
    let resting = law.depth_rate(&SurfaceState { sliding_speed: 0.0, ..*at }, film);
    contract
        .require(resting == 0.0, "the rate is zero at rest", || format!("{resting} m/s at {at:?} at rest"))?;
    let unloaded = loaded(at, 0.0);
    let idle = law.depth_rate(&unloaded, film);
    contract
        .require(idle == 0.0, "the rate is zero without load", || format!("{idle} m/s at {unloaded:?}"))?;
    for factor in [1.5, 4.0] {
        let faster = SurfaceState { sliding_speed: factor * at.sliding_speed, ..*at };
        let heavier = loaded(at, factor);
        for (clause, harder) in
            [("faster sliding never wears less", faster), ("higher load never wears less", heavier)]
        {
            let more = law.depth_rate(&harder, film);
            contract.require(more >= rate * (1.0 - 1e-12), clause, || {
                format!("{more} m/s at {harder:?}, {rate} m/s at {at:?}")
            })?;
        }
    }
    Ok(())
}

/// The node with all stresses multiplied by `factor`.
fn loaded(at: &SurfaceState, factor: f64) -> SurfaceState {
    SurfaceState {
        pressure: factor * at.pressure,
        solid_pressure: factor * at.solid_pressure,
        shear_stress: factor * at.shear_stress,
        ..*at
    }
}
