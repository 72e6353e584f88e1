//! Measured surfaces: heights on a rectangular array of points, possibly with undefined points.

use super::error::SurfaceError;
use crate::error::InputError;
use crate::grid::Grid;

/// Smoothing sweeps over filled holes.
const FILL_SWEEPS: usize = 200;

/// Measured heights \[m\] of `nx` x `ny` points, row-major with x fastest, and the spacing of the points if known.
///
/// Undefined points (no signal of the instrument) are flagged in a mask; their height is stored as 0.
///
/// ```
/// use stribeck::{Grid, surface::Heights};
/// let ripple: Vec<f64> = (0..64 * 32).map(|k| if k % 2 == 0 { 1e-7 } else { -1e-7 }).collect();
/// let measured = Heights::new(64, 32, Some([1e-6, 1e-6]), ripple, None)?;
/// let on_grid = measured.fit_to_grid(&Grid::centred(100, 100, 1e-6, 1e-6)?)?;
/// assert_eq!(on_grid.len(), 10_000);
/// # Ok::<(), stribeck::surface::SurfaceError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Heights {
    /// Points along x.
    pub(super) nx: usize,
    /// Points along y.
    pub(super) ny: usize,
    /// Spacing of the points along x and y \[m\]; `None` if the file has none.
    pub(super) spacing: Option<[f64; 2]>,
    /// Heights \[m\], x fastest.
    pub(super) heights: Vec<f64>,
    /// `None`: all points are defined.
    pub(super) defined: Option<Vec<bool>>,
    /// Unit of their file.
    #[cfg(feature = "formats")]
    pub(super) unit: Option<surface_formats::LengthUnit>,
    /// Warnings of the file reader.
    #[cfg(feature = "formats")]
    pub(super) warnings: Vec<String>,
}

impl Heights {
    /// Surface of `nx` x `ny` points with `spacing` `[dx, dy]` \[m\] and a mask of the defined points
    /// (`None`: all).
    ///
    /// Heights of undefined points are ignored.
    ///
    /// # Errors
    /// A count of zero or more than [`Grid::MAX_NODES`] points, a spacing that is not positive, slices of the
    /// wrong length, a defined height that is not finite.
    pub fn new(
        nx: usize,
        ny: usize,
        spacing: Option<[f64; 2]>,
        mut heights: Vec<f64>,
        defined: Option<Vec<bool>>,
    ) -> Result<Self, SurfaceError> {
        let [dx, dy] = spacing.unwrap_or([1.0, 1.0]);
        let points = Grid::centred(nx, ny, dx, dy)?.len();
        InputError::require_len("heights", &heights, points)?;
        if let Some(mask) = &defined {
            InputError::require_len("defined", mask, points)?;
        }
        let defined = defined.filter(|mask| mask.contains(&false));
        if let Some(mask) = &defined {
            for (height, _) in heights.iter_mut().zip(mask).filter(|(_, defined)| !**defined) {
                *height = 0.0;
            }
        }
        InputError::require_finite("heights", &heights)?;
        Ok(Self {
            nx,
            ny,
            spacing,
            heights,
            defined,
            #[cfg(feature = "formats")]
            unit: None,
            #[cfg(feature = "formats")]
            warnings: Vec::new(),
        })
    }

    /// The same heights with spacing `dx`, `dy` \[m\], for formats without spacing.
    ///
    /// # Errors
    /// A spacing that is not finite and positive.
    pub fn with_spacing(mut self, dx: f64, dy: f64) -> Result<Self, SurfaceError> {
        Grid::centred(self.nx, self.ny, dx, dy)?;
        self.spacing = Some([dx, dy]);
        Ok(self)
    }

    /// Number of points along x.
    #[must_use]
    pub fn nx(&self) -> usize {
        self.nx
    }

    /// Number of points along y.
    #[must_use]
    pub fn ny(&self) -> usize {
        self.ny
    }

    /// Spacing along x \[m\], if known.
    #[must_use]
    pub fn dx(&self) -> Option<f64> {
        self.spacing.map(|[dx, _]| dx)
    }

    /// Spacing along y \[m\], if known.
    #[must_use]
    pub fn dy(&self) -> Option<f64> {
        self.spacing.map(|[_, dy]| dy)
    }

    /// The heights \[m\], point `(i, j)` at `j * nx + i`; undefined points hold 0.
    #[must_use]
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Mask of the defined points, `None` when all are.
    #[must_use]
    pub fn defined(&self) -> Option<&[bool]> {
        self.defined.as_deref()
    }

    /// The heights \[m\], NaN where undefined.
    #[must_use]
    pub fn heights_or_nan(&self) -> Vec<f64> {
        (0..self.heights.len()).map(|k| if self.is_defined(k) { self.heights[k] } else { f64::NAN }).collect()
    }

    /// The heights of the defined points \[m\], in order: the input of the height and bearing parameters of
    /// [`crate::metrics`].
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let surface = Heights::new(3, 1, None, vec![1e-6, 0.0, 3e-6], Some(vec![true, false, true]))?;
    /// assert_eq!(surface.defined_heights(), [1e-6, 3e-6]);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    #[must_use]
    pub fn defined_heights(&self) -> Vec<f64> {
        (0..self.heights.len()).filter(|&k| self.is_defined(k)).map(|k| self.heights[k]).collect()
    }

    /// Number of undefined points.
    #[must_use]
    pub fn undefined(&self) -> usize {
        self.defined.as_ref().map_or(0, |mask| mask.iter().filter(|defined| !**defined).count())
    }

    /// Fills the undefined points. They are set ring by ring to the mean of their known neighbors and then relaxed towards
    /// Laplace's equation (a membrane over the hole). Defined heights do not change.
    ///
    /// # Errors
    /// [`SurfaceError::AllUndefined`] if no point is defined.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let mut line = Heights::new(5, 1, None, vec![0.0, 9.9, 9.9, 9.9, 4e-6],
    ///     Some(vec![true, false, false, false, true]))?;
    /// line.fill_undefined()?;
    /// assert!((line.heights()[1] - 1e-6).abs() < 1e-12 && line.undefined() == 0);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn fill_undefined(&mut self) -> Result<(), SurfaceError> {
        let Some(mut known) = self.defined.clone() else { return Ok(()) };
        let holes = self.grow_into_holes(&mut known)?;
        for _ in 0..FILL_SWEEPS {
            for &k in &holes {
                let (sum, count) =
                    self.neighbours(k).fold((0.0, 0.0), |(s, n), l| (s + self.heights[l], n + 1.0));
                if count > 0.0 {
                    self.heights[k] = sum / count;
                }
            }
        }
        self.defined = None;
        Ok(())
    }

    /// Sets unknown points ring by ring to the mean of their known neighbors; returns these points.
    fn grow_into_holes(&mut self, known: &mut [bool]) -> Result<Vec<usize>, SurfaceError> {
        let mut filled = Vec::new();
        let touches = |surface: &Self, known: &[bool], k: usize| surface.neighbours(k).any(|l| known[l]);
        let mut ring: Vec<usize> =
            (0..known.len()).filter(|&k| !known[k] && touches(self, known, k)).collect();
        while !ring.is_empty() {
            for &k in &ring {
                let near = self.neighbours(k).filter(|&l| known[l]);
                let (sum, count) = near.fold((0.0, 0.0), |(s, n), l| (s + self.heights[l], n + 1.0));
                self.heights[k] = sum / count;
            }
            ring.iter().for_each(|&k| known[k] = true);
            let mut next: Vec<usize> =
                ring.iter().flat_map(|&k| self.neighbours(k)).filter(|&l| !known[l]).collect();
            next.sort_unstable();
            next.dedup();
            filled.append(&mut ring);
            ring = next;
        }
        if known.iter().all(|&k| k) {
            Ok(filled)
        } else {
            Err(SurfaceError::AllUndefined { points: known.len() })
        }
    }

    /// The neighbors of point `k`, up to four.
    fn neighbours(&self, k: usize) -> impl Iterator<Item = usize> + use<> {
        let (nx, last) = (self.nx, self.heights.len());
        let i = k % nx;
        let left = (i > 0).then(|| k - 1);
        let right = (i + 1 < nx).then_some(k + 1);
        let below = k.checked_sub(nx);
        let above = (k + nx < last).then_some(k + nx);
        [left, right, below, above].into_iter().flatten()
    }

    /// Whether point `k` was measured.
    pub(super) fn is_defined(&self, k: usize) -> bool {
        self.defined.as_ref().is_none_or(|mask| mask[k])
    }
}
