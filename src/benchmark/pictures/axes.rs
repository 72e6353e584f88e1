//! A chart with linear or logarithmic axes.

use super::svg::{Anchor, Svg};

/// Margins of the frame within its area \[pixels\].
const LEFT: f64 = 78.0;
const RIGHT: f64 = 20.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = 48.0;

/// A line of a chart.
#[derive(Debug, Clone)]
pub(in crate::benchmark) struct Line {
    pub(in crate::benchmark) colour: &'static str,
    pub(in crate::benchmark) points: Vec<(f64, f64)>,
    pub(in crate::benchmark) width: f64,
    pub(in crate::benchmark) dashed: bool,
    /// Whether the points have markers.
    pub(in crate::benchmark) marked: bool,
}

/// A chart.
#[derive(Debug)]
pub(in crate::benchmark) struct Axes<'a> {
    pub(in crate::benchmark) title: &'a str,
    pub(in crate::benchmark) x_label: &'a str,
    pub(in crate::benchmark) y_label: &'a str,
    /// Whether the x axis is logarithmic; then x values must be positive.
    pub(in crate::benchmark) log_x: bool,
    pub(in crate::benchmark) log_y: bool,
    pub(in crate::benchmark) lines: Vec<Line>,
}

/// One axis: its range, in decades if it is logarithmic, and its ticks.
struct Scale {
    is_log: bool,
    low: f64,
    high: f64,
    step: f64,
}

impl Scale {
    /// A scale that contains `values`.
    fn of(values: impl Iterator<Item = f64>, is_log: bool) -> Self {
        let (low, high) = values
            .map(|value| if is_log { value.log10() } else { value })
            .filter(|value| value.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        if is_log {
            let low = low.floor();
            let high = high.ceil().max(low + 1.0);
            let step = ((high - low) / 8.0).ceil();
            return Self { is_log, low, high, step };
        }
        let (low, high) = (low.min(0.0), if high > low { high } else { low + 1.0 });
        let rough = (high - low) / 5.0;
        let power = 10_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power).into_iter().find(|step| *step >= rough);
        Self { is_log, low, high, step: step.unwrap_or(rough) }
    }

    /// Share of the axis up to `value`.
    fn share(&self, value: f64) -> f64 {
        let value = if self.is_log { value.log10() } else { value };
        ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }

    /// Shares of the ticks with their labels.
    fn ticks(&self) -> Vec<(f64, String)> {
        let first = (self.low / self.step).ceil() as i64;
        let last = (self.high / self.step + 1e-9).floor() as i64;
        let tick = |k: i64| {
            let position = k as f64 * self.step;
            let label = match position {
                power if self.is_log && (-2.0..=3.0).contains(&power) => format!("{}", 10_f64.powf(power)),
                power if self.is_log => format!("1e{power}"),
                // Without the rounding error of the product.
                value => format!("{}", (value * 1e9).round() / 1e9),
            };
            ((position - self.low) / (self.high - self.low), label)
        };
        (first..=last).map(tick).collect()
    }
}

impl Axes<'_> {
    /// Draws the chart into the area with this corner and size.
    pub(in crate::benchmark) fn draw(&self, svg: &mut Svg, corner: (f64, f64), size: (f64, f64)) {
        let points = || self.lines.iter().flat_map(|line| &line.points);
        let x = Scale::of(points().map(|point| point.0), self.log_x);
        let y = Scale::of(points().map(|point| point.1), self.log_y);
        let (left, top) = (corner.0 + LEFT, corner.1 + TOP);
        let (width, height) = (size.0 - LEFT - RIGHT, size.1 - TOP - BOTTOM);
        let bottom = top + height;
        svg.text((left + 0.5 * width, top - 10.0), 15.0, Anchor::Middle, self.title);
        for (share, label) in x.ticks() {
            let at = left + share * width;
            svg.line(&[(at, top), (at, bottom)], "#dddddd", 1.0, false);
            svg.text((at, bottom + 16.0), 12.0, Anchor::Middle, &label);
        }
        for (share, label) in y.ticks() {
            let at = bottom - share * height;
            svg.line(&[(left, at), (left + width, at)], "#dddddd", 1.0, false);
            svg.text((left - 6.0, at + 4.0), 12.0, Anchor::End, &label);
        }
        svg.text((left + 0.5 * width, bottom + 36.0), 13.0, Anchor::Middle, self.x_label);
        svg.text((corner.0 + 8.0, top - 10.0), 13.0, Anchor::Start, self.y_label);
        let frame = [(left, top), (left + width, top), (left + width, bottom), (left, bottom), (left, top)];
        svg.line(&frame, "#000000", 1.0, false);
        if points().next().is_none() {
            svg.text((left + 0.5 * width, top + 0.5 * height), 13.0, Anchor::Middle, "no values");
        }
        for line in &self.lines {
            let place = |(px, py): &(f64, f64)| (left + x.share(*px) * width, bottom - y.share(*py) * height);
            let places: Vec<(f64, f64)> = line.points.iter().map(place).collect();
            if places.len() > 1 {
                svg.line(&places, line.colour, line.width, line.dashed);
            }
            for place in places.iter().filter(|_| line.marked) {
                svg.circle(*place, 1.5 + line.width, line.colour);
            }
        }
    }
}
