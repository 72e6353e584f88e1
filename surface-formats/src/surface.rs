//! The content of a file: heights on a rectangle of points.

use crate::unit::LengthUnit;

/// Most points of a surface.
pub const MAX_POINTS: usize = 1 << 26;

/// Heights as a file holds them, lengths in metres.
///
/// ```
/// let surface = surface_formats::read_bytes(b"# Width: 2 um\n# Height: 1 um\n# Value units: nm\n1 NaN\n", "a.txt")?;
/// assert_eq!((surface.nx, surface.ny, surface.undefined()), (2, 1, 1));
/// assert_eq!((surface.spacing, surface.heights[0]), (Some([1e-6, 1e-6]), 1e-9));
/// # Ok::<(), surface_formats::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Surface {
    /// Points along x.
    pub nx: usize,
    /// Points along y.
    pub ny: usize,
    /// Distances of the points along x and y \[m\]; `None` where the file does not say.
    pub spacing: Option<[f64; 2]>,
    /// Unit of the heights in the file; `None` where the file names none and the numbers are taken as metres.
    pub unit: Option<LengthUnit>,
    /// Heights \[m\], point `(i, j)` at `j * nx + i`; NaN where undefined.
    pub heights: Vec<f64>,
    /// Doubts of the reader, a sentence each: missing units, keys of a header that are not understood, a
    /// layout that was chosen among several possible ones.
    pub warnings: Vec<String>,
}

impl Surface {
    /// Heights \[m\] of `nx` x `ny` points without spacing, unit or warnings; NaN where undefined.
    #[must_use]
    pub fn new(nx: usize, ny: usize, heights: Vec<f64>) -> Self {
        Self { nx, ny, spacing: None, unit: None, heights, warnings: Vec::new() }
    }

    /// The same points at other distances along x and y \[m\].
    #[must_use]
    pub fn with_spacing(mut self, spacing: Option<[f64; 2]>) -> Self {
        self.spacing = spacing;
        self
    }

    /// Number of undefined points.
    #[must_use]
    pub fn undefined(&self) -> usize {
        self.heights.iter().filter(|height| height.is_nan()).count()
    }
}
