//! Roughness on the track, and wear, plastic depth and tribofilm of the bodies.

use crate::error::InputError;
use crate::metrics;

/// Root mean square roughness on the track without its form
/// ([`track_roughness`](crate::sim::MixedLubricationSim::track_roughness)) \[m\].
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let roughness = solve_contact(&Scene::azam_2019(32))?.roughness;
/// let [ball, disc] = roughness.rq();
/// assert!((roughness.composite_rq - ball.hypot(disc)).abs() < 1e-15 && disc > ball);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct RoughnessNumbers {
    /// Rq of the ball.
    pub ball_rq: f64,
    /// Rq of the disc.
    pub disc_rq: f64,
    /// `sqrt(ball_rq^2 + disc_rq^2)`.
    pub composite_rq: f64,
}

impl RoughnessNumbers {
    /// From the Rq of ball and disc.
    pub(in crate::sim) fn of([ball_rq, disc_rq]: [f64; 2]) -> Self {
        Self { ball_rq, disc_rq, composite_rq: metrics::composite_rq(ball_rq, disc_rq) }
    }

    /// Rq of ball and disc.
    pub fn rq(&self) -> [f64; 2] {
        [self.ball_rq, self.disc_rq]
    }

    /// `film` over the composite roughness; `None` for smooth surfaces and an unknown film.
    pub(in crate::sim) fn lambda(&self, film: f64) -> Option<f64> {
        let lambda = film / self.composite_rq;
        lambda.is_finite().then_some(lambda)
    }
}

/// A depth or thickness on both bodies \[m\], such as that of the tribofilm.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16).with_tribofilm()).build()?;
/// let record = sim.step(600.0)?;
/// // There is no growth beside the track: the mean over its width is above that over the patch.
/// let film = record.tribofilm;
/// assert!(film.disc_max >= film.disc_in_contact && film.disc_in_contact > film.disc_mean);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct DepthNumbers {
    /// Mean over the patch of the ball.
    pub ball_mean: f64,
    /// Mean over the patch of the disc.
    pub disc_mean: f64,
    /// Largest on the ball.
    pub ball_max: f64,
    /// Largest on the disc.
    pub disc_max: f64,
    /// Mean over the width of the ball's track
    /// ([`mean_on_track`](crate::sim::MixedLubricationSim::mean_on_track)).
    pub ball_in_contact: f64,
    /// Mean over the width of the disc's track.
    pub disc_in_contact: f64,
}

impl DepthNumbers {
    /// From the fields of both bodies, with means `on_track`.
    pub(in crate::sim) fn of(
        [ball, disc]: [&[f64]; 2],
        on_track: impl Fn(&[f64]) -> Result<f64, InputError>,
    ) -> Result<Self, InputError> {
        let mean = |field: &[f64]| field.iter().sum::<f64>() / field.len() as f64;
        let largest = |field: &[f64]| field.iter().copied().fold(0.0, f64::max);
        Ok(Self {
            ball_mean: mean(ball),
            disc_mean: mean(disc),
            ball_max: largest(ball),
            disc_max: largest(disc),
            ball_in_contact: on_track(ball)?,
            disc_in_contact: on_track(disc)?,
        })
    }

    /// Means over the patches of ball and disc.
    pub fn mean(&self) -> [f64; 2] {
        [self.ball_mean, self.disc_mean]
    }

    /// Means over the tracks of ball and disc.
    pub fn in_contact(&self) -> [f64; 2] {
        [self.ball_in_contact, self.disc_in_contact]
    }
}

/// Plastic deformation.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build()?;
/// let (first, second) = (sim.step(10.0)?, sim.step(10.0)?);
/// assert!(second.plastic.volume >= first.plastic.volume, "plastic deformation is permanent");
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct PlasticNumbers {
    /// Plastic volume of both bodies \[m^3\].
    pub volume: f64,
}
