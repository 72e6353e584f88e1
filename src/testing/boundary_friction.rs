//! The contract of boundary friction.

use super::{Contract, Violation, same};
use crate::boundary_friction::BoundaryFriction;

/// Solid pressures \[Pa\] of the check.
const PRESSURES: [f64; 4] = [0.0, 1e6, 1e9, 1e12];
/// Sliding speeds \[m/s\].
const SPEEDS: [f64; 4] = [0.0, 1e-3, 1.0, 1e3];
/// Tribofilms \[m\].
const FILMS: [f64; 4] = [0.0, 5e-9, 200e-9, 1e-3];

/// Checks `law` against the contract of [`BoundaryFriction`]: coefficients are finite and non-negative,
/// repeated calls agree, and field values equal node values.
///
/// # Errors
/// The first violation.
///
/// ```
/// stribeck::testing::boundary_friction(&stribeck::ConstantFriction::new(0.115)?)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn boundary_friction(law: &dyn BoundaryFriction) -> Result<(), Violation> {
    let contract = Contract::of(law);
    let first = law.coefficient(1e9, 0.1, [10e-9, 20e-9]);
    for pressure in PRESSURES {
        for speed in SPEEDS {
            for ball in FILMS {
                for disc in FILMS {
                    let coefficient = law.coefficient(pressure, speed, [ball, disc]);
                    let sound = coefficient.is_finite() && coefficient >= 0.0;
                    contract.require(sound, "coefficients are finite and not negative", || {
                        format!(
                            "{coefficient} at {pressure} Pa, {speed} m/s under {ball} m and {disc} m of film"
                        )
                    })?;
                }
            }
        }
    }
    let again = law.coefficient(1e9, 0.1, [10e-9, 20e-9]);
    contract.require(
        again.to_bits() == first.to_bits(),
        "coefficients depend on the arguments alone",
        || format!("{first} at first and {again} later"),
    )?;
    SPEEDS.into_iter().try_for_each(|speed| check_field(&contract, law, speed))
}

/// Compares the coefficients of a field at `speed` \[m/s\] with those of its nodes.
fn check_field(contract: &Contract, law: &dyn BoundaryFriction, speed: f64) -> Result<(), Violation> {
    let mut disc = FILMS;
    disc.reverse();
    let mut coefficients = [0.0; FILMS.len()];
    law.coefficients(&PRESSURES, speed, [&FILMS, &disc], &mut coefficients);
    for (k, coefficient) in coefficients.into_iter().enumerate() {
        let single = law.coefficient(PRESSURES[k], speed, [FILMS[k], disc[k]]);
        contract.require(same(coefficient, single), "fields have the coefficients of their nodes", || {
            format!("{coefficient} and {single} at {} Pa and {speed} m/s", PRESSURES[k])
        })?;
    }
    Ok(())
}
