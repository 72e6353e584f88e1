//! The picture of a curve, with resolved contacts beside it.

use plotters::style::RGBColor;

use super::row::{Columns, QUANTITIES, Row};
use crate::picture::{BLUE, Chart, Line, Panel, VERMILION, XScale};

/// A panel for each quantity, with bands where values have them; `resolved` rows are drawn beside the curve.
pub(super) fn chart(name: &str, columns: Columns, [rows, resolved]: [&[Row]; 2]) -> Chart {
    let over = columns.over;
    let x_of = &|at: f64| if over.is_logarithmic() { at.log10() } else { over.shown(at) };
    let panels = QUANTITIES.iter().enumerate().filter_map(|(index, quantity)| {
        let curve = line(rows, index, x_of, BLUE);
        let beside = line(resolved, index, x_of, VERMILION);
        let mut lines = vec![curve, beside];
        lines.retain(|line| !line.points.is_empty());
        if let [curve, beside] = lines.as_mut_slice() {
            (curve.name, beside.name) = ("asperity inlets", "resolved");
        }
        let panel = Panel { y_label: quantity.label.to_owned(), lines, highest: None };
        (!panel.lines.is_empty()).then_some(panel)
    });
    Chart {
        title: format!("{} {name}", over.title()),
        x_label: over.label(columns.line),
        x_scale: if over.is_logarithmic() { XScale::Decades } else { XScale::Linear },
        panels: panels.collect(),
    }
}

/// The quantity of number `index` over the x of `rows`.
fn line(rows: &[Row], index: usize, x_of: &dyn Fn(f64) -> f64, colour: RGBColor) -> Line {
    let values: Vec<_> = rows.iter().filter_map(|row| Some((x_of(row.at), row.values[index]?))).collect();
    let scaled = |number: f64| QUANTITIES[index].factor * number;
    let bands = values.iter().filter_map(|(x, value)| {
        let band = value.band()?;
        Some((*x, [scaled(value.mean - band), scaled(value.mean + band)]))
    });
    Line {
        name: "",
        colour,
        points: values.iter().map(|(x, value)| (*x, scaled(value.mean))).collect(),
        bands: bands.collect(),
    }
}
