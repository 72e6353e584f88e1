//! Speeds of the surfaces at the point of first contact, and spin.
//!
//! With the speeds `u1` of the ball and `u2` of the disc along x, the entrainment speed is `(u1 + u2)/2` and
//! the slide-roll ratio `(u1 - u2)` over it.

/// Speeds of the surfaces along x.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::Motion;
/// let motion = Motion::new(0.1, 0.5);
/// assert_eq!(motion.surface_speeds(), [0.125, 0.07500000000000001]);
/// assert!((motion.sliding_speed() - 0.05).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct Motion {
    /// Mean of the two surface speeds \[m/s\].
    pub entrainment_speed: f64,
    /// Sliding speed over entrainment speed; positive if the ball is faster.
    pub slide_roll_ratio: f64,
    /// Radius of spin `R` \[m\]: the mean motion of the surfaces is a rotation about the point (0, `R`), with
    /// `u = U (1 - y/R)` along x and `v = U x/R` along y. The point must be outside the box. Absent: no spin.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub spin_radius: Option<f64>,
}

impl Motion {
    /// An entrainment speed \[m/s\] and a slide-roll ratio.
    pub const fn new(entrainment_speed: f64, slide_roll_ratio: f64) -> Self {
        Self { entrainment_speed, slide_roll_ratio, spin_radius: None }
    }

    /// Sliding speed, never negative \[m/s\].
    pub fn sliding_speed(&self) -> f64 {
        (self.entrainment_speed * self.slide_roll_ratio).abs()
    }

    /// Speeds of ball and disc \[m/s\].
    pub fn surface_speeds(&self) -> [f64; 2] {
        let half = 0.5 * self.slide_roll_ratio;
        [self.entrainment_speed * (1.0 + half), self.entrainment_speed * (1.0 - half)]
    }
}
