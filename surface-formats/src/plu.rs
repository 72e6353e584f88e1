//! Sensofar topographies (`.plu`, `.apx`). The format has no magic number.

use crate::error::Error;
use crate::number::{Kind, NumberType};
use crate::source::Source;
use crate::surface::Surface;
use crate::unit::LengthUnit;

/// Length of the date, a text padded with zeros.
const DATE: usize = 128;
/// Where the calibration starts: after date, time and comment.
const CALIBRATION: usize = DATE + 4 + 256;
/// Where the type of the measurement is.
const KIND: usize = CALIBRATION + 40;
/// The type that holds heights.
const KIND_TOPOGRAPHY: u32 = 3;
/// Highest type that is known.
const LAST_KIND: u32 = 20;
/// Where the first layer starts: counts, then heights.
const LAYER: usize = KIND + 72;
/// Height of a point that was not measured.
const UNDEFINED: f64 = 1_000_001.0;

/// Whether the file starts with a date of printable letters padded with zeros, and the type is one that
/// exists.
pub(crate) fn recognises(bytes: &[u8]) -> bool {
    let Some(date) = bytes.get(..DATE) else { return false };
    let length = date.iter().take_while(|byte| (0x20..0x7f).contains(*byte)).count();
    // garbage may follow the zero that ends the text
    let is_date = (8..DATE).contains(&length) && date.get(length) == Some(&0);
    let kind =
        bytes.get(KIND..KIND + 4).map(|b| b.iter().rev().fold(0, |sum, byte| (sum << 8) | u32::from(*byte)));
    is_date && kind.is_some_and(|kind| kind <= LAST_KIND)
}

/// The only layer, or the chosen one of several.
pub(crate) fn read(source: Source<'_>) -> Result<Surface, Error> {
    let kind = source.u32(KIND, "the type of measurement")?;
    if kind != KIND_TOPOGRAPHY {
        return Err(source.unsupported(format!("a measurement of type {kind} instead of 3, topography")));
    }
    let unit = LengthUnit::Micrometre;
    let spacing = [
        source.f32(CALIBRATION + 16, "x spacing")? * unit.metres(),
        source.f32(CALIBRATION + 20, "y spacing")? * unit.metres(),
    ];
    let layers = usize::from(source.slice(KIND + 61, 1, "the number of layers")?[0]);
    if layers == 0 {
        return Err(source.corrupt("no layer".to_owned()));
    }
    let chosen = source.choose((1..=layers).map(|number| format!("layer {number}")).collect())?;
    let number = NumberType::new(Kind::Float, 4, false).ok_or_else(|| source.unknown())?;
    let mut start = LAYER;
    for layer in 0.. {
        let (ny, nx) = (source.u32(start, "rows")? as usize, source.u32(start + 4, "columns")? as usize);
        source.require_size(nx, ny, Some(spacing))?;
        let what = format!("the data of {nx} x {ny} points");
        let data = source.slice(start + 8, nx * ny * number.size(), &what)?;
        if layer < chosen {
            start += 8 + data.len();
            continue;
        }
        let mut stored = number.decode(data);
        stored.iter_mut().filter(|v| v.to_bits() == UNDEFINED.to_bits()).for_each(|v| *v = f64::NAN);
        let heights = source.scaled(nx, stored, -0.0, unit.metres())?;
        let surface = Surface { unit: Some(unit), ..Surface::new(nx, ny, heights) };
        return source.finish(surface.with_spacing(Some(spacing)));
    }
    Err(source.unknown())
}
