//! Warnings about wear.

use std::f64::consts::PI;

use super::{Warning, short};
use crate::grid::Grid;
use crate::units::by_size;

/// Deepest wear over the half-width of the contact.
const DEEPEST_WEAR: f64 = 0.1;
/// Fields of that warning, for ball and disc.
pub(in crate::sim) const DEEP_WEAR: [&str; 2] = ["wear.ball_max", "wear.disc_max"];
/// Field of the warning about long steps.
pub(in crate::sim) const LONG_STEP: &str = "time_step";

/// A node of ball or disc whose larger worn depth of `depths` \[m\] is large for a contact of `half_width` \[m\].
pub(in crate::sim) fn deep_wear([ball, disc]: [f64; 2], half_width: f64) -> Option<Warning> {
    let [of_ball, of_disc] = DEEP_WEAR;
    let (field, depth) = if ball > disc { (of_ball, ball) } else { (of_disc, disc) };
    (depth > DEEPEST_WEAR * half_width).then(|| {
        let message = format!(
            "a node has worn by {} times the half-width of the contact, surfaces are taken for shallow",
            short(depth / half_width)
        );
        let remedy = "check the unit of the wear coefficient and the time step".to_owned();
        Warning::new(field, depth, message, remedy)
    })
}

/// A step of `time_step` \[s\] that wears a node by `depth` \[m\], of both bodies together, so that pressures oscillate from node
/// to node. `pressure` \[Pa\] is the largest one and `modulus` \[Pa\] the equivalent one `E'`.
///
/// A pressure wave `p cos(q x)` deflects half-spaces by `4 p/(E' q)` (Johnson, K. L. (1985), Contact Mechanics, section 13.2).
/// Removing a depth `d` of this wave changes its pressure by `-p E' q d/(4 p)`, to less than `-p` where `d > 8 p/(E' q)`:
/// the wave then grows from step to step. The shortest waves of the mesh have `q = pi sqrt(1/dx^2 + 1/dy^2)`.
pub(in crate::sim) fn long_step(
    time_step: f64,
    depth: f64,
    grid: &Grid,
    (pressure, modulus): (f64, f64),
) -> Option<Warning> {
    let across = if grid.has_side_edges() { grid.dy().recip() } else { 0.0 };
    let largest = 8.0 * pressure / (modulus * PI * grid.dx().recip().hypot(across));
    (depth > largest).then(|| {
        let message = format!(
            "a step wears a node by up to {}, above the {} from which on profiles and pressures oscillate from node to node",
            by_size(depth, "m"),
            by_size(largest, "m")
        );
        let remedy = format!("steps of at most {} s", short_below(time_step * largest / depth));
        Warning::new(LONG_STEP, time_step, message, remedy)
    })
}

/// The number rounded down to one digit.
fn short_below(value: f64) -> String {
    let unit = 10.0_f64.powf(value.log10().floor());
    short((value / unit).floor() * unit)
}
