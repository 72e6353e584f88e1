//! Fields of contacts for the scripts of a report: cut down to the cells of a screen, two bytes a value.

use serde_json::{Value, json};
use stribeck::Grid;

use crate::picture::{Maps, inner};

/// Most cells along a side of the fields of one contact, and of one of many.
const CELLS: [usize; 2] = [256, 64];
/// Most bytes of all fields as text.
const BYTES: usize = 3_000_000;
/// Code of a value that is not finite.
const MISSING: u16 = u16::MAX;

/// Contacts whose fields are kept: all of them, or evenly spread ones where all would be too large, and the last one.
pub(crate) struct Fields {
    /// Most cells along a side.
    cells: usize,
    frames: Vec<(usize, Value)>,
    last: Option<Value>,
    seen: usize,
    /// Contacts between two that are kept; it doubles when they are too many.
    every: usize,
    /// Places, maps and their largest values.
    head: Option<Value>,
    highest: Vec<f64>,
}

impl Fields {
    /// Fields of one contact.
    pub(crate) fn of(maps: &Maps<'_>, label: &str) -> Self {
        let mut fields = Self { cells: CELLS[0], ..Self::many() };
        fields.keep(maps, label);
        fields
    }

    /// Fields of many contacts.
    pub(crate) fn many() -> Self {
        let (frames, highest) = (Vec::new(), Vec::new());
        Self { cells: CELLS[1], frames, last: None, seen: 0, every: 1, head: None, highest }
    }

    /// Keeps the contact of `maps`, if it is one of those to keep.
    pub(crate) fn keep(&mut self, maps: &Maps<'_>, label: &str) {
        let places = Places::new(&maps.grid, self.cells);
        let fields = maps.maps.iter().map(|map| places.coded(&map.values, map.factor));
        let frame = json!({"label": label, "fields": fields.collect::<Vec<_>>()});
        self.highest.resize(maps.maps.len(), 0.0);
        for (highest, map) in self.highest.iter_mut().zip(&maps.maps) {
            *highest = highest.max(map.range.1);
        }
        self.head = Some(head(maps, &places));
        if self.seen.is_multiple_of(self.every) {
            self.frames.push((self.seen, frame.clone()));
            let bytes = places.columns.len() * places.rows.len() * 8 / 3 * maps.maps.len().max(1);
            if self.frames.len() * bytes > BYTES {
                self.every *= 2;
                self.frames.retain(|(number, _)| number.is_multiple_of(self.every));
            }
        }
        self.last = Some(frame);
        self.seen += 1;
    }

    /// Null without any contact.
    pub(super) fn to_json(&self) -> Option<Value> {
        let mut json = self.head.clone()?;
        let is_last_kept = self.frames.last().is_some_and(|(number, _)| number + 1 == self.seen);
        let last = self.last.iter().filter(|_| !is_last_kept).cloned();
        json["frames"] = self.frames.iter().map(|(_, frame)| frame.clone()).chain(last).collect();
        for (map, highest) in json["maps"].as_array_mut()?.iter_mut().zip(&self.highest) {
            map["high"] = (*highest).into();
        }
        Some(json)
    }
}

/// The nodes that are shown: those within the rim, or every second, third, ... of them.
struct Places {
    columns: Vec<usize>,
    rows: Vec<usize>,
    nx: usize,
}

impl Places {
    fn new(grid: &Grid, cells: usize) -> Self {
        let spread = |n: usize| inner(n).step_by(n.div_ceil(cells).max(1)).collect();
        Self { columns: spread(grid.nx()), rows: spread(grid.ny()), nx: grid.nx() }
    }

    /// The values, times `factor`, as base64 of numbers of two bytes between the lowest and the highest.
    fn coded(&self, values: &[f64], factor: f64) -> Value {
        let nodes = self.rows.iter().flat_map(|j| self.columns.iter().map(move |i| j * self.nx + i));
        let shown: Vec<f64> =
            nodes.map(|node| values.get(node).map_or(f64::NAN, |value| factor * value)).collect();
        let (low, high) = crate::picture::extremes(shown.iter().copied());
        let step = (high - low) / f64::from(MISSING - 1);
        let code = |value: &f64| match value {
            value if !value.is_finite() => MISSING,
            value if step > 0.0 => ((value - low) / step).round() as u16,
            _ => 0,
        };
        let bytes: Vec<u8> = shown.iter().flat_map(|value| code(value).to_le_bytes()).collect();
        json!({"low": low, "high": high, "data": base64(&bytes)})
    }
}

/// Lengths in micrometres; the first cell begins at `x`, `y`.
fn head(maps: &Maps<'_>, places: &Places) -> Value {
    let (grid, hertz) = (&maps.grid, &maps.hertz);
    let first = |places: &[usize]| places.first().copied().unwrap_or(0);
    let step = |places: &[usize]| places.windows(2).next().map_or(1, |pair| pair[1] - pair[0]) as f64;
    let shown = maps.maps.iter().map(|map| {
        let (_, unit) = map.title.split_once('(').unwrap_or(("", ""));
        let unit = unit.split_once(')').map_or("", |(unit, _)| unit);
        let (title, _) = map.title.split_once(',').filter(|_| !unit.is_empty()).unwrap_or((&map.title, ""));
        json!({"title": title, "unit": unit, "outline": map.outline})
    });
    let width_y = (!grid.is_strip()).then_some(1e6 * hertz.half_width_y);
    json!({
        "title": maps.title,
        "nx": places.columns.len(),
        "ny": places.rows.len(),
        "x": 1e6 * (grid.x(first(&places.columns)) - 0.5 * grid.dx()),
        "y": 1e6 * (grid.y(first(&places.rows)) - 0.5 * grid.dy()),
        "dx": 1e6 * grid.dx() * step(&places.columns),
        "dy": 1e6 * grid.dy() * step(&places.rows),
        "outline": json!([1e6 * hertz.half_width_x, width_y, hertz.angle]),
        "maps": shown.collect::<Vec<_>>(),
    })
}

/// Bytes as text by RFC 4648.
pub(super) fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |k: usize| u32::from(group.get(k).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for k in 0..4 {
            let letter = LETTERS.get((bits >> (18 - 6 * k) & 63) as usize).copied().unwrap_or(b'=');
            text.push(if k <= group.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use stribeck::Grid;
    use stribeck::sim::Scene;

    use super::{Fields, base64};
    use crate::picture::{Map, Maps};

    /// 720 contacts with four maps of 128 x 128 nodes.
    #[test]
    fn fields_of_long_histories_stay_below_four_megabytes() {
        let grid = Grid::centred(128, 128, 1e-6, 1e-6).unwrap();
        let values: Vec<f64> = (0..grid.len()).map(|node| (node as f64).sin()).collect();
        let scene =
            Scene::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/scenes/smooth.toml")).unwrap();
        let hertz = scene.hertz().unwrap();
        let map = || Map {
            title: "film (nm)".to_owned(),
            values: values.as_slice().into(),
            factor: 1.0,
            range: (0.0, 1.0),
            outline: true,
        };
        let maps = Maps { title: String::new(), grid, hertz, maps: vec![map(), map(), map(), map()] };
        let mut fields = Fields::many();
        (0..720).for_each(|step| fields.keep(&maps, &format!("{step}")));
        let json = fields.to_json().unwrap();
        let frames = json["frames"].as_array().unwrap();
        assert_eq!((&frames[0]["label"], &frames[frames.len() - 1]["label"]), (&"0".into(), &"719".into()));
        assert!(frames.len() > 30 && json.to_string().len() < 4_000_000, "{} frames", frames.len());
    }

    /// Test vectors of RFC 4648, section 10.
    #[test]
    fn base64_is_that_of_the_standard() {
        let words: Vec<&[u8]> = (0..=6).map(|length| &b"foobar"[..length]).collect();
        let texts = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        let coded: Vec<String> = words.into_iter().map(base64).collect();
        assert_eq!(coded, texts);
    }
}
