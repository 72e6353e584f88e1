//! Coordinates along the first row and the first column of a matrix.

use super::header::Header;
use super::lateral::{Lateral, lateral_of};
use super::number::decimals;
use super::pairs::split_unit;
use super::raster::Axis;
use super::style::Style;
use super::table::Table;
use crate::error::Error;
use crate::source::Source;
use crate::unit::LengthUnit;

/// A line of coordinates behind a title in the corner.
pub(super) struct Corner {
    /// Coordinates along x.
    numbers: Vec<f64>,
    decimals: i32,
    /// Unit in the title.
    unit: Option<LengthUnit>,
}

/// Coordinates that were cut off.
pub(super) struct Edges {
    /// Distances of the points; `None` where the coordinates count them.
    pub(super) lateral: Option<Lateral>,
    pub(super) warning: Option<String>,
}

impl Corner {
    /// The coordinates in the line before rows of `columns` numbers, if it holds a title and numbers.
    pub(super) fn read(line: &str, style: Style, columns: usize) -> Option<Self> {
        let fields = style.separator.split(line.trim_end().trim_start_matches(['#', '%']));
        let (title, rest) = fields.split_first()?;
        let numbers: Option<Vec<f64>> =
            rest.iter().map(|field| style.decimal.parse(field).filter(|number| !number.is_nan())).collect();
        let numbers = numbers.filter(|numbers| numbers.len() + 1 == columns && columns > 2)?;
        let unit = LengthUnit::parse(split_unit(title).1).or(LengthUnit::parse(title));
        let decimals = rest.iter().map(|field| decimals(field)).max().unwrap_or_default();
        Some(Self { numbers, decimals, unit })
    }
}

/// Cuts coordinates off the table, if it has them: a first column below `corner`, a first row that is one number
/// shorter than the others, or both around an empty field.
pub(super) fn cut_edges(
    source: Source<'_>,
    header: &Header,
    table: &mut Table,
    corner: Option<Corner>,
) -> Result<Option<Edges>, Error> {
    let columns = table.columns;
    if let Some(Corner { numbers, decimals, unit }) = corner {
        table.require_even(source)?;
        let below = table.column(0);
        let digits = [decimals, table.decimals.first().copied().unwrap_or_default()];
        cut(table, 0, columns);
        return edges(source, header, [numbers, below], digits, unit).map(Some);
    }
    let most = |table: &Table| table.decimals.iter().copied().max().unwrap_or_default();
    // all rows but the first have one number more
    let is_short = table.ragged.is_some_and(|(_, count)| count == columns + 1)
        && table.rows > 2
        && table.values.len() == columns + (table.rows - 1) * (columns + 1);
    if is_short {
        let along: Vec<f64> = table.values.drain(..columns).collect();
        (table.columns, table.rows, table.ragged) = (columns + 1, table.rows - 1, None);
        let below = table.column(0);
        let digits = [most(table); 2];
        cut(table, 0, columns + 1);
        return edges(source, header, [along, below], digits, None).map(Some);
    }
    if !table.has_empty_corner || table.ragged.is_some() || columns < 3 || table.rows < 3 {
        return Ok(None);
    }
    let along: Vec<f64> = table.values[1..columns].to_vec();
    let below: Vec<f64> = table.column(0).split_off(1);
    let digits = [most(table), table.decimals.first().copied().unwrap_or_default()];
    // an empty field may be an undefined height, too: coordinates begin with zero or one
    let begins =
        |numbers: &[f64]| numbers.first().is_some_and(|first| *first == 0.0 || (first - 1.0).abs() < 1e-12);
    let are_axes = [&along, &below].iter().zip(digits).all(|(numbers, digits)| {
        begins(numbers)
            && numbers.iter().all(|n| n.is_finite())
            && is_rising(numbers)
            && Axis::of(numbers, digits).is_ok()
    });
    if !are_axes {
        return Ok(None);
    }
    cut(table, columns, columns);
    let mut edges = edges(source, header, [along, below], digits, None)?;
    edges.warning = Some("the first row and the first column are read as coordinates".to_owned());
    Ok(Some(edges))
}

/// Whether numbers rise all along.
fn is_rising(numbers: &[f64]) -> bool {
    numbers.windows(2).all(|pair| pair[0] < pair[1])
}

/// Leaves out the first `start` numbers and the first column of the rest, of rows of `columns` numbers.
fn cut(table: &mut Table, start: usize, columns: usize) {
    let mut place = 0;
    table.values.retain(|_| {
        place += 1;
        place > start && (place - 1) % columns != 0
    });
    table.columns = columns - 1;
    table.rows = table.values.len() / table.columns.max(1);
}

/// Spacings of coordinates, which must be equidistant.
fn edges(
    source: Source<'_>,
    header: &Header,
    coordinates: [Vec<f64>; 2],
    digits: [i32; 2],
    unit: Option<LengthUnit>,
) -> Result<Edges, Error> {
    let axis = |k: usize, name: &str| {
        let numbers = &coordinates[k];
        let refused = |what: String| source.unsupported(format!("coordinates along {name} {what}"));
        if !is_rising(numbers) && !numbers.windows(2).all(|pair| pair[0] > pair[1]) {
            return Err(refused("neither rise nor fall all along".to_owned()));
        }
        let axis = Axis::of(numbers, digits[k]).ok().filter(|axis| axis.count == numbers.len());
        axis.ok_or_else(|| refused("are not equidistant".to_owned()))
    };
    let axes = [axis(0, "the first row")?, axis(1, "the first column")?];
    let has_unit = unit.or(header.lateral_unit(0)).or(source.options.unit).is_some();
    let counts_points = |axis: Axis| {
        (axis.spacing - 1.0).abs() < 1e-9 && (axis.first == 0.0 || (axis.first - 1.0).abs() < 1e-9)
    };
    let are_indices = axes.iter().all(|axis| counts_points(*axis)) && !has_unit;
    let lateral = if are_indices { None } else { lateral_of(source, header, axes, [unit; 2])? };
    Ok(Edges { lateral, warning: None })
}
