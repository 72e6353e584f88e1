//! Readers of surface topography files, and writers of three formats.
//!
//! ```
//! let text = "# Width: 3 um\n# Height: 2 um\n# Value units: nm\n1 2 3\n4 BAD 6\n";
//! let surface = surface_formats::read_bytes(text.as_bytes(), "heights.txt")?;
//! assert_eq!((surface.nx, surface.ny, surface.undefined()), (3, 2, 1));
//! assert_eq!((surface.heights[0], surface.spacing), (1e-9, Some([1e-6, 1e-6])));
//! assert!(surface.warnings.is_empty());
//! # Ok::<(), surface_formats::Error>(())
//! ```
//!
//! | content | format | holds |
//! |---|---|---|
//! | zip archive with `main.xml` | x3p, ISO 25178-72 | heights and spacing in metres, undefined points |
//! | `DIGITAL SURF`, `DSCOMPRESSED` | Digital Surf sur and pro | heights as integers with scale and units, undefined points |
//! | `aISO-1.0`, `bISO-1.0`, versions 2.0, `BCR`, `NPL` | sdf, ISO 25178-71 | heights with scale in metres, undefined points |
//! | `AliconaImaging` | al3d | heights in metres, undefined points |
//! | date padded with zeros | Sensofar plu | heights in micrometres, undefined points |
//! | `\x93NUMPY` | npy | an array of shape `(ny, nx)` without unit or spacing |
//! | `CX`, `CZ` and `EOR` or ETX | prf, smd, ISO 5436-2 | a profile with units |
//! | text | matrices and columns x, z or x, y, z | units and sizes where a header or titles give them |
//!
//! Points are undefined where the format has a marker and where a number is NaN or infinite. They are NaN in
//! [`Surface::heights`]. Whatever the file leaves open is in [`Surface::warnings`].
//!
//! Readers are written against damaged and hostile files: every access is checked, sizes are compared with the
//! length of the file before memory is taken, and errors name the file, the place and the fault.
#![forbid(unsafe_code)]

mod al3d;
mod error;
mod foreign;
mod npy;
mod number;
mod options;
mod plu;
mod prf;
mod sdf;
mod source;
mod sur;
mod surface;
mod text;
mod unit;
mod x3p;

use std::cell::Cell;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

pub use error::Error;
pub use npy::write_npy;
pub use options::Options;
pub use surface::{MAX_POINTS, Surface};
pub use text::write_text;
pub use unit::LengthUnit;
pub use x3p::write_x3p;

use source::Source;

/// Examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// Larger files are refused: more than the text of [`MAX_POINTS`] heights.
const MAX_FILE: u64 = 1 << 31;

/// Reads the file at `path`; its content decides about the format, not its name.
///
/// # Errors
/// [`Error`] with the path and the fault: the file cannot be opened, is a pipe, a device or a folder, is of no
/// known format, damaged, or holds a part that is not supported.
pub fn read(path: impl AsRef<Path>) -> Result<Surface, Error> {
    Options::new().read(path)
}

/// Reads the content of a file, as [`read`] does; `name` stands in errors.
///
/// # Errors
/// Those of [`read`].
pub fn read_bytes(bytes: &[u8], name: impl AsRef<Path>) -> Result<Surface, Error> {
    Options::new().read_bytes(bytes, name)
}

/// Reads the file at `path`.
fn read_file(path: &Path, options: Options) -> Result<Surface, Error> {
    let bytes = file_content(path).map_err(|source| Error::Io { path: path.to_owned(), source })?;
    read_content(&bytes, path, options)
}

/// The content of a regular file of at most [`MAX_FILE`] bytes.
fn file_content(path: &Path) -> io::Result<Vec<u8>> {
    let found = fs::metadata(path)?;
    if !found.is_file() {
        let what = if found.is_dir() { "this is a folder" } else { "this is a pipe or a device" };
        return Err(io::Error::new(ErrorKind::InvalidInput, format!("{what}, give a file")));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_FILE + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads `bytes` with the reader that their beginning calls for.
fn read_content(bytes: &[u8], path: &Path, options: Options) -> Result<Surface, Error> {
    let is_chosen = Cell::new(false);
    let source = Source { path, bytes, big_endian: false, options, is_chosen: &is_chosen };
    if bytes.len() as u64 > MAX_FILE {
        return Err(source.unsupported("a file of more than 2 GiB".to_owned()));
    }
    if let Some(format) = foreign::format_of(bytes) {
        return Err(Error::Foreign { path: path.to_owned(), format });
    }
    if let Some(content) = foreign::other_content(bytes) {
        return Err(source.unsupported(content.to_owned()));
    }
    if bytes.starts_with(npy::MAGIC) {
        npy::read(source)
    } else if bytes.starts_with(x3p::MAGIC) {
        x3p::read(source)
    } else if bytes.starts_with(sur::MAGIC) || bytes.starts_with(sur::MAGIC_COMPRESSED) {
        sur::read(source)
    } else if bytes.starts_with(al3d::MAGIC) {
        al3d::read(source)
    } else if sdf::recognises(bytes) {
        sdf::read(source)
    } else if plu::recognises(bytes) {
        plu::read(source)
    } else if text::recognises(bytes) {
        text::read(source)
    } else if prf::has_control_characters(bytes) {
        prf::read_with_control_characters(source)
    } else {
        Err(source.unknown())
    }
}
