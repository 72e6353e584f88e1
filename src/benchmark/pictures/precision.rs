//! Charts of error over work.

use super::{Axes, Line, Svg, colour, draw_legend, legend_height};
use crate::benchmark::limits::Quantity;
use crate::benchmark::results::{Results, distinct};
use crate::benchmark::row::Row;

/// Cases that have a panel each.
const MOST_PANELS: usize = 6;
const PANEL: (f64, f64) = (480.0, 340.0);

/// One point: seconds, convolutions and error.
type Point = [f64; 3];

impl Results {
    /// Errors over seconds and over convolutions: lines over the tolerances of each mesh, and one over the meshes
    /// at the smallest tolerance. The error of a mesh itself is a broken line. Up to six cases have a panel
    /// each; the values of more are geometric means over the cases that all contestants solve. Errors are those from
    /// the limits of a case, or else from its solution on the finest mesh at the smallest tolerance.
    pub fn work_precision(&self) -> String {
        svg(self)
    }
}

/// Charts of errors over seconds and over convolutions.
fn svg(results: &Results) -> String {
    let contestants = results.contestants();
    let cases = distinct(results.rows().iter().map(|row| row.case.as_str()));
    let groups: Vec<(String, Vec<&str>)> = if cases.len() <= MOST_PANELS {
        cases.iter().map(|case| ((*case).to_owned(), vec![*case])).collect()
    } else {
        vec![(format!("{} cases, geometric means", cases.len()), cases)]
    };
    let head = legend_height(contestants.len());
    let mut svg = Svg::new(2.0 * PANEL.0, head + groups.len() as f64 * PANEL.1);
    draw_legend(&mut svg, &contestants);
    for (row, (title, cases)) in groups.iter().enumerate() {
        let chart = Chart::of(results, &contestants, cases);
        for (column, unit) in ["seconds", "convolutions"].into_iter().enumerate() {
            let axes = Axes {
                title,
                x_label: unit,
                y_label: "error",
                log_x: true,
                log_y: true,
                lines: chart.lines(column),
            };
            axes.draw(&mut svg, (column as f64 * PANEL.0, head + row as f64 * PANEL.1), PANEL);
        }
    }
    svg.finish()
}

/// Points of each contestant, by mesh (ascending) and tolerance (descending).
struct Chart {
    points: Vec<Vec<Vec<Point>>>,
}

impl Chart {
    fn of(results: &Results, contestants: &[&str], cases: &[&str]) -> Self {
        let mut cells = distinct(results.rows().iter().filter(|row| is_of(row, cases)).map(|row| row.cells));
        cells.sort_unstable();
        let mut tolerances = distinct(results.rows().iter().map(|row| row.tolerance));
        tolerances.sort_by(|a, b| b.total_cmp(a));
        let rows = solved_by_all(results, contestants, cases);
        let of = |contestant: &&str| {
            let on_mesh = |cells: &usize| {
                let at = |tolerance: &f64| mean(results, &rows, (contestant, *cells, *tolerance));
                tolerances.iter().filter_map(at).collect()
            };
            cells.iter().map(on_mesh).collect()
        };
        Self { points: contestants.iter().map(of).collect() }
    }

    /// Lines of errors over the costs of a column.
    fn lines(&self, column: usize) -> Vec<Line> {
        let mut lines = self.floors(column);
        for (k, meshes) in self.points.iter().enumerate() {
            let line = |points: Vec<&Point>, width: f64| Line {
                colour: colour(k),
                points: points.iter().map(|point| (point[column], point[2])).collect(),
                width,
                dashed: false,
                marked: true,
            };
            lines.extend(meshes.iter().map(|points| line(points.iter().collect(), 1.0)));
            lines.push(line(meshes.iter().filter_map(|points| points.last()).collect(), 2.5));
        }
        lines.retain(|line| !line.points.is_empty());
        lines
    }

    /// The error of each mesh: the least one at the smallest tolerance, over the range of costs.
    fn floors(&self, column: usize) -> Vec<Line> {
        let all = || self.points.iter().flatten().flatten();
        let range = |of: fn(f64, f64) -> f64, start: f64| all().map(|point| point[column]).fold(start, of);
        let ends = [range(f64::min, f64::INFINITY), range(f64::max, 0.0)];
        let meshes = self.points.first().map_or(0, Vec::len);
        (0..meshes)
            .filter_map(|mesh| {
                let last = self.points.iter().filter_map(|meshes| meshes.get(mesh)?.last());
                let floor = last.map(|point| point[2]).reduce(f64::min)?;
                let points = ends.map(|end| (end, floor)).to_vec();
                Some(Line { colour: "#888888", points, width: 1.0, dashed: true, marked: false })
            })
            .collect()
    }
}

fn is_of(row: &Row, cases: &[&str]) -> bool {
    cases.contains(&row.case.as_str())
}

/// Rows of the cases. Of several cases only the runs that all contestants solve, so that means are of the same
/// runs.
fn solved_by_all<'a>(results: &'a Results, contestants: &[&str], cases: &[&str]) -> Vec<&'a Row> {
    if let [case] = cases {
        return results.rows().iter().filter(|row| row.case == *case && row.is_solved()).collect();
    }
    let problems = results.problems(contestants).into_iter();
    problems.filter(|rows| rows.iter().all(|row| row.is_solved())).flatten().collect()
}

/// Geometric means of costs and errors of a contestant at a mesh and tolerance.
fn mean(results: &Results, rows: &[&Row], key: (&str, usize, f64)) -> Option<Point> {
    let (contestant, cells, tolerance) = key;
    let (mut sums, mut count) = ([0.0; 3], 0);
    for row in rows {
        let is_key = row.contestant == contestant
            && row.cells == cells
            && row.tolerance.to_bits() == tolerance.to_bits();
        let Some(error) = Some(row).filter(|_| is_key).and_then(|row| error(results, row)) else { continue };
        let point = [row.seconds, row.work(), error];
        if point.iter().all(|value| *value > 0.0) {
            sums.iter_mut().zip(point).for_each(|(sum, value)| *sum += value.ln());
            count += 1;
        }
    }
    (count > 0).then(|| sums.map(|sum| (sum / f64::from(count)).exp()))
}

/// Error from the limits of the case, or else from its solution on the finest mesh at the smallest tolerance.
fn error(results: &Results, row: &Row) -> Option<f64> {
    if !row.error.is_nan() {
        return Some(row.error);
    }
    let solved = results.rows().iter().filter(|other| other.case == row.case && other.is_solved());
    let best = solved.reduce(|best, other| {
        let is_finer =
            other.cells > best.cells || (other.cells == best.cells && other.tolerance < best.tolerance);
        if is_finer { other } else { best }
    })?;
    let errors = Quantity::ALL.into_iter().filter_map(|quantity| {
        let error = quantity.error(row.value(quantity), best.value(quantity));
        error.is_finite().then_some(error)
    });
    errors.reduce(f64::max)
}
