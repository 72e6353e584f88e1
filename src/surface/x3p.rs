//! The x3p container (ISO 25178-72): a zip archive with a description in XML and the heights in binary form.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use roxmltree::{Document, Node, ParsingOptions};
use zip::ZipArchive;

use super::error::SurfaceError;
use super::measured::Heights;
use super::number::{Kind, NumberType};
use crate::grid::Grid;

/// Longest description accepted \[bytes\]; one with the heights as a list of text is long.
const MAX_XML: u64 = 1 << 24;
/// Most XML nodes accepted, which bounds the memory of the parsed description.
const MAX_XML_NODES: u32 = 1 << 21;

/// What `main.xml` says.
struct Description {
    nx: usize,
    ny: usize,
    spacing: [f64; 2],
    number: NumberType,
    /// Height = offset + scale * stored number.
    scale: f64,
    offset: f64,
    points: Points,
}

/// Where the heights are.
enum Points {
    /// Name of the binary part.
    Part(String),
    /// Stored in the description itself; `NaN` where undefined.
    List(Vec<f64>),
}

pub(super) fn read(path: &Path, file: File) -> Result<Heights, SurfaceError> {
    let context = Context { path };
    let mut archive = ZipArchive::new(BufReader::new(file))
        .map_err(|error| context.corrupt(format!("zip archive: {error}")))?;
    if archive.index_for_name("main.xml").is_none() {
        return Err(SurfaceError::UnknownFormat { path: path.to_owned() });
    }
    let xml = context.part(&mut archive, "main.xml", MAX_XML)?;
    let xml = String::from_utf8(xml).map_err(|_| context.corrupt("main.xml is not UTF-8 text".to_owned()))?;
    let Description { nx, ny, spacing, number, scale, offset, points } = context.describe(&xml)?;
    let stored = match points {
        Points::List(values) => values,
        Points::Part(name) => {
            let expected = (nx * ny * number.size()) as u64;
            let bytes = context.part(&mut archive, &name, expected)?;
            if bytes.len() as u64 != expected {
                let found = bytes.len();
                return Err(context
                    .corrupt(format!("{name} holds {found} bytes, {nx} x {ny} points need {expected}")));
            }
            number.decode(&bytes)
        }
    };
    let defined: Vec<bool> = stored.iter().map(|value| !value.is_nan()).collect();
    let heights: Vec<f64> = stored.iter().map(|value| offset + scale * value).collect();
    if let Some(k) = (0..heights.len()).find(|&k| heights[k].is_infinite()) {
        let (column, row, value) = (k % nx, k / nx, heights[k]);
        return Err(SurfaceError::NotFinite { path: path.to_owned(), column, row, value });
    }
    Heights::new(nx, ny, Some(spacing), heights, Some(defined))
}

/// The file being read, for errors.
struct Context<'a> {
    path: &'a Path,
}

impl Context<'_> {
    fn corrupt(&self, what: String) -> SurfaceError {
        SurfaceError::Corrupt { path: self.path.to_owned(), what }
    }

    fn unsupported(&self, what: String) -> SurfaceError {
        SurfaceError::Unsupported { path: self.path.to_owned(), what }
    }

    /// The content of a part, refused when longer than `limit`.
    fn part(
        &self,
        archive: &mut ZipArchive<BufReader<File>>,
        name: &str,
        limit: u64,
    ) -> Result<Vec<u8>, SurfaceError> {
        let part = archive.by_name(name).map_err(|error| self.corrupt(format!("part {name}: {error}")))?;
        let mut bytes = Vec::new();
        part.take(limit + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| self.corrupt(format!("part {name}: {error}")))?;
        if bytes.len() as u64 > limit {
            return Err(self.corrupt(format!("part {name} holds more than the expected {limit} bytes")));
        }
        Ok(bytes)
    }

    fn describe(&self, xml: &str) -> Result<Description, SurfaceError> {
        let options = ParsingOptions { nodes_limit: MAX_XML_NODES, ..ParsingOptions::default() };
        let document = Document::parse_with_options(xml, options)
            .map_err(|error| self.corrupt(format!("main.xml: {error}")))?;
        let root = document.root_element();
        self.require_surface(root)?;
        let (nx, ny) = (self.count(root, "SizeX")?, self.count(root, "SizeY")?);
        let spacing = [self.increment(root, "CX")?, self.increment(root, "CY")?];
        Grid::centred(nx, ny, spacing[0], spacing[1])
            .map_err(|error| self.corrupt(format!("main.xml: {nx} x {ny} points: {error}")))?;
        let (number, scale, offset) = self.heights_axis(root)?;
        let points = self.points(root, nx * ny)?;
        Ok(Description { nx, ny, spacing, number, scale, offset, points })
    }

    /// Refuses what is not a single areal surface with all points in one matrix.
    fn require_surface(&self, root: Node<'_, '_>) -> Result<(), SurfaceError> {
        let feature = self.text(root, &["Record1", "FeatureType"])?;
        if feature != "SUR" {
            return Err(self.unsupported(format!("feature type {feature} instead of SUR")));
        }
        if let Some(layers) = find(root, &["Record3", "MatrixDimension", "SizeZ"])
            && layers.text().map(str::trim) != Some("1")
        {
            return Err(self.unsupported("more than one layer (SizeZ)".to_owned()));
        }
        if find(root, &["Record3", "DataLink", "ValidPointsLink"]).is_some() {
            return Err(self.unsupported("a separate mask of valid points (ValidPointsLink)".to_owned()));
        }
        Ok(())
    }

    fn text<'a>(&self, root: Node<'a, '_>, names: &[&str]) -> Result<&'a str, SurfaceError> {
        find(root, names)
            .and_then(|node| node.text())
            .map(str::trim)
            .ok_or_else(|| self.corrupt(format!("main.xml lacks {}", names.join("/"))))
    }

    fn count(&self, root: Node<'_, '_>, name: &str) -> Result<usize, SurfaceError> {
        let text = self.text(root, &["Record3", "MatrixDimension", name])?;
        text.parse()
            .map_err(|_| self.corrupt(format!("main.xml: {name} is not a count: {}", shortened(text))))
    }

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

    /// Type of the stored heights and their scale and offset, which count for integers only.
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
            if number.kind() == Kind::Signed && find(root, &names).is_some() {
                self.number(root, &names)
            } else {
                Ok(default)
            }
        };
        Ok((number, optional("Increment", 1.0)?, optional("Offset", 0.0)?))
    }

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

/// Element names regardless of their namespace.
trait LocalName {
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

/// The start of a text for an error message.
fn shortened(text: &str) -> String {
    text.chars().take(32).collect()
}
