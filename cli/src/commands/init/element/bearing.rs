//! Rolling bearings with published inner geometry.
//!
//! The heaviest loaded of `Z` rolling elements carries `5 F/Z` of the radial load `F` (Stribeck 1901, with usual clearance). At the inner
//! ring the surfaces have the mean speed `d w (1 - g^2)/4` relative to the contact, with the pitch diameter `d`, the rate of rotation `w` of
//! the ring and `g = D/d` of the diameter `D` of the elements (Hamrock, Schmid and Jacobson, Fundamentals of fluid film lubrication).

use std::error::Error;
use std::f64::consts::TAU;

use stribeck::analytic::HertzPoint;
use stribeck::units::Dimension;

use super::super::{Options as Init, plain, rounded};
use super::{Element, LINE_GRID, quantity, rotation, steel};

/// Load of the heaviest loaded element, in radial loads over the number of elements.
const STRIBECK: f64 = 5.0;

/// Inner geometry of a bearing, lengths in mm.
struct Bearing {
    name: &'static str,
    elements: f64,
    /// Diameter of the rolling elements.
    diameter: f64,
    /// Diameter of the pitch circle.
    pitch: f64,
    race: Race,
    source: &'static str,
}

/// Race of the inner ring.
enum Race {
    /// Radius of the groove over the diameter of the balls.
    Groove(f64),
    /// Effective length of the rollers.
    Roller(f64),
}

/// The bearings.
const BEARINGS: [Bearing; 4] = [
    Bearing {
        name: "6203",
        elements: 8.0,
        diameter: 6.746,
        pitch: 28.5,
        race: Race::Groove(0.52),
        source: "8 balls of 6.746 mm on 28.50 mm: Case Western Reserve University, Bearing Data Center; groove radius 0.52 of the ball: usual",
    },
    Bearing {
        name: "6205",
        elements: 9.0,
        diameter: 7.94,
        pitch: 39.04,
        race: Race::Groove(0.52),
        source: "9 balls of 7.94 mm on 39.04 mm: Case Western Reserve University, Bearing Data Center; groove radius 0.52 of the ball: usual",
    },
    Bearing {
        name: "6209",
        elements: 9.0,
        diameter: 12.7,
        pitch: 64.9985,
        race: Race::Groove(6.6 / 12.7),
        source: "9 balls of 12.7 mm, races of 52.291 and 77.706 mm, groove radius 6.6 mm: Harris, Rolling bearing analysis (bearing 209)",
    },
    Bearing {
        name: "NU209",
        elements: 14.0,
        diameter: 10.0,
        pitch: 65.0115,
        race: Race::Roller(9.6),
        source: "14 rollers of 10 mm with 9.6 mm effective length, races of 54.991 and 75.032 mm: Harris, Rolling bearing analysis (bearing 209)",
    },
];

/// The heaviest loaded contact at the inner ring of the bearing `name`.
pub(super) fn element(options: &Init, name: &str) -> Result<Element, Box<dyn Error>> {
    let plain_name: String = name.chars().filter(|c| !c.is_whitespace()).collect::<String>().to_uppercase();
    let bearing = BEARINGS
        .iter()
        .find(|bearing| bearing.name == plain_name)
        .ok_or_else(|| unknown(name, &plain_name))?;
    let (load, force) = quantity(Dimension::Force, "--load", options.load.as_ref(), "1 kN")?;
    let rotation = rotation(options, 1500.0)?;
    let &Bearing { elements, diameter, pitch, ref race, source, .. } = bearing;
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

/// The error for a bearing that is not in the list, with the nearest ones.
fn unknown(given: &str, name: &str) -> String {
    let number = |name: &str| {
        let digits: String = name.chars().filter(char::is_ascii_digit).collect();
        digits.parse::<f64>().unwrap_or(f64::MAX) % 1000.0
    };
    let is_roller = name.starts_with('N');
    let mut near: Vec<&Bearing> = BEARINGS.iter().collect();
    near.sort_by(|a, b| {
        let key = |bearing: &Bearing| {
            let other = matches!(bearing.race, Race::Roller(_)) != is_roller;
            (number(bearing.name) - number(name)).abs() + if other { 1000.0 } else { 0.0 }
        };
        key(a).total_cmp(&key(b))
    });
    let names: Vec<&str> = near.iter().map(|bearing| bearing.name).collect();
    format!(
        "--bearing {given:?}: its inner geometry is not in the list; nearest first: {}. Of another bearing, write the radii into a scene of one of \
         these",
        names.join(", ")
    )
}
