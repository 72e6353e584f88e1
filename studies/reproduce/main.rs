//! The experiment of Azam et al. (2019) over several roughness seeds, with and without tribofilm, asked
//! throughout the run what the paper says of it; and the same on other meshes, steps, boxes and contact
//! films, and as published.
//!
//! ```text
//! cargo run --release -p studies --bin reproduce                                   # all variants: hours
//! cargo run --release -p studies --bin reproduce -- --case default --seeds 2       # one variant
//! cargo run --release -p studies --bin reproduce -- --tables                       # tables of complete variants
//! cargo run --release -p studies --bin reproduce -- --quick --out target/quick --report target/quick
//! cargo run --release -p studies --bin reproduce -- --help
//! ```

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

mod case_run;
mod cases;
#[path = "../../examples/chart/mod.rs"]
mod chart;
mod figures;
mod history;
mod options;
mod plan;
#[path = "../../examples/statements/mod.rs"]
mod statements;
mod tables;

use std::error::Error;
use std::process::ExitCode;

use options::{Command, Options};

/// Exit status of a wrong option or of a file that cannot be read or written.
const REFUSED: u8 = 2;

fn main() -> ExitCode {
    let outcome = match options::parse() {
        Ok(Command::Help) => {
            print!("{}", options::USAGE);
            Ok(())
        }
        Ok(Command::Run(options)) => run(&options),
        Err(error) => Err(format!("{error} (--help lists the options)").into()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("reproduce: {error}");
            ExitCode::from(REFUSED)
        }
    }
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let runs = plan::runs(options);
    if !options.tables {
        plan::execute(&runs, options)?;
    }
    let all = tables::gather(&runs, options)?;
    let folder = &options.report;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    tables::write(&all, options)?;
    if let Some(first) = all.first() {
        figures::draw_all(first, folder)?;
    }
    println!("{}", tables::summary(&all));
    Ok(())
}
