//! Pictures: each drawn twice, as SVG and as PNG. Letters come from a font in the program.

mod curves;
mod lines;
mod maps;
mod page;

use std::error::Error;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Once;

use image::codecs::png::PngEncoder;
use image::{ColorType, ImageEncoder};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};

pub(crate) use lines::{Chart, Line, Panel, Scale, UpperAxis};
pub(crate) use maps::{Map, Maps};
pub(crate) use page::Page;

/// Blue, vermilion and green of the palette of Okabe and Ito: distinct with all kinds of colour vision.
pub(crate) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(crate) const VERMILION: RGBColor = RGBColor(213, 94, 0);
pub(crate) const GREEN: RGBColor = RGBColor(0, 158, 115);
/// Dark violet to yellow over blue and green, even in lightness.
const SCALE: [[f64; 3]; 5] =
    [[68.0, 1.0, 84.0], [59.0, 82.0, 139.0], [33.0, 145.0, 140.0], [94.0, 201.0, 98.0], [253.0, 231.0, 37.0]];

const FONT: &[u8] = include_bytes!("../../font/DejaVuSans-subset.ttf");
const TITLE_SIZE: u32 = 19;
const TEXT_SIZE: u32 = 15;

type Drawn = Result<(), Box<dyn Error>>;

/// Something that can be drawn on any canvas.
pub(crate) trait Picture {
    /// Width and height in pixels.
    fn size(&self) -> (u32, u32);

    fn draw<B: DrawingBackend>(&self, canvas: &DrawingArea<B, Shift>) -> Drawn
    where
        B::ErrorType: 'static;
}

/// The files of the picture `name` in `folder`.
pub(crate) fn files(folder: &Path, name: &str) -> [PathBuf; 2] {
    ["svg", "png"].map(|kind| folder.join(format!("{name}.{kind}")))
}

/// Writes `picture` into `folder` as `name.svg` and `name.png`.
pub(crate) fn write(
    picture: &impl Picture,
    folder: &Path,
    name: &str,
) -> Result<[PathBuf; 2], Box<dyn Error>> {
    let files = files(folder, name);
    crate::files::write(&files[0], svg(picture)?.as_bytes())?;
    crate::files::write(&files[1], &png(picture)?)?;
    Ok(files)
}

/// The text of the drawing.
pub(crate) fn svg(picture: &impl Picture) -> Result<String, Box<dyn Error>> {
    let mut drawing = String::new();
    whole(picture, SVGBackend::with_string(&mut drawing, picture.size()))?;
    Ok(drawing)
}

/// The bytes of the PNG file.
pub(crate) fn png(picture: &impl Picture) -> Result<Vec<u8>, Box<dyn Error>> {
    let (width, height) = picture.size();
    let mut pixels = vec![0; 3 * width as usize * height as usize];
    whole(picture, BitMapBackend::with_buffer(&mut pixels, (width, height)))?;
    let mut encoded = Vec::new();
    PngEncoder::new(&mut encoded).write_image(&pixels, width, height, ColorType::Rgb8)?;
    Ok(encoded)
}

fn whole<B: DrawingBackend>(picture: &impl Picture, backend: B) -> Drawn
where
    B::ErrorType: 'static,
{
    static FONT_IS_KNOWN: Once = Once::new();
    let mut fonts = Ok(());
    FONT_IS_KNOWN.call_once(|| fonts = register_font("sans-serif", FontStyle::Normal, FONT));
    fonts.map_err(|_| "the font in the program is damaged")?;
    let canvas = backend.into_drawing_area();
    canvas.fill(&WHITE)?;
    picture.draw(&canvas)?;
    canvas.present()?;
    Ok(())
}

/// The colour of a share of the scale, 0 to 1.
fn colour(share: f64) -> RGBColor {
    let position = if share.is_finite() { share.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64 } else { 0.0 };
    let low = (position as usize).min(SCALE.len() - 2);
    let part = position - low as f64;
    let channel = |k: usize| ((1.0 - part) * SCALE[low][k] + part * SCALE[low + 1][k]).round() as u8;
    RGBColor(channel(0), channel(1), channel(2))
}

fn text(size: u32) -> TextStyle<'static> {
    ("sans-serif", size).into_font().color(&BLACK)
}

/// Smallest and largest finite value; zeros without any.
pub(crate) fn extremes(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let finite = values.into_iter().filter(|value| value.is_finite());
    finite
        .fold(None, |found, v| found.map_or(Some((v, v)), |(l, h): (f64, f64)| Some((l.min(v), h.max(v)))))
        .unwrap_or((0.0, 0.0))
}

/// The places along a side of `n` nodes without its ends, whose values are those of the boundary condition.
pub(crate) fn inner(n: usize) -> Range<usize> {
    if n > 2 { 1..n - 1 } else { 0..n }
}

/// Digits of tick labels that tell them apart over `range`.
fn tick(range: &Range<f64>) -> impl Fn(&f64) -> String + use<> {
    let (width, largest) = (range.end - range.start, range.start.abs().max(range.end.abs()));
    let decimals = (1.0 - width.log10()).ceil().clamp(0.0, 9.0) as usize;
    let powers = largest >= 1e6 || width < 1e-4;
    move |value| if powers { format!("{value:.1e}") } else { format!("{value:.decimals$}") }
}

/// Words in place of a panel.
fn note<B: DrawingBackend>(area: &DrawingArea<B, Shift>, words: &str) -> Drawn
where
    B::ErrorType: 'static,
{
    area.draw(&Text::new(words.to_owned(), (60, 60), text(TEXT_SIZE)))?;
    Ok(())
}
