//! The command `stribeck`: rough lubricated contacts from scene files (`docs/scene.md`), with reports, JSON
//! and pictures.
//!
//! Ends with 0 when the contact converged, 1 when it did not, 2 when the input was refused, with one line on
//! standard error. A library beside the program, for the Python package.
#![forbid(unsafe_code)]

mod commands;
mod files;
mod interrupt;
mod output;
mod picture;
mod report;
mod sample;
mod surface_numbers;

use std::ffi::OsString;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};

use crate::commands::{
    benchmark, check, completion, curve, cycle, explain, init, man, run, solve, surface, sweep,
};
use crate::output::Outcome;

/// Rough lubricated contacts that change as they rub.
///
/// A scene file describes a contact in TOML; `stribeck init` writes one. Exit status: 0 converged, 1 not
/// converged, 2 refused.
#[derive(Parser)]
#[command(name = "stribeck", version, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Solve one contact
    Solve(solve::Options),
    /// Run the history of a contact: friction, film, wear and tribofilm through time
    Run(run::Options),
    /// Compute a Stribeck curve: friction, load on solids and film over a range of speeds
    Curve(curve::Options),
    /// Solve a contact over a cycle of load, speeds and radius: gear, cam, reciprocating rig
    Cycle(cycle::Options),
    /// Solve a scene under all combinations of some of its values
    Sweep(sweep::Options),
    /// Compare solvers over lists of cases
    Benchmark(benchmark::Options),
    /// Report the parameters of a measured surface (ISO 25178-2)
    Surface(surface::Options),
    /// List the parts of the model and estimates of a scene, without solving
    Check(check::Options),
    /// Write a scene file from options, or from the answers to a few questions
    Init(Box<init::Options>),
    /// Explain a key of scenes or a warning
    Explain(explain::Options),
    /// Print the completion of this command for a shell
    Completion(completion::Options),
    /// Print the manual page of this command or of a subcommand
    Man(man::Options),
}

/// The text of `stribeck` alone.
const SHORT_HELP: &str = "\
stribeck: rough lubricated contacts from scene files

  stribeck init scene.toml                           write a scene by answering a few questions
  stribeck check scene.toml                          Hertz contact, oil, film and regime by formula
  stribeck solve scene.toml --plot                   film, pressure and friction of one contact
  stribeck curve scene.toml --plot                   Stribeck curve: friction over speed
  stribeck curve scene.toml --over slide_roll_ratio  traction curve; also over load and temperature
  stribeck run scene.toml --duration 1h              wear, running-in and tribofilm over time
  stribeck explain lubricant.grade                   meaning, unit, default and range of a key

Others: cycle, sweep, benchmark, surface, completion, man. `stribeck COMMAND --help` lists the options of a command.";

/// Runs the command with its `arguments`, of which the first is its own name; its exit status.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    outcome(arguments).code()
}

fn outcome(arguments: impl IntoIterator<Item = OsString>) -> Outcome {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            return match output::print(&SHORT_HELP) {
                Ok(()) => Outcome::Converged,
                Err(error) => {
                    output::complain("error", &error.to_string());
                    Outcome::Refused
                }
            };
        }
        Err(error) if error.use_stderr() => {
            output::complain("error", &short(&error.to_string()));
            return Outcome::Refused;
        }
        // Help and version.
        Err(text) => {
            return match output::print(&text.to_string().trim_end()) {
                Ok(()) => Outcome::Converged,
                Err(_) => Outcome::Refused,
            };
        }
    };
    let outcome = match cli.command {
        Command::Solve(options) => solve::run(&options),
        Command::Run(options) => run::run(&options),
        Command::Curve(options) => curve::run(&options),
        Command::Cycle(options) => cycle::run(&options),
        Command::Sweep(options) => sweep::run(&options),
        Command::Benchmark(options) => benchmark::run(&options),
        Command::Surface(options) => surface::run(&options),
        Command::Check(options) => check::run(&options),
        Command::Init(options) => init::run(&options),
        Command::Explain(options) => explain::run(&options),
        Command::Completion(options) => completion::run(&options, &mut Cli::command()),
        Command::Man(options) => man::run(&options, &mut Cli::command()),
    };
    match outcome {
        Ok(outcome) => outcome,
        Err(error) => {
            output::complain("error", &error.to_string());
            Outcome::Refused
        }
    }
}

/// The `reason` of an option with the option and its value in `head`, "invalid value 'VALUE' for '--option <NAME", unless it names them.
fn refused_value(head: &str, reason: &str) -> String {
    let named = head.trim_start_matches("invalid value '").split_once("' for '");
    let Some((value, option)) = named.filter(|_| !reason.contains("--")) else { return reason.to_owned() };
    let option = option.split(' ').next().unwrap_or(option);
    let reason = match reason {
        "invalid float literal" => "a number is expected, in the unit that `--help` names",
        "invalid digit found in string" => "a whole number is expected",
        reason => reason,
    };
    format!("{option} = {value}: {reason}")
}

/// The fault of the command line, without usage; of a value that an option refuses, the reason with option and value.
fn short(error: &str) -> String {
    let parts = error.split("\n\n").map(str::trim);
    let kept = parts.filter(|part| !part.starts_with("Usage:") && !part.starts_with("For more information"));
    let text = kept.collect::<Vec<_>>().join("; ");
    let text = text.strip_prefix("error: ").unwrap_or(&text);
    match text.split_once(">': ") {
        Some((head, rest)) if head.starts_with("invalid value") => refused_value(head, rest),
        _ => text.to_owned(),
    }
}
