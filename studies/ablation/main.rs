//! Cost of each setting of Newton's method: switched off, halved or doubled in turn.
//!
//! ```text
//! cargo run --release -p studies --bin ablation                    # everything over all scenes; hours
//! cargo run --release -p studies --bin ablation -- --every 12      # every twelfth scene of the stability map
//! cargo run --release -p studies --bin ablation -- --change step_bound  # the changes whose names contain "step_bound"
//! cargo run --release -p studies --bin ablation -- --quick         # a few coarse scenes
//! ```
//!
//! Three groups of contacts: rough reference contacts at 128 x 128 from the dry contact, scenes of the
//! stability map, and the contacts of a history, each of which starts from the one before.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

mod changes;
#[path = "../../examples/command/mod.rs"]
mod command;
#[path = "../stability_map/scenes.rs"]
mod scenes;

use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use changes::{CHANGES, Change};
use lexopt::prelude::*;
use scenes::Group;
use stribeck::reynolds::{NewtonKrylov, NewtonSettings};
use stribeck::sim::scene::Roughness;
use stribeck::sim::{MixedLubricationSim, Scene};
use stribeck::surface::Advected;

const USAGE: &str = "\
usage: cargo run --release -p studies --bin ablation -- [--quick] [--every N] [--seeds N] [--change NAME] [--out DIR]

  --quick        a few coarse scenes and changes
  --every N      every Nth scene of the stability map (default 1)
  --seeds N      seeds of the map (default 3)
  --change NAME  changes whose names contain NAME (default all)
  --out DIR      where to write ablation.csv (default target/ablation)
";
const THREADS: usize = 2;
/// Contacts of the history \[-\] and the time between them \[s\].
const HISTORY: (u32, f64) = (60, 10.0);

struct Options {
    quick: bool,
    every: usize,
    seeds: u64,
    change: String,
    out: PathBuf,
}

fn main() -> ExitCode {
    command::run("ablation", USAGE, options(), run)
}

fn options() -> Result<Option<Options>, lexopt::Error> {
    let (change, out) = (String::new(), PathBuf::from("target/ablation"));
    let mut options = Options { quick: false, every: 1, seeds: 3, change, out };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("quick") => options.quick = true,
            Long("every") => {
                options.every = parser.value()?.parse_with(|n| n.parse().map(|n: usize| n.max(1)))?;
            }
            Long("seeds") => options.seeds = parser.value()?.parse()?,
            Long("change") => options.change = parser.value()?.string()?,
            Long("out") => options.out = parser.value()?.into(),
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected()),
        }
    }
    Ok(Some(options))
}

/// A scene and how many contacts of it are solved, this time apart \[s\].
struct Job {
    scene: Scene,
    contacts: u32,
    time_step: f64,
    moves: bool,
}

/// What a group of contacts costs.
#[derive(Debug, Clone, Copy, Default)]
struct Cost {
    convolutions: f64,
    seconds: f64,
    failures: u32,
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let groups = [
        ("reference", reference(options.quick)),
        ("map", map(options)?),
        ("history", history(options.quick)),
    ];
    let changes = CHANGES.iter().filter(|change| change.name.contains(&options.change));
    let changes = changes.take(if options.quick { 3 } else { usize::MAX });
    let mut table = String::from(
        "change,group,contacts,convolutions,seconds,failures,relative_convolutions,relative_seconds\n",
    );
    let defaults = groups.each_ref().map(|(_, jobs)| cost(jobs, &NewtonSettings::default()));
    println!(
        "{:44} {:>10} {:>12} {:>6} {:>6} {:>6}",
        "change", "group", "convolutions", "rel.", "time", "failed"
    );
    let none = Change { name: "none", apply: |_| () };
    for change in std::iter::once(&none).chain(changes) {
        let mut settings = NewtonSettings::default();
        (change.apply)(&mut settings);
        for ((name, jobs), before) in groups.iter().zip(defaults) {
            let now = if change.name == none.name { before } else { cost(jobs, &settings) };
            let relative = (now.convolutions / before.convolutions, now.seconds / before.seconds);
            println!(
                "{:44} {name:>10} {:12.0} {:6.3} {:6.3} {:6}",
                change.name, now.convolutions, relative.0, relative.1, now.failures
            );
            // Writing to a string cannot fail.
            let _ = writeln!(
                table,
                "{},{name},{},{:.0},{:.2},{},{:.4},{:.4}",
                change.name,
                jobs.iter().map(|job| job.contacts).sum::<u32>(),
                now.convolutions,
                now.seconds,
                now.failures,
                relative.0,
                relative.1
            );
        }
    }
    std::fs::create_dir_all(&options.out)?;
    std::fs::write(options.out.join("ablation.csv"), table)?;
    Ok(())
}

/// Eight pairs of surfaces, hard, soft and fast.
fn reference(quick: bool) -> Vec<Job> {
    let (pairs, cells) = if quick { (1, 32) } else { (8, 128) };
    let mut jobs = Vec::new();
    for pair in 0..pairs {
        for variant in 0..3 {
            let mut scene = Scene::azam_2019(cells);
            let rough = |rq, seed| Roughness::gaussian(rq, 10e-6, seed);
            scene.roughness.ball = rough(20e-9, 2 * pair + 1);
            scene.roughness.disc = rough(130e-9, 2 * pair + 2);
            if let Some(plastic) = &mut scene.plastic {
                plastic.film_hardness = None;
                if variant == 1 {
                    plastic.hardness = 2e9;
                }
            }
            if variant == 2 {
                scene.motion.entrainment_speed = 1.0;
            }
            jobs.push(Job { scene, contacts: 1, time_step: 1e-3, moves: false });
        }
    }
    jobs
}

/// Scenes of the stability map.
fn map(options: &Options) -> Result<Vec<Job>, Box<dyn Error>> {
    let seeds = if options.quick { 1 } else { options.seeds };
    let every = if options.quick { 4 } else { options.every };
    let mut jobs = Vec::new();
    for seed in 1..=seeds {
        let cases = scenes::cases(false, options.quick, seed)
            .into_iter()
            .filter(|case| case.group != Group::Infeasible);
        for case in cases.step_by(every) {
            let scene = case.scene()?;
            let cell = scene.grid()?.dx();
            let moves = case.cells > 0;
            let time_step = if moves { f64::from(case.cells) * cell / case.speed } else { 1e-3 };
            jobs.push(Job { scene, contacts: if moves { 6 } else { 1 }, time_step, moves });
        }
    }
    Ok(jobs)
}

/// One history of the reference scene.
fn history(quick: bool) -> Vec<Job> {
    let (contacts, time_step) = if quick { (4, HISTORY.1) } else { HISTORY };
    vec![Job { scene: Scene::azam_2019(if quick { 32 } else { 64 }), contacts, time_step, moves: false }]
}

fn cost(jobs: &[Job], settings: &NewtonSettings) -> Cost {
    let next = AtomicUsize::new(0);
    let sum = Mutex::new(Cost::default());
    std::thread::scope(|scope| {
        for _ in 0..THREADS {
            scope.spawn(|| {
                while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let cost = solve(job, settings);
                    if let Ok(mut sum) = sum.lock() {
                        sum.convolutions += cost.convolutions;
                        sum.seconds += cost.seconds;
                        sum.failures += cost.failures;
                    }
                }
            });
        }
    });
    sum.into_inner().unwrap_or_default()
}

/// All contacts of a job, up to the first that fails.
fn solve(job: &Job, settings: &NewtonSettings) -> Cost {
    let mut cost = Cost::default();
    let started = Instant::now();
    let sim =
        NewtonKrylov::with_settings(settings.clone()).map_err(|error| error.to_string()).and_then(|solver| {
            let builder = MixedLubricationSim::builder(job.scene.clone()).solver(solver);
            let builder = if job.moves { builder.motion(Advected).with_squeeze() } else { builder };
            builder.build().map_err(|error| error.to_string())
        });
    match sim {
        Err(error) => {
            eprintln!("{error}");
            cost.failures += 1;
        }
        Ok(mut sim) => {
            for _ in 0..job.contacts {
                let (report, failed) = match sim.step(job.time_step) {
                    Ok(record) => (Some(record.report), false),
                    Err(stribeck::sim::SimError::NotConverged { source, .. }) => (Some(*source.report), true),
                    Err(_) => (None, true),
                };
                cost.convolutions += report.map_or(0.0, |report| report.work.convolutions);
                if failed {
                    cost.failures += 1;
                    break;
                }
            }
        }
    }
    cost.seconds = started.elapsed().as_secs_f64();
    cost
}
