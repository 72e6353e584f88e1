//! Digital Surf surface files (`.sur`), plain and compressed.
//!
//! A header of 512 bytes at fixed places, a comment and private bytes of given length, then the heights as
//! integers of 16 or 32 bits: plain, or in streams compressed by zlib. Numbers have the byte order of PCs or
//! of Motorola processors, as a field tells.

use std::io::Read;

use flate2::read::ZlibDecoder;

use super::number::{Kind, NumberType};
use super::source::{Found, Source, shortened};
use crate::surface::{Heights, LengthUnit, SurfaceError};

/// First bytes of a plain file.
pub(super) const MAGIC: &[u8] = b"DIGITAL SURF";
/// First bytes of a compressed file.
pub(super) const MAGIC_COMPRESSED: &[u8] = b"DSCOMPRESSED";

/// Bytes of the header.
const HEADER: usize = 512;
/// Objects that hold no heights: images, force curves, parametric profiles, spectra.
const WITHOUT_HEIGHTS: [u16; 8] = [3, 10, 12, 14, 15, 17, 18, 19];
/// Most streams that a compressed object may be divided into.
const MAX_STREAMS: u32 = 1 << 12;

/// How the heights are turned about (field `inverted`): they are negated unless zero.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Inversion {
    /// As they are.
    None,
    /// Heights negated.
    Heights,
    /// Heights negated, columns in reverse.
    HeightsAndColumns,
    /// Heights negated, rows in reverse.
    HeightsAndRows,
}

/// What the header says.
struct Header {
    /// Points along x.
    nx: usize,
    /// Points along y.
    ny: usize,
    /// Distances of the points along x and y \[m\].
    spacing: [f64; 2],
    /// Unit of the heights.
    unit: LengthUnit,
    /// Type of the stored numbers.
    number: NumberType,
    /// Height \[m\] = offset + scale * stored number.
    scale: f64,
    /// Height of a stored zero \[m\].
    offset: f64,
    /// Stored number of an undefined point.
    undefined: Option<f64>,
    /// How they are turned about.
    inversion: Inversion,
    /// Where they start.
    data: usize,
}

/// The first object of the file.
pub(super) fn read(source: Source<'_>) -> Result<Heights, SurfaceError> {
    let source = with_byte_order(source)?;
    let header = read_header(source)?;
    let Header { nx, ny, number, .. } = header;
    let expected = nx * ny * number.size();
    let stored = if source.bytes.starts_with(MAGIC_COMPRESSED) {
        source.require_noise(expected)?;
        number.decode(&decompress(source, header.data, expected)?)
    } else {
        let what = format!("the data of {nx} x {ny} points");
        number.decode(source.slice(header.data, expected, &what)?)
    };
    let defined = header.undefined.map(|marker| stored.iter().map(|&value| !same(value, marker)).collect());
    let heights = stored.iter().map(|value| header.offset + header.scale * value).collect();
    source.finish(Found {
        nx,
        ny,
        spacing: Some(header.spacing),
        unit: Some(header.unit),
        heights: turn(heights, nx, header.inversion),
        defined: defined.map(|mask| turn(mask, nx, header.inversion)),
    })
}

/// Equality of integers held as floats.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.5
}

/// Mirrors the columns or rows that the instrument had swapped.
fn turn<T: Copy>(field: Vec<T>, nx: usize, inversion: Inversion) -> Vec<T> {
    match inversion {
        Inversion::None | Inversion::Heights => field,
        Inversion::HeightsAndColumns => field.chunks(nx).flat_map(|row| row.iter().rev()).copied().collect(),
        Inversion::HeightsAndRows => field.chunks(nx).rev().flatten().copied().collect(),
    }
}

/// The source with the byte order that its field `format` tells: 0 of PCs, 1 of Motorola processors.
fn with_byte_order(source: Source<'_>) -> Result<Source<'_>, SurfaceError> {
    match source.slice(12, 2, "the format")? {
        [0, 0] => Ok(source),
        [0, 1] => Ok(Source { big_endian: true, ..source }),
        other => Err(source.unsupported(format!("byte order {other:?}, neither of PCs nor of Motorola"))),
    }
}

/// The header, refused where it makes no sense or belongs to an object without heights.
fn read_header(source: Source<'_>) -> Result<Header, SurfaceError> {
    source.slice(0, HEADER, "the header")?;
    let kind = source.u16(18, "object type")?;
    if WITHOUT_HEIGHTS.contains(&kind) {
        return Err(source.unsupported(format!("an object of type {kind} instead of a surface")));
    }
    let bits = source.u16(98, "bits per point")?;
    let number = matches!(bits, 16 | 32)
        .then(|| NumberType::new(Kind::Signed, usize::from(bits / 8), source.big_endian));
    let number = number.flatten().ok_or_else(|| source.corrupt(format!("{bits} bits per point")))?;
    let (nx, ny) = (count(source, 108, "points per line")?, count(source, 112, "lines")?);
    let spacing = [
        source.f32(120, "x spacing")? * axis_unit(source, 180, "x")?.metres(),
        source.f32(124, "y spacing")? * axis_unit(source, 196, "y")?.metres(),
    ];
    source.require_size(nx, ny, Some(spacing))?;
    let points = source.u32(116, "number of points")?;
    if points as usize != nx * ny {
        return Err(source.corrupt(format!("the header counts {points} points in {nx} x {ny}")));
    }
    let unit = axis_unit(source, 212, "height")?;
    let inversion = match source.u16(290, "inversion")? {
        1 => Inversion::Heights,
        2 => Inversion::HeightsAndColumns,
        3 => Inversion::HeightsAndRows,
        _ => Inversion::None,
    };
    let sign = if inversion == Inversion::None { 1.0 } else { -1.0 };
    let lowest = f64::from(source.i32(100, "smallest value")?);
    let comment = usize::from(source.u16(334, "comment size")?);
    let private = usize::from(source.u16(336, "private size")?);
    Ok(Header {
        nx,
        ny,
        spacing,
        unit,
        number,
        scale: sign * source.f32(128, "height scale")? * unit.metres(),
        offset: sign * source.f32(474, "height offset")? * unit.metres(),
        undefined: (source.u16(86, "special points")? == 1).then_some(lowest - 2.0),
        inversion,
        data: HEADER + comment + private,
    })
}

/// A count at a place of the file, named `what` in errors.
fn count(source: Source<'_>, at: usize, what: &str) -> Result<usize, SurfaceError> {
    let value = source.i32(at, what)?;
    usize::try_from(value).map_err(|_| source.corrupt(format!("{value} {what}")))
}

/// The unit of an axis step, or of the axis where that is blank (48 bytes on).
fn axis_unit(source: Source<'_>, at: usize, what: &str) -> Result<LengthUnit, SurfaceError> {
    let step = source.text(at, 16, "a unit")?;
    let name = if step.is_empty() { source.text(at + 48, 16, "a unit")? } else { step };
    source.unit(&name, what)
}

/// The `expected` bytes of the zlib streams that a table at `at` describes.
fn decompress(source: Source<'_>, at: usize, expected: usize) -> Result<Vec<u8>, SurfaceError> {
    let streams = source.u32(at, "the number of compressed streams")?;
    if !(1..=MAX_STREAMS).contains(&streams) {
        return Err(source.corrupt(format!("{streams} compressed streams")));
    }
    let table = at + 4;
    let mut start = table + 8 * streams as usize;
    let mut bytes = Vec::new();
    for stream in 0..streams as usize {
        let packed = source.u32(table + 8 * stream + 4, "the table of streams")? as usize;
        let part = source.slice(start, packed, &format!("compressed stream {stream}"))?;
        let missing = (expected - bytes.len()) as u64;
        ZlibDecoder::new(part).take(missing + 1).read_to_end(&mut bytes).map_err(|error| {
            source.corrupt(format!("compressed stream {stream}: {}", shortened(&error.to_string())))
        })?;
        if bytes.len() > expected {
            return Err(source.corrupt(format!("the compressed data hold more than {expected} bytes")));
        }
        start += packed;
    }
    if bytes.len() == expected {
        Ok(bytes)
    } else {
        let found = bytes.len();
        Err(source.corrupt(format!("the compressed data hold {found} bytes instead of {expected}")))
    }
}
