//! Scenes whose film has a temperature of its own.

use crate::error::InputError;
use crate::lubricant::ViscosityLaw;
use crate::sim::scene::Scene;

/// Whether the film temperature is modelled.
pub(in crate::sim) fn models_film_temperature(scene: &Scene) -> bool {
    scene.is_lubricated() && scene.lubricant.is_some_and(|lubricant| lubricant.thermal.is_some())
}

/// Checks that a modelled film temperature has a viscosity `law` that depends on temperature.
pub(in crate::sim) fn validate_film_temperature(
    scene: &Scene,
    law: Option<&dyn ViscosityLaw>,
) -> Result<(), InputError> {
    let asked = scene.lubricant.is_some_and(|lubricant| lubricant.thermal.is_some());
    match law {
        Some(law) if asked && law.viscosity_at(0.0, scene.thermal.bulk_temperature).is_none() => {
            Err(InputError::Conflict {
                field: "lubricant.thermal".to_owned(),
                reason: "the viscosity does not know temperature: give lubricant.temperature and lubricant.roelands_s0, an oil by \
                         lubricant.grade or lubricant.kinematic, or another law as lubricant.viscosity"
                    .to_owned(),
            })
        }
        _ => Ok(()),
    }
}
