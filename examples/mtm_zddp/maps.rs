//! Film, pressure and tribofilm of the last contact, seen from above.

use std::error::Error;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::history::History;

/// Shades of a map: neighbours of one shade are one rectangle, which keeps the file small.
const SHADES: u8 = 14;
/// Edge of a map, gaps beside it, room above and below in pixels.
const EDGE: i32 = 280;
const GAP: i32 = 26;
const ABOVE: i32 = 44;
const BELOW: i32 = 74;

/// A field, its name and unit, and the value of its darkest shade.
struct Map<'a> {
    title: &'static str,
    field: &'a [f64],
    factor: f64,
    darkest: f64,
    unit: &'static str,
}

/// Draws the three maps of `history` side by side, within 1.2 Hertz radii.
pub(crate) fn draw(history: &History, path: &Path) -> Result<(), Box<dyn Error>> {
    let Some(contact) = &history.last_contact else { return Ok(()) };
    let film = history.sim.bodies()[1].tribofilm();
    let thickest = film.iter().copied().fold(0.0, f64::max);
    let maps = [
        Map { title: "film thickness", field: &contact.film, factor: 1e9, darkest: 200.0, unit: "nm" },
        Map { title: "pressure", field: &contact.pressure, factor: 1e-9, darkest: 4.0, unit: "GPa" },
        Map {
            title: "tribofilm on the disc",
            field: film,
            factor: 1e9,
            darkest: round_up(1e9 * thickest),
            unit: "nm",
        },
    ];
    let size = (3 * (EDGE + GAP) + GAP, EDGE + ABOVE + BELOW);
    let root = SVGBackend::new(path, (size.0 as u32, size.1 as u32)).into_drawing_area();
    root.fill(&WHITE)?;
    for (k, map) in (0..).zip(&maps) {
        draw_map(&root, history, map, GAP + k * (EDGE + GAP))?;
    }
    root.present()?;
    Ok(())
}

fn draw_map(
    root: &DrawingArea<SVGBackend<'_>, Shift>,
    history: &History,
    map: &Map<'_>,
    left: i32,
) -> Result<(), Box<dyn Error>> {
    let (grid, radius) = (history.sim.grid(), history.sim.hertz().half_width_x);
    let text = |size: u32| ("sans-serif", size).into_font().color(&BLACK);
    let centred = |size: u32| text(size).pos(Pos::new(HPos::Center, VPos::Center));
    root.draw(&Text::new(map.title, (left + EDGE / 2, ABOVE / 2), centred(20)))?;
    let reach = 1.2 * radius;
    // Pixel of a place, x to the right and y upwards.
    let pixel = |x: f64, y: f64| {
        let along = |v: f64| (f64::from(EDGE) * (v / reach).clamp(-1.0, 1.0) / 2.0).round() as i32;
        (left + EDGE / 2 + along(x), ABOVE + EDGE / 2 - along(y))
    };
    let shade =
        |value: f64| (f64::from(SHADES) * (map.factor * value / map.darkest).clamp(0.0, 1.0)).round() as u8;
    let (half_x, half_y) = (0.5 * grid.dx(), 0.5 * grid.dy());
    for (j, row) in map.field.chunks_exact(grid.nx()).enumerate() {
        let y = grid.y(j);
        if y.abs() > reach {
            continue;
        }
        let columns = (0..grid.nx()).filter(|i| grid.x(*i).abs() <= reach).collect::<Vec<_>>();
        for run in columns.chunk_by(|a, b| shade(row[*a]) == shade(row[*b])) {
            let (Some(&first), Some(&last)) = (run.first(), run.last()) else { continue };
            let corners =
                [pixel(grid.x(first) - half_x, y + half_y), pixel(grid.x(last) + half_x, y - half_y)];
            root.draw(&Rectangle::new(corners, colour(shade(row[first])).filled()))?;
        }
    }
    // The film is seen on the patch of the disc, wherever that stands in the contact.
    if std::ptr::eq(map.field, history.sim.bodies()[1].tribofilm()) {
        return draw_scale(root, map, left);
    }
    let ring = (0..=120).map(|k| (f64::from(k) * std::f64::consts::TAU / 120.0).sin_cos());
    root.draw(&PathElement::new(
        ring.map(|(s, c)| pixel(radius * c, radius * s)).collect::<Vec<_>>(),
        BLACK,
    ))?;
    draw_scale(root, map, left)
}

fn draw_scale(
    root: &DrawingArea<SVGBackend<'_>, Shift>,
    map: &Map<'_>,
    left: i32,
) -> Result<(), Box<dyn Error>> {
    let text = |size: u32| ("sans-serif", size).into_font().color(&BLACK);
    let (top, steps) = (ABOVE + EDGE + 12, i32::from(SHADES) + 1);
    for k in 0..=SHADES {
        let [from, to] = [0, 1].map(|next| left + EDGE * (i32::from(k) + next) / steps);
        let fill = colour(k).filled();
        root.draw(&Rectangle::new([(from, top), (to, top + 14)], fill))?;
    }
    let ends = [
        ("0".to_owned(), left, HPos::Left),
        (format!("{:.0} {} and more", map.darkest, map.unit), left + EDGE, HPos::Right),
    ];
    for (words, x, side) in ends {
        root.draw(&Text::new(words, (x, top + 32), text(17).pos(Pos::new(side, VPos::Center))))?;
    }
    Ok(())
}

/// The next of 1, 2, 5, 10, 20, ... from `value` on.
fn round_up(value: f64) -> f64 {
    let decade = 10_f64.powf(value.max(1e-3).log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|step| step * decade).find(|step| *step >= value).unwrap_or(value)
}

/// From pale yellow over green to dark blue: ascending darkness, also without colours.
fn colour(shade: u8) -> RGBColor {
    const STOPS: [[f64; 3]; 4] =
        [[255.0, 252.0, 217.0], [161.0, 218.0, 180.0], [44.0, 127.0, 184.0], [18.0, 24.0, 92.0]];
    let place = 3.0 * f64::from(shade) / f64::from(SHADES);
    let low = (place as usize).min(2);
    let part = place - low as f64;
    let [r, g, b] =
        [0, 1, 2].map(|c| (STOPS[low][c] * (1.0 - part) + STOPS[low + 1][c] * part).round() as u8);
    RGBColor(r, g, b)
}
