//! Measured surfaces on simulation grids.

use super::error::SurfaceError;
use super::measured::Heights;
use super::resample::{Tiling, resample};
use crate::error::InputError;
use crate::grid::Grid;

impl Heights {
    /// Heights \[m\] on `grid`, from a window of its size in the center of the surface; coordinates of the grid are ignored.
    ///
    /// Along an axis where the grid is coarser, cells get the average over their area (which removes wavelengths below the
    /// cell size and lowers the roughness); otherwise linear interpolation. Opposite edges of the result do not match: see
    /// [`Heights::resample_mirrored`] for periodic roughness.
    ///
    /// # Errors
    /// [`SurfaceError::NoSpacing`], [`SurfaceError::Undefined`], or [`SurfaceError::TooSmall`] if the window does not
    /// fit.
    ///
    /// ```
    /// # use stribeck::{Grid, surface::Heights};
    /// let surface = Heights::new(4, 1, Some([1e-6, 1e-6]), vec![0.0, 2.0, 4.0, 6.0], None)?;
    /// let coarse = surface.resample(&Grid::centred(2, 1, 2e-6, 1e-6)?)?;
    /// assert!((coarse[0] - 1.0).abs() < 1e-12 && (coarse[1] - 5.0).abs() < 1e-12);
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn resample(&self, grid: &Grid) -> Result<Vec<f64>, SurfaceError> {
        let [dx, dy] = self.usable_spacing()?;
        let (measured_x, measured_y) = (dx * self.nx as f64, dy * self.ny as f64);
        let (grid_x, grid_y) = (grid.size_x(), grid.size_y());
        if grid_x > measured_x * (1.0 + 1e-9) || grid_y > measured_y * (1.0 + 1e-9) {
            return Err(SurfaceError::TooSmall { measured_x, measured_y, grid_x, grid_y });
        }
        Ok(resample(&self.heights, [self.nx, self.ny], [dx, dy], grid, Tiling::Window))
    }

    /// Heights \[m\] on `grid`, periodic and of any size: a window in the center of the surface is tiled by mirror images,
    /// so that heights are continuous and opposite edges of the grid match.
    ///
    /// Along each axis the window is the largest that fits an even number of times into the grid. The pattern repeats with
    /// visible mirror symmetry at the seams: mean roughness is kept, the longest wavelengths are not. Cells are averaged
    /// or interpolated as in [`Heights::resample`].
    ///
    /// # Errors
    /// [`SurfaceError::NoSpacing`] or [`SurfaceError::Undefined`]; [`SurfaceError::Input`] when the measured
    /// area is so small that it would be repeated more often than the grid has nodes.
    ///
    /// ```
    /// # use stribeck::{Grid, surface::Heights};
    /// let surface = Heights::new(2, 1, Some([1e-6, 1e-6]), vec![0.0, 1.0], None)?;
    /// let tiled = surface.resample_mirrored(&Grid::centred(8, 1, 1e-6, 1e-6)?)?;
    /// let expected = [0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0];
    /// assert!(tiled.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12));
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn resample_mirrored(&self, grid: &Grid) -> Result<Vec<f64>, SurfaceError> {
        let [dx, dy] = self.usable_spacing()?;
        let axes = [
            (grid.size_x(), dx * self.nx as f64, grid.nx()),
            (grid.size_y(), dy * self.ny as f64, grid.ny()),
        ];
        for (size, measured, nodes) in axes {
            if size / measured > nodes as f64 {
                let reason = format!(
                    "the measured {measured:.3e} m would be repeated more often than the {size:.3e} m of the grid have nodes, {nodes}"
                );
                return Err(InputError::Conflict { field: "surface".to_owned(), reason }.into());
            }
        }
        Ok(resample(&self.heights, [self.nx, self.ny], [dx, dy], grid, Tiling::Mirrored))
    }

    /// The spacing, if all points are defined.
    fn usable_spacing(&self) -> Result<[f64; 2], SurfaceError> {
        match self.undefined() {
            0 => self.spacing.ok_or(SurfaceError::NoSpacing),
            points => Err(SurfaceError::Undefined { points }),
        }
    }

    /// The measured roughness on a simulation grid \[m\], periodic and with zero mean:
    /// [`Heights::fill_undefined`], [`Heights::remove_plane`], [`Heights::resample_mirrored`], then removal
    /// of the mean.
    ///
    /// # Errors
    /// [`SurfaceError::NoSpacing`], [`SurfaceError::AllUndefined`], or the errors of the three steps.
    ///
    /// ```
    /// # use stribeck::{Grid, surface::Heights};
    /// let surface = Heights::new(3, 1, Some([1e-6, 1e-6]), vec![5e-6, 5e-6, 5e-6], None)?;
    /// let flat = surface.fit_to_grid(&Grid::centred(7, 7, 1e-6, 1e-7)?)?;
    /// assert!(flat.iter().all(|z| z.abs() < 1e-18));
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn fit_to_grid(&self, grid: &Grid) -> Result<Vec<f64>, SurfaceError> {
        self.levelled()?.mean_free_on(grid)
    }

    /// The surface with filled holes, minus its plane.
    pub(crate) fn levelled(&self) -> Result<Self, SurfaceError> {
        let mut level = self.clone();
        level.fill_undefined()?;
        level.remove_plane()?;
        Ok(level)
    }

    /// Heights of a [levelled](Self::levelled) surface on `grid`, with zero mean \[m\].
    pub(crate) fn mean_free_on(&self, grid: &Grid) -> Result<Vec<f64>, SurfaceError> {
        let mut heights = self.resample_mirrored(grid)?;
        let mean = heights.iter().sum::<f64>() / heights.len() as f64;
        heights.iter_mut().for_each(|z| *z -= mean);
        Ok(heights)
    }
}
