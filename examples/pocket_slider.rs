//! A slider with a pocket, in which the film cavitates and reforms: the benchmark of Fowell et al.
//!
//! ```text
//! cargo run --release --example pocket_slider -- [--speed U] [--cells N] [--json]
//! ```
//!
//! A pad of 10 mm, infinitely wide, over a surface that moves with `U` m/s. The film falls from 1.05 to 1 um,
//! the pocket is 1 um deep from 2 to 5 mm, the viscosity 0.01 Pa s, pressure 1e5 Pa at the edges and zero
//! where the film cavitates. Pressures are absolute, forces and flows those of one metre of width.
//!
//! Exit status: 0 converged, 1 not converged, 2 bad input, with one line on standard error.

use std::error::Error;
use std::io::{self, Write};
use std::process::ExitCode;

use serde_json::json;
use stribeck::lubricant::{Barus, Incompressible, Lubricant};
use stribeck::reynolds::{FilmThickness, GivenFilm, GivenFilmSolution, SideEdges};
use stribeck::{Grid, Status};

const USAGE: &str = "usage: pocket_slider [--speed U] [--cells N] [--json]";
const NOT_CONVERGED: u8 = 1;
const REFUSED: u8 = 2;

const LENGTH: f64 = 10e-3;
const POCKET: [f64; 2] = [2e-3, 5e-3];
const POCKET_DEPTH: f64 = 1e-6;
const VISCOSITY: f64 = 0.01;
const AMBIENT_PRESSURE: f64 = 1e5;

struct Arguments {
    speed: f64,
    cells: usize,
    json: bool,
}

fn main() -> ExitCode {
    match run() {
        Ok(Some(Status::Converged) | None) => ExitCode::SUCCESS,
        Ok(Some(_)) => ExitCode::from(NOT_CONVERGED),
        Err(error) => {
            let line = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
            // Nobody is left to be told when standard error is closed.
            let _ = writeln!(io::stderr(), "error: {line}");
            ExitCode::from(REFUSED)
        }
    }
}

/// The status of the solve; none when only help was wanted.
fn run() -> Result<Option<Status>, Box<dyn Error>> {
    let Some(arguments) = parse_arguments()? else {
        writeln!(io::stdout(), "{USAGE}")?;
        return Ok(None);
    };
    let grid = Grid::from_edges(arguments.cells, 1, [0.0, LENGTH], [0.0, 1.0])?;
    let film = FilmThickness::from_function(grid, |x, _| film_at(x))?;
    let oil = Lubricant::new(Barus::new(VISCOSITY, 0.0)?, Incompressible);
    let slider = GivenFilm::new(&film, &oil, [arguments.speed, 0.0])
        .with_ambient_pressure(AMBIENT_PRESSURE)
        .with_sides(SideEdges::Closed);
    let solution = slider.solve()?;
    let text = if arguments.json { to_json(&solution) } else { summary(&solution) };
    writeln!(io::stdout(), "{text}")?;
    Ok(Some(solution.report.status))
}

/// Film at `x` \[m\].
fn film_at(x: f64) -> f64 {
    let pad = 1.05e-6 - 0.05e-6 * x / LENGTH;
    if x > POCKET[0] && x < POCKET[1] { pad + POCKET_DEPTH } else { pad }
}

fn parse_arguments() -> Result<Option<Arguments>, Box<dyn Error>> {
    use lexopt::prelude::*;
    let mut parser = lexopt::Parser::from_env();
    let mut arguments = Arguments { speed: 0.02, cells: 1000, json: false };
    while let Some(argument) = parser.next()? {
        match argument {
            Long("speed") => arguments.speed = parser.value()?.parse()?,
            Long("cells") => arguments.cells = parser.value()?.parse()?,
            Long("json") => arguments.json = true,
            Long("help") | Short('h') => return Ok(None),
            other => return Err(format!("{}; {USAGE}", other.unexpected()).into()),
        }
    }
    Ok(Some(arguments))
}

/// Pressures where the pocket starts and ends \[Pa\].
fn pocket_pressures(solution: &GivenFilmSolution) -> [Option<f64>; 2] {
    POCKET.map(|x| solution.pressure_at(x, 0))
}

/// One line, SI units.
fn to_json(solution: &GivenFilmSolution) -> String {
    let [start, end] = pocket_pressures(solution);
    json!({
        "pressure_pocket_start": start,
        "pressure_pocket_end": end,
        "load": solution.load,
        "reformation": solution.reformation(0),
        "inflow": solution.flow.inflow,
        "outflow": solution.flow.outflow,
    })
    .to_string()
}

fn summary(solution: &GivenFilmSolution) -> String {
    let report = &solution.report;
    let [start, end] = pocket_pressures(solution).map(|p| p.unwrap_or(AMBIENT_PRESSURE));
    [
        format!(
            "{} in {} Newton steps on {} cells, {} on coarser grids",
            report.status,
            report.work.iterations,
            solution.grid().nx(),
            solution.coarse_steps
        ),
        format!(
            "pressure     {start:.1} Pa at {} mm, {end:.1} Pa at {} mm",
            POCKET[0] * 1e3,
            POCKET[1] * 1e3
        ),
        format!("load         {:.4} N/m", solution.load),
        solution.reformation(0).map_or_else(
            || "reformation  none: the film is full".to_owned(),
            |x| format!("reformation  at {:.5} mm", x * 1e3),
        ),
        format!("friction     {:.5} and {:.5} N/m", solution.friction[0], solution.friction[1]),
        format!(
            "flow         {:.6e} m^2/s in, {:.6e} m^2/s out, imbalance {:.1e}",
            solution.flow.inflow, solution.flow.outflow, solution.flow.imbalance
        ),
    ]
    .join("\n")
}
