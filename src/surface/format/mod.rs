//! Files of measured surfaces: readers and writers, one format a file.
//!
//! The format is told from the first bytes; `.plu`, which has no mark, from the padded date there, and text
//! is what is none of the others. Readers take bytes and give [`Heights`] in metres, positive out of the
//! body, undefined points marked. They are written against damaged and hostile files: every access is
//! checked, sizes are compared with the length of the file before memory is asked for, and errors name the
//! file and what is wrong with it (`source`).

mod al3d;
mod npy;
mod number;
mod plu;
mod sdf;
mod source;
mod sur;
mod text;
mod x3p;

use std::path::Path;

pub use npy::write_npy;
pub use text::write_text;
pub use x3p::write_x3p;

use self::source::Source;
use super::error::SurfaceError;
use super::measured::Heights;
use crate::regular_file;

/// Larger files are refused: more than the text of [`crate::Grid::MAX_NODES`] heights.
const MAX_FILE: u64 = 1 << 31;

/// Reads a measured surface; the content decides about the format, not the name.
///
/// | content | format | holds |
/// |---|---|---|
/// | zip archive with `main.xml` | x3p, ISO 25178-72 | heights and spacing in metres, undefined points |
/// | `DIGITAL SURF`, `DSCOMPRESSED` | Digital Surf sur | heights as integers with scale and units, undefined points |
/// | `aISO-1.0`, `bISO-1.0` and versions 2.0, `BCR` | sdf, ISO 25178-71 | heights with scale in metres, undefined points |
/// | `AliconaImaging` | al3d | heights in metres, undefined points |
/// | date padded with zeros | Sensofar plu | heights in micrometres, undefined points |
/// | `\x93NUMPY` | npy | an array of shape `(ny, nx)`, taken as heights in metres; no spacing ([`Heights::with_spacing`]) |
/// | text | delimited numbers, a line for each row | sizes and units where a header gives them, else metres |
///
/// All lengths are converted to metres; [`Heights::unit`] tells the unit of the file. Points that the format
/// marks as undefined go into the mask; a height that is not finite without being so marked is an error.
///
/// Of x3p: surfaces and profiles at equal distances with binary heights (16 or 32 bit integers, 32 or 64 bit
/// floats, `NaN` undefined), scaled by the increment and offset of the height axis where given, or a list in
/// the XML (up to 16 MiB). The checksum of the archive (CRC-32) is verified, the MD5 sums of the standard are
/// not. Of sur and plu: the first object or layer. Of sdf: uncompressed. Of al3d: the depth image (`NaN`
/// undefined). Of npy: versions 1 to 3, integers and floats of any size up to 8 bytes, both byte orders, C
/// and Fortran order. Profiles (x3p, sur, npy of one dimension) are surfaces of one row. Of text: fields
/// separated by blanks, commas or semicolons, `BAD` or an empty field undefined; headers in the style of
/// Gwyddion (`Width: 10 um`), SPIP (`x-length`, `z-unit`) and this crate; the first channel.
///
/// No file, however damaged, should make it panic; memory is taken for points that the file really holds, at
/// most [`crate::Grid::MAX_NODES`]. Heights of more than 64 MB that are packed into less than a
/// two-hundredth of their size are refused: those of measurements are noisy and hardly shrink.
///
/// # Errors
/// [`SurfaceError`] with the path and what is wrong: the file cannot be opened, is a pipe, a device or a
/// folder, is of no known format, damaged, holds a part that is not supported, or a height that is not finite.
///
/// ```
/// use stribeck::surface::{read, write_npy};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("heights.npy");
/// write_npy(&path, 2, 1, &[1e-9, 2e-9])?;
/// let heights = read(&path)?.with_spacing(1e-6, 1e-6)?;
/// assert_eq!(heights.heights(), [1e-9, 2e-9]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read(path: impl AsRef<Path>) -> Result<Heights, SurfaceError> {
    let path = path.as_ref();
    let io = |source| SurfaceError::Io { path: path.to_owned(), source };
    let bytes = regular_file::read(path, MAX_FILE).map_err(io)?;
    read_bytes(&bytes, path)
}

/// Reads a measured surface from the content of a file, as [`read`] does; `name` stands in errors.
///
/// # Errors
/// Those of [`read`].
///
/// ```
/// use stribeck::surface::{LengthUnit, read_bytes};
/// let text = "# Width: 3 um\n# Height: 2 um\n# Value units: nm\n1 2 3\n4 BAD 6\n";
/// let surface = read_bytes(text.as_bytes(), "heights.txt")?;
/// assert_eq!((surface.nx(), surface.ny(), surface.undefined()), (3, 2, 1));
/// assert_eq!((surface.heights()[0], surface.unit()), (1e-9, Some(LengthUnit::Nanometre)));
/// # Ok::<(), stribeck::surface::SurfaceError>(())
/// ```
pub fn read_bytes(bytes: &[u8], name: impl AsRef<Path>) -> Result<Heights, SurfaceError> {
    let source = Source { path: name.as_ref(), bytes, big_endian: false };
    if bytes.len() as u64 > MAX_FILE {
        return Err(source.unsupported("a file of more than 2 GiB".to_owned()));
    }
    if bytes.starts_with(npy::MAGIC) {
        npy::read(source)
    } else if bytes.starts_with(x3p::MAGIC) {
        x3p::read(source)
    } else if bytes.starts_with(sur::MAGIC) || bytes.starts_with(sur::MAGIC_COMPRESSED) {
        sur::read(source)
    } else if bytes.starts_with(al3d::MAGIC) {
        al3d::read(source)
    } else if sdf::recognises(bytes) {
        sdf::read(source)
    } else if plu::recognises(bytes) {
        plu::read(source)
    } else if text::recognises(bytes) {
        text::read(source)
    } else {
        Err(source.unknown())
    }
}
