//! Common parts of the subcommands: messages and files, reading of scenes, exit codes.

use std::error::Error;
use std::fmt::Display;
use std::io::{self, Write};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use indicatif::ProgressBar;
use stribeck::sim::{CheckpointError, OilNumbers, Scene, SceneFile, SimError, Warning};
use stribeck::units::Dimension;
use stribeck::{InputError, Status};

use crate::files::{self, io_words};

/// How a subcommand ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outcome {
    Converged,
    NotConverged,
    Refused,
}

impl Outcome {
    /// The exit status.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Converged => 0,
            Self::NotConverged => 1,
            Self::Refused => 2,
        }
    }
}

impl From<Status> for Outcome {
    fn from(status: Status) -> Self {
        if status == Status::Converged { Self::Converged } else { Self::NotConverged }
    }
}

/// Where JSON, pictures and other files go.
#[derive(clap::Args)]
pub(crate) struct Output {
    /// Print one JSON object in SI units on standard output
    #[arg(long)]
    pub(crate) json: bool,
    /// Write pictures as SVG and PNG
    #[arg(long)]
    pub(crate) plot: bool,
    /// Folder for files that are written
    #[arg(long, value_name = "FOLDER", default_value = ".")]
    pub(crate) out: PathBuf,
    /// Write over files that exist
    #[arg(long)]
    pub(crate) force: bool,
}

/// The report of a solve, curve, cycle or run.
#[derive(clap::Args)]
pub(crate) struct ReportFile {
    /// Write one HTML file with scene, warnings, numbers and pictures, for a browser or the printer
    #[arg(long, value_name = "OUT.html")]
    pub(crate) report: Option<PathBuf>,
}

impl ReportFile {
    /// Checks that the report can be written.
    pub(crate) fn claim(&self, scene: &Path, force: bool) -> Result<(), String> {
        let Some(path) = &self.report else { return Ok(()) };
        keep_scene(scene, path)?;
        files::claim(std::slice::from_ref(path), force, OTHER_NAME)
    }
}

/// Ends of messages about files that exist.
pub(crate) const OTHER_FOLDER: &str = "--out FOLDER writes elsewhere";
pub(crate) const OTHER_NAME: &str = "another name writes elsewhere";
/// Memory from which on a solve announces it \[byte\].
const MUCH_MEMORY: f64 = 1e9;

/// Refuses to write `file` over the `scene` that it is made from.
pub(crate) fn keep_scene(scene: &Path, file: &Path) -> Result<(), String> {
    match (scene.canonicalize(), file.canonicalize()) {
        (Ok(scene), Ok(same)) if scene == same => Err(format!(
            "{}: this is the scene, which would be written over; give another name",
            file.display()
        )),
        _ => Ok(()),
    }
}

/// Writes `text` and the end of a line to standard output.
pub(crate) fn print(text: &dyn Display) -> io::Result<()> {
    match writeln!(io::stdout(), "{text}") {
        // A reader that has enough, as `head`, is no fault.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(io::Error::other(format!("standard output: {}", io_words(&error)))),
        Ok(()) => Ok(()),
    }
}

/// The message without the number that the system appends to its own.
fn without_number(message: &str) -> String {
    let Some((words, rest)) = message.split_once(" (os error ") else { return message.to_owned() };
    rest.split_once(')').map_or_else(|| message.to_owned(), |(_, rest)| format!("{words}{rest}"))
}

/// One line on standard error.
pub(crate) fn complain(kind: &str, text: &str) {
    let line = without_number(text).split_whitespace().collect::<Vec<_>>().join(" ");
    // Without standard error the message is lost.
    let _ = writeln!(io::stderr(), "{kind}: {line}");
}

/// Prints warnings on standard error, one line each.
pub(crate) fn warn<'a>(warnings: impl IntoIterator<Item = &'a Warning>) {
    for warning in warnings {
        complain("warning", &warning.to_string());
    }
}

/// A time in seconds or, where it is short, in milliseconds.
pub(crate) fn time(seconds: f64) -> String {
    if seconds > 0.0 && seconds < 1.0 {
        format!("{:.3} ms", 1e3 * seconds)
    } else {
        format!("{seconds:.1} s")
    }
}

/// Lines that are printed at the first iteration of a solve: an input that is refused before has its error
/// alone.
#[derive(Clone, Default)]
pub(crate) struct Held(Arc<Mutex<Vec<(&'static str, String)>>>);

impl Held {
    pub(crate) fn hold(&self, kind: &'static str, text: String) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push((kind, text));
    }

    pub(crate) fn hold_warnings(&self, warnings: &[Warning]) {
        warnings.iter().for_each(|warning| self.hold("warning", warning.to_string()));
    }

    /// The texts of the warnings that are still to be printed.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let lines = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        lines.iter().filter(|(kind, _)| *kind == "warning").map(|(_, text)| text.clone()).collect()
    }

    /// Prints them above the `bar`, once.
    pub(crate) fn print(&self, bar: &ProgressBar) {
        let lines = std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner));
        if !lines.is_empty() {
            bar.suspend(|| lines.iter().for_each(|(kind, text)| complain(kind, text)));
        }
    }
}

/// Holds a line about the memory that a solve of the scene begins with, if that is much.
pub(crate) fn announce_memory(scene: &Scene, held: &Held) -> Result<(), SimError> {
    let bytes = scene.first_memory()?;
    if bytes >= MUCH_MEMORY {
        held.hold("needs", format!("about {:.1} GB of memory", 1e-9 * bytes));
    }
    Ok(())
}

/// A number with five digits, by powers of ten below 1e-4 and from 1e7 on.
pub(crate) fn digits(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    if !(9.9999e-5..9.9999e6).contains(&size) {
        return format!("{value:.4e}");
    }
    format!("{value:.*}", (4 - size.log10().floor() as i32).max(0) as usize)
}

/// Says which files were written; with `json` standard output is not for that.
pub(crate) fn report_files(files: &[PathBuf], json: bool) -> io::Result<()> {
    for file in files {
        let line = format!("written    {}", file.display());
        if json { writeln!(io::stderr(), "{line}")? } else { print(&line)? }
    }
    Ok(())
}

/// The contents of the scene file at `path`.
pub(crate) fn load_any(path: &Path) -> Result<SceneFile, String> {
    SceneFile::load(path).map_err(|error| in_scene(path, plain(error).as_ref()))
}

/// The contact of curved bodies in the scene file at `path`.
pub(crate) fn load(path: &Path) -> Result<Scene, String> {
    contact(path, load_any(path)?)
}

/// The contact of curved bodies in `file`; a file of another kind is an error that names the commands for it.
pub(crate) fn contact(path: &Path, file: SceneFile) -> Result<Scene, String> {
    let is = match file {
        SceneFile::Contact(scene) => return Ok(*scene),
        SceneFile::Bearing(_) => {
            "[given_film] is a rigid bearing, which `stribeck check`, `solve` and `curve` take; `stribeck curve --over speed` (or load, \
             temperature) solves it for several values"
        }
        _ => {
            "form.kind = \"flat\" is a contact of flat surfaces, which `stribeck solve` takes, one load.mean_pressure or \
             load.mean_gap at a time"
        }
    };
    Err(format!("{}: {is}", path.display()))
}

/// The remark that `command` leaves out the cycle of `scene`, if it has one.
pub(crate) fn without_cycle(scene: &Scene, command: &str) -> Option<String> {
    scene.cycle.as_ref().map(|_| {
        format!(
            "[cycle]: `stribeck {command}` solves the contact of the scene; `stribeck cycle` solves its cycle"
        )
    })
}

/// The error with the scene file in front, unless it already names it.
pub(crate) fn in_scene(path: &Path, error: &dyn Error) -> String {
    let (name, text) = (path.display().to_string(), error.to_string());
    if text.starts_with(&name) { text } else { format!("{name}: {text}") }
}

/// Name of `file` without folder and ending, for the files that come of it.
pub(crate) fn stem(file: &Path) -> String {
    file.file_stem().map_or_else(|| "stribeck".to_owned(), |name| name.to_string_lossy().into_owned())
}

/// The error of the library with those of files in plain words.
pub(crate) fn plain(error: SimError) -> Box<dyn Error> {
    match error {
        SimError::Io { path, source } | SimError::Checkpoint(CheckpointError::Io { path, source }) => {
            files::named(&path, &source).into()
        }
        other => other.into(),
    }
}

/// A number in SI units, or one with a unit.
pub(crate) fn quantity(dimension: Dimension, field: &str, text: &str) -> Result<f64, InputError> {
    text.trim().parse().or_else(|_| dimension.parse(field, text))
}

/// The value of an option that must be positive.
pub(crate) fn positive(dimension: Dimension, field: &str, text: &str) -> Result<f64, InputError> {
    let value = quantity(dimension, field, text)?;
    let requirement = match dimension {
        Dimension::Speed => "finite and > 0, such as \"0.5 m/s\": the oil flows along +x",
        Dimension::Length => "finite and > 0, such as \"10 mm\"",
        Dimension::Force => "finite and > 0, such as \"20 N\"",
        Dimension::ForcePerLength => "finite and > 0, such as \"100 kN/m\"",
        Dimension::Viscosity => "finite and > 0, such as \"10 mPa s\"",
        Dimension::InversePressure => "finite and > 0, such as \"18 1/GPa\"",
        Dimension::Temperature => "above absolute zero, such as \"40 degC\"",
        _ => "finite and > 0",
    };
    require(value > 0.0, field, value, requirement)
}

/// The value of an option that counts something.
pub(crate) fn count<N: TryFrom<u64>>(
    field: &str,
    text: &str,
    range: RangeInclusive<u64>,
) -> Result<N, InputError> {
    let number = text.trim().parse().ok().filter(|number| range.contains(number));
    number.and_then(|number| N::try_from(number).ok()).ok_or_else(|| {
        let [least, most] = [range.start(), range.end()];
        let to = if *most == u64::MAX { String::new() } else { format!(" to {most}") };
        InputError::Conflict {
            field: format!("{field} = \"{text}\""),
            reason: format!("must be a whole number from {least}{to}"),
        }
    })
}

/// The value of an option that is a ratio of any sign: a number, or one in per cent.
pub(crate) fn ratio(field: &str, text: &str) -> Result<f64, InputError> {
    let value = quantity(Dimension::Ratio, field, text)?;
    require(true, field, value, "finite")
}

/// The `value` of `field`, if it is finite and `holds`.
pub(crate) fn require(
    holds: bool,
    field: &str,
    value: f64,
    requirement: &'static str,
) -> Result<f64, InputError> {
    if holds && value.is_finite() {
        Ok(value)
    } else {
        Err(InputError::Value { field: field.to_owned(), value, requirement })
    }
}

/// The viscosity ratio of a bearing in a line; `None` without a bearing.
pub(crate) fn kappa(oil: &OilNumbers) -> Option<String> {
    let (kappa, viscosity) = (oil.kappa?, 1e6 * oil.kinematic_viscosity);
    Some(format!(
        "kappa      {kappa:.3}: {viscosity:.2} mm^2/s over {:.2} mm^2/s by ISO 281",
        viscosity / kappa
    ))
}
