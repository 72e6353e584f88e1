//! `NumPy` arrays. The header is parsed here, so that a damaged one costs neither a panic nor memory.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use crate::error::Error;
use crate::number::{Kind, NumberType};
use crate::source::{Source, without_unit};
use crate::surface::Surface;

/// First bytes of the file.
pub(crate) const MAGIC: &[u8] = b"\x93NUMPY";

/// Headers longer than this are not those of a plain array.
const MAX_HEADER: u32 = 1 << 16;

/// Content of the header.
struct Header {
    /// Type of the numbers.
    number: NumberType,
    /// Whether the first index runs fastest.
    fortran_order: bool,
    /// Rows.
    ny: usize,
    /// Columns.
    nx: usize,
    /// Where the numbers start.
    data: usize,
}

/// Heights of an array of one or two dimensions, without a spacing.
pub(crate) fn read(source: Source<'_>) -> Result<Surface, Error> {
    let Header { number, fortran_order, ny, nx, data } = read_header(source)?;
    let expected = nx * ny * number.size();
    let bytes = source.bytes.get(data..).unwrap_or_default();
    if bytes.len() != expected {
        let found = if bytes.len() > expected { "more".to_owned() } else { bytes.len().to_string() };
        return Err(
            source.corrupt(format!("shape ({ny}, {nx}) needs {expected} bytes of data, found {found}"))
        );
    }
    let stored = number.decode(bytes);
    let heights = if fortran_order {
        (0..ny).flat_map(|j| stored.iter().skip(j).step_by(ny)).copied().collect()
    } else {
        stored
    };
    let unit = source.options.unit;
    let heights = source.scaled(nx, heights, -0.0, unit.map_or(1.0, |unit| unit.metres()))?;
    let mut surface = Surface { unit, ..Surface::new(nx, ny, heights) };
    if unit.is_none() {
        surface.warnings.push(without_unit("npy files name none, the option unit does"));
    }
    source.finish(surface)
}

/// The header, of the versions 1 to 3 of the format.
fn read_header(source: Source<'_>) -> Result<Header, Error> {
    let version = source.slice(6, 2, "the end of the magic number")?[0];
    let (start, length) = match version {
        1 => (10, u32::from(source.u16(8, "the length of the header")?)),
        2 | 3 => (12, source.u32(8, "the length of the header")?),
        _ => return Err(source.corrupt(format!("version {version} of the npy format is unknown"))),
    };
    if length > MAX_HEADER {
        return Err(source.corrupt(format!("header of {length} bytes")));
    }
    let bytes = source.slice(start, length as usize, "the header")?;
    let (number, fortran_order, ny, nx) = parse_header(source, &String::from_utf8_lossy(bytes))?;
    Ok(Header { number, fortran_order, ny, nx, data: start + length as usize })
}

/// Number type, order and shape from the dictionary of the header.
fn parse_header(source: Source<'_>, text: &str) -> Result<(NumberType, bool, usize, usize), Error> {
    let missing = |key: &str| source.corrupt(format!("header without a usable '{key}'"));
    let descr = value_of(text, "descr").ok_or_else(|| missing("descr"))?;
    let number = parse_number_type(descr).ok_or_else(|| {
        source.unsupported(format!(
            "array of type {}, heights are integers or floats",
            descr.split(',').next().unwrap_or(descr).chars().take(16).collect::<String>()
        ))
    })?;
    let fortran_order = match value_of(text, "fortran_order") {
        Some(value) if value.starts_with("True") => true,
        Some(value) if value.starts_with("False") => false,
        _ => return Err(missing("fortran_order")),
    };
    let shape = value_of(text, "shape")
        .and_then(|value| value.strip_prefix('(')?.split_once(')'))
        .map(|(inside, _)| inside.trim().trim_end_matches(','))
        .ok_or_else(|| missing("shape"))?;
    let sizes: Result<Vec<usize>, _> =
        shape.split(',').filter(|part| !part.trim().is_empty()).map(|part| part.trim().parse()).collect();
    let sizes = sizes.map_err(|_| missing("shape"))?;
    let (ny, nx) = match *sizes.as_slice() {
        [ny, nx] => (ny, nx),
        [nx] => (1, nx),
        _ => {
            let shape = shape.chars().take(32).collect::<String>();
            return Err(source.unsupported(format!(
                "array of shape ({shape}) instead of (ny, nx), or (nx,) for a profile; numpy.squeeze removes axes of length 1"
            )));
        }
    };
    source.require_size(nx, ny, None)?;
    Ok((number, fortran_order, ny, nx))
}

/// The text after `'key':` in the header's dictionary.
fn value_of<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let rest = ['\'', '"']
        .into_iter()
        .find_map(|q| text.split_once(&format!("{q}{key}{q}")).map(|(_, rest)| rest))?;
    Some(rest.trim_start().strip_prefix(':')?.trim_start())
}

/// For example `'<f8'`.
fn parse_number_type(descr: &str) -> Option<NumberType> {
    let quote = descr.chars().next().filter(|c| matches!(c, '\'' | '"'))?;
    let (name, _) = descr[1..].split_once(quote)?;
    let mut letters = name.chars();
    let big_endian = match letters.next()? {
        '<' | '|' => false,
        '>' => true,
        '=' => cfg!(target_endian = "big"),
        _ => return None,
    };
    let kind = match letters.next()? {
        'f' => Kind::Float,
        'i' => Kind::Signed,
        'u' => Kind::Unsigned,
        _ => return None,
    };
    NumberType::new(kind, letters.as_str().parse().ok()?, big_endian)
}

/// Writes heights \[m\], undefined points as NaN, as an npy array of shape `(ny, nx)`, 64 bit floats in C
/// order. The spacing is not written.
///
/// # Errors
/// [`Error::Io`] when the file cannot be written.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("heights.npy");
/// use surface_formats::{Surface, write_npy};
/// write_npy(&path, &Surface::new(3, 2, vec![0.0; 6]))?;
/// assert_eq!(std::fs::metadata(&path)?.len(), 128 + 6 * 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_npy(path: impl AsRef<Path>, surface: &Surface) -> Result<(), Error> {
    let path = path.as_ref();
    write_array(path, surface.nx, surface.ny, &surface.heights)
        .map_err(|source| Error::Io { path: path.to_owned(), source })
}

/// Header and numbers of an array of `ny` rows.
fn write_array(path: &Path, nx: usize, ny: usize, field: &[f64]) -> std::io::Result<()> {
    let mut out = BufWriter::new(File::create(path)?);
    let dictionary = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({ny}, {nx}), }}");
    // magic, version and length take 10 bytes; data start at a multiple of 64
    out.write_all(b"\x93NUMPY\x01\x00\x76\x00")?;
    writeln!(out, "{dictionary:<117}")?;
    for value in field {
        out.write_all(&value.to_le_bytes())?;
    }
    out.flush()
}
