//! The writer of text files.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use crate::error::Error;
use crate::surface::Surface;

/// Writes a surface as text: a header with sizes and units, then one line of heights \[m\] for each row,
/// separated by tabs, `BAD` where undefined. Programs that read Gwyddion's text export understand it.
///
/// [`crate::read`] gives back the same heights, undefined points and spacing, bit by bit.
///
/// # Errors
/// [`Error::Io`] when the file cannot be written.
///
/// ```
/// use surface_formats::{Surface, read, write_text};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("surface.txt");
/// let surface = Surface::new(2, 1, vec![1e-9 / 3.0, 2e-9]).with_spacing(Some([1e-6, 1e-6]));
/// write_text(&path, &surface)?;
/// assert_eq!(read(&path)?.heights, surface.heights);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_text(path: impl AsRef<Path>, surface: &Surface) -> Result<(), Error> {
    let path = path.as_ref();
    write_lines(path, surface).map_err(|source| Error::Io { path: path.to_owned(), source })
}

/// Header and rows.
fn write_lines(path: &Path, surface: &Surface) -> std::io::Result<()> {
    let Surface { nx, ny, .. } = *surface;
    let mut out = BufWriter::new(File::create(path)?);
    if let Some([dx, dy]) = surface.spacing {
        writeln!(out, "# Width: {:e} m", dx * nx as f64)?;
        writeln!(out, "# Height: {:e} m", dy * ny as f64)?;
        // sizes do not always give back the spacing to the last bit
        writeln!(out, "# Spacing X: {dx:e} m")?;
        writeln!(out, "# Spacing Y: {dy:e} m")?;
    }
    writeln!(out, "# Value units: m")?;
    // a file cut short is found out
    writeln!(out, "# x-pixels = {nx}")?;
    writeln!(out, "# y-pixels = {ny}")?;
    for (k, height) in surface.heights.iter().enumerate() {
        if height.is_nan() {
            write!(out, "BAD")?;
        } else {
            write!(out, "{height:e}")?;
        }
        out.write_all(if (k + 1) % nx == 0 { b"\n" } else { b"\t" })?;
    }
    out.flush()
}
