//! Two hours of a rough ball rubbing on a rough disc in a mini traction machine, with and without a ZDDP
//! tribofilm: the histories of Azam et al. (2019), their figures and their closing numbers. Runs can be
//! stopped and resumed.
//!
//! ```text
//! cargo run --release --example mtm_zddp               # 128 x 128 nodes, 720 steps of 10 s
//! cargo run --release --example mtm_zddp -- --quick    # 64 x 64 nodes, 24 steps of 10 s
//! cargo run --release --example mtm_zddp -- --seeds 3  # and how far seeds lie apart
//! cargo run --release --example mtm_zddp -- --resume   # goes on where it was stopped
//! cargo run --release --example mtm_zddp -- --help
//! ```

#![expect(clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../chart/mod.rs"]
mod chart;
mod figures;
mod history;
mod maps;
mod options;
mod setup;
#[path = "../statements/mod.rs"]
mod statements;
mod table;

use std::error::Error;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use stribeck::sim::{MixedLubricationSim, SimError};

use history::History;
use options::{Command, Options};

/// Exit status when a history ended before its last step.
const INCOMPLETE: u8 = 1;
/// Exit status of a wrong option, scene or file.
const REFUSED: u8 = 2;

fn main() -> ExitCode {
    let outcome = match options::parse() {
        Ok(Command::Help) => say(options::USAGE).map(|()| true),
        Ok(Command::Run(options)) => run(&options),
        Err(error) => Err(format!("{error} (--help lists the options)").into()),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(INCOMPLETE),
        Err(error) => {
            eprintln!("mtm_zddp: {error}");
            ExitCode::from(REFUSED)
        }
    }
}

/// Runs both histories of every seed and writes all there is of them; whether all took every step.
fn run(options: &Options) -> Result<bool, Box<dyn Error>> {
    let start = Instant::now();
    let mut pairs = Vec::new();
    for number in 0..options.seeds {
        let options = options.of_seed(number);
        std::fs::create_dir_all(&options.out)
            .map_err(|source| SimError::Io { path: options.out.clone(), source })?;
        let [with, without] = rub(setup::pair(&options)?, &options)?;
        if number == 0 {
            figures::draw_all(&with, &without, &options.out)?;
            maps::draw(&with, &options.out.join("maps.svg"))?;
        }
        pairs.push([with, without]);
    }
    say(&format!(
        "{}\n{} in all; tables, fields and figures are in {}\n",
        table::closing(&pairs)?,
        clock(start.elapsed()),
        options.out.display()
    ))?;
    let mut complete = true;
    for history in pairs.iter().flatten() {
        if let Some(error) = &history.failure {
            complete = false;
            let (time, end) = (history.sim.time(), options.end());
            eprintln!("mtm_zddp: {} ended at {time} s of {end} s: {error}", history.title);
        }
    }
    Ok(complete)
}

/// The two histories side by side, one thread each.
fn rub(sims: [MixedLubricationSim; 2], options: &Options) -> Result<[History; 2], Box<dyn Error>> {
    let [with, without] = sims;
    let bars = MultiProgress::new();
    let [with_bar, without_bar] =
        [bars.add(ProgressBar::new(options.steps)), bars.add(ProgressBar::new(options.steps))];
    let style = ProgressStyle::with_template("{prefix:<17} {wide_bar} {pos}/{len} steps, {eta} left")?;
    with_bar.set_style(style.clone());
    without_bar.set_style(style);
    let (with, without) = std::thread::scope(|scope| {
        let with = scope.spawn(|| history::run(with, "with", options, &with_bar));
        let without = scope.spawn(|| history::run(without, "without", options, &without_bar));
        (with.join(), without.join())
    });
    let or_unwind = |joined: std::thread::Result<Result<History, SimError>>| {
        joined.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    };
    Ok([or_unwind(with)?, or_unwind(without)?])
}

/// To standard output; unlike `print!` it survives a reader that has left.
fn say(text: &str) -> Result<(), Box<dyn Error>> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}

/// `1 h 02 min 03 s`, without leading zeros.
fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    match (seconds / 3600, seconds / 60 % 60, seconds % 60) {
        (0, 0, _) => format!("{:.1} s", time.as_secs_f64()),
        (0, minutes, seconds) => format!("{minutes} min {seconds:02} s"),
        (hours, minutes, seconds) => format!("{hours} h {minutes:02} min {seconds:02} s"),
    }
}
