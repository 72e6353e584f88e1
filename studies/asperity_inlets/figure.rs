//! The figure: load ratios of asperity inlets over those resolved, and errors over seconds.

use std::error::Error;
use std::path::Path;

use plotters::prelude::*;

use super::{METHODS, Method, Row};

const SIZE: (u32, u32) = (1000, 470);
const INK: f64 = 0.12;
/// Blue for isotropic surfaces, vermilion for those with a lay.
const ISOTROPIC: RGBColor = RGBColor(0, 114, 178);
const LAY: RGBColor = RGBColor(213, 94, 0);

pub(crate) fn draw(path: &Path, rows: &[Row]) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(SIZE.0 as i32 / 2);
    let font = |size: u32| ("sans-serif", size).into_font();

    let mut chart = ChartBuilder::on(&left)
        .caption("load ratio (blue: isotropic, vermilion: with a lay)", font(16))
        .margin(10)
        .x_label_area_size(44)
        .y_label_area_size(60)
        .build_cartesian_2d(0.0..1.0, 0.0..1.0)?;
    chart
        .configure_mesh()
        .x_desc("resolved, cells of 0.24 um")
        .y_desc("asperity inlets, cells of 0.49 um")
        .label_style(font(15))
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(INK))
        .draw()?;
    chart.draw_series(LineSeries::new([(0.0, 0.0), (1.0, 1.0)], BLACK.mix(0.4)))?;
    let points = rows.iter().filter(|row| row.errors(1).is_some());
    chart.draw_series(points.map(|row| {
        let colour = if row.surface.has_lay() { LAY } else { ISOTROPIC };
        Circle::new((row.found[0].load_ratio, row.found[1].load_ratio), 4, colour.filled())
    }))?;

    let mut chart = ChartBuilder::on(&right)
        .caption("error over cost, isotropic surfaces", font(16))
        .margin(10)
        .x_label_area_size(44)
        .y_label_area_size(60)
        .build_cartesian_2d((0.02..20.0).log_scale(), 0.0..0.1)?;
    chart
        .configure_mesh()
        .x_desc("seconds of a contact")
        .y_desc("mean error of the load ratio")
        .label_style(font(15))
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(INK))
        .draw()?;
    for (k, (method, cells)) in METHODS.into_iter().enumerate().skip(1) {
        let of: Vec<&Row> = rows
            .iter()
            .filter(|row| !row.surface.has_lay() && !row.is_by_lambda && row.errors(k).is_some())
            .collect();
        if of.is_empty() {
            continue;
        }
        let mean =
            |value: &dyn Fn(&Row) -> f64| of.iter().map(|row| value(row)).sum::<f64>() / of.len() as f64;
        let error = mean(&|row| row.errors(k).map_or(0.0, |error| error[0].abs()));
        let seconds = mean(&|row| row.found[k].seconds);
        let colour = if method == Method::Inlets { ISOTROPIC } else { BLACK };
        chart.draw_series([Circle::new((seconds, error), 5, colour.filled())])?;
        // The label of the law on coarse cells lies below its point, the others above.
        let (name, offset) = match method {
            Method::Inlets if cells < 256 => (format!("inlets {cells}"), -0.003),
            Method::Inlets => (format!("inlets {cells}"), 0.006),
            Method::Resolved => (format!("resolved {cells}"), 0.006),
        };
        chart.draw_series([Text::new(name, (seconds, error + offset), font(14).color(&colour))])?;
    }
    root.present()?;
    Ok(())
}
