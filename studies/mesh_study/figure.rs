//! The figure, of the first surface: a row of panels for each quantity, over the cells on the left, over the
//! contact film on the right.

use std::error::Error;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::contact::Row;
use crate::plan::{CELLS, CONTACTS, CUTOFF, CUTOFFS, Contact, MESH};
use crate::summary::{Choice, Mean, first, mean};

const SIZE: (u32, u32) = (960, 1060);
const HEAD: i32 = 92;
/// Names of the quantities, the factor to their unit, the top of their axis.
const QUANTITIES: [(&str, f64, f64); 4] = [
    ("area ratio", 1.0, 1.05),
    ("load ratio", 1.0, 1.05),
    ("mean film / nm", 1e9, 70.0),
    ("friction coefficient", 1.0, 0.14),
];

/// Colours of the palette of Okabe and Ito.
fn pen(contact: Contact) -> (RGBColor, &'static str) {
    match contact {
        Contact::Inlet => (RGBColor(213, 94, 0), "inlet, mass conserved"),
        Contact::Means => (RGBColor(0, 114, 178), "means, Reynolds"),
        Contact::Paper => (RGBColor(230, 159, 0), "paper as published"),
        Contact::Dry => (RGBColor(0, 158, 115), "dry"),
    }
}

fn font(size: u32) -> FontDesc<'static> {
    ("sans-serif", size).into_font()
}

pub(crate) fn draw(rows: &[Row], path: &Path) -> Result<(), Box<dyn Error>> {
    let rows = first(rows);
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(HEAD);
    for (k, contact) in CONTACTS.into_iter().enumerate() {
        let (x, y) = (24 + 240 * (k as i32 / 2), 22 + 26 * (k as i32 % 2));
        let (colour, name) = pen(contact);
        head.draw(&PathElement::new(vec![(x, y), (x + 28, y)], colour.stroke_width(3)))?;
        head.draw(&Text::new(name, (x + 34, y - 9), font(18)))?;
    }
    for (y, full, name) in [(22, true, "converged"), (48, false, "not converged")] {
        let fill = if full { BLACK.filled() } else { BLACK.stroke_width(1) };
        head.draw(&Circle::new((760, y), 4, fill))?;
        head.draw(&Text::new(name, (772, y - 9), font(18)))?;
    }
    head.draw(&Text::new("mesh, contact film 1 nm", (190, 70), font(19)))?;
    head.draw(&Text::new(format!("contact film, {MESH} cells"), (670, 70), font(19)))?;
    let finest = rows.iter().map(|row| row.job.cells).max().unwrap_or(CELLS[0]);
    let grids: Vec<f64> = CELLS.iter().filter(|cells| **cells <= finest).map(|cells| *cells as f64).collect();
    let films: Vec<f64> = CUTOFFS.iter().map(|cutoff| 1e9 * cutoff).collect();
    for (k, areas) in body.split_evenly((QUANTITIES.len(), 2)).chunks(2).enumerate() {
        let [left, right] = areas else { continue };
        panel(left, k, &grids, "cells along each side", &|contact, x| {
            mean(&rows, Choice::reference(contact, CELLS[x]))
        })?;
        panel(right, k, &films, "contact film / nm", &|contact, x| {
            // A dry contact has no contact film: a line across.
            let cutoff = if contact == Contact::Dry { CUTOFF } else { CUTOFFS[x] };
            mean(&rows, Choice { cutoff, ..Choice::reference(contact, MESH) })
        })?;
    }
    root.present()?;
    Ok(())
}

/// Quantity `k` of all contacts over the positions of `ticks`, which stand in equal or logarithmic distances.
fn panel(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    k: usize,
    ticks: &[f64],
    x_label: &str,
    at: &dyn Fn(Contact, usize) -> Option<Mean>,
) -> Result<(), Box<dyn Error>> {
    let (name, factor, top) = QUANTITIES[k];
    let (first, last) = (ticks[0], ticks[ticks.len() - 1]);
    let mut chart = ChartBuilder::on(area)
        .margin(6)
        .margin_right(20)
        .x_label_area_size(if k + 1 == QUANTITIES.len() { 50 } else { 26 })
        .y_label_area_size(66)
        .build_cartesian_2d(
            ((0.87 * first)..(1.15 * last)).log_scale().with_key_points(ticks.to_vec()),
            0.0..top,
        )?;
    chart
        .configure_mesh()
        .x_desc(if k + 1 == QUANTITIES.len() { x_label } else { "" })
        .y_desc(name)
        .x_labels(ticks.len())
        .y_labels(5)
        .label_style(font(16))
        .axis_desc_style(font(18))
        .x_label_formatter(&|x| format!("{x}"))
        .y_label_formatter(&|y| if top > 2.0 { format!("{y:.0}") } else { format!("{y:.2}") })
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .draw()?;
    for contact in CONTACTS.into_iter().rev() {
        let (colour, _) = pen(contact);
        let points: Vec<(f64, f64, bool)> = ticks
            .iter()
            .enumerate()
            .filter_map(|(i, x)| {
                let mean = at(contact, i)?;
                // What is off the axis, as films far below zero are, is drawn at its edge.
                let y = (factor * mean.values[k]).clamp(0.0, top);
                y.is_finite().then_some((*x, y, mean.converged > 0))
            })
            .collect();
        let line = points.iter().map(|(x, y, _)| (*x, *y));
        if points.iter().all(|point| point.2) {
            chart.draw_series(LineSeries::new(line, colour.stroke_width(2)))?;
        } else {
            chart.draw_series(DashedLineSeries::new(line, 5, 5, colour.stroke_width(1)))?;
        }
        chart.draw_series(points.iter().map(|(x, y, converged)| {
            let style = if *converged { colour.filled() } else { colour.stroke_width(1) };
            Circle::new((*x, *y), 4, style)
        }))?;
    }
    Ok(())
}
