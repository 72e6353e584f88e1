//! The Hertz contact of a scene, point or line.

use std::f64::consts::PI;

use crate::analytic::{HertzLine, HertzPoint};
use crate::grid::Grid;
use crate::metrics::Ellipse;

/// Length of a line contact for loads, areas and fields \[m\].
pub(in crate::sim) const LINE_LENGTH: f64 = 1.0;

/// Size, pressure and load of the Hertz contact of the smooth bodies. Those of a line contact are per metre of
/// its length: its load in N is its load per length in N/m.
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scene;
/// let hertz = Scene::azam_2019(32).hertz()?;
/// assert!((hertz.force / (2.0 / 3.0 * hertz.pressure * hertz.area) - 1.0).abs() < 1e-12);
/// assert!((hertz.radius_squared(hertz.half_width_x, 0.0) - 1.0).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct HertzContact {
    /// Semi-axis along x, or along the first axis of the form for a rotated ellipse; half-width of a line contact
    /// \[m\].
    pub half_width_x: f64,
    /// Semi-axis along y, or along the second axis of the form for a rotated ellipse; half a metre for a line
    /// contact \[m\].
    pub half_width_y: f64,
    /// Angle from x to the first axis \[rad\].
    pub angle: f64,
    /// Geometric mean of the semi-axes; half-width of a line contact \[m\].
    pub radius: f64,
    /// Contact area \[m^2\].
    pub area: f64,
    /// Maximum pressure \[Pa\].
    pub pressure: f64,
    /// Load \[N\].
    pub force: f64,
}

impl HertzContact {
    /// Half extents of the contact along x and y \[m\].
    pub fn half_extents(&self) -> [f64; 2] {
        self.ellipse().half_extents()
    }

    /// Squared distance of a point from the center in Hertz units: 1 on the boundary of the contact.
    pub fn radius_squared(&self, x: f64, y: f64) -> f64 {
        self.ellipse().radius_squared(x, y)
    }

    /// Area and load of one period of a strip; those of other grids do not change.
    pub(in crate::sim) fn on(self, grid: &Grid) -> Self {
        let length = grid.contact_length();
        Self { area: self.area * length, force: self.force * length, ..self }
    }

    /// Area and load per metre of the contact of one period of a strip; those of other grids do not change.
    pub(in crate::sim) fn per_metre(self, grid: &Grid) -> Self {
        let length = grid.contact_length();
        Self { area: self.area / length, force: self.force / length, ..self }
    }

    /// The boundary of the contact.
    pub(in crate::sim) fn ellipse(&self) -> Ellipse {
        Ellipse::turned(self.half_width_x, self.half_width_y, self.angle)
    }
}

impl From<HertzPoint> for HertzContact {
    fn from(point: HertzPoint) -> Self {
        let HertzPoint { half_width_x, half_width_y, pressure, force, .. } = point;
        Self {
            half_width_x,
            half_width_y,
            angle: 0.0,
            radius: (half_width_x * half_width_y).sqrt(),
            area: PI * half_width_x * half_width_y,
            pressure,
            force,
        }
    }
}

impl From<HertzLine> for HertzContact {
    fn from(line: HertzLine) -> Self {
        let half_width_x = line.half_width;
        Self {
            half_width_x,
            half_width_y: 0.5 * LINE_LENGTH,
            angle: 0.0,
            radius: half_width_x,
            area: 2.0 * half_width_x * LINE_LENGTH,
            pressure: line.pressure,
            force: line.force * LINE_LENGTH,
        }
    }
}
