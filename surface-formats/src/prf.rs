//! Profiles and surfaces of the SMD format of ISO 5436-2 (`.prf`, `.smd`).
//!
//! Three records that end with the line `EOR` or the control character ETX: names and axes, free text, heights. A
//! checksum may follow; it is not verified. An axis is its name, type (`I` at equal distances), number of points, unit,
//! factor and type of numbers, between blanks or NUL, and perhaps its increment, which the factor multiplies.

use crate::error::Error;
use crate::source::{Source, decode_text, shortened};
use crate::surface::Surface;
use crate::text::number::parse_height;
use crate::unit::LengthUnit;

/// End of a record: a line, or a control character.
const END: &str = "EOR";
const ETX: char = '\u{3}';
/// Place of the increment among the fields of an axis.
const INCREMENT: usize = 6;
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

/// Whether the content is text but for NUL and ETX, with an axis before the first ETX.
pub(crate) fn has_control_characters(bytes: &[u8]) -> bool {
    let Some(end) = bytes.iter().position(|&byte| byte == ETX as u8) else { return false };
    let head = &bytes[..end];
    head.iter().all(|&byte| byte >= b' ' || matches!(byte, 0 | b'\t' | b'\n' | b'\r'))
        && head.windows(3).any(|start| matches!(start, b"CX " | b"CX\0"))
}

/// The heights of a file whose records end with ETX.
pub(crate) fn read_with_control_characters(source: Source<'_>) -> Result<Surface, Error> {
    let content = decode_text(source.bytes).replace('\0', " ");
    let mut lines = Vec::new();
    for (line, text) in content.lines().enumerate() {
        for (part, text) in text.split(ETX).enumerate() {
            lines.extend((part > 0).then_some((line + 1, END)));
            lines.extend((!text.trim().is_empty()).then_some((line + 1, text)));
        }
    }
    read(source, &lines)
}

/// The heights of the third record.
pub(crate) fn read(source: Source<'_>, lines: &[Line<'_>]) -> Result<Surface, Error> {
    let mut records = lines.split(|(_, line)| line.trim() == END);
    let head = records.next().unwrap_or_default();
    let data =
        records.nth(1).ok_or_else(|| source.corrupt("fewer than three records (EOR or ETX)".to_owned()))?;
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
    let mut surface = Surface { unit: Some(z.unit), ..Surface::new(nx, ny, heights) };
    if z.count != nx * ny {
        surface.warnings.push(format!("the axis CZ counts {} heights, the file holds {}", z.count, nx * ny));
    }
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
    let number =
        |field: &str| parse_height(field).filter(|value| value.is_finite()).ok_or_else(|| wrong(field));
    let increment = fields.get(INCREMENT).map_or(Ok(1.0), |field| number(field))?;
    // units are written in capitals
    let unit = source.unit(&unit.to_lowercase(), name)?;
    Ok(Axis {
        is_equidistant: kind == "I",
        count: points as usize,
        unit,
        metres: number(factor)? * increment * unit.metres(),
        name,
    })
}
