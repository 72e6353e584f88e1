//! Fields seen from above, side by side, each with axes and a colour bar.

use std::borrow::Cow;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use stribeck::Grid;
use stribeck::sim::HertzContact;

use super::{Drawn, Picture, TEXT_SIZE, TITLE_SIZE, colour, inner, text, tick};

/// Width of a field, of the axis and the margin on its left and of the bar with its numbers on its right, in
/// pixels.
const FIELD: u32 = 330;
const LEFT: u32 = 70;
const MARGIN: u32 = 8;
const BAR: i32 = 112;
/// Of these the bar itself.
const BAR_LEFT: u32 = 10;
const BAR_NUMBERS: u32 = 76;
/// Distance of the numbers from it.
const BAR_TICK: u32 = 6;
const HEAD: i32 = 40;
const TOP: u32 = 34;
const BOTTOM: u32 = 46;
/// Shades of a map: neighbours of one shade are one rectangle, which keeps files small.
const SHADES: f64 = 48.0;
/// Most cells along a side of a map; of more every second, third, ... is shown.
const CELLS: usize = 256;

/// A field, one value a node.
#[derive(Clone)]
pub(crate) struct Map<'a> {
    pub(crate) title: String,
    pub(crate) values: Cow<'a, [f64]>,
    /// Turns values into the unit of the title.
    pub(crate) factor: f64,
    /// Values of the first and the last colour, in that unit.
    pub(crate) range: (f64, f64),
    /// Whether the outline of the Hertz contact is drawn.
    pub(crate) outline: bool,
}

/// Fields of one grid, without the nodes of its rim.
pub(crate) struct Maps<'a> {
    pub(crate) title: String,
    pub(crate) grid: Grid,
    /// Its rim is drawn.
    pub(crate) hertz: HertzContact,
    pub(crate) maps: Vec<Map<'a>>,
}

impl Maps<'_> {
    fn height(&self) -> i32 {
        let shape = (self.grid.size_y() / self.grid.size_x()).clamp(0.25, 2.0);
        (f64::from(FIELD) * shape) as i32
    }

    fn width(&self) -> i32 {
        (MARGIN + LEFT + FIELD) as i32 + BAR
    }
}

impl Picture for Maps<'_> {
    fn size(&self) -> (u32, u32) {
        let height = HEAD + self.height() + (TOP + BOTTOM) as i32;
        ((self.width() * self.maps.len() as i32) as u32, height as u32)
    }

    fn draw<B: DrawingBackend>(&self, canvas: &DrawingArea<B, Shift>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let (head, body) = canvas.split_vertically(HEAD);
        let title = text(TITLE_SIZE).pos(Pos::new(HPos::Center, VPos::Center));
        head.draw(&Text::new(self.title.as_str(), (self.size().0 as i32 / 2, HEAD / 2), title))?;
        let ends: Vec<i32> = (1..self.maps.len() as i32).map(|k| k * self.width()).collect();
        for (area, map) in body.split_by_breakpoints(ends, [] as [i32; 0]).iter().zip(&self.maps) {
            let (field, bar) = area.split_horizontally(self.width() - BAR);
            self.draw_field(&field, map)?;
            draw_bar(&bar, map)?;
        }
        Ok(())
    }
}

impl Maps<'_> {
    fn draw_field<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, map: &Map<'_>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let grid = &self.grid;
        let edges = |first: f64, step: f64, places: Range<usize>| {
            let edge = |place: usize| (first + (place as f64 - 0.5) * step) * 1e6;
            edge(places.start)..edge(places.end)
        };
        let x = edges(grid.x(0), grid.dx(), inner(grid.nx()));
        let y = edges(grid.y(0), grid.dy(), inner(grid.ny()));
        let (x_number, y_number, sides) = (tick(&x), tick(&y), y.clone());
        let middle = (MARGIN + LEFT + FIELD / 2) as i32;
        let title = text(TEXT_SIZE + 1).pos(Pos::new(HPos::Center, VPos::Center));
        area.draw(&Text::new(map.title.as_str(), (middle, TOP as i32 / 2), title))?;
        let mut chart = ChartBuilder::on(area)
            .margin_top(TOP)
            .margin_left(MARGIN)
            .x_label_area_size(BOTTOM)
            .y_label_area_size(LEFT)
            .build_cartesian_2d(x, y)?;
        chart.draw_series(self.rectangles(map))?;
        if map.outline {
            let (a, b) = (self.hertz.half_width_x * 1e6, self.hertz.half_width_y * 1e6);
            if grid.is_strip() {
                for x in [-a, a] {
                    let side = [(x, sides.start), (x, sides.end)];
                    chart.draw_series(LineSeries::new(side, WHITE.stroke_width(1)))?;
                }
            } else {
                let (sin, cos) = self.hertz.angle.sin_cos();
                let ring = (0..=120).map(|k| (f64::from(k) * std::f64::consts::TAU / 120.0).sin_cos());
                let rim = ring.map(|(s, c)| (cos * a * c - sin * b * s, sin * a * c + cos * b * s));
                chart.draw_series(LineSeries::new(rim, WHITE.stroke_width(1)))?;
            }
        }
        chart
            .configure_mesh()
            .disable_mesh()
            .x_desc("x (µm)")
            .y_desc("y (µm)")
            .x_labels(5)
            .y_labels(5)
            .x_label_formatter(&|v| x_number(v))
            .y_label_formatter(&|v| y_number(v))
            .axis_desc_style(text(TEXT_SIZE))
            .label_style(text(TEXT_SIZE - 1))
            .draw()?;
        Ok(())
    }

    /// Runs of one shade along x.
    fn rectangles(&self, map: &Map<'_>) -> Vec<Rectangle<(f64, f64)>> {
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        let (low, high) = map.range;
        let shade = |value: f64| {
            let share = (map.factor * value - low) / (high - low);
            if share.is_finite() { (SHADES * share.clamp(0.0, 1.0)).round() } else { 0.0 }
        };
        let [stride_x, stride_y] = [nx, ny].map(|n| n.div_ceil(CELLS).max(1));
        let (half_x, half_y) = (0.5 * self.grid.dx(), 0.5 * self.grid.dy());
        let mut rectangles = Vec::new();
        let (columns, rows) = (inner(nx), inner(ny));
        let lines = map.values.chunks_exact(nx).enumerate().take(rows.end).skip(rows.start);
        for (j, row) in lines.step_by(stride_y) {
            let nodes = row.iter().copied().enumerate().take(columns.end).skip(columns.start);
            let shown: Vec<(usize, f64)> = nodes.step_by(stride_x).collect();
            let last_row = (j + stride_y - 1).min(rows.end - 1);
            for run in shown.chunk_by(|a, b| shade(a.1).total_cmp(&shade(b.1)).is_eq()) {
                let (Some(first), Some(last)) = (run.first(), run.last()) else { continue };
                let end = (last.0 + stride_x - 1).min(columns.end - 1);
                let corners = [
                    ((self.grid.x(first.0) - half_x) * 1e6, (self.grid.y(j) - half_y) * 1e6),
                    ((self.grid.x(end) + half_x) * 1e6, (self.grid.y(last_row) + half_y) * 1e6),
                ];
                rectangles.push(Rectangle::new(corners, colour(shade(first.1) / SHADES).filled()));
            }
        }
        rectangles
    }
}

fn draw_bar<B: DrawingBackend>(area: &DrawingArea<B, Shift>, map: &Map<'_>) -> Drawn
where
    B::ErrorType: 'static,
{
    let (low, high) = map.range;
    let number = tick(&(low..high));
    let mut chart = ChartBuilder::on(area)
        .margin_top(TOP)
        .margin_bottom(BOTTOM)
        .margin_left(BAR_LEFT)
        .right_y_label_area_size(BAR_NUMBERS)
        .build_cartesian_2d(0.0..1.0, low..high)?;
    let steps = SHADES as u32;
    let edge = |k: u32| low + (high - low) * f64::from(k) / f64::from(steps);
    chart.draw_series((0..steps).map(|k| {
        let fill = colour((f64::from(k) + 0.5) / f64::from(steps)).filled();
        Rectangle::new([(0.0, edge(k)), (1.0, edge(k + 1))], fill)
    }))?;
    chart
        .configure_mesh()
        .disable_mesh()
        .x_labels(0)
        .y_labels(6)
        .set_tick_mark_size(LabelAreaPosition::Right, BAR_TICK)
        .y_label_formatter(&|v| number(v))
        .label_style(text(TEXT_SIZE - 1))
        .draw()?;
    Ok(())
}
