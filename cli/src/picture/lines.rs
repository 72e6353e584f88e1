//! Line charts: panels one below the other with a common x axis.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{Drawn, Picture, TEXT_SIZE, TITLE_SIZE, extremes, text, tick};

const WIDTH: u32 = 900;
const HEAD: i32 = 40;
/// Heights of a panel, of the numbers and of the name below the last one.
const PANEL: i32 = 190;
const FOOT: i32 = 56;
const LEFT: u32 = 84;
/// Height of a second x axis.
const UPPER: i32 = 20;
/// Points of a line of fewer are dots too.
const FEW: usize = 40;

/// Size of a legend over that of the axes: its width, and the height of a line.
const LEGEND_WIDTH: f64 = 0.2;
const LEGEND_LINE: f64 = 0.17;

type Axes<'a, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// A line through points.
pub(crate) struct Line {
    /// In the legend; empty for none.
    pub(crate) name: &'static str,
    pub(crate) colour: RGBColor,
    pub(crate) points: Vec<(f64, f64)>,
    /// Lower and upper edge of a band around the line, at its x; empty for none.
    pub(crate) bands: Vec<(f64, [f64; 2])>,
}

/// A pair of axes with its curves.
pub(crate) struct Panel {
    pub(crate) y_label: String,
    pub(crate) lines: Vec<Line>,
    /// Values above are cut off; none for all.
    pub(crate) highest: Option<f64>,
    pub(crate) y_scale: Scale,
}

impl Panel {
    /// All lines from zero on.
    pub(crate) fn new(y_label: impl Into<String>, lines: Vec<Line>) -> Self {
        Self { y_label: y_label.into(), lines, highest: None, y_scale: Scale::Linear }
    }

    /// Positive values on a logarithmic scale.
    pub(crate) fn logarithmic(y_label: impl Into<String>, mut lines: Vec<Line>) -> Self {
        let decade = |v: f64| if v > 0.0 { v.log10() } else { f64::NAN };
        for line in &mut lines {
            line.points.iter_mut().for_each(|point| point.1 = decade(point.1));
            line.bands.iter_mut().flat_map(|(_, edges)| edges).for_each(|edge| *edge = decade(*edge));
            line.bands.retain(|(_, edges)| edges.iter().all(|edge| edge.is_finite()));
        }
        Self { y_scale: Scale::Decades, ..Self::new(y_label, lines) }
    }
}

/// The numbers of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scale {
    /// The values.
    Linear,
    /// Logarithms to base 10, labelled with the values.
    Decades,
}

/// A line chart.
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) x_label: &'static str,
    pub(crate) x_scale: Scale,
    /// A second x axis above the panels.
    pub(crate) upper: Option<UpperAxis>,
    pub(crate) panels: Vec<Panel>,
}

/// A second x axis.
pub(crate) struct UpperAxis {
    pub(crate) label: &'static str,
    /// Places on the first x axis and their labels.
    pub(crate) ticks: Vec<(f64, String)>,
}

impl Picture for Chart {
    fn size(&self) -> (u32, u32) {
        (WIDTH, (HEAD + self.upper_height() + PANEL * self.panels.len() as i32 + FOOT) as u32)
    }

    fn draw<B: DrawingBackend>(&self, canvas: &DrawingArea<B, Shift>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let (head, body) = canvas.split_vertically(HEAD);
        let title = text(TITLE_SIZE).pos(Pos::new(HPos::Center, VPos::Center));
        head.draw(&Text::new(self.title.as_str(), (WIDTH as i32 / 2, HEAD / 2), title))?;
        let x = self.x_range();
        let ends: Vec<i32> = (1..self.panels.len() as i32).map(|k| self.upper_height() + k * PANEL).collect();
        let areas = body.split_by_breakpoints([] as [i32; 0], ends);
        for (k, (area, panel)) in areas.iter().zip(&self.panels).enumerate() {
            self.draw_panel(area, panel, x.clone(), [k == 0, k + 1 == self.panels.len()])?;
        }
        Ok(())
    }
}

impl Scale {
    /// The label of a tick; of decades whole powers of ten alone.
    fn number(self, v: f64, plain: &dyn Fn(&f64) -> String) -> String {
        match self {
            Self::Linear => plain(&v),
            Self::Decades if (v - v.round()).abs() < 1e-9 => format!("{}", 10_f64.powi(v.round() as i32)),
            Self::Decades => String::new(),
        }
    }
}

impl Chart {
    /// Height of the second x axis.
    fn upper_height(&self) -> i32 {
        if self.upper.is_some() { UPPER } else { 0 }
    }

    /// The highest panel has the second x axis of all, the lowest one names the first.
    fn draw_panel<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        panel: &Panel,
        x: Range<f64>,
        [highest, lowest]: [bool; 2],
    ) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let y = panel.y_range();
        let (plain, y_number) = (tick(&x), tick(&y));
        let x_number = |v: &f64| self.x_scale.number(*v, &plain);
        let y_number = |v: &f64| panel.y_scale.number(*v, &y_number);
        let mut chart = ChartBuilder::on(area)
            .margin_left(8)
            .margin_right(24)
            .margin_top(8 + if highest { self.upper_height() } else { 0 })
            .margin_bottom(4)
            .x_label_area_size(if lowest { FOOT } else { 24 })
            .y_label_area_size(LEFT)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .x_desc(if lowest { self.x_label } else { "" })
            .y_desc(panel.y_label.as_str())
            .axis_desc_style(text(TEXT_SIZE + 1))
            .label_style(text(TEXT_SIZE))
            .x_labels(9)
            .y_labels(5)
            .x_label_formatter(&x_number)
            .y_label_formatter(&y_number)
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12))
            .draw()?;
        panel.draw_lines(&mut chart)?;
        match self.upper.as_ref().filter(|_| highest) {
            Some(upper) => upper.draw(&mut chart),
            None => Ok(()),
        }
    }

    fn x_range(&self) -> Range<f64> {
        let lines = self.panels.iter().flat_map(|panel| &panel.lines);
        let (low, high) = extremes(lines.flat_map(|line| &line.points).map(|point| point.0));
        if high > low { low..high } else { low - 0.5..low + 0.5 }
    }
}

impl UpperAxis {
    /// Ticks with their labels along the upper edge, and the name to the left of them.
    fn draw<'a, B: DrawingBackend + 'a>(&self, chart: &mut Axes<'a, B>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let (x, y) = (chart.x_range(), chart.y_range());
        let label = |at, text: String, anchor| {
            let style = self::text(TEXT_SIZE).pos(Pos::new(anchor, VPos::Bottom));
            EmptyElement::at((at, y.end)) + Text::new(text, (0, -7), style)
        };
        let left = label(x.start, format!("{}  ", self.label), HPos::Right);
        chart.draw_series([left])?;
        for (at, text) in &self.ticks {
            let tick = PathElement::new(vec![(0, 0), (0, -5)], BLACK);
            chart.draw_series([EmptyElement::at((*at, y.end)) + tick])?;
            chart.draw_series([label(*at, text.clone(), HPos::Center)])?;
        }
        Ok(())
    }
}

impl Panel {
    fn draw_lines<'a, B: DrawingBackend + 'a>(&self, chart: &mut Axes<'a, B>) -> Drawn
    where
        B::ErrorType: 'static,
    {
        let y = chart.y_range();
        for line in &self.lines {
            let edge = |side: usize| line.bands.iter().map(move |(x, edges)| (*x, edges[side]));
            let outline: Vec<(f64, f64)> = edge(0).chain(edge(1).rev()).collect();
            if !outline.is_empty() {
                chart.draw_series([Polygon::new(outline, line.colour.mix(0.2))])?;
            }
            let style = ShapeStyle::from(line.colour).stroke_width(2);
            let known: Vec<(f64, f64)> = line.points.iter().copied().filter(|(_, v)| v.is_finite()).collect();
            let mut is_named = line.name.is_empty();
            for run in runs_below(&known, y.end) {
                let drawn = chart.draw_series(LineSeries::new(run, style))?;
                if !is_named {
                    let key = move |(x, y)| PathElement::new([(x, y), (x + 18, y)], style);
                    drawn.label(line.name).legend(key);
                    is_named = true;
                }
            }
            if known.len() < FEW {
                let dots = known.iter().filter(|(_, v)| y.contains(v));
                chart.draw_series(dots.map(|&point| Circle::new(point, 3, line.colour.filled())))?;
            }
        }
        if self.lines.iter().any(|line| !line.name.is_empty()) {
            let corner = self.free_corner(&chart.x_range(), &y);
            chart
                .configure_series_labels()
                .position(corner)
                .background_style(WHITE.mix(0.8))
                .label_font(text(TEXT_SIZE))
                .draw()?;
        }
        Ok(())
    }

    /// The corner of the axes with the fewest points in it, the upper left one of equals.
    fn free_corner(&self, x: &Range<f64>, y: &Range<f64>) -> SeriesLabelPosition {
        let share = |range: &Range<f64>, v: f64| (v - range.start) / (range.end - range.start);
        let points = || self.lines.iter().flat_map(|line| &line.points);
        let places: Vec<(f64, f64)> = points().map(|&(at, v)| (share(x, at), share(y, v))).collect();
        let corners = [
            (SeriesLabelPosition::UpperLeft, false, true),
            (SeriesLabelPosition::UpperRight, true, true),
            (SeriesLabelPosition::LowerLeft, false, false),
            (SeriesLabelPosition::LowerRight, true, false),
        ];
        let height = LEGEND_LINE * self.lines.len() as f64;
        let count = |right: bool, upper: bool| {
            let inside = |&(x, y): &(f64, f64)| {
                (if right { 1.0 - x } else { x }) < LEGEND_WIDTH && (if upper { 1.0 - y } else { y }) < height
            };
            places.iter().filter(|place| inside(place)).count()
        };
        let best = corners.into_iter().min_by_key(|(_, right, upper)| count(*right, *upper));
        best.map_or(SeriesLabelPosition::UpperLeft, |(position, _, _)| position)
    }

    /// From zero, or from the lowest value where it is negative, to a little above the highest.
    fn y_range(&self) -> Range<f64> {
        let values = self.lines.iter().flat_map(|line| &line.points).map(|point| point.1);
        let edges = self.lines.iter().flat_map(|line| &line.bands).flat_map(|(_, edges)| *edges);
        let (low, high) = extremes(values.chain(edges));
        if self.y_scale == Scale::Decades {
            // Whole decades, so that there are labels.
            return low.floor()..high.ceil().max(low.floor() + 1.0);
        }
        let (low, high) = (low.min(0.0), self.highest.map_or(high, |highest| high.min(highest)).max(0.0));
        let margin = if high > low { 0.06 * (high - low) } else { 1.0 };
        if low < 0.0 { low - margin..high + margin } else { 0.0..high + margin }
    }
}

/// The pieces of a line that are not above `top`, up to where they leave.
fn runs_below(points: &[(f64, f64)], top: f64) -> Vec<Vec<(f64, f64)>> {
    let (mut runs, mut run, mut last) = (Vec::new(), Vec::new(), None);
    for &(x, y) in points {
        if let Some((x0, y0)) = last
            && (y0 > top) != (y > top)
        {
            run.push((x0 + (top - y0) / (y - y0) * (x - x0), top));
        }
        if y > top {
            runs.push(std::mem::take(&mut run));
        } else {
            run.push((x, y));
        }
        last = Some((x, y));
    }
    runs.push(run);
    runs.retain(|run| !run.is_empty());
    runs
}

#[cfg(test)]
mod tests {
    use super::{Line, Panel, SeriesLabelPosition};
    use crate::picture::BLUE;

    fn corner(points: Vec<(f64, f64)>) -> SeriesLabelPosition {
        let line = Line { name: "film", colour: BLUE, points, bands: Vec::new() };
        Panel::new("film", vec![line]).free_corner(&(0.0..1.0), &(0.0..1.0))
    }

    #[test]
    fn legend_lies_in_a_corner_without_points() {
        assert!(matches!(corner(vec![(0.0, 0.0), (1.0, 1.0)]), SeriesLabelPosition::UpperLeft));
        let level = (0..=10).map(|k| (0.1 * f64::from(k), 0.95)).collect();
        assert!(matches!(corner(level), SeriesLabelPosition::LowerLeft));
    }

    #[test]
    fn logarithmic_panel_leaves_out_values_that_are_not_positive() {
        let points = vec![(0.0, 100.0), (1.0, 0.0), (2.0, -1.0)];
        let bands = vec![(0.0, [10.0, 1000.0]), (1.0, [-1.0, 1.0])];
        let line = Line { name: "", colour: BLUE, points, bands };
        let panel = Panel::logarithmic("film (nm)", vec![line]);
        let line = &panel.lines[0];
        assert!(
            (line.points[0].1 - 2.0).abs() < 1e-15 && line.points[1].1.is_nan() && line.points[2].1.is_nan()
        );
        assert!(line.bands.len() == 1 && (line.bands[0].1[1] - 3.0).abs() < 1e-15);
        assert_eq!(panel.y_range(), 1.0..3.0);
    }
}
