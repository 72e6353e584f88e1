//! What of a rough mixed contact converges with the mesh: area ratio, load ratio, mean film and friction of
//! the rough reference scene on the same band-limited surface from 64 to 512 cells along each side, over the
//! film at which solids touch and over the speed, for both definitions of contact and both pressure flows.
//!
//! ```text
//! cargo run --release -p studies --bin mesh_study                   # up to 512 x 512 cells
//! cargo run --release -p studies --bin mesh_study -- --finest 1024  # one more
//! cargo run --release -p studies --bin mesh_study -- --quick        # coarse grids alone
//! cargo run --release -p studies --bin mesh_study -- --reference    # the limits of small contacts
//! ```
//!
//! The surfaces are generated on the coarsest grid and brought to the others by their Fourier series.
//! Contacts that are in the table already are not solved again: a run that was stopped goes on, and a finer
//! grid adds to what is there.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/command/mod.rs"]
mod command;
mod contact;
mod figure;
mod plan;
mod reference;
mod summary;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use contact::Row;
use lexopt::prelude::*;

const USAGE: &str = "\
usage: cargo run --release -p studies --bin mesh_study -- [--quick | --reference] [--finest CELLS] [--out DIR]

  --quick         grids of 32 and 64 cells alone
  --reference     limits of the contact cut down to an eighth, by two discretisations
  --finest CELLS  cells along each side of the finest grid, 64 to 1024 (default 512)
  --out DIR       where tables and figures are (default target/mesh_study)
";

struct Options {
    quick: bool,
    reference: bool,
    finest: usize,
    out: PathBuf,
}

fn main() -> ExitCode {
    command::run("mesh_study", USAGE, options(), run)
}

fn options() -> Result<Option<Options>, lexopt::Error> {
    let mut options =
        Options { quick: false, reference: false, finest: 512, out: PathBuf::from("target/mesh_study") };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("quick") => options.quick = true,
            Long("reference") => options.reference = true,
            Long("finest") => options.finest = parser.value()?.parse()?,
            Long("out") => options.out = PathBuf::from(parser.value()?),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    Ok(Some(options))
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let folder = &options.out;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    if options.reference {
        return reference::run(folder, options.finest);
    }
    let table = folder.join("mixed.csv");
    let known = if table.exists() { read(&table)? } else { Vec::new() };
    if options.finest < plan::CELLS[0] {
        return Err(
            format!("--finest {}: the coarsest grid has {} cells", options.finest, plan::CELLS[0]).into()
        );
    }
    let plan = if options.quick { plan::quick() } else { plan::all(options.finest) };
    let mut rows: Vec<Row> = Vec::with_capacity(plan.len());
    for (k, job) in plan.iter().enumerate() {
        let row = match known.iter().find(|row| row.job.key() == job.key()) {
            Some(row) => row.clone(),
            None => contact::solve(job, folder)?,
        };
        eprintln!("{} of {}: {} {}", k + 1, plan.len(), job.key(), row.status);
        rows.push(row);
        // What is known of contacts further down must outlive a stop.
        let later = known.iter().filter(|row| plan[k + 1..].iter().any(|job| job.key() == row.job.key()));
        write(&table, rows.iter().chain(later))?;
    }
    figure::draw(&rows, &folder.join("mixed.svg"))?;
    print!("{}", summary::text(&rows)?);
    println!("table and figure are in {}", folder.display());
    Ok(())
}

fn read(path: &Path) -> Result<Vec<Row>, Box<dyn Error>> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut lines = text.lines();
    if lines.next() != Some(contact::COLUMNS) {
        return Err(format!("{}: not a table of this example", path.display()).into());
    }
    lines
        .map(|line| {
            Row::parse(line).ok_or_else(|| format!("{}: cannot read `{line}`", path.display()).into())
        })
        .collect()
}

fn write<'a>(path: &Path, rows: impl Iterator<Item = &'a Row>) -> Result<(), Box<dyn Error>> {
    let lines: Vec<String> =
        std::iter::once(contact::COLUMNS.to_owned()).chain(rows.map(Row::line)).collect();
    std::fs::write(path, lines.join("\n") + "\n")
        .map_err(|error| format!("{}: {error}", path.display()).into())
}
