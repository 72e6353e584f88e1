//! Film and friction over the slide-roll ratio with the temperature of the film, beside the isothermal
//! contact.
//!
//! ```text
//! cargo run --release -p studies --bin thermal_film            # 64 x 64 cells, 27 contacts three times each
//! cargo run --release -p studies --bin thermal_film -- --quick # 32 x 32 cells, 9 contacts
//! ```

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/chart/mod.rs"]
mod chart;
#[path = "../../examples/command/mod.rs"]
mod command;
#[path = "../../examples/command/quick.rs"]
mod quick;

use std::error::Error;
use std::fmt::Write as _;
use std::process::ExitCode;

use chart::{BLACK, BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use quick::{Options, options};
use rayon::prelude::*;
use stribeck::analytic::ThermalInlet;
use stribeck::sim::scene::GridSpec;
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::thermal::{FilmProfile, FilmThermal};

const USAGE: &str = "\
usage: cargo run --release -p studies --bin thermal_film -- [--quick] [--out DIR]

  --quick    fewer and coarser contacts
  --out DIR  where to write thermal_film.csv and thermal_film.svg (default target/thermal_film)
";
const SPEEDS: [f64; 3] = [1.0, 2.0, 5.0];
const BULK: f64 = 313.15;
const VISCOSITY: f64 = 0.04;
const INDEX: f64 = 1.1;
const PRESSURE: f64 = 0.8e9;

fn main() -> ExitCode {
    command::run("thermal_film", USAGE, options("target/thermal_film"), run)
}

/// A steel ball on a smooth steel disc, 40 mPa s at 40 C, an Eyring fluid with a limiting stress.
fn scene(nodes: usize, speed: f64, ratio: f64) -> Scene {
    let mut scene = Scene::azam_2019(nodes);
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.load.hertz_pressure = Some(PRESSURE);
    scene.motion.entrainment_speed = speed;
    scene.motion.slide_roll_ratio = ratio;
    scene.thermal.bulk_temperature = BULK;
    scene.friction.eyring_stress = Some(5e6);
    scene.grid = GridSpec::Cells { nx: nodes, ny: nodes, x: [-0.35e-3, 0.2e-3], y: [-0.22e-3, 0.22e-3] };
    if let Some(oil) = &mut scene.lubricant {
        (oil.eta0, oil.alpha, oil.formula_alpha) = (VISCOSITY, Some(18e-9), None);
        (oil.temperature, oil.roelands_s0) = (Some(BULK), Some(INDEX));
    }
    scene
}

/// The same contact isothermal, with the parabolic profile and by collocation.
fn solve(nodes: usize, speed: f64, ratio: f64) -> Result<[ContactSolution; 3], Box<dyn Error + Send + Sync>> {
    let mut scene = scene(nodes, speed, ratio);
    let isothermal = solve_contact(&scene)?;
    let mut warm = |profile| {
        if let Some(oil) = &mut scene.lubricant {
            oil.thermal = Some(FilmThermal::default().with_profile(profile));
        }
        solve_contact(&scene)
    };
    let solutions = [isothermal, warm(FilmProfile::Parabola)?, warm(FilmProfile::Collocation)?];
    for solution in &solutions {
        solution.report.require_converged()?;
    }
    Ok(solutions)
}

/// Film over the isothermal one by the formula of Gupta et al.
fn formula(speed: f64, slide_roll_ratio: f64, modulus: f64) -> Result<f64, Box<dyn Error>> {
    let inlet = ThermalInlet {
        entrainment_speed: speed,
        eta0: VISCOSITY,
        temperature_coefficient: 18e-9 * 1.96e8 / 0.68 * INDEX / (BULK - 138.0),
        conductivity: FilmThermal::default().conductivity,
        pressure_over_modulus: PRESSURE / modulus,
        slide_roll_ratio,
    };
    Ok(inlet.gupta()?)
}

fn rise(solution: &ContactSolution) -> f64 {
    solution.thermal.as_ref().map_or(0.0, |heat| heat.film_temperature_max - BULK)
}

/// Lines of the figure at one speed: loss of film, friction with heat and without it, rise of the film.
type Lines = [Vec<(f64, f64)>; 4];

/// Solves the contacts at `speed` over the slide-roll ratio; prints them and appends them to `table`.
fn over_sliding(nodes: usize, speed: f64, steps: u32, table: &mut String) -> Result<Lines, Box<dyn Error>> {
    let mut lines = Lines::default();
    let ratios: Vec<f64> = (0..=steps).map(|step| 2.0 * f64::from(step) / f64::from(steps)).collect();
    let contacts: Result<Vec<_>, _> = ratios.par_iter().map(|ratio| solve(nodes, speed, *ratio)).collect();
    let contacts = contacts.map_err(|error| -> Box<dyn Error> { error })?;
    for (ratio, solved) in ratios.into_iter().zip(contacts) {
        for (profile, solution) in ["isothermal", "parabola", "collocation"].into_iter().zip(&solved) {
            let (film, friction) = (solution.film.central, solution.friction.coefficient);
            writeln!(table, "{speed},{ratio},{profile},{film:e},{friction:e},{:e}", rise(solution))?;
        }
        let film = [0, 1, 2].map(|k| solved[k].film.central * 1e9);
        let friction = [0, 1, 2].map(|k| solved[k].friction.coefficient);
        let modulus = scene(nodes, speed, ratio).equivalent_modulus()?;
        let (ours, gupta) = (film[2] / film[0], formula(speed, ratio, modulus)?);
        let rises = [rise(&solved[1]), rise(&solved[2])];
        println!(
            "{speed:<4} {ratio:<5.2} {:7.1} {:7.1} {:7.1} {ours:6.3} {gupta:6.3}   {:.4} {:.4} {:.4}  {:6.2} {:6.2}",
            film[0], film[1], film[2], friction[0], friction[1], friction[2], rises[0], rises[1]
        );
        let values = [100.0 * (1.0 - ours), friction[2], friction[0], rises[1]];
        for (line, y) in lines.iter_mut().zip(values) {
            line.push((ratio, y));
        }
    }
    Ok(lines)
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let (nodes, steps) = if options.quick { (32, 2) } else { (64, 8) };
    let mut panels =
        [("loss of film, %", Vec::new()), ("friction", Vec::new()), ("rise of film, K", Vec::new())];
    let mut legend = Vec::new();
    let mut table = String::from(
        "entrainment_speed_m_s,slide_roll_ratio,profile,film_central_m,friction_coefficient,film_temperature_rise_k\n",
    );
    println!(
        "m/s  S     film nm: isothermal, parabola, collocation; ratio, Gupta   friction: the same three  rise K"
    );
    for (speed, colour) in SPEEDS.into_iter().zip([BLUE, VERMILION, BLACK]) {
        let lines = over_sliding(nodes, speed, steps, &mut table)?;
        legend.push((Pen::strong(colour), format!("{speed} m/s")));
        legend.push((Pen::dashed(colour), format!("{speed} m/s, isothermal")));
        let pens = [Pen::strong(colour), Pen::strong(colour), Pen::dashed(colour), Pen::strong(colour)];
        for ((points, pen), panel) in lines.into_iter().zip(pens).zip([0, 1, 1, 2]) {
            panels[panel].1.push(Line { pen, points });
        }
    }
    let figure = Figure {
        title: "Film, friction and heat of a smooth contact".to_owned(),
        x_label: "slide-roll ratio",
        x_scale: XScale::FromZero,
        legend,
        panels: panels.into_iter().map(|(y_label, lines)| Panel { y_label, lines }).collect(),
    };
    std::fs::create_dir_all(&options.out)?;
    std::fs::write(options.out.join("thermal_film.csv"), table)?;
    let path = options.out.join("thermal_film.svg");
    figure.write(&path)?;
    println!("{}", path.display());
    Ok(())
}
