//! End of a history of two hours against the number of its steps, with places along the track and at
//! random: the scene of `examples/scenes/dry_history.toml`. Writes a table and a figure into
//! `target/step_study`.
//!
//! ```text
//! cargo run --release -p studies --bin step_study [-- SEEDS]     # 2 seeds of the places
//! ```
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/chart/mod.rs"]
mod chart;
#[path = "../../examples/command/mod.rs"]
mod command;

use std::error::Error;
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::Path;
use std::process::ExitCode;

use chart::{BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use plotters::style::RGBColor;
use stribeck::metrics::height_statistics;
use stribeck::sim::scene::{RoughnessPair, TrackMotion};
use stribeck::sim::{MixedLubricationSim, Scene, SimError, StepRecord};

const USAGE: &str = "usage: cargo run --release -p studies --bin step_study [-- SEEDS]\n";
/// Time of a history \[s\].
const END: f64 = 7200.0;
/// Numbers of steps.
const STEPS: [u32; 5] = [72, 144, 288, 720, 2880];
const HEADER: &str =
    "scene,motion,seed,steps,rq_ball_m,rq_disc_m,track_wear_ball_m,track_wear_disc_m,plastic_volume_m3";

/// Smooth or rough, with a film or without.
#[derive(Clone, Copy)]
struct Case {
    name: &'static str,
    label: &'static str,
    /// The quantity of the panel, in the unit of the label.
    value: fn(&StepRecord) -> f64,
    rough: bool,
    film: bool,
}

const CASES: [Case; 3] = [
    Case {
        name: "smooth",
        label: "Rq smooth, nm",
        value: |r| 1e9 * r.roughness.ball_rq,
        rough: false,
        film: false,
    },
    Case {
        name: "bare",
        label: "Rq rough, nm",
        value: |r| 1e9 * r.roughness.ball_rq,
        rough: true,
        film: false,
    },
    Case {
        name: "film",
        label: "flattened, \u{b5}m\u{b3}",
        value: |r| 1e18 * r.plastic.volume,
        rough: true,
        film: true,
    },
];

/// The last record of a history.
fn end(scene: &Scene, steps: u32) -> Result<Option<StepRecord>, SimError> {
    let mut sim = MixedLubricationSim::builder(scene.clone()).build()?;
    let mut last = None;
    sim.run(
        u64::from(steps),
        END / f64::from(steps),
        &mut |_: &MixedLubricationSim, record: &StepRecord| {
            last = Some(record.clone());
            ControlFlow::Continue(())
        },
    )?;
    // The record has the roughness before the last step.
    if let Some(StepRecord { roughness, .. }) = &mut last {
        for (rq, body) in [&mut roughness.ball_rq, &mut roughness.disc_rq].into_iter().zip(sim.bodies()) {
            *rq = height_statistics(&sim.track_roughness(body.surface())?)?.sq;
        }
    }
    Ok(last)
}

/// The histories of `scene` in more and more steps: a line of the figure, a row of the table each.
fn line(
    case: &Case,
    scene: &Scene,
    (name, colour): (&str, RGBColor),
    table: &mut String,
) -> Result<Line, Box<dyn Error>> {
    let mut points = Vec::new();
    for steps in STEPS {
        let Some(record) = end(scene, steps)? else { continue };
        let (rq, wear) = (record.roughness.rq(), record.wear.in_contact());
        let row = format!(
            "{},{name},{},{steps},{:e},{:e},{:e},{:e},{:e}",
            case.name, scene.track.seed, rq[0], rq[1], wear[0], wear[1], record.plastic.volume
        );
        println!("{row}");
        writeln!(table, "{row}")?;
        points.push((f64::from(steps).log10(), (case.value)(&record)));
    }
    Ok(Line { pen: Pen::strong(colour), points })
}

fn main() -> ExitCode {
    command::run("step_study", USAGE, seeds(), |&seeds| study(seeds))
}

/// Seeds of the places, 2 by default; none where the usage is asked for.
fn seeds() -> Result<Option<u64>, lexopt::Error> {
    use lexopt::prelude::*;
    let mut seeds = 2;
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Value(count) => seeds = count.parse::<u64>()?.max(1),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    Ok(Some(seeds))
}

fn study(seeds: u64) -> Result<(), Box<dyn Error>> {
    let base =
        Scene::load(Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/scenes/dry_history.toml"))?;
    let mut table = format!("{HEADER}\n");
    let mut panels = Vec::new();
    println!("{HEADER}");
    for case in CASES {
        let mut scene = base.clone();
        if !case.rough {
            scene.roughness = RoughnessPair::default();
        }
        scene.tribofilm = scene.tribofilm.filter(|_| case.film);
        let mut lines = Vec::new();
        for (motion, name, colour) in
            [(TrackMotion::AlongTrack, "along_track", BLUE), (TrackMotion::Random, "random", VERMILION)]
        {
            for seed in 0..seeds {
                (scene.track.motion, scene.track.seed) = (motion, seed);
                lines.push(line(&case, &scene, (name, colour), &mut table)?);
            }
        }
        panels.push(Panel { y_label: case.label, lines });
    }
    let figure = Figure {
        title: "Two hours by the number of steps".to_owned(),
        x_label: "steps",
        x_scale: XScale::Decades,
        legend: vec![
            (Pen::strong(BLUE), "even places along the track".to_owned()),
            (Pen::strong(VERMILION), "random places along and across".to_owned()),
        ],
        panels,
    };
    let folder = Path::new("target/step_study");
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("step_study.csv"), table)?;
    figure.write(&folder.join("step_study.svg"))?;
    println!("table and figure are in {}", folder.display());
    Ok(())
}
