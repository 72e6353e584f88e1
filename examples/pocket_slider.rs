//! A slider with a pocket, in which the film cavitates and reforms: the benchmark of Fowell et al.
//!
//! ```text
//! cargo run --release --example pocket_slider -- [--speed U] [--cells N] [--json]
//! ```
//!
//! A pad of 10 mm, infinitely wide, over a surface that moves with `U` m/s. The film falls from 1.05 to 1 um,
//! the pocket is 1 um deep from 2 to 5 mm, the viscosity 0.01 Pa s, pressure 1e5 Pa at the edges and zero
//! where the film cavitates. Pressures are absolute, forces and flows those of one metre of width.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "command/mod.rs"]
mod command;

use std::process::ExitCode;

use lexopt::prelude::*;
use serde_json::json;
use stribeck::Grid;
use stribeck::lubricant::{Barus, Incompressible, Lubricant};
use stribeck::reynolds::{FilmThickness, GivenFilm, SideEdges};

const USAGE: &str = "usage: pocket_slider [--speed U] [--cells N] [--json]\n";
const LENGTH: f64 = 10e-3;
const POCKET: [f64; 2] = [2e-3, 5e-3];

/// Speed \[m/s\], number of cells, and whether the output is JSON.
type Options = (f64, usize, bool);

fn main() -> ExitCode {
    command::run("pocket_slider", USAGE, options(), |(speed, cells, json)| {
        let grid = Grid::from_edges(*cells, 1, [0.0, LENGTH], [0.0, 1.0])?;
        let film = FilmThickness::from_function(grid, |x, _| film_at(x))?;
        let oil = Lubricant::new(Barus::new(0.01, 0.0)?, Incompressible);
        let slider = GivenFilm::new(&film, &oil, [*speed, 0.0]).with_ambient_pressure(1e5);
        let solution = slider.with_sides(SideEdges::Closed).solve()?;
        let [start, end] = POCKET.map(|x| solution.pressure_at(x, 0));
        let values = json!({
            "pressure_pocket_start": start,
            "pressure_pocket_end": end,
            "load": solution.load,
            "reformation": solution.reformation(0),
            "friction": solution.friction,
            "inflow": solution.flow.inflow,
            "outflow": solution.flow.outflow,
        });
        println!("{}", if *json { values.to_string() } else { format!("{values:#}") });
        Ok(solution.report.require_converged()?)
    })
}

/// Film at `x` \[m\].
fn film_at(x: f64) -> f64 {
    let pocket = if x > POCKET[0] && x < POCKET[1] { 1e-6 } else { 0.0 };
    1.05e-6 - 0.05e-6 * x / LENGTH + pocket
}

fn options() -> Result<Option<Options>, lexopt::Error> {
    let mut options = (0.02, 1000, false);
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("speed") => options.0 = parser.value()?.parse()?,
            Long("cells") => options.1 = parser.value()?.parse()?,
            Long("json") => options.2 = true,
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    Ok(Some(options))
}
