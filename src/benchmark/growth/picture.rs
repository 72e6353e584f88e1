//! Measured and fitted films over time.

use super::comparison::{GrowthComparison, GrowthRow};
use crate::benchmark::pictures::{Axes, Line, Svg, colour, draw_legend, legend_height};

const PANEL: (f64, f64) = (620.0, 320.0);
const NANOMETRES: f64 = 1e9;

impl GrowthComparison {
    /// Measured and fitted films over time, as SVG: a panel for each film.
    pub fn svg(&self) -> String {
        let fitted: Vec<&GrowthRow> = self.rows().iter().filter(|row| row.reason.is_empty()).collect();
        let names: Vec<&str> = fitted.iter().map(|row| row.law.as_str()).collect();
        let head = legend_height(names.len());
        let mut svg = Svg::new(PANEL.0, head + self.films.len() as f64 * PANEL.1);
        draw_legend(&mut svg, &names);
        for (k, film) in self.films.iter().enumerate() {
            let at = film.conditions().first();
            let title = at.map_or_else(String::new, |at| {
                format!("{:.1} K, {:.0} MPa, measured: dots", at.temperature, 1e-6 * at.shear_stress)
            });
            let points = |films: &[f64]| -> Vec<(f64, f64)> {
                film.times().iter().copied().zip(films.iter().map(|film| NANOMETRES * film)).collect()
            };
            let mut lines: Vec<Line> = fitted
                .iter()
                .enumerate()
                .filter_map(|(law, row)| {
                    let points = points(row.thicknesses.get(k)?);
                    Some(Line { colour: colour(law), points, width: 2.0, dashed: false, marked: false })
                })
                .collect();
            let measured = points(film.thicknesses());
            lines.extend(measured.into_iter().map(|point| {
                let points = vec![point];
                Line { colour: "#000000", points, width: 1.0, dashed: false, marked: true }
            }));
            let (x_label, y_label) = ("time (s)", "film (nm)");
            let axes = Axes { title: &title, x_label, y_label, log_x: false, log_y: false, lines };
            axes.draw(&mut svg, (0.0, head + k as f64 * PANEL.1), PANEL);
        }
        svg.finish()
    }
}
