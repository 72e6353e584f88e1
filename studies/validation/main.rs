//! Computed contacts beside measurements, closed forms and published solutions. Writes the numbers with their deviations as
//! CSV and the figures as SVG, and the tables of `docs/validation.md`.
//!
//! ```text
//! cargo run --release -p studies --bin validation                   # all rows
//! cargo run --release -p studies --bin validation -- hertz waves    # rows by name
//! cargo run --release -p studies --bin validation -- --page docs    # all rows, and the page of the book
//! cargo run --release -p studies --bin validation -- hertz --page docs   # a row, and its part of the page
//! ```
//!
//! A number outside of the deviation that the page states is an error.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

mod bearings;
#[path = "../../examples/chart/mod.rs"]
mod chart;
#[path = "../../examples/command/mod.rs"]
mod command;
mod dry;
mod ellipses;
mod films;
mod inlet_heat;
mod mourier;
mod mourier_data;
mod page;
#[path = "../../tests/common/pocket_slider.rs"]
mod pocket_slider;
mod reciprocation;
mod report;
mod rig;
#[path = "../../tests/common/rolling.rs"]
mod rolling;
mod rough;
mod rough_seeds;
mod speed_changes;
mod starvation;
mod waves;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use lexopt::prelude::*;
use report::{Effort, Outcome, Row};

const USAGE: &str = "\
usage: cargo run --release -p studies --bin validation -- [ROW ...] [--quick] [--out DIR] [--page DIR]

  ROW         rows by name (default: all)
  --quick     few cases of each row
  --out DIR   folder of validation.csv and of the figures (default target/validation)
  --page DIR  also renew the tables of these rows in DIR/validation.md, their lines of DIR/validation.csv and their figures in
              DIR/validation
";

type Compute = fn(Effort) -> Outcome<Row>;

/// In the order of the page: measurements, independent computations, closed forms, fits.
const ROWS: [(&str, Compute); 23] = [
    ("mourier", mourier::row),
    ("rig", rig::row),
    ("crowned_rollers", ellipses::row),
    ("rough_films", rough::row),
    ("rough_seeds", rough_seeds::row),
    ("speed_changes", speed_changes::row),
    ("journal_bearings", bearings::journal_bearings),
    ("pocket", bearings::pocket),
    ("reciprocation", reciprocation::row),
    ("waves", waves::row),
    ("inlet_heat", inlet_heat::row),
    ("slider", bearings::slider),
    ("step_bearing", bearings::step_bearing),
    ("hertz", dry::hertz),
    ("wavy_surface", dry::wavy_surface),
    ("subsurface", dry::subsurface),
    ("contact_area", dry::contact_area),
    ("point_films", films::points),
    ("line_films", films::lines),
    ("coarse_lines", films::coarse_lines),
    ("rigid_films", films::rigid),
    ("soft_films", films::soft),
    ("starvation", starvation::row),
];

struct Options {
    rows: Vec<String>,
    quick: bool,
    out: PathBuf,
    page: Option<PathBuf>,
}

fn options() -> Result<Option<Options>, lexopt::Error> {
    let mut options =
        Options { rows: Vec::new(), quick: false, out: PathBuf::from("target/validation"), page: None };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Value(name) => options.rows.push(name.string()?),
            Long("quick") => options.quick = true,
            Long("out") => options.out = PathBuf::from(parser.value()?),
            Long("page") => options.page = Some(PathBuf::from(parser.value()?)),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    let known = |name: &String| ROWS.iter().any(|(row, _)| row == name);
    if let Some(name) = options.rows.iter().find(|name| !known(name)) {
        let names: Vec<&str> = ROWS.iter().map(|(row, _)| *row).collect();
        return Err(format!("there is no row `{name}`; the rows are {}", names.join(", ")).into());
    }
    if options.page.is_some() && options.quick {
        return Err("the page needs rows in full: leave out --quick".into());
    }
    Ok(Some(options))
}

fn main() -> ExitCode {
    command::run("validation", USAGE, options(), run)
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let effort = if options.quick { Effort::Short } else { Effort::Full };
    let asked = |name: &str| options.rows.is_empty() || options.rows.iter().any(|row| row == name);
    let mut rows = Vec::new();
    for (name, compute) in ROWS.into_iter().filter(|(name, _)| asked(name)) {
        let start = Instant::now();
        let row = compute(effort).map_err(|error| -> Box<dyn Error> { error })?;
        println!("{name}, {:.0} s\n\n{}", start.elapsed().as_secs_f64(), row.table());
        rows.push(row);
    }
    std::fs::create_dir_all(&options.out)?;
    page::write_files(&rows, &options.out.join("validation.csv"), &options.out)?;
    if let Some(folder) = &options.page {
        page::renew(&rows, folder)?;
    }
    let failures: String = rows.iter().map(Row::failures).collect();
    if failures.is_empty() {
        Ok(())
    } else {
        Err(format!("outside of the stated deviation:\n{failures}").into())
    }
}

#[cfg(test)]
mod tests {
    use super::{Effort, ROWS};

    /// The short form of a row holds the deviations that the page states.
    fn check(name: &str) {
        let found = ROWS.iter().find(|(row, _)| *row == name).map(|(_, compute)| compute(Effort::Short));
        match found {
            Some(Ok(row)) => {
                assert!(!row.numbers.is_empty() && row.failures().is_empty(), "{}", row.failures());
            }
            Some(Err(error)) => panic!("{name}: {error}"),
            None => panic!("there is no row {name}"),
        }
    }

    macro_rules! rows {
        ($($test:ident: $row:literal;)*) => {
            $(#[test] fn $test() { check($row); })*

            #[test]
            fn every_row_has_a_test() {
                let tested = [$($row),*];
                assert!(ROWS.iter().all(|(name, _)| tested.contains(name)) && tested.len() == ROWS.len());
            }
        };
    }

    rows! {
        smooth_film_of_a_ball_is_near_the_measured_one: "mourier";
        film_grows_with_speed_as_on_the_rig: "rig";
        minimum_films_of_crowned_rollers_lie_below_the_measured_mean: "crowned_rollers";
        rough_films_reach_the_smooth_film_above_lambda_two: "rough_films";
        rough_films_scatter_little_between_surfaces: "rough_seeds";
        film_lags_behind_the_steady_one_of_its_speed: "speed_changes";
        least_film_of_a_stroke_is_at_its_end: "reciprocation";
        journal_bearings_match_the_table: "journal_bearings";
        pocket_has_the_published_peak: "pocket";
        slider_with_a_pocket_is_that_of_the_integrals: "slider";
        step_bearing_has_the_load_of_the_closed_form: "step_bearing";
        dry_contacts_are_those_of_hertz: "hertz";
        wavy_surface_has_the_gap_of_westergaard: "wavy_surface";
        stresses_below_the_surface_are_those_of_johnson: "subsurface";
        contact_area_over_load_lies_between_the_bounds: "contact_area";
        waves_have_the_published_amplitudes: "waves";
        point_films_are_near_the_formula: "point_films";
        line_films_are_near_the_formula: "line_films";
        coarse_lines_are_off_by_the_stated_part: "coarse_lines";
        film_of_a_rigid_ball_is_near_the_formula: "rigid_films";
        films_of_soft_balls_are_near_the_formulas: "soft_films";
        starved_films_lie_between_the_published_curves: "starvation";
        heated_inlets_are_near_the_independent_solution: "inlet_heat";
    }
}
