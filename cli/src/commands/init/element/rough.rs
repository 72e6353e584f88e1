//! Elements with a rough disc: cells that hold its heights.

use std::error::Error;

use stribeck::InputError;
use stribeck::analytic::HertzLine;
use stribeck::sim::Scene;
use stribeck::sim::scene::GridSpec;

use super::super::answers::disc;
use super::super::disc::{Disc, STRIP, STRIP_ROWS};
use super::super::{GAP_BEYOND, HARDNESS, Options as Init, REACH, ROOM, plain, rounded};
use super::{ESTIMATE, Element, given, text};

/// Ends of the box of a line contact before and behind the middle, in half-widths.
const ENDS: [f64; 2] = [3.5, 1.7];

/// Options of the roughness.
pub(super) const OPTIONS: [&str; 4] = ["--roughness", "--length", "--finish", "--cells"];

/// `element` with the roughness of the options. A rough line contact is a strip: on a single row oil could not flow around asperities.
pub(super) fn roughened(options: &Init, name: &str, element: Element) -> Result<Element, Box<dyn Error>> {
    let disc = disc(options)?.unwrap_or(Disc::Smooth);
    if disc.rq() == 0.0 {
        if options.cells.is_some() {
            return Err(given::without_effect("--cells", &format!("the smooth scene of {name}")).into());
        }
        return Ok(element);
    }
    let scene = Scene::from_toml(&text(options, &element)?)?;
    let hertz = scene.hertz()?;
    let length = |metres: f64| plain(1e6 * metres);
    let box_and_cells = if let GridSpec::Cells { x: [inlet, outlet], y: [_, side], .. } = scene.grid {
        let (radius_x, radius_y) = scene.form.radii();
        // Asperities touch beyond the contact of smooth bodies.
        let reach = |half_width: f64, radius: f64| {
            let beyond = (REACH * disc.rq() * radius / (GAP_BEYOND * half_width.powi(2))).powf(2.0 / 3.0);
            rounded(half_width * (1.0 + beyond + ROOM))
        };
        let along = reach(hertz.half_width_x, radius_x);
        let [inlet, outlet] = [-inlet, outlet].map(|edge| edge.max(along));
        let side = side.max(reach(hertz.half_width_y, radius_y));
        let sizes = [inlet + outlet, 2.0 * side];
        let longest = sizes[0].max(sizes[1]);
        // The cells of the option are those of the longer side.
        let cells_of =
            |size: f64| options.cells.map(|cells| (f64::from(cells) * size / longest).ceil() as u32);
        let [nx, ny] = sizes.map(|size| disc.cells(cells_of(size), size));
        let [nx, ny] = [nx?, ny?];
        if let Err(error) = disc.require_nodes(options.cells, [nx, ny]) {
            return Err((error + &strip_instead(&scene, name)?).into());
        }
        let [inlet, outlet, side] = [inlet, outlet, side].map(length);
        format!(
            "nx = {nx}\nny = {ny}\nx = [\"-{inlet} um\", \"{outlet} um\"]\ny = [\"-{side} um\", \"{side} um\"]\n"
        )
    } else {
        let [inlet, outlet] = ENDS.map(|reach| rounded(reach * hertz.half_width_x));
        let cells = disc.cells(options.cells, inlet + outlet)?;
        disc.require_nodes(options.cells, [cells, STRIP_ROWS])?;
        let [inlet, outlet] = [inlet, outlet].map(length);
        format!(
            "{STRIP}ny = {STRIP_ROWS}\nnx = {cells}\nx = [\"-{inlet} um\", \"{outlet} um\"] # the oil flows along +x\n"
        )
    };
    let estimate = if element.is_dry { "" } else { ESTIMATE };
    Ok(Element { grid: box_and_cells + &disc.tables(&options.file, HARDNESS)? + estimate, ..element })
}

/// Options of a strip through the middle of the ellipse of a bearing, a line contact with the same radius, pressure and speed.
fn strip_instead(scene: &Scene, name: &str) -> Result<String, InputError> {
    if name != "--bearing" {
        return Ok(String::new());
    }
    let (radius, _) = scene.form.radii();
    // The pressure rises with the root of the load.
    let load = (scene.hertz()?.pressure
        / HertzLine::from_load(radius, scene.equivalent_modulus()?, 1.0)?.pressure)
        .powi(2);
    Ok(format!(
        "; a strip through the middle of the ellipse has its pressure: --roller in place of --bearing, with --radius \"{:.4} mm\" --load \"{:.4} \
         kN/m\" --speed \"{:.4} m/s\" --slide-roll-ratio {}",
        1e3 * radius,
        1e-3 * load,
        scene.motion.entrainment_speed,
        scene.motion.slide_roll_ratio
    ))
}
