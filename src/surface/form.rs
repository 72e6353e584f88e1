//! The smooth shape of the contacting bodies.

use std::f64::consts::FRAC_PI_2;

use crate::error::InputError;
use crate::grid::Grid;

/// Undeformed gap between the smooth bodies, `x^2/(2 Rx) + y^2/(2 Ry)` (for a cylinder only the first term): the
/// parabolic approximation, valid for contacts that are small compared with the radii.
///
/// For two curved bodies use the equivalent radii, `1/R = 1/R1 + 1/R2` in each direction. An ellipsoid may be rotated
/// by an angle about the normal, for entrainment (along x) oblique to its axes: x and y in its gap are then its own
/// axes.
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
    /// Different curvatures along two perpendicular axes.
    Ellipsoid {
        /// Radius of curvature along the first axis, x without rotation \[m\].
        radius_x: f64,
        /// Radius of curvature along the second axis, y without rotation \[m\].
        radius_y: f64,
        /// Angle from x to the first axis, positive towards y \[rad\].
        #[cfg_attr(feature = "serde", serde(skip_serializing_if = "is_zero"))]
        angle: f64,
    },
    /// Parallel cylinders along y: a line contact, solved on one row of nodes.
    Cylinder {
        /// Radius \[m\].
        radius: f64,
    },
}

impl Form {
    /// Checks radii and angle.
    ///
    /// # Errors
    /// [`InputError::Value`] naming a radius that is not finite and positive, or an angle above a right angle.
    pub fn validate(&self) -> Result<(), InputError> {
        match *self {
            Self::Sphere { radius } | Self::Cylinder { radius } => {
                let requirement = "finite and > 0: it is that of both bodies together. A concave body has a negative radius in `radii` = [ball, disc]";
                InputError::require(radius.is_finite() && radius > 0.0, "form.radius", radius, requirement)
            }
            Self::Ellipsoid { radius_x, radius_y, angle } => {
                InputError::require_positive("form.radius_x", radius_x)?;
                InputError::require_positive("form.radius_y", radius_y)?;
                let range = "between -pi/2 and pi/2 (plain numbers are in rad; \"30 deg\" is 30 degrees)";
                InputError::require(angle.abs() <= FRAC_PI_2 * (1.0 + 1e-9), "form.angle", angle, range)
            }
        }
    }

    /// Radii of curvature along x and y \[m\], for a rotated ellipsoid along its own axes; infinite along a cylinder.
    #[must_use]
    pub fn radii(&self) -> (f64, f64) {
        match *self {
            Self::Sphere { radius } => (radius, radius),
            Self::Cylinder { radius } => (radius, f64::INFINITY),
            Self::Ellipsoid { radius_x, radius_y, .. } => (radius_x, radius_y),
        }
    }

    /// Angle from x to the first axis \[rad\]; zero except for ellipsoids.
    #[must_use]
    pub fn angle(&self) -> f64 {
        match *self {
            Self::Ellipsoid { angle, .. } => angle,
            _ => 0.0,
        }
    }

    /// Radii of curvature of the sections along and across entrainment \[m\], `1/R_e = cos^2/R_x + sin^2/R_y` and
    /// `1/R_s = sin^2/R_x + cos^2/R_y`: the input of film formulas for a rotated ellipsoid.
    #[must_use]
    pub fn radii_of_entrainment(&self) -> (f64, f64) {
        let (radius_x, radius_y) = self.radii();
        if self.angle() == 0.0 {
            return (radius_x, radius_y);
        }
        let (sin, cos) = self.angle().sin_cos();
        let section = |x: f64, y: f64| 1.0 / (x * x / radius_x + y * y / radius_y);
        (section(cos, sin), section(sin, cos))
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
        let (sin, cos) = self.angle().sin_cos();
        for (gap, (x, y)) in out.iter_mut().zip(grid.nodes()) {
            let (x, y) = (cos * x + sin * y, cos * y - sin * x);
            *gap = 0.5 * (x * x / radius_x + y * y / radius_y);
        }
        Ok(())
    }
}

/// Whether the angle is the default and not written.
#[cfg(feature = "serde")]
fn is_zero(angle: &f64) -> bool {
    *angle == 0.0
}
