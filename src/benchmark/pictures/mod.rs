//! Pictures of results, as SVG.

mod axes;
mod map;
mod precision;
mod profile;
mod svg;

pub(super) use axes::{Axes, Line};
pub(super) use svg::{Anchor, Svg};

/// Colours of contestants: the palette of Okabe and Ito, which is legible with all kinds of colour vision.
const COLOURS: [&str; 8] =
    ["#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#999999"];

/// The colour of contestant `k`.
pub(super) fn colour(k: usize) -> &'static str {
    COLOURS[k % COLOURS.len()]
}

/// Height of the legend of so many names \[pixels\].
pub(super) fn legend_height(count: usize) -> f64 {
    16.0 + 20.0 * count as f64
}

/// Draws a legend of the contestants from the upper left corner.
pub(super) fn draw_legend(svg: &mut Svg, names: &[&str]) {
    for (k, name) in names.iter().enumerate() {
        let y = 16.0 + 20.0 * k as f64;
        svg.line(&[(20.0, y), (48.0, y)], colour(k), 3.0, false);
        svg.text((56.0, y + 5.0), 14.0, Anchor::Start, name);
    }
}
