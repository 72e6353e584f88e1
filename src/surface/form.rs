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
        angle: f64,
    },
    /// Parallel cylinders along y: a line contact, solved on one row of nodes.
    Cylinder {
        /// Radius \[m\].
        radius: f64,
    },
    /// Two curved bodies. A concave one has a negative radius, a straight one an infinite radius.
    Bodies {
        /// Radii of ball and disc along the first axis, x without rotation \[m\].
        x: [f64; 2],
        /// Radii along the second axis \[m\]; both infinite for a line contact.
        y: [f64; 2],
        /// Angle from x to the first axis, positive towards y \[rad\].
        angle: f64,
    },
}

/// Radius \[m\] of a body on a flat with the gap between two bodies, `1/R = 1/R_1 + 1/R_2`.
pub(crate) fn reduced_radius([first, second]: [f64; 2]) -> f64 {
    match [first, second].map(f64::is_infinite) {
        [_, true] => first,
        [true, _] => second,
        _ => 1.0 / (1.0 / first + 1.0 / second),
    }
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
            Self::Bodies { .. } => self.reduced().validate(),
        }
    }

    /// The form with the reduced radius of each section in place of those of both bodies.
    #[must_use]
    pub fn reduced(&self) -> Self {
        let Self::Bodies { x, y, angle } = *self else { return *self };
        let (radius_x, radius_y) = self.radii();
        if self.is_line() {
            Self::Cylinder { radius: radius_x }
        } else if angle == 0.0 && x.iter().zip(y).all(|(along, across)| along.total_cmp(&across).is_eq()) {
            Self::Sphere { radius: radius_x }
        } else {
            Self::Ellipsoid { radius_x, radius_y, angle }
        }
    }

    /// Radii of curvature along x and y \[m\], for a rotated ellipsoid along its own axes; infinite along a cylinder.
    #[must_use]
    pub fn radii(&self) -> (f64, f64) {
        match *self {
            Self::Sphere { radius } => (radius, radius),
            Self::Cylinder { radius } => (radius, f64::INFINITY),
            Self::Ellipsoid { radius_x, radius_y, .. } => (radius_x, radius_y),
            Self::Bodies { x, y, .. } => (reduced_radius(x), reduced_radius(y)),
        }
    }

    /// Angle from x to the first axis \[rad\]; zero except for ellipsoids and bodies.
    #[must_use]
    pub fn angle(&self) -> f64 {
        match *self {
            Self::Ellipsoid { angle, .. } | Self::Bodies { angle, .. } => angle,
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
        match self {
            Self::Bodies { y, .. } => y.iter().all(|radius| radius.is_infinite()),
            other => matches!(other, Self::Cylinder { .. }),
        }
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

/// The table `[form]` of a form: kind, radii of both bodies or the radius of each section, angle.
#[cfg(feature = "serde")]
#[derive(Default, serde::Serialize)]
struct Table {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    radius: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    radii: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    radius_x: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    radii_x: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    radius_y: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    radii_y: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angle: Option<f64>,
}

#[cfg(feature = "serde")]
impl serde::Serialize for Form {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let angle = Some(self.angle()).filter(|angle| *angle != 0.0);
        // Files have no infinite radii: a section with a straight body has the radius of the other one.
        let pair =
            |radii: [f64; 2]| Some(radii).filter(|radii| radii.iter().all(|radius| radius.is_finite()));
        let [x, y] = match *self {
            Self::Bodies { x, y, .. } => [pair(x), pair(y)],
            _ => [None; 2],
        };
        let single = |pair: Option<[f64; 2]>, radius: f64| if pair.is_some() { None } else { Some(radius) };
        let table = match self.reduced() {
            Self::Sphere { radius } => {
                Table { kind: "sphere", radius: single(x, radius), radii: x, ..Table::default() }
            }
            Self::Cylinder { radius } => {
                Table { kind: "cylinder", radius: single(x, radius), radii: x, ..Table::default() }
            }
            Self::Ellipsoid { .. } | Self::Bodies { .. } => {
                let (radius_x, radius_y) = self.radii();
                let (radius_x, radius_y) = (single(x, radius_x), single(y, radius_y));
                Table {
                    kind: "ellipsoid",
                    radius_x,
                    radii_x: x,
                    radius_y,
                    radii_y: y,
                    angle,
                    ..Table::default()
                }
            }
        };
        table.serialize(serializer)
    }
}
