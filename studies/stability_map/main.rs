//! Where each solver converges, stalls, diverges or lies: more than 450 scenes from full film to dry contact.
//!
//! ```text
//! cargo run --release -p studies --bin stability_map                     # all scenes, all solvers
//! cargo run --release -p studies --bin stability_map -- --quick          # a few coarse ones
//! cargo run --release -p studies --bin stability_map -- --solver auto    # one solver
//! cargo run --release -p studies --bin stability_map -- --seed 2         # other roughness
//! cargo run --release -p studies --bin stability_map -- --every 11       # slow solvers: every eleventh scene
//! cargo run --release -p studies --bin stability_map -- --solver auto --film-heat # film heat, thinning, limit, coating, spin
//! cargo run --release -p studies --bin stability_map -- --solver auto --lines # rough line contacts
//! ```
//!
//! A solve that calls itself converged is checked from its fields alone: no pressure or gap may be negative,
//! no film under solid contact off the contact film, and the pressures must carry the load. One that fails
//! the check is listed as a lie.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/command/mod.rs"]
mod command;
mod map;
mod outcome;
mod scenes;

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use lexopt::prelude::*;
use outcome::{Entry, SOLVERS, Solver, Verdict, solve};
use scenes::{Case, Group};

const USAGE: &str = "\
usage: cargo run --release -p studies --bin stability_map -- [--quick] [--every N] [--solver NAME] [--seed N] [--film-heat | --lines] [--out DIR]

  --quick        a few coarse scenes
  --every N      every Nth scene with semi_system and paper_contact, which are slow (default 1)
  --solver NAME  auto, newton_krylov, semi_system or paper_contact alone (default: all four)
  --seed N       of the roughness of the ball, the disc's is N + 100 (default 1)
  --film-heat    the scenes on 64 x 64 cells at once, at slide-roll ratios of 0.05 to 2, with all of it: temperature of
                 the film, shear thinning in its flow, a limiting stress, a coated disc, spin
  --lines        64 rough line contacts on 512 cells in place of the scenes of the map
  --out DIR      where to write stability.csv and stability.svg (default target/stability_map)
";
const THREADS: usize = 2;

struct Options {
    quick: bool,
    every: usize,
    solver: Option<Solver>,
    seed: u64,
    film_heat: bool,
    lines: bool,
    out: PathBuf,
}

fn main() -> ExitCode {
    command::run("stability_map", USAGE, options(), run)
}

fn options() -> Result<Option<Options>, lexopt::Error> {
    let mut options = Options {
        quick: false,
        every: 1,
        solver: None,
        seed: 1,
        film_heat: false,
        lines: false,
        out: PathBuf::from("target/stability_map"),
    };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("quick") => options.quick = true,
            Long("every") => {
                options.every = parser.value()?.parse_with(|n| n.parse().map(|n: usize| n.max(1)))?;
            }
            Long("solver") => {
                let name = parser.value()?.string()?;
                let known = SOLVERS.into_iter().find(|solver| solver.to_string() == name);
                options.solver = Some(known.ok_or_else(|| format!("no solver is called {name:?}"))?);
            }
            Long("seed") => options.seed = parser.value()?.parse()?,
            Long("film-heat") => options.film_heat = true,
            Long("lines") => options.lines = true,
            Long("out") => options.out = PathBuf::from(parser.value()?),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    if options.film_heat && options.lines {
        return Err("--film-heat is for the scenes on 64 x 64 cells, which --lines leaves out".into());
    }
    Ok(Some(options))
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let mut cases = scenes::cases(options.lines, options.quick, options.seed);
    if options.film_heat {
        cases = with_film_heat(cases);
    }
    let every = |solver: Solver| if solver.is_slow() { options.every } else { 1 };
    let jobs: Vec<(&Case, Solver)> = SOLVERS
        .into_iter()
        .filter(|solver| options.solver.is_none_or(|only| only == *solver))
        .flat_map(|solver| cases.iter().step_by(every(solver)).map(move |case| (case, solver)))
        .collect();
    let entries = solve_all(&jobs);
    let folder = &options.out;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let table = folder.join("stability.csv");
    std::fs::write(&table, outcome::table(&entries))
        .map_err(|error| format!("{}: {error}", table.display()))?;
    map::draw(&entries, &folder.join("stability.svg"))?;
    print!("{}", summary(&entries)?);
    println!("table and map are in {}", folder.display());
    Ok(())
}

/// Those on 64 x 64 cells and less that are solved at once, with all of it, slide-roll ratios in turn.
fn with_film_heat(cases: Vec<Case>) -> Vec<Case> {
    let fit = cases.into_iter().filter(|case| case.cells == 0 && case.nodes <= 64);
    fit.zip([0.05, 0.5, 1.0, 2.0].into_iter().cycle())
        .map(|(case, ratio)| Case { sliding: Some(ratio), ..case })
        .collect()
}

/// Solves all jobs on two threads; the entries come in the order of the jobs.
fn solve_all(jobs: &[(&Case, Solver)]) -> Vec<Entry> {
    let next = AtomicUsize::new(0);
    let found = Mutex::new(Vec::with_capacity(jobs.len()));
    std::thread::scope(|scope| {
        for _ in 0..THREADS {
            scope.spawn(|| {
                loop {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    let Some((case, solver)) = jobs.get(k) else { break };
                    let entry = solve(case, *solver);
                    if let Ok(mut found) = found.lock() {
                        found.push((k, entry));
                        if found.len() % 50 == 0 {
                            eprintln!("{} of {} solved", found.len(), jobs.len());
                        }
                    }
                }
            });
        }
    });
    let mut found = found.into_inner().unwrap_or_default();
    found.sort_by_key(|(k, _)| *k);
    found.into_iter().map(|(_, entry)| entry).collect()
}

/// Counts per solver and group, and what each solver's solves cost.
fn summary(entries: &[Entry]) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    write!(text, "{:<14} {:<12} {:>6}", "solver", "scenes", "all")?;
    for verdict in Verdict::ALL {
        write!(text, " {:>12}", verdict.to_string())?;
    }
    writeln!(text)?;
    let groups = [
        Group::Battery,
        Group::Finer,
        Group::Anisotropic,
        Group::Exponential,
        Group::Transient,
        Group::Measured,
        Group::Infeasible,
        Group::Line,
    ];
    for solver in SOLVERS {
        for group in groups {
            let of: Vec<&Entry> =
                entries.iter().filter(|entry| entry.solver == solver && entry.case.group == group).collect();
            if of.is_empty() {
                continue;
            }
            write!(text, "{:<14} {:<12} {:>6}", solver.to_string(), group.to_string(), of.len())?;
            for verdict in Verdict::ALL {
                write!(text, " {:>12}", of.iter().filter(|entry| entry.verdict == verdict).count())?;
            }
            writeln!(text)?;
        }
    }
    for solver in SOLVERS {
        costs(&mut text, solver, entries)?;
    }
    Ok(text)
}

/// Convolutions of a solver's solves, of transient scenes those of the last step, and how many of the
/// converged ones were reached by which strategy.
fn costs(text: &mut String, solver: Solver, entries: &[Entry]) -> std::fmt::Result {
    let solves = entries.iter().filter(|entry| entry.solver == solver);
    let (mut total, mut most, mut converged_total, mut strategies) = (0.0, 0.0_f64, 0.0, BTreeMap::new());
    for (entry, report) in solves.filter_map(|entry| Some((entry, entry.report.as_ref()?))) {
        let convolutions = report.work.convolutions;
        total += convolutions;
        if entry.verdict == Verdict::Converged {
            (converged_total, most) = (converged_total + convolutions, most.max(convolutions));
            let strategy = report.strategy.map_or("no strategy".to_owned(), |strategy| strategy.to_string());
            *strategies.entry(strategy).or_insert(0) += 1;
        }
    }
    let converged: u32 = strategies.values().sum();
    if converged > 0 {
        write!(text, "{solver}: {total:.0} convolutions; of the converged {converged_total:.0}, ")?;
        write!(text, "mean {:.0}, most {most:.0}", converged_total / f64::from(converged))?;
        for (strategy, count) in strategies {
            write!(text, "; {strategy} {count}")?;
        }
        writeln!(text)?;
    }
    Ok(())
}
