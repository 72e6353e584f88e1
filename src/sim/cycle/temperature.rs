//! Warning about temperatures that change nothing.

use crate::error::InputError;
use crate::sim::contact::warnings::Warning;
use crate::sim::scene::Scene;
use crate::sim::scene::cycle_table::CycleTable;

/// The warning about bulk temperatures of `table` that differ while the oil of `scene` has one viscosity.
pub(super) fn without_effect(scene: &Scene, table: &CycleTable) -> Result<Option<Warning>, InputError> {
    let temperatures = || table.rows.iter().map(|row| row.bulk_temperature);
    let (coldest, warmest) =
        (temperatures().fold(f64::INFINITY, f64::min), temperatures().fold(0.0, f64::max));
    let eta0 = |bulk_temperature: f64| {
        let mut at = scene.clone();
        at.thermal.bulk_temperature = bulk_temperature;
        Ok::<_, InputError>(at.oil_numbers()?.map(|oil| oil.eta0))
    };
    if warmest <= coldest || eta0(coldest)? != eta0(warmest)? {
        return Ok(None);
    }
    Ok(Some(Warning::new(
        "cycle.bulk_temperature",
        warmest,
        format!(
            "the temperature varies from {coldest} K, but the viscosity of the oil does not depend on it: films do not change"
        ),
        "an oil by its grade or kinematic viscosities, or lubricant.temperature with roelands_s0".to_owned(),
    )))
}
