//! Fields as files of the Visualization Toolkit.
//!
//! One file holds one grid and its fields as scalars at the nodes, big-endian as the format requires.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::error::SimError;

/// Writes `fields` on `grid` as point data of a legacy VTK file (rectilinear grid, binary, 64 bit floats,
/// positions of the nodes in m), which `ParaView` and `VisIt` open. Names must not hold blanks.
///
/// Source: VTK file formats, Kitware, legacy format 3.0.
///
/// # Errors
/// [`SimError::Input`] naming the field that does not fit the grid or whose name is empty, taken or holds a
/// blank; [`SimError::Io`] when the file cannot be written.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("fields.vtk");
/// let grid = stribeck::Grid::centred(3, 2, 1e-6, 1e-6)?;
/// stribeck::sim::write_vtk(&path, &grid, &[("film", &[1e-9; 6]), ("pressure", &[0.0; 6])])?;
/// assert!(std::fs::read(&path)?.starts_with(b"# vtk DataFile Version 3.0\n"));
/// let error = stribeck::sim::write_vtk(&path, &grid, &[("film m", &[1e-9; 6])]).unwrap_err();
/// assert_eq!(error.to_string(), "field name \"film m\": every field needs its own name, without blanks");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_vtk(path: impl AsRef<Path>, grid: &Grid, fields: &[(&str, &[f64])]) -> Result<(), SimError> {
    for (index, &(name, field)) in fields.iter().enumerate() {
        InputError::require_len(name, field, grid.len())?;
        let taken = fields[..index].iter().any(|(other, _)| *other == name);
        if name.is_empty() || taken || name.contains(|c: char| c.is_whitespace() || c.is_control()) {
            let reason = "every field needs its own name, without blanks".to_owned();
            return Err(InputError::Conflict { field: format!("field name \"{name}\""), reason }.into());
        }
    }
    let path = path.as_ref();
    write(path, grid, fields).map_err(|source| SimError::Io { path: path.to_owned(), source })
}

/// Header and fields.
fn write(path: &Path, grid: &Grid, fields: &[(&str, &[f64])]) -> std::io::Result<()> {
    let mut out = BufWriter::new(File::create(path)?);
    writeln!(out, "# vtk DataFile Version 3.0\nstribeck\nBINARY\nDATASET RECTILINEAR_GRID")?;
    writeln!(out, "DIMENSIONS {} {} 1", grid.nx(), grid.ny())?;
    let x: Vec<f64> = (0..grid.nx()).map(|i| grid.x(i)).collect();
    let y: Vec<f64> = (0..grid.ny()).map(|j| grid.y(j)).collect();
    for (axis, positions) in [("X", &x[..]), ("Y", &y), ("Z", &[0.0])] {
        writeln!(out, "{axis}_COORDINATES {} double", positions.len())?;
        write_values(&mut out, positions)?;
    }
    writeln!(out, "POINT_DATA {}", grid.len())?;
    for (name, field) in fields {
        writeln!(out, "SCALARS {name} double 1\nLOOKUP_TABLE default")?;
        write_values(&mut out, field)?;
    }
    out.flush()
}

/// Writes big-endian numbers and a newline.
fn write_values(out: &mut impl Write, values: &[f64]) -> std::io::Result<()> {
    for value in values {
        out.write_all(&value.to_be_bytes())?;
    }
    writeln!(out)
}
