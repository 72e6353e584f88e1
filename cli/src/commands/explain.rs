//! `stribeck explain`: a key of scenes or a warning in the words of the book.

use std::error::Error;

use stribeck::sim::scene::explain;

use crate::output::{self, Outcome};

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Key, as lubricant.alpha or alpha, table, as lubricant, result, as film.lambda, or the text of a warning [default: all tables with their keys]
    #[arg(value_name = "KEY|RESULT|WARNING")]
    text: Vec<String>,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    output::print(&explain(&options.text.join(" "))?)?;
    Ok(Outcome::Converged)
}
