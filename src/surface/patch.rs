//! Random surfaces with open edges: patches of larger periodic ones, generated wave by wave.
//!
//! The edges of a patch do not match if the period is longer than the patch. The deviates of a wave do not depend on the
//! grid; each column of waves has its own random stream. Only the patch is transformed back.

use num_complex::Complex64;
use rand_distr::{Distribution, StandardNormal};

use super::amplitudes::{Amplitudes, Mean};
use super::deviates::{cipher, phase};
use super::johnson::Johnson;
use super::random_shape::RandomShape;
use super::self_affine::SelfAffine;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{RealFft2, fast_length};

/// Normal deviates on `grid` with the autocorrelation of `shape`, and their standard deviation over all
/// seeds.
///
/// The spectrum of white noise is white, so the waves of the larger surface are drawn directly, each column of the
/// spectrum from its own stream. The inverse transform computes only the lines of the patch.
pub(super) fn deviates(
    shape: &RandomShape,
    johnson: Option<&Johnson>,
    grid: &Grid,
    seed: u64,
    phases_alone: bool,
) -> Result<(Vec<f64>, f64), InputError> {
    let period = period(shape, grid)?;
    let (nx, ny, width) = (period.nx(), period.ny(), period.nx() / 2 + 1);
    let transform = RealFft2::new(nx, ny);
    let amplitudes = Amplitudes::new(shape, johnson, &period, &transform, Mean::Drawn);
    let field = transform.synthesise([grid.nx(), grid.ny()], |i, column| {
        let amplitude = |j: usize| amplitudes.waves[j.min(ny - j) * width + i];
        if (0..=ny / 2).all(|j| amplitude(j) == 0.0) {
            return false;
        }
        let mut generator = cipher(seed);
        generator.set_stream(i as u64 + 1);
        for value in &mut *column {
            let parts = [(); 2].map(|()| StandardNormal.sample(&mut generator));
            *value = Complex64::new(parts[0], parts[1]) * std::f64::consts::FRAC_1_SQRT_2;
        }
        if i == 0 || 2 * i == nx {
            mirror(column);
        }
        for (j, value) in column.iter_mut().enumerate() {
            if phases_alone {
                *value = phase(*value);
            }
            *value *= amplitude(j);
        }
        true
    });
    Ok((field, amplitudes.power.sqrt()))
}

/// Makes a column Hermitian if its waves along y include their conjugates: real if a wave is its own conjugate.
fn mirror(column: &mut [Complex64]) {
    let ny = column.len();
    for j in 0..=ny / 2 {
        let partner = (ny - j) % ny;
        if partner == j {
            column[j] = Complex64::new(column[j].re * std::f64::consts::SQRT_2, 0.0);
        } else {
            column[partner] = column[j].conj();
        }
    }
}

/// A grid so much larger than `grid` that opposite edges of a patch are nearly uncorrelated: by a margin over which the
/// autocorrelation falls to 2 % or less, up to half the size of `grid`; above that by one over which it falls to 10 % or
/// less.
fn period(shape: &RandomShape, grid: &Grid) -> Result<Grid, InputError> {
    let half = [grid.size_x() / 2.0, grid.size_y() / 2.0];
    let margins = match *shape {
        RandomShape::Correlated { length_x, length_y, .. } => [(length_x, half[0]), (length_y, half[1])]
            .map(|(length, half)| (2.0 * length).min(half.max(length))),
        // waves longer than the roll-off are independent
        RandomShape::SelfAffine(SelfAffine { roll_off, .. }) => half.map(|half| roll_off.min(half)),
    };
    let longer = |n: usize, d: f64, margin: f64| {
        if n == 1 { 1 } else { fast_length(n + (margin / d) as usize + 1) }
    };
    let (nx, ny) = (longer(grid.nx(), grid.dx(), margins[0]), longer(grid.ny(), grid.dy(), margins[1]));
    Grid::centred(nx, ny, grid.dx(), grid.dy())
}
