//! The bytes of a file with checked access, and the errors that name it.

use std::cell::Cell;
use std::path::Path;

use crate::error::Error;
use crate::options::Options;
use crate::surface::{MAX_POINTS, Surface};
use crate::unit::LengthUnit;

/// Bytes of heights over bytes of the file, at most: heights with the noise of an instrument shrink to a half at
/// best, those that are rounded or undefined over most of the area to some hundredth.
const MAX_EXPANSION: usize = 200;
/// Bytes of heights that are always taken: synthetic surfaces may be flat.
const ALWAYS_UNPACKED: usize = 1 << 26;

/// A file being read.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// Its name, for errors.
    pub(crate) path: &'a Path,
    /// Its content.
    pub(crate) bytes: &'a [u8],
    /// Whether numbers have their most significant byte first; most formats know one order alone.
    pub(crate) big_endian: bool,
    /// Choices of the caller.
    pub(crate) options: Options,
    /// Whether one of several surfaces was chosen.
    pub(crate) is_chosen: &'a Cell<bool>,
}

impl<'a> Source<'a> {
    /// A file that is damaged.
    pub(crate) fn corrupt(&self, what: String) -> Error {
        Error::Corrupt { path: self.path.to_owned(), what }
    }

    /// A variant that is not read.
    pub(crate) fn unsupported(&self, what: String) -> Error {
        Error::Unsupported { path: self.path.to_owned(), what }
    }

    /// A file of no known format.
    pub(crate) fn unknown(&self) -> Error {
        Error::UnknownFormat { path: self.path.to_owned() }
    }

    /// Index of the surface that was chosen among those called `names`; the only one needs no choice.
    pub(crate) fn choose(&self, names: Vec<String>) -> Result<usize, Error> {
        if names.len() == 1 {
            return Ok(0);
        }
        if self.is_chosen.replace(true) {
            let listed = names.join(", ");
            return Err(self.unsupported(format!("several surfaces within the chosen one ({listed})")));
        }
        match self.options.channel {
            Some(number) if (1..=names.len()).contains(&number) => Ok(number - 1),
            _ => Err(Error::Several { path: self.path.to_owned(), names }),
        }
    }

    /// `length` bytes from `at` on; `what` names them when the file ends before.
    pub(crate) fn slice(&self, at: usize, length: usize, what: &str) -> Result<&'a [u8], Error> {
        let end = at.checked_add(length);
        end.and_then(|end| self.bytes.get(at..end)).ok_or_else(|| {
            let size = self.bytes.len();
            self.corrupt(format!("{what} needs {length} bytes from byte {at} on, the file has {size}"))
        })
    }

    /// `N` bytes of a number, the least significant first.
    fn array<const N: usize>(&self, at: usize, what: &str) -> Result<[u8; N], Error> {
        let mut array = [0; N];
        array.copy_from_slice(self.slice(at, N, what)?);
        if self.big_endian {
            array.reverse();
        }
        Ok(array)
    }

    /// Little-endian number at a place, `what` for the error.
    pub(crate) fn u16(&self, at: usize, what: &str) -> Result<u16, Error> {
        Ok(u16::from_le_bytes(self.array(at, what)?))
    }

    pub(crate) fn u32(&self, at: usize, what: &str) -> Result<u32, Error> {
        Ok(u32::from_le_bytes(self.array(at, what)?))
    }

    pub(crate) fn i32(&self, at: usize, what: &str) -> Result<i32, Error> {
        Ok(i32::from_le_bytes(self.array(at, what)?))
    }

    pub(crate) fn f32(&self, at: usize, what: &str) -> Result<f64, Error> {
        Ok(f64::from(f32::from_le_bytes(self.array(at, what)?)))
    }

    pub(crate) fn f64(&self, at: usize, what: &str) -> Result<f64, Error> {
        Ok(f64::from_le_bytes(self.array(at, what)?))
    }

    /// A text field of fixed length, up to its first zero byte, without the blanks around it.
    pub(crate) fn text(&self, at: usize, length: usize, what: &str) -> Result<String, Error> {
        let bytes = self.slice(at, length, what)?;
        let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(length);
        Ok(decode_text(&bytes[..end]).trim().to_owned())
    }

    /// The unit of length called `name`; `what` says of which axis.
    pub(crate) fn unit(&self, name: &str, what: &str) -> Result<LengthUnit, Error> {
        LengthUnit::parse(name)
            .ok_or_else(|| self.unsupported(format!("{what}: \"{}\" is no unit of length", shortened(name))))
    }

    /// Error unless there are from 1 to [`MAX_POINTS`] points at positive distances \[m\], before memory is
    /// taken for them.
    pub(crate) fn require_size(&self, nx: usize, ny: usize, spacing: Option<[f64; 2]>) -> Result<(), Error> {
        let count = nx.checked_mul(ny);
        if count.is_none_or(|count| count == 0 || count > MAX_POINTS) {
            let limits = "there must be at least 1 along each axis and at most 2^26 (67 million) in all";
            return Err(self.corrupt(format!("{nx} x {ny} points: {limits}")));
        }
        for (name, distance) in ["dx", "dy"].into_iter().zip(spacing.unwrap_or([1.0, 1.0])) {
            if !(distance.is_finite() && distance > 0.0) {
                return Err(self.corrupt(format!("{name} = {distance} m: it must be finite and > 0")));
            }
        }
        Ok(())
    }

    /// Refuses compressed heights that take `expected` bytes where the file is too small for measured ones.
    pub(crate) fn require_noise(&self, expected: usize) -> Result<(), Error> {
        let packed = self.bytes.len();
        if expected <= ALWAYS_UNPACKED || expected / MAX_EXPANSION <= packed {
            return Ok(());
        }
        Err(self.unsupported(format!(
            "{packed} bytes that claim to hold {expected} bytes of heights, more than {MAX_EXPANSION} times as many"
        )))
    }

    /// Heights `offset + scale * stored` \[m\], NaN where the stored number is not finite.
    pub(crate) fn scaled(
        &self,
        nx: usize,
        stored: Vec<f64>,
        offset: f64,
        scale: f64,
    ) -> Result<Vec<f64>, Error> {
        let mut heights = stored;
        for (k, value) in heights.iter_mut().enumerate() {
            let height = offset + scale * *value;
            if value.is_finite() && !height.is_finite() {
                let (column, row) = (k % nx, k / nx);
                let what = format!("height ({column}, {row}) = {offset} + {scale} * {value} is not finite");
                return Err(self.corrupt(what));
            }
            *value = if value.is_finite() { height } else { f64::NAN };
        }
        Ok(heights)
    }

    /// The surface, if its sizes are sound.
    pub(crate) fn finish(&self, surface: Surface) -> Result<Surface, Error> {
        let Surface { nx, ny, spacing, .. } = surface;
        self.require_size(nx, ny, spacing)?;
        if surface.heights.len() != nx * ny {
            let found = surface.heights.len();
            return Err(self.corrupt(format!("{found} heights instead of {nx} x {ny}")));
        }
        if surface.heights.len() == 1 {
            return Err(self.unsupported("a single height is no surface".to_owned()));
        }
        if self.options.channel.is_some_and(|number| number != 1) && !self.is_chosen.get() {
            return Err(Error::Several { path: self.path.to_owned(), names: vec![String::new()] });
        }
        Ok(surface)
    }
}

/// Most keys that a warning lists.
const MOST_KEYS: usize = 8;

/// The warning of keys of a header that are not understood.
pub(crate) fn unknown_keys(keys: &[String]) -> Option<String> {
    let listed: Vec<String> = keys.iter().take(MOST_KEYS).map(|key| format!("\"{key}\"")).collect();
    let more = keys.len().saturating_sub(MOST_KEYS);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    (!keys.is_empty()).then(|| format!("keys of the header are not understood: {}{more}", listed.join(", ")))
}

/// The warning of a surface whose heights have no unit.
pub(crate) fn without_unit(remedy: &str) -> String {
    format!("the unit of the heights is not known, their numbers are taken as metres; {remedy}")
}

/// The marks that tell in which order the bytes of UTF-16 come.
const UTF_16: [[u8; 2]; 2] = [[0xff, 0xfe], [0xfe, 0xff]];

/// Whether text starts with a mark of UTF-16.
pub(crate) fn is_utf_16(bytes: &[u8]) -> bool {
    UTF_16.iter().any(|mark| bytes.starts_with(mark))
}

/// Text that is UTF-16 with its mark, UTF-8 or else Latin-1, without marks.
pub(crate) fn decode_text(bytes: &[u8]) -> String {
    if is_utf_16(bytes) {
        let order = if bytes.starts_with(&UTF_16[0]) { u16::from_le_bytes } else { u16::from_be_bytes };
        let units = bytes[2..].chunks_exact(2).map(|pair| order([pair[0], pair[1]]));
        return char::decode_utf16(units)
            .map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER))
            .collect();
    }
    let bytes = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().copied().map(char::from).collect(),
    }
}

/// The start of a text for an error message.
pub(crate) fn shortened(text: &str) -> String {
    text.chars().take(32).collect()
}
