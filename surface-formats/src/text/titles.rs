//! Titles of columns.

use super::number::parse_height;
use super::pairs::split_unit;
use super::style::{Separator, Style, unquoted};
use crate::unit::LengthUnit;

/// Content of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Column {
    X,
    Y,
    Z,
    /// Running number of the row.
    Index,
    /// One for defined points, zero for others.
    Valid,
    Other,
}

/// Title of a column.
#[derive(Debug, Clone)]
pub(super) struct Title {
    pub(super) column: Column,
    pub(super) name: String,
    pub(super) unit: Option<LengthUnit>,
    /// Whether the unit is another one than of length.
    pub(super) is_foreign: bool,
}

/// Titles of a table.
#[derive(Debug, Clone)]
pub(super) struct Titles(pub(super) Vec<Title>);

impl Title {
    /// The title in a field.
    fn parse(field: &str) -> Self {
        let (mut name, unit) = split_unit(field);
        let mut unit = LengthUnit::parse(unit);
        if unit.is_none()
            && let Some((before, last)) = name.rsplit_once([' ', '/', '_', ','])
        {
            // "Lateral um", "X/mm", "z_nm"; one letter alone may be an axis
            let found = LengthUnit::parse(last).filter(|_| !before.trim().is_empty());
            if found.is_some() {
                (name, unit) = (before.trim_end_matches([' ', ',', '/', '_']), found);
            }
        }
        let is_foreign = unit.is_none() && name.ends_with([')', ']']);
        Self { column: column(name), name: name.to_owned(), unit, is_foreign }
    }
}

/// The content that the name of a column tells.
fn column(name: &str) -> Column {
    let name = name.to_lowercase().replace(['_', '-'], " ");
    let name = name.trim_matches(['"', ' ', '#', '.', ':']);
    match name {
        "x" | "distance" | "position" | "lateral" | "length" | "x position" | "x axis" | "x coordinate"
        | "lateral position" | "scan length" | "pos" | "pos x" | "x pos" | "abscissa" => Column::X,
        "y" | "y position" | "y axis" | "y coordinate" | "pos y" | "y pos" => Column::Y,
        "z" | "height" | "heights" | "z position" | "z axis" | "z coordinate" | "elevation" | "profile"
        | "total profile" | "raw" | "topography" | "height sensor" | "z height" | "value" => Column::Z,
        "" | "index" | "no" | "nr" | "n" | "point" | "row" | "id" | "i" | "number" | "line" | "data no"
        | "point no" => Column::Index,
        "valid" => Column::Valid,
        _ => Column::Other,
    }
}

/// Fields of a line of titles for `columns` columns in the separation of the rows or, where these are blanks,
/// with units in brackets joined to their names.
fn fields(line: &str, style: Style, columns: usize) -> Option<Vec<String>> {
    let line = line.trim().trim_start_matches(['#', '%', ';', '\\']);
    let line = if style.separator == Separator::Tab { line } else { line.trim() };
    for separator in [style.separator, Separator::Tab, Separator::Comma, Separator::Semicolon] {
        let found = separator.split(line.trim_end());
        if found.len() == columns && (columns > 1 || separator == style.separator) {
            return Some(found.into_iter().map(str::to_owned).collect());
        }
    }
    let mut joined: Vec<String> = Vec::new();
    for word in line.split_whitespace().map(unquoted) {
        match joined.last_mut() {
            Some(last) if word.starts_with(['(', '[']) => *last = format!("{last} {word}"),
            _ => joined.push(word.to_owned()),
        }
    }
    (joined.len() == columns && columns > 1).then_some(joined)
}

impl Titles {
    /// Titles in the last of `lines` before the rows, or in the last two, of which the second holds units, and
    /// how many lines these are.
    pub(super) fn read(lines: &[(usize, &str)], style: Style, columns: usize) -> Option<(Self, usize)> {
        let (_, last) = lines.last().filter(|(_, line)| !is_pair(line))?;
        let found = fields(last, style, columns)?;
        let units: Vec<Option<LengthUnit>> = found.iter().map(|field| unit_alone(field)).collect();
        // titles of which none is a length, and no pair of key and value
        if units.iter().any(Option::is_some)
            && found
                .iter()
                .all(|field| unit_alone(field).is_some() || is_bracketed(field) || field.is_empty())
        {
            let above = lines.split_last()?.1.last().and_then(|(_, line)| fields(line, style, columns));
            let above = above.filter(|above| are_words(above))?;
            let mut titles: Vec<Title> = above.iter().map(|field| Title::parse(field)).collect();
            for ((title, unit), field) in titles.iter_mut().zip(units).zip(&found) {
                title.unit = title.unit.or(unit);
                title.is_foreign |= title.unit.is_none() && !field.is_empty();
            }
            return Some((Self(titles), 2));
        }
        let titles: Vec<Title> = found.iter().map(|field| Title::parse(field)).collect();
        let knows_any = titles.iter().any(|title| matches!(title.column, Column::X | Column::Y | Column::Z));
        (are_words(&found) && knows_any).then_some((Self(titles), 1))
    }

    /// Place of the first column with this content.
    pub(super) fn place(&self, column: Column) -> Option<usize> {
        self.0.iter().position(|title| title.column == column)
    }

    /// Columns that may hold heights: those called so, else those of lengths or without unit that are nothing
    /// else.
    pub(super) fn heights(&self) -> Vec<usize> {
        let of = |column: Column| -> Vec<usize> {
            let fits = |title: &Title| title.column == column && !title.is_foreign;
            self.0.iter().enumerate().filter(|(_, title)| fits(title)).map(|(k, _)| k).collect()
        };
        [Column::Z, Column::Other, Column::Y]
            .map(of)
            .into_iter()
            .find(|found| !found.is_empty())
            .unwrap_or_default()
    }
}

/// Whether a line is a key of a header with its value.
fn is_pair(line: &str) -> bool {
    line.contains('=')
        || line
            .split_once(':')
            .is_some_and(|(key, value)| !value.is_empty() && !key.contains([',', ';', '\t']))
}

/// The unit of a field that holds nothing else.
fn unit_alone(field: &str) -> Option<LengthUnit> {
    LengthUnit::parse(field.trim().trim_matches(['(', ')', '[', ']']))
}

/// Whether a field stands in brackets.
fn is_bracketed(field: &str) -> bool {
    field.starts_with(['(', '[']) && field.ends_with([')', ']'])
}

/// Whether no field is a number.
fn are_words(fields: &[String]) -> bool {
    fields.iter().all(|field| field.is_empty() || parse_height(field).is_none_or(f64::is_nan))
        && fields.iter().any(|field| !field.is_empty())
}
