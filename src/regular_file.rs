//! Untrusted files: only regular files of bounded size are read.
//!
//! Scenes, checkpoints, surfaces, tables and archives are opened by this module. Reading from a pipe could
//! block, and reading from a device could be endless.

use std::fs::{self, File};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

/// The size of the file at `path` \[bytes\].
///
/// # Errors
/// A path that does not exist or is not a regular file.
pub(crate) fn size(path: &Path) -> Result<u64> {
    let found = fs::metadata(path)?;
    if found.is_file() {
        return Ok(found.len());
    }
    let kind = if found.is_dir() { "this is a folder" } else { "this is a pipe or a device" };
    Err(Error::new(ErrorKind::InvalidInput, format!("{kind}, give a file")))
}

/// Opens the file at `path`.
///
/// # Errors
/// The errors of [`size`], and a file that cannot be opened.
#[cfg(all(feature = "formats", feature = "npz"))]
pub(crate) fn open(path: &Path) -> Result<File> {
    size(path).and_then(|_| File::open(path))
}

/// Whether the file at `path` begins with `bytes`.
///
/// # Errors
/// The errors of [`size`], and a file that cannot be read.
#[cfg(feature = "serde")]
pub(crate) fn begins_with(path: &Path, bytes: &[u8]) -> Result<bool> {
    size(path)?;
    let mut found = Vec::new();
    File::open(path)?.take(bytes.len() as u64).read_to_end(&mut found)?;
    Ok(found == bytes)
}

/// The content of a file of at most `largest` bytes.
///
/// # Errors
/// The errors of [`size`], a file that is too large, and one that cannot be read.
pub(crate) fn read(path: &Path, largest: u64) -> Result<Vec<u8>> {
    let size = size(path)?;
    if size > largest {
        let message = format!("the file has {size} bytes, at most {largest} are read");
        return Err(Error::new(ErrorKind::FileTooLarge, message));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(size).read_to_end(&mut bytes)?;
    Ok(bytes)
}
