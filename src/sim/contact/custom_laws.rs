//! What a law of the user's must hold before a contact is built on it.
//!
//! A law from outside is asked at pressures up to the end of the table of the lubricant: a value that is no
//! number, or that falls, would be met in the middle of a solve.

use crate::error::InputError;
use crate::lubricant::{DensityLaw, ViscosityLaw};

/// Pressures that laws of a lubricant are asked at, up to the end of its table.
const PRESSURES: usize = 128;
/// Distance of these pressures \[Pa\].
const STEP: f64 = 1.6e8;
/// Rise above the bulk temperature up to which they are asked, in steps of one \[K\].
const WARMEST: u32 = 100;
/// What rounding may take from a value that does not fall.
const ROUNDING: f64 = 1e-12;

/// Checks that viscosities are positive and do not fall with pressure, nor rise with temperature from the one
/// of the bulk, `bulk` \[K\], where the law knows temperature.
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

/// Checks that densities are those of the fluid without pressure at first and do not fall.
pub(in crate::sim) fn require_density(law: &dyn DensityLaw) -> Result<(), InputError> {
    let field = "density ratio of the law";
    let ambient = law.ratio(0.0);
    let is_one = (ambient - 1.0).abs() <= 1e-9;
    InputError::require(is_one, field, ambient, "1 without pressure")?;
    require(field, "finite and not falling with pressure", |p, out| law.fill(p, out))
}

/// Checks values at all pressures, those that `fill` gives.
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
