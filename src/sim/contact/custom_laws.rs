//! Requirements on custom laws of the lubricant, checked before a contact is built.
//!
//! A custom law is evaluated at pressures up to the end of the lubricant table. Values that are not finite or decrease
//! would otherwise appear in the middle of a solve.

use crate::error::InputError;
use crate::lubricant::{DensityLaw, ViscosityLaw};

/// Number of test pressures up to the end of the lubricant table.
const PRESSURES: usize = 128;
/// Spacing of test pressures \[Pa\].
const STEP: f64 = 1.6e8;
/// Largest tested rise above the bulk temperature, in steps of one \[K\].
const WARMEST: u32 = 100;
/// Relative decrease accepted as rounding error.
const ROUNDING: f64 = 1e-12;

/// Checks that viscosities are positive and do not decrease with pressure. If the law depends on temperature, they must
/// not increase with temperature above the `bulk` temperature \[K\].
pub(in crate::sim) fn require_viscosity(law: &dyn ViscosityLaw, bulk: f64) -> Result<(), InputError> {
    let field = "viscosity of the law";
    require(field, "finite, above 0 and not falling with pressure", |p, out| law.fill(p, out))?;
    let mut most = f64::INFINITY;
    for temperature in (0..=WARMEST).map(|rise| bulk + f64::from(rise)) {
        let Some(value) = law.viscosity_at(0.0, temperature) else { break };
        let holds = value.is_finite() && value > 0.0 && value <= (1.0 + ROUNDING) * most;
        InputError::require(holds, field, value, "finite, above 0 and not rising with temperature")?;
        most = value;
    }
    Ok(())
}

/// Checks that the density ratio is one at zero pressure and does not decrease.
pub(in crate::sim) fn require_density(law: &dyn DensityLaw) -> Result<(), InputError> {
    let field = "density ratio of the law";
    let ambient = law.ratio(0.0);
    let is_one = (ambient - 1.0).abs() <= 1e-9;
    InputError::require(is_one, field, ambient, "1 without pressure")?;
    require(field, "finite and not falling with pressure", |p, out| law.fill(p, out))
}

/// Checks the values of `fill` at all test pressures.
fn require(
    field: &str,
    requirement: &'static str,
    fill: impl Fn(&[f64], &mut [f64]),
) -> Result<(), InputError> {
    let pressures: Vec<f64> = (0..=PRESSURES).map(|i| i as f64 * STEP).collect();
    let mut values = vec![f64::NAN; pressures.len()];
    fill(&pressures, &mut values);
    let mut least = 0.0;
    for &value in &values {
        let holds = value.is_finite() && value > 0.0 && value >= (1.0 - ROUNDING) * least;
        InputError::require(holds, field, value, requirement)?;
        least = value;
    }
    Ok(())
}
