//! `stribeck solve`: one contact.

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use stribeck::sim::{ContactSolution, solve_contact, write_npz};

use super::contact_pictures::{Seen, maps, profile};
use crate::output::{self, Outcome, Output};
use crate::picture;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Scene file
    scene: PathBuf,
    /// Write the fields as a NumPy archive
    #[arg(long, value_name = "OUT.npz")]
    fields: Option<PathBuf>,
    #[command(flatten)]
    output: Output,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    if let Some(path) = &options.fields {
        output::keep_scene(&options.scene, path)?;
    }
    let scene = output::load(&options.scene)?;
    // Before the solve, which may take long.
    let known = scene.warnings();
    output::warn(&known);
    let solution = solve_contact(&scene).map_err(|error| output::in_scene(&options.scene, &error))?;
    let seconds = start.elapsed().as_secs_f64();
    let mut files = Vec::new();
    if let Some(path) = &options.fields {
        write_npz(path, &solution.grid, &solution.fields())?;
        files.push(path.clone());
    }
    if options.output.plot {
        files.extend(pictures(options, &solution)?);
    }
    let mut numbers = serde_json::to_value(&solution)?;
    numbers["seconds"] = seconds.into();
    output::warn(solution.warnings.iter().filter(|warning| !known.contains(warning)));
    if options.output.json {
        output::print(&numbers)?;
    } else {
        output::print(&format!("{solution}\ntime       {seconds:.2} s"))?;
    }
    output::report_files(&files, options.output.json)?;
    Ok(solution.report.status.into())
}

fn pictures(options: &Options, solution: &ContactSolution) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let name = output::stem(&options.scene);
    let seen = Seen {
        title: format!("{name}, {}", solution.report.status),
        grid: solution.grid,
        hertz: solution.hertz,
        state: &solution.state,
        lubricated: solution.moes.is_some(),
        tribofilm: None,
    };
    let mut files = Vec::new();
    let out = &options.output.out;
    if solution.grid.ny() > 1 {
        files.extend(picture::write(&maps(&seen), out, &format!("{name}_maps"))?);
    }
    files.extend(picture::write(&profile(&seen), out, &format!("{name}_profile"))?);
    Ok(files)
}
