//! The experiment of Azam et al. (2019) over several roughness seeds, with and without tribofilm; what becomes of the
//! paper's statements, and which of the choices that the paper leaves open turns them.
//!
//! ```text
//! cargo run --release --example reproduce                       # 8 seeds, 128 x 128, 72 steps of 100 s; 256 x 256 once
//! cargo run --release --example reproduce -- --choices          # the open choices too
//! cargo run --release --example reproduce -- --seeds 2 --steps 24 --grid 64 --report target/reproduce
//! cargo run --release --example reproduce -- --help
//! ```
//!
//! Each history is written as it ends; a second start of the same command takes up where the first was interrupted.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../chart/mod.rs"]
mod chart;
mod choices;
mod figures;
mod history;
mod options;
mod plan;
mod report;
mod sensitivity;
mod statements;

use std::error::Error;
use std::process::ExitCode;

use options::{Command, Options};
use sensitivity::Table;

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
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let runs = plan::runs(options);
    plan::execute(&runs, options)?;
    let results = report::Results::gather(&runs, options)?;
    let figures = options.report.join("figures");
    std::fs::create_dir_all(&figures).map_err(|error| format!("{}: {error}", figures.display()))?;
    figures::draw_all(&results, &figures)?;
    let table = match Table::of(&results, options) {
        Some(table) => {
            println!("{} is written", table.write(&options.report)?.display());
            Some(table)
        }
        None => Table::read(&options.report)?,
    };
    let page = options.report.join("reproduction.md");
    std::fs::write(&page, report::page(&results, table.as_ref(), options))
        .map_err(|error| format!("{}: {error}", page.display()))?;
    println!("{} and its figures are written", page.display());
    Ok(())
}
