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
    /// Mean depth over the width of the ball's track, `|y| <= a`
    /// ([`mean_on_track`](crate::sim::MixedLubricationSim::mean_on_track)).
    pub ball_in_contact: f64,
    /// Mean depth over the width of the disc's track.
    pub disc_in_contact: f64,
    /// Volume worn off the ball since the start of the history
    /// ([`Body::worn_volume`](crate::sim::Body::worn_volume)).
    pub ball_volume: f64,
    /// Volume worn off the disc.
    pub disc_volume: f64,
}

impl WearNumbers {
    /// From depths and volumes.
    pub(in crate::sim) fn of(depth: DepthNumbers, [ball_volume, disc_volume]: [f64; 2]) -> Self {
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
