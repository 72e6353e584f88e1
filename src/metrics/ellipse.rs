//! The Hertz ellipse that numbers of a contact refer to.

use std::f64::consts::PI;

use crate::error::InputError;

/// An ellipse about the origin, its axes turned by an angle from x and y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ellipse {
    /// Along its own axes \[m\].
    semi_axes: [f64; 2],
    /// Sine of the angle that the first is turned against x.
    sin: f64,
    /// Cosine of it.
    cos: f64,
}

impl Ellipse {
    /// Of semi-axes \[m\] along x and y.
    ///
    /// # Errors
    /// A semi-axis that is not finite and positive.
    pub(super) fn upright(a_x: f64, a_y: f64) -> Result<Self, InputError> {
        InputError::require_positive("a_x", a_x)?;
        InputError::require_positive("a_y", a_y)?;
        Ok(Self::turned(a_x, a_y, 0.0))
    }

    /// Of semi-axes \[m\], the first of them at `angle` \[rad\] from x.
    pub(crate) fn turned(a_x: f64, a_y: f64, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { semi_axes: [a_x, a_y], sin, cos }
    }

    /// The point in coordinates along the axes, each over its semi-axis.
    pub(crate) fn normalised(&self, x: f64, y: f64) -> [f64; 2] {
        let [a, b] = self.semi_axes;
        [(self.cos * x + self.sin * y) / a, (self.cos * y - self.sin * x) / b]
    }

    /// 0 in the middle, 1 on the ellipse.
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

    /// Half the chord through the middle along x \[m\].
    pub(crate) fn half_chord_x(&self) -> f64 {
        let [a, b] = self.semi_axes;
        a / self.cos.hypot(self.sin * a / b)
    }
}
