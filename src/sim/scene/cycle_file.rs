//! A cycle from a table in a text file: a line of names with units, then the rows.

use std::path::Path;

use crate::error::{InputError, escape};
use crate::sim::scene::CycleSpec;
use crate::sim::scene::cycle_source::{CycleLines, CycleSource};
use crate::text_file;
use crate::text_table;
use crate::units::Dimension;

impl CycleSpec {
    /// The spec with the columns of the file at `path`, and its lines.
    pub(super) fn read(&self, path: &Path, is_line: bool) -> Result<(Self, CycleSource), InputError> {
        let mut file = CycleLines { path: path.to_owned(), columns: Vec::new(), lines: Vec::new() };
        let given = [&self.time, &self.angle, &self.load, &self.ball_speed, &self.disc_speed, &self.radius];
        if given.iter().any(|column| !column.is_empty()) || !self.bulk_temperature.is_empty() {
            return Err(file.error("the table replaces the lists; give one of the two"));
        }
        let text = text_file::read(path).map_err(|error| file.error(&error.to_string()))?;
        let mut rows = text_table::rows(&text);
        let Some(names) = rows.next() else { return Err(file.error("is empty")) };
        let headings = headings(&names.cells, is_line)
            .map_err(|reason| file.error(&format!("line {}: {reason}", names.line)))?;
        file.columns = headings.iter().map(|heading| (heading.key, heading.text.to_owned())).collect();
        let mut spec = Self { table: None, ..self.clone() };
        for text_table::Row { line, text, cells } in rows {
            if cells.len() != headings.len() {
                let names: Vec<_> = headings.iter().map(|heading| heading.text).collect();
                return Err(file.error(&format!(
                    "line {line} has {} values, expected {} ({}): `{}`",
                    cells.len(),
                    names.len(),
                    names.join(", "),
                    escape(text)
                )));
            }
            for (heading, cell) in headings.iter().zip(&cells) {
                let value =
                    heading.value(cell).map_err(|reason| file.error(&format!("line {line}, {reason}")))?;
                spec.column(heading.name).push(value);
            }
            file.lines.push((line, cells.into_iter().map(str::to_owned).collect()));
        }
        Ok((spec, CycleSource::File(file)))
    }

    /// The list of the column `name`.
    fn column(&mut self, name: Column) -> &mut Vec<f64> {
        match name {
            Column::Time => &mut self.time,
            Column::Angle => &mut self.angle,
            Column::Load => &mut self.load,
            Column::BallSpeed => &mut self.ball_speed,
            Column::DiscSpeed => &mut self.disc_speed,
            Column::Radius => &mut self.radius,
            Column::BulkTemperature => &mut self.bulk_temperature,
        }
    }
}

/// A column of a table.
#[derive(Debug, Clone, Copy)]
enum Column {
    Time,
    Angle,
    Load,
    BallSpeed,
    DiscSpeed,
    Radius,
    BulkTemperature,
}

/// Names of the columns.
const COLUMNS: [(&str, Column, Dimension); 7] = [
    ("time", Column::Time, Dimension::Time),
    ("angle", Column::Angle, Dimension::Angle),
    ("load", Column::Load, Dimension::Force),
    ("ball_speed", Column::BallSpeed, Dimension::Speed),
    ("disc_speed", Column::DiscSpeed, Dimension::Speed),
    ("radius", Column::Radius, Dimension::Length),
    ("bulk_temperature", Column::BulkTemperature, Dimension::Temperature),
];

/// The columns of the line of `names`.
fn headings<'a>(names: &[&'a str], is_line: bool) -> Result<Vec<Heading<'a>>, String> {
    let headings = names.iter().map(|name| Heading::of(name, is_line)).collect::<Result<Vec<_>, _>>()?;
    let is_repeated =
        |(index, heading): &(usize, &Heading<'_>)| headings[..*index].iter().any(|h| h.key == heading.key);
    match headings.iter().enumerate().find(is_repeated) {
        Some((_, heading)) => Err(format!("column {} is there twice", heading.key)),
        None => Ok(headings),
    }
}

/// Name and unit of a column.
struct Heading<'a> {
    /// As written.
    text: &'a str,
    key: &'static str,
    name: Column,
    dimension: Dimension,
    /// Empty for SI units.
    unit: &'a str,
}

impl<'a> Heading<'a> {
    /// That of the cell `text`, `angle (deg)` or `angle`.
    fn of(text: &'a str, is_line: bool) -> Result<Self, String> {
        let (name, unit) =
            text.split_once('(').map_or((text, ""), |(name, unit)| (name, unit.trim_end_matches(')')));
        let known = COLUMNS.iter().find(|(key, ..)| *key == name.trim());
        let Some((key, name, dimension)) = known else {
            let names: Vec<_> = COLUMNS.iter().map(|(key, ..)| *key).collect();
            return Err(format!(
                "unknown column `{}`; the first line has the names of the columns, with units in parentheses as in `angle (deg)`, of {}",
                escape(text),
                names.join(", ")
            ));
        };
        let dimension =
            if is_line && *dimension == Dimension::Force { Dimension::ForcePerLength } else { *dimension };
        Ok(Self { text, key, name: *name, dimension, unit: unit.trim() })
    }

    /// The value of `cell` in SI units.
    fn value(&self, cell: &str) -> Result<f64, String> {
        let text = escape(self.text);
        if cell.is_empty() {
            return Err(format!("column {text} is empty; give each row a value"));
        }
        if self.unit.is_empty() {
            return cell.parse().map_err(|_| not_a_number(&text, cell));
        }
        if cell.contains(',') {
            return Err(not_a_number(&text, cell));
        }
        let parsed = self.dimension.parse(&text, &format!("{cell} {}", self.unit));
        parsed.map_err(|error| error.to_string())
    }
}

/// The message for the `cell` of the column `name` that is not a number.
fn not_a_number(name: &str, cell: &str) -> String {
    let remedy = if cell.contains(',') { "; numbers have a decimal point" } else { "" };
    format!("column {name}: `{}` is not a number{remedy}", escape(cell))
}
