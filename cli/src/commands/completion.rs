//! `stribeck completion`: completion scripts of shells.

use std::error::Error;

use clap_complete::Shell;

use crate::output::{self, Outcome};

/// `stribeck completion bash > ~/.local/share/bash-completion/completions/stribeck` installs the completion for bash.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// The shell
    shell: Shell,
}

pub(crate) fn run(options: &Options, command: &mut clap::Command) -> Result<Outcome, Box<dyn Error>> {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, command, "stribeck", &mut script);
    output::print(&String::from_utf8(script)?)?;
    Ok(Outcome::Converged)
}
