//! Places of the rows of a cycle: in the lists of the scene or in the lines of a file.

use std::path::PathBuf;

use crate::error::{InputError, escape};

/// Origin of the rows of a cycle.
#[derive(Debug, Clone)]
pub(in crate::sim) enum CycleSource {
    /// The lists of the scene.
    Lists,
    /// The lines of a file.
    File(CycleLines),
}

/// A table in a text file.
#[derive(Debug, Clone)]
pub(in crate::sim) struct CycleLines {
    pub(super) path: PathBuf,
    /// Key and heading of each column, `load` and `load (kN/m)`.
    pub(super) columns: Vec<(&'static str, String)>,
    /// Number of each line of values, counted from 1, and its cells.
    pub(super) lines: Vec<(usize, Vec<String>)>,
}

impl CycleSource {
    /// Error for the `value` of `key` in `row`, counted from 0, unless `holds`.
    ///
    /// # Errors
    /// Line, heading and value as written of a file, key and index of a list.
    pub(super) fn require(
        &self,
        holds: bool,
        (key, row): (&str, usize),
        value: f64,
        requirement: &'static str,
    ) -> Result<(), InputError> {
        if holds {
            return Ok(());
        }
        let written = match self {
            Self::Lists => None,
            Self::File(file) => file.written(key, row).map(|place| (file, place)),
        };
        match written {
            Some((file, place)) => Err(file.error(&format!("{place}: must be {requirement}"))),
            None => InputError::require(false, &format!("cycle.{key}[{row}]"), value, requirement),
        }
    }

    /// The error of a cycle without times and angles.
    pub(super) fn without_rows(&self) -> InputError {
        match self {
            Self::File(file) if file.columns.iter().any(|(key, _)| ["time", "angle"].contains(key)) => {
                file.error("has no rows below the line of names")
            }
            Self::File(file) => file.error("has neither a column time nor angle"),
            Self::Lists => InputError::Conflict {
                field: "cycle.time".to_owned(),
                reason: "is missing; give times or angles of the rows".to_owned(),
            },
        }
    }

    /// Error for a cycle with a single value of `key`.
    pub(super) fn require_rows(&self, key: &str, rows: usize) -> Result<(), InputError> {
        match self {
            _ if rows >= 2 => Ok(()),
            Self::File(file) => Err(file.error("has a single row; a cycle needs at least 2")),
            Self::Lists => {
                InputError::require(false, &format!("cycle.{key}"), rows as f64, "a list of at least 2")
            }
        }
    }

    /// The place of `row`, counted from 0: `row 3 of [cycle]` of lists, `flank.csv, line 4` of a file.
    pub(in crate::sim) fn row(&self, row: usize) -> String {
        let line = match self {
            Self::Lists => None,
            Self::File(file) => {
                file.lines.get(row).map(|(line, _)| format!("{}, line {line}", file.path.display()))
            }
        };
        line.unwrap_or_else(|| format!("row {} of [cycle]", row + 1))
    }
}

impl CycleLines {
    /// Line, heading and text of the value of `key` in `row`.
    fn written(&self, key: &str, row: usize) -> Option<String> {
        let column = self.columns.iter().position(|(known, _)| *known == key)?;
        let (line, cells) = self.lines.get(row)?;
        Some(format!(
            "line {line}, {} = {}",
            escape(&self.columns.get(column)?.1),
            escape(cells.get(column)?)
        ))
    }

    /// The error of the file for `reason`.
    pub(super) fn error(&self, reason: &str) -> InputError {
        let reason = format!("{}: {reason}", self.path.display());
        InputError::Conflict { field: "cycle.table".to_owned(), reason }
    }
}
