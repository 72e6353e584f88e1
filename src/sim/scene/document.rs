//! Tables of scene files: TOML text to numbers in SI units to the types of a scene.
//!
//! The text is parsed once. Text with a unit becomes a number in SI units, then serde reads the tables. Errors of all
//! stages have one line with the number of the line, the key and the terms of scene files.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::de::{DeTable, Deserializer};
use toml::{Spanned, Table, Value};

use super::{journal_speed, keys, plain_words};
use crate::error::escape;
use crate::sim::error::SimError;
use crate::units::toml_line;

/// Most characters of a line quoted in a syntax error.
const LONGEST_QUOTE: usize = 80;
/// Laws of tables without the key `law`.
const DEFAULT_LAWS: [(&str, &str); 2] =
    [("tribofilm", super::tribofilm::DEFAULT_LAW), ("wear", super::wear::DEFAULT_LAW)];

/// A parsed scene file.
pub(in crate::sim) struct Document<'a> {
    text: &'a str,
    /// The tables with the places of their keys in `text`.
    places: Spanned<DeTable<'a>>,
    /// The tables in SI units.
    tables: Table,
    /// Diameter \[m\] on which the speed of a journal is a rate of rotation, where the file states it.
    pub(in crate::sim) speed_diameter: Option<f64>,
}

impl<'a> Document<'a> {
    /// Parses `text` and converts its quantities to SI units.
    ///
    /// # Errors
    /// A syntax error; text that is not a quantity of its key, a list in place of a table, a date.
    pub(in crate::sim) fn parse(text: &'a str) -> Result<Self, SimError> {
        let places = DeTable::parse(text).map_err(|error| syntax_error(text, &error))?;
        let tables = Table::deserialize(Deserializer::from(places.clone())).map_err(|error| {
            let line = line_of(text, error.span().map_or(0, |span| span.start));
            SimError::Scene { reason: format!("line {line}: {}", message(error)) }
        })?;
        let mut document = Self { text, places, tables, speed_diameter: None };
        document.speed_diameter = journal_speed::complete(&mut document.tables)?;
        keys::convert(&mut document.tables)?;
        for (table, law) in DEFAULT_LAWS {
            if let Some(Value::Table(table)) = document.tables.get_mut(table) {
                table.entry("law").or_insert_with(|| law.into());
            }
        }
        Ok(document)
    }

    /// The value at a path of names separated by dots.
    pub(in crate::sim) fn value(&self, path: &str) -> Option<&Value> {
        value_at(&self.tables, path)
    }

    /// Error that names the keys which `missing` finds absent, if they are several.
    ///
    /// # Errors
    /// More than one missing key.
    pub(in crate::sim) fn require_keys(
        &self,
        missing: impl Fn(&Table) -> Vec<String>,
    ) -> Result<(), SimError> {
        match missing(&self.tables) {
            absent if absent.len() > 1 => Err(SimError::Scene { reason: all_missing(&absent) }),
            _ => Ok(()),
        }
    }

    /// Reads the tables. `missing` lists all missing keys of the tables.
    ///
    /// # Errors
    /// An unknown or a missing key, a value that does not fit.
    pub(in crate::sim) fn read<T: DeserializeOwned>(
        &self,
        missing: impl Fn(&Table) -> Vec<String>,
    ) -> Result<T, SimError> {
        self.tables
            .clone()
            .try_into()
            .map_err(|error| SimError::Scene { reason: self.described::<T>(error, missing(&self.tables)) })
    }

    /// The error with its line and key, or all missing keys if it is one of several.
    fn described<T: DeserializeOwned>(&self, error: toml::de::Error, absent: Vec<String>) -> String {
        let (cause, mut path) = (error.message().to_owned(), path_of(&error));
        let is_missing = cause.starts_with("missing field");
        if is_missing && absent.len() > 1 {
            return all_missing(&absent);
        }
        let mut place = path.clone();
        let mut tag = String::new();
        if let Some(key) = cause.strip_prefix("unknown field `").and_then(|rest| rest.split('`').next()) {
            place = joined(&path, key);
            tag = self.tag(&path);
        } else if !is_missing {
            self.extend_to_cause::<T>(&cause, &mut path);
            place.clone_from(&path);
        }
        let within = if path.is_empty() { String::new() } else { format!(" in `{path}`") };
        let message = plain_words::of(&escape(&format!("{cause}{within}{tag}")));
        plain_words::with_remedy(format!("line {}: {message}", self.line(&place)))
    }

    /// Extends `path` from a table to the value that causes the error `cause`: the key without which the error is
    /// another one. Serde reads a table with `kind` or `law` as a whole, and its errors name the table only.
    fn extend_to_cause<T: DeserializeOwned>(&self, cause: &str, path: &mut String) {
        while let Some(Value::Table(table)) = self.value(path) {
            // Without the tag every error is another one: it is the cause if no other key is.
            let (tags, others): (Vec<_>, Vec<_>) = table.keys().partition(|key| TAGS.contains(&key.as_str()));
            let causes = |key: &&String| {
                let mut without = self.tables.clone();
                table_at(&mut without, path).and_then(|table| table.remove(key.as_str()));
                without.try_into::<T>().err().is_none_or(|error| error.message() != cause)
            };
            let Some(key) = others.into_iter().chain(tags).find(causes) else { return };
            *path = joined(path, key);
        }
    }

    /// Kind or law of the table at `path`, for messages.
    fn tag(&self, path: &str) -> String {
        let tag = TAGS.iter().find_map(|tag| Some((tag, self.value(&joined(path, tag))?)));
        tag.map_or_else(String::new, |(tag, value)| format!(", {tag} = {value}"))
    }

    /// Number of the line of the key at `path`, or of the innermost table of the file that holds it.
    fn line(&self, path: &str) -> usize {
        let mut table = Some(self.places.get_ref());
        let mut start = 0;
        for name in path.split('.') {
            let Some((key, value)) = table.and_then(|table| table.get_key_value(name)) else { break };
            // The place of the key of a table can be that of another table below it.
            start = if value.get_ref().is_table() { value.span().start } else { key.span().start };
            table = value.get_ref().as_table();
        }
        line_of(self.text, start)
    }
}

/// The message about several missing keys.
fn all_missing(absent: &[String]) -> String {
    plain_words::with_remedy(format!("missing keys: `{}`", absent.join("`, `")))
}

/// Keys that select the other keys of a table.
const TAGS: [&str; 2] = ["kind", "law"];

/// The value at a path of names separated by dots.
fn value_at<'a>(tables: &'a Table, path: &str) -> Option<&'a Value> {
    let mut names = path.split('.');
    let first = tables.get(names.next()?)?;
    names.try_fold(first, |value, name| value.get(name))
}

/// The table at a path of names separated by dots.
fn table_at<'a>(tables: &'a mut Table, path: &str) -> Option<&'a mut Table> {
    path.split('.').try_fold(tables, |table, name| table.get_mut(name)?.as_table_mut())
}

/// The path of `key` in the table at `path`.
fn joined(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

/// The path of the value that an error is about; empty if it is the document.
fn path_of(error: &toml::de::Error) -> String {
    let shown = error.to_string();
    let path = shown.trim_end().rsplit_once("\nin `").and_then(|(_, path)| path.strip_suffix('`'));
    path.unwrap_or_default().to_owned()
}

/// The message of the parser with the key in one line.
fn message(mut error: toml::de::Error) -> String {
    // With the source text the parser would draw the location instead of naming the key.
    error.set_input(None);
    plain_words::of(&escape(&error.to_string()))
}

/// The error of a text that is not TOML.
fn syntax_error(text: &str, error: &toml::de::Error) -> SimError {
    let number = line_of(text, error.span().map_or(0, |span| span.start));
    let line = text.lines().nth(number - 1).unwrap_or_default().trim();
    let shown: String = line.chars().filter(|c| !c.is_control()).take(LONGEST_QUOTE).collect();
    let hint = toml_line(line).map_or_else(String::new, |hint| format!("; {hint}"));
    let message = message(error.clone());
    SimError::Scene { reason: format!("line {number}: {message} in `{shown}`{hint}") }
}

/// Number of the line at byte `start`, counted from 1.
fn line_of(text: &str, start: usize) -> usize {
    1 + text.as_bytes().iter().take(start).filter(|byte| **byte == b'\n').count()
}
