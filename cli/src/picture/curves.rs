//! Curves of the page of a surface: profile, height distribution, bearing curve.

use plotters::coord::Shift;
use plotters::prelude::*;
use stribeck::metrics::height_histogram;
use stribeck::surface::Heights;

use super::{BLUE, Drawn, GREEN, TEXT_SIZE, VERMILION, extremes, note, text, tick};
use crate::surface_numbers::Numbers;

/// Most points of a curve.
const POINTS: usize = 400;
const CLASSES: usize = 60;
/// Share of the range that is left free above and below a profile.
const MARGIN: f64 = 0.05;

/// Heights about the mean along the middle row, with gaps where they are undefined.
pub(super) fn draw_profile<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    surface: &Heights,
    numbers: &Numbers,
) -> Drawn
where
    B::ErrorType: 'static,
{
    let (nx, row) = (surface.nx(), surface.ny() / 2);
    let (scale, label) = match surface.dx() {
        Some(dx) => (dx * 1e6, "x (µm)"),
        None => (1.0, "x (points)"),
    };
    let mean = numbers.mean;
    let heights = surface.heights_or_nan();
    let points: Vec<(f64, f64)> =
        (0..nx).map(|i| ((i as f64 + 0.5) * scale, (heights[row * nx + i] - mean) * 1e6)).collect();
    let (low, high) = extremes(points.iter().map(|point| point.1));
    if nx < 2 || low >= high {
        return note(area, "no profile: flat, or a single column");
    }
    let margin = MARGIN * (high - low);
    let y = low - margin..high + margin;
    let (x_number, y_number) = (tick(&(0.0..nx as f64 * scale)), tick(&y));
    let mut chart = ChartBuilder::on(area)
        .caption(format!("Profile, row {row}"), text(TEXT_SIZE + 1))
        .margin(10)
        .x_label_area_size(38)
        .y_label_area_size(80)
        .build_cartesian_2d(0.0..nx as f64 * scale, y)?;
    chart
        .configure_mesh()
        .x_desc(label)
        .x_label_formatter(&|v| x_number(v))
        .x_labels(7)
        .y_desc("height about the mean (µm)")
        .x_labels(6)
        .y_label_formatter(&|v| y_number(v))
        .light_line_style(WHITE)
        .label_style(text(TEXT_SIZE))
        .draw()?;
    for run in points.split(|point| point.1.is_nan()).filter(|run| !run.is_empty()) {
        chart.draw_series(LineSeries::new(outline(run), &BLUE))?;
    }
    Ok(())
}

/// The lowest and the highest point of each of [`POINTS`] pieces of a long line, a short one as it is.
fn outline(run: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if run.len() <= 4 * POINTS {
        return run.to_vec();
    }
    let pieces = run.chunks(run.len().div_ceil(POINTS));
    let ends = pieces.flat_map(|piece| {
        let of = |sign: f64| piece.iter().copied().min_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1)));
        let mut ends: Vec<(f64, f64)> = [of(1.0), of(-1.0)].into_iter().flatten().collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        ends
    });
    ends.collect()
}

/// Density of the heights in classes.
pub(super) fn draw_histogram<B: DrawingBackend>(area: &DrawingArea<B, Shift>, surface: &Heights) -> Drawn
where
    B::ErrorType: 'static,
{
    let Ok(histogram) = height_histogram(&surface.defined_heights(), CLASSES) else {
        return note(area, "no height distribution: flat");
    };
    let (low, width) = (histogram.lowest * 1e6, histogram.width * 1e6);
    let density: Vec<f64> = histogram.density.iter().map(|density| density * 1e-6).collect();
    let (_, densest) = extremes(density.iter().copied());
    let x = low..low + width * CLASSES as f64;
    let (x_number, y_number) = (tick(&x), tick(&(0.0..1.05 * densest)));
    let mut chart = ChartBuilder::on(area)
        .caption("Height distribution", text(TEXT_SIZE + 1))
        .margin(10)
        .x_label_area_size(38)
        .y_label_area_size(84)
        .build_cartesian_2d(x, 0.0..1.05 * densest)?;
    chart
        .configure_mesh()
        .x_desc("height (µm)")
        .x_labels(6)
        .y_desc("density (1/µm)")
        .x_label_formatter(&|v| x_number(v))
        .y_label_formatter(&|v| y_number(v))
        .light_line_style(WHITE)
        .label_style(text(TEXT_SIZE))
        .draw()?;
    let bars = density.iter().enumerate().map(|(k, density)| {
        let left = low + k as f64 * width;
        Rectangle::new([(left, 0.0), (left + width, *density)], BLUE.mix(0.5).filled())
    });
    chart.draw_series(bars)?;
    Ok(())
}

/// The bearing curve with the equivalent line of the core, its ends and the ratios at which they cut the curve.
pub(super) fn draw_bearing<B: DrawingBackend>(area: &DrawingArea<B, Shift>, numbers: &Numbers) -> Drawn
where
    B::ErrorType: 'static,
{
    let curve = &numbers.curve;
    let (top, bottom) = (curve.height_at(0.0) * 1e6, curve.height_at(1.0) * 1e6);
    if top <= bottom {
        return note(area, "no bearing curve: flat");
    }
    let core = curve.core();
    let number = tick(&(0.01 * bottom..0.01 * top));
    let mut chart = ChartBuilder::on(area)
        .caption(
            format!(
                "Bearing curve, Sk {} Spk {} Svk {} µm",
                number(&(core.sk * 1e6)),
                number(&(core.spk * 1e6)),
                number(&(core.svk * 1e6))
            ),
            text(TEXT_SIZE + 1),
        )
        .margin(10)
        .x_label_area_size(38)
        .y_label_area_size(70)
        .build_cartesian_2d(0.0..1.0, bottom..top)?;
    chart
        .configure_mesh()
        .y_label_formatter(&|height| format!("{}", (height * 1e6).round() / 1e6 + 0.0))
        .x_desc("material ratio")
        .x_labels(6)
        .y_desc("height about the mean (µm)")
        .light_line_style(WHITE)
        .label_style(text(TEXT_SIZE))
        .draw()?;
    let points = (0..=POINTS).map(|k| {
        let ratio = k as f64 / POINTS as f64;
        (ratio, curve.height_at(ratio) * 1e6)
    });
    chart.draw_series(LineSeries::new(points, &VERMILION))?;
    let (line_top, line_bottom) = curve.equivalent_line();
    let (line_top, line_bottom) = (line_top * 1e6, line_bottom * 1e6);
    let construction = [
        vec![(0.0, line_top), (1.0, line_bottom)],
        vec![(0.0, line_top), (core.smr1, line_top), (core.smr1, bottom)],
        vec![(1.0, line_bottom), (core.smr2, line_bottom), (core.smr2, bottom)],
    ];
    for points in construction {
        chart.draw_series(LineSeries::new(points, &GREEN))?;
    }
    Ok(())
}
