//! Input errors, which name field and value.
//!
//! One type for all input of the library. Module errors wrap it (`SimError`, `ReynoldsError`, `SurfaceError`). Fields
//! have the names that users write: scene keys with their path, arguments by name.

use thiserror::Error;

/// An invalid input: a value out of range, a field of the wrong shape, a value that is not finite.
///
/// # Examples
///
/// ```
/// use stribeck::{Grid, InputError};
/// let error = Grid::centred(64, 64, -1e-6, 1e-6).unwrap_err();
/// assert!(matches!(&error, InputError::Value { value, .. } if *value == -1e-6));
/// assert!(error.to_string().contains("must be"));
/// ```
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InputError {
    /// A single value lies outside its valid range.
    #[error("{field} = {}: must be {requirement}", format_number(*value))]
    Value {
        /// The field as the user wrote it, for example `load.force`.
        field: String,
        /// The given value.
        value: f64,
        /// The valid range in words.
        requirement: &'static str,
    },
    /// A slice does not match the grid or the other slices of the call.
    #[error("{field} has {found} values, expected {expected}")]
    Shape {
        /// Name of the argument.
        field: String,
        /// Number of values required.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
    /// A field holds a value that is not finite.
    #[error("{field}[{index}] = {value}: every value must be finite")]
    NotFinite {
        /// Name of the argument.
        field: String,
        /// Position of the first offending value.
        index: usize,
        /// The value found there.
        value: f64,
    },
    /// Two inputs contradict each other or one is missing.
    #[error("{field}: {reason}")]
    Conflict {
        /// The field or pair of fields.
        field: String,
        /// The contradiction or missing value.
        reason: String,
    },
}

/// A number of moderate size in decimal digits, otherwise with a power of ten.
pub(crate) fn format_number(value: f64) -> String {
    let everyday = value == 0.0 || (1e-4..1e10).contains(&value.abs());
    if everyday { value.to_string() } else { format!("{value:e}") }
}

/// Most characters of a quoted word.
const LONGEST_WORD: usize = 80;

/// The text in one line, with long words truncated.
pub(crate) fn escape(text: &str) -> String {
    let words = text.split_whitespace().map(|word| match word.char_indices().nth(LONGEST_WORD) {
        Some((end, _)) => format!("{}...", &word[..end]),
        None => word.to_owned(),
    });
    words.collect::<Vec<_>>().join(" ")
}

impl InputError {
    /// The error with `path` before the field: `conductivity` in `lubricant.thermal` becomes
    /// `lubricant.thermal.conductivity`.
    pub(crate) fn within(mut self, path: &str) -> Self {
        let (Self::Value { field, .. }
        | Self::Shape { field, .. }
        | Self::NotFinite { field, .. }
        | Self::Conflict { field, .. }) = &mut self;
        field.insert(0, '.');
        field.insert_str(0, path);
        self
    }

    /// Error unless `value` is finite and above zero.
    ///
    /// # Errors
    /// [`InputError::Value`] naming `field`.
    pub(crate) fn require_positive(field: &str, value: f64) -> Result<(), Self> {
        Self::require(value.is_finite() && value > 0.0, field, value, "finite and > 0")
    }

    /// Error unless `value` is finite and not below zero.
    ///
    /// # Errors
    /// [`InputError::Value`] naming `field`.
    pub(crate) fn require_non_negative(field: &str, value: f64) -> Result<(), Self> {
        Self::require(value.is_finite() && value >= 0.0, field, value, "finite and >= 0")
    }

    /// Error with `requirement` as its reason unless `holds`.
    ///
    /// # Errors
    /// [`InputError::Value`] naming `field`.
    pub(crate) fn require(
        holds: bool,
        field: &str,
        value: f64,
        requirement: &'static str,
    ) -> Result<(), Self> {
        if holds { Ok(()) } else { Err(Self::Value { field: field.to_owned(), value, requirement }) }
    }

    /// Error unless `values` has `expected` entries.
    ///
    /// # Errors
    /// [`InputError::Shape`] naming `field`.
    pub(crate) fn require_len<T>(field: &str, values: &[T], expected: usize) -> Result<(), Self> {
        if values.len() == expected {
            Ok(())
        } else {
            Err(Self::Shape { field: field.to_owned(), expected, found: values.len() })
        }
    }

    /// Error unless every entry of `values` is finite.
    ///
    /// # Errors
    /// [`InputError::NotFinite`] naming `field` and the first offending entry.
    pub(crate) fn require_finite(field: &str, values: &[f64]) -> Result<(), Self> {
        match values.iter().position(|v| !v.is_finite()) {
            None => Ok(()),
            Some(index) => Err(Self::NotFinite { field: field.to_owned(), index, value: values[index] }),
        }
    }
}
