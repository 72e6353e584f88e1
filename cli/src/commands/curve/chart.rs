//! The picture of a curve.

use super::row::{QUANTITIES, Row};
use crate::picture::{BLUE, Chart, Line, Panel, XScale};

/// A panel for each quantity, with bands where values have them.
pub(super) fn chart(name: &str, rows: &[Row]) -> Chart {
    let panels = QUANTITIES.iter().enumerate().filter_map(|(index, quantity)| {
        let known = |row: &Row| Some((row.speed.log10(), row.values[index]?));
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
        title: format!("Stribeck curve of {name}"),
        x_label: "entrainment speed (m/s)",
        x_scale: XScale::Decades,
        panels: panels.collect(),
    }
}
