//! One page: height map, profile, spectra, autocorrelation, height distribution and bearing curve.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use stribeck::metrics::{Axis, Spectrum, profile_spectrum, radial_spectrum};
use stribeck::surface::Heights;
use stribeck::{Boundary, Grid};

use super::curves::{draw_bearing, draw_histogram, draw_profile};
use super::{
    BLUE, Drawn, GREEN, Picture, TEXT_SIZE, TITLE_SIZE, VERMILION, colour, extremes, note, text, tick,
};
use crate::surface_numbers::Numbers;

const SIZE: (u32, u32) = (1600, 900);
const HEAD: i32 = 40;
/// Most squares along a side of a map.
const SQUARES: usize = 100;
/// Size of a square over their distance: without overlap, viewers show seams.
const OVERLAP: f64 = 1.5;
/// Colour of undefined points.
const GREY: RGBColor = RGBColor(170, 170, 170);
/// Share of the highest and of the lowest points that have no colour of their own.
const OUTLIERS: f64 = 0.005;
/// Sizes of labels and of the title of a map, in pixels.
const X_LABELS: u32 = 38;
const Y_LABELS: u32 = 80;
const CAPTION: u32 = 30;
/// Largest ratio of the sides of a map as drawn.
const MOST_RATIO: f64 = 5.0;
const CUBIC_NANOMETRES: f64 = 1e27;

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
    /// Grey where not set.
    defined: Option<&'a [bool]>,
}

/// The page of a surface.
pub(crate) struct Page<'a> {
    pub(crate) title: String,
    pub(crate) surface: &'a Heights,
    pub(crate) numbers: &'a Numbers,
}

impl Picture for Page<'_> {
    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<B: DrawingBackend>(&self, canvas: &DrawingArea<B, Shift>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let (head, body) = canvas.split_vertically(HEAD);
        let title = text(TITLE_SIZE).pos(Pos::new(HPos::Center, VPos::Center));
        head.draw(&Text::new(self.title.as_str(), (SIZE.0 as i32 / 2, HEAD / 2), title))?;
        let areas = body.split_evenly((2, 3));
        let [map, profile, spectrum, correlation, histogram, bearing] = areas.as_slice() else {
            return Ok(());
        };
        draw_heights(map, self.surface, self.numbers)?;
        draw_profile(profile, self.surface, self.numbers)?;
        draw_spectra(spectrum, self.surface, self.numbers)?;
        draw_correlation(correlation, self.numbers)?;
        draw_histogram(histogram, self.surface)?;
        draw_bearing(bearing, self.numbers)
    }
}

fn draw_heights<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    surface: &Heights,
    numbers: &Numbers,
) -> Drawn
where
    B::ErrorType: 'static,
{
    let (nx, ny) = (surface.nx(), surface.ny());
    let (width, height, x_label, y_label) = match &numbers.grid {
        Some(grid) => (grid.size_x() * 1e6, grid.size_y() * 1e6, "x (µm)", "y (µm)"),
        None => (nx as f64, ny as f64, "x (points)", "y (points)"),
    };
    let (low, high) = extremes(surface.defined_heights());
    let digits = tick(&(low * 1e5..high * 1e5));
    let middle = 0.5 * (low + high);
    // a spike must not take all colours
    let mean = high - numbers.curve.height_at(0.0);
    let colours = [1.0 - OUTLIERS, OUTLIERS].map(|ratio| mean + numbers.curve.height_at(ratio));
    let colours = if colours[0] < colours[1] { (colours[0], colours[1]) } else { (middle, middle + 1.0) };
    draw_map(
        area,
        &Map {
            title: format!(
                "Height, colours {} to {} µm{}",
                digits(&(colours.0 * 1e6)),
                digits(&(colours.1 * 1e6)),
                if surface.undefined() > 0 { ", grey: undefined" } else { "" }
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

fn draw_correlation<B: DrawingBackend>(area: &DrawingArea<B, Shift>, numbers: &Numbers) -> Drawn
where
    B::ErrorType: 'static,
{
    let (Some(correlation), Some(grid)) = (&numbers.correlation, &numbers.grid) else {
        return note(area, "no autocorrelation: flat, or without spacing");
    };
    let (rx, ry) = correlation.reach();
    let (x, y) = ((rx as f64 + 0.5) * grid.dx() * 1e6, (ry as f64 + 0.5) * grid.dy() * 1e6);
    draw_map(
        area,
        &Map {
            title: "Autocorrelation, -1 to 1".to_owned(),
            x_label: "lag along x (µm)",
            y_label: "lag along y (µm)",
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

/// Pixels that stay free on each side of a map and above it, so that lengths are equal along both axes, up to a ratio of the
/// sides.
fn room_beside((width, height): (u32, u32), map: &Map<'_>) -> [u32; 2] {
    let inside =
        [width.saturating_sub(Y_LABELS + 20), height.saturating_sub(X_LABELS + CAPTION + 20)].map(f64::from);
    let sides = (map.x.end - map.x.start, map.y.end - map.y.start);
    let ratio = (sides.1 / sides.0).clamp(1.0 / MOST_RATIO, MOST_RATIO);
    let shown = inside[0].min(inside[1] / ratio);
    [(0.5 * (inside[0] - shown)) as u32, (inside[1] - ratio * shown) as u32]
}

/// Squares are single points of the field, so that nothing is averaged away.
fn draw_map<B: DrawingBackend>(area: &DrawingArea<B, Shift>, map: &Map<'_>, (low, high): (f64, f64)) -> Drawn
where
    B::ErrorType: 'static,
{
    let (x_number, y_number) = (tick(&map.x), tick(&map.y));
    let [side, top] = room_beside(area.dim_in_pixel(), map);
    let mut chart = ChartBuilder::on(area)
        .caption(&map.title, text(TEXT_SIZE + 1))
        .margin(10)
        .margin_left(10 + side)
        .margin_right(10 + side)
        .margin_top(10 + top)
        .x_label_area_size(X_LABELS)
        .y_label_area_size(Y_LABELS)
        .build_cartesian_2d(map.x.clone(), map.y.clone())?;
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc(map.x_label)
        .y_desc(map.y_label)
        .x_labels(6)
        .x_label_formatter(&|v| x_number(v))
        .y_label_formatter(&|v| y_number(v))
        .label_style(text(TEXT_SIZE))
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
        let fill = if defined { colour((value - low) / (high - low)) } else { GREY };
        let (i, j) = (i as f64, j as f64);
        let from = (edge(&map.x, i, columns), edge(&map.y, j, rows));
        let to = (edge(&map.x, i + OVERLAP, columns), edge(&map.y, j + OVERLAP, rows));
        Some(Rectangle::new([from, to], fill.filled()))
    });
    chart.draw_series(squares)?;
    Ok(())
}

fn draw_spectra<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    surface: &Heights,
    numbers: &Numbers,
) -> Drawn
where
    B::ErrorType: 'static,
{
    let Some(grid) = &numbers.grid else { return note(area, "no spectrum: without spacing") };
    let Some(lines) = spectra(surface, grid) else { return note(area, "no spectrum: too few points") };
    let all = || lines.iter().flat_map(|(_, _, points)| points);
    let (q_low, q_high) = extremes(all().map(|point| point.0));
    let (c_low, c_high) = extremes(all().map(|point| point.1));
    if !(q_low < q_high && c_low < c_high) {
        return note(area, "no spectrum: flat");
    }
    let mut chart = ChartBuilder::on(area)
        .caption("Spectral density, Hann window", text(TEXT_SIZE + 1))
        .margin(10)
        .x_label_area_size(38)
        .y_label_area_size(70)
        .build_cartesian_2d(
            (q_low..q_high).log_scale(),
            (c_low.max(c_high * 1e-12)..c_high * 1.5).log_scale(),
        )?;
    let c_decades = powers(c_low.max(c_high * 1e-12), c_high);
    chart
        .configure_mesh()
        .x_desc("wavenumber (1/m)")
        .y_desc("density (nm^3)")
        .x_label_formatter(&powers(q_low, q_high))
        .y_label_formatter(&c_decades)
        .light_line_style(WHITE)
        .label_style(text(TEXT_SIZE))
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
        .label_font(text(TEXT_SIZE))
        .draw()?;
    Ok(())
}

/// Labels of a logarithmic axis: of two decades and more the powers of ten alone.
fn powers(low: f64, high: f64) -> impl Fn(&f64) -> String {
    let is_long = high >= 100.0 * low;
    move |value| {
        let exponent = value.log10();
        let is_power = (exponent - exponent.round()).abs() < 1e-6;
        if is_power || !is_long { format!("{value:.0e}") } else { String::new() }
    }
}

/// A line of a spectrum: name, colour and points.
type SpectrumLine = (&'static str, RGBColor, Vec<(f64, f64)>);

/// Spectra of the surface with its holes filled, in nm^3; a line of points has one along it. `None` without any.
fn spectra(surface: &Heights, grid: &Grid) -> Option<Vec<SpectrumLine>> {
    let mut filled = surface.clone();
    filled.fill_undefined().ok()?;
    let heights = filled.heights();
    let plain = |_: f64, c: f64| c * CUBIC_NANOMETRES;
    // times the wavenumber over pi the ring average has the unit of the others
    let ring = |q: f64, c: f64| q * c / std::f64::consts::PI * CUBIC_NANOMETRES;
    let along_x = profile_spectrum(grid, heights, Axis::X, Boundary::Open).ok();
    let along_y = profile_spectrum(grid, heights, Axis::Y, Boundary::Open).ok();
    let radial =
        radial_spectrum(grid, heights, Boundary::Open).ok().filter(|_| grid.nx() > 1 && grid.ny() > 1);
    let lines = [
        along_x.map(|found| ("profiles along x", BLUE, positive_points(&found, plain))),
        along_y.map(|found| ("profiles along y", VERMILION, positive_points(&found, plain))),
        radial.map(|found| ("q/pi times radial mean", GREEN, positive_points(&found, ring))),
    ];
    let lines: Vec<SpectrumLine> = lines.into_iter().flatten().collect();
    (!lines.is_empty()).then_some(lines)
}

fn positive_points(spectrum: &Spectrum, density: impl Fn(f64, f64) -> f64) -> Vec<(f64, f64)> {
    let points = spectrum.wavenumber.iter().zip(&spectrum.density);
    points.map(|(&q, &c)| (q, density(q, c))).filter(|&(_, c)| c > 0.0).collect()
}
