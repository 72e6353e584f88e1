//! The x3p container (ISO 25178-72): a zip archive with a description in XML and the heights in binary form.
//!
//! `main.xml` describes one feature on equidistant axes: counts, increments, type and scale of the heights.
//! The heights are a binary part of the archive, whose name the description gives, or a list in the
//! description itself; a second part may hold one bit a point for what is defined. Archives that were zipped
//! with their folder have it in front of all names. Parts are read up to the size that the description asks
//! for and no further.

mod description;
mod write;

use std::io::{Cursor, Read};

use zip::ZipArchive;

use self::description::{Context, Description, Points};
pub use self::write::write_x3p;
use crate::error::Error;
use crate::foreign;
use crate::source::{Source, decode_text, shortened};
use crate::surface::Surface;
use crate::unit::LengthUnit;

/// First bytes of a zip archive.
pub(crate) const MAGIC: &[u8] = b"PK\x03\x04";
/// Longest description accepted \[bytes\]; one with the heights as a list of text is long.
const MAX_XML: u64 = 1 << 24;
/// Name of the description.
const DESCRIPTION: &str = "main.xml";

/// Part of a workbook that names its sheets.
const WORKBOOK: &str = "xl/workbook.xml";

/// The archive in memory.
type Archive<'a> = ZipArchive<Cursor<&'a [u8]>>;

/// Heights of the archive; undefined are those that are not finite and those whose bit is not set.
pub(crate) fn read(source: Source<'_>) -> Result<Surface, Error> {
    let mut archive = ZipArchive::new(Cursor::new(source.bytes))
        .map_err(|error| source.corrupt(format!("zip archive: {error}")))?;
    require_no_workbook(source, &mut archive)?;
    let folder = choose_folder(source, &archive)?;
    let xml = part(source, &mut archive, &format!("{folder}{DESCRIPTION}"), MAX_XML)?;
    let Description { nx, ny, layers, spacing, number, scale, offset, is_scale_doubtful, points, mask } =
        Context { source }.describe(&decode_text(&xml))?;
    // a choice among folders is none among layers
    let layer = if layers == 1 {
        0
    } else {
        source.choose((1..=layers).map(|number| format!("layer {number}")).collect())?
    };
    let count = nx * ny * layers;
    let mut stored = match points {
        Points::List(values) => values,
        Points::Part(name) => {
            let expected = count * number.size();
            source.require_noise(expected)?;
            let name = format!("{folder}{}", plain(&name));
            number.decode(&exact_part(source, &mut archive, &name, [nx, ny, layers], expected)?)
        }
    };
    if let Some(name) = mask {
        let name = format!("{folder}{}", plain(&name));
        let bits = exact_part(source, &mut archive, &name, [nx, ny, layers], count.div_ceil(8))?;
        for (k, value) in stored.iter_mut().enumerate() {
            if bits.get(k / 8).is_none_or(|byte| byte >> (k % 8) & 1 == 0) {
                *value = f64::NAN;
            }
        }
    }
    stored.truncate((layer + 1) * nx * ny);
    let heights = source.scaled(nx, stored.split_off(layer * nx * ny), offset, scale)?;
    let mut surface = Surface { unit: Some(LengthUnit::Metre), ..Surface::new(nx, ny, heights) };
    if is_scale_doubtful {
        surface.warnings.push(format!(
            "the axis CZ holds absolute heights (type A), for which no increment is foreseen; they are multiplied by that of \
             the file, {scale}"
        ));
    }
    source.finish(surface.with_spacing(Some(spacing)))
}

/// Refuses a workbook of Excel, and names those of Mitutoyo, whose sheets have fixed names.
fn require_no_workbook(source: Source<'_>, archive: &mut Archive<'_>) -> Result<(), Error> {
    if !names(archive).any(|name| name == WORKBOOK) {
        return Ok(());
    }
    let sheets = decode_text(&part(source, archive, WORKBOOK, MAX_XML)?);
    if ["\"DATA\"", "\"Certificate\""].into_iter().all(|sheet| sheets.contains(sheet)) {
        return Err(Error::Foreign { path: source.path.to_owned(), format: "Mitutoyo xlsx" });
    }
    Err(source.unsupported("an Excel workbook xlsx; save the sheet of heights as text".to_owned()))
}

/// The folder of the only description, or of the chosen one of several, with the slash at its end.
fn choose_folder(source: Source<'_>, archive: &Archive<'_>) -> Result<String, Error> {
    let names: Vec<String> = names(archive).collect();
    let folders = names.iter().filter_map(|name| name.strip_suffix(DESCRIPTION));
    let mut folders: Vec<String> =
        folders.filter(|folder| folder.is_empty() || folder.ends_with('/')).map(str::to_owned).collect();
    match folders.as_slice() {
        [] => Err(match foreign::format_of_archive(names.iter().map(String::as_str)) {
            Some(format) => Error::Foreign { path: source.path.to_owned(), format },
            None => source.unsupported(format!("a zip archive without {DESCRIPTION}")),
        }),
        [_] => Ok(folders.swap_remove(0)),
        _ => {
            let chosen = source.choose(folders.clone())?;
            Ok(folders.swap_remove(chosen))
        }
    }
}

/// Plain names of all parts.
fn names(archive: &Archive<'_>) -> impl Iterator<Item = String> {
    (0..archive.len())
        .map(|k| archive.name_for_index(k).and_then(Result::ok).map(|name| plain(&name)).unwrap_or_default())
}

/// The content of a part, refused when longer than `limit`.
fn part(source: Source<'_>, archive: &mut Archive<'_>, name: &str, limit: u64) -> Result<Vec<u8>, Error> {
    let index = names(archive).position(|other| other.eq_ignore_ascii_case(name));
    let index =
        index.ok_or_else(|| source.corrupt(format!("part {} is not in the archive", shortened(name))))?;
    let damaged =
        |error: &dyn std::fmt::Display| source.corrupt(format!("part {}: {error}", shortened(name)));
    let part = archive.by_index(index).map_err(|error| damaged(&error))?;
    let mut bytes = Vec::new();
    part.take(limit + 1).read_to_end(&mut bytes).map_err(|error| damaged(&error))?;
    if bytes.len() as u64 > limit {
        let what = format!("part {} holds more than the expected {limit} bytes", shortened(name));
        return Err(source.corrupt(what));
    }
    Ok(bytes)
}

/// The content of a part that must have `expected` bytes.
fn exact_part(
    source: Source<'_>,
    archive: &mut Archive<'_>,
    name: &str,
    [nx, ny, layers]: [usize; 3],
    expected: usize,
) -> Result<Vec<u8>, Error> {
    let bytes = part(source, archive, name, expected as u64)?;
    if bytes.len() == expected {
        return Ok(bytes);
    }
    let found = bytes.len();
    let what = format!("{name} holds {found} bytes, {nx} x {ny} x {layers} points need {expected}");
    Err(source.corrupt(what))
}

/// Name of a part as archives should write it: some have backslashes or a leading one.
fn plain(name: &str) -> String {
    name.replace('\\', "/").trim_start_matches("./").trim_start_matches('/').to_owned()
}
