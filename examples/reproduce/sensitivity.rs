//! What each open choice does when flipped alone: a table that is kept beside the page, because it takes longer than the page.

use std::fs;
use std::path::{Path, PathBuf};

use crate::choices::{Choice, NO_FLIP};
use crate::options::Options;
use crate::report::Results;
use crate::statements::{Pair, STATEMENTS};

/// Name of the kept table.
const FILE: &str = "open_choices.csv";

/// Columns of the table: with and without film where a name ends so.
const COLUMNS: [&str; 14] = [
    "name",
    "flip",
    "wear_ratio",
    "wear_without_m",
    "film_m",
    "lambda_with",
    "lambda_without",
    "area_ratio_with",
    "area_ratio_without",
    "load_ratio_with",
    "load_ratio_without",
    "steps_with",
    "steps_without",
    "turns",
];

/// Between the statements in one cell.
const SEPARATOR: &str = "; ";

/// One flip and its effects.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) flip: String,
    /// The columns after the flip, but for the last.
    pub(crate) numbers: Vec<f64>,
    /// Statements whose answer is another one than in the first row.
    pub(crate) turns: Vec<String>,
}

impl Row {
    /// Whether both histories are of one length.
    pub(crate) fn is_whole(&self) -> bool {
        matches!(self.numbers[..], [.., with, without] if with.to_bits() == without.to_bits())
    }
}

/// The table with the command that made it.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    pub(crate) command: String,
    /// The first row is the scene as it is.
    pub(crate) rows: Vec<Row>,
}

impl Table {
    /// The table of what was run now; none without flips.
    pub(crate) fn of(results: &Results, options: &Options) -> Option<Self> {
        let (_, base) = results.choices.iter().find(|(choice, _)| choice.name == NO_FLIP.name)?;
        let rows = results.choices.iter().map(|(choice, pair)| row(choice, pair, base)).collect();
        Some(Self { command: options.command(), rows })
    }

    /// Reads the kept table, if there is one.
    ///
    /// # Errors
    /// A table that does not fit.
    pub(crate) fn read(folder: &Path) -> Result<Option<Self>, String> {
        let file = folder.join(FILE);
        let Ok(text) = fs::read_to_string(&file) else { return Ok(None) };
        let broken = |what: &str| format!("{}: {what}", file.display());
        let (first, table) = text.split_once('\n').ok_or_else(|| broken("no table"))?;
        let command = first.strip_prefix("# ").ok_or_else(|| broken("no command in the first line"))?;
        let mut rows = Vec::new();
        for record in csv::Reader::from_reader(table.as_bytes()).records() {
            let record = record.map_err(|error| broken(&error.to_string()))?;
            let cells: Vec<&str> = record.iter().collect();
            let [name, flip, numbers @ .., turns] = cells.as_slice() else {
                return Err(broken("too few columns"));
            };
            let numbers: Result<Vec<f64>, _> = numbers.iter().map(|cell| cell.parse()).collect();
            rows.push(Row {
                name: (*name).to_owned(),
                flip: (*flip).to_owned(),
                numbers: numbers.map_err(|_| broken(&format!("a cell of `{name}` is no number")))?,
                turns: turns.split(SEPARATOR).filter(|turn| !turn.is_empty()).map(str::to_owned).collect(),
            });
        }
        Ok(Some(Self { command: command.to_owned(), rows }))
    }

    /// Writes the table; returns its place.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub(crate) fn write(&self, folder: &Path) -> Result<PathBuf, String> {
        let file = folder.join(FILE);
        let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", file.display());
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(COLUMNS).map_err(|error| failed(&error))?;
        for row in &self.rows {
            let mut cells = vec![row.name.clone(), row.flip.clone()];
            cells.extend(row.numbers.iter().map(|number| format!("{number:.4e}")));
            cells.push(row.turns.join(SEPARATOR));
            writer.write_record(&cells).map_err(|error| failed(&error))?;
        }
        let table = writer.into_inner().map_err(|error| failed(&error))?;
        let mut bytes = format!("# {}\n", self.command).into_bytes();
        bytes.extend(table);
        fs::write(&file, bytes).map_err(|error| failed(&error))?;
        Ok(file)
    }
}

fn row(choice: &Choice, pair: &Pair, base: &Pair) -> Row {
    let wear = [&pair.with, &pair.without].map(|history| history.last("track_wear_disc_m"));
    let mut numbers = vec![wear[0] / wear[1], wear[1], pair.with.last("track_film_disc_m")];
    for column in ["lambda", "area_ratio", "load_ratio"] {
        numbers.extend([pair.with.end(column), pair.without.end(column)]);
    }
    numbers.extend([pair.with.steps() as f64, pair.without.steps() as f64]);
    let turned = STATEMENTS.iter().filter(|statement| (statement.holds)(pair) != (statement.holds)(base));
    Row {
        name: choice.name.to_owned(),
        flip: choice.text.to_owned(),
        numbers,
        turns: turned.map(|statement| statement.text.to_owned()).collect(),
    }
}
