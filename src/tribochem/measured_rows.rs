//! Rows of measured numbers.

use std::io::Read;
use std::path::Path;

use super::fit_error::FitError;
use crate::text_file;

/// Reads comma-separated text; lines that start with `#` are skipped. `take` gets the index of each row and its
/// numbers, `None` for a field that is not one, and returns whether the row is `expected`.
///
/// # Errors
/// [`FitError::Csv`] with the line of a row that cannot be read or is not as expected.
pub(super) fn read_rows(
    reader: impl Read,
    expected: &str,
    mut take: impl FnMut(usize, &[Option<f64>]) -> bool,
) -> Result<(), FitError> {
    let mut table = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(reader);
    for (row, record) in table.records().enumerate() {
        let record = record.map_err(|error| FitError::Csv {
            line: error.position().map_or(0, csv::Position::line),
            reason: error.to_string(),
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        let numbers: Vec<Option<f64>> = record.iter().map(|field| field.parse().ok()).collect();
        if !take(row, &numbers) {
            let fields: Vec<&str> = record.iter().collect();
            let reason = format!("`{}` is not {expected}", fields.join(","));
            return Err(FitError::Csv { line, reason });
        }
    }
    Ok(())
}

/// Text of a file of at most 16 MB.
///
/// # Errors
/// [`FitError::Io`] if the file cannot be read or is larger.
pub(super) fn read_text(path: &Path) -> Result<String, FitError> {
    text_file::read(path).map_err(|source| FitError::Io { path: path.to_owned(), source })
}
