//! `NumPy` arrays. The header is parsed here, so that a damaged one costs neither a panic nor memory.

use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Write};
use std::path::Path;

use super::error::SurfaceError;
use super::measured::Heights;
use super::number::{Kind, NumberType};
use crate::error::InputError;
use crate::grid::Grid;

/// Headers longer than this are not those of a plain array.
const MAX_HEADER: u64 = 1 << 16;

/// What the header says.
struct Header {
    number: NumberType,
    fortran_order: bool,
    ny: usize,
    nx: usize,
}

pub(super) fn read(path: &Path, file: File) -> Result<Heights, SurfaceError> {
    let mut reader = BufReader::new(file);
    let header = read_header(path, &mut reader)?;
    let Header { number, fortran_order, ny, nx } = header;
    let expected = (nx * ny * number.size()) as u64;
    let bytes = read_up_to(path, &mut reader, expected + 1)?;
    if bytes.len() as u64 != expected {
        let found = if bytes.len() as u64 > expected { "more".to_owned() } else { bytes.len().to_string() };
        let what = format!("shape ({ny}, {nx}) needs {expected} bytes of data, found {found}");
        return Err(SurfaceError::Corrupt { path: path.to_owned(), what });
    }
    let stored = number.decode(&bytes);
    let heights = if fortran_order {
        (0..ny).flat_map(|j| stored.iter().skip(j).step_by(ny)).copied().collect()
    } else {
        stored
    };
    match heights.iter().position(|h| !h.is_finite()) {
        None => Heights::new(nx, ny, None, heights, None),
        Some(k) => Err(SurfaceError::NotFinite {
            path: path.to_owned(),
            column: k % nx,
            row: k / nx,
            value: heights[k],
        }),
    }
}

fn read_up_to(path: &Path, reader: &mut impl Read, limit: u64) -> Result<Vec<u8>, SurfaceError> {
    let mut bytes = Vec::new();
    reader
        .take(limit)
        .read_to_end(&mut bytes)
        .map_err(|source| SurfaceError::Io { path: path.to_owned(), source })?;
    Ok(bytes)
}

fn read_header(path: &Path, reader: &mut impl Read) -> Result<Header, SurfaceError> {
    let corrupt = |what: String| SurfaceError::Corrupt { path: path.to_owned(), what };
    let start = read_up_to(path, reader, 8)?;
    let &[_, _, _, _, _, _, version, _] = start.as_slice() else {
        return Err(corrupt("ends within the magic number".to_owned()));
    };
    let width = match version {
        1 => 2,
        2 | 3 => 4,
        _ => return Err(corrupt(format!("version {version} of the npy format is unknown"))),
    };
    let length_bytes = read_up_to(path, reader, width)?;
    let length = length_bytes.iter().rev().fold(0_u64, |sum, byte| (sum << 8) | u64::from(*byte));
    if length_bytes.len() as u64 != width || length > MAX_HEADER {
        return Err(corrupt(format!("header of {length} bytes")));
    }
    let bytes = read_up_to(path, reader, length)?;
    if bytes.len() as u64 != length {
        return Err(corrupt(format!("ends within its header of {length} bytes")));
    }
    parse_header(path, &String::from_utf8_lossy(&bytes))
}

fn parse_header(path: &Path, text: &str) -> Result<Header, SurfaceError> {
    let corrupt = |what: String| SurfaceError::Corrupt { path: path.to_owned(), what };
    let unsupported = |what: String| SurfaceError::Unsupported { path: path.to_owned(), what };
    let missing = |key: &str| corrupt(format!("header without a usable '{key}'"));
    let descr = value_of(text, "descr").ok_or_else(|| missing("descr"))?;
    let number = parse_number_type(descr).ok_or_else(|| {
        unsupported(format!("array of type {}", descr.chars().take(16).collect::<String>()))
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
    let &[ny, nx] = sizes.as_slice() else {
        return Err(unsupported(format!("array of {} dimensions instead of 2", sizes.len())));
    };
    // the grid knows which counts are sound
    Grid::centred(nx, ny, 1.0, 1.0).map_err(|error| corrupt(format!("shape ({ny}, {nx}): {error}")))?;
    Ok(Header { number, fortran_order, ny, nx })
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

/// Writes a field \[m\] of `nx` x `ny` values, x fastest, as an npy array of shape `(ny, nx)`, 64 bit floats in C order.
///
/// # Errors
/// [`SurfaceError::Input`] when `field` has not `nx * ny` values, [`SurfaceError::Io`] when the file cannot be written.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("heights.npy");
/// stribeck::surface::write_npy(&path, 3, 2, &[0.0; 6])?;
/// assert_eq!(std::fs::metadata(&path)?.len(), 128 + 6 * 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_npy(path: impl AsRef<Path>, nx: usize, ny: usize, field: &[f64]) -> Result<(), SurfaceError> {
    InputError::require_len("field", field, nx.saturating_mul(ny))?;
    let path = path.as_ref();
    write_array(path, nx, ny, field).map_err(|source| SurfaceError::Io { path: path.to_owned(), source })
}

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
