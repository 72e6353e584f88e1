//! The command line.

use std::path::PathBuf;

use lexopt::prelude::*;

/// What `--help` prints.
pub(crate) const USAGE: &str = "\
The experiment of Azam et al. (2019) over several seeds, with and without tribofilm, and its open choices.

usage: cargo run --release --example reproduce -- [options]

  --seeds N      roughness seeds (default 8)
  --steps N      steps of each history (default 72)
  --time-step S  seconds that a step stands for (default 100)
  --grid N       nodes along each side (default 128); one more pair is run on twice as many, and one beside it on these,
                 with a quarter of the steps of four times the time
  --no-fine      leave those pairs out
  --choices      flip the open choices, one at a time, on the first seed, with half the steps of twice the time; their table
                 is kept beside the page
  --threads N    histories at a time (default 2)
  --out DIR      where histories are kept (default target/reproduce)
  --report DIR   where reproduction.md and figures/ are written (default docs)
  --help         this text

Histories that are in --out already, by the same steps, are not run again.
";

/// What the command line asks for.
pub(crate) enum Command {
    /// The usage.
    Help,
    /// Runs and report.
    Run(Options),
}

/// Size and place of the runs.
#[derive(Debug, Clone)]
pub(crate) struct Options {
    pub(crate) seeds: u64,
    pub(crate) steps: u64,
    /// Time that one step stands for \[s\].
    pub(crate) time_step: f64,
    /// Nodes along each side.
    pub(crate) grid: usize,
    /// Whether one pair is run on a grid twice as fine, and one beside it.
    pub(crate) fine: bool,
    /// Whether the open choices are flipped.
    pub(crate) choices: bool,
    pub(crate) threads: usize,
    pub(crate) out: PathBuf,
    pub(crate) report: PathBuf,
}

impl Options {
    /// The command that asks for this.
    pub(crate) fn command(&self) -> String {
        let Self { seeds, steps, time_step, grid, .. } = self;
        let fine = if self.fine { "" } else { " --no-fine" };
        let choices = if self.choices { " --choices" } else { "" };
        format!(
            "cargo run --release --example reproduce -- --seeds {seeds} --grid {grid} --steps {steps} --time-step \
             {time_step}{fine}{choices}"
        )
    }
}

/// Reads the command line.
pub(crate) fn parse() -> Result<Command, lexopt::Error> {
    let mut options = Options {
        seeds: 8,
        steps: 72,
        time_step: 100.0,
        grid: 128,
        fine: true,
        choices: false,
        threads: 2,
        out: PathBuf::from("target/reproduce"),
        report: PathBuf::from("docs"),
    };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("seeds") => options.seeds = parser.value()?.parse()?,
            Long("steps") => options.steps = parser.value()?.parse()?,
            Long("time-step") => options.time_step = parser.value()?.parse()?,
            Long("grid") => options.grid = parser.value()?.parse()?,
            Long("no-fine") => options.fine = false,
            Long("choices") => options.choices = true,
            Long("threads") => options.threads = parser.value()?.parse()?,
            Long("out") => options.out = PathBuf::from(parser.value()?),
            Long("report") => options.report = PathBuf::from(parser.value()?),
            Long("help") | Short('h') => return Ok(Command::Help),
            other => return Err(other.unexpected()),
        }
    }
    if options.seeds == 0 || options.steps < 4 || options.threads == 0 {
        return Err("--seeds and --threads must be at least 1, --steps at least 4".into());
    }
    Ok(Command::Run(options))
}
