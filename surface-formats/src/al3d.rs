//! Alicona depth images (`.al3d`).
//!
//! Behind the magic stand tags of fixed width, name and value as text; they give counts, spacings and where
//! the depth image starts: floats of 32 bits, rows padded to multiples of eight bytes.

use crate::error::Error;
use crate::number::{Kind, NumberType};
use crate::source::{Source, shortened};
use crate::surface::Surface;
use crate::unit::LengthUnit;

/// First bytes of the file.
pub(crate) const MAGIC: &[u8] = b"AliconaImaging\0\r\n";

/// Bytes of the name of a tag, which its value and the end of the line follow.
const NAME: usize = 20;
/// Bytes of its value.
const VALUE: usize = 30;
/// Bytes of a whole tag.
const TAG: usize = NAME + VALUE + 2;
/// More tags than these are refused.
const MAX_TAGS: usize = 1 << 10;
/// Rows start at multiples of this many bytes.
const ALIGNMENT: usize = 8;
/// Relative difference below which a depth is the marker of undefined points, which is a rounded text.
const MARKER_TOLERANCE: f64 = 1.5e-7;
/// Depths from here on are undefined too; files without a marker of their own use it \[m\].
const MARKER: f64 = 3e15;

/// The tags of a file.
struct Tags<'a> {
    /// The file, for errors.
    source: Source<'a>,
    /// Names and values in the order of the file.
    tags: Vec<(String, String)>,
}

impl<'a> Tags<'a> {
    /// Reads as many tags as the second one counts.
    fn read(source: Source<'a>) -> Result<Self, Error> {
        let version = read_tag(source, 0)?;
        let count = read_tag(source, 1)?;
        let mut tags = Self { source, tags: vec![version, count] };
        let further = tags.number::<usize>("TagCount")?;
        if further > MAX_TAGS {
            return Err(source.corrupt(format!("TagCount = {further}, at most {MAX_TAGS} are read")));
        }
        for index in 2..2 + further {
            tags.tags.push(read_tag(source, index)?);
        }
        Ok(tags)
    }

    /// The value of a tag, if it is there.
    fn text(&self, name: &str) -> Option<&str> {
        self.tags.iter().find(|(other, _)| other == name).map(|(_, value)| value.as_str())
    }

    /// The value of a tag as a number; an error where it is missing.
    fn number<T: std::str::FromStr>(&self, name: &str) -> Result<T, Error> {
        let text = self.text(name).ok_or_else(|| self.source.corrupt(format!("tag {name} is missing")))?;
        text.parse()
            .map_err(|_| self.source.corrupt(format!("tag {name} = {} is not a number", shortened(text))))
    }
}

/// Name and value of tag number `index`.
fn read_tag(source: Source<'_>, index: usize) -> Result<(String, String), Error> {
    let at = MAGIC.len() + index * TAG;
    let what = format!("tag {index}");
    if source.slice(at + NAME + VALUE, 2, &what)? != b"\r\n" {
        return Err(source.corrupt(format!("{what} does not end with a line break")));
    }
    Ok((source.text(at, NAME, &what)?, source.text(at + NAME, VALUE, &what)?))
}

/// Heights of the depth image.
pub(crate) fn read(source: Source<'_>) -> Result<Surface, Error> {
    let tags = Tags::read(source)?;
    let (nx, ny) = (tags.number::<usize>("Cols")?, tags.number::<usize>("Rows")?);
    let spacing = [tags.number("PixelSizeXMeter")?, tags.number("PixelSizeYMeter")?];
    source.require_size(nx, ny, Some(spacing))?;
    let marker = match tags.text("InvalidPixelValue") {
        Some(_) => tags.number::<f64>("InvalidPixelValue")?,
        None => MARKER,
    };
    let marker = if marker.is_finite() { marker } else { MARKER };
    let start = tags.number::<usize>("DepthImageOffset")?;
    let number = NumberType::new(Kind::Float, 4, false).ok_or_else(|| source.unknown())?;
    let row = nx * number.size();
    let stride = row.next_multiple_of(ALIGNMENT);
    // the padding of the last row may be missing
    let what = format!("the depth image of {nx} x {ny} points");
    let image = source.slice(start, stride * (ny - 1) + row, &what)?;
    let depths = image.chunks(stride).flat_map(|line| number.decode(&line[..row]));
    let heights = depths.map(|depth| if is_defined(depth, marker) { depth } else { f64::NAN }).collect();
    let surface = Surface { unit: Some(LengthUnit::Metre), ..Surface::new(nx, ny, heights) };
    source.finish(surface.with_spacing(Some(spacing)))
}

/// Whether a depth is finite, below [`MARKER`] and not the marker of undefined points.
fn is_defined(depth: f64, marker: f64) -> bool {
    let marked = (depth - marker).abs() <= MARKER_TOLERANCE * marker.abs();
    depth.is_finite() && !marked && depth < MARKER
}
