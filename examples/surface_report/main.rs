//! Prints the parameters of a surface file (ISO 25178-2) and draws a page (`docs/surfaces.md`).
//!
//! ```text
//! cargo run --release --example surface_report -- FILE [--json] [--out PAGE.svg]
//! ```
//!
//! Nothing is levelled, filtered or filled first. Ends with 1 for bad input, with one line on standard error.

mod numbers;
mod page;

use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use stribeck::surface;

use crate::numbers::Numbers;

const USAGE: &str = "usage: surface_report FILE [--json] [--out PAGE.svg]";

struct Arguments {
    file: PathBuf,
    json: bool,
    out: PathBuf,
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let line = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
            // Nobody is left to be told when standard error is closed.
            let _ = writeln!(io::stderr(), "error: {line}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let Some(arguments) = parse_arguments()? else {
        writeln!(io::stdout(), "{USAGE}")?;
        return Ok(());
    };
    let measured = surface::read(&arguments.file)?;
    let numbers = Numbers::of(&measured)?;
    if let Some(folder) = arguments.out.parent() {
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    page::draw(&arguments.out, &title(&arguments.file), &measured, &numbers)
        .map_err(|error| format!("{}: {error}", arguments.out.display()))?;
    if arguments.json {
        writeln!(io::stdout(), "{}", numbers.to_json())?;
    } else {
        writeln!(io::stdout(), "{}page       {}", numbers.to_text(), arguments.out.display())?;
    }
    Ok(())
}

fn parse_arguments() -> Result<Option<Arguments>, Box<dyn Error>> {
    use lexopt::prelude::*;
    let mut parser = lexopt::Parser::from_env();
    let (mut file, mut json, mut out) = (None, false, None);
    while let Some(argument) = parser.next()? {
        match argument {
            Long("json") => json = true,
            Long("out") => out = Some(PathBuf::from(parser.value()?)),
            Long("help") | Short('h') => return Ok(None),
            Value(path) if file.is_none() => file = Some(PathBuf::from(path)),
            other => return Err(format!("{}; {USAGE}", other.unexpected()).into()),
        }
    }
    let file = file.ok_or_else(|| format!("no surface file is given; {USAGE}"))?;
    let out = out.unwrap_or_else(|| Path::new("target/surface_report").join(format!("{}.svg", title(&file))));
    Ok(Some(Arguments { file, json, out }))
}

fn title(file: &Path) -> String {
    file.file_name().map_or_else(|| "surface".to_owned(), |name| name.to_string_lossy().into_owned())
}
