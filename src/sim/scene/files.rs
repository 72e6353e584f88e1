//! Scenes as TOML text and files.
//!
//! Reading has three stages: syntax (`toml`), units (`keys`), tables (`serde`). Errors of all stages have one line
//! with line number, key and the terms of scene files.

use std::path::Path;

use serde::de::DeserializeOwned;
use toml::de::DeTable;

use super::{Scene, keys, missing};
use crate::error::escape;
use crate::sim::error::SimError;
use crate::text_file;
use crate::units::toml_line;

/// Most characters of a line quoted in a syntax error.
const LONGEST_QUOTE: usize = 80;

impl Scene {
    /// Reads a scene from TOML text. The value of a key with a dimension may be text with a
    /// [unit](crate::units): `"9.525 mm"`.
    ///
    /// # Errors
    /// [`SimError::Scene`] with key and line for a value that does not fit, [`SimError::Input`] for a quantity
    /// of another dimension than its key.
    pub fn from_toml(text: &str) -> Result<Self, SimError> {
        read_tables(text, missing::keys)
    }

    /// The scene as TOML text.
    ///
    /// # Errors
    /// [`SimError::Scene`] when a path is not UTF-8.
    pub fn to_toml(&self) -> Result<String, SimError> {
        toml::to_string(self).map_err(|e| SimError::Scene { reason: e.to_string() })
    }

    /// Reads a scene file. Paths of other files in it are relative to its folder.
    ///
    /// # Errors
    /// [`SimError::Io`] if the file cannot be read or exceeds 16 MB, [`SimError::Scene`] if it is not valid.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, SimError> {
        let path = path.as_ref();
        let text = text_file::read(path).map_err(|source| SimError::Io { path: path.to_owned(), source })?;
        let mut scene = Self::from_toml(&text)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        scene.roughness.locate_files(folder);
        scene.schedule.locate_tables(folder);
        if let Some(table) = scene.cycle.as_mut().and_then(|cycle| cycle.table.as_mut()) {
            *table = folder.join(&table);
        }
        Ok(scene)
    }
}

/// Reads tables from TOML text in three stages. `missing` lists all missing keys of the tables.
pub(in crate::sim) fn read_tables<T: DeserializeOwned>(
    text: &str,
    missing: impl Fn(&toml::Table) -> Vec<String>,
) -> Result<T, SimError> {
    let scene = |reason| SimError::Scene { reason };
    let root = DeTable::parse(text).map_err(|error| {
        let line = text.lines().nth(line_of(text, &error)).unwrap_or_default().trim();
        let shown: String = line.chars().filter(|c| !c.is_control()).take(LONGEST_QUOTE).collect();
        let hint = toml_line(line).map_or_else(String::new, |hint| format!("; {hint}"));
        scene(format!("{} in `{shown}`{hint}", in_one_line(text, error)))
    })?;
    let text = keys::in_si_units(text, root.get_ref())?;
    let tree = toml::Deserializer::parse(&text).map_err(|error| scene(in_one_line(&text, error)))?;
    T::deserialize(tree).map_err(|error| {
        let message = in_one_line(&text, error);
        let absent = match text.parse() {
            Ok(table) if message.contains("missing key") => missing(&table),
            _ => Vec::new(),
        };
        let chosen = if absent.iter().any(|key| key == "grid") { CHOSEN_GRID } else { "" };
        let message =
            if absent.len() > 1 { format!("missing keys: `{}`", absent.join("`, `")) } else { message };
        scene(message + chosen)
    })
}

/// Remedy for a scene without `[grid]`.
const CHOSEN_GRID: &str = "; accuracy = \"2 %\" in [grid] chooses box and cells";

/// Terms of the parser and their replacements for readers of scene files.
const WORDS: [(&str, &str); 24] = [
    ("expected f64", "expected a number"),
    ("expected usize", "expected a whole number from 0"),
    ("expected u64", "expected a whole number from 0"),
    ("expected a boolean", "expected true or false"),
    ("expected a sequence", "expected a list"),
    ("expected path string", "expected text"),
    ("expected a string", "expected text"),
    ("wanted string or table", "expected text"),
    ("invalid type: sequence", "a list"),
    ("invalid type: boolean ", ""),
    ("invalid type: string", "text"),
    ("invalid type: map", "a table"),
    ("expected an array of length 2", "expected a list of two numbers"),
    ("floating point", "number"),
    ("invalid type: integer", "whole number"),
    ("invalid value: integer", "whole number"),
    ("invalid type: ", ""),
    ("invalid value: ", ""),
    ("invalid length ", "length "),
    ("number too large to fit in target type", "the number is too large"),
    ("invalid digit found in string", "not a whole number"),
    ("unknown variant", "unknown value"),
    ("unknown field", "unknown key"),
    ("missing field", "missing key"),
];

/// The message in the terms of scene files, without type names of this crate.
fn in_plain_words(message: &str) -> String {
    let plain = WORDS.iter().fold(message.to_owned(), |text, (from, to)| text.replace(from, to));
    match plain.split_once("expected struct ") {
        None => plain,
        Some((before, after)) => {
            let rest = after.split_once(' ').map_or(String::new(), |(_, rest)| format!(" {rest}"));
            format!("{before}expected a table{rest}")
        }
    }
}

/// The message of the parser with line and key, in one line.
fn in_one_line(text: &str, mut error: toml::de::Error) -> String {
    let line = 1 + line_of(text, &error);
    // With the source text the parser would draw the location instead of naming the key.
    error.set_input(None);
    format!("line {line}: {}", in_plain_words(&escape(&error.to_string())))
}

/// The line of the error, counted from 0.
fn line_of(text: &str, error: &toml::de::Error) -> usize {
    let start = error.span().map_or(0, |span| span.start.min(text.len()));
    text.as_bytes()[..start].iter().filter(|byte| **byte == b'\n').count()
}
