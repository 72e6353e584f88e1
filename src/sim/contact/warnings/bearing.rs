//! Warnings about rigid bearings of scenes.

use super::Warning;
use super::given_film::{ISOVISCOUS, LARGEST_RISE};
use super::limits::{negative_index, steep_dimples};
use super::quantity::OIL_TEMPERATURE;
use crate::sim::scene::{OilSpec, PadRelief};

/// Warnings about a solved bearing of a scene with its load \[N\] and the temperature of its oil \[K\]: one without load, an oil by its data sheet at a temperature that oils do not have, steep dimples.
pub(in crate::sim) fn bearing_warnings(
    [load, temperature]: [f64; 2],
    oil: Option<&OilSpec>,
    relief: Option<&PadRelief>,
) -> Vec<Warning> {
    let idle = (load <= 0.0).then(|| {
        let message = if load < 0.0 {
            "the film pulls the surfaces together: its mean pressure is below ambient"
        } else if relief.is_some() {
            "the film carries no load: it cavitates behind its first dimples, or its pressures cancel"
        } else {
            "the film carries no load: it does not converge in the direction of motion"
        };
        let remedy = "inlet_film above outlet_film, an eccentricity above 0, or a supply pressure".to_owned();
        Warning::new("load", load, message.to_owned(), remedy)
    });
    let steep = match relief {
        Some(&PadRelief::Dimples { diameter, depth, .. }) => {
            steep_dimples("given_film.dimple_depth", depth, diameter)
        }
        _ => None,
    };
    let index = oil.and_then(negative_index);
    let hot = oil.and_then(|_| OIL_TEMPERATURE.check("temperature", temperature));
    [idle, steep, hot, index].into_iter().flatten().collect()
}

/// Warning about a bearing whose film is not converged, with `alpha` \[1/Pa\] and the viscosity ratio of the last iteration.
pub(in crate::sim) fn unsolved_bearing([alpha, viscosity_ratio]: [f64; 2], is_rigid: bool) -> Warning {
    let message = "the film is not converged: load, friction, flows and power are unknown";
    if is_rigid && viscosity_ratio > LARGEST_RISE {
        let message = format!("{message}; the viscosity rises with pressure between rigid surfaces");
        return Warning::new("alpha", alpha, message, ISOVISCOUS.to_owned());
    }
    let remedy = "other cells (nx, ny), a lower load or a thicker film".to_owned();
    Warning::new("status", f64::NAN, message.to_owned(), remedy)
}
