//! Line charts: panels stacked in one SVG, with a legend above that covers no data. Shared by the examples.
#![allow(dead_code, reason = "not every example draws every kind of line")]

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Blue, vermilion and black of the palette of Okabe and Ito: told apart by all kinds of colour vision.
pub(crate) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(crate) const VERMILION: RGBColor = RGBColor(213, 94, 0);
pub(crate) const BLACK: RGBColor = RGBColor(0, 0, 0);

const SIZE: (u32, u32) = (800, 500);
const TITLE_FONT: u32 = 23;
const LABEL_FONT: u32 = 20;
const TICK_FONT: u32 = 18;
const LEGEND_ROW: i32 = 24;
const STUB: i32 = 30;
/// Heights of the numbers and of the name of the x axis.
const X_TICKS: i32 = 28;
const X_NAME: i32 = 24;

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// How a line is drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pen {
    /// Colour at full strength.
    pub(crate) colour: RGBColor,
    /// Thin and pale, for scattered values behind their mean.
    pub(crate) faint: bool,
    /// Broken.
    pub(crate) dashed: bool,
}

impl Pen {
    pub(crate) fn strong(colour: RGBColor) -> Self {
        Self { colour, faint: false, dashed: false }
    }

    pub(crate) fn faint(colour: RGBColor) -> Self {
        Self { colour, faint: true, dashed: false }
    }

    pub(crate) fn dashed(colour: RGBColor) -> Self {
        Self { colour, faint: false, dashed: true }
    }

    fn style(self) -> ShapeStyle {
        let (opacity, width) = if self.faint { (0.5, 1) } else { (1.0, 2) };
        ShapeStyle::from(self.colour.mix(opacity)).stroke_width(width)
    }
}

/// A line through points.
pub(crate) struct Line {
    pub(crate) pen: Pen,
    pub(crate) points: Vec<(f64, f64)>,
}

/// A pair of axes with its lines.
pub(crate) struct Panel {
    pub(crate) y_label: &'static str,
    pub(crate) lines: Vec<Line>,
}

/// The kind of numbers of an x axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum XScale {
    /// The values, from zero on.
    FromZero,
    /// Logarithms to base 10, labelled with the values.
    Decades,
}

/// A figure.
pub(crate) struct Figure {
    pub(crate) title: String,
    pub(crate) x_label: &'static str,
    pub(crate) x_scale: XScale,
    /// A sample of the line before each text.
    pub(crate) legend: Vec<(Pen, String)>,
    pub(crate) panels: Vec<Panel>,
}

impl Figure {
    /// Writes the figure; its panels stand one below the other with a common x axis.
    pub(crate) fn write(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        let root = SVGBackend::new(path, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let title = text_style(TITLE_FONT).pos(Pos::new(HPos::Center, VPos::Top));
        let (head, body) = root.split_vertically(38 + self.legend_rows() * LEGEND_ROW);
        head.draw(&Text::new(self.title.as_str(), (SIZE.0 as i32 / 2, 10), title))?;
        self.draw_legend(&head)?;
        let x = self.x_range();
        let count = self.panels.len();
        let height = (SIZE.1 as i32 - head.dim_in_pixel().1 as i32 - X_NAME) / count.max(1) as i32;
        let heights: Vec<i32> = (1..count as i32).map(|k| k * height).collect();
        let areas = body.split_by_breakpoints([] as [i32; 0], heights);
        for (k, (area, panel)) in areas.iter().zip(&self.panels).enumerate() {
            self.draw_panel(area, panel, x.clone(), k + 1 == count)?;
        }
        root.present()?;
        Ok(())
    }

    /// Positions of the legend's entries, left to right and row by row.
    fn legend_positions(&self) -> Vec<(i32, i32)> {
        let (mut x, mut row) = (80, 0);
        let mut positions = Vec::new();
        for (_, text) in &self.legend {
            // The width of a letter, 7.5, is a guess: the viewer's font is not known here.
            let width = STUB + 8 + text.chars().count() as i32 * 15 / 2 + 18;
            if x + width > SIZE.0 as i32 && x > 80 {
                (x, row) = (80, row + 1);
            }
            positions.push((x, row));
            x += width;
        }
        positions
    }

    fn legend_rows(&self) -> i32 {
        self.legend_positions().last().map_or(0, |(_, row)| row + 1)
    }

    fn draw_legend(&self, area: &Canvas<'_>) -> Result<(), Box<dyn Error>> {
        let style = text_style(TICK_FONT).pos(Pos::new(HPos::Left, VPos::Center));
        for ((x, row), (pen, text)) in self.legend_positions().into_iter().zip(&self.legend) {
            let y = 38 + row * LEGEND_ROW + LEGEND_ROW / 2;
            let pieces: &[(i32, i32)] = if pen.dashed { &[(0, 8), (11, 19), (22, 30)] } else { &[(0, STUB)] };
            for (from, to) in pieces {
                area.draw(&PathElement::new(vec![(x + from, y), (x + to, y)], pen.style()))?;
            }
            area.draw(&Text::new(text.as_str(), (x + STUB + 8, y), style.clone()))?;
        }
        Ok(())
    }

    /// The lowest panel names the x axis of all.
    fn draw_panel(
        &self,
        area: &Canvas<'_>,
        panel: &Panel,
        x: Range<f64>,
        lowest: bool,
    ) -> Result<(), Box<dyn Error>> {
        let y = y_range(&panel.lines);
        let (x_decimals, y_decimals) = (decimals(&x), decimals(&y));
        let x_number = |v: &f64| match self.x_scale {
            XScale::FromZero => format!("{v:.x_decimals$}"),
            XScale::Decades if (v - v.round()).abs() < 1e-9 => format!("{}", 10_f64.powi(v.round() as i32)),
            XScale::Decades => String::new(),
        };
        let many = self.panels.len() > 1;
        let mut chart = ChartBuilder::on(area)
            .margin_left(10)
            .margin_right(24)
            .margin_top(10)
            .margin_bottom(6)
            .x_label_area_size(if lowest { X_TICKS + X_NAME } else { X_TICKS })
            .y_label_area_size(74)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .x_desc(if lowest { self.x_label } else { "" })
            .y_desc(panel.y_label)
            .axis_desc_style(text_style(LABEL_FONT))
            .label_style(text_style(TICK_FONT))
            .x_labels(9)
            .y_labels(if many { 4 } else { 7 })
            .x_label_formatter(&x_number)
            .y_label_formatter(&|v| format!("{v:.y_decimals$}"))
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12))
            .draw()?;
        for line in &panel.lines {
            let points = line.points.iter().copied();
            if line.pen.dashed {
                chart.draw_series(DashedLineSeries::new(points, 8, 4, line.pen.style()))?;
            } else {
                chart.draw_series(LineSeries::new(points, line.pen.style()))?;
            }
        }
        Ok(())
    }

    /// From zero, or from the lowest point where it is negative, to the last point of all lines; decades are
    /// whole.
    fn x_range(&self) -> Range<f64> {
        let lines = self.panels.iter().flat_map(|panel| &panel.lines);
        let (low, high) = extremes(lines.flat_map(|line| &line.points).map(|point| point.0));
        if self.x_scale == XScale::Decades {
            return low.floor()..(high.ceil()).max(low.floor() + 1.0);
        }
        let low = low.min(0.0);
        if high > low { low..high } else { low..low + 1.0 }
    }
}

/// From zero, or from the lowest value where it is negative, to a little above the highest.
fn y_range(lines: &[Line]) -> Range<f64> {
    let (low, high) = extremes(lines.iter().flat_map(|line| &line.points).map(|point| point.1));
    let (low, high) = (low.min(0.0), high.max(0.0));
    let margin = if high > low { 0.05 * (high - low) } else { 1.0 };
    if low < 0.0 { low - margin..high + margin } else { 0.0..high + margin }
}

/// Smallest and largest finite value; zeros without any.
fn extremes(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let finite = values.filter(|value| value.is_finite());
    finite
        .fold(None, |found, v| found.map_or(Some((v, v)), |(l, h): (f64, f64)| Some((l.min(v), h.max(v)))))
        .unwrap_or((0.0, 0.0))
}

/// Decimals that tell the tick labels of `range` apart.
fn decimals(range: &Range<f64>) -> usize {
    (1.0 - (range.end - range.start).log10()).ceil().clamp(0.0, 9.0) as usize
}

fn text_style(size: u32) -> TextStyle<'static> {
    ("sans-serif", size).into_font().color(&BLACK)
}
