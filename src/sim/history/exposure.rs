//! How long the nodes under the contact age in a step.
//!
//! A point of the track, which is `l` long, meets the contact once a round. In the middle, `y = 0`, it is in
//! the contact of the half-width `a` for the share `2a/l` of the time, elsewhere for that of the chord. The
//! patch of a body is a piece of the track, `L` long, whose places the contact meets equally often: in the
//! simulation the middle is in the contact for the share `2a/L` of the steps, whatever `l` is. A node under
//! the contact of a solve therefore ages for
//!
//! | exposure | body that moves along x | that stays |
//! |---|---|---|
//! | contact clock | `dt L/(2a)` | `dt` |
//! | track | `dt L/l` | `dt` at rest, else `dt 2a/l` |
//!
//! so that the middle of the track ages by `dt` in a step on average (contact clock), or by `dt 2a/l`
//! (track), in a box of any length. Roughness that is met at random in both directions has `L_x L_y/(pi a b)`
//! in place of `L/(2a)`, with the area of the contact. A body at rest relative to the contact (at a
//! slide-roll ratio of 2 or -2) has no track: what is in the contact stays there.
//!
//! Growth takes the time of `track.exposure`, wear that of `wear.exposure`. A worn volume is that of the contact,
//! whatever the exposure: in a step `dt` times the integral of the rate of wear, of Archard's law `K F u_s dt`.
//! The patch holds the share `L/l` (track) or `L/(2a)` (contact clock) of it.
//!
//! A print of the contact takes no time: a passage leaves one.
//! Where a step is so short that less than one passage of a point falls to a solve at one of the places of
//! the track, it leaves that share of its print; a body that stays, or whose passages the steps follow, takes
//! the whole print each time.

use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::operating_schedule::OperatingSchedule;
use crate::sim::scene::{self, Scene, TrackSpec};
use crate::surface::{PointRevisit, RoughnessMotion};
use crate::wear::track_duty_factor;

/// What a step of a second does to the nodes of one body that are under the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::sim) struct TimeWeight {
    /// Time in the contact per second \[1\].
    pub(in crate::sim) rate: f64,
    /// Passages that a solve stands for per second \[1/s\]; infinite where every solve leaves its whole
    /// print.
    passages: f64,
}

impl TimeWeight {
    /// Share of the print of a solve that a step of `time_step` \[s\] leaves.
    pub(in crate::sim) fn print(&self, time_step: f64) -> f64 {
        (self.passages * time_step).min(1.0)
    }
}

/// Checks the tracks of a scene under all conditions of its schedule.
///
/// # Errors
/// A track that is shorter than the patch or than the contact under the largest load, one that is missing
/// where the exposure needs it.
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
                if let Some((what, length)) = lengths.into_iter().find(|(_, length)| track < *length) {
                    let reason = format!(
                        "a track of {track:e} m is shorter than the {what}, which is {length:e} m long"
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

/// The ageing of ball and disc that move at `speeds` \[m/s\] as `motion` says, on `track` under `exposure`.
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
        // How much rarer the contact is met than if it stayed.
        let spread = match visits {
            PointRevisit::Permanent => 1.0,
            PointRevisit::Patch if grid.ny() > 1 => {
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
        // A box within the contact cannot be met more often than always.
        let rate = share * spread.max(1.0);
        let passages = match visits {
            PointRevisit::Permanent | PointRevisit::Passing => f64::INFINITY,
            PointRevisit::Track | PointRevisit::Patch => rate * speed.abs() / (2.0 * half_chord),
        };
        Ok(TimeWeight { rate, passages })
    };
    Ok([of(track.radius_ball, speeds[0])?, of(track.radius_disc, speeds[1])?])
}

/// Places that a body moving at `speed` \[m/s\] as `motion` says brings under the contact: at rest it stays,
/// whatever the motion says.
pub(in crate::sim) fn visits(motion: &dyn RoughnessMotion, speed: f64) -> PointRevisit {
    if speed == 0.0 { PointRevisit::Permanent } else { motion.visits(speed) }
}

/// Length of a track of this `radius` \[m\]: `2 pi radius`.
fn track_length(radius: f64) -> f64 {
    2.0 * std::f64::consts::PI * radius
}
