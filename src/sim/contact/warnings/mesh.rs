//! Warnings about boxes that cut the contact and cells that do not resolve the roughness.

use super::{Warning, short};
use crate::boundary::Boundary;
use crate::grid::Grid;
use crate::metrics::{Axis, profile_spectrum};
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::operating_schedule::OperatingSchedule;
use crate::sim::scene::{BODIES, GridSpec, Scene, ShortestWaves};

/// Smallest distance of an edge from the point of first contact, in Hertz half-widths.
const ROOM: f64 = 1.5;
/// Fewest cells per shortest wavelength.
const CELLS_IN_WAVE: f64 = 3.0;
/// Fraction of the mean square height in waves shorter than that for a Gaussian autocorrelation whose length is
/// [`CELLS_IN_WAVE`] cells.
const SHARE_OF_SHORT_WAVES: f64 = 3e-3;

/// Edges of the box close to the contact.
pub(super) fn boxes(scene: &Scene) -> Vec<Warning> {
    let chosen = matches!(scene.grid, GridSpec::Accuracy { .. });
    let allowed = scene.solver.edge_contact && !scene.is_lubricated();
    let (Ok(grid), Ok(operating_schedule)) = (scene.grid(), OperatingSchedule::new(scene)) else {
        return Vec::new();
    };
    let [_, largest] = operating_schedule.loads();
    let heaviest = if scene.schedule.load.is_some() { scene.hertz_under(largest) } else { scene.hertz() };
    match heaviest {
        Ok(hertz) if !chosen && !allowed => edges(&grid, &hertz, scene.form.is_line()),
        _ => Vec::new(),
    }
}

/// Warnings about edges of `grid` within [`ROOM`] half-widths of the center; for a line only along x.
fn edges(grid: &Grid, hertz: &HertzContact, is_line: bool) -> Vec<Warning> {
    let [half_x, half_y] = hertz.half_extents();
    let axes = [
        ("grid.x", grid.x(0) - 0.5 * grid.dx(), grid.size_x(), half_x),
        ("grid.y", grid.y(0) - 0.5 * grid.dy(), grid.size_y(), half_y),
    ];
    let near = |(field, low, size, half_width): (&str, f64, f64, f64)| {
        let edge = if -low < low + size { low } else { low + size };
        let least = ROOM * half_width;
        (edge.abs() < least * (1.0 - 1e-9)).then(|| {
            Warning::new(
                field,
                edge,
                format!(
                    "the box ends less than {ROOM} Hertz half-widths of {} m from the middle and may cut the contact",
                    short(half_width)
                ),
                format!("at least from {} to {} m, more on the inlet side of a thick film", short(-least), short(least)),
            )
        })
    };
    axes.into_iter().take(if is_line { 1 } else { 2 }).filter_map(near).collect()
}

/// Cells too wide for random surfaces with a known spectrum.
pub(super) fn known_waves(scene: &Scene) -> Vec<Warning> {
    let Ok(grid) = scene.grid() else { return Vec::new() };
    let bodies = || BODIES.into_iter().zip([&scene.roughness.ball, &scene.roughness.disc]);
    let shortest = |axis: usize| {
        let lengths = bodies().filter_map(|(name, roughness)| match roughness.shortest_waves() {
            ShortestWaves::Of(lengths) if lengths[axis].is_finite() => Some((name, lengths[axis])),
            _ => None,
        });
        lengths.min_by(|a, b| a.1.total_cmp(&b.1))
    };
    let (along_x, along_y) = (shortest(0), shortest(1).filter(|_| grid.ny() > 1));
    let mut list: Vec<Warning> = [
        few_cells("grid.nx", (grid.nx(), grid.dx()), along_x),
        few_cells("grid.ny", (grid.ny(), grid.dy()), along_y),
    ]
    .into_iter()
    .flatten()
    .collect();
    let endless = bodies().find(|(_, roughness)| roughness.shortest_waves() == ShortestWaves::Endless);
    list.extend(endless.map(|(name, _)| {
        Warning::new(
            "grid.nx",
            grid.nx() as f64,
            format!(
                "roughness.{name} has waves down to any length, more than the cells hold: peak pressures and contact area \
                 depend on the cells"
            ),
            "a Gaussian autocorrelation or a shortest wavelength ends them".to_owned(),
        )
    }));
    list
}

/// Fewer than three cells per shortest wavelength of a body.
fn few_cells(field: &str, (count, cell): (usize, f64), waves: Option<(&str, f64)>) -> Option<Warning> {
    let (body, length) = waves?;
    (cell > length / CELLS_IN_WAVE * (1.0 + 1e-9)).then(|| {
        let least = (CELLS_IN_WAVE * cell * count as f64 / length * (1.0 - 1e-9)).ceil();
        Warning::new(
            field,
            count as f64,
            format!(
                "cells of {} m are wider than a third of the shortest waves of roughness.{body}, {} m",
                short(cell),
                short(length)
            ),
            format!("at least {least} cells"),
        )
    })
}

/// Cells too wide for the waves of given `heights`.
pub(super) fn measured_waves(field: &str, heights: &[f64], grid: &Grid) -> Vec<Warning> {
    let axes = [(Axis::X, "nx", grid.dx(), grid.nx()), (Axis::Y, "ny", grid.dy(), grid.ny())];
    let mut list = Vec::new();
    for (axis, count, cell, cells) in axes {
        // Spectra need at least four cells.
        let Ok(spectrum) = profile_spectrum(grid, heights, axis, Boundary::Periodic) else { continue };
        let shortest = std::f64::consts::TAU / (CELLS_IN_WAVE * cell);
        let (mut all, mut short_waves) = (0.0, 0.0);
        for (wavenumber, density) in spectrum.wavenumber.iter().zip(&spectrum.density) {
            all += density;
            short_waves += if *wavenumber > shortest { *density } else { 0.0 };
        }
        let share = short_waves / all;
        if share > SHARE_OF_SHORT_WAVES {
            list.push(Warning::new(
                format!("grid.{count}"),
                cells as f64,
                format!(
                    "{} % of the mean square height of {field} is in waves shorter than three cells of {} m",
                    short((1e3 * share).round() / 10.0),
                    short(cell)
                ),
                "more cells, or a surface without its short waves (low-pass filter)".to_owned(),
            ));
        }
    }
    list
}
