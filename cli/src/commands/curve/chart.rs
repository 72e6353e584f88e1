//! The picture of a curve.

use super::row::{Columns, QUANTITIES, Row};
use crate::picture::{BLUE, Chart, Line, Panel, XScale};

/// A panel for each quantity, with bands where values have them.
pub(super) fn chart(name: &str, columns: Columns, rows: &[Row]) -> Chart {
    let over = columns.over;
    let x_of = |at: f64| if over.is_logarithmic() { at.log10() } else { over.shown(at) };
    let panels = QUANTITIES.iter().enumerate().filter_map(|(index, quantity)| {
        let known = |row: &Row| Some((x_of(row.at), row.values[index]?));
        let values: Vec<_> = rows.iter().filter_map(known).collect();
        let scaled = |number: f64| quantity.factor * number;
        let line = Line {
            name: "",
            colour: BLUE,
            points: values.iter().map(|(x, value)| (*x, scaled(value.mean))).collect(),
            bands: values
                .iter()
                .filter_map(|(x, value)| {
                    let band = value.band()?;
                    Some((*x, [scaled(value.mean - band), scaled(value.mean + band)]))
                })
                .collect(),
        };
        let panel = Panel { y_label: quantity.label.to_owned(), lines: vec![line], highest: None };
        (!values.is_empty()).then_some(panel)
    });
    Chart {
        title: format!("{} {name}", over.title()),
        x_label: over.label(columns.line),
        x_scale: if over.is_logarithmic() { XScale::Decades } else { XScale::Linear },
        panels: panels.collect(),
    }
}
