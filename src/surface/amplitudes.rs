//! Amplitudes of the waves of a random surface.
//!
//! A random surface is white noise whose transform is multiplied by the square root of a spectral density. For an
//! autocorrelation function the density is its transform, for a self-affine surface a power of the wave number
//! between its cut-offs. For heights with a Johnson distribution it is the density of the normal deviates that they
//! are computed from.

use super::autocorrelation::Autocorrelation;
use super::johnson::Johnson;
use super::random_shape::RandomShape;
use crate::grid::Grid;
use crate::numerics::{RealFft2, map_lines};

/// Factors on white noise that give normal deviates the requested correlation.
pub(super) struct Amplitudes {
    /// Factors for 0 to `nx / 2` by 0 to `ny / 2` waves, of any scale; the other waves are their mirror images.
    pub(super) waves: Vec<f64>,
    /// Sum of their squares over all `nx` by `ny` waves.
    pub(super) power: f64,
}

/// Mean of the surface.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Mean {
    /// Zero.
    Zero,
    /// Random, like the adjacent waves: for patches of an infinite surface.
    Drawn,
}

impl Amplitudes {
    /// Amplitudes of `shape` on the waves of `grid`.
    pub(super) fn new(
        shape: &RandomShape,
        johnson: Option<&Johnson>,
        grid: &Grid,
        transform: &RealFft2,
        mean: Mean,
    ) -> Self {
        let (width, height) = (grid.nx() / 2 + 1, grid.ny() / 2 + 1);
        let mut waves = density(shape, johnson, grid, transform);
        // negative values are errors of rounding and wrapping
        map_lines(&mut waves, width, |_, row| row.iter_mut().for_each(|value| *value = value.max(0.0)));
        if mean == Mean::Zero {
            waves[0] = 0.0;
        }
        let stands_for = |k: usize, n: usize| if k == 0 || 2 * k == n { 1.0 } else { 2.0 };
        let along_x = |row: &[f64]| (0..width).map(|i| stands_for(i, grid.nx()) * row[i]).sum::<f64>();
        let power = (0..height).map(|j| stands_for(j, grid.ny()) * along_x(&waves[j * width..])).sum();
        map_lines(&mut waves, width, |_, row| row.iter_mut().for_each(|value| *value = value.sqrt()));
        Self { waves, power }
    }
}

/// The spectral density of normal deviates in a quarter of the waves.
fn density(shape: &RandomShape, johnson: Option<&Johnson>, grid: &Grid, transform: &RealFft2) -> Vec<f64> {
    let width = grid.nx() / 2 + 1;
    let mut correlation = match *shape {
        RandomShape::Correlated { autocorrelation: Autocorrelation::Gaussian, length_x, length_y }
            if johnson.is_none() =>
        {
            return gaussian_density(grid, [length_x, length_y]);
        }
        RandomShape::Correlated { autocorrelation, length_x, length_y } => {
            autocorrelation.quarter(grid, [length_x, length_y])
        }
        RandomShape::SelfAffine(spectrum) => {
            let density = spectrum.density_quarter(grid);
            if johnson.is_none() {
                return density;
            }
            transform.symmetric(&density)
        }
    };
    if let Some(johnson) = johnson {
        let table = CorrelationTable::new(johnson.correlations());
        let variance = correlation[0];
        map_lines(&mut correlation, width, |_, row| {
            row.iter_mut().for_each(|value| *value = table.needed(*value / variance));
        });
    }
    transform.symmetric(&correlation)
}

/// Fraction of the largest density below which a density is mostly rounding error of its transform. Square roots of
/// such values would differ between processors.
const ROUNDING: f64 = 1e-14;

/// Density of the Gaussian autocorrelation, a product of functions of x and of y.
fn gaussian_density(grid: &Grid, [length_x, length_y]: [f64; 2]) -> Vec<f64> {
    let along = |n: usize, spacing: f64, length: f64| {
        let square = |k: usize| (k as f64 * spacing / length).powi(2);
        let line: Vec<f64> = (0..=n / 2).map(|k| Autocorrelation::Gaussian.at(square(k))).collect();
        let mut density = RealFft2::new(n, 1).symmetric(&line);
        let least = ROUNDING * density[0];
        density.iter_mut().filter(|value| **value < least).for_each(|value| *value = 0.0);
        density
    };
    let (x, y) = (along(grid.nx(), grid.dx(), length_x), along(grid.ny(), grid.dy(), length_y));
    y.iter().flat_map(|y| x.iter().map(move |x| x * y)).collect()
}

/// Correlations of normal deviates as a function of those of the transformed ones.
struct CorrelationTable {
    /// Pairs `(requested, needed)`, both increasing.
    pairs: Vec<(f64, f64)>,
    /// For each bin of the requested range: the first pair at or above its lower end.
    starts: Vec<usize>,
    /// Bins per unit of the requested correlation.
    shares_per_unit: f64,
}

impl CorrelationTable {
    /// A table of pairs, at least two.
    fn new(pairs: Vec<(f64, f64)>) -> Self {
        let (lowest, highest) = (pairs[0].0, pairs[pairs.len() - 1].0);
        let shares_per_unit = pairs.len() as f64 / (highest - lowest);
        let lower_end = |share: usize| lowest + share as f64 / shares_per_unit;
        let starts =
            (0..=pairs.len()).map(|share| pairs.partition_point(|pair| pair.0 < lower_end(share))).collect();
        Self { pairs, starts, shares_per_unit }
    }

    /// Linear between the pairs, constant outside.
    fn needed(&self, requested: f64) -> f64 {
        let share = (requested - self.pairs[0].0) * self.shares_per_unit;
        let last = self.pairs.len() - 1;
        // conversion of a negative value gives 0
        let start = self.starts[(share as usize).min(last)].saturating_sub(1);
        let further = self.pairs[start..].iter().take_while(|pair| pair.0 < requested).count();
        let high = (start + further).clamp(1, last);
        let ((x0, y0), (x1, y1)) = (self.pairs[high - 1], self.pairs[high]);
        y0 + (y1 - y0) * ((requested - x0) / (x1 - x0)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amplitudes_are_independent_of_transform_rounding() {
        let grid = Grid::centred(256, 1, 1.0, 1.0).unwrap();
        for length_x in [3.0, 20.0, 256.0] {
            let shape = RandomShape::Correlated {
                autocorrelation: Autocorrelation::Gaussian,
                length_x,
                length_y: 1.0,
            };
            let found = Amplitudes::new(&shape, None, &grid, &RealFft2::new(256, 1), Mean::Zero);
            let value = |k: usize| Autocorrelation::Gaussian.at((k as f64 / length_x).powi(2));
            // summed directly, smallest terms first
            let density = |wave: usize| {
                let term = |k: usize| {
                    value(k.min(256 - k)) * (std::f64::consts::TAU * (k * wave % 256) as f64 / 256.0).cos()
                };
                (0..=128)
                    .rev()
                    .map(|k| if k % 128 == 0 { term(k) } else { term(k) + term(256 - k) })
                    .sum::<f64>()
            };
            let largest = density(0).sqrt();
            for (wave, amplitude) in found.waves.iter().enumerate().skip(1) {
                let direct = density(wave);
                let direct = if direct < 1e-14 * density(0) { 0.0 } else { direct.sqrt() };
                assert!(
                    (amplitude - direct).abs() < 3e-9 * largest,
                    "{length_x}, {wave}: {amplitude:e} {direct:e}"
                );
            }
        }
    }

    #[test]
    fn needed_correlations_are_interpolated_from_the_table() {
        let johnson = Johnson::new(-1.0, 5.0).unwrap();
        let pairs = johnson.correlations();
        let table = CorrelationTable::new(pairs.clone());
        let (lowest, highest) = (pairs[0], pairs[pairs.len() - 1]);
        assert!((table.needed(lowest.0 - 0.1) - lowest.1).abs() < 1e-15);
        assert!((table.needed(2.0) - highest.1).abs() < 1e-15);
        for k in 0..10_000 {
            let requested = lowest.0 + (highest.0 - lowest.0) * f64::from(k) / 9999.0;
            let high = pairs.iter().position(|pair| pair.0 >= requested).unwrap_or(pairs.len() - 1).max(1);
            let needed = table.needed(requested);
            assert!((pairs[high - 1].1..=pairs[high].1 + 1e-15).contains(&needed), "{requested}: {needed}");
        }
    }
}
