//! The bytes of a file with checked access, and the errors that name it.

use std::path::Path;

use crate::grid::Grid;
use crate::surface::{Heights, LengthUnit, SurfaceError};

/// Bytes of heights over bytes of the file, at most: heights with the noise of an instrument shrink to a half at
/// best, those that are rounded or undefined over most of the area to some hundredth.
const MAX_EXPANSION: usize = 200;
/// Bytes of heights that are always taken: synthetic surfaces may be flat.
const ALWAYS_UNPACKED: usize = 1 << 26;

/// A file being read.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    /// Its name, for errors.
    pub(super) path: &'a Path,
    /// Its content.
    pub(super) bytes: &'a [u8],
    /// Whether numbers have their most significant byte first; most formats know one order alone.
    pub(super) big_endian: bool,
}

/// What a reader found, lengths in metres, not yet checked.
pub(super) struct Found {
    /// Points along x.
    pub(super) nx: usize,
    /// Points along y.
    pub(super) ny: usize,
    /// Distances of the points along x and y \[m\].
    pub(super) spacing: Option<[f64; 2]>,
    /// Unit of the heights in the file.
    pub(super) unit: Option<LengthUnit>,
    /// Heights \[m\].
    pub(super) heights: Vec<f64>,
    /// Which points are defined; none where all are.
    pub(super) defined: Option<Vec<bool>>,
}

impl<'a> Source<'a> {
    /// A file that is damaged.
    pub(super) fn corrupt(&self, what: String) -> SurfaceError {
        SurfaceError::Corrupt { path: self.path.to_owned(), what }
    }

    /// A variant that is not read.
    pub(super) fn unsupported(&self, what: String) -> SurfaceError {
        SurfaceError::Unsupported { path: self.path.to_owned(), what }
    }

    /// A file of no known format.
    pub(super) fn unknown(&self) -> SurfaceError {
        SurfaceError::UnknownFormat { path: self.path.to_owned() }
    }

    /// `length` bytes from `at` on; `what` names them when the file ends before.
    pub(super) fn slice(&self, at: usize, length: usize, what: &str) -> Result<&'a [u8], SurfaceError> {
        let end = at.checked_add(length);
        end.and_then(|end| self.bytes.get(at..end)).ok_or_else(|| {
            let size = self.bytes.len();
            self.corrupt(format!("{what} needs {length} bytes from byte {at} on, the file has {size}"))
        })
    }

    /// `N` bytes of a number, the least significant first.
    fn array<const N: usize>(&self, at: usize, what: &str) -> Result<[u8; N], SurfaceError> {
        let mut array = [0; N];
        array.copy_from_slice(self.slice(at, N, what)?);
        if self.big_endian {
            array.reverse();
        }
        Ok(array)
    }

    /// Little-endian number at a place, `what` for the error.
    pub(super) fn u16(&self, at: usize, what: &str) -> Result<u16, SurfaceError> {
        Ok(u16::from_le_bytes(self.array(at, what)?))
    }

    pub(super) fn u32(&self, at: usize, what: &str) -> Result<u32, SurfaceError> {
        Ok(u32::from_le_bytes(self.array(at, what)?))
    }

    pub(super) fn i32(&self, at: usize, what: &str) -> Result<i32, SurfaceError> {
        Ok(i32::from_le_bytes(self.array(at, what)?))
    }

    pub(super) fn f32(&self, at: usize, what: &str) -> Result<f64, SurfaceError> {
        Ok(f64::from(f32::from_le_bytes(self.array(at, what)?)))
    }

    pub(super) fn f64(&self, at: usize, what: &str) -> Result<f64, SurfaceError> {
        Ok(f64::from_le_bytes(self.array(at, what)?))
    }

    /// A text field of fixed length, up to its first zero byte, without the blanks around it.
    pub(super) fn text(&self, at: usize, length: usize, what: &str) -> Result<String, SurfaceError> {
        let bytes = self.slice(at, length, what)?;
        let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(length);
        Ok(decode_text(&bytes[..end]).trim().to_owned())
    }

    /// The unit of length called `name`; `what` says of which axis.
    pub(super) fn unit(&self, name: &str, what: &str) -> Result<LengthUnit, SurfaceError> {
        LengthUnit::parse(name)
            .ok_or_else(|| self.unsupported(format!("{what} unit \"{}\" is no length", shortened(name))))
    }

    /// Error unless the counts and the spacing \[m\] make a grid, before memory is taken for it.
    pub(super) fn require_size(
        &self,
        nx: usize,
        ny: usize,
        spacing: Option<[f64; 2]>,
    ) -> Result<(), SurfaceError> {
        let [dx, dy] = spacing.unwrap_or([1.0, 1.0]);
        Grid::centred(nx, ny, dx, dy)
            .map(|_| ())
            .map_err(|error| self.corrupt(format!("{nx} x {ny} points: {error}")))
    }

    /// Refuses compressed heights that take `expected` bytes where the file is too small for measured ones.
    pub(super) fn require_noise(&self, expected: usize) -> Result<(), SurfaceError> {
        let packed = self.bytes.len();
        if expected <= ALWAYS_UNPACKED || expected / MAX_EXPANSION <= packed {
            return Ok(());
        }
        Err(self.unsupported(format!(
            "{packed} bytes that claim to hold {expected} bytes of heights, more than {MAX_EXPANSION} times as many"
        )))
    }

    /// The surface, if all that is defined is finite.
    pub(super) fn finish(&self, found: Found) -> Result<Heights, SurfaceError> {
        let Found { nx, ny, spacing, unit, heights, defined } = found;
        self.require_size(nx, ny, spacing)?;
        let is_defined = |k: usize| defined.as_ref().is_none_or(|mask| mask.get(k) == Some(&true));
        let wrong = heights.iter().enumerate().find(|&(k, height)| !height.is_finite() && is_defined(k));
        if let Some((k, &value)) = wrong {
            let (column, row) = (k % nx, k / nx);
            return Err(SurfaceError::NotFinite { path: self.path.to_owned(), column, row, value });
        }
        let surface = Heights::new(nx, ny, spacing, heights, defined)?;
        Ok(match unit {
            Some(unit) => surface.with_unit(unit),
            None => surface,
        })
    }
}

/// The marks that tell in which order the bytes of UTF-16 come.
const UTF_16: [[u8; 2]; 2] = [[0xff, 0xfe], [0xfe, 0xff]];

/// Whether text starts with a mark of UTF-16.
pub(super) fn is_utf_16(bytes: &[u8]) -> bool {
    UTF_16.iter().any(|mark| bytes.starts_with(mark))
}

/// Text that is UTF-16 with its mark, UTF-8 or else Latin-1, without marks.
pub(super) fn decode_text(bytes: &[u8]) -> String {
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
pub(super) fn shortened(text: &str) -> String {
    text.chars().take(32).collect()
}
