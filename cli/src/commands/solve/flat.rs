//! Dry contact of flat rough surfaces: scenes with `form.kind = "flat"`.

use std::error::Error;
use std::time::Instant;

use stribeck::sim::{FlatContact, FlatContactSolution};
use stribeck::units::by_size;

use super::{Options, write_fields, write_plain_report};
use crate::output::{self, Outcome};
use crate::{files, interrupt};

pub(super) fn run(options: &Options, contact: &FlatContact) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    if options.output.plot {
        return Err(
            "--plot: there are no pictures of a flat contact; --fields OUT.npz has its pressures".into()
        );
    }
    if let Some(path) = &options.fields {
        files::claim(std::slice::from_ref(path), options.output.force, output::OTHER_NAME)?;
    }
    let solved = contact.solve(interrupt::is_requested);
    let solution = solved.map_err(|error| output::in_scene(&options.scene, &error))?;
    output::warn(&solution.warnings);
    if let Some(path) = &options.fields {
        write_fields(path, &solution.grid, &solution.fields())?;
    }
    let seconds = start.elapsed().as_secs_f64();
    let mut numbers = serde_json::to_value(solution.numbers)?;
    numbers["status"] = serde_json::to_value(solution.status)?;
    numbers["warnings"] = serde_json::to_value(&solution.warnings)?;
    numbers["seconds"] = seconds.into();
    numbers["version"] = env!("CARGO_PKG_VERSION").into();
    let report_file =
        write_plain_report(options, ("flat contact", solution.status), &solution.warnings, &numbers)?;
    if options.output.json {
        output::print(&numbers)?;
    } else {
        output::print(&format!("{}\ntime       {seconds:.2} s", report(&solution)))?;
    }
    output::report_files(
        &options.fields.iter().cloned().chain(report_file).collect::<Vec<_>>(),
        options.output.json,
    )?;
    Ok(solution.status.into())
}

/// The numbers for people.
fn report(solution: &FlatContactSolution) -> String {
    let numbers = &solution.numbers;
    let stiffness = numbers.stiffness.map_or_else(
        || "the gap is closed".to_owned(),
        |stiffness| format!("{:.4} MPa/nm, mean pressure over decrease of the mean gap", 1e-15 * stiffness),
    );
    let mut lines = vec![
        format!("status     {}", solution.status),
        format!("area       {:.5} of the cell in contact", numbers.area_share),
        format!(
            "mean gap   {}, {:.3} of Rq",
            by_size(numbers.mean_gap, "m"),
            numbers.mean_gap / numbers.composite_rq
        ),
        format!(
            "pressure   {} on average, at most {}",
            by_size(numbers.mean_pressure, "Pa"),
            by_size(numbers.pressure_max, "Pa")
        ),
        format!("stiffness  {stiffness}"),
        format!(
            "roughness  Rq {:.2} nm, root mean square slope {:.5}; area over load {:.3} (Persson 1.60, Bush-Gibson-Thomas 2.51)",
            1e9 * numbers.composite_rq,
            numbers.rms_slope,
            numbers.area_over_load
        ),
    ];
    if numbers.plastic_share > 0.0 {
        lines.push(format!(
            "plastic    {:.5} of the cell at the hardness, {:.3} nm deep on average",
            numbers.plastic_share,
            1e9 * numbers.mean_plastic_depth
        ));
    }
    lines.push(format!("error      energy within {:.1e}", numbers.energy_error));
    lines.join("\n")
}
