//! Fits of several laws to the same films.

use std::fmt::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::law::{Boxed, GrowthLaw};
use crate::tribochem::{FittedConstant, MeasuredFilm, fit_growth_law_to, thicknesses};

/// The fit of a law.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct GrowthRow {
    /// Name of the law.
    pub law: String,
    /// Fitted constants; empty if the fit failed.
    pub constants: Vec<FittedConstant>,
    /// Residual standard deviation \[m\]; NaN if the fit failed.
    pub standard_deviation: f64,
    /// Corrected Akaike information criterion; NaN if the fit failed or points are too few.
    pub aicc: f64,
    /// Thickness by the law at each point of each film \[m\]; empty if the fit failed.
    pub thicknesses: Vec<Vec<f64>>,
    /// Reason of a failure.
    pub reason: String,
}

/// Laws over films, the best one first and failures last.
#[derive(Debug, Clone)]
pub struct GrowthComparison {
    pub(super) films: Vec<MeasuredFilm>,
    rows: Vec<GrowthRow>,
}

/// Fits all `laws` to all `films`. A law that panics or cannot be fitted is a row with the reason.
pub fn compare(films: &[MeasuredFilm], laws: impl IntoIterator<Item = GrowthLaw>) -> GrowthComparison {
    let mut rows: Vec<GrowthRow> = laws.into_iter().map(|law| row(films, &law)).collect();
    let key = |row: &GrowthRow| if row.aicc.is_nan() { f64::INFINITY } else { row.aicc };
    rows.sort_by(|a, b| key(a).total_cmp(&key(b)));
    GrowthComparison { films: films.to_vec(), rows }
}

/// The fit of one law.
fn row(films: &[MeasuredFilm], law: &GrowthLaw) -> GrowthRow {
    let failed = |reason: String| GrowthRow {
        law: law.name.clone(),
        constants: Vec::new(),
        standard_deviation: f64::NAN,
        aicc: f64::NAN,
        thicknesses: Vec::new(),
        reason,
    };
    let start: Vec<(&str, f64)> = law.start.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let fitted = catch_unwind(AssertUnwindSafe(|| {
        let fit = fit_growth_law_to(films, &start, |constants| (law.make)(constants).map(Boxed))?;
        let computed: Vec<Vec<f64>> =
            films.iter().map(|film| thicknesses(&fit.law, film).collect()).collect();
        Ok::<_, crate::tribochem::FitError>((fit.constants, fit.standard_deviation, computed))
    }));
    let (constants, standard_deviation, thicknesses) = match fitted {
        Err(_) => return failed("the law panicked".to_owned()),
        Ok(Err(error)) => return failed(error.to_string()),
        Ok(Ok(fit)) => fit,
    };
    let points: usize = films.iter().map(|film| film.times().len()).sum();
    let aicc = aicc(points, constants.len(), standard_deviation);
    GrowthRow {
        law: law.name.clone(),
        constants,
        standard_deviation,
        aicc,
        thicknesses,
        reason: String::new(),
    }
}

/// The criterion by the standard deviation of a fit of so many constants; NaN with too few points.
fn aicc(points: usize, constants: usize, standard_deviation: f64) -> f64 {
    let (n, k) = (points as f64, constants as f64 + 1.0);
    if n <= k + 1.0 {
        return f64::NAN;
    }
    let squares = standard_deviation * standard_deviation * (n - constants as f64);
    // Perfect fits have residuals of rounding errors.
    n * (squares / n).max(f64::MIN_POSITIVE).ln() + 2.0 * k + 2.0 * k * (k + 1.0) / (n - k - 1.0)
}

impl GrowthComparison {
    /// All laws, the one with the smallest criterion first.
    pub fn rows(&self) -> &[GrowthRow] {
        &self.rows
    }

    /// A line for each law: differences of the criterion, standard deviations and constants with their 95 %
    /// intervals, or the reason of a failure.
    pub fn summary(&self) -> String {
        let points: usize = self.films.iter().map(|film| film.times().len()).sum();
        let mut text = format!("{} films, {points} points\n", self.films.len());
        let best = self.rows.first().map_or(f64::NAN, |row| row.aicc);
        for row in &self.rows {
            // Writing to a string cannot fail.
            if row.reason.is_empty() {
                let deviation = 1e9 * row.standard_deviation;
                let _ =
                    write!(text, "{}: AICc + {:.1}, deviation {deviation:.2} nm", row.law, row.aicc - best);
                for FittedConstant { name, value, interval: [low, high] } in &row.constants {
                    let _ = write!(text, "; {name} {value:.3e} ({low:.2e} to {high:.2e})");
                }
                let _ = writeln!(text);
            } else {
                let _ = writeln!(text, "{}: not fitted: {}", row.law, row.reason);
            }
        }
        text
    }

    /// The fits as CSV: law, criterion, standard deviation \[m\], constants, reason.
    pub fn to_csv(&self) -> String {
        let mut text = String::from("law,aicc,standard_deviation_m,constants,reason\n");
        let quoted = |field: &str| format!("\"{}\"", field.replace('"', "\"\""));
        let number = |value: f64| if value.is_nan() { String::new() } else { format!("{value:e}") };
        for row in &self.rows {
            let constants: Vec<String> =
                row.constants.iter().map(|c| format!("{}={:e}", c.name, c.value)).collect();
            let _ = writeln!(
                text,
                "{},{},{},{},{}",
                quoted(&row.law),
                number(row.aicc),
                number(row.standard_deviation),
                quoted(&constants.join(";")),
                quoted(&row.reason)
            );
        }
        text
    }
}
