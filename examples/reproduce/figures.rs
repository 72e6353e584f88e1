//! The eight figures of the paper: mean over the seeds, and their smallest and largest values pale behind it.

use std::error::Error;
use std::path::Path;

use plotters::style::RGBColor;

use crate::chart::{BLACK, BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use crate::history::History;
use crate::report::Results;

/// Draws `reproduction1.svg` to `reproduction8.svg` into `folder`.
pub(crate) fn draw_all(results: &Results, folder: &Path) -> Result<(), Box<dyn Error>> {
    let figures = [
        over_time(results, "Roughness of the ball", &[("Rq of the ball, nm", "rq_ball_m", 1e9)]),
        over_time(
            results,
            "\u{3bb} ratio by the film formula of Hamrock and Dowson",
            &[("\u{3bb}_OLD = h_c / Rq", "lambda_old", 1.0)],
        ),
        over_time(
            results,
            "Average film within 2/3 of the contact radius, and composite roughness",
            &[("h_avg, nm", "h_avg_m", 1e9), ("Rq, nm", "rq_composite_m", 1e9)],
        ),
        over_time(results, "\u{3bb} ratio by the average film", &[("\u{3bb} = h_avg / Rq", "lambda", 1.0)]),
        over_time(
            results,
            "Solid contact: share of the Hertz area and of the load",
            &[("area ratio", "area_ratio", 1.0), ("load ratio", "load_ratio", 1.0)],
        ),
        over_time(
            results,
            "Wear depth of the disc, mean over its patch",
            &[("wear depth, nm", "track_wear_disc_m", 1e9)],
        ),
        profiles(results),
        bearing(results),
    ];
    for (number, figure) in (1..).zip(figures) {
        figure.write(&folder.join(format!("reproduction{number}.svg")))?;
    }
    Ok(())
}

/// Without film first: where both lie on each other, the film stays visible.
fn sides(results: &Results) -> [(Vec<&History>, RGBColor); 2] {
    let without = results.seeds.iter().map(|pair| &pair.without).collect();
    let with = results.seeds.iter().map(|pair| &pair.with).collect();
    [(without, BLUE), (with, VERMILION)]
}

fn legend(results: &Results) -> Vec<(Pen, String)> {
    let seeds = results.seeds.len();
    vec![
        (Pen::strong(BLUE), "without tribofilm".to_owned()),
        (Pen::strong(VERMILION), "with tribofilm".to_owned()),
        (Pen::faint(BLACK), format!("smallest and largest of {seeds} seeds")),
    ]
}

fn over_time(results: &Results, title: &str, columns: &[(&'static str, &str, f64)]) -> Figure {
    let panel = |&(y_label, column, unit): &(&'static str, &str, f64)| {
        let mut lines = Vec::new();
        for (histories, colour) in sides(results) {
            let values: Vec<Vec<f64>> = histories
                .iter()
                .map(|h| running_mean(&h.column(column), h.window()).iter().map(|v| unit * v).collect())
                .collect();
            let times = histories.iter().map(|h| h.column("time_s")).max_by_key(Vec::len).unwrap_or_default();
            lines.extend(band(&times.iter().map(|t| t / 60.0).collect::<Vec<_>>(), &values, colour));
        }
        Panel { y_label, lines }
    };
    Figure {
        title: title.to_owned(),
        x_label: "time, min",
        x_scale: XScale::FromZero,
        legend: legend(results),
        panels: columns.iter().map(panel).collect(),
    }
}

/// Mean, smallest and largest at each place, over the histories that reach it.
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

fn running_mean(values: &[f64], window: usize) -> Vec<f64> {
    let half = window / 2;
    let around = |k: usize| &values[k.saturating_sub(half)..(k + half + 1).min(values.len())];
    (0..values.len()).map(|k| around(k).iter().sum::<f64>() / around(k).len() as f64).collect()
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
    let curves = |histories: &[&History], moment: usize| {
        let values: Vec<Vec<f64>> =
            histories.iter().map(|h| h.bearing[moment].iter().map(|p| 1e9 * p.1).collect()).collect();
        let places = histories.first().map(|h| h.bearing[moment].as_slice()).unwrap_or_default();
        (places.iter().map(|p| 100.0 * p.0).collect::<Vec<_>>(), values)
    };
    let mut lines = Vec::new();
    for (histories, colour) in sides(results) {
        let (places, values) = curves(&histories, 1);
        lines.extend(band(&places, &values, colour));
        if colour == BLUE {
            let (places, values) = curves(&histories, 0);
            let start = band(&places, &values, BLACK).pop();
            lines.extend(start.map(|line| Line { pen: Pen::dashed(BLACK), ..line }));
        }
    }
    let mut legend = legend(results);
    legend.push((Pen::dashed(BLACK), "initial".to_owned()));
    Figure {
        title: "Bearing area curve of the disc".to_owned(),
        x_label: "material ratio, %",
        x_scale: XScale::FromZero,
        legend,
        panels: vec![Panel { y_label: "height above the mean, nm", lines }],
    }
}
