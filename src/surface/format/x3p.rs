//! The x3p container (ISO 25178-72): a zip archive with a description in XML and the heights in binary form.
//!
//! `main.xml` describes one feature on equidistant axes: counts, increments, type and scale of the heights.
//! The heights are a binary part of the archive, whose name the description gives, or a list in the
//! description itself; a second part may hold one bit a point for what is defined. Parts are read up to the
//! size that the description asks for and no further.

use std::fs::File;
use std::io::{BufWriter, Cursor, Read, Write};
use std::path::Path;

use md5::{Digest, Md5};
use roxmltree::{Document, Node, ParsingOptions};
use zip::ZipArchive;
use zip::write::{SimpleFileOptions, ZipWriter};

use super::number::{Kind, NumberType};
use super::source::{Found, Source, decode_text, shortened};
use crate::surface::{Heights, LengthUnit, SurfaceError};

/// Longest description accepted \[bytes\]; one with the heights as a list of text is long.
const MAX_XML: u64 = 1 << 24;
/// Most XML nodes accepted, which bounds the memory of the parsed description.
const MAX_XML_NODES: u32 = 1 << 21;

/// What `main.xml` says.
struct Description {
    /// Points along x.
    nx: usize,
    /// Points along y.
    ny: usize,
    /// Distances of the points along x and y \[m\].
    spacing: [f64; 2],
    /// Type of the stored numbers.
    number: NumberType,
    /// Height = offset + scale * stored number.
    scale: f64,
    /// Height of a stored zero \[m\].
    offset: f64,
    /// The stored numbers, or where they are.
    points: Points,
    /// Name of the part with one bit for each point, set where it is defined.
    mask: Option<String>,
}

/// What is described.
enum Feature {
    /// Points on a rectangle.
    Surface,
    /// A surface of one row; the step across it is taken as that along it.
    Profile,
}

/// Where the heights are.
enum Points {
    /// Name of the binary part.
    Part(String),
    /// Stored in the description itself; `NaN` where undefined.
    List(Vec<f64>),
}

/// First bytes of a zip archive.
pub(super) const MAGIC: &[u8] = b"PK\x03\x04";

/// The archive in memory.
type Archive<'a> = ZipArchive<Cursor<&'a [u8]>>;

/// Heights of the archive; undefined are those that are no number and those whose bit is not set.
pub(super) fn read(source: Source<'_>) -> Result<Heights, SurfaceError> {
    let context = Context { source };
    let mut archive = ZipArchive::new(Cursor::new(source.bytes))
        .map_err(|error| source.corrupt(format!("zip archive: {error}")))?;
    if archive.index_for_name("main.xml").is_none() {
        return Err(source.unknown());
    }
    let xml = context.part(&mut archive, "main.xml", MAX_XML)?;
    let Description { nx, ny, spacing, number, scale, offset, points, mask } =
        context.describe(&decode_text(&xml))?;
    let stored = match points {
        Points::List(values) => values,
        Points::Part(name) => {
            let expected = nx * ny * number.size();
            source.require_noise(expected)?;
            number.decode(&context.exact_part(&mut archive, &name, nx, ny, expected)?)
        }
    };
    let mut defined: Vec<bool> = stored.iter().map(|value| !value.is_nan()).collect();
    if let Some(name) = mask {
        let bits = context.exact_part(&mut archive, &name, nx, ny, (nx * ny).div_ceil(8))?;
        for (k, flag) in defined.iter_mut().enumerate() {
            *flag &= bits.get(k / 8).is_some_and(|byte| byte >> (k % 8) & 1 == 1);
        }
    }
    let heights = stored.iter().map(|value| offset + scale * value).collect();
    let (spacing, unit) = (Some(spacing), Some(LengthUnit::Metre));
    source.finish(Found { nx, ny, spacing, unit, heights, defined: Some(defined) })
}

/// The file being read.
struct Context<'a> {
    /// Its bytes and its name.
    source: Source<'a>,
}

impl Context<'_> {
    /// The error of a damaged file.
    fn corrupt(&self, what: String) -> SurfaceError {
        self.source.corrupt(what)
    }

    /// The error of a file that is not read.
    fn unsupported(&self, what: String) -> SurfaceError {
        self.source.unsupported(what)
    }

    /// The content of a part, refused when longer than `limit`.
    fn part(&self, archive: &mut Archive<'_>, name: &str, limit: u64) -> Result<Vec<u8>, SurfaceError> {
        let same = |k: usize| {
            let other = archive.name_for_index(k).and_then(Result::ok);
            other.is_some_and(|other| plain(&other).eq_ignore_ascii_case(&plain(name)))
        };
        let exact = archive.index_for_name(name);
        let index = exact.or_else(|| (0..archive.len()).find(|&k| same(k)));
        let index =
            index.ok_or_else(|| self.corrupt(format!("part {} is not in the archive", shortened(name))))?;
        let part = archive.by_index(index).map_err(|error| self.corrupt(format!("part {name}: {error}")))?;
        let mut bytes = Vec::new();
        part.take(limit + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| self.corrupt(format!("part {name}: {error}")))?;
        if bytes.len() as u64 > limit {
            return Err(self.corrupt(format!("part {name} holds more than the expected {limit} bytes")));
        }
        Ok(bytes)
    }

    /// The content of a part that must have `expected` bytes.
    fn exact_part(
        &self,
        archive: &mut Archive<'_>,
        name: &str,
        nx: usize,
        ny: usize,
        expected: usize,
    ) -> Result<Vec<u8>, SurfaceError> {
        let bytes = self.part(archive, name, expected as u64)?;
        if bytes.len() == expected {
            return Ok(bytes);
        }
        let found = bytes.len();
        Err(self.corrupt(format!("{name} holds {found} bytes, {nx} x {ny} points need {expected}")))
    }

    /// What `main.xml` says, checked.
    fn describe(&self, xml: &str) -> Result<Description, SurfaceError> {
        let options = ParsingOptions { nodes_limit: MAX_XML_NODES, ..ParsingOptions::default() };
        let document = Document::parse_with_options(xml, options)
            .map_err(|error| self.corrupt(format!("main.xml: {error}")))?;
        let root = document.root_element();
        let feature = self.feature(root)?;
        let (nx, ny) = (self.count(root, "SizeX")?, self.count(root, "SizeY")?);
        let along_x = self.increment(root, "CX")?;
        let spacing = match feature {
            Feature::Surface => [along_x, self.increment(root, "CY")?],
            Feature::Profile if ny == 1 => [along_x, along_x],
            Feature::Profile => return Err(self.corrupt(format!("a profile of {ny} rows (SizeY)"))),
        };
        self.source.require_size(nx, ny, Some(spacing))?;
        let (number, scale, offset) = self.heights_axis(root)?;
        let points = self.points(root, nx * ny)?;
        let mask = find(root, &["Record3", "DataLink", "ValidPointsLink"])
            .and_then(|node| node.text())
            .map(|name| name.trim().to_owned())
            .filter(|name| !name.is_empty());
        Ok(Description { nx, ny, spacing, number, scale, offset, points, mask })
    }

    /// Refuses what is not a single surface or profile with all points in one matrix.
    fn feature(&self, root: Node<'_, '_>) -> Result<Feature, SurfaceError> {
        let feature = match self.text(root, &["Record1", "FeatureType"])? {
            "SUR" => Feature::Surface,
            "PRF" => Feature::Profile,
            other => {
                let what = format!("feature type {} instead of SUR or PRF", shortened(other));
                return Err(self.unsupported(what));
            }
        };
        if let Some(layers) = find(root, &["Record3", "MatrixDimension", "SizeZ"])
            && layers.text().map(str::trim) != Some("1")
        {
            return Err(self.unsupported("more than one layer (SizeZ)".to_owned()));
        }
        Ok(feature)
    }

    /// The text of the element at the path `names` below the root.
    fn text<'a>(&self, root: Node<'a, '_>, names: &[&str]) -> Result<&'a str, SurfaceError> {
        find(root, names)
            .and_then(|node| node.text())
            .map(str::trim)
            .ok_or_else(|| self.corrupt(format!("main.xml lacks {}", names.join("/"))))
    }

    /// A count of the matrix of points.
    fn count(&self, root: Node<'_, '_>, name: &str) -> Result<usize, SurfaceError> {
        let text = self.text(root, &["Record3", "MatrixDimension", name])?;
        text.parse()
            .map_err(|_| self.corrupt(format!("main.xml: {name} is not a count: {}", shortened(text))))
    }

    /// A finite number at the path `names`.
    fn number(&self, root: Node<'_, '_>, names: &[&str]) -> Result<f64, SurfaceError> {
        let text = self.text(root, names)?;
        text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| {
            self.corrupt(format!("main.xml: {} is not a number: {}", names.join("/"), shortened(text)))
        })
    }

    /// Spacing of a lateral axis \[m\].
    fn increment(&self, root: Node<'_, '_>, axis: &str) -> Result<f64, SurfaceError> {
        let kind = self.text(root, &["Record1", "Axes", axis, "AxisType"])?;
        if kind != "I" {
            return Err(self.unsupported(format!("axis {axis} of type {kind} instead of I (equidistant)")));
        }
        self.number(root, &["Record1", "Axes", axis, "Increment"])
    }

    /// Type of the stored heights and their scale and offset.
    fn heights_axis(&self, root: Node<'_, '_>) -> Result<(NumberType, f64, f64), SurfaceError> {
        let name = self.text(root, &["Record1", "Axes", "CZ", "DataType"])?;
        let number = match name {
            "I" => NumberType::new(Kind::Signed, 2, false),
            "L" => NumberType::new(Kind::Signed, 4, false),
            "F" => NumberType::new(Kind::Float, 4, false),
            "D" => NumberType::new(Kind::Float, 8, false),
            _ => None,
        };
        let number =
            number.ok_or_else(|| self.unsupported(format!("heights of type {}", shortened(name))))?;
        let optional = |name: &str, default: f64| {
            let names = ["Record1", "Axes", "CZ", name];
            match find(root, &names).and_then(|node| node.text()) {
                Some(text) if !text.trim().is_empty() => self.number(root, &names),
                _ => Ok(default),
            }
        };
        // heights that are floats may come with an increment of nothing
        let scale = Some(optional("Increment", 1.0)?).filter(|scale| *scale != 0.0).unwrap_or(1.0);
        // what is added to nothing must leave a negative zero as it is
        Ok((number, scale, optional("Offset", -0.0)?))
    }

    /// The name of the binary part, or the listed heights, of which there must be `expected`.
    fn points(&self, root: Node<'_, '_>, expected: usize) -> Result<Points, SurfaceError> {
        let Some(list) = find(root, &["Record3", "DataList"]) else {
            return Ok(Points::Part(self.text(root, &["Record3", "DataLink", "PointDataLink"])?.to_owned()));
        };
        let mut values = Vec::new();
        for datum in list.children().filter(|node| node.has_tag_name_local("Datum")) {
            // coordinates are separated by semicolons, the height comes last; an empty entry is undefined
            let height = datum.text().unwrap_or("").rsplit(';').next().unwrap_or("").trim();
            let value = if height.is_empty() { Some(f64::NAN) } else { height.parse().ok() };
            values.push(value.ok_or_else(|| {
                self.corrupt(format!(
                    "main.xml: datum {} is not a number: {}",
                    values.len(),
                    shortened(height)
                ))
            })?);
        }
        if values.len() == expected {
            Ok(Points::List(values))
        } else {
            Err(self.corrupt(format!("main.xml lists {} heights instead of {expected}", values.len())))
        }
    }
}

/// Name of a part as archives should write it: some have backslashes or a leading one.
fn plain(name: &str) -> String {
    name.replace('\\', "/").trim_start_matches("./").trim_start_matches('/').to_owned()
}

/// Element names regardless of their namespace.
trait LocalName {
    /// Whether the name without its namespace is `name`.
    fn has_tag_name_local(&self, name: &str) -> bool;
}

impl LocalName for Node<'_, '_> {
    fn has_tag_name_local(&self, name: &str) -> bool {
        self.is_element() && self.tag_name().name() == name
    }
}

/// The element reached from `root` by `names`.
fn find<'a, 'input>(root: Node<'a, 'input>, names: &[&str]) -> Option<Node<'a, 'input>> {
    names.iter().try_fold(root, |node, name| node.children().find(|child| child.has_tag_name_local(name)))
}

/// Name of the binary part that is written.
const DATA: &str = "bindata/data.bin";

/// Writes a surface as x3p (ISO 25178-72), 64 bit floats; undefined points are `NaN`, as the standard has it.
///
/// [`super::read`] gives back the same heights, mask and spacing, bit by bit.
///
/// # Errors
/// [`SurfaceError::NoSpacing`] for a surface without spacing, [`SurfaceError::Io`] when the file cannot be
/// written.
///
/// ```
/// use stribeck::surface::{Heights, read, write_x3p};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("surface.x3p");
/// let mask = Some(vec![true, false]);
/// let surface = Heights::new(2, 1, Some([1e-6, 1e-6]), vec![1e-9 / 3.0, 0.0], mask)?;
/// write_x3p(&path, &surface)?;
/// assert_eq!(read(&path)?.heights(), surface.heights());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_x3p(path: impl AsRef<Path>, surface: &Heights) -> Result<(), SurfaceError> {
    let (Some(dx), Some(dy)) = (surface.dx(), surface.dy()) else { return Err(SurfaceError::NoSpacing) };
    let path = path.as_ref();
    write_archive(path, surface, dx, dy).map_err(|source| SurfaceError::Io { path: path.to_owned(), source })
}

/// Description, heights and their checksum.
fn write_archive(path: &Path, surface: &Heights, dx: f64, dy: f64) -> std::io::Result<()> {
    let mut data = Vec::with_capacity(size_of_val(surface.heights()));
    for (k, height) in surface.heights().iter().enumerate() {
        let defined = surface.defined().is_none_or(|mask| mask[k]);
        data.extend(if defined { *height } else { f64::NAN }.to_le_bytes());
    }
    let description = describe(surface, dx, dy, &hexadecimal(&Md5::digest(&data)));
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
fn describe(surface: &Heights, dx: f64, dy: f64, data_sum: &str) -> String {
    let (nx, ny) = (surface.nx(), surface.ny());
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
