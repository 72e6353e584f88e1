//! Reading a measured surface, whatever its format.

use std::fs::File;
use std::io::{Read, Seek};
use std::path::Path;

use super::error::SurfaceError;
use super::measured::Heights;
use super::{npy, x3p};

/// Reads a measured surface; the content decides about the format, not the name.
///
/// | content | format | holds |
/// |---|---|---|
/// | zip archive with `main.xml` | x3p, ISO 25178-72 | heights and spacing in metres, undefined points |
/// | `\x93NUMPY` | npy | an array of shape `(ny, nx)`, taken as heights in metres; no spacing ([`Heights::with_spacing`]) |
///
/// Of x3p: areal surfaces on an equidistant grid with binary heights (16 or 32 bit integers, 32 or 64 bit floats) or a
/// list in the XML (up to 16 MiB). The checksum of the archive (CRC-32) is verified, the MD5 sums of the standard are not.
/// Of npy: versions 1 to 3, integers and floats of any size up to 8 bytes, both byte orders, C and Fortran order.
/// No file, however damaged, should make it panic; memory is taken for points that the file really holds, at most
/// [`crate::Grid::MAX_NODES`].
///
/// # Errors
/// [`SurfaceError`] with the path and what is wrong: the file cannot be opened, is of no known format, damaged, holds a part
/// that is not supported, or (npy) a height that is not finite.
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
    let mut file = File::open(path).map_err(io)?;
    let mut start = Vec::new();
    Read::by_ref(&mut file).take(6).read_to_end(&mut start).map_err(io)?;
    file.rewind().map_err(io)?;
    if start.starts_with(b"\x93NUMPY") {
        npy::read(path, file)
    } else if start.starts_with(b"PK\x03\x04") {
        x3p::read(path, file)
    } else {
        Err(SurfaceError::UnknownFormat { path: path.to_owned() })
    }
}
