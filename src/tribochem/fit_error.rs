//! Fits that fail.

use std::path::PathBuf;

use thiserror::Error;

use crate::error::InputError;

/// Failure of a fit.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FitError {
    /// A value out of range.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A file could not be read.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// A row of a table does not fit.
    #[error("line {line}: {reason}")]
    Csv {
        /// Line, from 1.
        line: u64,
        /// Description of the error.
        reason: String,
    },
    /// The number of points does not exceed the number of constants.
    #[error("{points} points cannot determine {constants} constants and their errors")]
    TooFewPoints {
        /// Points of the curve.
        points: usize,
        /// Constants of the law.
        constants: usize,
    },
    /// The least-squares minimization did not converge.
    #[error("no best fit was found: {reason}")]
    NotConverged {
        /// Status of the minimizer.
        reason: String,
    },
    /// The measurement does not determine a constant.
    #[error("the measurement does not determine `{constant}`: {reason}")]
    Undetermined {
        /// The constant.
        constant: String,
        /// The reason.
        reason: String,
    },
}
