//! Files of measured surfaces, read and written by the crate `surface-formats`.

use std::path::Path;

use surface_formats::{LengthUnit, Surface};

use super::error::SurfaceError;
use super::measured::Heights;
use crate::error::InputError;

/// Options for ambiguous files: which of several surfaces, the unit of numbers without one.
///
/// ```
/// use stribeck::surface::{LengthUnit, ReadOptions, read_with, write_npy};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("heights.npy");
/// write_npy(&path, 2, 1, &[1.0, 2.0])?;
/// let heights = read_with(&path, &ReadOptions::new().with_unit(LengthUnit::Micrometre))?;
/// assert_eq!(heights.heights(), [1e-6, 2e-6]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub use surface_formats::Options as ReadOptions;

/// Reads a measured surface; the format is detected from the content, not the name.
///
/// `docs/surfaces.md` lists the formats and their supported parts. All lengths are converted to metres;
/// [`Heights::unit`] is the unit of the file. Numbers without unit are taken as metres, with one of the
/// [`Heights::warnings`]. Points marked as undefined in the format, and points whose height is NaN or infinite, are
/// masked.
///
/// Damaged files are errors and never panic. Memory is allocated for points that the file really contains, at most
/// [`crate::Grid::MAX_NODES`]. More than 64 MB of heights compressed to less than 1/200 of their size are rejected:
/// measured heights are noisy and compress little.
///
/// # Errors
/// [`SurfaceError`] with path and cause: the file cannot be opened; is a pipe, a device or a folder; has an unknown
/// format; is damaged; has an unsupported part or several surfaces.
///
/// ```
/// use stribeck::surface::{read, write_npy};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("heights.npy");
/// write_npy(&path, 2, 1, &[1e-9, 2e-9])?;
/// let heights = read(&path)?.with_spacing(1e-6, 1e-6)?;
/// assert_eq!(heights.heights(), [1e-9, 2e-9]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read(path: impl AsRef<Path>) -> Result<Heights, SurfaceError> {
    read_with(path, &ReadOptions::new())
}

/// Reads a measured surface like [`read`], with options for ambiguous files.
///
/// # Errors
/// The errors of [`read`].
pub fn read_with(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Heights, SurfaceError> {
    Heights::of_file(options.read(path)?)
}

/// Reads a measured surface from the bytes of a file, like [`read`]; `name` is used in errors.
///
/// # Errors
/// The errors of [`read`].
///
/// ```
/// use stribeck::surface::{LengthUnit, read_bytes};
/// let text = "# Width: 3 um\n# Height: 2 um\n# Value units: nm\n1 2 3\n4 BAD 6\n";
/// let surface = read_bytes(text.as_bytes(), "heights.txt")?;
/// assert_eq!((surface.nx(), surface.ny(), surface.undefined()), (3, 2, 1));
/// assert_eq!((surface.heights()[0], surface.unit()), (1e-9, Some(LengthUnit::Nanometre)));
/// # Ok::<(), stribeck::surface::SurfaceError>(())
/// ```
pub fn read_bytes(bytes: &[u8], name: impl AsRef<Path>) -> Result<Heights, SurfaceError> {
    Heights::of_file(surface_formats::read_bytes(bytes, name)?)
}

/// Writes a surface as x3p (ISO 25178-72), 64 bit floats; undefined points are `NaN`, as in the standard.
///
/// [`read`] returns exactly the same heights, mask and spacing.
///
/// # Errors
/// [`SurfaceError::NoSpacing`] for a surface without spacing, [`SurfaceError::File`] when the file cannot be
/// written.
///
/// ```
/// use stribeck::surface::{Heights, read, write_x3p};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("surface.x3p");
/// let mask = Some(vec![true, false]);
/// let surface = Heights::new(2, 1, Some([1e-6, 1e-6]), vec![1e-9 / 3.0, 0.0], mask)?;
/// write_x3p(&path, &surface)?;
/// assert_eq!(read(&path)?.heights(), surface.heights());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_x3p(path: impl AsRef<Path>, surface: &Heights) -> Result<(), SurfaceError> {
    if surface.dx().is_none() {
        return Err(SurfaceError::NoSpacing);
    }
    Ok(surface_formats::write_x3p(path, &surface.to_file())?)
}

/// Writes a surface as text: a header with sizes and units, then one line of heights \[m\] per row, separated by tabs,
/// `BAD` where undefined. Programs that read Gwyddion's text export can read it.
///
/// [`read`] returns exactly the same heights, mask and spacing.
///
/// # Errors
/// [`SurfaceError::File`] when the file cannot be written.
///
/// ```
/// use stribeck::surface::{Heights, read, write_text};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("surface.txt");
/// let surface = Heights::new(2, 1, Some([1e-6, 1e-6]), vec![1e-9 / 3.0, 2e-9], None)?;
/// write_text(&path, &surface)?;
/// assert_eq!(read(&path)?.heights(), surface.heights());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_text(path: impl AsRef<Path>, surface: &Heights) -> Result<(), SurfaceError> {
    Ok(surface_formats::write_text(path, &surface.to_file())?)
}

/// Writes a field \[m\] of `nx` x `ny` values, x fastest, NaN where undefined, as an npy array of shape
/// `(ny, nx)`, 64 bit floats in C order.
///
/// # Errors
/// [`SurfaceError::Input`] when `field` has not `nx * ny` values, [`SurfaceError::File`] when the file cannot
/// be written.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("heights.npy");
/// stribeck::surface::write_npy(&path, 3, 2, &[0.0; 6])?;
/// assert_eq!(std::fs::metadata(&path)?.len(), 128 + 6 * 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_npy(path: impl AsRef<Path>, nx: usize, ny: usize, field: &[f64]) -> Result<(), SurfaceError> {
    InputError::require_len("field", field, nx.saturating_mul(ny))?;
    Ok(surface_formats::write_npy(path, &Surface::new(nx, ny, field.to_vec()))?)
}

impl Heights {
    /// The surface of a file.
    fn of_file(surface: Surface) -> Result<Self, SurfaceError> {
        let Surface { nx, ny, spacing, unit, heights, warnings, .. } = surface;
        let defined = heights.iter().map(|height| !height.is_nan()).collect();
        let mut read = Self::new(nx, ny, spacing, heights, Some(defined))?;
        (read.unit, read.warnings) = (unit, warnings);
        Ok(read)
    }

    /// The surface in the form of files.
    fn to_file(&self) -> Surface {
        Surface::new(self.nx, self.ny, self.heights_or_nan()).with_spacing(self.spacing)
    }

    /// The same heights with the `unit` of their file; values remain in metres.
    #[must_use]
    pub fn with_unit(mut self, unit: LengthUnit) -> Self {
        self.unit = Some(unit);
        self
    }

    /// Unit of the heights in their file, if known.
    #[must_use]
    pub fn unit(&self) -> Option<LengthUnit> {
        self.unit
    }

    /// The same heights with the `warnings` of another reader.
    #[must_use]
    pub fn with_warnings(mut self, warnings: Vec<String>) -> Self {
        self.warnings = warnings;
        self
    }

    /// Warnings of the file reader, one sentence each: missing units, unknown header keys, an ambiguous layout.
    ///
    /// ```
    /// let surface = stribeck::surface::read_bytes(b"1 2\n3 5\n", "heights.txt")?;
    /// assert!(surface.warnings()[0].starts_with("the unit of the heights is not known"));
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    #[must_use]
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }
}
