//! Where each solver converges, stalls, diverges or converges falsely: 468 scenes from full film to dry contact.
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

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/command/mod.rs"]
mod command;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use lexopt::prelude::*;
use stribeck::benchmark::{Benchmark, Budget, Cases, Contestant, Results};

const USAGE: &str = "\
usage: cargo run --release -p studies --bin stability_map -- [--quick] [--every N] [--solver NAME] [--seed N] [--film-heat | --lines] [--out DIR]

  --quick        a few coarse scenes
  --every N      every Nth scene with semi_system and paper_contact, which are slow (default 1)
  --solver NAME  auto, newton_krylov, semi_system, paper_contact or another contestant alone (default: these four)
  --seed N       of the roughness of the ball, the disc's is N + 100 (default 1)
  --film-heat    the scenes on 64 x 64 cells at once, at slide-roll ratios of 0.05 to 2, with all of it: temperature of
                 the film, shear thinning in its flow, a limiting stress, a coated disc, spin
  --lines        64 rough line contacts on 512 cells in place of the scenes of the map
  --out DIR      where to write stability.csv and stability.svg (default target/stability_map)
";
/// The published model, which only sweeps can solve: where it converges it mostly does so within 2000.
const PAPER: &str = "auto:contact=paper,max_iterations=3000";
const THREADS: usize = 2;

struct Options {
    quick: bool,
    every: usize,
    solver: Option<String>,
    seed: u64,
    list: &'static str,
    out: PathBuf,
}

fn main() -> ExitCode {
    command::run("stability_map", USAGE, options(), run)
}

fn options() -> Result<Option<Options>, lexopt::Error> {
    let out = PathBuf::from("target/stability_map");
    let mut options = Options { quick: false, every: 1, solver: None, seed: 1, list: "map", out };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("quick") => options.quick = true,
            Long("every") => options.every = parser.value()?.parse()?,
            Long("solver") => options.solver = Some(parser.value()?.string()?),
            Long("seed") => options.seed = parser.value()?.parse()?,
            Long("film-heat" | "lines") if options.list != "map" => {
                return Err("--film-heat is for the scenes on 64 x 64 cells, which --lines leaves out".into());
            }
            Long("film-heat") => options.list = "thermal",
            Long("lines") => options.list = "lines",
            Long("out") => options.out = PathBuf::from(parser.value()?),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    Ok(Some(options))
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let all = Cases::named(options.list, options.seed)?.every(if options.quick { 37 } else { 1 });
    let four = ["auto", "newton_krylov", "semi_system", "paper_contact"];
    let mut results = Results::default();
    for name in options.solver.as_deref().map_or(four.to_vec(), |name| vec![name]) {
        let text = if name == "paper_contact" { PAPER } else { name };
        let is_slow = ["semi_system", "paper_contact"].contains(&name);
        let cases = all.clone().every(if is_slow { options.every } else { 1 });
        let benchmark = Benchmark::new(cases).contestant(Contestant::named(text)?.with_name(name));
        let benchmark = if options.quick { benchmark.meshes([32]) } else { benchmark };
        let progress = |_: &_, done: usize, count: usize| {
            if done.is_multiple_of(50) {
                eprintln!("{name}: {done} of {count} solved");
            }
        };
        let benchmark = benchmark.budget(Budget::unlimited()).threads(THREADS).observe(progress);
        results = results.merged(benchmark.run()?);
    }
    std::fs::create_dir_all(&options.out)?;
    std::fs::write(options.out.join("stability.csv"), results.to_csv())?;
    std::fs::write(options.out.join("stability.svg"), results.stability_map())?;
    print!("{}", results.summary());
    println!("table and map are in {}", options.out.display());
    Ok(())
}
