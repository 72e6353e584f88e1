//! ASCII exports of Wyko and Vision.
//!
//! Lines of name, type, length and value separated by tabs, then the block `RAW_DATA`: rows of heights in
//! wavelengths over the multiplier `Mult`, with `Bad` for undefined points.

use super::style::Line;
use crate::error::Error;
use crate::source::{Source, shortened, without_unit};
use crate::surface::{MAX_POINTS, Surface};
use crate::text::number::parse_height;
use crate::unit::LengthUnit;

/// Beginning of the first line.
pub(super) const MAGIC: &str = "Wyko ASCII Data File";
/// Names of the block of heights.
const HEIGHTS: [&str; 4] = ["RAW_DATA", "RAW DATA", "SAMPLE_DATA", "OPD"];

/// Numbers of the header.
struct Header<'a> {
    source: Source<'a>,
    lines: &'a [Line<'a>],
}

impl Header<'_> {
    /// The last field of the line that begins with `name`, as a positive number.
    fn positive(&self, name: &str) -> Result<Option<f64>, Error> {
        let Some((number, line)) = self.lines.iter().find(|(_, line)| line.split('\t').next() == Some(name))
        else {
            return Ok(None);
        };
        let text = line.trim_end().rsplit('\t').next().unwrap_or("");
        match parse_height(text).filter(|value| *value > 0.0) {
            Some(value) => Ok(Some(value)),
            None => Err(self.source.corrupt(format!(
                "line {number}: {name} = \"{}\" is not a positive number",
                shortened(text)
            ))),
        }
    }
}

/// Heights of the block `RAW_DATA`.
pub(super) fn read(source: Source<'_>, lines: &[Line<'_>]) -> Result<Surface, Error> {
    let is_start = |line: &str| line.split('\t').next().is_some_and(|name| HEIGHTS.contains(&name));
    let start = lines.iter().position(|(_, line)| is_start(line));
    let start = start.ok_or_else(|| source.corrupt(format!("no block {}", HEIGHTS[0])))?;
    let header = Header { source, lines: &lines[..start] };
    let (rows, columns) = (header.positive("X Size")?, header.positive("Y Size")?);
    let (values, nx, ny) = rows_of(source, &lines[start + 1..])?;
    if let (Some(rows), Some(columns)) = (rows, columns) {
        let is = |given: f64, found: usize| (given - found as f64).abs() < 0.5;
        let fits = is(rows, ny) && is(columns, nx) || is(rows, nx) && is(columns, ny);
        if !fits {
            let what = format!("{ny} rows of {nx} heights, the header says {rows} x {columns}");
            return Err(source.corrupt(what));
        }
    }
    let aspect = header.positive("Aspect")?.unwrap_or(1.0);
    // millimetres
    let spacing = header.positive("Pixel_size")?.map(|size| [aspect * size * 1e-3, size * 1e-3]);
    let unit = match (header.positive("Wavelength")?, header.positive("Mult")?) {
        (Some(wavelength), mult) => Some((LengthUnit::Nanometre, wavelength / mult.unwrap_or(1.0) * 1e-9)),
        (None, _) => source.options.unit.map(|unit| (unit, unit.metres())),
    };
    source.require_size(nx, ny, spacing)?;
    let heights = source.scaled(nx, values, -0.0, unit.map_or(1.0, |(_, metres)| metres))?;
    let mut surface = Surface { unit: unit.map(|(unit, _)| unit), ..Surface::new(nx, ny, heights) };
    if unit.is_none() {
        surface.warnings.push(without_unit("the header lacks Wavelength, the option unit names it"));
    }
    source.finish(surface.with_spacing(spacing))
}

/// The numbers of rows up to the next block, and how many there are along x and y.
fn rows_of(source: Source<'_>, lines: &[Line<'_>]) -> Result<(Vec<f64>, usize, usize), Error> {
    let (mut values, mut nx, mut ny) = (Vec::new(), 0, 0);
    for (number, line) in lines.iter().filter(|(_, line)| !line.trim().is_empty()) {
        let line = line.trim_end_matches(['\r', '\t', ' ']);
        let before = values.len();
        let fields = line.split('\t').enumerate();
        // the next block begins with its name and three numbers
        if ny > 0 && parse_height(line.split('\t').next().unwrap_or("")).is_none() {
            break;
        }
        for (column, field) in fields {
            let value = parse_height(field).ok_or_else(|| {
                let field = shortened(field);
                source.corrupt(format!("line {number}, field {}: \"{field}\" is not a number", column + 1))
            })?;
            if values.len() == MAX_POINTS {
                return Err(source.corrupt(format!("line {number}: more than 2^26 (67 million) heights")));
            }
            values.push(value);
        }
        let count = values.len() - before;
        if ny > 0 && count != nx {
            return Err(source.corrupt(format!("line {number}: {count} numbers, {nx} in the first row")));
        }
        (nx, ny) = (count, ny + 1);
    }
    Ok((values, nx, ny))
}
