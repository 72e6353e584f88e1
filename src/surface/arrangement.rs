//! Cropping, rotation, mirroring and rescaling of measured surfaces.

use std::f64::consts::FRAC_PI_2;

use super::error::SurfaceError;
use super::measured::Heights;
use super::rescale::rescale;
use crate::error::InputError;

impl Heights {
    /// The `nx` x `ny` points from column and row `first` on.
    ///
    /// # Errors
    /// [`SurfaceError::Input`] for a count of zero or a part that is not within the surface.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let surface = Heights::new(3, 2, None, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0], None)?;
    /// assert_eq!(surface.crop([1, 0], 2, 2)?.heights(), [1.0, 2.0, 4.0, 5.0]);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn crop(&self, first: [usize; 2], nx: usize, ny: usize) -> Result<Self, SurfaceError> {
        for (field, wanted, start, available) in
            [("nx", nx, first[0], self.nx), ("ny", ny, first[1], self.ny)]
        {
            let fits = wanted >= 1 && start.checked_add(wanted).is_some_and(|end| end <= available);
            InputError::require(fits, field, wanted as f64, "at least 1 and within the surface")?;
        }
        self.rearranged(nx, ny, |i, j| (j + first[1]) * self.nx + i + first[0])
    }

    /// The central `nx` x `ny` points.
    ///
    /// # Errors
    /// [`SurfaceError::Input`] for a count of zero or above that of the surface.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let surface = Heights::new(4, 1, None, vec![0.0, 1.0, 2.0, 3.0], None)?;
    /// assert_eq!(surface.crop_to(2, 1)?.heights(), [1.0, 2.0]);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn crop_to(&self, nx: usize, ny: usize) -> Result<Self, SurfaceError> {
        self.crop([self.nx.saturating_sub(nx) / 2, self.ny.saturating_sub(ny) / 2], nx, ny)
    }

    /// Rotated by 90 degrees about the normal, from x to y: profiles along x become profiles along y.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let surface = Heights::new(2, 1, Some([1e-6, 2e-6]), vec![1.0, 2.0], None)?;
    /// let turned = surface.rotated_90();
    /// assert_eq!((turned.nx(), turned.ny(), turned.dx()), (1, 2, Some(2e-6)));
    /// assert_eq!(turned.heights(), [1.0, 2.0]);
    /// assert_eq!(turned.rotated_90().heights(), [2.0, 1.0]);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    #[must_use]
    pub fn rotated_90(&self) -> Self {
        let (nx, ny) = (self.ny, self.nx);
        // (x, y) maps to (-y, x)
        let mut turned = self.moved(nx, ny, |i, j| (nx - 1 - i) * self.nx + j);
        turned.spacing = self.spacing.map(|[dx, dy]| [dy, dx]);
        turned
    }

    /// Mirrored in x: the order of the columns is reversed.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let surface = Heights::new(3, 1, None, vec![1.0, 2.0, 3.0], None)?;
    /// assert_eq!(surface.mirrored_x().heights(), [3.0, 2.0, 1.0]);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    #[must_use]
    pub fn mirrored_x(&self) -> Self {
        self.moved(self.nx, self.ny, |i, j| (j + 1) * self.nx - 1 - i)
    }

    /// Mirrored in y: the order of the rows is reversed.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let surface = Heights::new(1, 3, None, vec![1.0, 2.0, 3.0], None)?;
    /// assert_eq!(surface.mirrored_y().heights(), [3.0, 2.0, 1.0]);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    #[must_use]
    pub fn mirrored_y(&self) -> Self {
        self.moved(self.nx, self.ny, |i, j| (self.ny - 1 - j) * self.nx + i)
    }

    /// Extended to twice the size along each axis by mirror images: heights are continuous and periodic. An axis with a
    /// single point is not extended.
    ///
    /// # Errors
    /// [`SurfaceError::Input`] for more than [`crate::Grid::MAX_NODES`] points.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let surface = Heights::new(2, 1, None, vec![1.0, 2.0], None)?;
    /// assert_eq!(surface.tile_mirrored()?.heights(), [1.0, 2.0, 2.0, 1.0]);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn tile_mirrored(&self) -> Result<Self, SurfaceError> {
        let doubled = |n: usize| if n == 1 { 1 } else { 2 * n };
        let folded = |i: usize, n: usize| if i < n { i } else { 2 * n - 1 - i };
        self.rearranged(doubled(self.nx), doubled(self.ny), |i, j| {
            folded(j, self.ny) * self.nx + folded(i, self.nx)
        })
    }

    /// Tapers the deviations from the mean of the defined points to zero within `width` \[m\] of the edges, by `sin^2`:
    /// opposite edges then match. Roughness near the edges is lost, and the mean may change.
    ///
    /// # Errors
    /// [`SurfaceError::NoSpacing`], [`SurfaceError::AllUndefined`]; [`SurfaceError::Input`] for a width that
    /// is not positive or above half the size along an axis of more than one point.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let heights = (0..100).map(|i| 1e-9 * f64::from(i)).collect();
    /// let mut surface = Heights::new(100, 1, Some([1e-6, 1e-6]), heights, None)?;
    /// surface.taper(20e-6)?;
    /// let ends = [surface.heights()[0], surface.heights()[99]];
    /// assert!((ends[0] - ends[1]).abs() < 0.2e-9 && (surface.heights()[50] - 50e-9).abs() < 1e-20);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn taper(&mut self, width: f64) -> Result<(), SurfaceError> {
        let [dx, dy] = self.spacing.ok_or(SurfaceError::NoSpacing)?;
        InputError::require_positive("width", width)?;
        let mean = self.mean()?;
        let window = |n: usize, d: f64| -> Result<Vec<f64>, InputError> {
            if n == 1 {
                return Ok(vec![1.0]);
            }
            let fits = width <= 0.5 * d * n as f64;
            InputError::require(fits, "width", width, "at most half the size of the surface")?;
            let share = |i: usize| ((i.min(n - 1 - i) as f64 + 0.5) * d / width).min(1.0);
            Ok((0..n).map(|i| (FRAC_PI_2 * share(i)).sin().powi(2)).collect())
        };
        let (along_x, along_y) = (window(self.nx, dx)?, window(self.ny, dy)?);
        for k in 0..self.heights.len() {
            let share = along_x[k % self.nx] * along_y[k / self.nx];
            if self.is_defined(k) && share < 1.0 {
                self.heights[k] = mean + share * (self.heights[k] - mean);
            }
        }
        Ok(())
    }

    /// Removes the mean of the defined points and scales them to the root mean square height `rq` \[m\].
    ///
    /// # Errors
    /// [`SurfaceError::AllUndefined`]; [`SurfaceError::Input`] for a negative `rq`, or a positive one for a flat
    /// surface.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let mut surface = Heights::new(2, 1, None, vec![1.0, 3.0], None)?;
    /// surface.set_rq(5e-9)?;
    /// assert_eq!(surface.heights(), [-5e-9, 5e-9]);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn set_rq(&mut self, rq: f64) -> Result<(), SurfaceError> {
        InputError::require_non_negative("rq", rq)?;
        // A surface without defined points has no mean.
        self.mean()?;
        let defined = self.defined.as_ref();
        // If the mean is much larger than the heights, rounding leaves part of it the first time.
        for _ in 0..2 {
            let counts = |k: usize| defined.is_none_or(|mask| mask[k]);
            rescale(&mut self.heights, self.nx, counts, rq).ok_or_else(|| InputError::Conflict {
                field: "rq".to_owned(),
                reason: "a surface without heights cannot be scaled".to_owned(),
            })?;
        }
        Ok(())
    }

    /// `nx` x `ny` points, `(i, j)` from point `source(i, j)`.
    fn rearranged(
        &self,
        nx: usize,
        ny: usize,
        source: impl Fn(usize, usize) -> usize,
    ) -> Result<Self, SurfaceError> {
        let [dx, dy] = self.spacing.unwrap_or([1.0, 1.0]);
        crate::Grid::centred(nx, ny, dx, dy)?;
        Ok(self.moved(nx, ny, source))
    }

    /// The same for valid counts.
    fn moved(&self, nx: usize, ny: usize, source: impl Fn(usize, usize) -> usize) -> Self {
        let points = || (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j)));
        let heights = points().map(|(i, j)| self.heights[source(i, j)]).collect();
        let mask = self.defined.as_ref();
        let defined: Option<Vec<bool>> = mask.map(|mask| points().map(|(i, j)| mask[source(i, j)]).collect());
        let defined = defined.filter(|mask| mask.contains(&false));
        Self {
            nx,
            ny,
            spacing: self.spacing,
            heights,
            defined,
            #[cfg(feature = "formats")]
            unit: self.unit,
            #[cfg(feature = "formats")]
            warnings: self.warnings.clone(),
        }
    }
}
