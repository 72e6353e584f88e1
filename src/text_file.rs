//! Text files from strangers: read whole, and refused where they are too large for it.
//!
//! Scene files, tables of schedules and measured films are read through it: their size is known before memory is taken.

use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::Path;

/// Bytes of the largest file that is read.
const LARGEST: u64 = 1 << 24;

/// The text of a file of at most 16 MB; memory is taken for what the file really holds.
pub(crate) fn read(path: &Path) -> std::io::Result<String> {
    let file = File::open(path)?;
    let too_large = |size: String| {
        let message = format!("the file has {size} bytes, at most {LARGEST} are read");
        Err(Error::new(ErrorKind::FileTooLarge, message))
    };
    let size = file.metadata()?.len();
    if size > LARGEST {
        return too_large(size.to_string());
    }
    let mut text = String::new();
    file.take(LARGEST + 1).read_to_string(&mut text)?;
    // Pipes and devices do not tell their size.
    if text.len() as u64 > LARGEST { too_large(format!("more than {LARGEST}")) } else { Ok(text) }
}
