//! Warnings about rigid bearings of scenes.

use super::quantity::OIL_TEMPERATURE;
use super::{Warning, short};
use crate::sim::scene::PadRelief;

/// Largest depth of dimples over their diameter.
const STEEPEST_DIMPLE: f64 = 0.1;

/// Warnings about a bearing of a scene with its load and the temperature of its oil: one without load, an oil by its data sheet at a temperature that oils do not have, steep dimples.
pub(in crate::sim) fn bearing_warnings(
    (load, temperature): (f64, f64),
    has_data_sheet: bool,
    relief: Option<&PadRelief>,
) -> Vec<Warning> {
    let idle = (load <= 0.0).then(|| {
        let message = "the film carries no load: it does not converge in the direction of motion".to_owned();
        let remedy = "inlet_film above outlet_film, an eccentricity above 0, or a supply pressure".to_owned();
        Warning::new("load", load, message, remedy)
    });
    let steep = match relief {
        Some(&PadRelief::Dimples { diameter, depth, .. }) if depth > STEEPEST_DIMPLE * diameter => {
            let message = format!(
                "it is {} of the diameter: the Reynolds equation holds for films of small slopes",
                short((1e3 * depth / diameter).round() / 1e3)
            );
            let remedy = "shallower dimples; take load and friction as a guess".to_owned();
            Some(Warning::new("given_film.dimple_depth", depth, message, remedy))
        }
        _ => None,
    };
    let hot = has_data_sheet.then(|| OIL_TEMPERATURE.check("temperature", temperature)).flatten();
    [idle, steep, hot].into_iter().flatten().collect()
}
