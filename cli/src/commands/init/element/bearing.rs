//! The heaviest loaded contact of a rolling bearing.
//!
//! The heaviest loaded of `Z` rolling elements carries `5 F/Z` of the radial load `F` (Stribeck 1901, with usual clearance). At the inner
//! ring the surfaces have the mean speed `d w (1 - g^2)/4` relative to the contact, with the pitch diameter `d`, the rate of rotation `w` of
//! the ring and `g = D/d` of the diameter `D` of the elements (Hamrock, Schmid and Jacobson, Fundamentals of fluid film lubrication).

use std::error::Error;
use std::f64::consts::TAU;

use stribeck::analytic::HertzPoint;
use stribeck::units::Dimension;

use super::super::{Options as Init, plain, rounded};
use super::bearing_list::{Bearing, Race, find};
use super::{Element, LINE_GRID, USUAL_CELSIUS, quantity, rotation, steel};

/// Load of the heaviest loaded element, in radial loads over the number of elements.
const STRIBECK: f64 = 5.0;

/// The heaviest loaded contact at the inner ring of the bearing `name`.
pub(super) fn element(options: &Init, name: &str) -> Result<Element, Box<dyn Error>> {
    let bearing = find(name)?;
    let (load, force) = quantity(Dimension::Force, "--load", options.load.as_ref(), "1 kN")?;
    let rotation = rotation(options, 1500.0)?;
    let Bearing { elements, diameter, pitch, ref race, ref source, .. } = bearing;
    let ratio = diameter / pitch;
    let share = STRIBECK * force / elements;
    let speed = 0.25e-3 * pitch * TAU * rotation / 60.0 * (1.0 - ratio * ratio);
    let [element, ring] =
        [0.5 * diameter, 0.5 * (pitch - diameter)].map(|radius| format!("\"{} mm\"", plain(radius)));
    let (form, load_keys) = match race {
        Race::Groove(conformity) => (
            format!(
                "kind = \"ellipsoid\"\nradii_x = [{element}, {ring}] # ball and inner ring, along the motion\nradii_y = [{element}, \"-{} mm\"] # ball and \
                 groove\n",
                plain(conformity * diameter)
            ),
            format!("force = {} # N\n", plain(share)),
        ),
        Race::Roller(length) => (
            format!("kind = \"cylinder\"\nradii = [{element}, {ring}] # roller and inner ring\n"),
            format!(
                "force = {} # N/m: over the effective length of a roller\n",
                plain(share / (1e-3 * length))
            ),
        ),
    };
    let grid = match race {
        Race::Groove(conformity) => groove_grid(share, [diameter, pitch], *conformity)?,
        Race::Roller(_) => LINE_GRID.to_owned(),
    };
    Ok(Element {
        title: format!(
            "# Heaviest loaded contact at the inner ring of a rolling bearing {} under a radial load of {load} at {rotation} rpm of the inner\n\
             # ring. It carries 5/Z of the load (Stribeck 1901).\n# {source}.\n",
            bearing.name
        ),
        form,
        materials: ["steel"; 2],
        load: load_keys,
        motion: format!(
            "entrainment_speed = {} # m/s\nslide_roll_ratio = {:?}\n",
            plain(speed),
            options.slide_roll_ratio.unwrap_or(0.0)
        ),
        boundary: 0.115,
        bearing: format!(
            "\n[bearing] # for the viscosity ratio kappa of ISO 281\nrotation = \"{rotation} rpm\"\nmean_diameter = \"{} mm\"\n",
            plain(pitch)
        ),
        is_dry: false,
        celsius: USUAL_CELSIUS,
        grid,
    })
}

/// Cells around the narrow ellipse of a ball of `[diameter, pitch]` \[mm\] in its groove under `load` \[N\].
fn groove_grid(load: f64, [diameter, pitch]: [f64; 2], conformity: f64) -> Result<String, Box<dyn Error>> {
    let reduced = |a: f64, b: f64| 1e-3 / (1.0 / a + 1.0 / b);
    let along = reduced(0.5 * diameter, 0.5 * (pitch - diameter));
    let across = reduced(0.5 * diameter, -conformity * diameter);
    let hertz = HertzPoint::from_load(along, across, steel(), load)?;
    let [inlet, outlet] = [3.5, 1.7].map(|reach| plain(1e6 * rounded(reach * hertz.half_width_x)));
    let side = plain(1e6 * rounded(1.6 * hertz.half_width_y));
    Ok(format!(
        "nx = 96\nny = 80\nx = [\"-{inlet} um\", \"{outlet} um\"] # the oil flows along +x\ny = [\"-{side} um\", \"{side} um\"]\n\n\
         [solver]\nestimate = true # errors of the mesh\n"
    ))
}
