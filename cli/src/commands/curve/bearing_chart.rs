//! The picture of a curve of a rigid bearing, and the table of its report.

use std::path::Path;

use serde_json::Value;
use stribeck::sim::BearingNumbers;

use super::axis::Axis;
use crate::output;
use crate::picture::{BLUE, Chart, Line, Panel, Scale};
use crate::report::{ErrorOf, Number, rows};

/// Most rows of the table of the report.
const ROWS: usize = 40;

/// A quantity of a point.
struct Quantity {
    /// Label with its unit in brackets.
    label: &'static str,
    /// Its name in the JSON object.
    key: &'static str,
    value: fn(&BearingNumbers) -> f64,
    /// Factor and offset from SI units.
    scale: [f64; 2],
    is_logarithmic: bool,
}

const QUANTITIES: [Quantity; 5] = [
    Quantity {
        label: "least film (um)",
        key: "least_film",
        value: |numbers| numbers.least_film,
        scale: [1e6, 0.0],
        is_logarithmic: true,
    },
    Quantity {
        label: "friction coefficient",
        key: "friction_coefficient",
        value: |numbers| numbers.friction_coefficient,
        scale: [1.0, 0.0],
        is_logarithmic: true,
    },
    Quantity {
        label: "largest pressure (MPa)",
        key: "pressure_max",
        value: |numbers| numbers.pressure_max,
        scale: [1e-6, 0.0],
        is_logarithmic: false,
    },
    Quantity {
        label: "power loss (W)",
        key: "power_loss",
        value: |numbers| numbers.power_loss,
        scale: [1.0, 0.0],
        is_logarithmic: true,
    },
    Quantity {
        label: "temperature of the oil (\u{b0}C)",
        key: "temperature",
        value: |numbers| numbers.temperature,
        scale: [1.0, -273.15],
        is_logarithmic: false,
    },
];

/// The label of `quantity`; a wide pad has its power per metre.
fn label(quantity: &Quantity, is_wide: bool) -> &'static str {
    if is_wide && quantity.key == "power_loss" { "power loss (W/m)" } else { quantity.label }
}

/// A panel for each quantity of the `points` over `over`.
pub(super) fn chart(scene: &Path, (over, is_wide): (Axis, bool), points: &[(f64, BearingNumbers)]) -> Chart {
    let panels = QUANTITIES.iter().filter_map(|quantity| {
        let [factor, offset] = quantity.scale;
        let place = |at: f64| if over.is_logarithmic() { at.log10() } else { over.shown(at) };
        let values =
            points.iter().map(|(at, numbers)| (place(*at), factor * (quantity.value)(numbers) + offset));
        let points: Vec<(f64, f64)> = values.filter(|(_, value)| value.is_finite()).collect();
        let is_logarithmic = quantity.is_logarithmic && points.iter().all(|(_, value)| *value > 0.0);
        let lines = vec![Line { name: "", colour: BLUE, points, bands: Vec::new() }];
        lines.iter().any(|line| !line.points.is_empty()).then(|| {
            if is_logarithmic {
                Panel::logarithmic(label(quantity, is_wide), lines)
            } else {
                Panel::new(label(quantity, is_wide), lines)
            }
        })
    });
    Chart {
        title: format!("{} {}", over.title(), output::stem(scene)),
        x_label: over.bearing_label(is_wide),
        x_scale: if over.is_logarithmic() { Scale::Decades } else { Scale::Linear },
        upper: None,
        panels: panels.collect(),
    }
}

/// The table of the curve `numbers`, its JSON object.
pub(super) fn table((over, is_wide): (Axis, bool), numbers: &Value) -> String {
    let offset = if over == Axis::Temperature { -273.15 } else { 0.0 };
    let column = |label: &'static str, key: &'static str, [factor, offset]: [f64; 2]| {
        let (name, unit) = label.split_once(" (").unwrap_or((label, ""));
        Number { name, key, unit: unit.trim_end_matches(')'), factor, offset, error: ErrorOf::None }
    };
    let others =
        QUANTITIES.iter().map(|quantity| column(label(quantity, is_wide), quantity.key, quantity.scale));
    let columns = std::iter::once(column(over.bearing_label(is_wide), "over", [1.0, offset])).chain(others);
    rows(numbers, "points", &columns.collect::<Vec<_>>(), ROWS)
}
