//! Markdown tables of the map.

use std::fmt::Write as _;

use super::{METHODS, Row};

/// Mean and largest of absolute values; empty for none.
fn mean_and_most(values: &[f64]) -> String {
    if values.is_empty() {
        return String::new();
    }
    let mean = values.iter().map(|value| value.abs()).sum::<f64>() / values.len() as f64;
    let most = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    format!("{mean:.3} ({most:.3})")
}

/// A set of contacts.
type Group = (&'static str, fn(&Row) -> bool);

/// Isotropic surfaces by the load ratio of the reference, and lays.
const GROUPS: [Group; 8] = [
    ("isotropic, below 0.1", |row| row.is_isotropic_within(f64::NEG_INFINITY, 0.1)),
    ("isotropic, 0.1 to 0.9", |row| row.is_isotropic_within(0.1, 0.9)),
    ("of these, without a warning", |row| row.is_isotropic_within(0.1, 0.9) && !row.is_sensitive()),
    ("of these, with a warning", |row| row.is_isotropic_within(0.1, 0.9) && row.is_sensitive()),
    ("isotropic, above 0.9", |row| row.is_isotropic_within(0.9, f64::INFINITY)),
    ("lambda 0.3, 1 and 3", |row| row.is_by_lambda),
    ("lay along the flow", |row| row.surface.name.starts_with("lay along")),
    ("lay across the flow", |row| row.surface.name.starts_with("lay across")),
];

/// Markdown tables: errors by surface, and by groups and methods with seconds.
pub(crate) fn of(rows: &[Row], divisor: usize) -> String {
    let mut text =
        "| surface | lambda | load ratio | friction | mean film |\n|---|---|---|---|---|\n".to_owned();
    let mut names: Vec<&str> = rows.iter().map(|row| row.surface.name).collect();
    names.dedup();
    for name in names {
        let of = || rows.iter().filter(|row| row.surface.name == name && !row.is_by_lambda);
        let errors: Vec<[f64; 3]> = of().filter_map(|row| row.errors(1)).collect();
        let column = |k: usize| mean_and_most(&errors.iter().map(|error| error[k]).collect::<Vec<_>>());
        let lambdas: Vec<f64> = of().map(|row| row.lambda).collect();
        let [low, high] = [f64::INFINITY, 0.0]
            .map(|start| lambdas.iter().copied().fold(start, if start == 0.0 { f64::max } else { f64::min }));
        let _ = writeln!(
            text,
            "| {name} | {low:.2} to {high:.2} | {} | {} | {} |",
            column(0),
            column(1),
            column(2)
        );
    }
    text.push_str("\n| contacts | method | cells | load ratio | friction | mean film | seconds |\n|---|---|---|---|---|---|---|\n");
    for (group, holds) in GROUPS {
        let of: Vec<&Row> = rows.iter().filter(|row| holds(row)).collect();
        for (k, (method, cells)) in METHODS.into_iter().enumerate().skip(1) {
            let errors: Vec<[f64; 3]> = of.iter().filter_map(|row| row.errors(k)).collect();
            let column = |at: usize| mean_and_most(&errors.iter().map(|error| error[at]).collect::<Vec<_>>());
            let seconds = of.iter().map(|row| row.found[k].seconds).sum::<f64>() / of.len().max(1) as f64;
            let _ = writeln!(
                text,
                "| {group} ({}) | {} | {} | {} | {} | {} | {seconds:.2} |",
                errors.len(),
                method.name(),
                cells / divisor,
                column(0),
                column(1),
                column(2)
            );
        }
    }
    text
}
