//! Numbers of a table without titles that do not look like heights.

use super::columns::Columns;
use super::table::Table;

/// Numbers from which on a count in front of heights can be told from a height.
const FEWEST: usize = 8;
/// Numbers from which on equal steps are no chance.
const FEWEST_STEPS: usize = 3;
/// Rounding of steps, over their size.
const ROUNDING: f64 = 1e-6;

/// A count in front of a single column of heights, perhaps behind a length or a second count.
pub(super) fn count_in_front(values: &[f64]) -> Option<String> {
    let rows = values.len();
    let is = |value: f64, count: usize| (value - count as f64).abs() < 1e-9;
    if rows < FEWEST {
        return None;
    }
    let (first, second) = (values[0], values[1]);
    if is(first, rows - 1) {
        Some(format!("the first number, {first}, counts the others"))
    } else if is(second, rows - 2) || is(first * second, rows - 2) {
        Some(format!("the first numbers, {first} and {second}, count the others"))
    } else {
        None
    }
}

/// Whether the first two of four or more columns are the positions of a map.
pub(super) fn begins_with_positions(table: &Table) -> bool {
    let Ok([x, y]) = Columns::new(Some(0), Some(1), 2).axes(table) else { return false };
    let nodes = x.count * y.count;
    let rows = table.rows;
    let is_map = x.count > 1 && y.count > 1 && rows > FEWEST_STEPS;
    if !is_map || nodes < rows || nodes > rows && (rows < FEWEST || nodes > 2 * rows) {
        return false;
    }
    let mut nodes: Vec<[usize; 2]> =
        table.values.chunks(table.columns).map(|row| [x.node(row[0]), y.node(row[1])]).collect();
    nodes.sort_unstable();
    nodes.windows(2).all(|pair| pair[0] != pair[1])
}

/// The warning of a matrix whose first row or first column rises in equal steps while the next does not.
pub(super) fn coordinates(table: &Table) -> Option<String> {
    let columns = table.columns;
    if columns < FEWEST_STEPS + 1 || table.rows < FEWEST_STEPS {
        return None;
    }
    let row = |k: usize| table.values[k * columns..(k + 1) * columns].to_vec();
    let stands_out = |first: &[f64], second: &[f64]| {
        rises_evenly(first) && !rises_evenly(second) && second.iter().all(|z| z.is_finite())
    };
    let has_corner = table.values[0].abs() < f64::MIN_POSITIVE && table.rows > FEWEST_STEPS;
    let (along, below) = (row(0), table.column(0));
    let is_corner = has_corner && rises_evenly(&along[1..]) && rises_evenly(&below[1..]);
    let found = match (is_corner, stands_out(&along, &row(1)), stands_out(&below, &table.column(1))) {
        (true, ..) | (_, true, true) => "the first row and the first column rise",
        (_, true, _) => "the first row rises",
        (_, _, true) => "the first column rises",
        _ => return None,
    };
    Some(format!(
        "{found} in equal steps, as coordinates do, and count as heights; a title before the coordinates of the first \
         row, \"um,0,1,2\", says that they are none"
    ))
}

/// Whether numbers rise in equal steps.
fn rises_evenly(numbers: &[f64]) -> bool {
    let (Some(first), Some(last)) = (numbers.first(), numbers.last()) else { return false };
    let step = (last - first) / (numbers.len().max(2) - 1) as f64;
    let is_even = |(k, number): (usize, &f64)| (number - first - k as f64 * step).abs() <= ROUNDING * step;
    numbers.len() >= FEWEST_STEPS && step > 0.0 && numbers.iter().enumerate().all(is_even)
}
