//! The smooth shape of the contacting bodies.

use crate::error::InputError;
use crate::grid::Grid;

/// Undeformed gap between the smooth bodies, `x^2/(2 Rx) + y^2/(2 Ry)` (of a cylinder the first term alone):
/// the parabolic approximation, valid while the contact is small against the radii.
///
/// With two curved bodies the radii are the equivalent ones, `1/R = 1/R1 + 1/R2` in each direction.
///
/// ```
/// use stribeck::{Grid, surface::Form};
/// let grid = Grid::centred(3, 1, 1e-4, 1e-4)?;
/// let mut gap = [0.0; 3];
/// Form::Sphere { radius: 9.525e-3 }.gap_into(&grid, &mut gap)?;
/// assert!(gap[1].abs() < 1e-18);
/// assert!((gap[2] - 1e-8 / (2.0 * 9.525e-3)).abs() < 1e-15);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(tag = "kind", rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Form {
    /// A ball on a flat.
    Sphere {
        /// Radius \[m\].
        radius: f64,
    },
    /// Different curvature along x and y.
    Ellipsoid {
        /// Radius of curvature along x \[m\].
        radius_x: f64,
        /// Radius of curvature along y \[m\].
        radius_y: f64,
    },
    /// Parallel cylinders along y: a line contact, solved on one row of nodes.
    Cylinder {
        /// Radius \[m\].
        radius: f64,
    },
}

impl Form {
    /// Checks the radii.
    ///
    /// # Errors
    /// [`InputError::Value`] naming the radius that is not finite and positive.
    pub fn validate(&self) -> Result<(), InputError> {
        match *self {
            Self::Sphere { radius } | Self::Cylinder { radius } => {
                InputError::require_positive("form.radius", radius)
            }
            Self::Ellipsoid { radius_x, radius_y } => {
                InputError::require_positive("form.radius_x", radius_x)?;
                InputError::require_positive("form.radius_y", radius_y)
            }
        }
    }

    /// Radii of curvature along x and y \[m\]; infinite along a cylinder.
    #[must_use]
    pub fn radii(&self) -> (f64, f64) {
        match *self {
            Self::Sphere { radius } => (radius, radius),
            Self::Cylinder { radius } => (radius, f64::INFINITY),
            Self::Ellipsoid { radius_x, radius_y } => (radius_x, radius_y),
        }
    }

    /// Whether the contact is a line.
    #[must_use]
    pub fn is_line(&self) -> bool {
        matches!(self, Self::Cylinder { .. })
    }

    /// Overwrites `out` \[m\] with the undeformed gap at the nodes of `grid`, zero at the origin.
    ///
    /// # Errors
    /// See [`Form::validate`]; an `out` that does not fit the grid.
    pub fn gap_into(&self, grid: &Grid, out: &mut [f64]) -> Result<(), InputError> {
        self.validate()?;
        InputError::require_len("out", out, grid.len())?;
        let (radius_x, radius_y) = self.radii();
        for (gap, (x, y)) in out.iter_mut().zip(grid.nodes()) {
            *gap = 0.5 * (x * x / radius_x + y * y / radius_y);
        }
        Ok(())
    }
}
