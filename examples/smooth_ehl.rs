//! Smooth contacts in oil at four speeds: central and minimum film beside the formulas of Hamrock and Dowson.
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

use std::error::Error;

use stribeck::analytic::FilmConditions;
use stribeck::lubricant::{Roelands, ViscosityLaw};
use stribeck::sim::scene::{GridSpec, RoughnessPair};
use stribeck::sim::{Scene, solve_contact};

fn main() -> Result<(), Box<dyn Error>> {
    let mut scene = Scene::azam_2019(64);
    scene.roughness = RoughnessPair::default();
    scene.plastic = None;
    scene.load.hertz_pressure = Some(0.5e9);
    let hertz = scene.hertz()?;
    let a = hertz.half_width_x;
    // Room for the inlet.
    scene.grid = GridSpec::Cells { nx: 96, ny: 64, x: [-4.0 * a, 2.0 * a], y: [-2.5 * a, 2.5 * a] };
    let oil = Roelands::new(0.04, 0.6, 1.96e8)?;
    if let Some(spec) = &mut scene.lubricant {
        (spec.eta0, spec.roelands_z) = (0.04, 0.6);
    }
    println!("{:>10} {:>24} {:>24}", "speed, m/s", "central film, nm", "minimum film, nm");
    println!("{:>10} {:>12}{:>12} {:>12}{:>12}", "", "solved", "formula", "solved", "formula");
    for speed in [0.25, 0.5, 1.0, 2.0] {
        scene.motion.entrainment_speed = speed;
        let solution = solve_contact(&scene)?;
        solution.report.require_converged()?;
        let formula = FilmConditions {
            entrainment_speed: speed,
            eta0: oil.viscosity(0.0),
            alpha: oil.log_slope(0.0),
            equivalent_modulus: scene.elastic.equivalent_modulus,
            radius: scene.form.radii().0,
            load: hertz.force,
            ellipticity: 1.0,
        };
        let [central, minimum] = [formula.hamrock_dowson_central()?, formula.hamrock_dowson_minimum()?];
        let film = solution.film;
        println!(
            "{speed:10.2} {:12.1}{:12.1} {:12.1}{:12.1}",
            film.central * 1e9,
            central * 1e9,
            film.minimum * 1e9,
            minimum * 1e9
        );
        assert!((film.central / central - 1.0).abs() < 0.2, "within a fifth of the formula");
    }
    Ok(())
}
