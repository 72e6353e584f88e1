//! The curve that the crate is named after: friction over speed, from boundary lubrication to full film, with the share
//! of the load that solids carry and the film over the roughness. Writes a table and a figure into `target/stribeck_curve`.
//!
//! ```text
//! cargo run --release --example stribeck_curve [-- SPEEDS]     # 21 from 0.1 mm/s to 10 m/s
//! ```
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

#[path = "../chart/mod.rs"]
mod chart;

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use chart::{BLUE, Figure, Line, Panel, Pen, XScale};
use stribeck::metrics::composite_rq;
use stribeck::sim::scene::{RandomRoughness, Roughness, RoughnessPair};
use stribeck::sim::{Scene, solve_contact};

/// Root mean square heights of ball and disc \[m\].
const RQ: [f64; 2] = [5e-9, 40e-9];

/// A steel ball on a fine-ground disc in an oil of 20 mPa s, half rolling, half sliding.
fn scene(speed: f64) -> Scene {
    let mut scene = Scene::azam_2019(64);
    scene.load.hertz_pressure = Some(0.8e9);
    scene.motion.entrainment_speed = speed;
    scene.motion.slide_roll_ratio = 0.5;
    if let Some(oil) = &mut scene.lubricant {
        oil.eta0 = 0.02;
    }
    let random =
        |rq, seed| Roughness::Gaussian(RandomRoughness { rq, length_x: 20e-6, length_y: 20e-6, seed });
    scene.roughness = RoughnessPair { ball: random(RQ[0], 1), disc: random(RQ[1], 2) };
    scene.friction.eyring_stress = Some(5e6);
    scene.solver.tolerance = 1e-4;
    scene
}

fn main() -> Result<(), Box<dyn Error>> {
    let count = std::env::args().nth(1).map_or(Ok(21), |count| count.parse::<u32>())?.max(2);
    // Friction, share of the load on solids and film over roughness, over the logarithm of the speed.
    let mut curves = [const { Vec::new() }; 3];
    let mut table = String::from("entrainment_speed_m_per_s,friction_coefficient,load_ratio,lambda\n");
    println!("{:>10} {:>9} {:>10} {:>8}", "speed, m/s", "friction", "load ratio", "lambda");
    for k in 0..count {
        let decade = 5.0 * f64::from(k) / f64::from(count - 1) - 4.0;
        let speed = 10_f64.powf(decade);
        let solution = solve_contact(&scene(speed))?;
        if let Err(error) = solution.report.require_converged() {
            println!("{speed:10.4} is left out: {error}");
            continue;
        }
        let lambda = solution.film.mean_central / composite_rq(RQ[0], RQ[1]);
        let numbers = [solution.friction_coefficient, solution.contact.load_ratio, lambda];
        println!("{speed:10.4} {:9.4} {:10.4} {:8.3}", numbers[0], numbers[1], numbers[2]);
        writeln!(table, "{speed:e},{:e},{:e},{:e}", numbers[0], numbers[1], numbers[2])?;
        curves.iter_mut().zip(numbers).for_each(|(curve, number)| curve.push((decade, number)));
    }
    let labels = ["friction", "load ratio", "\u{3bb} = h_avg / Rq"];
    let panel = |(y_label, points)| Panel { y_label, lines: vec![Line { pen: Pen::strong(BLUE), points }] };
    let figure = Figure {
        title: "Stribeck curve of a rough ball on disc".to_owned(),
        x_label: "entrainment speed, m/s",
        x_scale: XScale::Decades,
        legend: Vec::new(),
        panels: labels.into_iter().zip(curves).map(panel).collect(),
    };
    let folder = Path::new("target/stribeck_curve");
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("stribeck_curve.csv"), table)?;
    figure.write(&folder.join("stribeck_curve.svg"))?;
    println!("table and figure are in {}", folder.display());
    Ok(())
}
