//! Rows as CSV.

use std::fs;
use std::path::Path;

use super::row::Row;
use crate::sim::SimError;
use crate::text_file;

/// Columns of a table.
const COLUMNS: [&str; 27] = [
    "case",
    "tags",
    "parameters",
    "contestant",
    "tolerance",
    "cells",
    "scene",
    "verdict",
    "ran",
    "strategy",
    "mass_residual",
    "load_residual",
    "complementarity_residual",
    "iterations",
    "convolutions",
    "all_convolutions",
    "displacements",
    "seconds",
    "minimum_gap_m",
    "central_film_m",
    "minimum_film_m",
    "mean_film_m",
    "area_ratio",
    "load_ratio",
    "friction",
    "error",
    "reason",
];

/// Rows with their head.
pub(super) fn text<'a>(rows: impl IntoIterator<Item = &'a Row>) -> String {
    let mut text = line(COLUMNS);
    rows.into_iter().for_each(|row| text.push_str(&of_row(row)));
    text
}

/// The line of a row.
pub(super) fn of_row(row: &Row) -> String {
    let number = |value: f64| if value.is_nan() { String::new() } else { format!("{value:e}") };
    let parameters: Vec<String> =
        row.parameters.iter().map(|(name, value)| format!("{name}={value:e}")).collect();
    let mut fields = vec![
        row.case.clone(),
        row.tags.join(";"),
        parameters.join(";"),
        row.contestant.clone(),
        number(row.tolerance),
        row.cells.to_string(),
        row.scene.clone(),
        row.verdict.to_string(),
        row.ran.clone(),
        row.strategy.clone(),
    ];
    fields.extend(row.residuals.map(number));
    fields.push(row.iterations.to_string());
    fields.extend(
        [row.convolutions, row.all_convolutions, row.displacements, row.seconds, row.minimum_gap].map(number),
    );
    fields.extend(row.values.map(number));
    fields.extend([number(row.error), row.reason.clone()]);
    line(fields)
}

fn line<T: AsRef<str>>(fields: impl IntoIterator<Item = T>) -> String {
    let quoted = fields.into_iter().map(|field| {
        // One row is one line, so that a line that was cut off is recognized.
        let field = field.as_ref().split_whitespace().collect::<Vec<_>>().join(" ");
        let is_plain = !field.contains([',', '"']);
        if is_plain { field } else { format!("\"{}\"", field.replace('"', "\"\"")) }
    });
    quoted.collect::<Vec<_>>().join(",") + "\n"
}

/// The rows of a text. A last line without an end, of a run that was stopped while it wrote, is left out.
///
/// # Errors
/// The number of the first line that is no row, with the reason.
pub(super) fn parse(text: &str) -> Result<Vec<Row>, String> {
    let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(whole.as_bytes());
    let mut rows = Vec::new();
    for (k, record) in reader.records().enumerate() {
        let record = record.map_err(|error| error.to_string())?;
        if k == 0 {
            if !record.iter().eq(COLUMNS) {
                return Err("line 1: not the head of a table of a benchmark".to_owned());
            }
            continue;
        }
        rows.push(row(&record).map_err(|column| format!("line {}: cannot read {column}", k + 1))?);
    }
    Ok(rows)
}

/// The row of a record, or the first column that cannot be read.
fn row(record: &csv::StringRecord) -> Result<Row, String> {
    if record.len() != COLUMNS.len() {
        return Err(format!("{} columns, expected {}", record.len(), COLUMNS.len()));
    }
    let field = |k: usize| record.get(k).unwrap_or_default().to_owned();
    let unread = |k: usize| format!("{} = `{}`", COLUMNS[k], field(k));
    let number = |k: usize| match field(k) {
        empty if empty.is_empty() => Ok(f64::NAN),
        text => text.parse::<f64>().map_err(|_| unread(k)),
    };
    let list = |k: usize| -> Vec<String> {
        field(k).split(';').filter(|part| !part.is_empty()).map(str::to_owned).collect()
    };
    let parameter = |text: &String| {
        let (name, value) = text.split_once('=')?;
        Some((name.to_owned(), value.parse().ok()?))
    };
    Ok(Row {
        case: field(0),
        tags: list(1),
        parameters: list(2).iter().map(parameter).collect::<Option<_>>().ok_or_else(|| unread(2))?,
        contestant: field(3),
        tolerance: number(4)?,
        cells: field(5).parse().map_err(|_| unread(5))?,
        scene: field(6),
        verdict: field(7).parse().map_err(|_| unread(7))?,
        ran: field(8),
        strategy: field(9),
        residuals: [number(10)?, number(11)?, number(12)?],
        iterations: field(13).parse().map_err(|_| unread(13))?,
        convolutions: number(14)?,
        all_convolutions: number(15)?,
        displacements: number(16)?,
        seconds: number(17)?,
        minimum_gap: number(18)?,
        values: [number(19)?, number(20)?, number(21)?, number(22)?, number(23)?, number(24)?],
        error: number(25)?,
        reason: field(26),
    })
}

/// The rows of the file at `path`.
pub(super) fn read(path: &Path) -> Result<Vec<Row>, SimError> {
    let text = text_file::read(path).map_err(|source| SimError::Io { path: path.to_owned(), source })?;
    parse(&text).map_err(|reason| SimError::Scene { reason: format!("{}: {reason}", path.display()) })
}

/// Writes `rows` to `path`, in place of what is there.
pub(super) fn write(path: &Path, rows: &[Row]) -> Result<(), SimError> {
    let failed = |source| SimError::Io { path: path.to_owned(), source };
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(failed)?;
    }
    fs::write(path, text(rows)).map_err(failed)
}
