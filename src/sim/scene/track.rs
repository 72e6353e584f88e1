//! Motion of the bodies through the contact, and the exposure of their points to it.

use crate::error::InputError;
use crate::surface::{Advected, AlongTrack, Fixed, RandomShift, RoughnessMotion};

/// Motion of the roughness in a history, tracks, and exposure of tribofilms.
///
/// # Examples
///
/// A disc whose roughness has a new random position in both directions at each solve:
///
/// ```
/// use stribeck::sim::scene::TrackMotion;
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let mut scene = Scene::azam_2019(16);
/// (scene.track.motion, scene.track.seed) = (TrackMotion::Random, 7);
/// let sim = MixedLubricationSim::builder(scene).build()?;
/// assert!(format!("{:?}", sim.motion()).contains('7'));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct TrackSpec {
    /// How the roughness moves from solve to solve.
    pub motion: TrackMotion,
    /// Seed of random positions.
    #[cfg_attr(feature = "serde", serde(with = "super::tables::seed"))]
    pub seed: u64,
    /// Exposure of a point of the track, for growth and plastic indentation; that of wear is
    /// [`WearSpec::exposure`](super::WearSpec::exposure).
    pub exposure: Exposure,
    /// Radius of the track on the ball \[m\]; required for [`Exposure::Track`] if the ball moves.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub radius_ball: Option<f64>,
    /// Radius of the track on the disc \[m\]; required for [`Exposure::Track`] if the disc moves.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub radius_disc: Option<f64>,
}

/// How the roughness moves from solve to solve; see [`RoughnessMotion`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum TrackMotion {
    /// [`Fixed`].
    AtRest,
    /// [`Advected`].
    Carried,
    /// [`AlongTrack`].
    #[default]
    AlongTrack,
    /// [`RandomShift`].
    Random,
}

/// Time in the contact of a point of the track per second of the test.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::Exposure;
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let worn = |exposure| -> Result<f64, stribeck::sim::SimError> {
///     let mut scene = Scene::azam_2019(16);
///     scene.wear = scene.wear.map(|wear| wear.with_exposure(exposure));
///     (scene.track.radius_ball, scene.track.radius_disc) = (Some(9e-3), Some(20e-3));
///     Ok(MixedLubricationSim::builder(scene).build()?.step(10.0)?.wear.disc_mean)
/// };
/// // A point of the track is in the contact for a small fraction of the time.
/// assert!(worn(Exposure::Track)? < 0.01 * worn(Exposure::ContactClock)?);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Exposure {
    /// As if the center line of the track were always in the contact: for constants fitted to the duration of a
    /// test.
    #[default]
    ContactClock,
    /// One transit of the contact per revolution: for constants measured at a point of the track.
    Track,
}

impl TrackSpec {
    /// The motion named in the table.
    pub fn roughness_motion(&self) -> Box<dyn RoughnessMotion> {
        match self.motion {
            TrackMotion::AtRest => Box::new(Fixed),
            TrackMotion::Carried => Box::new(Advected),
            TrackMotion::AlongTrack => Box::new(AlongTrack { seed: self.seed }),
            TrackMotion::Random => Box::new(RandomShift { seed: self.seed }),
        }
    }

    /// Checks both radii, used or not.
    ///
    /// # Errors
    /// A radius that is not finite and positive.
    pub fn validate(&self) -> Result<(), InputError> {
        for (field, radius) in
            [("track.radius_ball", self.radius_ball), ("track.radius_disc", self.radius_disc)]
        {
            if let Some(radius) = radius {
                InputError::require_positive(field, radius)?;
            }
        }
        Ok(())
    }
}
