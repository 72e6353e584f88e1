//! The command line.

use std::path::PathBuf;

use lexopt::prelude::*;

use crate::cases::CASES;

/// Output of `--help`.
pub(crate) const USAGE: &str = "\
The experiment of Azam et al. (2019) with and without tribofilm: which of the paper's statements hold, and which of them survive
other seeds, meshes, steps, boxes and contact films.

usage: cargo run --release -p studies --bin reproduce -- [options]

  --quick        half the cells, ten steps of 10 s, one seed
  --case NAME    this variant alone (see studies/reproduce/cases.rs)
  --seeds N      at most so many roughness seeds of each variant (default 8)
  --tables       runs nothing: tables and figures of the histories that are complete
  --threads N    histories at a time (default 2)
  --out DIR      where histories are kept (default target/reproduce)
  --report DIR   where tables and figures are written (default docs/reproduction)
  --help         this text

A run that was stopped goes on where it was; histories that have ended in --out are not run again.
";

/// The options of the command line.
pub(crate) enum Command {
    /// The usage.
    Help,
    /// Runs and tables.
    Run(Options),
}

/// Size and place of the runs.
#[derive(Debug, Clone)]
pub(crate) struct Options {
    pub(crate) quick: bool,
    /// The only variant.
    pub(crate) case: Option<String>,
    /// Most seeds of a variant.
    pub(crate) seeds: u64,
    /// Whether nothing is run.
    pub(crate) tables: bool,
    pub(crate) threads: usize,
    pub(crate) out: PathBuf,
    pub(crate) report: PathBuf,
}

/// Reads the command line.
pub(crate) fn parse() -> Result<Command, lexopt::Error> {
    let mut options = Options {
        quick: false,
        case: None,
        seeds: 8,
        tables: false,
        threads: 2,
        out: PathBuf::from("target/reproduce"),
        report: PathBuf::from("docs/reproduction"),
    };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("quick") => options.quick = true,
            Long("case") => options.case = Some(known(parser.value()?.string()?)?),
            Long("seeds") => options.seeds = parser.value()?.parse()?,
            Long("tables") => options.tables = true,
            Long("threads") => options.threads = parser.value()?.parse()?,
            Long("out") => options.out = PathBuf::from(parser.value()?),
            Long("report") => options.report = PathBuf::from(parser.value()?),
            Long("help") | Short('h') => return Ok(Command::Help),
            other => return Err(other.unexpected()),
        }
    }
    if options.seeds == 0 || options.threads == 0 {
        return Err("--seeds and --threads must be at least 1".into());
    }
    Ok(Command::Run(options))
}

fn known(name: String) -> Result<String, lexopt::Error> {
    if CASES.iter().any(|case| case.name == name) {
        return Ok(name);
    }
    let names: Vec<&str> = CASES.iter().map(|case| case.name).collect();
    Err(format!("--case {name} is none of {}", names.join(", ")).into())
}
