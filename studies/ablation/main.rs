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

#[path = "../../examples/command/mod.rs"]
mod command;

use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

use lexopt::prelude::*;
use stribeck::benchmark::{Benchmark, Budget, Case, Cases, Contestant, History, Results};
use stribeck::reynolds::NewtonSettings;
use stribeck::sim::Scene;
use stribeck::sim::scene::Roughness;

const USAGE: &str = "\
usage: cargo run --release -p studies --bin ablation -- [--quick] [--every N] [--seeds N] [--change NAME] [--out DIR]

  --quick        a few coarse scenes and changes
  --every N      every Nth scene of the stability map (default 1)
  --seeds N      seeds of the map (default 3)
  --change NAME  changes whose names contain NAME (default all)
  --out DIR      where to write ablation.csv (default target/ablation)
";
const NONE: &str = "none";

type Change = fn(&mut NewtonSettings);

/// Changes of the settings with their names.
const CHANGES: [(&str, Change); 15] = [
    ("no continuation", |s| s.least_film_ratio = f64::INFINITY),
    ("first_contact_film: 1 (no film homotopy)", |s| s.first_contact_film = 1.0),
    ("first_contact_film x 2", |s| s.first_contact_film *= 2.0),
    ("warm_start_threshold x 0.1", |s| s.warm_start_threshold *= 0.1),
    ("warm_start_threshold x 10", |s| s.warm_start_threshold *= 10.0),
    ("step_bound x 0.5", |s| s.step_bound *= 0.5),
    ("step_bound x 3", |s| s.step_bound *= 3.0),
    ("pseudo_transient off", |s| s.pseudo_transient = (0.0, 0.0)),
    ("pseudo_transient x 2", |s| s.pseudo_transient.0 *= 2.0),
    ("krylov_tolerance: 0.03", |s| s.krylov_tolerance = 0.03),
    ("krylov_tolerance: 0.01", |s| s.krylov_tolerance = 0.01),
    ("krylov_tolerance: 0.3", |s| s.krylov_tolerance = 0.3),
    ("stall_window x 0.5", |s| s.stall_window /= 2),
    ("stall_window x 2", |s| s.stall_window *= 2),
    ("halvings: 1", |s| s.halvings = 1),
];

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
            Long("every") => options.every = parser.value()?.parse()?,
            Long("seeds") => options.seeds = parser.value()?.parse()?,
            Long("change") => options.change = parser.value()?.string()?,
            Long("out") => options.out = parser.value()?.into(),
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected()),
        }
    }
    Ok(Some(options))
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let changes = CHANGES.iter().filter(|(name, _)| name.contains(&options.change));
    let changes = changes.take(if options.quick { 3 } else { usize::MAX });
    let mut contestants = vec![Contestant::newton(NONE, NewtonSettings::default())?];
    for (name, apply) in changes {
        let mut settings = NewtonSettings::default();
        apply(&mut settings);
        contestants.push(Contestant::newton(*name, settings)?);
    }
    let groups = [
        ("reference", reference(options.quick)),
        ("map", map(options)?),
        ("history", history(options.quick)),
    ];
    let mut table = String::from(
        "change,group,contacts,convolutions,seconds,failures,relative_convolutions,relative_seconds\n",
    );
    println!(
        "{:44} {:>10} {:>12} {:>6} {:>6} {:>6}",
        "change", "group", "convolutions", "rel.", "time", "failed"
    );
    for (group, cases) in groups {
        let contacts: u32 =
            cases.iter().filter_map(|case| case.history).map(|history| history.contacts).sum();
        let benchmark = Benchmark::new(cases).contestants(contestants.clone());
        let results = benchmark.budget(Budget::unlimited()).threads(2).run()?;
        let [convolutions, seconds, _] = cost(&results, NONE);
        for name in results.contestants() {
            let now = cost(&results, name);
            let relative = (now[0] / convolutions, now[1] / seconds);
            println!(
                "{name:44} {group:>10} {:12.0} {:6.3} {:6.3} {:6}",
                now[0], relative.0, relative.1, now[2]
            );
            writeln!(
                table,
                "{name},{group},{contacts},{:.0},{:.2},{},{:.4},{:.4}",
                now[0], now[1], now[2], relative.0, relative.1
            )?;
        }
    }
    std::fs::create_dir_all(&options.out)?;
    std::fs::write(options.out.join("ablation.csv"), table)?;
    Ok(())
}

/// Convolutions, seconds and failures of a contestant.
fn cost(results: &Results, contestant: &str) -> [f64; 3] {
    results.of(contestant).fold([0.0; 3], |[convolutions, seconds, failures], row| {
        let more = if row.all_convolutions.is_nan() { 0.0 } else { row.all_convolutions };
        [convolutions + more, seconds + row.seconds, failures + f64::from(u8::from(!row.is_solved()))]
    })
}

/// Eight pairs of surfaces, hard, soft and fast.
fn reference(quick: bool) -> Vec<Case> {
    let (pairs, cells) = if quick { (1, 32) } else { (8, 128) };
    let mut cases = Vec::new();
    for pair in 0..pairs {
        for variant in ["hard", "soft", "fast"] {
            let mut scene = Scene::azam_2019(cells);
            scene.roughness.ball = Roughness::gaussian(20e-9, 10e-6, 2 * pair + 1);
            scene.roughness.disc = Roughness::gaussian(130e-9, 10e-6, 2 * pair + 2);
            if let Some(plastic) = &mut scene.plastic {
                plastic.film_hardness = None;
                plastic.hardness = if variant == "soft" { 2e9 } else { plastic.hardness };
            }
            if variant == "fast" {
                scene.motion.entrainment_speed = 1.0;
            }
            let case = Case::new(format!("{variant} {pair}"), scene);
            cases.push(case.with_history(Some(History::new(1, 1e-3))));
        }
    }
    cases
}

/// Scenes of the stability map.
fn map(options: &Options) -> Result<Vec<Case>, Box<dyn Error>> {
    let (seeds, every) = if options.quick { (1, 74) } else { (options.seeds, options.every) };
    let mut all = Vec::new();
    for seed in 1..=seeds {
        let mut cases = Cases::named("map", seed)?;
        cases.cases.retain(|case| !case.has_tag("infeasible"));
        for case in cases.every(every).cases {
            let history = case.history.unwrap_or(History::new(1, 1e-3));
            all.push(case.with_history(Some(history)));
        }
    }
    Ok(all)
}

/// One history of the reference scene.
fn history(quick: bool) -> Vec<Case> {
    let (contacts, cells) = if quick { (4, 32) } else { (60, 64) };
    let case = Case::new("history", Scene::azam_2019(cells));
    vec![case.with_history(Some(History::new(contacts, 10.0)))]
}
