//! The eight figures of the paper, of one variant: mean over the seeds, and their smallest and largest values
//! pale behind it.

use std::error::Error;
use std::path::Path;

use plotters::style::RGBColor;
use stribeck::sim::StepRecord;

use crate::chart::{BLACK, BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use crate::statements::{BEARING_INTERVALS, History, PARTS, Value};
use crate::tables::Results;

/// Share of the steps in a running mean.
const WINDOW: f64 = 0.05;

/// Draws `figure1.svg` to `figure8.svg` into `folder`.
pub(crate) fn draw_all(results: &Results, folder: &Path) -> Result<(), Box<dyn Error>> {
    let figures = [
        over_time(results, "Roughness of the ball", &[("Rq of the ball, nm", 1e9, |r| r.roughness.ball_rq)]),
        over_time(
            results,
            "\u{3bb} ratio by the film formula of Hamrock and Dowson",
            &[("\u{3bb}_OLD = h_c / Rq", 1.0, |r| r.film.formula_lambda.unwrap_or(f64::NAN))],
        ),
        over_time(
            results,
            "Average film within 2/3 of the contact radius, and composite roughness",
            &[("h_avg, nm", 1e9, |r| r.film.mean_central), ("Rq, nm", 1e9, |r| r.roughness.composite_rq)],
        ),
        over_time(
            results,
            "\u{3bb} ratio by the average film",
            &[("\u{3bb} = h_avg / Rq", 1.0, |r| r.film.lambda.unwrap_or(f64::NAN))],
        ),
        over_time(
            results,
            "Solid contact: share of the Hertz area and of the load",
            &[("area ratio", 1.0, |r| r.contact.area_ratio), ("load ratio", 1.0, |r| r.contact.load_ratio)],
        ),
        over_time(
            results,
            "Wear depth of the disc, mean over the width of its track",
            &[("wear depth, nm", 1e9, |r| r.wear.disc_in_contact)],
        ),
        profiles(results),
        bearing(results),
    ];
    for (number, figure) in (1..).zip(figures) {
        figure.write(&folder.join(format!("figure{number}.svg")))?;
    }
    Ok(())
}

/// Without film first: where both lie on each other, the film stays visible.
fn sides(results: &Results) -> [(Vec<&History>, RGBColor); 2] {
    let without = results.pairs.iter().map(|pair| &pair.without).collect();
    let with = results.pairs.iter().map(|pair| &pair.with).collect();
    [(without, BLUE), (with, VERMILION)]
}

fn legend(results: &Results) -> Vec<(Pen, String)> {
    let seeds = results.pairs.len();
    vec![
        (Pen::strong(BLUE), "without tribofilm".to_owned()),
        (Pen::strong(VERMILION), "with tribofilm".to_owned()),
        (Pen::faint(BLACK), format!("smallest and largest of {seeds} seeds")),
    ]
}

fn over_time(results: &Results, title: &str, panels: &[(&'static str, f64, Value)]) -> Figure {
    let panel = |&(y_label, unit, value): &(&'static str, f64, Value)| {
        let mut lines = Vec::new();
        for (histories, colour) in sides(results) {
            let values: Vec<Vec<f64>> =
                histories.iter().map(|history| running_mean(&history.records, unit, value)).collect();
            let records = histories.first().map(|history| history.records.as_slice()).unwrap_or_default();
            let minutes: Vec<f64> = records.iter().map(|record| record.time / 60.0).collect();
            lines.extend(band(&minutes, &values, colour));
        }
        Panel { y_label, lines }
    };
    Figure {
        title: title.to_owned(),
        x_label: "time, min",
        x_scale: XScale::FromZero,
        legend: legend(results),
        panels: panels.iter().map(panel).collect(),
    }
}

/// Mean, smallest and largest at each place.
fn band(places: &[f64], values: &[Vec<f64>], colour: RGBColor) -> Vec<Line> {
    let (mut low, mut high, mut mean) = (Vec::new(), Vec::new(), Vec::new());
    for (k, &x) in places.iter().enumerate() {
        let here: Vec<f64> = values.iter().filter_map(|history| history.get(k)).copied().collect();
        low.push((x, here.iter().copied().fold(f64::INFINITY, f64::min)));
        high.push((x, here.iter().copied().fold(f64::NEG_INFINITY, f64::max)));
        mean.push((x, here.iter().sum::<f64>() / here.len() as f64));
    }
    let pens = [Pen::faint(colour), Pen::faint(colour), Pen::strong(colour)];
    pens.into_iter().zip([low, high, mean]).map(|(pen, points)| Line { pen, points }).collect()
}

/// Mean of the steps around each, as many before as after.
fn running_mean(records: &[StepRecord], unit: f64, value: Value) -> Vec<f64> {
    let widest = (0.5 * WINDOW * records.len() as f64).round() as usize;
    let around = |k: usize| {
        let half = widest.min(k).min(records.len() - 1 - k);
        &records[k - half..=k + half]
    };
    let mean = |part: &[StepRecord]| unit * part.iter().map(value).sum::<f64>() / part.len() as f64;
    (0..records.len()).map(|k| mean(around(k))).collect()
}

/// The first seed alone: a profile belongs to one surface.
fn profiles(results: &Results) -> Figure {
    let mut lines = Vec::new();
    for (histories, colour) in sides(results) {
        let profile = histories.first().map(|history| history.profile.as_slice()).unwrap_or_default();
        let points = profile.iter().map(|(y, film)| (1e6 * y, 1e9 * film)).collect();
        lines.push(Line { pen: Pen::strong(colour), points });
    }
    let mut legend = legend(results);
    legend.truncate(2);
    Figure {
        title: "Film along y at x = 0 in the last step, first seed".to_owned(),
        x_label: "y, \u{b5}m",
        x_scale: XScale::FromZero,
        legend,
        panels: vec![Panel { y_label: "film thickness, nm", lines }],
    }
}

fn bearing(results: &Results) -> Figure {
    let shares: Vec<f64> =
        (0..=BEARING_INTERVALS).map(|k| 100.0 * k as f64 / BEARING_INTERVALS as f64).collect();
    let curves = |histories: &[&History], last: bool, colour| {
        let part = if last { PARTS } else { 0 };
        let values: Vec<Vec<f64>> = histories
            .iter()
            .filter_map(|history| history.bearing.get(&part))
            .map(|heights| heights.iter().map(|z| 1e9 * z).collect())
            .collect();
        band(&shares, &values, colour)
    };
    let mut lines = Vec::new();
    for (histories, colour) in sides(results) {
        if colour == BLUE {
            let initial = curves(&histories, false, BLACK).pop();
            lines.extend(initial.map(|line| Line { pen: Pen::dashed(BLACK), ..line }));
        }
        lines.extend(curves(&histories, true, colour));
    }
    let mut legend = legend(results);
    legend.push((Pen::dashed(BLACK), "initial".to_owned()));
    Figure {
        title: "Bearing area curve of the disc's track".to_owned(),
        x_label: "material ratio, %",
        x_scale: XScale::FromZero,
        legend,
        panels: vec![Panel { y_label: "height above the mean, nm", lines }],
    }
}
