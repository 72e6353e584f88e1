//! `stribeck check` of a rigid bearing: its size, what its film carries, and the parts of its model. The film is solved, which takes
//! about a second.

use std::error::Error;

use stribeck::sim::scene::BearingSpec;
use stribeck::sim::{BearingNumbers, RigidBearing};
use stribeck::units::by_size;

use super::Options;
use super::parts::{self, Part};
use crate::commands::solve::bearing_lines;
use crate::interrupt;
use crate::output::{self, Outcome};

pub(super) fn run(options: &Options, bearing: &RigidBearing) -> Result<Outcome, Box<dyn Error>> {
    interrupt::listen("the check ends here")?;
    let solved = bearing.solve(interrupt::is_requested);
    let solution = solved.map_err(|error| output::in_scene(&options.scene, &error))?;
    let status = solution.film.report.status;
    let parts = parts(bearing, &solution.numbers);
    output::warn(&solution.warnings);
    if options.json {
        let mut numbers = serde_json::to_value(solution.numbers)?;
        numbers["specific_load"] = specific_load(bearing, &solution.numbers).into();
        numbers["status"] = serde_json::to_value(status)?;
        numbers["modelled"] = parts::objects(&parts).into();
        numbers["warnings"] = serde_json::to_value(&solution.warnings)?;
        numbers["version"] = env!("CARGO_PKG_VERSION").into();
        output::print(&numbers)?;
    } else {
        let mut lines = size(bearing, &solution.numbers);
        lines.push(bearing_lines(bearing, &solution, status));
        lines.extend(parts::lines(&parts));
        output::print(&lines.join("\n"))?;
    }
    Ok(status.into())
}

/// Load over the projected area \[Pa\]; NaN for pads without width.
fn specific_load(bearing: &RigidBearing, numbers: &BearingNumbers) -> f64 {
    let area = match bearing.bearing {
        BearingSpec::Journal { diameter, width, .. } => diameter * width,
        BearingSpec::Pad { length, width, .. } => length * width.unwrap_or(1.0),
        _ => f64::NAN,
    };
    numbers.load / area
}

/// Size and motion, and the specific load.
fn size(bearing: &RigidBearing, numbers: &BearingNumbers) -> Vec<String> {
    let metres = |length: f64| by_size(length, "m");
    let first = match bearing.bearing {
        BearingSpec::Journal { diameter, width, clearance, speed, .. } => format!(
            "bearing    diameter {}, width {}, radial clearance {} ({:.2} per mille); {speed:.4} m/s",
            metres(diameter),
            metres(width),
            metres(clearance),
            2e3 * clearance / diameter
        ),
        BearingSpec::Pad { length, width, speed, .. } => {
            let width = width.map_or_else(|| "wide".to_owned(), |width| format!("{} wide", metres(width)));
            format!("bearing    pad, {} long, {width}; {speed:.4} m/s", metres(length))
        }
        _ => "bearing    with a prescribed film".to_owned(),
    };
    let carried = numbers.contact_share.map_or_else(
        || "by the film alone, the surfaces are smooth".to_owned(),
        |share| format!("by the film, {:.2} % by solids", 100.0 * share),
    );
    let specific = specific_load(bearing, numbers);
    vec![first, format!("carried    {} over the projected area, {carried}", by_size(specific, "Pa"))]
}

/// The parts of the model.
fn parts(bearing: &RigidBearing, numbers: &BearingNumbers) -> Vec<Part> {
    let part = |name, modelled, why: &str| Part { name, modelled, why: why.to_owned() };
    let mut parts = vec![
        part("cavitation", true, "of conserved mass"),
        part("holes", bearing.holes.is_some(), "given_film.hole_diameter"),
        part("roughness", bearing.roughness.is_some(), "given_film.roughness"),
        part("heat balance", bearing.heat.is_some(), "given_film.supply_temperature"),
        part(
            "rise of the viscosity with pressure",
            numbers.alpha > 0.0,
            "lubricant.alpha, 0 for an isoviscous oil",
        ),
    ];
    if let BearingSpec::Journal { .. } = bearing.bearing {
        parts.push(part("grooves", bearing.grooves.is_some(), "given_film.groove_angles"));
        let why = "given_film.bore_modulus, or liner_modulus";
        parts.push(part("elastic bore", bearing.bore.is_some(), why));
    } else {
        parts.push(part("relief", bearing.relief.is_some(), "given_film.dimple_depth, or heights in a file"));
    }
    for name in ["turbulence", "misalignment", "unsteady loads"] {
        parts.push(part(name, false, "no key"));
    }
    parts
}
