//! Textures in motion repeat with the box.

use crate::error::InputError;
use crate::sim::scene::{Roughness, Scene};
use crate::surface::{GrooveDirection, Texture};

/// Relative difference of a pitch from a divisor of the box.
const ROUNDING: f64 = 1e-6;

/// Rejects textures whose pitch along x does not divide the `length` \[m\] of the box, the period of roughness in motion.
pub(super) fn require_whole(scene: &Scene, length: f64) -> Result<(), InputError> {
    for (body, roughness) in [("ball", &scene.roughness.ball), ("disc", &scene.roughness.disc)] {
        let Roughness::Texture(texture) = roughness else { continue };
        let pitch = match *texture {
            Texture::Grooves { direction: GrooveDirection::AlongX, .. } => continue,
            Texture::Grooves { pitch, .. } | Texture::Dimples { pitch, .. } => pitch,
        };
        let count = length / pitch;
        let whole = count.round().max(1.0);
        if (count - whole).abs() > ROUNDING * whole {
            return Err(InputError::Conflict {
                field: format!("roughness.{body}.pitch = {pitch:?}"),
                reason: format!(
                    "does not divide the length of the box, {length:.6e} m, with which roughness in motion repeats; \
                     take {:.6e}",
                    length / whole
                ),
            });
        }
    }
    Ok(())
}
