//! Surface data files of ISO 25178-71 (`.sdf`), ASCII and binary, versions 1 and 2.
//!
//! A header of counts, spacings, a scale of the heights and a code of the number type, then the heights row
//! by row: in an ASCII file as keys and text, in a binary one at fixed places. The version is told by the
//! first eight bytes.

use super::number::{Kind, NumberType};
use super::source::{Found, Source, decode_text, shortened};
use super::text::parse_height;
use crate::surface::{Heights, LengthUnit, SurfaceError};

/// First bytes of each version.
const MAGICS: [(&[u8], Version); 6] = [
    (b"aBCR-1.0", Version::Ascii),
    (b"aISO-1.0", Version::Ascii),
    (b"aISO-2.0", Version::Ascii),
    (b"bBCR-1.0", Version::Binary { wide: false }),
    (b"bISO-1.0", Version::Binary { wide: false }),
    (b"bISO-2.0", Version::Binary { wide: true }),
];

/// Which version.
#[derive(Clone, Copy)]
enum Version {
    /// Keys and numbers as text.
    Ascii,
    /// Counts of 16 bits, or of 32 when wide.
    Binary { wide: bool },
}

/// Whether the file begins as one of the versions.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    MAGICS.iter().any(|(magic, _)| bytes.starts_with(magic))
}

/// What the header says.
struct Header {
    /// Points along x.
    nx: usize,
    /// Points along y.
    ny: usize,
    /// Distances of the points along x and y \[m\].
    spacing: [f64; 2],
    /// Height \[m\] per stored number.
    scale: f64,
    /// Type of the stored numbers of binary files.
    number: NumberType,
    /// Stored number of an undefined point.
    undefined: Option<f64>,
}

/// Heights, those that equal the marker undefined.
pub(super) fn read(source: Source<'_>) -> Result<Heights, SurfaceError> {
    let version =
        MAGICS.iter().find(|(magic, _)| source.bytes.starts_with(magic)).map(|(_, version)| *version);
    let (header, stored, mut defined) = match version {
        Some(Version::Ascii) => read_ascii(source)?,
        Some(Version::Binary { wide }) => read_binary(source, wide)?,
        None => return Err(source.unknown()),
    };
    if let Some(marker) = header.undefined {
        defined
            .iter_mut()
            .zip(&stored)
            .for_each(|(flag, value)| *flag &= value.to_bits() != marker.to_bits());
    }
    source.finish(Found {
        nx: header.nx,
        ny: header.ny,
        spacing: Some(header.spacing),
        // the scale turns stored numbers into metres
        unit: Some(LengthUnit::of_length(header.scale).unwrap_or(LengthUnit::Metre)),
        heights: stored.iter().map(|value| header.scale * value).collect(),
        defined: Some(defined),
    })
}

/// Type of the stored numbers and the one that marks an undefined point, by the code of the standard.
fn number_type(code: u64) -> Option<(NumberType, Option<f64>)> {
    let (kind, size, marker) = match code {
        0 => (Kind::Unsigned, 1, None),
        1 => (Kind::Unsigned, 2, Some(f64::from(u16::MAX))),
        2 => (Kind::Unsigned, 4, Some(f64::from(u32::MAX))),
        3 => (Kind::Float, 4, Some(f64::from(f32::MIN))),
        4 => (Kind::Signed, 1, Some(f64::from(i8::MIN))),
        5 => (Kind::Signed, 2, Some(f64::from(i16::MIN))),
        6 => (Kind::Signed, 4, Some(f64::from(i32::MIN))),
        7 => (Kind::Float, 8, Some(f64::MIN)),
        _ => return None,
    };
    NumberType::new(kind, size, false).map(|number| (number, marker))
}

/// The header of `sizes` (points, profiles), `scales` (of x, y, z) and `codes` (compression, data type),
/// refused where one makes no sense or is not read.
fn check(
    source: Source<'_>,
    sizes: [usize; 2],
    scales: [f64; 3],
    codes: [u64; 2],
) -> Result<Header, SurfaceError> {
    let ([nx, ny], [dx, dy, scale], [compression, data_type]) = (sizes, scales, codes);
    source.require_size(nx, ny, Some([dx, dy]))?;
    if !scale.is_finite() {
        return Err(source.corrupt(format!("Zscale = {scale}")));
    }
    if compression != 0 {
        return Err(source.unsupported(format!("Compression = {compression}")));
    }
    let (number, undefined) =
        number_type(data_type).ok_or_else(|| source.unsupported(format!("DataType = {data_type}")))?;
    Ok(Header { nx, ny, spacing: [dx, dy], scale, number, undefined })
}

/// Header, stored numbers and which are defined, of a binary file.
fn read_binary(source: Source<'_>, wide: bool) -> Result<(Header, Vec<f64>, Vec<bool>), SurfaceError> {
    // magic, maker and two dates come first
    let at = 8 + 10 + 12 + 12;
    let (sizes, at) = if wide {
        let sizes = [source.u32(at, "NumPoints")? as usize, source.u32(at + 4, "NumProfiles")? as usize];
        (sizes, at + 8)
    } else {
        let sizes = [source.u16(at, "NumPoints")?, source.u16(at + 2, "NumProfiles")?];
        (sizes.map(usize::from), at + 4)
    };
    let scales = [source.f64(at, "Xscale")?, source.f64(at + 8, "Yscale")?, source.f64(at + 16, "Zscale")?];
    let codes = source.slice(at + 32, 3, "the data type")?;
    let header = check(source, sizes, scales, [u64::from(codes[0]), u64::from(codes[1])])?;
    let [nx, ny] = sizes;
    let what = format!("the data of {nx} x {ny} points");
    let stored = header.number.decode(source.slice(at + 35, nx * ny * header.number.size(), &what)?);
    let defined = vec![true; stored.len()];
    Ok((header, stored, defined))
}

/// The value of a key of the ASCII header, if it is there.
fn value_of<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    header
        .lines()
        .filter_map(|line| line.split_once('='))
        .find(|(name, _)| name.trim().eq_ignore_ascii_case(key))
        // a comment may follow
        .map(|(_, value)| value.split(';').next().unwrap_or(value).trim())
}

/// The value of a key as a number.
fn parse<T: std::str::FromStr>(source: Source<'_>, header: &str, key: &str) -> Result<T, SurfaceError> {
    let text = value_of(header, key).ok_or_else(|| source.corrupt(format!("the header lacks {key}")))?;
    text.parse().map_err(|_| source.corrupt(format!("{key} = {} is not a number", shortened(text))))
}

/// Header, stored numbers and which are defined, of an ASCII file.
fn read_ascii(source: Source<'_>) -> Result<(Header, Vec<f64>, Vec<bool>), SurfaceError> {
    let content = decode_text(&source.bytes[8..]);
    let (head, rest) =
        content.split_once('*').ok_or_else(|| source.corrupt("the header is not closed by *".to_owned()))?;
    let sizes = [parse(source, head, "NumPoints")?, parse(source, head, "NumProfiles")?];
    let scales =
        [parse(source, head, "Xscale")?, parse(source, head, "Yscale")?, parse(source, head, "Zscale")?];
    // files that are not compressed may leave this out
    let compression = value_of(head, "Compression").map_or(Ok(0), |_| parse(source, head, "Compression"))?;
    let codes = [compression, parse(source, head, "DataType")?];
    let header = check(source, sizes, scales, codes)?;
    let data = rest.split('*').next().unwrap_or("");
    let [nx, ny] = sizes;
    let (mut stored, mut defined) = (Vec::new(), Vec::new());
    let is_separator = |letter: char| letter.is_whitespace() || matches!(letter, ',' | ';');
    for (k, token) in data.split(is_separator).filter(|token| !token.is_empty()).enumerate() {
        if k == nx * ny {
            return Err(source.corrupt(format!("more than the {nx} x {ny} heights of the header")));
        }
        let height = parse_height(token).ok_or_else(|| {
            source.corrupt(format!("height ({}, {}) = {} is not a number", k % nx, k / nx, shortened(token)))
        })?;
        stored.push(height.unwrap_or(0.0));
        defined.push(height.is_some());
    }
    if stored.len() < nx * ny {
        let found = stored.len();
        return Err(source.corrupt(format!("{found} heights, the header says {nx} x {ny}")));
    }
    Ok((header, stored, defined))
}
