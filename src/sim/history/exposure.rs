//! Exposure time of the nodes under the contact in a step.
//!
//! A point of a track of length `l` passes the contact once per revolution. On the center line, `y = 0`, it is
//! in the contact of half-width `a` for the fraction `2a/l` of the time; elsewhere the chord takes the place of
//! `2a`. The patch of a body is a section of the track of length `L`, and all its positions meet the contact
//! equally often: in the simulation its center line is in the contact for the fraction `2a/L` of the steps,
//! independent of `l`. A node in the contact of a solve is therefore exposed for
//!
//! | exposure | body that moves along x | that stays |
//! |---|---|---|
//! | contact clock | `dt L/(2a)` | `dt` |
//! | track | `dt L/l` | `dt` at rest, else `dt 2a/l` |
//!
//! Averaged over the steps, the center line of the track is then exposed for `dt` per step (contact clock) or
//! `dt 2a/l` (track), in a box of any length. For roughness at random positions in both directions,
//! `L/(2a)` is replaced by `L_x L_y/(pi a b)`, with the area of the contact, of a point contact. A body at rest relative to the
//! contact (slide-roll ratio 2 or -2) has no track: its nodes in the contact stay there.
//!
//! Growth uses `track.exposure`, wear `wear.exposure`. The worn volume is that of the contact and does not
//! depend on the exposure: in a step it is `dt` times the integral of the wear rate, with Archard's law
//! `K F u_s dt`. The patch holds the fraction `L/l` (track) or `L/(2a)` (contact clock) of it.
//!
//! Plastic indentation does not depend on time: each passage leaves one indentation. In a step so short that a
//! point passes less than once per solve at a track position, that fraction of the indentation is applied. A
//! body at rest, or one whose passages are resolved by the steps, takes the full indentation each time.

use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::operating_schedule::OperatingSchedule;
use crate::sim::scene::{self, Scene, TrackSpec};
use crate::surface::{PointRevisit, RoughnessMotion};
use crate::wear::track_duty_factor;

/// Time weights of one body: effect of a step of one second on its nodes under the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::sim) struct TimeWeight {
    /// Time in the contact per second \[1\].
    pub(in crate::sim) rate: f64,
    /// Passages per second that a solve represents \[1/s\]; infinite if every solve applies its full indentation.
    passages: f64,
}

impl TimeWeight {
    /// Fraction of the plastic indentation of a solve applied in a step of `time_step` \[s\].
    pub(in crate::sim) fn indentation_share(&self, time_step: f64) -> f64 {
        (self.passages * time_step).min(1.0)
    }
}

/// Checks the tracks of a scene under all conditions of its schedule.
///
/// # Errors
/// A track shorter than the patch or than the contact under the largest load; a missing track that the
/// exposure needs.
pub(in crate::sim) fn validate(
    scene: &Scene,
    operating_schedule: &OperatingSchedule,
    grid: &Grid,
) -> Result<(), InputError> {
    scene.track.validate()?;
    let by_wear = scene.wear.is_some_and(|wear| wear.exposure == scene::Exposure::Track);
    let needed_by = match scene.track.exposure {
        _ if by_wear => Some("wear.exposure"),
        scene::Exposure::Track => Some("track.exposure"),
        scene::Exposure::ContactClock => None,
    };
    let [_, largest_load] = operating_schedule.loads();
    let lengths = [
        ("patch", grid.size_x()),
        ("contact", 2.0 * scene.hertz_under(largest_load)?.ellipse().half_chord_x()),
    ];
    let radii = [("ball", scene.track.radius_ball), ("disc", scene.track.radius_disc)];
    for ((body, radius), moves) in radii.into_iter().zip(operating_schedule.moving()) {
        let field = format!("track.radius_{body}");
        match radius {
            Some(radius) => {
                let track = track_length(radius);
                if let Some((part, length)) = lengths.into_iter().find(|(_, length)| track < *length) {
                    let reason = format!(
                        "a track of {track:e} m is shorter than the {part}, which is {length:e} m long"
                    );
                    return Err(InputError::Conflict { field: format!("{field} = {radius:e}"), reason });
                }
            }
            None => {
                if let Some(key) = needed_by.filter(|_| moves) {
                    let reason = format!("is missing; {key} = \"track\" needs it");
                    return Err(InputError::Conflict { field, reason });
                }
            }
        }
    }
    Ok(())
}

/// Time weights of ball and disc that move at `speeds` \[m/s\] by `motion`, on `track` under `exposure`.
///
/// # Errors
/// A radius that is not finite and positive.
pub(in crate::sim) fn time_weight(
    (track, exposure): (&TrackSpec, scene::Exposure),
    motion: &dyn RoughnessMotion,
    grid: &Grid,
    hertz: &HertzContact,
    speeds: [f64; 2],
) -> Result<[TimeWeight; 2], InputError> {
    let half_chord = hertz.ellipse().half_chord_x();
    let of = |radius: Option<f64>, speed: f64| {
        let visits = visits(motion, speed);
        // Ratio of the patch to the part of it in the contact.
        let spread = match visits {
            PointRevisit::Permanent => 1.0,
            PointRevisit::Patch if grid.has_side_edges() => {
                grid.size_x() * grid.size_y()
                    / (std::f64::consts::PI * hertz.half_width_x * hertz.half_width_y)
            }
            PointRevisit::Passing | PointRevisit::Track | PointRevisit::Patch => {
                grid.size_x() / (2.0 * half_chord)
            }
        };
        let share = match (exposure, radius) {
            (scene::Exposure::Track, Some(radius)) if speed != 0.0 => track_duty_factor(half_chord, radius)?,
            _ => 1.0,
        };
        // A point of a patch smaller than the contact is always in the contact.
        let rate = share * spread.max(1.0);
        let passages = match visits {
            PointRevisit::Permanent | PointRevisit::Passing => f64::INFINITY,
            PointRevisit::Track | PointRevisit::Patch => rate * speed.abs() / (2.0 * half_chord),
        };
        Ok(TimeWeight { rate, passages })
    };
    Ok([of(track.radius_ball, speeds[0])?, of(track.radius_disc, speeds[1])?])
}

/// Revisits of points of a body that moves at `speed` \[m/s\] by `motion`. At zero speed the body stays,
/// whatever the motion.
pub(in crate::sim) fn visits(motion: &dyn RoughnessMotion, speed: f64) -> PointRevisit {
    if speed == 0.0 { PointRevisit::Permanent } else { motion.visits(speed) }
}

/// Length of a track of this `radius` \[m\]: `2 pi radius`.
fn track_length(radius: f64) -> f64 {
    2.0 * std::f64::consts::PI * radius
}
