//! The picture of a curve, with resolved contacts beside it.

use plotters::style::RGBColor;
use stribeck::sim::FilmFormula;

use super::Curve;
use super::row::{Columns, QUANTITIES, Quantity, Row};
use crate::picture::{BLUE, Chart, GREEN, Line, Panel, Scale, UpperAxis, VERMILION};

/// A panel for each quantity, with bands where values have them; resolved rows are drawn beside the curve. Films over speed or
/// load have logarithmic axes.
pub(super) fn chart(name: &str, curve: &Curve<'_>) -> Chart {
    let columns = curve.columns;
    let panels = QUANTITIES.iter().enumerate().filter_map(|(index, quantity)| {
        let line = |rows, colour| line(rows, index, columns, colour);
        let mut lines = vec![line(&curve.rows, BLUE), line(&curve.resolved, VERMILION)];
        lines.retain(|line| !line.points.is_empty());
        if let [curve, beside] = lines.as_mut_slice() {
            (curve.name, beside.name) = ("asperity inlets", "resolved");
        }
        if lines.is_empty() {
            return None;
        }
        Some(match quantity.column {
            "friction_coefficient" => {
                let parts = friction_parts(curve);
                if let ([line], false) = (lines.as_mut_slice(), parts.is_empty()) {
                    line.name = "friction";
                }
                lines.extend(parts);
                Panel::new(quantity.label, lines)
            }
            "film_mean_central_m" | "film_lambda" => {
                if let Some(formula) = formula(curve, quantity) {
                    if let [line] = lines.as_mut_slice() {
                        line.name = "mean film";
                    }
                    lines.push(formula);
                }
                if columns.over.is_logarithmic() {
                    Panel::logarithmic(quantity.label, lines)
                } else {
                    Panel::new(quantity.label, lines)
                }
            }
            _ => Panel::new(quantity.label, lines),
        })
    });
    Chart {
        title: format!("{} {name}", columns.over.title()),
        x_label: columns.over.label(columns.line),
        x_scale: if columns.over.is_logarithmic() { Scale::Decades } else { Scale::Linear },
        upper: lambda_axis(curve),
        panels: panels.collect(),
    }
}

/// Film over roughness as a second axis: the places where the curve first has a round value. `None` of a film that hardly changes and
/// between smooth surfaces.
fn lambda_axis(curve: &Curve<'_>) -> Option<UpperAxis> {
    let index = QUANTITIES.iter().position(|quantity| quantity.column == "film_lambda")?;
    let known =
        curve.rows.iter().filter_map(|row| Some((place(curve.columns, row.at), row.values[index]?.mean)));
    let known: Vec<(f64, f64)> =
        known.filter(|(_, lambda)| *lambda > 0.0).map(|(x, l)| (x, l.ln())).collect();
    let decades = (-3..3).map(|power| 10_f64.powi(power));
    let round = decades.flat_map(|decade| [1.0, 2.0, 5.0].map(|step| step * decade));
    let ticks = round.filter_map(|lambda| {
        let between = known.windows(2).find_map(|pair| match pair {
            [(x0, low), (x1, high)]
                if (low - lambda.ln()) * (high - lambda.ln()) <= 0.0 && (high - low).abs() > 0.0 =>
            {
                Some(x0 + (x1 - x0) * (lambda.ln() - low) / (high - low))
            }
            _ => None,
        });
        between.map(|x| (x, format!("{}", (lambda * 1e3).round() / 1e3)))
    });
    let ticks: Vec<_> = ticks.collect();
    (ticks.len() > 1).then_some(UpperAxis { label: "film / Rq", ticks })
}

/// The place of a value on the x axis.
fn place(columns: Columns, at: f64) -> f64 {
    if columns.over.is_logarithmic() { at.log10() } else { columns.over.shown(at) }
}

/// The quantity of number `index` over the x of `rows`.
fn line(rows: &[Row], index: usize, columns: Columns, colour: RGBColor) -> Line {
    let x_of = |at| place(columns, at);
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

/// Parts of solids and fluid in the friction, where both are there.
fn friction_parts(curve: &Curve<'_>) -> Vec<Line> {
    let part = |index: usize| -> Vec<(f64, f64)> {
        curve.rows.iter().map(|row| (place(curve.columns, row.at), row.friction_parts[index])).collect()
    };
    let [solid, fluid] = [part(0), part(1)];
    let some = |points: &[(f64, f64)]| points.iter().any(|point| point.1 > 0.0);
    if !(some(&solid) && some(&fluid)) {
        return Vec::new();
    }
    let line = |name, colour, points| Line { name, colour, points, bands: Vec::new() };
    vec![line("of it solid", VERMILION, solid), line("of it fluid", GREEN, fluid)]
}

/// The film by formula, of the smooth contact.
fn formula(curve: &Curve<'_>, quantity: &Quantity) -> Option<Line> {
    if quantity.column != "film_mean_central_m" {
        return None;
    }
    let films = curve
        .rows
        .iter()
        .filter_map(|row| Some((place(curve.columns, row.at), quantity.factor * row.formula?.central)));
    let points: Vec<_> = films.collect();
    let mut formulas: Vec<_> = curve.rows.iter().filter_map(|row| Some(row.formula?.formula)).collect();
    formulas.dedup();
    (!points.is_empty()).then(|| Line {
        name: match formulas.as_slice() {
            [FilmFormula::HamrockDowson] => "smooth, by formula (Hamrock, Dowson)",
            [FilmFormula::DowsonToyoda] => "smooth, by formula (Dowson, Toyoda)",
            [FilmFormula::Moes] => "smooth, by formula (Moes)",
            _ => "smooth, by formula of each regime",
        },
        colour: GREEN,
        points,
        bands: Vec::new(),
    })
}
