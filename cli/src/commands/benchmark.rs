//! `stribeck benchmark`: solvers over lists of cases.

use std::error::Error;
use std::path::PathBuf;

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use stribeck::benchmark::{Benchmark, Budget, Cases, Contestant, Results, Row, Verdict};
use stribeck::sim::SimError;
use stribeck::units::Dimension;

use crate::output::{self, Outcome};
use crate::{files, interrupt};

/// Rows are kept in benchmark.csv as they are solved; rows that are kept are not solved again. Ctrl-C ends the
/// benchmark.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// List of cases: battery, corners, map, lines, thermal, references, or a file with tables [[case]]
    #[arg(long, value_name = "LIST", default_value = "battery")]
    cases: Vec<String>,
    /// Solver, with settings if wanted: `auto`, `newton_krylov:halvings=1`, `auto:face_mobility=wedge`
    #[arg(long, value_name = "SOLVER", default_value = "auto")]
    solver: Vec<String>,
    /// Seed of the roughness of the lists
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only cases with this tag
    #[arg(long)]
    tag: Option<String>,
    /// Only every Nth case
    #[arg(long, value_name = "N", default_value_t = 1)]
    every: usize,
    /// Only N cases, drawn by the seed
    #[arg(long, value_name = "N")]
    draw: Option<usize>,
    /// Tolerance of the residuals
    #[arg(long, value_name = "RESIDUAL", default_value = "1e-6")]
    tolerance: Vec<f64>,
    /// Cells along x, in place of those of the cases
    #[arg(long, value_name = "CELLS")]
    mesh: Vec<usize>,
    /// Limit of time for one case, "10 min"
    #[arg(long, value_name = "TIME", default_value = "600 s")]
    time: String,
    /// Limit of convolutions for one case
    #[arg(long, value_name = "N")]
    convolutions: Option<f64>,
    /// Cases that are solved at the same time [default: the number of processors]
    #[arg(long, value_parser = |text: &str| output::count::<usize>("--jobs", text, 1..=4096))]
    jobs: Option<usize>,
    /// Print one JSON object in SI units on standard output
    #[arg(long)]
    json: bool,
    /// Write stability map, work-precision chart and performance profile as SVG
    #[arg(long)]
    plot: bool,
    /// Folder for table and pictures
    #[arg(long, value_name = "FOLDER", default_value = ".")]
    out: PathBuf,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let mut cases = Cases::default();
    for name in &options.cases {
        cases = cases.joined(list(name, options.seed)?);
    }
    if let Some(tag) = &options.tag {
        cases = cases.tagged(tag);
    }
    cases = cases.every(options.every);
    if let Some(count) = options.draw {
        cases = cases.draw(count, options.seed);
    }
    files::make_folder(&options.out)?;
    let table = options.out.join("benchmark.csv");
    let results = solve(options, cases, table.clone())?;
    let mut written = vec![table];
    if options.plot {
        for (name, picture) in [
            ("stability_map", results.stability_map()),
            ("work_precision", results.work_precision()),
            ("performance_profile", results.performance_profile()),
        ] {
            let file = options.out.join(format!("{name}.svg"));
            files::write(&file, picture.as_bytes())?;
            written.push(file);
        }
    }
    if options.json {
        output::print(&json!({ "rows": results, "version": env!("CARGO_PKG_VERSION") }))?;
    } else {
        output::print(&results.summary().trim_end())?;
    }
    output::report_files(&written, options.json)?;
    let fails = |row: &Row| !row.is_solved() && row.verdict != Verdict::Refused;
    Ok(if results.rows().iter().any(fails) { Outcome::NotConverged } else { Outcome::Converged })
}

/// A list of the library, or the cases of a file.
fn list(name: &str, seed: u64) -> Result<Cases, Box<dyn Error>> {
    let is_known = Cases::names().contains(&name);
    let is_file = !is_known && (name.ends_with(".toml") || PathBuf::from(name).exists());
    let cases = if is_file { Cases::load(name) } else { Cases::named(name, seed) };
    cases.map_err(output::plain)
}

fn solve(options: &Options, cases: Cases, table: PathBuf) -> Result<Results, Box<dyn Error>> {
    let seconds = output::positive(Dimension::Time, "--time", &options.time)?;
    let budget = Budget::default().with_seconds(seconds);
    let budget = budget.with_convolutions(options.convolutions.unwrap_or(f64::INFINITY));
    let solvers = options.solver.iter().map(|text| Contestant::named(text));
    let solvers = solvers.collect::<Result<Vec<_>, _>>()?;
    interrupt::listen("the benchmark ends; the same command goes on with the rows that are left")?;
    let style = ProgressStyle::with_template("{wide_bar} {pos} of {len} rows, {eta} left")?;
    let bar = ProgressBar::new(0).with_style(style);
    let mut benchmark = Benchmark::new(cases)
        .contestants(solvers)
        .tolerances(options.tolerance.iter().copied())
        .meshes(options.mesh.iter().copied())
        .budget(budget)
        .file(table)
        .interrupt(interrupt::is_requested)
        .observe(|_: &Row, done, count| {
            bar.set_length(count as u64);
            bar.set_position(done as u64);
        });
    if let Some(jobs) = options.jobs {
        benchmark = benchmark.threads(jobs);
    }
    let results = benchmark.run();
    bar.finish_and_clear();
    results.map_err(|error| match error {
        SimError::Interrupted => "interrupted; the same command goes on with the rows that are left".into(),
        other => output::plain(other),
    })
}
