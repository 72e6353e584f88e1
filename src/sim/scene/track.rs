//! How the bodies move past the contact, and how much of the time a point of them is in it.

use crate::error::InputError;
use crate::surface::{Advected, AlongTrack, Fixed, RandomShift, RoughnessMotion};

/// Motion of the roughness in a history, tracks, and the exposure of tribofilms to the contact.
///
/// # Examples
///
/// A disc whose roughness is met at random in both directions, a fresh place at each solve:
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
    /// Seed of the places that a random motion meets.
    #[cfg_attr(feature = "serde", serde(with = "super::tables::seed"))]
    pub seed: u64,
    /// Time that a point of the track is in the contact, of growth and flattening; that of wear is
    /// [`WearSpec::exposure`](super::WearSpec::exposure).
    pub exposure: Exposure,
    /// Radius of the track on the ball \[m\]; needed for [`Exposure::Track`] where the ball moves.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub radius_ball: Option<f64>,
    /// Radius of the track on the disc \[m\]; needed for [`Exposure::Track`] where the disc moves.
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

/// How long a point of the track is in the contact per second of the test.
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
/// // A point of the track is in the contact for a small share of the time.
/// assert!(worn(Exposure::Track)? < 0.01 * worn(Exposure::ContactClock)?);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Exposure {
    /// As if the middle of the track never left the contact: for constants that were fitted to the time of a
    /// test.
    #[default]
    ContactClock,
    /// As long as the contact takes to pass, once a round: for constants that were measured on a point of the
    /// track.
    Track,
}

impl TrackSpec {
    /// The motion that the table names.
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
