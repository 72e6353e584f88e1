//! `stribeck man`: manual pages.

use std::error::Error;

use clap_mangen::Man;

use crate::output::{self, Outcome};

/// `stribeck man > ~/.local/share/man/man1/stribeck.1` installs the page of the command, `stribeck man solve >
/// ~/.local/share/man/man1/stribeck-solve.1` that of a subcommand.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Subcommand [default: the page of the command itself]
    subcommand: Option<String>,
}

pub(crate) fn run(options: &Options, command: &mut clap::Command) -> Result<Outcome, Box<dyn Error>> {
    command.build();
    let page = match &options.subcommand {
        None => command.clone(),
        Some(name) => command
            .find_subcommand(name)
            .cloned()
            .ok_or_else(|| format!("there is no subcommand {name}; `stribeck --help` lists them"))?,
    };
    let mut text = Vec::new();
    Man::new(page).render(&mut text)?;
    output::print(&String::from_utf8(text)?.trim_end())?;
    Ok(Outcome::Converged)
}
