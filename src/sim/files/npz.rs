//! Fields as `NumPy` archives.
//!
//! An archive is a zip file of arrays; each is written in pieces, so that no copy of a field is made.

use std::fs::File;
use std::io::{BufWriter, ErrorKind, Seek, SeekFrom, Write};
use std::path::Path;

use zip::CompressionMethod;
use zip::write::{SimpleFileOptions, ZipWriter};

use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::error::SimError;

/// Bytes before the data of an npy array: a multiple of 64, enough for the shape of any grid.
const HEADER: usize = 128;
/// Positions of the nodes.
const AXES: [&str; 2] = ["x", "y"];
/// Number of values written at once.
const CHUNK: usize = 1024;
/// Magic, version and length of the dictionary.
const PREFIX: usize = 10;

/// Writes `fields` on `grid`, x fastest, as a deflated `NumPy` archive: `numpy.load(path)["film"]` is the
/// array of shape `(ny, nx)`, 64 bit floats in C order, of the field named `film`; `x` and `y` are the
/// positions of the nodes \[m\], of the shapes `(nx,)` and `(ny,)`.
///
/// # Errors
/// [`SimError::Input`] naming the field that has not a value a node or whose name is empty, taken (`x` and
/// `y` are) or no file name; [`SimError::Io`] when the file cannot be written.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("fields.npz");
/// let grid = stribeck::Grid::centred(3, 2, 1e-6, 1e-6)?;
/// stribeck::sim::write_npz(&path, &grid, &[("film", &[1e-9; 6]), ("pressure", &[0.0; 6])])?;
/// assert!(std::fs::read(&path)?.starts_with(b"PK"));
/// let error = stribeck::sim::write_npz(&path, &grid, &[("film", &[1e-9; 5])]).unwrap_err();
/// assert_eq!(error.to_string(), "film has 5 values, expected 6");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_npz(path: impl AsRef<Path>, grid: &Grid, fields: &[(&str, &[f64])]) -> Result<(), SimError> {
    for (index, &(name, field)) in fields.iter().enumerate() {
        InputError::require_len(name, field, grid.len())?;
        let taken = AXES.contains(&name) || fields[..index].iter().any(|(other, _)| *other == name);
        if name.is_empty() || taken || name.contains(['/', '\\', '\0']) {
            let reason = "every field needs its own name, without slashes".to_owned();
            return Err(InputError::Conflict { field: format!("field name \"{name}\""), reason }.into());
        }
    }
    let path = path.as_ref();
    write_archive(path, grid, fields).map_err(|source| SimError::Io { path: path.to_owned(), source })
}

/// Positions of the nodes, then the fields.
fn write_archive(path: &Path, grid: &Grid, fields: &[(&str, &[f64])]) -> std::io::Result<()> {
    let mut archive =
        ZipWriter::new(UntilError { inner: BufWriter::new(File::create(path)?), failed: false });
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    let (nx, ny) = (grid.nx(), grid.ny());
    let axes: [Vec<f64>; 2] = [(0..nx).map(|i| grid.x(i)).collect(), (0..ny).map(|j| grid.y(j)).collect()];
    for (name, positions) in AXES.iter().zip(&axes) {
        archive.start_file(format!("{name}.npy"), options)?;
        write_array(&mut archive, &format!("{},", positions.len()), positions)?;
    }
    for (name, field) in fields {
        archive.start_file(format!("{name}.npy"), options)?;
        write_array(&mut archive, &format!("{ny}, {nx}"), field)?;
    }
    archive.finish()?.flush()
}

/// A writer that discards all output after its first error. An archive writer finishes itself when dropped
/// and would print its errors to the terminal.
struct UntilError<W> {
    /// The writer.
    inner: W,
    /// Whether it has failed.
    failed: bool,
}

impl<W> UntilError<W> {
    /// The result of `act`, or `otherwise` after an error.
    fn act<T>(&mut self, otherwise: T, act: impl FnOnce(&mut W) -> std::io::Result<T>) -> std::io::Result<T> {
        if self.failed {
            return Ok(otherwise);
        }
        act(&mut self.inner).inspect_err(|error| self.failed = error.kind() != ErrorKind::Interrupted)
    }
}

impl<W: Write> Write for UntilError<W> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.act(bytes.len(), |inner| inner.write(bytes))
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.act((), Write::flush)
    }
}

impl<W: Seek> Seek for UntilError<W> {
    fn seek(&mut self, position: SeekFrom) -> std::io::Result<u64> {
        self.act(0, |inner| inner.seek(position))
    }
}

/// Header and values of one array of the given `shape`.
fn write_array(out: &mut impl Write, shape: &str, values: &[f64]) -> std::io::Result<()> {
    let dictionary = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({shape}), }}");
    let length = HEADER - PREFIX;
    out.write_all(b"\x93NUMPY\x01\x00")?;
    out.write_all(&[length as u8, 0])?;
    writeln!(out, "{dictionary:<width$}", width = length - 1)?;
    let mut bytes = Vec::with_capacity(CHUNK * size_of::<f64>());
    for row in values.chunks(CHUNK) {
        bytes.clear();
        bytes.extend(row.iter().flat_map(|value| value.to_le_bytes()));
        out.write_all(&bytes)?;
    }
    Ok(())
}
