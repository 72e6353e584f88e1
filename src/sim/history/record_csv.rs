//! Records as lines of comma-separated values.

use std::io::{self, Write};

use crate::error::InputError;
use crate::sim::history::columns::{COLUMNS, Cell, Column};
use crate::sim::history::record::StepRecord;

impl StepRecord {
    /// Names of the columns of a history and their units, empty for ratios, counts and words.
    ///
    /// ```
    /// let mut columns = stribeck::sim::StepRecord::columns();
    /// assert!(columns.any(|column| column == ("film.mean_central", "m")));
    /// ```
    pub fn columns() -> impl Iterator<Item = (&'static str, &'static str)> {
        COLUMNS.iter().map(|column| (column.name, column.unit))
    }

    /// The first line of `history.csv`: names and units of the columns of [`StepRecord::write_csv`]. A name is the
    /// path of its field.
    pub fn csv_header() -> String {
        COLUMNS.iter().map(Column::heading).collect::<Vec<_>>().join(",")
    }

    /// Writes the record as one line of comma-separated values with all digits. Cells of physics not modelled are
    /// empty.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_csv(&self, out: &mut impl Write) -> io::Result<()> {
        for (index, column) in COLUMNS.iter().enumerate() {
            let comma = if index == 0 { "" } else { "," };
            match (column.get)(self) {
                Cell::Empty => write!(out, "{comma}")?,
                Cell::Number(number) => write!(out, "{comma}{number:e}")?,
                Cell::Count(count) => write!(out, "{comma}{count}")?,
                Cell::Word(word) => write!(out, "{comma}{word}")?,
            }
        }
        writeln!(out)
    }

    /// Reads the record from a `line` of [`write_csv`](Self::write_csv), exactly. A line does not hold the name of
    /// a custom solver, which becomes `other`, nor the strategy and the residual history of the solve.
    ///
    /// # Errors
    /// A missing or extra cell, or one whose text does not fit its column.
    pub fn from_csv(line: &str) -> Result<Self, InputError> {
        let mut record = Self::blank();
        let mut cells = line.trim_end().split(',');
        for column in &COLUMNS {
            let cell = cells.next().unwrap_or_default();
            if (column.set)(&mut record, cell).is_none() {
                return Err(unreadable(&column.heading(), cell));
            }
        }
        match cells.next() {
            Some(stray) => Err(unreadable("history", stray)),
            None => Ok(record),
        }
    }
}

/// The error for a cell whose text does not fit its column.
fn unreadable(column: &str, cell: &str) -> InputError {
    InputError::Conflict {
        field: column.to_owned(),
        reason: format!("`{cell}` is not a value of this column"),
    }
}
