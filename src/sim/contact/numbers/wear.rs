//! Wear of both bodies.

use super::bodies::DepthNumbers;

/// Worn depth \[m\] and volume \[m^3\] of both bodies.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build()?;
/// let record = sim.step(600.0)?;
/// // There is no wear beside the track: the mean over its width is above that over the patch.
/// assert!(record.wear.disc_in_contact > record.wear.disc_mean && record.wear.disc_mean > 0.0);
/// // K F s/H for 54.07 N and 5 mm/s for ten minutes, on each body.
/// let archard = 5.45e-8 * record.load * 0.005 * 600.0 / 6e9;
/// assert!(record.wear.volume().iter().all(|volume| (volume / archard - 1.0).abs() < 1e-4));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct WearNumbers {
    /// Mean depth over the patch of the ball.
    pub ball_mean: f64,
    /// Mean depth over the patch of the disc.
    pub disc_mean: f64,
    /// Largest depth on the ball.
    pub ball_max: f64,
    /// Largest depth on the disc.
    pub disc_max: f64,
    /// Mean depth over the width of the ball's track
    /// ([`mean_on_track`](crate::sim::MixedLubricationSim::mean_on_track)).
    pub ball_in_contact: f64,
    /// Mean depth over the width of the disc's track.
    pub disc_in_contact: f64,
    /// Volume worn off the ball since the start of the history
    /// ([`Body::worn_volume`](crate::sim::Body::worn_volume)).
    pub ball_volume: f64,
    /// Volume worn off the disc.
    pub disc_volume: f64,
    /// Width of the scar of the ball: of the track across the motion, of a cylinder at rest along it. `None` for a
    /// cylinder that moves ([`Body`](crate::sim::Body), worn everywhere).
    pub ball_scar_width: Option<f64>,
    /// Width of the scar of the disc.
    pub disc_scar_width: Option<f64>,
    /// Largest depth of the profile of the ball's scar.
    pub ball_scar_depth: f64,
    /// Largest depth of the profile of the disc's scar.
    pub disc_scar_depth: f64,
}

/// Width and depth of a worn scar \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::sim) struct Scar {
    /// Distance of the points on both sides where the profile has a twentieth of its largest depth.
    pub(in crate::sim) width: Option<f64>,
    /// Largest depth of the profile.
    pub(in crate::sim) depth: f64,
}

impl Scar {
    /// Share of the largest depth at the edges of a scar.
    const EDGE: f64 = 0.05;

    /// The scar of a profile of `count` values `depth` \[m\] at the distance `spacing` \[m\].
    pub(in crate::sim) fn of_profile(count: usize, spacing: f64, depth: impl Fn(usize) -> f64) -> Self {
        let deepest = (0..count).map(&depth).fold(0.0, f64::max);
        let edge = Self::EDGE * deepest;
        let is_worn = |k: &usize| depth(*k) > edge;
        let (Some(first), Some(last)) = ((0..count).find(is_worn), (0..count).rev().find(is_worn)) else {
            return Self { width: Some(0.0), depth: 0.0 };
        };
        // Linear between the last worn node and the next one; the outer half of a cell at the edge of the box.
        let beyond = |inner: usize, outer: Option<usize>| {
            let outer = outer.filter(|k| *k < count).map(&depth);
            outer.map_or(0.5, |outer| (depth(inner) - edge) / (depth(inner) - outer))
        };
        let cells =
            (last - first) as f64 + beyond(first, first.checked_sub(1)) + beyond(last, last.checked_add(1));
        Self { width: Some(spacing * cells), depth: deepest }
    }
}

impl WearNumbers {
    /// From depths, volumes and scars.
    pub(in crate::sim) fn of(
        depth: DepthNumbers,
        [ball_volume, disc_volume]: [f64; 2],
        [ball_scar, disc_scar]: [Scar; 2],
    ) -> Self {
        let DepthNumbers { ball_mean, disc_mean, ball_max, disc_max, ball_in_contact, disc_in_contact } =
            depth;
        Self {
            ball_mean,
            disc_mean,
            ball_max,
            disc_max,
            ball_in_contact,
            disc_in_contact,
            ball_volume,
            disc_volume,
            ball_scar_width: ball_scar.width,
            disc_scar_width: disc_scar.width,
            ball_scar_depth: ball_scar.depth,
            disc_scar_depth: disc_scar.depth,
        }
    }

    /// Mean depths over the patches of ball and disc.
    pub fn mean(&self) -> [f64; 2] {
        [self.ball_mean, self.disc_mean]
    }

    /// Mean depths over the tracks of ball and disc.
    pub fn in_contact(&self) -> [f64; 2] {
        [self.ball_in_contact, self.disc_in_contact]
    }

    /// Volumes worn off ball and disc.
    pub fn volume(&self) -> [f64; 2] {
        [self.ball_volume, self.disc_volume]
    }
}
