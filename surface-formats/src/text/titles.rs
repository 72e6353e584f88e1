//! Titles of columns.

use super::blocks::is_comment;
use super::keys::meaning;
use super::number::parse_height;
use super::pairs::{plain_key, quantity, split_unit};
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
    /// A roughness parameter.
    Parameter,
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
            // "Lateral um", "X/mm", "z_nm", "x in um"; "Sensor A" names no unit, "Raw A" does
            let is_word = matches!(last, "A" | "in") && column(before) == Column::Other;
            let found = LengthUnit::parse(last).filter(|_| !before.trim().is_empty() && !is_word);
            if found.is_some() {
                (name, unit) = (before.trim_end_matches([' ', ',', '/', '_']), found);
                name = name.strip_suffix(" in").unwrap_or(name);
            }
        }
        let is_foreign = unit.is_none() && name.ends_with([')', ']']);
        Self { column: column(name), name: name.to_owned(), unit, is_foreign }
    }
}

/// The content that the name of a column tells; numbers at its end count columns of one kind.
pub(super) fn column(name: &str) -> Column {
    let name = name.to_lowercase().replace(['_', '-'], " ");
    let name = name.trim_matches(['"', ' ', '#', '.', ':']);
    let name = Some(name.trim_end_matches(|letter: char| letter.is_ascii_digit() || letter == ' '))
        .filter(|stem| !stem.is_empty())
        .unwrap_or(name);
    match name {
        "x" | "distance" | "position" | "lateral" | "length" | "x position" | "x axis" | "x coordinate"
        | "lateral position" | "scan length" | "pos" | "pos x" | "x pos" | "abscissa" => Column::X,
        "y" | "y position" | "y axis" | "y coordinate" | "pos y" | "y pos" => Column::Y,
        "z" | "height" | "heights" | "z position" | "z axis" | "z coordinate" | "elevation" | "altitude"
        | "profile" | "total profile" | "raw" | "topography" | "height sensor" | "z height" | "value" => {
            Column::Z
        }
        "" | "index" | "no" | "nr" | "n" | "point" | "row" | "id" | "i" | "number" | "line" | "data no"
        | "point no" | "row number" | "counter" => Column::Index,
        "valid" => Column::Valid,
        "sa" | "sq" | "sz" | "sp" | "sv" | "ssk" | "sku" | "ra" | "rq" | "rz" | "rt" | "rp" | "rv"
        | "rsk" | "rku" | "rms" => Column::Parameter,
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
    if matches!(style.separator, Separator::Comma | Separator::Semicolon) && line.contains([',', ';']) {
        return None;
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
            let above = lines.split_last()?.1.last().filter(|(_, line)| !is_pair(line));
            let above = above.and_then(|(_, line)| fields(line, style, columns));
            let above = above.filter(|above| are_words(above));
            let count = 1 + usize::from(above.is_some());
            // units alone stand for titles, too
            let above = above.or_else(|| units.iter().all(Option::is_some).then(|| found.clone()))?;
            let mut titles: Vec<Title> = above.iter().map(|field| Title::parse(field)).collect();
            for ((title, unit), field) in titles.iter_mut().zip(units).zip(&found) {
                title.unit = title.unit.or(unit);
                title.is_foreign |= title.unit.is_none() && !field.is_empty();
            }
            return Some((Self(titles), count));
        }
        let titles: Vec<Title> = found.iter().map(|field| Title::parse(field)).collect();
        (are_words(&found) && (are_understood(&titles) || are_titles(last, &found, style)))
            .then_some((Self(titles), 1))
    }

    /// The names in quotes, for messages.
    pub(super) fn names(&self) -> String {
        quoted(self.0.iter().map(|title| title.name.as_str()))
    }
}

/// Names in quotes with commas between them.
pub(super) fn quoted<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ")
}

/// Whether any title names a position, a height or a unit of length; a single one must be a height.
fn are_understood(titles: &[Title]) -> bool {
    let is_understood = |title: &Title| {
        matches!(title.column, Column::X | Column::Y | Column::Z | Column::Parameter) || title.unit.is_some()
    };
    match titles {
        [only] => matches!(only.column, Column::X | Column::Y | Column::Z),
        several => several.iter().any(is_understood),
    }
}

/// Whether words that are not understood are titles of columns all the same: a word above each of several columns,
/// neither a key of a header nor a sentence.
fn are_titles(line: &str, fields: &[String], style: Style) -> bool {
    let is_key = fields.first().is_some_and(|field| meaning(&plain_key(field)).is_some());
    let is_sentence = style.separator == Separator::Blanks && is_comment(line);
    let named = fields.iter().skip(1).all(|field| !field.is_empty());
    fields.len() > 1 && named && !is_key && !is_sentence
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

/// Whether no field is a number or begins with one.
fn are_words(fields: &[String]) -> bool {
    fields.iter().all(|field| parse_height(field).is_none_or(f64::is_nan) && quantity(field).is_none())
        && fields.iter().any(|field| !field.is_empty())
}
