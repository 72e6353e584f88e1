//! The report of a curve.

use std::error::Error;
use std::path::Path;

use serde_json::Value;
use stribeck::Status;

use super::axis::Axis;
use super::row::QUANTITIES;
use super::{Curve, chart};
use crate::output;
use crate::report::{ErrorOf, Number, Report, rows};

/// Most rows of the table.
const ROWS: usize = 40;

/// Writes the report of `curve`, whose JSON object is `numbers`.
pub(super) fn write(
    curve: &Curve<'_>,
    (numbers, is_whole): (&Value, bool),
    path: &Path,
) -> Result<(), Box<dyn Error>> {
    let (scene, columns) = (&curve.options.scene, curve.columns);
    let status = curve.contacts.iter().map(|(status, _)| *status).find(|status| *status != Status::Converged);
    let title = columns.over.title().trim_end_matches(" of");
    let mut report = Report::new(scene, title, status.unwrap_or(Status::Converged))?;
    if !is_whole {
        report.end_early("interrupted");
    }
    report.warn(curve.warnings.iter().cloned());
    let unit = match (columns.over, columns.line) {
        (Axis::Speed, _) => "m/s",
        (Axis::SlideRollRatio, _) => "",
        (Axis::Load, false) => "N",
        (Axis::Load, true) => "N/m",
        (Axis::Temperature, _) => "K",
    };
    let (name, _) = columns.over.label(columns.line).split_once(" (").unwrap_or(("slide-roll ratio", ""));
    let key = columns.over.column(columns.line);
    let mut table = vec![Number { name, key, unit, factor: 1.0, offset: 0.0, error: ErrorOf::None }];
    let ending = if columns.spread { "sd" } else { "error" };
    let errors = QUANTITIES.each_ref().map(|quantity| format!("{}_{ending}", quantity.column));
    for (quantity, error) in QUANTITIES.iter().zip(&errors) {
        let (name, unit) = quantity.label.split_once(" (").unwrap_or((quantity.label, ""));
        let (unit, factor) = (unit.trim_end_matches(')'), quantity.factor);
        table.push(Number {
            name,
            key: quantity.column,
            unit,
            factor,
            offset: 0.0,
            error: ErrorOf::Absolute(error),
        });
    }
    table.push(Number {
        name: "film by formula",
        key: "film_formula_m",
        unit: "nm",
        factor: 1e9,
        offset: 0.0,
        error: ErrorOf::None,
    });
    report.table(&rows(numbers, "curve", &table, ROWS));
    report.chart(&chart::chart(&output::stem(scene), curve))?;
    report.write(path)
}
