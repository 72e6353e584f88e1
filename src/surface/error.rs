//! Errors of measured surfaces and their files.

use thiserror::Error;

use crate::error::InputError;

/// A measured surface that cannot be used or a file that cannot be read.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::surface::{Heights, SurfaceError};
/// // Points without spacing cannot be mapped to a grid.
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
    /// A file that cannot be read or written.
    #[cfg(feature = "formats")]
    #[error("{error}{}", conversion(error))]
    File {
        /// The error of its reader or writer.
        error: surface_formats::Error,
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

#[cfg(feature = "formats")]
impl From<surface_formats::Error> for SurfaceError {
    fn from(error: surface_formats::Error) -> Self {
        Self::File { error }
    }
}

/// The command that converts a file whose format has no reader.
#[cfg(feature = "formats")]
fn conversion(error: &surface_formats::Error) -> String {
    let surface_formats::Error::Foreign { path, .. } = error else { return String::new() };
    let (from, to) = (path.display(), path.with_extension("x3p"));
    let program = format!("import stribeck; stribeck.surface.read('{from}').write('{}')", to.display());
    format!("; with the Python package stribeck[formats] this converts it: python -c \"{program}\"")
}
