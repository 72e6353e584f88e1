//! Mean film of rough contacts with several random surfaces of the same statistics.

use stribeck::sim::scene::SolverModel;

use crate::chart::{BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use crate::report::{Effort, Number, Outcome, Row};
use crate::rough::{Case, LENGTHS, computed};

const SEEDS: u64 = 4;
/// Nominal film ratios.
const LAMBDAS: [f64; 4] = [0.5, 1.0, 2.0, 3.0];

/// Film over the smooth film, share on solids and friction of the surfaces of one film ratio and correlation length.
fn surfaces(found: &[(Case, [f64; 3])], lambda: f64, length: f64) -> Vec<[f64; 3]> {
    found.iter().filter(|(case, _)| case.is_at(lambda, length)).map(|(_, values)| *values).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Smallest, mean and largest value.
fn band(values: &[f64]) -> [f64; 3] {
    let of = |pick: fn(f64, f64) -> f64| values.iter().copied().reduce(pick).unwrap_or(f64::NAN);
    [of(f64::min), mean(values), of(f64::max)]
}

fn figure(found: &[(Case, [f64; 3])], lambdas: &[f64]) -> Figure {
    let mut panels = Vec::new();
    for (k, y_label) in [(0, "film / smooth"), (2, "friction")] {
        let mut lines = Vec::new();
        for (length, colour) in LENGTHS.into_iter().zip([BLUE, VERMILION]) {
            let bands: Vec<(f64, [f64; 3])> = (lambdas.iter())
                .map(|lambda| {
                    let values: Vec<f64> =
                        surfaces(found, *lambda, length).iter().map(|values| values[k]).collect();
                    (lambda.log10(), band(&values))
                })
                .collect();
            for (end, pen) in
                [Pen::dashed(colour), Pen::strong(colour), Pen::dashed(colour)].into_iter().enumerate()
            {
                lines.push(Line { pen, points: bands.iter().map(|(x, band)| (*x, band[end])).collect() });
            }
        }
        panels.push(Panel { y_label, lines });
    }
    Figure {
        title: "Rough contacts of four random surfaces: mean and band".to_owned(),
        x_label: "nominal lambda",
        x_scale: XScale::Decades,
        legend: vec![
            (Pen::strong(BLUE), "16 \u{b5}m, mean".to_owned()),
            (Pen::dashed(BLUE), "16 \u{b5}m, smallest and largest".to_owned()),
            (Pen::strong(VERMILION), "48 \u{b5}m, mean".to_owned()),
            (Pen::dashed(VERMILION), "48 \u{b5}m, smallest and largest".to_owned()),
        ],
        panels,
    }
}

pub(crate) fn row(effort: Effort) -> Outcome<Row> {
    let (lambdas, lengths, seeds) = if effort.is_full() {
        (&LAMBDAS[..], &LENGTHS[..], SEEDS)
    } else {
        (&LAMBDAS[3..], &LENGTHS[..1], 2)
    };
    let mut cases = Vec::new();
    for lambda in lambdas {
        for length in lengths {
            let case = |seed| Case { lambda: *lambda, length: *length, seed, model: SolverModel::Resolved };
            cases.extend((1..=seeds).map(case));
        }
    }
    let found = computed(&cases, lambdas)?;
    let mut numbers = Vec::new();
    for (case, [film, ..]) in &found {
        let films: Vec<f64> =
            surfaces(&found, case.lambda, case.length).iter().map(|values| values[0]).collect();
        // The bounds are the scatter of these surfaces.
        let (group, bound) = if case.length > LENGTHS[0] {
            ("film over smooth film beside the mean of the surfaces, 48 um", 0.12)
        } else if case.lambda < 1.0 {
            ("film over smooth film beside the mean of the surfaces, 16 um, lambda 0.5", 0.06)
        } else {
            ("film over smooth film beside the mean of the surfaces, 16 um, lambda 1 to 3", 0.04)
        };
        let text = format!("lambda {}; seed {}", case.lambda, case.seed);
        numbers.push(Number::absolute(group, text, "", mean(&films), *film, bound));
    }
    Ok(Row {
        name: "rough_seeds",
        quantity: "Scatter of rough films from surface to surface",
        reference: "own computation: mean of four random surfaces",
        range: "as above, nominal lambda 0.5 to 3",
        numbers,
        extra: String::new(),
        figures: vec![("rough_seeds", figure(&found, lambdas))],
    })
}
