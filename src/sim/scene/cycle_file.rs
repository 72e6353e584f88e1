//! A cycle from a file of comma-separated values: a line of names with units, then the rows.

use std::path::Path;

use crate::error::{InputError, escape};
use crate::sim::scene::CycleSpec;
use crate::text_file;
use crate::units::Dimension;

impl CycleSpec {
    /// The spec with the columns of the file at `path`.
    pub(super) fn read(&self, path: &Path, is_line: bool) -> Result<Self, InputError> {
        let refused = |reason: String| InputError::Conflict {
            field: "cycle.table".to_owned(),
            reason: format!("{}: {reason}", path.display()),
        };
        let given = [&self.time, &self.angle, &self.load, &self.ball_speed, &self.disc_speed, &self.radius];
        if given.iter().any(|column| !column.is_empty()) || !self.bulk_temperature.is_empty() {
            return Err(refused("the table replaces the lists; give one of the two".to_owned()));
        }
        let text = text_file::read(path).map_err(|error| refused(error.to_string()))?;
        let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
        let mut lines = lines.filter(|(_, line)| !line.trim().is_empty() && !line.trim().starts_with('#'));
        let Some((_, names)) = lines.next() else { return Err(refused("is empty".to_owned())) };
        let headings = names.split(',').map(|name| Heading::of(name, is_line).map_err(&refused));
        let headings = headings.collect::<Result<Vec<_>, _>>()?;
        let mut spec = Self { table: None, ..self.clone() };
        for (number, line) in lines {
            let cells: Vec<&str> = line.split(',').map(str::trim).collect();
            let line = number + 1;
            if cells.len() != headings.len() {
                let (found, expected) = (cells.len(), headings.len());
                return Err(refused(format!(
                    "line {line} has {found} values, the line of names has {expected}"
                )));
            }
            for (heading, cell) in headings.iter().zip(cells) {
                let value =
                    heading.value(cell).map_err(|reason| refused(format!("line {line}, {reason}")))?;
                spec.column(heading.name).push(value);
            }
        }
        Ok(spec)
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

/// Name and unit of a column.
struct Heading<'a> {
    key: &'static str,
    name: Column,
    dimension: Dimension,
    /// Empty for SI units.
    unit: &'a str,
}

impl<'a> Heading<'a> {
    /// That of the cell `text`, `angle (deg)` or `angle`.
    fn of(text: &'a str, is_line: bool) -> Result<Self, String> {
        let text = text.trim().trim_matches('"');
        let (name, unit) =
            text.split_once('(').map_or((text, ""), |(name, unit)| (name, unit.trim_end_matches(')')));
        let known = COLUMNS.iter().find(|(key, ..)| *key == name.trim());
        let Some((key, name, dimension)) = known else {
            let names: Vec<_> = COLUMNS.iter().map(|(key, ..)| *key).collect();
            return Err(format!("unknown column `{}`, the columns are {}", escape(text), names.join(", ")));
        };
        let dimension =
            if is_line && *dimension == Dimension::Force { Dimension::ForcePerLength } else { *dimension };
        Ok(Self { key, name: *name, dimension, unit: unit.trim() })
    }

    /// The value of `cell` in SI units.
    fn value(&self, cell: &str) -> Result<f64, String> {
        let key = self.key;
        if cell.is_empty() {
            return Err(format!("column {key} is empty"));
        }
        if self.unit.is_empty() {
            return cell.parse().map_err(|_| format!("column {key}: `{}` is not a number", escape(cell)));
        }
        self.dimension.parse(key, &format!("{cell} {}", self.unit)).map_err(|error| error.to_string())
    }
}
