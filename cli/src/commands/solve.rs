//! `stribeck solve`: one contact, a flat contact or a rigid bearing.

mod bearing;
mod bearing_profile;
mod flat;
mod passage;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use indicatif::ProgressBar;
use serde_json::Value;
use stribeck::sim::scene::{GridSpec, Scene};
use stribeck::sim::{
    ContactSolution, MixedLubricationSim, OilNumbers, SceneFile, SimError, Warning, write_npz,
};
use stribeck::{Grid, Status};

pub(super) use self::bearing::report as bearing_lines;
use super::contact_pictures::{Seen, maps, profile};
use super::strip_sample;
use crate::output::{self, Held, Outcome, Output, ReportFile};
use crate::report::{self, Fields, Report};
use crate::{files, interrupt, picture};

/// A scene with the table `given_film` is a rigid bearing: load, friction, side flow and power. A scene with `form.kind` flat is
/// a dry contact of rough planes: area, mean gap and stiffness.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Scene file
    scene: PathBuf,
    /// Write the fields as a NumPy archive
    #[arg(long, value_name = "OUT.npz")]
    fields: Option<PathBuf>,
    /// Write the contacts of a passage (motion.roughness = "moving") as comma-separated values
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// Write film and pressure of so many contacts of a passage as NumPy archives
    #[arg(long, value_name = "COUNT", allow_hyphen_values = true, value_parser = |text: &str| output::count::<usize>("--frames", text, 1..=10000))]
    frames: Option<usize>,
    #[command(flatten)]
    report: ReportFile,
    #[command(flatten)]
    output: Output,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    if let Some(path) = &options.fields {
        output::keep_scene(&options.scene, path)?;
    }
    options.report.claim(&options.scene, options.output.force)?;
    let scene = match output::load_any(&options.scene)? {
        SceneFile::Bearing(bearing) => return bearing::run(options, &bearing),
        SceneFile::Flat(contact) => return flat::run(options, &contact),
        file => output::contact(&options.scene, file)?,
    };
    if !scene.motion.roughness.is_at_rest() {
        return passage::run(options, scene, start);
    }
    if options.csv.is_some() || options.frames.is_some() {
        return Err("--csv and --frames are of a passage; add roughness = \"moving\" to [motion]".into());
    }
    claim(options, &scene)?;
    let (held, known) = (Held::default(), scene.warnings());
    // At the first iteration, before the long part.
    held.hold_warnings(&known);
    output::announce_memory(&scene, &held).map_err(|error| output::in_scene(&options.scene, &error))?;
    let refines = scene.solver.accuracy.is_some() || matches!(scene.grid, GridSpec::Accuracy { .. });
    if refines {
        interrupt::listen("the solve ends here")?;
    }
    let oil = scene.oil_numbers().ok().flatten();
    let sample = strip_sample::note(&scene, &options.scene);
    let hidden = ProgressBar::hidden();
    let builder = MixedLubricationSim::builder(scene).interrupt(move || {
        held.print(&hidden);
        interrupt::is_requested()
    });
    let solved = builder.solve_observed(|solution| {
        if refines {
            output::complain("mesh", &mesh_line(solution));
        }
    });
    let solution = match solved {
        Err(SimError::Interrupted) => {
            output::complain("error", "interrupted; the meshes above are solved, none to the accuracy");
            return Ok(Outcome::NotConverged);
        }
        solved => solved.map_err(|error| output::in_scene(&options.scene, &error))?,
    };
    output::warn(solution.warnings.iter().filter(|warning| !known.contains(warning)));
    finish(options, &solution, (oil.as_ref(), sample), start.elapsed().as_secs_f64())?;
    Ok(solution.report.status.into())
}

/// Writes the files of a solved contact and prints its numbers.
fn finish(
    options: &Options,
    solution: &ContactSolution,
    (oil, sample): (Option<&OilNumbers>, Option<String>),
    seconds: f64,
) -> Result<(), Box<dyn Error>> {
    let mut written = Vec::new();
    if let Some(path) = &options.fields {
        write_fields(path, &solution.grid, &solution.fields())?;
        written.push(path.clone());
    }
    if options.output.plot {
        written.extend(pictures(options, solution)?);
    }
    let mut numbers = serde_json::to_value(solution)?;
    numbers["seconds"] = seconds.into();
    numbers["oil"] = serde_json::to_value(oil)?;
    if let Some(path) = &options.report.report {
        write_report(options, solution, &numbers, path)?;
        written.push(path.clone());
    }
    if options.output.json {
        output::print(&numbers)?;
    } else {
        let scatter = oil.filter(|oil| oil.film_uncertainty >= 0.005).map_or_else(String::new, |oil| {
            format!(
                "\nby alpha   +- {:.0} % of the film: {}, +- {:.0} %",
                100.0 * oil.film_uncertainty,
                oil.alpha_source,
                100.0 * oil.alpha_uncertainty
            )
        });
        let kappa = oil.and_then(output::kappa).map_or_else(String::new, |line| format!("\n{line}"));
        let sample = sample.map_or_else(String::new, |note| format!("\nsample     {note}"));
        output::print(&format!("{solution}{scatter}{kappa}{sample}\ntime       {seconds:.2} s"))?;
    }
    output::report_files(&written, options.output.json)?;
    Ok(())
}

/// The solution of one mesh of several in a line.
fn mesh_line(solution: &ContactSolution) -> String {
    let (grid, estimate) = (&solution.grid, &solution.error_estimate);
    let percent = |error: f64| format!(" +- {:.2} %", 100.0 * error);
    let known = |error: Option<f64>| error.map_or_else(String::new, percent);
    format!(
        "{} x {} cells, {}: mean film {:.2} nm{}, load on solids {:.4}, friction {:.4}{}",
        grid.nx(),
        grid.ny(),
        solution.report.status,
        1e9 * solution.film.mean_central,
        known(estimate.map(|estimate| estimate.film_mean_central)),
        solution.contact.load_ratio,
        solution.friction.coefficient,
        known(estimate.map(|estimate| estimate.friction_coefficient))
    )
}

/// Checks before the solve that the files can be written.
fn claim(options: &Options, scene: &Scene) -> Result<(), String> {
    let force = options.output.force;
    if let Some(path) = &options.fields {
        files::claim(std::slice::from_ref(path), force, output::OTHER_NAME)?;
    }
    if options.output.plot {
        let (out, name) = (&options.output.out, output::stem(&options.scene));
        let has_rows = !scene.form.is_line() || matches!(scene.grid, GridSpec::Strip { .. });
        let maps = has_rows.then(|| picture::files(out, &format!("{name}_maps")));
        let mut targets: Vec<PathBuf> = maps.into_iter().flatten().collect();
        targets.extend(picture::files(out, &format!("{name}_profile")));
        files::make_folder(out)?;
        files::claim(&targets, force, output::OTHER_FOLDER)?;
    }
    Ok(())
}

/// Writes the `fields` on `grid` as a NumPy archive.
fn write_fields(path: &Path, grid: &Grid, fields: &[(&str, &[f64])]) -> Result<(), Box<dyn Error>> {
    files::write_with(path, |draft| {
        write_npz(draft, grid, fields).map_err(|error| match error {
            SimError::Io { source, .. } => files::named(path, &source).into(),
            other => other.into(),
        })
    })
}

fn pictures(options: &Options, solution: &ContactSolution) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let (name, seen) = (output::stem(&options.scene), seen(options, solution));
    let mut written = Vec::new();
    let out = &options.output.out;
    if solution.grid.ny() > 1 {
        written.extend(picture::write(&maps(&seen), out, &format!("{name}_maps"))?);
    }
    written.extend(picture::write(&profile(&seen), out, &format!("{name}_profile"))?);
    Ok(written)
}

fn seen<'a>(options: &Options, solution: &'a ContactSolution) -> Seen<'a> {
    Seen {
        title: format!("{}, {}", output::stem(&options.scene), solution.report.status),
        grid: solution.grid,
        hertz: solution.hertz,
        state: &solution.state,
        lubricated: solution.moes.is_some(),
        tribofilm: None,
    }
}

fn write_report(
    options: &Options,
    solution: &ContactSolution,
    numbers: &Value,
    path: &Path,
) -> Result<(), Box<dyn Error>> {
    let (status, seen) = (solution.report.status, seen(options, solution));
    let mut report = Report::new(&options.scene, "one contact", status)?;
    report.warn(solution.warnings.iter().map(ToString::to_string));
    report.table(&report::contact(
        numbers,
        solution.moes.is_some(),
        solution.grid.ny() == 1 || solution.grid.is_strip(),
    ));
    report.chart(&profile(&seen))?;
    if solution.grid.ny() > 1 {
        let maps = maps(&seen);
        report.maps(Some(&maps), &Fields::of(&maps, ""))?;
    }
    report.write(path)
}

/// Writes the report of a solve without a contact: all its numbers.
fn write_plain_report(
    options: &Options,
    (command, status): (&str, Status),
    warnings: &[Warning],
    numbers: &Value,
) -> Result<Option<PathBuf>, Box<dyn Error>> {
    let Some(path) = &options.report.report else { return Ok(None) };
    let mut report = Report::new(&options.scene, command, status)?;
    report.warn(warnings.iter().map(ToString::to_string));
    report.table(&report::all(numbers));
    report.write(path)?;
    Ok(Some(path.clone()))
}
