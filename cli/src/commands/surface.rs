//! `stribeck surface`: the parameters of a measured surface.

use std::error::Error;
use std::path::PathBuf;

use stribeck::surface;

use crate::files;
use crate::output::{self, Outcome, Output};
use crate::picture::{self, Page};
use crate::surface_numbers::Numbers;

/// Nothing is levelled, filtered or filled first.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// File of heights: x3p, sur, sdf, plu, al3d, npy or text
    file: PathBuf,
    #[command(flatten)]
    output: Output,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let measured = surface::read(&options.file)?;
    let numbers = Numbers::of(&measured)?;
    if let Some(warning) = numbers.warning() {
        output::complain("warning", &warning);
    }
    let mut written = Vec::new();
    if options.output.plot {
        let file = options.file.file_name().unwrap_or(options.file.as_os_str());
        let title = file.to_string_lossy().into_owned();
        let name = format!("{}_surface", output::stem(&options.file));
        let Output { out, force, .. } = &options.output;
        files::make_folder(out)?;
        files::claim(&picture::files(out, &name), *force, output::OTHER_FOLDER)?;
        let page = Page { title, surface: &measured, numbers: &numbers };
        written.extend(picture::write(&page, out, &name)?);
    }
    if options.output.json {
        output::print(&numbers.to_json())?;
    } else {
        output::print(&numbers.to_text().trim_end())?;
    }
    output::report_files(&written, options.output.json)?;
    Ok(Outcome::Converged)
}
