//! What can be wrong with a measured surface or its file.
//!
//! Each error of a file carries its path; those of heights in memory are an [`InputError`]. Readers never
//! panic: what is damaged, unknown or not supported ends here.

use std::path::PathBuf;

use thiserror::Error;

use crate::error::InputError;

/// A measured surface that cannot be used or a file that cannot be read.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::surface::{Heights, SurfaceError};
/// // Points without distances cannot be put on a grid.
/// let heights = Heights::new(4, 4, None, vec![0.0; 16], None)?;
/// let error = heights.resample(&Grid::centred(2, 2, 1e-6, 1e-6)?).unwrap_err();
/// assert!(matches!(error, SurfaceError::NoSpacing));
/// # Ok::<(), SurfaceError>(())
/// ```
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// A value out of range or a field of the wrong shape.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The operating system refused to open, read or write the file.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The content starts like no format that is read here.
    #[error("{}: neither x3p, sur, sdf, al3d, plu, npy nor text with numbers", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The file is damaged: truncated, contradicting itself or not what its format requires.
    #[error("{}: {what}", path.display())]
    Corrupt {
        /// The file.
        path: PathBuf,
        /// The place and what is wrong with it.
        what: String,
    },
    /// The file is sound but uses a part of the format that is not read here.
    #[error("{}: not supported: {what}", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// The part.
        what: String,
    },
    /// A height in a file without undefined points is not finite.
    #[error("{}: height ({column}, {row}) = {value} is not finite", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// Position along x.
        column: usize,
        /// Position along y.
        row: usize,
        /// The value found.
        value: f64,
    },
    /// The heights have no lateral spacing (npy files hold none): set it with `Heights::with_spacing`.
    #[error("the measured surface has no lateral spacing")]
    NoSpacing,
    /// No point of the surface is defined.
    #[error("all {points} points of the measured surface are undefined")]
    AllUndefined {
        /// Number of points.
        points: usize,
    },
    /// Undefined points must be filled first (`Heights::fill_undefined`).
    #[error("{points} points of the measured surface are undefined; fill them first")]
    Undefined {
        /// Number of undefined points.
        points: usize,
    },
    /// The measured area does not cover the grid.
    #[error(
        "the measured area of {measured_x:.3e} m x {measured_y:.3e} m is smaller than the grid, {grid_x:.3e} m x {grid_y:.3e} m"
    )]
    TooSmall {
        /// Extent of the measurement along x \[m\].
        measured_x: f64,
        /// Extent of the measurement along y \[m\].
        measured_y: f64,
        /// Extent of the grid along x \[m\].
        grid_x: f64,
        /// Extent of the grid along y \[m\].
        grid_y: f64,
    },
}
