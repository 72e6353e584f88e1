//! Text files of untrusted content: scene files, schedules and measured films.

use std::io::{Error, ErrorKind, Result};
use std::path::Path;

use crate::regular_file;

/// Largest file size \[bytes\].
const LARGEST: u64 = 1 << 24;

/// The text of a file of at most 16 MB.
///
/// # Errors
/// A path that is not a regular file, a file that is too large, cannot be read or is not UTF-8 text.
pub(crate) fn read(path: &Path) -> Result<String> {
    let bytes = regular_file::read(path, LARGEST)?;
    String::from_utf8(bytes).map_err(|_| Error::new(ErrorKind::InvalidData, "the file is not text in UTF-8"))
}
