//! Choices of the caller.

use std::path::Path;

use crate::error::Error;
use crate::surface::Surface;
use crate::unit::LengthUnit;

/// Choices for files that leave something open.
///
/// ```
/// use surface_formats::{LengthUnit, Options};
/// let file = b"1 2\n3 4\n";
/// let surface = Options::new().with_unit(LengthUnit::Micrometre).read_bytes(file, "heights.txt")?;
/// assert_eq!((surface.heights[0], surface.warnings.len()), (1e-6, 0));
/// # Ok::<(), surface_formats::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Options {
    /// Which surface of several, counted from 1.
    pub channel: Option<usize>,
    /// Unit of lengths for which the file names none.
    pub unit: Option<LengthUnit>,
}

impl Options {
    /// No choices: a file of several surfaces is an error, numbers without unit are taken as metres with a
    /// warning.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The same with the surface number `channel`, counted from 1.
    #[must_use]
    pub fn with_channel(mut self, channel: usize) -> Self {
        self.channel = Some(channel);
        self
    }

    /// The same with a unit of lengths for which the file names none.
    #[must_use]
    pub fn with_unit(mut self, unit: LengthUnit) -> Self {
        self.unit = Some(unit);
        self
    }

    /// Reads the file at `path`, see [`crate::read`].
    ///
    /// # Errors
    /// Those of [`crate::read`].
    pub fn read(&self, path: impl AsRef<Path>) -> Result<Surface, Error> {
        crate::read_file(path.as_ref(), *self)
    }

    /// Reads the content of a file, `name` stands in errors; see [`crate::read_bytes`].
    ///
    /// # Errors
    /// Those of [`crate::read`].
    pub fn read_bytes(&self, bytes: &[u8], name: impl AsRef<Path>) -> Result<Surface, Error> {
        crate::read_content(bytes, name.as_ref(), *self)
    }
}
