//! Stability maps.

use super::{Anchor, Svg};
use crate::benchmark::results::{Results, distinct};
use crate::benchmark::row::{Row, Verdict};

/// Size of a cell, margins and gaps \[pixels\].
const CELL: (f64, f64) = (26.0, 12.0);
const LEFT: f64 = 230.0;
const HEAD: f64 = 46.0;
const TITLE: f64 = 74.0;
const GAP: f64 = 8.0;
/// Cells of a row without parameters.
const WRAP: usize = 30;

fn colour(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Converged => "#009e73",
        Verdict::MeshTooCoarse => "#56b4e9",
        Verdict::Stalled => "#e69f00",
        Verdict::MaxIterations => "#f0e442",
        Verdict::Diverged => "#d55e00",
        Verdict::Refused => "#aaaaaa",
        Verdict::FalselyConverged => "#000000",
        Verdict::OutOfBudget => "#cc79a7",
        Verdict::GivenUp => "#7a3b7a",
        Verdict::Panicked => "#8b0000",
        Verdict::WrongGrid => "#0072b2",
    }
}

/// One panel: rows of a contestant, a group, a mesh and a tolerance, in columns and lines.
struct Panel<'a> {
    title: String,
    columns: Vec<Key>,
    lines: Vec<Key>,
    cells: Vec<(usize, usize, &'a Row)>,
}

/// Values of some parameters.
type Key = Vec<(String, f64)>;

impl<'a> Panel<'a> {
    fn of(title: &str, rows: &[&'a Row]) -> Self {
        let solved = rows.iter().filter(|row| row.is_solved()).count();
        let title = format!("{title}: {solved} of {} converge", rows.len());
        Self::by_parameters(&title, rows).unwrap_or_else(|| Self::wrapped(title, rows))
    }

    /// Columns by the first two parameters, lines by the others; `None` if two rows share a place or most places
    /// are empty.
    fn by_parameters(title: &str, rows: &[&'a Row]) -> Option<Self> {
        let split = |row: &Row| {
            let (first, others) = row.parameters.split_at_checked(2)?;
            Some((first.to_vec(), others.to_vec()))
        };
        let keys: Vec<(Key, Key)> = rows.iter().map(|row| split(row)).collect::<Option<_>>()?;
        let sorted = |keys: Vec<Key>| {
            let mut keys = keys;
            let order = |a: &Key, b: &Key| {
                let pairs = a.iter().zip(b).map(|(a, b)| a.1.total_cmp(&b.1));
                pairs.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
            };
            keys.sort_by(order);
            keys
        };
        let columns = sorted(distinct(keys.iter().map(|key| key.0.clone())));
        let lines = sorted(distinct(keys.iter().map(|key| key.1.clone())));
        let place = |(row, key): (&&'a Row, &(Key, Key))| {
            let column = columns.iter().position(|other| *other == key.0)?;
            Some((column, lines.iter().position(|other| *other == key.1)?, *row))
        };
        let cells: Vec<(usize, usize, &Row)> = rows.iter().zip(&keys).map(place).collect::<Option<_>>()?;
        let places = distinct(cells.iter().map(|cell| (cell.0, cell.1)));
        let fits = places.len() == rows.len() && columns.len() * lines.len() <= 4 * rows.len();
        (fits && rows.len() > 1).then(|| Self { title: title.to_owned(), columns, lines, cells })
    }

    /// Rows one after the other.
    fn wrapped(title: String, rows: &[&'a Row]) -> Self {
        let cells = rows.iter().enumerate().map(|(k, row)| (k % WRAP, k / WRAP, *row)).collect();
        let lines = vec![Vec::new(); rows.len().div_ceil(WRAP)];
        Self { title, columns: vec![Vec::new(); WRAP.min(rows.len())], lines, cells }
    }

    fn size(&self) -> (f64, f64) {
        let gaps = |keys: &[Key]| keys.windows(2).filter(|pair| is_new_block(pair)).count() as f64 * GAP;
        (
            LEFT + self.columns.len() as f64 * CELL.0 + gaps(&self.columns) + 12.0,
            TITLE + self.lines.len() as f64 * CELL.1 + gaps(&self.lines) + 14.0,
        )
    }

    fn draw(&self, svg: &mut Svg, top: f64) {
        svg.text((10.0, top + 18.0), 15.0, Anchor::Start, &self.title);
        let x = positions(&self.columns, LEFT, CELL.0);
        let y = positions(&self.lines, top + TITLE, CELL.1);
        for (column, line, row) in &self.cells {
            let corner = (x[*column], y[*line]);
            svg.rectangle(corner, (CELL.0 - 1.0, CELL.1 - 1.0), colour(row.verdict));
        }
        for (k, key) in self.columns.iter().enumerate() {
            let [(outer, outer_value), (inner, inner_value)] = key.as_slice() else { continue };
            if k == 0 {
                svg.text((LEFT - 8.0, top + TITLE - 20.0), 11.0, Anchor::End, outer);
                svg.text((LEFT - 8.0, top + TITLE - 5.0), 11.0, Anchor::End, inner);
            }
            if k == 0 || is_new_block(&self.columns[k - 1..=k]) {
                svg.text((x[k], top + TITLE - 20.0), 12.0, Anchor::Start, &short(*outer_value));
            }
            let middle = (x[k] + 0.5 * CELL.0, top + TITLE - 5.0);
            svg.text(middle, 7.0, Anchor::Middle, &short(*inner_value));
        }
        for (k, key) in self.lines.iter().enumerate().filter(|(_, key)| !key.is_empty()) {
            let values: Vec<String> = key.iter().map(|(_, value)| short(*value)).collect();
            svg.text((LEFT - 8.0, y[k] + CELL.1 - 3.0), 10.0, Anchor::End, &values.join("  "));
            if k == 0 {
                let names: Vec<&str> = key.iter().map(|(name, _)| name.as_str()).collect();
                svg.text((10.0, top + 34.0), 10.0, Anchor::Start, &format!("lines: {}", names.join(", ")));
            }
        }
    }
}

/// Whether the first values of two neighbors differ while there are others.
fn is_new_block(pair: &[Key]) -> bool {
    match pair {
        [before, after] => before.len() > 1 && before.first() != after.first(),
        _ => false,
    }
}

/// Positions of columns or lines, with gaps between blocks.
fn positions(keys: &[Key], start: f64, step: f64) -> Vec<f64> {
    let mut gaps = 0.0;
    (0..keys.len())
        .map(|k| {
            if k > 0 && is_new_block(&keys[k - 1..=k]) {
                gaps += GAP;
            }
            start + k as f64 * step + gaps
        })
        .collect()
}

/// A number in few characters; infinity is the absence of a limit.
fn short(value: f64) -> String {
    match value {
        value if value.is_infinite() => "none".to_owned(),
        value if value == 0.0 || (1e-3..1e4).contains(&value.abs()) => format!("{value}"),
        value => format!("{value:e}"),
    }
}

impl Results {
    /// The verdict of every case, a panel for each contestant and group of cases. Cases with parameters are
    /// ordered by them: the first two along x, the others along y.
    pub fn stability_map(&self) -> String {
        svg(self)
    }
}

/// The map of all rows.
fn svg(results: &Results) -> String {
    let mut panels = Vec::new();
    let key = |row: &Row| (row.contestant.clone(), row.group().to_owned(), row.tolerance.to_bits());
    for panel in distinct(results.rows().iter().map(key)) {
        let (contestant, group, tolerance) = &panel;
        let tolerance = f64::from_bits(*tolerance);
        let rows: Vec<&Row> = results.rows().iter().filter(|row| key(row) == panel).collect();
        let title = format!("{contestant}, {group}, tolerance {tolerance:e}");
        panels.push(Panel::of(&title, &rows));
    }
    let sizes: Vec<(f64, f64)> = panels.iter().map(Panel::size).collect();
    let width = sizes.iter().fold(560.0_f64, |most, size| most.max(size.0));
    let mut svg = Svg::new(width, HEAD + sizes.iter().map(|size| size.1).sum::<f64>());
    let seen =
        Verdict::ALL.into_iter().filter(|verdict| results.rows().iter().any(|r| r.verdict == *verdict));
    for (k, verdict) in seen.enumerate() {
        let at = (10.0 + 138.0 * (k % 4) as f64, 10.0 + 16.0 * (k / 4) as f64);
        svg.rectangle(at, (11.0, 11.0), colour(verdict));
        svg.text((at.0 + 16.0, at.1 + 10.0), 12.0, Anchor::Start, &verdict.to_string());
    }
    let mut top = HEAD;
    for (panel, size) in panels.iter().zip(&sizes) {
        panel.draw(&mut svg, top);
        top += size.1;
    }
    svg.finish()
}
