//! Digital Surf surface files (`.sur`), plain and compressed.
//!
//! A header of 512 bytes at fixed places, a comment and private bytes of given length, then the heights as
//! integers of 16 or 32 bits: plain, or in streams compressed by zlib. Numbers have the byte order of PCs or
//! of Motorola processors, as a field tells.

use std::io::Read;

use flate2::read::ZlibDecoder;

use crate::error::Error;
use crate::number::{Kind, NumberType};
use crate::source::{Source, shortened};
use crate::surface::Surface;
use crate::unit::LengthUnit;

/// First bytes of a plain file.
pub(crate) const MAGIC: &[u8] = b"DIGITAL SURF";
/// First bytes of a compressed file.
pub(crate) const MAGIC_COMPRESSED: &[u8] = b"DSCOMPRESSED";

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

/// Content of the header.
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

/// The only object of the file, or the chosen one of several.
pub(crate) fn read(source: Source<'_>) -> Result<Surface, Error> {
    let source = with_byte_order(source)?;
    source.slice(0, HEADER, "the header")?;
    // older files count none
    let objects = source.u16(14, "number of objects")?.max(1);
    if objects == 1 {
        source.choose(vec![source.text(20, 30, "the name")?])?;
        return read_object(source, 0);
    }
    let mut starts = vec![0];
    for _ in 1..objects {
        starts.push(end_of_object(source, starts[starts.len() - 1])?);
    }
    let named = starts.iter().map(|at| source.text(at + 20, 30, "the name of an object"));
    let chosen = source.choose(named.collect::<Result<_, _>>()?)?;
    read_object(source, starts[chosen])
}

/// The object whose header is at byte `at`.
fn read_object(source: Source<'_>, at: usize) -> Result<Surface, Error> {
    let header = read_header(source, at)?;
    let Header { nx, ny, number, .. } = header;
    let expected = nx * ny * number.size();
    let mut stored = if is_compressed(source, at) {
        source.require_noise(expected)?;
        number.decode(&decompress(source, header.data, expected)?)
    } else {
        let what = format!("the data of {nx} x {ny} points");
        number.decode(source.slice(header.data, expected, &what)?)
    };
    if let Some(marker) = header.undefined {
        stored.iter_mut().filter(|value| same(**value, marker)).for_each(|value| *value = f64::NAN);
    }
    let heights = source.scaled(nx, stored, header.offset, header.scale)?;
    let heights = turn(heights, nx, header.inversion);
    let surface = Surface { unit: Some(header.unit), ..Surface::new(nx, ny, heights) };
    source.finish(surface.with_spacing(Some(header.spacing)))
}

/// Whether the heights of the object at byte `at` are compressed.
fn is_compressed(source: Source<'_>, at: usize) -> bool {
    source.bytes.get(at..).is_some_and(|rest| rest.starts_with(MAGIC_COMPRESSED))
}

/// Byte after the heights of the object at byte `at`.
fn end_of_object(source: Source<'_>, at: usize) -> Result<usize, Error> {
    let header = read_header(source, at)?;
    let size = if is_compressed(source, at) {
        let streams = stream_count(source, header.data)?;
        let table = header.data + 4;
        let packed = (0..streams).map(|k| source.u32(table + 8 * k + 4, "the table of streams"));
        let packed = packed.collect::<Result<Vec<u32>, _>>()?;
        4 + 8 * streams + packed.into_iter().map(|size| size as usize).sum::<usize>()
    } else {
        header.nx * header.ny * header.number.size()
    };
    source.slice(header.data, size, "the data of an object")?;
    Ok(header.data + size)
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
fn with_byte_order(source: Source<'_>) -> Result<Source<'_>, Error> {
    match source.slice(12, 2, "the format")? {
        [0, 0] => Ok(source),
        [0, 1] => Ok(Source { big_endian: true, ..source }),
        other => Err(source.unsupported(format!("byte order {other:?}, neither of PCs nor of Motorola"))),
    }
}

/// The header at byte `at`, refused where it makes no sense or belongs to an object without heights.
fn read_header(source: Source<'_>, at: usize) -> Result<Header, Error> {
    source.slice(at, HEADER, "the header")?;
    let kind = source.u16(at + 18, "object type")?;
    if WITHOUT_HEIGHTS.contains(&kind) {
        return Err(source.unsupported(format!("an object of type {kind} instead of a surface")));
    }
    let bits = source.u16(at + 98, "bits per point")?;
    let number = matches!(bits, 16 | 32)
        .then(|| NumberType::new(Kind::Signed, usize::from(bits / 8), source.big_endian));
    let number = number.flatten().ok_or_else(|| source.corrupt(format!("{bits} bits per point")))?;
    let (nx, ny) = (count(source, at + 108, "points per line")?, count(source, at + 112, "lines")?);
    let spacing = read_spacing(source, at, ny)?;
    source.require_size(nx, ny, Some(spacing))?;
    let points = source.u32(at + 116, "number of points")?;
    if points as usize != nx * ny {
        return Err(source.corrupt(format!("the header counts {points} points in {nx} x {ny}")));
    }
    let unit = axis_unit(source, at + 212, "height")?;
    let inversion = match source.u16(at + 290, "inversion")? {
        1 => Inversion::Heights,
        2 => Inversion::HeightsAndColumns,
        3 => Inversion::HeightsAndRows,
        _ => Inversion::None,
    };
    let sign = if inversion == Inversion::None { 1.0 } else { -1.0 };
    let lowest = f64::from(source.i32(at + 100, "smallest value")?);
    let comment = usize::from(source.u16(at + 334, "comment size")?);
    let private = usize::from(source.u16(at + 336, "private size")?);
    Ok(Header {
        nx,
        ny,
        spacing,
        unit,
        number,
        scale: sign * source.f32(at + 128, "height scale")? * unit.metres(),
        offset: sign * source.f32(at + 474, "height offset")? * unit.metres(),
        undefined: (source.u16(at + 86, "special points")? == 1).then_some(lowest - 2.0),
        inversion,
        data: at + HEADER + comment + private,
    })
}

/// Distances of the points \[m\] of the object at byte `at` with `ny` rows; a profile may leave the one across
/// blank, where that along it stands in.
fn read_spacing(source: Source<'_>, at: usize, ny: usize) -> Result<[f64; 2], Error> {
    let dx = source.f32(at + 120, "x spacing")? * axis_unit(source, at + 180, "x")?.metres();
    let dy = source.f32(at + 124, "y spacing")?;
    let is_blank = axis_unit_name(source, at + 196)?.is_empty() || dy == 0.0;
    if ny == 1 && is_blank {
        return Ok([dx, dx]);
    }
    Ok([dx, dy * axis_unit(source, at + 196, "y")?.metres()])
}

/// A count at a place of the file, named `what` in errors.
fn count(source: Source<'_>, at: usize, what: &str) -> Result<usize, Error> {
    let value = source.i32(at, what)?;
    usize::try_from(value).map_err(|_| source.corrupt(format!("{value} {what}")))
}

/// Name of the unit of an axis step, or of the axis where that is blank (48 bytes on).
fn axis_unit_name(source: Source<'_>, at: usize) -> Result<String, Error> {
    let step = source.text(at, 16, "a unit")?;
    if step.is_empty() { source.text(at + 48, 16, "a unit") } else { Ok(step) }
}

/// The unit of an axis, named `what` in errors.
fn axis_unit(source: Source<'_>, at: usize, what: &str) -> Result<LengthUnit, Error> {
    source.unit(&axis_unit_name(source, at)?, what)
}

/// Number of the zlib streams whose table is at byte `at`.
fn stream_count(source: Source<'_>, at: usize) -> Result<usize, Error> {
    let streams = source.u32(at, "the number of compressed streams")?;
    if (1..=MAX_STREAMS).contains(&streams) {
        Ok(streams as usize)
    } else {
        Err(source.corrupt(format!("{streams} compressed streams")))
    }
}

/// The `expected` bytes of the zlib streams that a table at `at` describes.
fn decompress(source: Source<'_>, at: usize, expected: usize) -> Result<Vec<u8>, Error> {
    let streams = stream_count(source, at)?;
    let table = at + 4;
    let mut start = table + 8 * streams;
    let mut bytes = Vec::new();
    for stream in 0..streams {
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
