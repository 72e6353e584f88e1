//! The contracts of viscosity and density.

use super::{Contract, Violation, close, same};
use crate::lubricant::{DensityLaw, ViscosityLaw};

/// Pressures \[Pa\] in ascending order, from ambient to far beyond any contact.
const PRESSURES: [f64; 12] = [0.0, 1e3, 1e6, 1e7, 5e7, 1.1e8, 3e8, 7.7e8, 1.3e9, 3.1e9, 6.2e9, 1e12];
/// Accepted difference between slope and difference quotient, relative to the larger of the slopes here and
/// at ambient pressure.
const SLOPE_TOLERANCE: f64 = 1e-3;

/// Checks `law` against the contract of [`ViscosityLaw`]: the viscosity is finite, positive and
/// non-decreasing with pressure; negative pressures count as zero; the logarithmic slope is the derivative;
/// field values equal single values; and `viscosity_at` equals the law `at_temperature`.
///
/// # Errors
/// The first violation.
///
/// ```
/// stribeck::testing::viscosity_law(&stribeck::lubricant::Barus::new(0.01, 20e-9)?)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn viscosity_law(law: &dyn ViscosityLaw) -> Result<(), Violation> {
    let contract = Contract::of(law);
    let mut field = PRESSURES;
    law.fill(&PRESSURES, &mut field);
    let mut lower = 0.0;
    for (p, filled) in PRESSURES.into_iter().zip(field) {
        let eta = law.viscosity(p);
        contract.require(eta.is_finite() && eta > 0.0, "viscosity is finite and positive", || {
            format!("{eta} Pa s at {p} Pa")
        })?;
        contract.require(eta >= lower, "viscosity does not fall with pressure", || {
            format!("{eta} Pa s at {p} Pa, {lower} Pa s below")
        })?;
        contract.require(same(filled, eta), "fields are filled with the same values", || {
            format!("{filled} and {eta} Pa s at {p} Pa")
        })?;
        lower = eta;
    }
    for temperature in [250.0, 350.0, 450.0] {
        let boxed = law.at_temperature(temperature).map(|law| law.viscosity(3e8));
        let value = law.viscosity_at(3e8, temperature);
        let agree = boxed.zip(value).map_or(boxed == value, |(boxed, value)| same(boxed, value));
        contract.require(agree, "viscosity_at is that of at_temperature", || {
            format!("{value:?} and {boxed:?} Pa s at {temperature} K")
        })?;
    }
    let (negative, ambient) = (law.viscosity(-1e8), law.viscosity(0.0));
    contract.require(same(negative, ambient), "pressures below zero count as zero", || {
        format!("{negative} Pa s at -1e8 Pa, {ambient} Pa s at 0")
    })?;
    slopes(&contract, |p| law.viscosity(p).ln(), |p| law.log_slope(p))
}

/// Checks `law` against the contract of [`DensityLaw`]: the ratio is finite, 1 at ambient pressure and
/// non-decreasing with pressure; negative pressures count as zero; the slope is the derivative; and field
/// values equal single values.
///
/// # Errors
/// The first violation.
///
/// ```
/// stribeck::testing::density_law(&stribeck::lubricant::Incompressible)?;
/// # Ok::<(), stribeck::testing::Violation>(())
/// ```
pub fn density_law(law: &dyn DensityLaw) -> Result<(), Violation> {
    let contract = Contract::of(law);
    let ambient = law.ratio(0.0);
    contract.require(close(ambient, 1.0, 1.0, 1e-12), "the ratio is 1 at ambient pressure", || {
        format!("{ambient}")
    })?;
    let (mut ratios, mut ratio_slopes) = (PRESSURES, PRESSURES);
    law.fill(&PRESSURES, &mut ratios);
    law.fill_slopes(&PRESSURES, &mut ratio_slopes);
    let mut lower = 0.0;
    for (p, filled) in PRESSURES.into_iter().zip(ratios.into_iter().zip(ratio_slopes)) {
        let ratio = law.ratio(p);
        contract.require(
            same(filled.0, ratio) && same(filled.1, law.slope(p)),
            "fields are filled with the same values",
            || format!("{filled:?}, {ratio} and {} 1/Pa at {p} Pa", law.slope(p)),
        )?;
        contract.require(
            ratio.is_finite() && ratio >= lower,
            "density does not fall with pressure",
            || format!("{ratio} at {p} Pa, {lower} below"),
        )?;
        lower = ratio;
    }
    let negative = law.ratio(-1e8);
    contract.require(same(negative, ambient), "pressures below zero count as zero", || {
        format!("{negative} at -1e8 Pa, {ambient} at 0")
    })?;
    slopes(&contract, |p| law.ratio(p), |p| law.slope(p))
}

/// Compares `slope` with central differences of `value`.
fn slopes(
    contract: &Contract,
    value: impl Fn(f64) -> f64,
    slope: impl Fn(f64) -> f64,
) -> Result<(), Violation> {
    let ambient = slope(0.0);
    for p in PRESSURES {
        let given = slope(p);
        let step = 1e-4 * p.max(1e6);
        let low = (p - step).max(0.0);
        let found = (value(p + step) - value(low)) / (p + step - low);
        // Beyond the range of tables the difference quotient is dominated by rounding.
        let rounding = 1e-15 * value(p).abs() / step;
        let accepted = SLOPE_TOLERANCE * given.abs().max(ambient.abs()) + rounding;
        contract.require((given - found).abs() <= accepted, "the slope is the derivative", || {
            format!("{given} 1/Pa given, {found} 1/Pa by differences at {p} Pa")
        })?;
    }
    Ok(())
}
