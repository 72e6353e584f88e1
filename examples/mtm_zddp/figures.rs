//! The eight figures of Azam et al. (2019), each with both histories on the same axes.

use std::error::Error;
use std::path::Path;

use stribeck::InputError;
use stribeck::sim::{Body, StepRecord};

use crate::chart::{BLACK, BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use crate::history::History;
use crate::statements::{self, BEARING_INTERVALS};

/// Draws `figure1.svg` to `figure8.svg` into `folder`.
pub(crate) fn draw_all(with: &History, without: &History, folder: &Path) -> Result<(), Box<dyn Error>> {
    // The one without film first: where both lie on each other, the film stays visible.
    let pair = [without, with];
    let figures = [
        ball_roughness(pair),
        formula_lambda(pair),
        film_and_roughness(pair),
        lambda(pair),
        contact(pair),
        wear(pair),
        film_profile(pair),
        bearing_area(pair)?,
    ];
    for (number, figure) in (1..).zip(figures) {
        figure.write(&folder.join(format!("figure{number}.svg")))?;
    }
    Ok(())
}

type Pair<'a> = [&'a History; 2];

/// Colours of [without, with].
const COLOURS: [plotters::style::RGBColor; 2] = [BLUE, VERMILION];

/// Unit of the time axis, by the longer history.
struct Clock {
    label: &'static str,
    seconds: f64,
}

impl Clock {
    fn new(pair: Pair<'_>) -> Self {
        let end =
            pair.iter().filter_map(|history| history.records.last()).map(|r| r.time).fold(0.0, f64::max);
        if end > 6.0 * 3600.0 {
            Self { label: "time, h", seconds: 3600.0 }
        } else {
            Self { label: "time, min", seconds: 60.0 }
        }
    }

    fn points(&self, history: &History, value: impl Fn(&StepRecord) -> f64) -> Vec<(f64, f64)> {
        history.records.iter().map(|record| (record.time / self.seconds, value(record))).collect()
    }

    /// A column that belongs to the surfaces and so has no scatter.
    fn smooth(
        &self,
        pair: Pair<'_>,
        pen: fn(plotters::style::RGBColor) -> Pen,
        value: impl Fn(&StepRecord) -> f64,
    ) -> Vec<Line> {
        let lines = pair.into_iter().zip(COLOURS);
        lines
            .map(|(history, colour)| Line { pen: pen(colour), points: self.points(history, &value) })
            .collect()
    }

    /// A column that belongs to one position of the roughness: every step faint, their running mean strong.
    fn scattered(&self, pair: Pair<'_>, value: impl Fn(&StepRecord) -> f64) -> Vec<Line> {
        let raw = pair.map(|history| self.points(history, &value));
        let means = [0, 1].map(|k| running_mean(&raw[k], pair[k].window()));
        let faint =
            raw.into_iter().zip(COLOURS).map(|(points, colour)| Line { pen: Pen::faint(colour), points });
        let strong =
            means.into_iter().zip(COLOURS).map(|(points, colour)| Line { pen: Pen::strong(colour), points });
        faint.chain(strong).collect()
    }
}

/// Mean of the `window` points around each, fewer at the ends.
fn running_mean(points: &[(f64, f64)], window: usize) -> Vec<(f64, f64)> {
    let half = window / 2;
    let around = |k: usize| &points[k.saturating_sub(half)..(k + half + 1).min(points.len())];
    let mean = |part: &[(f64, f64)]| part.iter().map(|point| point.1).sum::<f64>() / part.len() as f64;
    points.iter().enumerate().map(|(k, point)| (point.0, mean(around(k)))).collect()
}

/// The two colours.
fn legend(pair: Pair<'_>) -> Vec<(Pen, String)> {
    let entries = pair.into_iter().zip(COLOURS);
    entries.map(|(history, colour)| (Pen::strong(colour), history.title.clone())).collect()
}

/// The two colours, thin and strong lines.
fn scattered_legend(pair: Pair<'_>) -> Vec<(Pen, String)> {
    let mut legend = legend(pair);
    legend.push((Pen::faint(BLACK), "each step".to_owned()));
    legend.push((
        Pen::strong(BLACK),
        format!("running mean, {} steps", pair[0].window().max(pair[1].window())),
    ));
    legend
}

fn ball_roughness(pair: Pair<'_>) -> Figure {
    let clock = Clock::new(pair);
    let lines = clock.smooth(pair, Pen::strong, |r| 1e9 * r.roughness.ball_rq);
    Figure {
        title: "Roughness of the ball".to_owned(),
        x_label: clock.label,
        x_scale: XScale::FromZero,
        legend: legend(pair),
        panels: vec![Panel { y_label: "Rq of the ball, nm", lines }],
    }
}

fn formula_lambda(pair: Pair<'_>) -> Figure {
    let clock = Clock::new(pair);
    let lines = clock.smooth(pair, Pen::strong, |r| r.film.formula_lambda.unwrap_or(f64::NAN));
    Figure {
        title: "\u{3bb} ratio by the film formula of Hamrock and Dowson".to_owned(),
        x_label: clock.label,
        x_scale: XScale::FromZero,
        legend: legend(pair),
        panels: vec![Panel { y_label: "\u{3bb}_OLD = h_c / Rq", lines }],
    }
}

fn film_and_roughness(pair: Pair<'_>) -> Figure {
    let clock = Clock::new(pair);
    let mut roughness = clock.smooth(pair, Pen::strong, |r| 1e9 * r.roughness.disc_rq);
    roughness.extend(clock.smooth(pair, Pen::dashed, |r| 1e9 * r.roughness.ball_rq));
    let mut legend = scattered_legend(pair);
    legend.push((Pen::strong(BLACK), "Rq of the disc".to_owned()));
    legend.push((Pen::dashed(BLACK), "Rq of the ball".to_owned()));
    Figure {
        title: "Average film within 2/3 of the contact radius, and roughness".to_owned(),
        x_label: clock.label,
        x_scale: XScale::FromZero,
        legend,
        panels: vec![
            Panel { y_label: "h_avg, nm", lines: clock.scattered(pair, |r| 1e9 * r.film.mean_central) },
            Panel { y_label: "Rq, nm", lines: roughness },
        ],
    }
}

fn lambda(pair: Pair<'_>) -> Figure {
    let clock = Clock::new(pair);
    Figure {
        title: "\u{3bb} ratio by the average film".to_owned(),
        x_label: clock.label,
        x_scale: XScale::FromZero,
        legend: scattered_legend(pair),
        panels: vec![Panel {
            y_label: "\u{3bb} = h_avg / Rq",
            lines: clock.scattered(pair, |r| r.film.lambda.unwrap_or(f64::NAN)),
        }],
    }
}

fn contact(pair: Pair<'_>) -> Figure {
    let clock = Clock::new(pair);
    Figure {
        title: "Solid contact: share of the Hertz area and of the load".to_owned(),
        x_label: clock.label,
        x_scale: XScale::FromZero,
        legend: scattered_legend(pair),
        panels: vec![
            Panel { y_label: "area ratio", lines: clock.scattered(pair, |r| r.contact.area_ratio) },
            Panel { y_label: "load ratio", lines: clock.scattered(pair, |r| r.contact.load_ratio) },
        ],
    }
}

fn wear(pair: Pair<'_>) -> Figure {
    let clock = Clock::new(pair);
    let lines = clock.smooth(pair, Pen::strong, |r| 1e9 * r.wear.disc_mean);
    Figure {
        title: "Wear depth of the disc, mean over its patch".to_owned(),
        x_label: clock.label,
        x_scale: XScale::FromZero,
        legend: legend(pair),
        panels: vec![Panel { y_label: "wear depth, nm", lines }],
    }
}

/// Along y through x = 0, inside the Hertz contact, as the last step left it.
fn film_profile(pair: Pair<'_>) -> Figure {
    let mut lines = Vec::new();
    for (history, colour) in pair.into_iter().zip(COLOURS) {
        let film = history.last_contact.as_ref().map(|contact| contact.film.as_slice());
        let profile = film.map(|film| statements::film_profile(&history.sim, film)).unwrap_or_default();
        let points = profile.into_iter().map(|(y, film)| (1e6 * y, 1e9 * film)).collect();
        lines.push(Line { pen: Pen::strong(colour), points });
    }
    Figure {
        title: "Film along y at x = 0 in the last step (one position of the roughness)".to_owned(),
        x_label: "y, \u{b5}m",
        x_scale: XScale::FromZero,
        legend: legend(pair),
        panels: vec![Panel { y_label: "film thickness, nm", lines }],
    }
}

/// Roughness of the disc on the track over the share of its area that stands as high.
fn bearing_area(pair: Pair<'_>) -> Result<Figure, Box<dyn Error>> {
    let curve = |history: &History, heights: fn(&Body) -> &[f64], pen: Pen| -> Result<Line, InputError> {
        let heights = statements::bearing_heights(&history.sim, heights(&history.sim.bodies()[1]))?;
        let share = 100.0 / BEARING_INTERVALS as f64;
        let points = heights.iter().enumerate().map(|(k, z)| (k as f64 * share, 1e9 * z)).collect();
        Ok(Line { pen, points })
    };
    let [without, with] = pair;
    let mut legend = vec![(Pen::dashed(BLACK), "initial".to_owned())];
    legend.extend(
        pair.into_iter()
            .zip(COLOURS)
            .map(|(history, colour)| (Pen::strong(colour), format!("final, {}", history.title))),
    );
    Ok(Figure {
        title: "Bearing area curve of the disc".to_owned(),
        x_label: "material ratio, %",
        x_scale: XScale::FromZero,
        legend,
        panels: vec![Panel {
            y_label: "height above the mean along the track, nm",
            lines: vec![
                curve(without, Body::initial, Pen::dashed(BLACK))?,
                curve(without, Body::surface, Pen::strong(BLUE))?,
                curve(with, Body::surface, Pen::strong(VERMILION))?,
            ],
        }],
    })
}
