//! Performance profiles.

use super::{Axes, Line, Svg, colour, draw_legend, legend_height};
use crate::benchmark::results::Results;
use crate::benchmark::row::Row;

/// Largest factor that is shown.
const LARGEST_FACTOR: f64 = 100.0;
/// Shortest time of a solve in a profile \[s\]; shorter ones count as equal.
const LEAST_SECONDS: f64 = 1e-6;
/// Cost of a run.
type Cost = fn(&Row) -> f64;

const PANEL: (f64, f64) = (480.0, 380.0);

impl Results {
    /// Share of the runs that a contestant solves with at most a factor of the work of the best one, over this
    /// factor, for convolutions and seconds (Dolan and More, Math. Program. 91, 2002, 201-213).
    pub fn performance_profile(&self) -> String {
        svg(self)
    }
}

/// Profiles of convolutions and of seconds.
fn svg(results: &Results) -> String {
    let contestants = results.contestants();
    let head = legend_height(contestants.len());
    let mut svg = Svg::new(2.0 * PANEL.0, head + PANEL.1);
    draw_legend(&mut svg, &contestants);
    let problems = results.problems(&contestants);
    let costs: [(&str, Cost); 2] =
        [("convolutions", Row::work), ("seconds", |row| row.seconds.max(LEAST_SECONDS))];
    for (k, (unit, cost)) in costs.into_iter().enumerate() {
        let axes = Axes {
            title: &format!("{} runs by {unit}", problems.len()),
            x_label: "factor over the best contestant",
            y_label: "share solved",
            log_x: true,
            log_y: false,
            lines: lines(&problems, contestants.len(), cost),
        };
        axes.draw(&mut svg, (k as f64 * PANEL.0, head), PANEL);
    }
    svg.finish()
}

/// The profile of each contestant as steps.
fn lines(problems: &[Vec<&Row>], contestants: usize, cost: Cost) -> Vec<Line> {
    (0..contestants)
        .map(|k| {
            let mut points = vec![(1.0, 0.0)];
            for (solved, factor) in factors(problems, k, cost).into_iter().enumerate() {
                let before = solved as f64 / problems.len() as f64;
                points.extend([(factor, before), (factor, (solved + 1) as f64 / problems.len() as f64)]);
            }
            points.retain(|(factor, _)| *factor <= LARGEST_FACTOR);
            let last = points.last().map_or(0.0, |point| point.1);
            points.push((LARGEST_FACTOR, last));
            // The axis reaches to one.
            Line { colour: colour(k), points, width: 2.0, dashed: false, marked: false }
        })
        .chain([Line {
            colour: "#dddddd",
            points: vec![(1.0, 1.0)],
            width: 1.0,
            dashed: true,
            marked: false,
        }])
        .collect()
}

/// Costs of contestant `k` over those of the best one, of the runs that it solves, ascending.
pub(in crate::benchmark) fn factors(problems: &[Vec<&Row>], k: usize, cost: Cost) -> Vec<f64> {
    let solved = |row: &&&Row| row.is_solved() && cost(row) > 0.0;
    let mut factors: Vec<f64> = problems
        .iter()
        .filter_map(|rows| {
            let own = rows.get(k).filter(solved)?;
            let best = rows.iter().filter(solved).map(|row| cost(row)).fold(f64::INFINITY, f64::min);
            Some(cost(own) / best)
        })
        .collect();
    factors.sort_by(f64::total_cmp);
    factors
}
