//! The figure, of the first surface: a column of panels for each scene, load ratio, area ratio and friction
//! over the size of the cells, at all speeds.

use std::error::Error;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use stribeck::reynolds::Cavitation;

use super::limits::{limit, mean, size};
use super::plan::{CELLS, Case, LAWS, Law, MINIATURES, SEEDS, cases};
use super::run::Row;

const SIZE: (u32, u32) = (960, 900);
const HEAD: i32 = 70;
/// Which of the four numbers, its name, the top of its axis.
const QUANTITIES: [(usize, &str, f64); 3] =
    [(1, "load ratio", 1.05), (0, "area ratio", 0.62), (3, "friction coefficient", 0.13)];

/// Colours of the palette of Okabe and Ito.
fn pen(law: Law) -> (RGBColor, &'static str) {
    match law {
        Law::Wedge => (RGBColor(0, 0, 0), "wedge"),
        Law::Inlet => (RGBColor(213, 94, 0), "inlet"),
        Law::Means => (RGBColor(0, 114, 178), "means of cubes"),
    }
}

fn font(size: u32) -> FontDesc<'static> {
    ("sans-serif", size).into_font()
}

pub(crate) fn draw(rows: &[Row], path: &Path) -> Result<(), Box<dyn Error>> {
    let rows: Vec<Row> = rows.iter().filter(|row| row.run.seed == SEEDS[0]).cloned().collect();
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(HEAD);
    for (k, law) in LAWS.into_iter().enumerate() {
        let x = 70 + 170 * k as i32;
        let (colour, name) = pen(law);
        head.draw(&PathElement::new(vec![(x, 22), (x + 28, 22)], colour.stroke_width(3)))?;
        head.draw(&Text::new(name, (x + 36, 13), font(18)))?;
    }
    head.draw(&Rectangle::new([(580, 15), (608, 29)], BLACK.mix(0.18).filled()))?;
    head.draw(&Text::new("limit and its spread", (616, 13), font(18)))?;
    for (k, miniature) in MINIATURES.iter().enumerate() {
        let speeds: Vec<String> = miniature.speeds.iter().map(f64::to_string).collect();
        let title = format!("{}: {} m/s", miniature.name, speeds.join(", "));
        head.draw(&Text::new(title, (80 + 318 * k as i32, 48), font(17)))?;
    }
    for (k, areas) in
        body.split_evenly((QUANTITIES.len(), MINIATURES.len())).chunks(MINIATURES.len()).enumerate()
    {
        for (area, miniature) in areas.iter().zip(MINIATURES) {
            let of =
                |case: &Case| case.miniature == miniature && case.cavitation.0 == Cavitation::MassConserving;
            let cases: Vec<Case> = cases().into_iter().filter(of).collect();
            panel(area, k, &cases, &rows)?;
        }
    }
    root.present()?;
    Ok(())
}

/// Quantity `k` of the cases of one scene.
fn panel(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    k: usize,
    cases: &[Case],
    rows: &[Row],
) -> Result<(), Box<dyn Error>> {
    let (quantity, name, top) = QUANTITIES[k];
    let bottom = k + 1 == QUANTITIES.len();
    let sizes: Vec<f64> = CELLS.iter().map(|cells| size(*cells)).collect();
    let (finest, coarsest) = (0.8 * sizes[sizes.len() - 1], 1.25 * sizes[0]);
    let mut chart = ChartBuilder::on(area)
        .margin(6)
        .margin_right(12)
        .x_label_area_size(if bottom { 50 } else { 26 })
        .y_label_area_size(60)
        .build_cartesian_2d((finest..coarsest).log_scale().with_key_points(sizes.clone()), 0.0..top)?;
    chart
        .configure_mesh()
        .x_desc(if bottom { "cells / um" } else { "" })
        .y_desc(name)
        .x_labels(sizes.len())
        .y_labels(6)
        .label_style(font(15))
        .axis_desc_style(font(17))
        .x_label_formatter(&|x| format!("{x:.2}"))
        .y_label_formatter(&|y| if top < 0.2 { format!("{y:.2}") } else { format!("{y:.1}") })
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .draw()?;
    for case in cases {
        let Some(limit) = limit(case, rows) else { continue };
        let (value, spread) = (limit.values[quantity], limit.spreads[quantity].max(0.004 * top));
        let band = [(finest, (value - spread).max(0.0)), (coarsest, (value + spread).min(top))];
        chart.draw_series([Rectangle::new(band, BLACK.mix(0.18).filled())])?;
        for law in LAWS {
            let points: Vec<(f64, f64)> = CELLS
                .iter()
                .filter_map(|cells| Some((size(*cells), mean(case, &limit, rows, law, *cells)?[quantity])))
                .collect();
            let (colour, _) = pen(law);
            chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)))?;
            chart.draw_series(points.iter().map(|point| Circle::new(*point, 3, colour.filled())))?;
        }
    }
    Ok(())
}
