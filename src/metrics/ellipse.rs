//! The Hertz ellipse, the reference of contact statistics.

use std::f64::consts::PI;

use crate::error::InputError;

/// An ellipse about the origin at an angle to the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ellipse {
    /// Semi-axes \[m\].
    semi_axes: [f64; 2],
    /// Sine of the angle of the first semi-axis to x.
    sin: f64,
    /// Cosine of that angle.
    cos: f64,
}

impl Ellipse {
    /// Ellipse with semi-axes \[m\] along x and y.
    ///
    /// # Errors
    /// A semi-axis that is not finite and positive.
    pub(super) fn upright(a_x: f64, a_y: f64) -> Result<Self, InputError> {
        InputError::require_positive("a_x", a_x)?;
        InputError::require_positive("a_y", a_y)?;
        Ok(Self::turned(a_x, a_y, 0.0))
    }

    /// Ellipse with the first semi-axis \[m\] at `angle` \[rad\] to x.
    pub(crate) fn turned(a_x: f64, a_y: f64, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { semi_axes: [a_x, a_y], sin, cos }
    }

    /// Coordinates along the semi-axes, normalized by them.
    pub(crate) fn normalised(&self, x: f64, y: f64) -> [f64; 2] {
        let [a, b] = self.semi_axes;
        [(self.cos * x + self.sin * y) / a, (self.cos * y - self.sin * x) / b]
    }

    /// Squared normalized radius: 0 at the center, 1 on the ellipse.
    pub(crate) fn radius_squared(&self, x: f64, y: f64) -> f64 {
        let [along, across] = self.normalised(x, y);
        along.powi(2) + across.powi(2)
    }

    /// `pi a b` \[m^2\].
    pub(super) fn area(&self) -> f64 {
        PI * self.semi_axes[0] * self.semi_axes[1]
    }

    /// Half the extent along x and y \[m\].
    pub(crate) fn half_extents(&self) -> [f64; 2] {
        let [a, b] = self.semi_axes;
        [(a * self.cos).hypot(b * self.sin), (a * self.sin).hypot(b * self.cos)]
    }

    /// Half the chord through the center along x \[m\].
    pub(crate) fn half_chord_x(&self) -> f64 {
        let [a, b] = self.semi_axes;
        a / self.cos.hypot(self.sin * a / b)
    }
}
