//! The command `stribeck`.
#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(stribeck_cli::run(std::env::args_os()))
}
