//! The picture of a rigid bearing: pressure, film and film fraction along the motion.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use stribeck::sim::scene::BearingSpec;
use stribeck::sim::{BearingSolution, RigidBearing};

use crate::output;
use crate::picture::{BLUE, Chart, GREEN, Line, Panel, Scale, VERMILION, extremes};

/// Pressures, film and film fraction along the motion through the largest pressure. The abscissa of a journal is the angle from
/// the load in the direction of rotation.
pub(super) fn profile(scene: &Path, bearing: &RigidBearing, solution: &BearingSolution) -> Chart {
    let (film, grid) = (&solution.film, solution.film.grid());
    let largest = film.pressure.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    let row =
        largest.filter(|(_, pressure)| **pressure > 0.0).map_or(grid.ny() / 2, |(node, _)| node / grid.nx());
    let angle = match bearing.bearing {
        BearingSpec::Journal { diameter, .. } => {
            solution.numbers.attitude.map(|attitude| (0.5 * diameter, attitude))
        }
        _ => None,
    };
    let abscissa = |x: f64| match angle {
        Some((radius, attitude)) => ((x / radius + attitude).rem_euclid(TAU) - PI).to_degrees(),
        None => 1e3 * x,
    };
    let line = |name, colour, values: &[f64], factor: f64| {
        let at =
            |i: usize| values.get(row * grid.nx() + i).map(|value| (abscissa(grid.x(i)), factor * value));
        let mut points: Vec<(f64, f64)> = (0..grid.nx()).filter_map(at).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Line { name, colour, points, bands: Vec::new() }
    };
    let solids = film.contact.as_ref();
    let name = if solids.is_some() { "film" } else { "" };
    let mut pressures = vec![line(name, BLUE, &film.pressure, 1e-6)];
    pressures.extend(solids.map(|contact| line("solids", VERMILION, &contact.pressure, 1e-6)));
    let mut films = vec![line("", BLUE, &solution.thickness, 1e6)];
    let highest = extremes(films.iter().flat_map(|line| &line.points).map(|point| point.1)).1;
    films.extend(groove_marks(bearing, highest));
    let panels = vec![
        Panel::new("pressure (MPa)", pressures),
        Panel::new("film (um)", films),
        Panel::new("film fraction", vec![line("", GREEN, &film.theta, 1.0)]),
    ];
    let x_label = if angle.is_some() {
        "angle from the load, along the rotation (deg)"
    } else {
        "x along the motion (mm)"
    };
    let place = output::digits(1e3 * (grid.y(row) - grid.y(0) + 0.5 * grid.dy()));
    let title = if grid.ny() == 1 {
        format!("{}: profile along the motion", output::stem(scene))
    } else {
        format!("{}: profile through the largest pressure, {place} mm from a side", output::stem(scene))
    };
    Chart { title, x_label, x_scale: Scale::Linear, panels, upper: None }
}

/// Upright lines up to `highest` at both edges of the grooves of a journal.
fn groove_marks(bearing: &RigidBearing, highest: f64) -> Vec<Line> {
    let (BearingSpec::Journal { diameter, .. }, Some(grooves)) = (bearing.bearing, &bearing.grooves) else {
        return Vec::new();
    };
    let half = grooves.width / diameter;
    let edges = grooves.angles.iter().flat_map(|angle| [angle - half, angle + half]);
    edges
        .enumerate()
        .map(|(k, edge)| {
            let at = ((edge + PI).rem_euclid(TAU) - PI).to_degrees();
            let name = if k == 0 { "edges of grooves" } else { "" };
            Line { name, colour: VERMILION, points: vec![(at, 0.0), (at, highest)], bands: Vec::new() }
        })
        .collect()
}
