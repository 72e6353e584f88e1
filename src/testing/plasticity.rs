//! The contract of plasticity.

use super::{Contract, Violation, same};
use crate::plastic::PlasticityModel;

/// Films and plastic depths \[m\] in ascending order.
const FILMS: [f64; 5] = [0.0, 10e-9, 150e-9, 200e-9, 1e-6];
const DEPTHS: [f64; 5] = [0.0, 1e-9, 30e-9, 500e-9, 1e-5];

/// Checks `model` against the contract of [`PlasticityModel`]: limits are positive and do not decrease with
/// plastic depth, and the limit of a pair is the smaller one.
///
/// # Errors
/// The first violation.
///
/// ```
/// stribeck::testing::plasticity_model(&stribeck::plastic::ElasticPerfectlyPlastic::azam_2019())?;
/// # Ok::<(), stribeck::testing::Violation>(())
/// ```
pub fn plasticity_model(model: &dyn PlasticityModel) -> Result<(), Violation> {
    let contract = Contract::of(model);
    for film in FILMS {
        let mut lower = 0.0;
        for depth in DEPTHS {
            let limit = model.pressure_limit(film, depth);
            contract.require(limit > 0.0, "limits are positive", || {
                format!("{limit} Pa under {film} m of film at a depth of {depth} m")
            })?;
            contract.require(limit >= lower, "limits do not fall with depth", || {
                format!("{limit} Pa at a depth of {depth} m, {lower} Pa above, under {film} m of film")
            })?;
            lower = limit;
        }
    }
    let mut filled = DEPTHS;
    model.pressure_limits(&FILMS, &DEPTHS, &mut filled);
    for (k, limit) in filled.into_iter().enumerate() {
        let single = model.pressure_limit(FILMS[k], DEPTHS[k]);
        contract.require(same(limit, single), "fields are filled with the same values", || {
            format!("{limit} and {single} Pa")
        })?;
    }
    let mut backwards = (FILMS, DEPTHS);
    backwards.0.reverse();
    backwards.1.reverse();
    let mut pair = [0.0; 5];
    let films: [&[f64]; 2] = [&FILMS, &backwards.0];
    let depths: [&[f64]; 2] = [&DEPTHS, &backwards.1];
    model
        .contact_limit_into(films, depths, &mut pair)
        .map_err(|error| contract.broken("fields of one length are accepted", error.to_string()))?;
    for (k, limit) in pair.into_iter().enumerate() {
        let [first, second] = [0, 1].map(|body| model.pressure_limit(films[body][k], depths[body][k]));
        contract.require(same(limit, first.min(second)), "the limit of a pair is the smaller one", || {
            format!("{limit} Pa for bodies of {first} and {second} Pa")
        })?;
    }
    let refused = model.contact_limit_into([&FILMS[..2], &FILMS], depths, &mut pair).is_err();
    contract.require(refused, "fields of different length are refused", || "they were accepted".to_owned())
}
