//! Maps and profile of a solved contact.

use std::borrow::Cow;

use stribeck::Grid;
use stribeck::reynolds::ContactState;
use stribeck::sim::HertzContact;

use crate::picture::{BLUE, Chart, GREEN, Line, Map, Maps, Panel, Scale, VERMILION, extremes, inner};

/// Hertz's pressure over the largest one, above which it is not drawn.
const LARGEST_HERTZ: f64 = 3.0;

/// A contact as it is drawn.
pub(crate) struct Seen<'a> {
    pub(crate) title: String,
    pub(crate) grid: Grid,
    pub(crate) hertz: HertzContact,
    pub(crate) state: &'a ContactState,
    pub(crate) lubricated: bool,
    /// Of the disc \[m\], where there is one.
    pub(crate) tribofilm: Option<&'a [f64]>,
}

/// Film, pressure, film fraction and tribofilm from above.
pub(crate) fn maps<'a>(seen: &Seen<'a>) -> Maps<'a> {
    let state = seen.state;
    let map = |title: &str, values: Cow<'a, [f64]>, factor, highest: f64, outline| Map {
        title: title.to_owned(),
        values,
        factor,
        range: (0.0, if highest > 0.0 { highest } else { 1.0 }),
        outline,
    };
    let (most, thickest) = (round_up(1e9 * thick_film(seen)), 1e9 * extremes(state.film.iter().copied()).1);
    let cut = if thickest > most { format!(", yellow: {most} and more") } else { String::new() };
    let film_name = format!("{}{cut}", film_name(seen));
    let (unit, factor) = pressure_unit(seen);
    let pressure_scale = round_up(factor * largest_pressure(seen));
    let mut maps = vec![
        map(&film_name, (&state.film).into(), 1e9, most, true),
        map(&format!("pressure ({unit})"), (&state.pressure).into(), factor, pressure_scale, true),
    ];
    if seen.lubricated {
        if state.pressure.iter().zip(&state.fluid_pressure).any(|(all, fluid)| all > fluid) {
            let solid = (0..state.pressure.len()).map(|k| state.solid_pressure(k)).collect::<Vec<_>>();
            let fluid = (&state.fluid_pressure).into();
            let of = |body: &str| format!("pressure of the {body} ({unit})");
            maps.push(map(&of("fluid"), fluid, factor, pressure_scale, true));
            maps.push(map(&of("solids"), solid.into(), factor, pressure_scale, true));
        }
        maps.push(map("film fraction, theta", (&state.theta).into(), 1.0, 1.0, true));
    }
    if let Some(film) = seen.tribofilm {
        let thickest = extremes(film.iter().copied()).1;
        // The patch of the disc, wherever that stands in the contact.
        maps.push(map("tribofilm on the disc (nm)", film.into(), 1e9, round_up(1e9 * thickest), false));
    }
    Maps { title: seen.title.clone(), grid: seen.grid, hertz: seen.hertz, maps }
}

/// Film and pressures along the entrainment, in the row next to the centre.
pub(crate) fn profile(seen: &Seen<'_>) -> Chart {
    let (grid, state) = (&seen.grid, seen.state);
    let row = (0..grid.ny()).min_by(|a, b| grid.y(*a).abs().total_cmp(&grid.y(*b).abs())).unwrap_or(0);
    // The ends hold the boundary condition.
    let columns = inner(grid.nx());
    let nodes = row * grid.nx() + columns.start..row * grid.nx() + columns.end;
    let line = |name, colour, values: &[f64], factor: f64| Line {
        name,
        colour,
        points: nodes
            .clone()
            .zip(columns.clone())
            .filter_map(|(node, i)| values.get(node).map(|value| (1e6 * grid.x(i), factor * value)))
            .collect(),
        bands: Vec::new(),
    };
    let (unit, factor) = pressure_unit(seen);
    let mut pressures = vec![line("all", VERMILION, &state.pressure, factor)];
    if seen.lubricated {
        pressures.push(line("fluid", BLUE, &state.fluid_pressure, factor));
    }
    // Bodies that hardly deflect have no Hertz contact, whose pressure would be all that the panel shows.
    if seen.hertz.pressure < LARGEST_HERTZ * largest_pressure(seen) {
        pressures.push(hertz_line(seen, row, columns.clone(), factor));
    }
    let highest = 2e9 * thick_film(seen);
    let mut film = line("", BLUE, &state.film, 1e9);
    if !seen.lubricated {
        // The gap of solids that touch is rounding.
        film.points.iter_mut().for_each(|point| point.1 = point.1.max(0.0));
    }
    let cut = if film.points.iter().any(|(_, film)| *film > highest) { ", cut off" } else { "" };
    let mut panels = vec![
        Panel::new(format!("pressure ({unit})"), pressures),
        Panel { highest: Some(highest), ..Panel::new(format!("{}{cut}", film_name(seen)), vec![film]) },
    ];
    if seen.lubricated {
        panels.push(Panel::new("theta", vec![line("", GREEN, &state.theta, 1.0)]));
    }
    let title = format!("{}: profile at y = {:.1} µm", seen.title, 1e6 * grid.y(row));
    Chart { title, x_label: "x (µm)", x_scale: Scale::Linear, panels, upper: None }
}

/// Hertz's pressure of the smooth dry contact in the nodes of a row.
fn hertz_line(seen: &Seen<'_>, row: usize, columns: std::ops::Range<usize>, factor: f64) -> Line {
    let (grid, hertz) = (&seen.grid, &seen.hertz);
    let y = if grid.is_strip() { 0.0 } else { grid.y(row) };
    let at = |x: f64| factor * hertz.pressure * (1.0 - hertz.radius_squared(x, y)).max(0.0).sqrt();
    let points = columns.map(|i| (1e6 * grid.x(i), at(grid.x(i)))).collect();
    Line { name: "Hertz", colour: GREEN, points, bands: Vec::new() }
}

fn largest_pressure(seen: &Seen<'_>) -> f64 {
    extremes(seen.state.pressure.iter().copied()).1
}

/// Unit of pressures by their size, and its factor.
fn pressure_unit(seen: &Seen<'_>) -> (&'static str, f64) {
    if largest_pressure(seen) < 1e8 { ("MPa", 1e-6) } else { ("GPa", 1e-9) }
}

/// Name of the film.
fn film_name(seen: &Seen<'_>) -> &'static str {
    if seen.lubricated { "film (nm)" } else { "gap (nm)" }
}

/// A film \[m\] that few nodes of the Hertz contact exceed: films outside of it are thicker by far.
fn thick_film(seen: &Seen<'_>) -> f64 {
    let inside = |(x, y): (f64, f64)| seen.hertz.radius_squared(x, y) <= 1.0;
    let nodes = seen.grid.nodes().zip(&seen.state.film);
    let mut films: Vec<f64> = nodes.filter(|(at, h)| inside(*at) && h.is_finite()).map(|(_, h)| *h).collect();
    films.sort_unstable_by(f64::total_cmp);
    // Nineteen of twenty nodes.
    films.get(films.len() * 19 / 20).map_or(0.0, |film| 1.2 * film)
}

/// The next of 1, 1.5, 2, 3, 5, 7, 10 times a power of ten from `value` on.
fn round_up(value: f64) -> f64 {
    if !(value > 0.0 && value.is_finite()) {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0];
    steps.into_iter().map(|step| step * decade).find(|step| *step >= value).unwrap_or(value)
}
