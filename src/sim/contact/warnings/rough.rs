//! Warnings about roughness beyond small slopes and Hertz contacts.

use super::quantity::rq_range;
use super::{Warning, short};
use crate::grid::Grid;
use crate::metrics::{height_statistics, hybrid_parameters};
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::{BODIES, Roughness, Scene};

/// Largest root mean square gradient. An elastic half-space under a cone of this slope is stiffer by 6 % than by the theory of small
/// slopes (Hay, J. C., Bolshakov, A. and Pharr, G. M. (1999), Journal of Materials Research 14, 2296-2305, with Poisson's ratio
/// 0.3), and the pressure gradient of Stokes flow in a wedge of the slope `s` differs by up to `0.35 s^2`, here 3 %, from that by
/// Reynolds' equation (Jeffery-Hamel flow without inertia).
const LARGEST_GRADIENT: f64 = 0.3;
/// Largest composite Rq over the Hertz approach `a^2/R`. Above about 0.05 the pressure is lower than that of Hertz; above
/// about 1 there is no Hertz contact (Greenwood, J. A. and Tripp, J. H. (1967), Journal of Applied Mechanics 34,
/// 153-159).
const LARGEST_SHARE: f64 = 0.5;

/// Warnings about the `heights` \[m\] of ball and disc on the grid.
pub(in crate::sim) fn of_roughness(
    scene: &Scene,
    heights: [&[f64]; 2],
    grid: &Grid,
    hertz: &HertzContact,
) -> Vec<Warning> {
    let steep = BODIES.into_iter().zip(heights).filter_map(|(body, heights)| steep(body, heights, grid));
    steep.chain(high(scene, heights, hertz)).collect()
}

/// A body with steep asperities.
fn steep(body: &str, heights: &[f64], grid: &Grid) -> Option<Warning> {
    let gradient = hybrid_parameters(grid, heights, None).ok()?.sdq;
    (gradient > LARGEST_GRADIENT).then(|| {
        Warning::new(
            format!("roughness.{body}_gradient"),
            gradient,
            format!(
                "the root mean square gradient on the grid is above {LARGEST_GRADIENT}: Reynolds' equation and elastic half-spaces are for \
                 small slopes, with errors of 3 % and 6 % there"
            ),
            "longer waves or a lower Rq; a low-pass filter for measured surfaces".to_owned(),
        )
    })
}

/// Rough bodies without a Hertz contact; textures, cut into smooth bodies, have one.
fn high(scene: &Scene, heights: [&[f64]; 2], hertz: &HertzContact) -> Option<Warning> {
    let bodies = [&scene.roughness.ball, &scene.roughness.disc].into_iter().zip(heights);
    let rough = bodies.filter(|(roughness, _)| !matches!(roughness, Roughness::Texture(_)));
    let squares = rough.filter_map(|(_, heights)| Some(height_statistics(heights).ok()?.sq.powi(2)));
    let rq = squares.sum::<f64>().sqrt();
    let approach = hertz.half_width_x.powi(2) / scene.form.radii().0;
    let is_said = rq_range(hertz.half_width_x.min(hertz.half_width_y)).check("", rq).is_some();
    (rq > LARGEST_SHARE * approach && !is_said).then(|| {
        Warning::new(
            "roughness.composite_rq",
            rq,
            format!(
                "it is {} times the Hertz approach a^2/R of {} m: the contact is wider and softer than that of Hertz, which box, film \
                 formulas and ratios refer to",
                short((1e2 * rq / approach).round() / 1e2),
                short(approach)
            ),
            "check the load and the Rq; a box of several half-widths holds such a contact".to_owned(),
        )
    })
}
