//! A grid of panels: curves over a logarithmic axis.

use std::error::Error;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

const WIDTH: u32 = 960;
const HEIGHT: u32 = 250;
const HEAD: u32 = 44;
/// Palette of Okabe and Ito.
const COLORS: [RGBColor; 4] =
    [RGBColor(213, 94, 0), RGBColor(0, 114, 178), RGBColor(0, 158, 115), RGBColor(230, 159, 0)];

/// A line with a mark at each point.
pub(crate) struct Curve {
    /// Position in the legend.
    pub(crate) pen: usize,
    pub(crate) points: Points,
}

/// Points by x, y and whether the contact is solved: the marks of others are hollow.
pub(crate) type Points = Vec<(f64, f64, bool)>;

pub(crate) struct Panel {
    pub(crate) y_label: String,
    pub(crate) x_label: &'static str,
    /// Upper end of the y axis, which begins at zero.
    pub(crate) top: f64,
    /// Ranges of y with a grey background.
    pub(crate) bands: Vec<(f64, f64)>,
    pub(crate) curves: Vec<Curve>,
}

fn font(size: u32) -> FontDesc<'static> {
    ("sans-serif", size).into_font()
}

/// Draws the panels in rows of `columns`.
pub(crate) fn draw(
    path: &Path,
    columns: usize,
    legend: &[String],
    panels: &[Panel],
) -> Result<(), Box<dyn Error>> {
    let rows = panels.len().div_ceil(columns);
    let root = SVGBackend::new(path, (WIDTH, HEAD + HEIGHT * rows as u32)).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(HEAD);
    for (k, name) in legend.iter().enumerate() {
        let x = 70 + 150 * k as i32;
        head.draw(&PathElement::new(vec![(x, 22), (x + 28, 22)], COLORS[k].stroke_width(3)))?;
        head.draw(&Text::new(name.as_str(), (x + 36, 13), font(18)))?;
    }
    for (area, panel) in body.split_evenly((rows, columns)).iter().zip(panels) {
        draw_panel(area, panel)?;
    }
    root.present()?;
    Ok(())
}

fn draw_panel(area: &DrawingArea<SVGBackend<'_>, Shift>, panel: &Panel) -> Result<(), Box<dyn Error>> {
    let mut ticks: Vec<f64> =
        panel.curves.iter().flat_map(|curve| &curve.points).map(|point| point.0).collect();
    ticks.sort_unstable_by(f64::total_cmp);
    ticks.dedup();
    let (Some(first), Some(last)) = (ticks.first(), ticks.last()) else { return Ok(()) };
    let x = 0.85 * first..1.18 * last;
    let y_label = |y: &f64| if panel.top > 2.0 { format!("{y:.0}") } else { format!("{y:.2}") };
    let mut chart = ChartBuilder::on(area)
        .margin(6)
        .margin_right(16)
        .x_label_area_size(48)
        .y_label_area_size(62)
        .build_cartesian_2d(x.clone().log_scale().with_key_points(ticks.clone()), 0.0..panel.top)?;
    let mesh = &mut chart.configure_mesh();
    mesh.x_desc(panel.x_label).y_desc(panel.y_label.as_str()).x_labels(ticks.len()).y_labels(5);
    mesh.label_style(font(15)).axis_desc_style(font(17));
    mesh.x_label_formatter(&|x| format!("{}", (100.0 * x).round() / 100.0)).y_label_formatter(&y_label);
    mesh.light_line_style(TRANSPARENT).bold_line_style(BLACK.mix(0.12)).draw()?;
    for (low, high) in &panel.bands {
        let corners = [(x.start, low.max(0.0)), (x.end, high.min(panel.top))];
        chart.draw_series([Rectangle::new(corners, BLACK.mix(0.18).filled())])?;
    }
    for Curve { pen, points } in panel.curves.iter().rev() {
        let color = COLORS[*pen];
        let line = points.iter().map(|(x, y, _)| (*x, *y));
        chart.draw_series(LineSeries::new(line, color.stroke_width(2)))?;
        chart.draw_series(points.iter().map(|(x, y, is_solved)| {
            let style = if *is_solved { color.filled() } else { color.stroke_width(1) };
            Circle::new((*x, *y), 4, style)
        }))?;
    }
    Ok(())
}
