//! Hybrid parameters: slope and area (ISO 25178-2).

use super::mask::Mask;
use crate::error::InputError;
use crate::grid::Grid;

/// Hybrid parameters.
///
/// # Examples
///
/// ```
/// use stribeck::metrics::hybrid_parameters;
/// use stribeck::Grid;
/// let grid = Grid::centred(512, 8, 1e-6, 1e-6)?;
/// let wave: Vec<f64> = grid.nodes().map(|(x, _)| 1e-7 * (x * std::f64::consts::TAU / 64e-6).sin()).collect();
/// let slope = hybrid_parameters(&grid, &wave, None)?.sdq;
/// // For a sine: amplitude times wave number over the square root of two.
/// let exact = 1e-7 * std::f64::consts::TAU / 64e-6 / 2.0_f64.sqrt();
/// assert!((slope / exact - 1.0).abs() < 0.01);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct HybridParameters {
    /// Root mean square gradient; of a line the slope along it alone.
    pub sdq: f64,
    /// Developed area over projected area, less 1; of a line its developed length over its projected one, less 1; NaN where no
    /// point has defined neighbors along both axes.
    pub sdr: f64,
}

/// Gradient and developed area of `heights` \[m\] on `grid`, where `defined` (`None`: everywhere).
///
/// ```text
/// Sdq = sqrt(mean (dz/dx)^2 + mean (dz/dy)^2)      Sdr = mean (sqrt(1 + (dz/dx)^2 + (dz/dy)^2) - 1)
/// ```
///
/// Slopes are those of the seven-point formula
/// `(z[i+3] - 9 z[i+2] + 45 z[i+1] - 45 z[i-1] + 9 z[i-2] - z[i-3]) / (60 dx)`
/// at points whose seven points are defined. Where an axis has no such point, or no point has it along both axes, the
/// formula of five, three or two points stands in. A line (one row or one column) has the slope along it alone, and Sdr is
/// the excess of its length. Both parameters grow with the resolution of a surface that is rough at every scale: filter
/// first.
///
/// Sources: ISO 25178-2 (definitions), ISO 4287:1997, 3.2.9 (formula).
///
/// # Errors
/// Slices that do not fit the grid, a defined height that is not finite, no two defined neighbours.
///
/// ```
/// use stribeck::{Grid, metrics::hybrid_parameters};
/// let grid = Grid::centred(8, 8, 1e-6, 1e-6)?;
/// let ramp: Vec<f64> = grid.nodes().map(|(x, y)| 0.3 * x + 0.4 * y).collect();
/// let hybrid = hybrid_parameters(&grid, &ramp, None)?;
/// assert!((hybrid.sdq - 0.5).abs() < 1e-9);
/// assert!((hybrid.sdr - (1.25_f64.sqrt() - 1.0)).abs() < 1e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn hybrid_parameters(
    grid: &Grid,
    heights: &[f64],
    defined: Option<&[bool]>,
) -> Result<HybridParameters, InputError> {
    let mask = Mask::new(grid, heights, defined)?;
    let (nx, ny) = (grid.nx(), grid.ny());
    let field = Field { mask, heights };
    let axes = [
        (Line { points: nx, lines: ny, step: 1, between: nx }, grid.dx()),
        (Line { points: ny, lines: nx, step: nx, between: 1 }, grid.dy()),
    ];
    let is_line = nx == 1 || ny == 1;
    let has_both = |[along_x, along_y]: &[Slopes<'_>; 2]| {
        (0..heights.len()).any(|k| along_x.at(k % nx, k).is_some() && along_y.at(k / nx, k).is_some())
    };
    let best = axes.map(|(line, spacing)| Slopes::of(&field, line, spacing));
    let [along_x, along_y] = if is_line || has_both(&best) {
        best
    } else {
        let formulas = CENTRAL.into_iter().map(Some).chain([None]);
        let of_both = |weights| axes.map(|(line, spacing)| Slopes { field: &field, line, spacing, weights });
        formulas.map(of_both).find(has_both).unwrap_or(best)
    };
    let (mut square_x, mut square_y, mut area) = (Mean::default(), Mean::default(), Mean::default());
    for k in 0..heights.len() {
        let (i, j) = (k % nx, k / nx);
        let (p, q) = (along_x.at(i, k), along_y.at(j, k));
        p.iter().for_each(|p| square_x.add(p * p));
        q.iter().for_each(|q| square_y.add(q * q));
        match (p, q) {
            (Some(p), Some(q)) => area.add(excess(p * p + q * q)),
            (Some(slope), None) | (None, Some(slope)) if is_line => area.add(excess(slope * slope)),
            _ => {}
        }
    }
    if square_x.count + square_y.count == 0 {
        return Err(InputError::Conflict {
            field: "heights".to_owned(),
            reason: "slopes need two defined neighbors".to_owned(),
        });
    }
    let sdr = if area.count > 0 { area.value() } else { f64::NAN };
    Ok(HybridParameters { sdq: (square_x.value() + square_y.value()).sqrt(), sdr })
}

/// Weights of a slope on both sides of a point, by distance, over the spacing: of seven, five and three points.
const CENTRAL: [&[f64]; 3] = [&[45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0], &[8.0 / 12.0, -1.0 / 12.0], &[0.5]];

/// Heights of which some are undefined.
struct Field<'a> {
    mask: Mask<'a>,
    heights: &'a [f64],
}

/// The lines of points along an axis.
#[derive(Clone, Copy)]
struct Line {
    /// Points of a line.
    points: usize,
    /// Number of lines.
    lines: usize,
    /// From a point to the next.
    step: usize,
    /// From a line to the next.
    between: usize,
}

/// Slopes along an axis by the formula of most points that applies anywhere.
struct Slopes<'a> {
    field: &'a Field<'a>,
    line: Line,
    spacing: f64,
    /// Weights of a central formula; `None` for the difference to the next point.
    weights: Option<&'static [f64]>,
}

impl<'a> Slopes<'a> {
    fn of(field: &'a Field<'a>, line: Line, spacing: f64) -> Self {
        let with = |weights| Self { field, line, spacing, weights };
        let applies = |slopes: &Self| {
            let places = (0..line.lines).flat_map(|l| (0..line.points).map(move |p| (p, l)));
            places.into_iter().any(|(p, l)| slopes.at(p, p * line.step + l * line.between).is_some())
        };
        CENTRAL.into_iter().map(|weights| with(Some(weights))).find(applies).unwrap_or(with(None))
    }

    /// The slope at point `place` of its line, which is value `k`; `None` where the formula does not apply.
    fn at(&self, place: usize, k: usize) -> Option<f64> {
        let Field { mask, heights } = self.field;
        let (step, last) = (self.line.step, self.line.points - 1);
        let Some(weights) = self.weights else {
            let defined = place < last && mask.has(k) && mask.has(k + step);
            return defined.then(|| (heights[k + step] - heights[k]) / self.spacing);
        };
        if place < weights.len() || place + weights.len() > last || !mask.has(k) {
            return None;
        }
        let mut sum = 0.0;
        for (n, weight) in weights.iter().enumerate() {
            let (before, after) = (k - (n + 1) * step, k + (n + 1) * step);
            if !(mask.has(before) && mask.has(after)) {
                return None;
            }
            sum += weight * (heights[after] - heights[before]);
        }
        Some(sum / self.spacing)
    }
}

/// `sqrt(1 + squared) - 1` without cancellation.
fn excess(squared: f64) -> f64 {
    squared / ((1.0 + squared).sqrt() + 1.0)
}

/// Running mean.
#[derive(Default)]
struct Mean {
    /// Sum of the values.
    sum: f64,
    /// Number of the values.
    count: usize,
}

impl Mean {
    /// Adds a value.
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1;
    }

    /// The mean, or zero without values.
    fn value(&self) -> f64 {
        self.sum / self.count.max(1) as f64
    }
}
