//! Speeds of a curve.

use std::error::Error;

use stribeck::InputError;
use stribeck::sim::scene::{Motion, Scene};

use super::Options;
use crate::output;

/// Range of speeds around that of the scene.
const RANGE: f64 = 100.0;

/// The motion at the start of the schedule of an oiled contact.
pub(super) fn start_motion(options: &Options, scene: &Scene) -> Result<Motion, Box<dyn Error>> {
    if !scene.is_lubricated() {
        return Err(output::in_scene(
            &options.scene,
            &InputError::Conflict {
                field: "lubricant".to_owned(),
                reason: "a Stribeck curve needs an oil, this contact is dry".to_owned(),
            },
        )
        .into());
    }
    let in_scene = |error: InputError| output::in_scene(&options.scene, &error);
    let motion = scene.conditions(0.0).map_err(in_scene)?.motion;
    // That of the scene is checked even where other speeds are given.
    let (field, speed) = ("motion.entrainment_speed", motion.entrainment_speed);
    output::require(speed >= 0.0, field, speed, "finite and >= 0: the oil flows along +x")
        .map_err(in_scene)?;
    Ok(motion)
}

/// Those that are asked for, about the `own` one of the scene \[m/s\].
pub(super) fn speeds(options: &Options, own: f64) -> Result<Vec<f64>, Box<dyn Error>> {
    if options.from.is_none() || options.to.is_none() {
        output::require(own > 0.0, "motion.entrainment_speed", own, "finite and > 0")
            .map_err(|error| output::in_scene(&options.scene, &error))?;
    }
    let (from, to) = (options.from.unwrap_or(own / RANGE), options.to.unwrap_or(own * RANGE));
    if to <= from {
        return Err(format!("--to = {to} m/s must be above --from = {from} m/s").into());
    }
    let last = f64::from(options.points - 1);
    Ok((0..options.points).map(|k| from * (to / from).powf(f64::from(k) / last)).collect())
}
