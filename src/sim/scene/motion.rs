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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "MotionTable"))]
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
    /// Motion of the roughness during a single contact.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "RoughnessState::is_at_rest"))]
    pub roughness: RoughnessState,
    /// Length of film over which the means of a passage are taken \[m\]; absent: the length of the box along x. It needs
    /// [`RoughnessState::Moving`].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub passage: Option<f64>,
}

/// Motion of the roughness during a single contact.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::RoughnessState;
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(24);
/// (scene.motion.entrainment_speed, scene.plastic) = (5.0, None);
/// let rest = solve_contact(&scene)?;
/// scene.motion.roughness = RoughnessState::Moving;
/// let moving = solve_contact(&scene)?;
/// assert!(moving.film.mean_central > rest.film.mean_central);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum RoughnessState {
    /// The roughness of both bodies rests in the contact, whatever their speeds: one steady contact.
    #[default]
    AtRest,
    /// The roughness of each body moves at its speed: a transient contact with squeeze and its means, see
    /// [`SimBuilder::solve_passage`](crate::sim::SimBuilder::solve_passage).
    Moving,
}

impl RoughnessState {
    /// Whether the roughness rests.
    pub fn is_at_rest(&self) -> bool {
        *self == Self::AtRest
    }
}

impl Motion {
    /// An entrainment speed \[m/s\] and a slide-roll ratio.
    pub const fn new(entrainment_speed: f64, slide_roll_ratio: f64) -> Self {
        Self {
            entrainment_speed,
            slide_roll_ratio,
            spin_radius: None,
            roughness: RoughnessState::AtRest,
            passage: None,
        }
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

/// `[motion]` as written in a scene file.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct MotionTable {
    entrainment_speed: Option<f64>,
    slide_roll_ratio: Option<f64>,
    ball_speed: Option<f64>,
    disc_speed: Option<f64>,
    spin_radius: Option<f64>,
    #[serde(default)]
    roughness: RoughnessState,
    passage: Option<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<MotionTable> for Motion {
    type Error = String;

    fn try_from(table: MotionTable) -> Result<Self, String> {
        let MotionTable { entrainment_speed, slide_roll_ratio, ball_speed, disc_speed, .. } = table;
        let MotionTable { spin_radius, roughness, passage, .. } = table;
        if passage.is_some() && roughness.is_at_rest() {
            return Err(
                "`passage` is a length of surfaces in motion; add `roughness = \"moving\"`".to_owned()
            );
        }
        let given = |speed: Option<f64>, ratio: Option<f64>| Self {
            entrainment_speed: speed.unwrap_or_default(),
            slide_roll_ratio: ratio.unwrap_or_default(),
            spin_radius,
            roughness,
            passage,
        };
        let (ball, disc) = match (ball_speed, disc_speed) {
            (None, None) => return Ok(given(entrainment_speed, slide_roll_ratio)),
            (Some(ball), Some(disc)) => (ball, disc),
            (Some(_), None) => return Err("missing field `disc_speed`, it goes with `ball_speed`".to_owned()),
            (None, Some(_)) => return Err("missing field `ball_speed`, it goes with `disc_speed`".to_owned()),
        };
        if entrainment_speed.is_some() || slide_roll_ratio.is_some() {
            return Err("`ball_speed` and `disc_speed` replace `entrainment_speed` and `slide_roll_ratio`; give one pair"
                .to_owned());
        }
        let mean = 0.5 * ball + 0.5 * disc;
        let sliding = ball - disc;
        if sliding.abs() > 0.0 && mean.abs() <= f64::EPSILON * ball.abs() {
            return Err(format!(
                "`ball_speed` = {ball} m/s and `disc_speed` = {disc} m/s have the mean 0: no oil is entrained, and there \
                 is no slide-roll ratio"
            ));
        }
        let ratio = if sliding.abs() > 0.0 { sliding / mean } else { 0.0 };
        Ok(given(Some(mean), Some(ratio)))
    }
}
