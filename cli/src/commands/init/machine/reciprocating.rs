//! A ball on a disc that reciprocates with a sinusoidal displacement.

use std::error::Error;
use std::f64::consts::TAU;

use super::super::answers::Answers;
use super::{Machine, Options, length, number};

/// Options of the ball alone.
pub(super) const OPTIONS: [&str; 4] = ["--radius", "--load", "--stroke", "--frequency"];
/// Rows of a period.
const ROWS: u32 = 120;

/// The ball over a period, from the largest speed of the disc on.
pub(super) fn machine(options: &Options, answers: &Answers) -> Result<Machine, Box<dyn Error>> {
    let stroke = length("--stroke", &options.stroke)?;
    let frequency = number("--frequency", options.frequency)?;
    let speed = 0.5 * TAU * frequency * stroke;
    let times: Vec<f64> = (0..=ROWS).map(|k| f64::from(k) / f64::from(ROWS) / frequency).collect();
    // The speed is exactly zero at the dead points.
    let cosine = |k: u32| {
        let is_dead_point = k % (ROWS / 2) == ROWS / 4;
        if is_dead_point { 0.0 } else { (TAU * f64::from(k % ROWS) / f64::from(ROWS)).cos() }
    };
    let count = times.len();
    Ok(Machine {
        title: "Ball on a disc that reciprocates, over a period".to_owned(),
        bodies: ["ball", "disc"],
        is_line: false,
        reverses: true,
        key: String::new(),
        loads: vec![answers.load.value; count],
        speeds: [vec![0.0; count], (0..=ROWS).map(|k| speed * cosine(k)).collect()],
        radii: vec![answers.radius.value; count],
        places: ("time", times),
    })
}
