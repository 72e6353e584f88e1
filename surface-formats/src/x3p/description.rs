//! `main.xml` of an x3p archive.

use roxmltree::{Document, Node, ParsingOptions};

use crate::error::Error;
use crate::number::{Kind, NumberType};
use crate::source::{Source, shortened};
use crate::surface::MAX_POINTS;

/// Most XML nodes accepted, which bounds the memory of the parsed description.
const MAX_XML_NODES: u32 = 1 << 21;

/// Content of `main.xml`.
pub(super) struct Description {
    /// Points along x.
    pub(super) nx: usize,
    /// Points along y.
    pub(super) ny: usize,
    /// Surfaces one above the other.
    pub(super) layers: usize,
    /// Distances of the points along x and y \[m\].
    pub(super) spacing: [f64; 2],
    /// Type of the stored numbers.
    pub(super) number: NumberType,
    /// Height = offset + scale * stored number.
    pub(super) scale: f64,
    /// Height of a stored zero \[m\].
    pub(super) offset: f64,
    /// Whether floating point heights of an axis of absolute values have an increment all the same.
    pub(super) is_scale_doubtful: bool,
    /// The stored numbers, or where they are.
    pub(super) points: Points,
    /// Name of the part with one bit for each point, set where it is defined.
    pub(super) mask: Option<String>,
}

/// Kind of the measurement.
enum Feature {
    /// Points on a rectangle.
    Surface,
    /// A surface of one row; the step across it is taken as that along it.
    Profile,
}

/// Where the heights are.
pub(super) enum Points {
    /// Name of the binary part.
    Part(String),
    /// Stored in the description itself; `NaN` where undefined.
    List(Vec<f64>),
}

/// The file whose description is read.
pub(super) struct Context<'a> {
    /// Its bytes and its name.
    pub(super) source: Source<'a>,
}

impl Context<'_> {
    /// The checked content of `main.xml`.
    pub(super) fn describe(&self, xml: &str) -> Result<Description, Error> {
        let options = ParsingOptions { nodes_limit: MAX_XML_NODES, ..ParsingOptions::default() };
        let document = Document::parse_with_options(xml, options)
            .map_err(|error| self.source.corrupt(format!("main.xml: {error}")))?;
        let root = document.root_element();
        let feature = self.feature(root)?;
        let (nx, ny) = (self.count(root, "SizeX")?, self.count(root, "SizeY")?);
        let along_x = self.increment(root, "CX")?;
        let spacing = match feature {
            Feature::Surface => [along_x, self.increment(root, "CY")?],
            Feature::Profile if ny == 1 => [along_x, along_x],
            Feature::Profile => return Err(self.source.corrupt(format!("a profile of {ny} rows (SizeY)"))),
        };
        self.source.require_size(nx, ny, Some(spacing))?;
        let layers = match find(root, &["Record3", "MatrixDimension", "SizeZ"]) {
            Some(_) => self.count(root, "SizeZ")?,
            None => 1,
        };
        let fits = layers.checked_mul(nx * ny).is_some_and(|points| layers > 0 && points <= MAX_POINTS);
        if !fits {
            return Err(self.source.corrupt(format!("main.xml: {layers} layers (SizeZ)")));
        }
        let (number, scale, offset) = self.heights_axis(root)?;
        let points = self.points(root, nx * ny * layers)?;
        let mask = find(root, &["Record3", "DataLink", "ValidPointsLink"])
            .and_then(|node| node.text())
            .map(|name| name.trim().to_owned())
            .filter(|name| !name.is_empty());
        let kind = find(root, &["Record1", "Axes", "CZ", "AxisType"]).and_then(|node| node.text());
        let is_scale_doubtful =
            kind.map(str::trim) == Some("A") && number.is_float() && (scale - 1.0).abs() > 0.0;
        Ok(Description { nx, ny, layers, spacing, number, scale, offset, is_scale_doubtful, points, mask })
    }

    /// The kind of the measurement; others than surfaces and profiles are refused.
    fn feature(&self, root: Node<'_, '_>) -> Result<Feature, Error> {
        match self.text(root, &["Record1", "FeatureType"])? {
            "SUR" => Ok(Feature::Surface),
            "PRF" => Ok(Feature::Profile),
            other => {
                let what = format!("feature type {} instead of SUR or PRF", shortened(other));
                Err(self.source.unsupported(what))
            }
        }
    }

    /// The text of the element at the path `names` below the root.
    fn text<'a>(&self, root: Node<'a, '_>, names: &[&str]) -> Result<&'a str, Error> {
        find(root, names)
            .and_then(|node| node.text())
            .map(str::trim)
            .ok_or_else(|| self.source.corrupt(format!("main.xml lacks {}", names.join("/"))))
    }

    /// A count of the matrix of points.
    fn count(&self, root: Node<'_, '_>, name: &str) -> Result<usize, Error> {
        let text = self.text(root, &["Record3", "MatrixDimension", name])?;
        text.parse()
            .map_err(|_| self.source.corrupt(format!("main.xml: {name} is not a count: {}", shortened(text))))
    }

    /// A finite number at the path `names`.
    fn number(&self, root: Node<'_, '_>, names: &[&str]) -> Result<f64, Error> {
        let text = self.text(root, names)?;
        text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| {
            self.source.corrupt(format!("main.xml: {} is not a number: {}", names.join("/"), shortened(text)))
        })
    }

    /// Spacing of a lateral axis \[m\].
    fn increment(&self, root: Node<'_, '_>, axis: &str) -> Result<f64, Error> {
        let kind = self.text(root, &["Record1", "Axes", axis, "AxisType"])?;
        if kind != "I" {
            return Err(self
                .source
                .unsupported(format!("axis {axis} of type {kind} instead of I (equidistant)")));
        }
        self.number(root, &["Record1", "Axes", axis, "Increment"])
    }

    /// Type of the stored heights and their scale and offset.
    fn heights_axis(&self, root: Node<'_, '_>) -> Result<(NumberType, f64, f64), Error> {
        let name = self.text(root, &["Record1", "Axes", "CZ", "DataType"])?;
        let number = match name {
            "I" => NumberType::new(Kind::Signed, 2, false),
            "L" => NumberType::new(Kind::Signed, 4, false),
            "F" => NumberType::new(Kind::Float, 4, false),
            "D" => NumberType::new(Kind::Float, 8, false),
            _ => None,
        };
        let number =
            number.ok_or_else(|| self.source.unsupported(format!("heights of type {}", shortened(name))))?;
        let optional = |name: &str, default: f64| {
            let names = ["Record1", "Axes", "CZ", name];
            match find(root, &names).and_then(|node| node.text()) {
                Some(text) if !text.trim().is_empty() => self.number(root, &names),
                _ => Ok(default),
            }
        };
        // heights that are floats may come with an increment of nothing
        let scale = Some(optional("Increment", 1.0)?).filter(|scale| *scale != 0.0).unwrap_or(1.0);
        // a missing offset is -0: adding it keeps the sign of zero
        Ok((number, scale, optional("Offset", -0.0)?))
    }

    /// The name of the binary part, or the listed heights, of which there must be `expected`.
    fn points(&self, root: Node<'_, '_>, expected: usize) -> Result<Points, Error> {
        let Some(list) = find(root, &["Record3", "DataList"]) else {
            return Ok(Points::Part(self.text(root, &["Record3", "DataLink", "PointDataLink"])?.to_owned()));
        };
        let mut values = Vec::new();
        for datum in list.children().filter(|node| node.has_tag_name_local("Datum")) {
            // coordinates are separated by semicolons, the height comes last; an empty entry is undefined
            let height = datum.text().unwrap_or("").rsplit(';').next().unwrap_or("").trim();
            let value = if height.is_empty() { Some(f64::NAN) } else { height.parse().ok() };
            values.push(value.ok_or_else(|| {
                self.source.corrupt(format!(
                    "main.xml: datum {} is not a number: {}",
                    values.len(),
                    shortened(height)
                ))
            })?);
        }
        if values.len() == expected {
            Ok(Points::List(values))
        } else {
            Err(self.source.corrupt(format!("main.xml lists {} heights instead of {expected}", values.len())))
        }
    }
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
