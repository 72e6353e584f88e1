//! One page: height map, spectra, autocorrelation and bearing curve.

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use stribeck::metrics::{Axis, Spectrum, height_histogram, profile_spectrum, radial_spectrum};
use stribeck::surface::Heights;
use stribeck::{Boundary, Grid};

use crate::numbers::{Numbers, defined_heights};

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;

const SIZE: (u32, u32) = (1100, 900);
const TITLE_FONT: u32 = 22;
const FONT: u32 = 15;
/// Most squares along a side of a map.
const SQUARES: usize = 100;
/// Size of a square over their distance: without overlap, viewers show seams.
const OVERLAP: f64 = 1.5;
/// Most points of a curve.
const POINTS: usize = 400;
const CLASSES: usize = 60;
/// Share of the highest and of the lowest points that have no colour of their own.
const OUTLIERS: f64 = 0.005;
const CUBIC_NANOMETRES: f64 = 1e27;
/// Blue, vermilion and green of the palette of Okabe and Ito.
const BLUE: RGBColor = RGBColor(0, 114, 178);
const VERMILION: RGBColor = RGBColor(213, 94, 0);
const GREEN: RGBColor = RGBColor(0, 158, 115);
/// Dark violet to yellow over blue and green, even in lightness.
const SCALE: [[f64; 3]; 5] =
    [[68.0, 1.0, 84.0], [59.0, 82.0, 139.0], [33.0, 145.0, 140.0], [94.0, 201.0, 98.0], [253.0, 231.0, 37.0]];

/// A field of `nx` by `ny` squares over a box.
struct Map<'a> {
    title: String,
    x_label: &'a str,
    y_label: &'a str,
    x: Range<f64>,
    y: Range<f64>,
    nx: usize,
    ny: usize,
    values: &'a [f64],
    /// Blank where not set.
    defined: Option<&'a [bool]>,
}

/// Writes the page.
pub(crate) fn draw(
    path: &Path,
    title: &str,
    surface: &Heights,
    numbers: &Numbers,
) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let root = root.titled(title, ("sans-serif", TITLE_FONT))?;
    let areas = root.split_evenly((2, 2));
    let [map, spectrum, correlation, bearing] = areas.as_slice() else { return Ok(()) };
    draw_heights(map, surface, numbers)?;
    draw_spectra(spectrum, surface, numbers)?;
    draw_correlation(correlation, numbers)?;
    draw_bearing(bearing, surface, numbers)?;
    root.present()?;
    Ok(())
}

fn draw_heights(area: &Canvas<'_>, surface: &Heights, numbers: &Numbers) -> Result<(), Box<dyn Error>> {
    let (nx, ny) = (surface.nx(), surface.ny());
    let (width, height, x_label, y_label) = match &numbers.grid {
        Some(grid) => (grid.size_x() * 1e6, grid.size_y() * 1e6, "x (um)", "y (um)"),
        None => (nx as f64, ny as f64, "x (points)", "y (points)"),
    };
    let heights = defined_heights(surface);
    let (low, high) = range(&heights);
    let middle = 0.5 * (low + high);
    // a spike must not take all colours
    let mean = high - numbers.curve.height_at(0.0);
    let colours = [1.0 - OUTLIERS, OUTLIERS].map(|ratio| mean + numbers.curve.height_at(ratio));
    let colours = if colours[0] < colours[1] { (colours[0], colours[1]) } else { (middle, middle + 1.0) };
    draw_map(
        area,
        &Map {
            title: format!(
                "Height, {:.4} to {:.4} um (colours {:.4} to {:.4} um)",
                low * 1e6,
                high * 1e6,
                colours.0 * 1e6,
                colours.1 * 1e6
            ),
            x_label,
            y_label,
            x: 0.0..width,
            y: 0.0..height,
            nx,
            ny,
            values: surface.heights(),
            defined: surface.defined(),
        },
        colours,
    )
}

fn draw_correlation(area: &Canvas<'_>, numbers: &Numbers) -> Result<(), Box<dyn Error>> {
    let (Some(correlation), Some(grid)) = (&numbers.correlation, &numbers.grid) else {
        return note(area, "no autocorrelation: flat, or without spacing");
    };
    let (rx, ry) = correlation.reach();
    let (x, y) = ((rx as f64 + 0.5) * grid.dx() * 1e6, (ry as f64 + 0.5) * grid.dy() * 1e6);
    draw_map(
        area,
        &Map {
            title: "Autocorrelation, -1 to 1".to_owned(),
            x_label: "lag along x (um)",
            y_label: "lag along y (um)",
            x: -x..x,
            y: -y..y,
            nx: 2 * rx + 1,
            ny: 2 * ry + 1,
            values: correlation.values(),
            defined: None,
        },
        (-1.0, 1.0),
    )
}

/// Squares are single points of the field, so that nothing is averaged away.
fn draw_map(area: &Canvas<'_>, map: &Map<'_>, (low, high): (f64, f64)) -> Result<(), Box<dyn Error>> {
    let mut chart = ChartBuilder::on(area)
        .caption(&map.title, ("sans-serif", FONT + 2))
        .margin(10)
        .x_label_area_size(38)
        .y_label_area_size(58)
        .build_cartesian_2d(map.x.clone(), map.y.clone())?;
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc(map.x_label)
        .y_desc(map.y_label)
        .label_style(("sans-serif", FONT))
        .draw()?;
    let (columns, rows) = (map.nx.min(SQUARES), map.ny.min(SQUARES));
    let edge = |range: &Range<f64>, k: f64, n: usize| {
        range.start + (range.end - range.start) * (k / n as f64).min(1.0)
    };
    let squares = (0..columns * rows).filter_map(|square| {
        let (i, j) = (square % columns, square / columns);
        let point = (2 * j + 1) * map.ny / (2 * rows) * map.nx + (2 * i + 1) * map.nx / (2 * columns);
        let defined = map.defined.is_none_or(|mask| mask.get(point) == Some(&true));
        let value = *map.values.get(point)?;
        defined.then(|| {
            let (i, j) = (i as f64, j as f64);
            let from = (edge(&map.x, i, columns), edge(&map.y, j, rows));
            let to = (edge(&map.x, i + OVERLAP, columns), edge(&map.y, j + OVERLAP, rows));
            Rectangle::new([from, to], colour((value - low) / (high - low)).filled())
        })
    });
    chart.draw_series(squares)?;
    Ok(())
}

fn colour(share: f64) -> RGBColor {
    let position = if share.is_finite() { share.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64 } else { 0.0 };
    let low = (position as usize).min(SCALE.len() - 2);
    let part = position - low as f64;
    let channel = |k: usize| ((1.0 - part) * SCALE[low][k] + part * SCALE[low + 1][k]) as u8;
    RGBColor(channel(0), channel(1), channel(2))
}

fn draw_spectra(area: &Canvas<'_>, surface: &Heights, numbers: &Numbers) -> Result<(), Box<dyn Error>> {
    let Some(grid) = &numbers.grid else { return note(area, "no spectrum: without spacing") };
    let Some((along_x, along_y, radial)) = spectra(surface, grid) else {
        return note(area, "no spectrum: too few points");
    };
    // profiles in nm^3; the ring average times the wavenumber over pi has the same unit
    let radial = positive_points(&radial, |q, c| q * c / std::f64::consts::PI * CUBIC_NANOMETRES);
    let lines = [
        ("profiles along x", BLUE, positive_points(&along_x, |_, c| c * CUBIC_NANOMETRES)),
        ("profiles along y", VERMILION, positive_points(&along_y, |_, c| c * CUBIC_NANOMETRES)),
        ("q/pi times radial mean", GREEN, radial),
    ];
    let all = || lines.iter().flat_map(|(_, _, points)| points);
    let (q_low, q_high) = range(&all().map(|point| point.0).collect::<Vec<_>>());
    let (c_low, c_high) = range(&all().map(|point| point.1).collect::<Vec<_>>());
    if !(q_low < q_high && c_low < c_high) {
        return note(area, "no spectrum: flat");
    }
    let mut chart = ChartBuilder::on(area)
        .caption("Spectral density, Hann window", ("sans-serif", FONT + 2))
        .margin(10)
        .x_label_area_size(38)
        .y_label_area_size(70)
        .build_cartesian_2d(
            (q_low..q_high).log_scale(),
            (c_low.max(c_high * 1e-12)..c_high * 1.5).log_scale(),
        )?;
    let power = |value: &f64| format!("{value:.0e}");
    chart
        .configure_mesh()
        .x_desc("wavenumber (1/m)")
        .y_desc("density (nm^3)")
        .x_label_formatter(&power)
        .y_label_formatter(&power)
        .light_line_style(WHITE)
        .label_style(("sans-serif", FONT))
        .draw()?;
    for (name, pen, points) in lines {
        chart
            .draw_series(LineSeries::new(points, &pen))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], pen));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE)
        .label_font(("sans-serif", FONT))
        .draw()?;
    Ok(())
}

/// Spectra of the surface with its holes filled.
fn spectra(surface: &Heights, grid: &Grid) -> Option<(Spectrum, Spectrum, Spectrum)> {
    let mut filled = surface.clone();
    filled.fill_undefined().ok()?;
    let heights = filled.heights();
    Some((
        profile_spectrum(grid, heights, Axis::X, Boundary::Open).ok()?,
        profile_spectrum(grid, heights, Axis::Y, Boundary::Open).ok()?,
        radial_spectrum(grid, heights, Boundary::Open).ok()?,
    ))
}

fn positive_points(spectrum: &Spectrum, density: impl Fn(f64, f64) -> f64) -> Vec<(f64, f64)> {
    let points = spectrum.wavenumber.iter().zip(&spectrum.density);
    points.map(|(&q, &c)| (q, density(q, c))).filter(|&(_, c)| c > 0.0).collect()
}

fn draw_bearing(area: &Canvas<'_>, surface: &Heights, numbers: &Numbers) -> Result<(), Box<dyn Error>> {
    let curve = &numbers.curve;
    let (top, bottom) = (curve.height_at(0.0) * 1e6, curve.height_at(1.0) * 1e6);
    let Ok(histogram) = height_histogram(&defined_heights(surface), CLASSES) else {
        return note(area, "no bearing curve: flat");
    };
    let mut chart = ChartBuilder::on(area)
        .caption("Bearing curve and height distribution", ("sans-serif", FONT + 2))
        .margin(10)
        .x_label_area_size(38)
        .y_label_area_size(70)
        .build_cartesian_2d(0.0..1.0, bottom..top)?;
    chart
        .configure_mesh()
        .y_label_formatter(&|height| format!("{}", (height * 1e6).round() / 1e6 + 0.0))
        .x_desc("material ratio")
        .y_desc("height about the mean (um)")
        .light_line_style(WHITE)
        .label_style(("sans-serif", FONT))
        .draw()?;
    let densest = histogram.density.iter().copied().fold(0.0, f64::max);
    let step = (top - bottom) / CLASSES as f64;
    let bars = histogram.density.iter().enumerate().map(|(k, density)| {
        let low = bottom + k as f64 * step;
        Rectangle::new([(0.0, low), (0.5 * density / densest, low + step)], BLUE.mix(0.25).filled())
    });
    chart.draw_series(bars)?;
    let points = (0..=POINTS).map(|k| {
        let ratio = k as f64 / POINTS as f64;
        (ratio, curve.height_at(ratio) * 1e6)
    });
    chart.draw_series(LineSeries::new(points, &VERMILION))?;
    Ok(())
}

fn note(area: &Canvas<'_>, text: &str) -> Result<(), Box<dyn Error>> {
    area.draw(&Text::new(text.to_owned(), (60, 60), ("sans-serif", FONT)))?;
    Ok(())
}

fn range(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &v| (low.min(v), high.max(v)))
}
