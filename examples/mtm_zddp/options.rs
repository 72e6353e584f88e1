//! The command line.

use std::path::PathBuf;

use lexopt::prelude::*;

/// Output of `--help`.
pub(crate) const USAGE: &str = "\
Two hours of a rough ball on a rough disc, with and without a ZDDP tribofilm (Azam et al. 2019).

usage: cargo run --release --example mtm_zddp -- [options]

  --quick         64 x 64 nodes, 24 steps of 10 s instead of 128 x 128 nodes, 720 steps of 10 s
  --surface FILE  measured surface of the disc: x3p, sur, sdf, plu, al3d, text, or npy with the heights of the grid in metres
  --seed N        seed of both roughnesses and of their motion (default 1)
  --seeds N       so many seeds from that one on (default 1): the table says how far they lie apart; figures are of the first
  --steps N       number of steps
  --time-step T   time that a step stands for in seconds (default 10)
  --grid N        nodes along each side of the grid
  --out DIR       where to write (default target/mtm_zddp)
  --checkpoint N  steps from one checkpoint to the next (default 10)
  --resume        goes on from the checkpoints in DIR, of a run with the same scene that was stopped, to the end of --steps times
                  --time-step, which may be another step
  --help          this text

Writes with.csv and without.csv (a row per step), with.npz and without.npz (final fields), figure1.svg to figure8.svg, maps.svg
(the last contact from above) and the folders with and without, from which a run is repeated or resumed: scene.toml, run.toml,
history.csv, fields.npz, checkpoint and contact.vtk (pressure and film for ParaView). Further seeds are written into the folders
seed2 and so on.
Exit status: 0 done, 1 a history ended early (its steps are written), 2 wrong option or file.
";

/// The options of the command line.
pub(crate) enum Command {
    /// The usage.
    Help,
    /// The two histories.
    Run(Options),
}

/// Size, time and place of the run.
#[derive(Debug, Clone)]
pub(crate) struct Options {
    /// Nodes along each side of the grid.
    pub(crate) grid: usize,
    /// Steps of each history.
    pub(crate) steps: u64,
    /// Time that one step stands for \[s\].
    pub(crate) time_step: f64,
    /// Seed of roughness and motion.
    pub(crate) seed: u64,
    /// Number of seeds, from that one on.
    pub(crate) seeds: u64,
    /// File of the disc's measured surface.
    pub(crate) surface: Option<PathBuf>,
    /// Folder of the output.
    pub(crate) out: PathBuf,
    /// Steps from one checkpoint to the next.
    pub(crate) every: u64,
    /// Whether the run goes on from its checkpoints.
    pub(crate) resume: bool,
}

impl Options {
    /// Time at which the histories end \[s\].
    pub(crate) fn end(&self) -> f64 {
        self.steps as f64 * self.time_step
    }

    /// The options of one seed: the first is written beside the figures, others into folders of their own.
    pub(crate) fn of_seed(&self, number: u64) -> Self {
        let seed = self.seed.wrapping_add(number);
        let out = if number == 0 { self.out.clone() } else { self.out.join(format!("seed{seed}")) };
        Self { seed, out, ..self.clone() }
    }
}

/// Reads the command line; the options may stand in any order.
pub(crate) fn parse() -> Result<Command, lexopt::Error> {
    let mut parser = lexopt::Parser::from_env();
    let (mut quick, mut grid, mut steps, mut time_step) = (false, None, None, 10.0);
    let (mut seed, mut seeds) = (1, 1);
    let (mut surface, mut out) = (None, PathBuf::from("target/mtm_zddp"));
    let (mut every, mut resume) = (10, false);
    while let Some(argument) = parser.next()? {
        match argument {
            Long("quick") => quick = true,
            Long("surface") => surface = Some(PathBuf::from(parser.value()?)),
            Long("seed") => seed = parser.value()?.parse()?,
            Long("seeds") => seeds = at_least_one("--seeds", parser.value()?.parse()?)?,
            Long("steps") => steps = Some(at_least_one("--steps", parser.value()?.parse()?)?),
            Long("time-step") => time_step = parser.value()?.parse()?,
            Long("grid") => grid = Some(at_least_one("--grid", parser.value()?.parse()?)?),
            Long("out") => out = PathBuf::from(parser.value()?),
            Long("checkpoint") => every = at_least_one("--checkpoint", parser.value()?.parse()?)?,
            Long("resume") => resume = true,
            Long("help") | Short('h') => return Ok(Command::Help),
            other => return Err(other.unexpected()),
        }
    }
    let (default_grid, default_steps) = if quick { (64, 24) } else { (128, 720) };
    let grid = match grid {
        Some(grid) => usize::try_from(grid).map_err(|_| format!("--grid {grid} is too large"))?,
        None => default_grid,
    };
    let steps = steps.unwrap_or(default_steps);
    Ok(Command::Run(Options { grid, steps, time_step, seed, seeds, surface, out, every, resume }))
}

fn at_least_one(option: &str, count: u64) -> Result<u64, lexopt::Error> {
    if count == 0 { Err(format!("{option} must be at least 1").into()) } else { Ok(count) }
}
