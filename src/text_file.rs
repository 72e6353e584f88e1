//! Text files from strangers: scene files, tables of schedules and measured films.

use std::io::{Error, ErrorKind, Result};
use std::path::Path;

use crate::regular_file;

/// Bytes of the largest file that is read.
const LARGEST: u64 = 1 << 24;

/// The text of a file of at most 16 MB.
///
/// # Errors
/// What is no file, is larger, cannot be read or is not text.
pub(crate) fn read(path: &Path) -> Result<String> {
    let bytes = regular_file::read(path, LARGEST)?;
    String::from_utf8(bytes).map_err(|_| Error::new(ErrorKind::InvalidData, "the file is not text in UTF-8"))
}
