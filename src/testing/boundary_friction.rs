//! The contract of boundary friction.

use super::{Contract, Violation};
use crate::boundary_friction::BoundaryFriction;

/// Solid pressures \[Pa\], sliding speeds \[m/s\] and films \[m\] that coefficients are asked for.
const PRESSURES: [f64; 4] = [0.0, 1e6, 1e9, 1e12];
/// Sliding speeds \[m/s\].
const SPEEDS: [f64; 4] = [0.0, 1e-3, 1.0, 1e3];
/// Tribofilms \[m\].
const FILMS: [f64; 4] = [0.0, 5e-9, 200e-9, 1e-3];

/// Checks `law` against the contract of [`BoundaryFriction`]: coefficients are finite and not negative, and
/// the same for the same arguments, whatever was asked in between.
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
    contract.require(again.to_bits() == first.to_bits(), "coefficients depend on the arguments alone", || {
        format!("{first} at first and {again} later")
    })
}
