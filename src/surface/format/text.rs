//! Heights as delimited text, with or without a header that gives sizes and units.
//!
//! A file is lines of numbers, one row each, behind lines of a header whose keys several programs spell in
//! their own ways. What is read of a header is in [`Header::take`]: a new spelling is a word there. Sizes
//! give spacings by the number of points; a unit beside a number wins over the unit of its axis, that over
//! the one for all.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use super::source::{Found, Source, decode_text, is_utf_16, shortened};
use crate::grid::Grid;
use crate::surface::{Heights, LengthUnit, SurfaceError};

/// Bytes at the start that must look like text.
const LOOK: usize = 4096;

/// Whether the start of the file holds no bytes that text does not hold.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(LOOK)];
    is_utf_16(start)
        || !start.is_empty()
            && start.iter().all(|&byte| byte >= 0x20 || matches!(byte, b'\t' | b'\n' | b'\r' | 0x0c))
}

/// A height of a text file; the inner `None` is an undefined point.
pub(super) fn parse_height(token: &str) -> Option<Option<f64>> {
    if token.eq_ignore_ascii_case("bad") { Some(None) } else { token.parse().ok().map(Some) }
}

/// What the header says, as far as it is understood.
#[derive(Default)]
struct Header {
    /// Points along x.
    nx: Option<usize>,
    /// Points along y.
    ny: Option<usize>,
    /// Sizes and spacings with the unit that stands beside them.
    size: [Option<(f64, String)>; 2],
    /// Distance of the points along x and y.
    spacing: [Option<(f64, String)>; 2],
    /// Units of the axes.
    lateral_unit: [String; 2],
    /// Unit of the heights.
    height_unit: String,
    /// The one for both.
    unit: String,
    /// Heights in their unit per stored number.
    height_factor: Option<f64>,
    /// Heights to nanometres, of files without a height unit.
    nanometres: Option<f64>,
    /// Whether anything was understood.
    known: bool,
}

impl Header {
    /// Takes what a line says, if its key is known.
    fn take(&mut self, source: Source<'_>, line: &str) -> Result<(), SurfaceError> {
        let line = line.trim_start_matches(['#', '%', ';']).trim();
        let Some((key, value)) = line.split_once(['=', ':']) else {
            // "Height [nm]" as the title of what follows
            let (key, unit) = split_unit(line);
            if !unit.is_empty() && matches!(key.to_lowercase().as_str(), "z" | "height" | "heights") {
                unit.clone_into(&mut self.height_unit);
            }
            return Ok(());
        };
        let (key, unit) = split_unit(key);
        let (key, value) = (key.to_lowercase().replace(['-', '_'], " "), value.trim());
        let count = |value: &str| {
            value
                .parse::<usize>()
                .map_err(|_| source.corrupt(format!("{key} = {} is not a count", shortened(value))))
        };
        let length = |value: &str| {
            let found = quantity(value)
                .ok_or_else(|| source.corrupt(format!("{key} = {} is not a length", shortened(value))))?;
            Ok::<_, SurfaceError>(if found.1.is_empty() { (found.0, unit.to_owned()) } else { found })
        };
        match key.as_str() {
            "x pixels" | "nx" | "w" => self.nx = Some(count(value)?),
            "y pixels" | "ny" | "h" => self.ny = Some(count(value)?),
            // Gwyddion writes them in the language of its user
            "width"
            | "x length"
            | "x size"
            | "size x"
            | "breite"
            | "largeur"
            | "larghezza"
            | "anchura"
            | "largura"
            | "\u{161}\u{ed}\u{159}ka" => self.size[0] = Some(length(value)?),
            "height" | "y length" | "y size" | "size y" | "h\u{f6}he" | "hauteur" | "altezza" | "altura"
            | "v\u{fd}\u{161}ka" => {
                self.size[1] = Some(length(value)?);
            }
            "spacing x" | "x spacing" | "scale x" | "x scale" | "step x" | "x step" | "pixel size x"
            | "x pixel size" | "dx" => self.spacing[0] = Some(length(value)?),
            "spacing y" | "y spacing" | "scale y" | "y scale" | "step y" | "y step" | "pixel size y"
            | "y pixel size" | "dy" => self.spacing[1] = Some(length(value)?),
            "pixel size" | "spacing" | "step" => self.spacing = [Some(length(value)?), Some(length(value)?)],
            "x unit" => value.clone_into(&mut self.lateral_unit[0]),
            "y unit" => value.clone_into(&mut self.lateral_unit[1]),
            "unit x" | "lateral unit" | "lateral units" | "xy unit" | "xy units" => {
                self.lateral_unit = [value.to_owned(), value.to_owned()];
            }
            // one unit for all that has none of its own
            "unit" | "units" => value.clone_into(&mut self.unit),
            "value units" | "value unit" | "z unit" | "z units" | "unit z" | "unit data" | "height unit"
            | "height units" | "einheiten" | "unit\u{e9}s" | "unit\u{e0} valore" | "unidades de valor"
            | "jednotky hodnot" => {
                value.clone_into(&mut self.height_unit);
            }
            "bit2nm" => self.nanometres = Some(length(value)?.0),
            _ => {
                let Some(rest) = key.strip_prefix("height conversion factor") else { return Ok(()) };
                if let Some((_, unit)) = rest.split_once('>') {
                    unit.trim().trim_end_matches(')').clone_into(&mut self.height_unit);
                }
                self.height_factor = Some(length(value)?.0);
            }
        }
        self.known = true;
        Ok(())
    }

    /// Unit of the heights and metres per stored number.
    fn heights(&self, source: Source<'_>) -> Result<(Option<LengthUnit>, f64), SurfaceError> {
        let factor = self.height_factor.unwrap_or(1.0);
        let name = if self.height_unit.is_empty() { &self.unit } else { &self.height_unit };
        if name.is_empty() {
            return Ok(match self.nanometres {
                Some(nanometres) => (Some(LengthUnit::Nanometre), factor * nanometres * 1e-9),
                None => (None, factor),
            });
        }
        let unit = source.unit(name, "height")?;
        Ok((Some(unit), factor * unit.metres()))
    }

    /// Spacing \[m\] of `points` along an axis, where it is given.
    fn spacing(&self, source: Source<'_>, axis: usize, points: usize) -> Result<Option<f64>, SurfaceError> {
        let (length, shares) = match (&self.spacing[axis], &self.size[axis]) {
            (Some(spacing), _) => (spacing, 1),
            (None, Some(size)) => (size, points),
            (None, None) => return Ok(None),
        };
        let (value, beside) = length;
        let names = [beside, &self.lateral_unit[axis], &self.unit];
        let name = names.into_iter().find(|name| !name.is_empty()).unwrap_or(beside);
        let metres = if name.is_empty() { 1.0 } else { source.unit(name, "lateral")?.metres() };
        Ok(Some(value * metres / shares as f64))
    }
}

/// A key and the unit that follows it in brackets.
fn split_unit(key: &str) -> (&str, &str) {
    let key = key.trim();
    let inside = key.strip_suffix([')', ']']).and_then(|rest| rest.rsplit_once(['(', '[']));
    match inside {
        Some((key, unit)) if LengthUnit::parse(unit).is_some() => (key.trim(), unit.trim()),
        _ => (key, ""),
    }
}

/// A number, perhaps with a decimal comma, and what follows it, which is its unit.
fn quantity(text: &str) -> Option<(f64, String)> {
    let end = text
        .find(|c: char| !matches!(c, '0'..='9' | '+' | '-' | '.' | ',' | 'e' | 'E'))
        .unwrap_or(text.len());
    let value: f64 = text[..end].replacen(',', ".", 1).parse().ok()?;
    let unit = text[end..].trim().trim_start_matches(['(', '[']).trim_end_matches([')', ']']);
    value.is_finite().then(|| (value, unit.trim().to_owned()))
}

/// What stands between the numbers of a line.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Separator {
    Blanks,
    /// Blanks between numbers with decimal commas.
    BlanksDecimalComma,
    Comma,
    Semicolon,
}

impl Separator {
    /// What separates the fields of `line`.
    fn of(line: &str) -> Self {
        if line.contains(';') {
            Self::Semicolon
        } else if !line.contains(',') {
            Self::Blanks
        } else if line.contains('\t')
            || line.split_whitespace().nth(1).is_some() && line.split_whitespace().all(has_decimal_comma)
        {
            Self::BlanksDecimalComma
        } else {
            Self::Comma
        }
    }

    /// The fields of a line; a separator at its end is no further field.
    fn split(self, line: &str) -> Vec<&str> {
        let by = |separator: char| {
            let line = line.trim();
            line.strip_suffix(separator).unwrap_or(line).split(separator).map(str::trim).collect()
        };
        match self {
            Self::Blanks | Self::BlanksDecimalComma => line.split_whitespace().collect(),
            Self::Comma => by(','),
            Self::Semicolon => by(';'),
        }
    }

    /// Whether a separator that is no blank ends the line.
    fn ends(self, line: &str) -> bool {
        match self {
            Self::Blanks | Self::BlanksDecimalComma => false,
            Self::Comma => line.trim_end().ends_with(','),
            Self::Semicolon => line.trim_end().ends_with(';'),
        }
    }

    /// The height in a field, undefined when the field is empty.
    fn parse(self, field: &str) -> Option<Option<f64>> {
        if field.is_empty() {
            return Some(None);
        }
        let decimal_comma = matches!(self, Self::BlanksDecimalComma | Self::Semicolon);
        parse_height(field).or_else(|| {
            (decimal_comma && field.contains(','))
                .then(|| parse_height(&field.replacen(',', ".", 1)))
                .flatten()
        })
    }
}

/// Whether a number has digits on both sides of its only comma, if it has one.
fn has_decimal_comma(number: &str) -> bool {
    number.split_once(',').is_none_or(|(whole, rest)| {
        whole.ends_with(|c: char| c.is_ascii_digit())
            && rest.starts_with(|c: char| c.is_ascii_digit())
            && !rest.contains(',')
    })
}

/// The numbers of the rows read so far.
struct Rows {
    /// What separates fields.
    separator: Separator,
    /// Heights so far.
    values: Vec<f64>,
    /// Which of them are defined.
    defined: Vec<bool>,
    /// Rows so far.
    rows: usize,
    /// Numbers in the first row.
    columns: usize,
    /// Line and count of the first row of another length.
    ragged: Option<(usize, usize)>,
}

impl Rows {
    /// Rows that start with `line`, if its first field is a number.
    fn start(line: &str) -> Option<Self> {
        let separator = Separator::of(line);
        separator.split(line).first().and_then(|field| separator.parse(field))?;
        let (values, defined) = (Vec::new(), Vec::new());
        Some(Self { separator, values, defined, rows: 0, columns: 0, ragged: None })
    }

    /// Takes a row, which must be as long as those before.
    fn take(&mut self, source: Source<'_>, number: usize, line: &str) -> Result<(), SurfaceError> {
        let before = self.values.len();
        for (column, field) in self.separator.split(line).into_iter().enumerate() {
            let at = || format!("line {number}, field {}", column + 1);
            let height = self
                .separator
                .parse(field)
                .ok_or_else(|| source.corrupt(format!("{}: {} is not a number", at(), shortened(field))))?;
            if self.values.len() == Grid::MAX_NODES {
                return Err(source.corrupt(format!("{}: more than 2^26 (67 million) heights", at())));
            }
            self.values.push(height.unwrap_or(0.0));
            self.defined.push(height.is_some());
        }
        let mut count = self.values.len() - before;
        // what looked like the end of the line is an empty field
        if count + 1 == self.columns && self.separator.ends(line) && self.values.len() < Grid::MAX_NODES {
            self.values.push(0.0);
            self.defined.push(false);
            count += 1;
        }
        if self.rows == 0 {
            self.columns = count;
        } else if count != self.columns && self.ragged.is_none() {
            self.ragged = Some((number, count));
        }
        self.rows += 1;
        Ok(())
    }

    /// Points along x and y: those of the header, which must fit, else those of the lines.
    fn size(&self, source: Source<'_>, header: &Header) -> Result<[usize; 2], SurfaceError> {
        let found = self.values.len();
        if let (Some(nx), Some(ny)) = (header.nx, header.ny) {
            let fits = nx.checked_mul(ny) == Some(found);
            let what = || format!("{found} heights, the header says {nx} x {ny}");
            return if fits { Ok([nx, ny]) } else { Err(source.corrupt(what())) };
        }
        if let Some((number, count)) = self.ragged {
            let columns = self.columns;
            return Err(source.corrupt(format!("line {number}: {count} heights, {columns} in the first row")));
        }
        for (what, given, found) in [("along x", header.nx, self.columns), ("along y", header.ny, self.rows)]
        {
            if let Some(given) = given.filter(|given| *given != found) {
                return Err(source.corrupt(format!("{found} heights {what}, the header says {given}")));
            }
        }
        Ok([self.columns, self.rows])
    }
}

/// The first matrix of the file.
pub(super) fn read(source: Source<'_>) -> Result<Heights, SurfaceError> {
    let content = decode_text(source.bytes);
    let (mut header, mut rows) = (Header::default(), None::<Rows>);
    for (index, line) in content.lines().enumerate() {
        if line.trim().is_empty() {
            continue;
        }
        let comment = line.trim_start().starts_with(['#', '%']);
        match &mut rows {
            Some(rows) if !comment => rows.take(source, index + 1, line)?,
            // a header after the heights is that of a further channel
            Some(_) => break,
            None => match Rows::start(line).filter(|_| !comment) {
                Some(mut started) => {
                    started.take(source, index + 1, line)?;
                    rows = Some(started);
                }
                None => header.take(source, line)?,
            },
        }
    }
    let Some(rows) = rows else {
        let known = header.known;
        return Err(if known {
            source.corrupt("no heights after the header".to_owned())
        } else {
            source.unknown()
        });
    };
    let [nx, ny] = rows.size(source, &header)?;
    let (unit, factor) = header.heights(source)?;
    let spacing = match (header.spacing(source, 0, nx)?, header.spacing(source, 1, ny)?) {
        (Some(dx), Some(dy)) => Some([dx, dy]),
        (None, None) => None,
        _ => return Err(source.corrupt("the header gives the size along one axis only".to_owned())),
    };
    let heights = rows.values.iter().map(|value| value * factor).collect();
    source.finish(Found { nx, ny, spacing, unit, heights, defined: Some(rows.defined) })
}

/// Writes a surface as text: a header with sizes and units, then one line of heights \[m\] for each row,
/// separated by tabs, `BAD` where undefined. Programs that read Gwyddion's text export understand it.
///
/// [`super::read`] gives back the same heights, mask and spacing, bit by bit.
///
/// # Errors
/// [`SurfaceError::Io`] when the file cannot be written.
///
/// ```
/// use stribeck::surface::{Heights, read, write_text};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("surface.txt");
/// let surface = Heights::new(2, 1, Some([1e-6, 1e-6]), vec![1e-9 / 3.0, 2e-9], None)?;
/// write_text(&path, &surface)?;
/// assert_eq!(read(&path)?.heights(), surface.heights());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_text(path: impl AsRef<Path>, surface: &Heights) -> Result<(), SurfaceError> {
    let path = path.as_ref();
    write_lines(path, surface).map_err(|source| SurfaceError::Io { path: path.to_owned(), source })
}

/// Header and rows.
fn write_lines(path: &Path, surface: &Heights) -> std::io::Result<()> {
    let (nx, ny) = (surface.nx(), surface.ny());
    let mut out = BufWriter::new(File::create(path)?);
    if let (Some(dx), Some(dy)) = (surface.dx(), surface.dy()) {
        writeln!(out, "# Width: {:e} m", dx * nx as f64)?;
        writeln!(out, "# Height: {:e} m", dy * ny as f64)?;
        // sizes do not always give back the spacing to the last bit
        writeln!(out, "# Spacing X: {dx:e} m")?;
        writeln!(out, "# Spacing Y: {dy:e} m")?;
    }
    writeln!(out, "# Value units: m")?;
    // a file cut short is found out
    writeln!(out, "# x-pixels = {nx}")?;
    writeln!(out, "# y-pixels = {ny}")?;
    for (k, height) in surface.heights().iter().enumerate() {
        if surface.defined().is_none_or(|mask| mask[k]) {
            write!(out, "{height:e}")?;
        } else {
            write!(out, "BAD")?;
        }
        out.write_all(if (k + 1) % nx == 0 { b"\n" } else { b"\t" })?;
    }
    out.flush()
}
