//! The oil of a scene: its laws of viscosity and density.

use crate::error::InputError;
use crate::lubricant::{
    Barus, DensityLaw, DoolittleTait, DowsonHigginson, ImprovedYasutomi, Oil, PressureViscosity, Roelands,
    ThermalRoelands, ViscosityLaw,
};
use crate::sim::scene::{LubricantSpec, OilSpec, Scene, ViscositySpec};

/// The viscosity law of the scene at `temperature` \[K\].
pub(in crate::sim) fn viscosity(
    scene: &Scene,
    temperature: f64,
) -> Result<Option<Box<dyn ViscosityLaw>>, InputError> {
    let Some(spec) = scene.lubricant.filter(|_| scene.is_lubricated()) else { return Ok(None) };
    let law = viscosity_law(&spec, temperature)?;
    Ok(Some(law.at_temperature(temperature).unwrap_or(law)))
}

/// The law, checked whether the scene uses it or not.
pub(in crate::sim) fn viscosity_law(
    spec: &LubricantSpec,
    temperature: f64,
) -> Result<Box<dyn ViscosityLaw>, InputError> {
    if let Some(oil) = spec.oil {
        return Ok(Box::new(data_sheet_law(spec, &oil, temperature)?));
    }
    Ok(match spec.viscosity {
        Some(ViscositySpec::Barus(constants)) => {
            let law = Barus::new(constants.eta0, constants.alpha);
            Box::new(law.map_err(|error| error.within("lubricant.viscosity"))?)
        }
        Some(ViscositySpec::DoolittleTait(constants)) => Box::new(DoolittleTait::new(constants)?),
        Some(ViscositySpec::ImprovedYasutomi(constants)) => {
            Box::new(ImprovedYasutomi::new(constants, temperature)?)
        }
        None => match (spec.temperature, spec.roelands_s0) {
            (None, None) => Box::new(roelands(spec)?),
            (Some(reference), Some(slope)) => {
                Box::new(ThermalRoelands::new(roelands(spec)?, reference, slope)?)
            }
            (given, _) => {
                let missing = if given.is_none() { "temperature" } else { "roelands_s0" };
                return Err(InputError::Conflict {
                    field: format!("lubricant.{missing}"),
                    reason: "is missing: temperature and roelands_s0 are given together or not at all"
                        .to_owned(),
                });
            }
        },
    })
}

/// The oil by its data sheet at `temperature` \[K\].
fn data_sheet_law(spec: &LubricantSpec, oil: &OilSpec, temperature: f64) -> Result<Oil, InputError> {
    let pressure = match (spec.alpha, spec.temperature) {
        (None, None) => PressureViscosity::Correlation(oil.base_oil),
        (None | Some(0.0), Some(at)) => {
            return Err(InputError::Conflict {
                field: format!("lubricant.temperature = {at}"),
                reason: "is the temperature of lubricant.alpha, which is missing or 0; the temperature of the contact is \
                         thermal.bulk_temperature"
                    .to_owned(),
            });
        }
        (Some(alpha), at) => PressureViscosity::Measured { alpha, temperature: at.unwrap_or(temperature) },
    };
    Oil::new(oil.walther()?, oil.density_at_15(), pressure, temperature)
}

/// Roelands' law by its index or its slope.
fn roelands(spec: &LubricantSpec) -> Result<Roelands, InputError> {
    match spec.alpha {
        None => Roelands::new(spec.eta0, spec.roelands_z, spec.roelands_p0),
        Some(alpha) => Roelands::from_alpha(spec.eta0, alpha, spec.roelands_z, spec.roelands_p0),
    }
}

/// The density law of the scene at `temperature` \[K\].
pub(in crate::sim) fn density(
    scene: &Scene,
    temperature: f64,
) -> Result<Option<Box<dyn DensityLaw>>, InputError> {
    let Some(spec) = scene.lubricant.filter(|_| scene.is_lubricated()) else { return Ok(None) };
    density_law(&spec, temperature).map(Some)
}

/// The density law at `temperature` \[K\].
pub(in crate::sim) fn density_law(
    spec: &LubricantSpec,
    temperature: f64,
) -> Result<Box<dyn DensityLaw>, InputError> {
    let law: Box<dyn DensityLaw> = match spec.viscosity {
        Some(ViscositySpec::DoolittleTait(constants)) => Box::new(DoolittleTait::new(constants)?),
        _ => Box::new(DowsonHigginson::new(spec.density_a, spec.density_b)?),
    };
    Ok(law.at_temperature(temperature).unwrap_or(law))
}
