//! XYZ exports of Zygo's `MetroPro`.
//!
//! A header up to a line `#`, then column, row and height in micrometres of each pixel, with `No Data` for
//! undefined points, up to another `#`. The distance of the pixels in metres is the seventh number of the eighth
//! line of the header, zero where it is not known.

use super::style::Line;
use crate::error::Error;
use crate::source::{Source, shortened};
use crate::surface::{MAX_POINTS, Surface};
use crate::text::number::parse_height;
use crate::unit::LengthUnit;

/// Beginning of the first line.
pub(super) const MAGIC: &str = "Zygo XYZ Data File";
/// Line and number of the distance of the pixels.
const RESOLUTION: (usize, usize) = (7, 6);
/// Nodes of the raster for each point that is given, at most.
const SPARSEST: usize = 100;

/// Heights of the pixels.
pub(super) fn read(source: Source<'_>, lines: &[Line<'_>]) -> Result<Surface, Error> {
    let start = lines.iter().position(|(_, line)| line.trim() == "#");
    let start = start.ok_or_else(|| source.corrupt("the header is not closed by #".to_owned()))?;
    let resolution = lines.get(RESOLUTION.0).and_then(|(_, line)| line.split_whitespace().nth(RESOLUTION.1));
    let resolution = resolution.and_then(parse_height).filter(|distance| *distance > 0.0);
    let mut points: Vec<([usize; 2], f64)> = Vec::new();
    let rows = lines[start + 1..].iter().take_while(|(_, line)| line.trim() != "#");
    for (number, line) in rows.filter(|(_, line)| !line.trim().is_empty()) {
        let wrong =
            || source.corrupt(format!("line {number}: \"{}\" is no pixel and height", shortened(line)));
        let mut words = line.split_whitespace();
        let mut pixel = || words.next().and_then(|word| word.parse::<usize>().ok()).ok_or_else(wrong);
        let place = [pixel()?, pixel()?];
        let height = parse_height(&words.collect::<Vec<_>>().join(" ")).ok_or_else(wrong)?;
        if points.len() == MAX_POINTS || place.iter().any(|index| *index >= MAX_POINTS) {
            return Err(wrong());
        }
        points.push((place, height));
    }
    let first = [0, 1].map(|k| points.iter().map(|(place, _)| place[k]).min().unwrap_or(0));
    let last = [0, 1].map(|k| points.iter().map(|(place, _)| place[k]).max().unwrap_or(0));
    let [nx, ny] = [0, 1].map(|k| last[k] - first[k] + 1);
    if points.is_empty() || nx.saturating_mul(ny) > SPARSEST * points.len() {
        return Err(source.corrupt(format!("{} of {nx} x {ny} pixels are given", points.len())));
    }
    let spacing = resolution.map(|distance| [distance; 2]);
    source.require_size(nx, ny, spacing)?;
    let mut values = vec![f64::NAN; nx * ny];
    for ([x, y], height) in points {
        values[(y - first[1]) * nx + x - first[0]] = height;
    }
    let unit = LengthUnit::Micrometre;
    let heights = source.scaled(nx, values, -0.0, unit.metres())?;
    let surface = Surface { unit: Some(unit), ..Surface::new(nx, ny, heights) };
    source.finish(surface.with_spacing(spacing))
}
