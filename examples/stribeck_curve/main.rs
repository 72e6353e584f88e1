//! The curve that the crate is named after: friction over speed, from boundary lubrication to full film, with the share
//! of the load that solids carry and the film over the roughness.
//!
//! ```text
//! cargo run --release --example stribeck_curve                          # 64 x 64 nodes, 21 speeds
//! cargo run --release --example stribeck_curve -- --grid 128 --points 25 --out target/curve
//! ```

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../chart/mod.rs"]
mod chart;

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use chart::{BLUE, Figure, Line, Panel, Pen, XScale};
use lexopt::prelude::*;
use stribeck::metrics::composite_rq;
use stribeck::sim::scene::{RandomRoughness, Roughness, RoughnessPair};
use stribeck::sim::{Scene, solve_contact};

const USAGE: &str = "\
usage: cargo run --release --example stribeck_curve -- [--grid N] [--points N] [--out DIR]

  --grid N    nodes along each side of the grid (default 64)
  --points N  speeds from 0.1 mm/s to 10 m/s (default 21)
  --out DIR   where to write stribeck_curve.svg and .csv (default target/stribeck_curve)
";
/// Root mean square heights of ball and disc \[m\].
const RQ: [f64; 2] = [5e-9, 40e-9];
/// Slowest speed and decades up to the fastest.
const SLOWEST: f64 = 1e-4;
const DECADES: f64 = 5.0;

struct Options {
    grid: usize,
    points: usize,
    out: PathBuf,
}

/// The contact at one speed.
struct Point {
    speed: f64,
    friction: f64,
    load_ratio: f64,
    lambda: f64,
}

fn main() -> ExitCode {
    let outcome = match options() {
        Ok(Some(options)) => run(&options),
        Ok(None) => {
            print!("{USAGE}");
            Ok(())
        }
        Err(error) => Err(format!("{error}\n{USAGE}").into()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("stribeck_curve: {error}");
            ExitCode::FAILURE
        }
    }
}

fn options() -> Result<Option<Options>, lexopt::Error> {
    let mut options = Options { grid: 64, points: 21, out: PathBuf::from("target/stribeck_curve") };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("grid") => options.grid = parser.value()?.parse()?,
            Long("points") => options.points = parser.value()?.parse()?,
            Long("out") => options.out = PathBuf::from(parser.value()?),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    if options.points < 2 {
        return Err("--points must be at least 2".into());
    }
    Ok(Some(options))
}

/// A steel ball on a fine-ground disc in an oil of 20 mPa s, half rolling, half sliding.
fn scene(grid: usize, speed: f64) -> Scene {
    let mut scene = Scene::azam_2019(grid);
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

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let rq = composite_rq(RQ[0], RQ[1]);
    let mut points = Vec::new();
    println!("{:>10} {:>9} {:>10} {:>8}", "speed, m/s", "friction", "load ratio", "lambda");
    for k in 0..options.points {
        let speed = SLOWEST * 10_f64.powf(DECADES * k as f64 / (options.points - 1) as f64);
        let solution = solve_contact(&scene(options.grid, speed))?;
        if let Err(error) = solution.report.require_converged() {
            eprintln!("stribeck_curve: {speed:.4} m/s is left out: {error}");
            continue;
        }
        let point = Point {
            speed,
            friction: solution.friction_coefficient,
            load_ratio: solution.contact.load_ratio,
            lambda: solution.film.mean_central / rq,
        };
        println!("{speed:10.4} {:9.4} {:10.4} {:8.3}", point.friction, point.load_ratio, point.lambda);
        points.push(point);
    }
    std::fs::create_dir_all(&options.out).map_err(|error| format!("{}: {error}", options.out.display()))?;
    write_table(&points, &options.out.join("stribeck_curve.csv"))?;
    draw(&points, &options.out.join("stribeck_curve.svg"))?;
    println!("table and figure are in {}", options.out.display());
    Ok(())
}

fn write_table(points: &[Point], path: &Path) -> Result<(), Box<dyn Error>> {
    let mut text = String::from("entrainment_speed_m_per_s,friction_coefficient,load_ratio,lambda\n");
    for point in points {
        writeln!(text, "{:e},{:e},{:e},{:e}", point.speed, point.friction, point.load_ratio, point.lambda)?;
    }
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()).into())
}

fn draw(points: &[Point], path: &Path) -> Result<(), Box<dyn Error>> {
    let line = |value: fn(&Point) -> f64| {
        let points = points.iter().map(|point| (point.speed.log10(), value(point))).collect();
        vec![Line { pen: Pen::strong(BLUE), points }]
    };
    let figure = Figure {
        title: "Stribeck curve of a rough ball on disc".to_owned(),
        x_label: "entrainment speed, m/s",
        x_scale: XScale::Decades,
        legend: Vec::new(),
        panels: vec![
            Panel { y_label: "friction", lines: line(|point| point.friction) },
            Panel { y_label: "load ratio", lines: line(|point| point.load_ratio) },
            Panel { y_label: "\u{3bb} = h_avg / Rq", lines: line(|point| point.lambda) },
        ],
    };
    figure.write(path)
}
