//! Profiles and surfaces of the SMD format of ISO 5436-2 (`.prf`, `.smd`).
//!
//! Three records that end with `EOR`: names and axes, free text, heights. An axis is its name, type (`I` at
//! equal distances), number of points, unit, factor and type of numbers.

use crate::error::Error;
use crate::source::{Source, shortened};
use crate::surface::Surface;
use crate::text::number::parse_height;
use crate::unit::LengthUnit;

/// End of a record.
const END: &str = "EOR";
/// Lines among which the axes begin.
const HEAD: usize = 6;

/// A line of the file and its number.
type Line<'a> = (usize, &'a str);

/// One axis of the first record.
struct Axis<'a> {
    is_equidistant: bool,
    count: usize,
    /// Unit and metres per stored number.
    unit: LengthUnit,
    metres: f64,
    name: &'a str,
}

/// Whether the lines begin with a record of axes.
pub(crate) fn recognises(lines: &[Line<'_>]) -> bool {
    let is_axis = |line: &str| line.starts_with("CX ") && line.split_whitespace().count() >= 5;
    lines.iter().take(HEAD).any(|(_, line)| is_axis(line)) && lines.iter().any(|(_, line)| line.trim() == END)
}

/// The heights of the third record.
pub(crate) fn read(source: Source<'_>, lines: &[Line<'_>]) -> Result<Surface, Error> {
    let mut records = lines.split(|(_, line)| line.trim() == END);
    let head = records.next().unwrap_or_default();
    let data = records.nth(1).ok_or_else(|| source.corrupt("fewer than three records (EOR)".to_owned()))?;
    let axis = |name: &str| -> Result<Option<Axis<'_>>, Error> {
        let line = head.iter().find(|(_, line)| line.split_whitespace().next() == Some(name));
        line.map(|(number, line)| parse_axis(source, *number, line)).transpose()
    };
    let missing = |name: &str| source.corrupt(format!("the axis {name} is missing"));
    let x = axis("CX")?.ok_or_else(|| missing("CX"))?;
    let z = axis("CZ")?.ok_or_else(|| missing("CZ"))?;
    let y = axis("CY")?.filter(|axis| axis.count > 1);
    if let Some(axis) = [Some(&x), y.as_ref()].into_iter().flatten().find(|axis| !axis.is_equidistant) {
        let what = format!("axis {} is not of type I (equal distances)", axis.name);
        return Err(source.unsupported(what));
    }
    let [nx, ny] = [x.count, y.as_ref().map_or(1, |axis| axis.count)];
    let spacing = [x.metres, y.map_or(x.metres, |axis| axis.metres)];
    source.require_size(nx, ny, Some(spacing))?;
    let mut values = Vec::new();
    for (number, line) in data {
        for field in line.split_whitespace() {
            values.push(parse_height(field).ok_or_else(|| {
                source.corrupt(format!("line {number}: \"{}\" is not a number", shortened(field)))
            })?);
        }
    }
    if values.len() != nx * ny {
        let found = values.len();
        return Err(source.corrupt(format!("{found} heights, the axes say {nx} x {ny}")));
    }
    let heights = source.scaled(nx, values, -0.0, z.metres)?;
    let surface = Surface { unit: Some(z.unit), ..Surface::new(nx, ny, heights) };
    source.finish(surface.with_spacing(Some(spacing)))
}

/// The axis of a line.
fn parse_axis<'a>(source: Source<'_>, number: usize, line: &'a str) -> Result<Axis<'a>, Error> {
    let fields: Vec<&str> = line.split_whitespace().collect();
    let &[name, kind, count, unit, factor, ..] = fields.as_slice() else {
        return Err(source.corrupt(format!("line {number}: an axis has five fields at least")));
    };
    let wrong =
        |field: &str| source.corrupt(format!("line {number}: \"{}\" is not usable", shortened(field)));
    let points =
        parse_height(count).filter(|count| (1.0..1e9).contains(count)).ok_or_else(|| wrong(count))?;
    let factor_value = parse_height(factor).filter(|value| value.is_finite()).ok_or_else(|| wrong(factor))?;
    // units are written in capitals
    let unit = source.unit(&unit.to_lowercase(), name)?;
    Ok(Axis {
        is_equidistant: kind == "I",
        count: points as usize,
        unit,
        metres: factor_value * unit.metres(),
        name,
    })
}
