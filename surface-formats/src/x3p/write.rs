//! The writer of x3p files.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use md5::{Digest, Md5};
use zip::write::{SimpleFileOptions, ZipWriter};

use crate::error::Error;
use crate::surface::Surface;

/// Name of the binary part that is written.
const DATA: &str = "bindata/data.bin";

/// Writes a surface as x3p (ISO 25178-72), 64 bit floats; undefined points are `NaN`, as the standard has it.
///
/// [`crate::read`] gives back the same heights, undefined points and spacing, bit by bit.
///
/// # Errors
/// [`Error::NoSpacing`] for a surface without spacing, [`Error::Io`] when the file cannot be written.
///
/// ```
/// use surface_formats::{Surface, read, write_x3p};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("surface.x3p");
/// let surface = Surface::new(2, 1, vec![1e-9 / 3.0, f64::NAN]).with_spacing(Some([1e-6, 1e-6]));
/// write_x3p(&path, &surface)?;
/// let back = read(&path)?;
/// assert_eq!((back.heights[0], back.undefined()), (surface.heights[0], 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_x3p(path: impl AsRef<Path>, surface: &Surface) -> Result<(), Error> {
    let spacing = surface.spacing.ok_or(Error::NoSpacing)?;
    let path = path.as_ref();
    write_archive(path, surface, spacing).map_err(|source| Error::Io { path: path.to_owned(), source })
}

/// Description, heights and their checksum.
fn write_archive(path: &Path, surface: &Surface, spacing: [f64; 2]) -> std::io::Result<()> {
    let data: Vec<u8> = surface.heights.iter().flat_map(|height| height.to_le_bytes()).collect();
    let description = describe(surface, spacing, &hexadecimal(&Md5::digest(&data)));
    let sum = format!("{} *main.xml\n", hexadecimal(&Md5::digest(description.as_bytes())));
    let mut archive = ZipWriter::new(BufWriter::new(File::create(path)?));
    let parts = [("main.xml", description.as_bytes()), (DATA, &data), ("md5checksum.hex", sum.as_bytes())];
    for (name, content) in parts {
        archive.start_file(name, SimpleFileOptions::default())?;
        archive.write_all(content)?;
    }
    archive.finish()?.flush()
}

/// Bytes as text, two digits each.
fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect()
}

/// The description of `surface`, whose data have the checksum `data_sum`.
fn describe(surface: &Surface, [dx, dy]: [f64; 2], data_sum: &str) -> String {
    let Surface { nx, ny, .. } = surface;
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.opengps.eu/2008/ISO5436_2 http://www.opengps.eu/2008/ISO5436_2/ISO5436_2.xsd">
  <Record1>
    <Revision>ISO5436 - 2000</Revision>
    <FeatureType>SUR</FeatureType>
    <Axes>
      <CX><AxisType>I</AxisType><DataType>D</DataType><Increment>{dx:e}</Increment><Offset>0</Offset></CX>
      <CY><AxisType>I</AxisType><DataType>D</DataType><Increment>{dy:e}</Increment><Offset>0</Offset></CY>
      <CZ><AxisType>A</AxisType><DataType>D</DataType></CZ>
    </Axes>
  </Record1>
  <Record3>
    <MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>1</SizeZ></MatrixDimension>
    <DataLink><PointDataLink>{DATA}</PointDataLink><MD5ChecksumPointData>{data_sum}</MD5ChecksumPointData></DataLink>
  </Record3>
  <Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4>
</p:ISO5436_2>
"#
    )
}
