//! `stribeck surface`: the parameters of a measured surface.

use std::error::Error;
use std::path::PathBuf;

use clap::ValueEnum;
use stribeck::Boundary;
use stribeck::surface::{self, Heights, LengthUnit, ReadOptions};
use stribeck::units::Dimension;

use crate::files;
use crate::output::{self, Outcome, Output};
use crate::picture::{self, Page};
use crate::surface_numbers::{Numbers, dominant_form};

/// Degree of the polynomial that is removed as a form.
const FORM_DEGREE: usize = 2;

/// Nothing is levelled, filtered or filled unless an option asks for it.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// File of heights: x3p, sur, sdf, prf, plu, al3d, npy or text
    file: PathBuf,
    /// Which surface of a file that holds several, counted from 1
    #[arg(long, value_name = "NUMBER")]
    channel: Option<usize>,
    /// Unit of heights and lengths for which the file names none
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// Remove the plane of least squares
    #[arg(long)]
    level: bool,
    /// Remove the form of least squares; the polynomial is of the second degree
    #[arg(long, value_enum, value_name = "FORM")]
    form: Option<Form>,
    /// Remove waves longer than this, "80 um" (L-filter of ISO 16610-61), after plane and form
    #[arg(long, value_name = "LENGTH")]
    filter: Option<String>,
    #[command(flatten)]
    output: Output,
}

/// Form that is removed.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Form {
    Sphere,
    Cylinder,
    Polynomial,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let mut measured = read(options)?;
    let mut warnings = measured.warnings().to_vec();
    let named = |error: Box<dyn Error>| format!("{}: {error}", options.file.display());
    prepare(options, &mut measured).map_err(named)?;
    let numbers = Numbers::of(&measured).map_err(|error| named(error.into()))?;
    warnings.extend(dominant_form(&measured));
    for warning in &warnings {
        output::complain("warning", &format!("{}: {warning}", options.file.display()));
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
        output::print(&numbers.to_json(&warnings))?;
    } else {
        output::print(&numbers.to_text().trim_end())?;
    }
    output::report_files(&written, options.output.json)?;
    Ok(Outcome::Converged)
}

/// The surface of the file.
fn read(options: &Options) -> Result<Heights, Box<dyn Error>> {
    let mut choices = ReadOptions::new();
    if let Some(channel) = options.channel {
        choices = choices.with_channel(channel);
    }
    if let Some(name) = &options.unit {
        let unit = LengthUnit::parse(name);
        let unit =
            unit.ok_or_else(|| format!("--unit = \"{name}\": must be a unit of length, such as um"))?;
        choices = choices.with_unit(unit);
    }
    surface::read_with(&options.file, &choices).map_err(|error| {
        let is_scene = options.file.extension().is_some_and(|end| end.eq_ignore_ascii_case("toml"));
        let remedy =
            if is_scene { "; `stribeck check` takes scene files, this takes files of heights" } else { "" };
        format!("{error}{remedy}").into()
    })
}

/// Removes plane, form and waviness as the options say.
fn prepare(options: &Options, surface: &mut Heights) -> Result<(), Box<dyn Error>> {
    if options.level {
        surface.remove_plane()?;
    }
    match options.form {
        Some(Form::Sphere) => drop(surface.remove_sphere()?),
        Some(Form::Cylinder) => drop(surface.remove_cylinder()?),
        Some(Form::Polynomial) => surface.remove_polynomial(FORM_DEGREE)?,
        None => {}
    }
    if let Some(length) = &options.filter {
        let cutoff = output::positive(Dimension::Length, "--filter", length)?;
        surface.l_filter(cutoff, Boundary::Open)?;
    }
    Ok(())
}
