//! The report of a cycle as a page.

use std::error::Error;
use std::path::Path;

use serde_json::Value;
use stribeck::Status;

use super::chart::{chart, pressure_unit};
use super::solved::Solved;
use super::{Kind, LINES, Options};
use crate::output;
use crate::report::{self, ErrorOf, Number, Report};

/// Columns of the report.
const COLUMNS: [(&str, &str, &str, f64); 12] = [
    ("angle", "angle", "deg", 180.0 / std::f64::consts::PI),
    ("time", "time", "ms", 1e3),
    ("load", "load", "N", 1.0),
    ("Hertz", "hertz_pressure", "GPa", 1e-9),
    ("h formula", "formula_film", "nm", 1e9),
    ("h", "film_central", "nm", 1e9),
    ("h min", "film_minimum", "nm", 1e9),
    ("p max", "pressure_max", "GPa", 1e-9),
    ("on solids", "contact_load_ratio", "", 1.0),
    ("friction", "friction_coefficient", "", 1.0),
    ("power", "friction_power", "W", 1.0),
    ("flash", "flash_rise", "K", 1.0),
];

/// Writes the report of `solution` with its `extremes` to the file `path`.
pub(super) fn write(
    options: &Options,
    (solution, squeeze): (&Solved, Option<String>),
    (numbers, kind): (&Value, Kind),
    (extremes, path): (&[(&str, String)], &Path),
) -> Result<(), Box<dyn Error>> {
    let mut report = Report::new(&options.scene, "cycle", Status::Converged)?;
    report.warn(solution.warnings.iter().map(ToString::to_string).chain(squeeze));
    if let Some(reason) = &solution.ended_early {
        report.end_early(reason);
    }
    let pressure = pressure_unit(&solution.points);
    let columns = COLUMNS.map(|(name, key, unit, factor)| {
        let unit = match (unit, kind.is_line) {
            ("N", true) => "N/m",
            ("W", true) => "W/m",
            ("GPa", _) => pressure.0,
            _ => unit,
        };
        let (name, key) = match key {
            "film_central" if kind.is_rough => ("h mean", "film_mean_central"),
            key => (name, key),
        };
        let factor =
            if key.ends_with("pressure") || key == "pressure_max" { 1.0 / pressure.1 } else { factor };
        Number { name, key, unit, factor, offset: 0.0, error: ErrorOf::None }
    });
    report.table(&report::lines(extremes));
    report.table(&report::rows(numbers, "points", &columns, LINES));
    report.chart(&chart(&output::stem(&options.scene), solution, kind))?;
    report.write(path)
}
