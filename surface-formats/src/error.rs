//! Errors of files.

use std::path::PathBuf;

use thiserror::Error;

/// A file that cannot be read or written; each variant but the last carries its path.
///
/// ```
/// use surface_formats::{Error, read_bytes};
/// let error = read_bytes(b"1 2\n3 x\n", "heights.txt").unwrap_err();
/// assert_eq!(error.to_string(), "heights.txt: line 2, field 2: \"x\" is not a number");
/// assert!(matches!(error, Error::Corrupt { .. }));
/// ```
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The operating system refused to open, read or write the file.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Message of the operating system.
        source: std::io::Error,
    },
    /// The content starts like no known format.
    #[error("{}: neither x3p, sur, sdf, prf, al3d, plu, npy nor text with numbers", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// A known format that has no reader here.
    #[error("{}: a file of the format {format}, which has no reader here", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// Name of the format.
        format: &'static str,
    },
    /// The file is damaged: truncated, contradicting itself or not as its format requires.
    #[error("{}: {what}", path.display())]
    Corrupt {
        /// The file.
        path: PathBuf,
        /// The place and the fault.
        what: String,
    },
    /// The file is sound but uses a part of its format that is not read here.
    #[error("{}: not supported: {what}", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// The part.
        what: String,
    },
    /// The file holds several surfaces and none was chosen, or one that it does not hold.
    #[error("{}: {}", path.display(), several(names))]
    Several {
        /// The file.
        path: PathBuf,
        /// Their names in the order of their numbers, from 1.
        names: Vec<String>,
    },
    /// A surface to be written has no distances between its points, which the format requires.
    #[error("the surface has no lateral spacing")]
    NoSpacing,
}

/// Most names that a message lists.
const MOST_NAMES: usize = 12;

/// How many surfaces there are, and how one is chosen.
fn several(names: &[String]) -> String {
    match names.len() {
        0 => "no surface".to_owned(),
        1 => "one surface alone; its number is channel = 1".to_owned(),
        count => {
            format!("{count} surfaces ({}); choose one by its number, channel = 1 to {count}", listed(names))
        }
    }
}

/// Names with their numbers.
fn listed(names: &[String]) -> String {
    let numbered = names.iter().take(MOST_NAMES).enumerate();
    let mut list: Vec<String> = numbered.map(|(k, name)| format!("{} {name:?}", k + 1)).collect();
    if names.len() > MOST_NAMES {
        list.push("...".to_owned());
    }
    list.join(", ")
}
