//! Convergence of rough mixed contacts with the mesh: area ratio, load ratio, mean film and friction.
//!
//! ```text
//! cargo run --release -p studies --bin mesh_study                   # the reference scene on up to 256 x 256 cells
//! cargo run --release -p studies --bin mesh_study -- --finest 512   # one more
//! cargo run --release -p studies --bin mesh_study -- --quick        # coarse grids alone
//! cargo run --release -p studies --bin mesh_study -- --reference    # limits of small contacts
//! ```
//!
//! Contacts that the table in the output folder holds are not solved again.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/command/mod.rs"]
mod command;
mod figure;
mod large;
mod reference;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use lexopt::prelude::*;
use stribeck::benchmark::{Benchmark, Budget, Case, Contestant, Quantity, Results};

const USAGE: &str = "\
usage: cargo run --release -p studies --bin mesh_study -- [--quick] [--reference] [--finest CELLS] [--out DIR]

  --quick         coarse grids alone
  --reference     limits of the contact cut down to an eighth, by two discretizations
  --finest CELLS  cells along each side of the finest grid (default 256; 512 with --reference)
  --out DIR       folder of tables and figures (default target/mesh_study)
";
/// Columns of the tables.
const QUANTITIES: [Quantity; 4] =
    [Quantity::AreaRatio, Quantity::LoadRatio, Quantity::MeanFilm, Quantity::Friction];

struct Options {
    quick: bool,
    reference: bool,
    finest: Option<usize>,
    out: PathBuf,
}

fn main() -> ExitCode {
    command::run("mesh_study", USAGE, options(), run)
}

fn options() -> Result<Option<Options>, lexopt::Error> {
    let out = PathBuf::from("target/mesh_study");
    let mut options = Options { quick: false, reference: false, finest: None, out };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("quick") => options.quick = true,
            Long("reference") => options.reference = true,
            Long("finest") => options.finest = Some(parser.value()?.parse()?),
            Long("out") => options.out = PathBuf::from(parser.value()?),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    Ok(Some(options))
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(&options.out)?;
    let finest = |full| options.finest.unwrap_or(if options.quick { 32 } else { full });
    let text = if options.reference {
        reference::run(&options.out, finest(512))?
    } else {
        large::run(&options.out, finest(256))?
    };
    println!("{text}\ntables and figure are in {}", options.out.display());
    Ok(())
}

/// Solves `cases` on the meshes by the contestants, given by name and text; `path` holds the rows that are known.
fn solve(
    cases: Vec<Case>,
    contestants: &[(&str, &str)],
    meshes: impl IntoIterator<Item = usize>,
    path: PathBuf,
) -> Result<Results, Box<dyn Error>> {
    let progress = |row: &stribeck::benchmark::Row, done: usize, count: usize| {
        eprintln!(
            "{done} of {count}: {}, {}, {} cells, {}",
            row.case, row.contestant, row.cells, row.verdict
        );
    };
    let benchmark = Benchmark::new(cases).meshes(meshes).file(path).budget(Budget::unlimited());
    let contestants: Result<Vec<Contestant>, _> =
        contestants.iter().map(|(name, text)| Ok(Contestant::named(text)?.with_name(*name))).collect();
    let contestants: Vec<Contestant> = contestants.map_err(|error: stribeck::InputError| error)?;
    Ok(benchmark.contestants(contestants).observe(progress).run()?)
}
