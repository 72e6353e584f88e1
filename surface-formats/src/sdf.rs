//! Surface data files of ISO 25178-71 (`.sdf`), ASCII and binary, versions 1 and 2.
//!
//! A header of counts, spacings, a scale of the heights and a code of the number type, then the heights row
//! by row: in an ASCII file as keys and text, in a binary one at fixed places. The version is told by the
//! first eight bytes.

use crate::error::Error;
use crate::number::{Kind, NumberType};
use crate::source::{Source, decode_text, shortened, unknown_keys};
use crate::surface::Surface;
use crate::text::number::parse_height;
use crate::unit::LengthUnit;

/// First bytes of each version.
const MAGICS: [(&[u8], Version); 8] = [
    (b"aBCR-1.0", Version::Ascii),
    (b"aNPL-V1.0", Version::Ascii),
    (b"aNPL-1.0", Version::Ascii),
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
pub(crate) fn recognises(bytes: &[u8]) -> bool {
    MAGICS.iter().any(|(magic, _)| bytes.starts_with(magic))
}

/// Content of the header.
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
pub(crate) fn read(source: Source<'_>) -> Result<Surface, Error> {
    let found = MAGICS.iter().find(|(magic, _)| source.bytes.starts_with(magic));
    let mut warnings = Vec::new();
    let (header, mut stored) = match found {
        Some((magic, Version::Ascii)) => read_ascii(source, magic.len(), &mut warnings)?,
        Some((_, Version::Binary { wide })) => read_binary(source, *wide)?,
        None => return Err(source.unknown()),
    };
    if let Some(marker) = header.undefined {
        stored.iter_mut().filter(|value| value.to_bits() == marker.to_bits()).for_each(|v| *v = f64::NAN);
    }
    let heights = source.scaled(header.nx, stored, -0.0, header.scale)?;
    // the scale turns stored numbers into metres
    let unit = Some(LengthUnit::of_length(header.scale).unwrap_or(LengthUnit::Metre));
    let surface = Surface { unit, warnings, ..Surface::new(header.nx, header.ny, heights) };
    source.finish(surface.with_spacing(Some(header.spacing)))
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
fn check(source: Source<'_>, sizes: [usize; 2], scales: [f64; 3], codes: [u64; 2]) -> Result<Header, Error> {
    let ([nx, ny], [dx, dy, scale], [compression, data_type]) = (sizes, scales, codes);
    // a profile has no distance between rows
    let dy = if ny == 1 && dy == 0.0 { dx } else { dy };
    source.require_size(nx, ny, Some([dx, dy]))?;
    if !(scale.is_finite() && scale != 0.0) {
        return Err(source.corrupt(format!("Zscale = {scale}: it must be finite and not zero")));
    }
    if compression != 0 {
        return Err(source.unsupported(format!("Compression = {compression}")));
    }
    let (number, undefined) =
        number_type(data_type).ok_or_else(|| source.unsupported(format!("DataType = {data_type}")))?;
    Ok(Header { nx, ny, spacing: [dx, dy], scale, number, undefined })
}

/// Header and stored numbers of a binary file.
fn read_binary(source: Source<'_>, wide: bool) -> Result<(Header, Vec<f64>), Error> {
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
    Ok((header, stored))
}

/// Keys of the ASCII header.
const KEYS: [&str; 12] = [
    "ManufacID",
    "CreateDate",
    "ModDate",
    "NumPoints",
    "NumProfiles",
    "Xscale",
    "Yscale",
    "Zscale",
    "Zresolution",
    "Compression",
    "DataType",
    "CheckType",
];

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
fn parse<T: std::str::FromStr>(source: Source<'_>, header: &str, key: &str) -> Result<T, Error> {
    let text = value_of(header, key).ok_or_else(|| source.corrupt(format!("the header lacks {key}")))?;
    text.parse().map_err(|_| source.corrupt(format!("{key} = {} is not a number", shortened(text))))
}

/// Header and stored numbers of an ASCII file whose magic has `start` bytes.
fn read_ascii(
    source: Source<'_>,
    start: usize,
    warnings: &mut Vec<String>,
) -> Result<(Header, Vec<f64>), Error> {
    let content = decode_text(&source.bytes[start..]);
    let (head, rest) =
        content.split_once('*').ok_or_else(|| source.corrupt("the header is not closed by *".to_owned()))?;
    let keys = head.lines().filter_map(|line| line.split_once('=')).map(|(key, _)| key.trim());
    let unknown = keys.filter(|key| !KEYS.iter().any(|known| known.eq_ignore_ascii_case(key)));
    warnings.extend(unknown_keys(&unknown.map(shortened).collect::<Vec<_>>()));
    let sizes = [parse(source, head, "NumPoints")?, parse(source, head, "NumProfiles")?];
    let scales =
        [parse(source, head, "Xscale")?, parse(source, head, "Yscale")?, parse(source, head, "Zscale")?];
    // files that are not compressed may leave this out
    let compression = value_of(head, "Compression").map_or(Ok(0), |_| parse(source, head, "Compression"))?;
    let codes = [compression, parse(source, head, "DataType")?];
    let header = check(source, sizes, scales, codes)?;
    let data = rest.split('*').next().unwrap_or("");
    let [nx, ny] = sizes;
    let mut stored = Vec::new();
    let is_separator = |letter: char| letter.is_whitespace() || matches!(letter, ',' | ';');
    for (k, token) in data.split(is_separator).filter(|token| !token.is_empty()).enumerate() {
        if k == nx * ny {
            return Err(source.corrupt(format!("more than the {nx} x {ny} heights of the header")));
        }
        stored.push(parse_height(token).ok_or_else(|| {
            source.corrupt(format!("height ({}, {}) = {} is not a number", k % nx, k / nx, shortened(token)))
        })?);
    }
    if stored.len() < nx * ny {
        let found = stored.len();
        return Err(source.corrupt(format!("{found} heights, the header says {nx} x {ny}")));
    }
    Ok((header, stored))
}
