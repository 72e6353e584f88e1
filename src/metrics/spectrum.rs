//! Power spectral densities.

use num_complex::Complex64;
use rustfft::FftDirection;

use super::roughness::{mean, require_heights};
use crate::boundary::Boundary;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::Fft2;

/// Direction of profiles.
///
/// # Examples
///
/// ```
/// use stribeck::metrics::{Axis, profile_spectrum};
/// use stribeck::{Boundary, Grid};
/// let grid = Grid::centred(64, 8, 1e-6, 1e-6)?;
/// let waves: Vec<f64> = grid.nodes().map(|(x, _)| (x * std::f64::consts::TAU / 16e-6).sin()).collect();
/// let along = profile_spectrum(&grid, &waves, Axis::X, Boundary::Periodic)?;
/// let top = along.density.iter().copied().fold(0.0, f64::max);
/// let highest = along.density.iter().position(|density| *density == top).unwrap();
/// assert!((along.wavenumber[highest] * 16e-6 / std::f64::consts::TAU - 1.0).abs() < 1e-9);
/// let across = profile_spectrum(&grid, &waves, Axis::Y, Boundary::Periodic)?;
/// assert!(across.density.iter().all(|density| *density < 1e-20 * top));
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Axis {
    /// Rows.
    X,
    /// Columns.
    Y,
}

/// A density over wave numbers `q = 2 pi / wavelength`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Spectrum {
    /// Wave numbers \[1/m\], increasing, without zero.
    pub wavenumber: Vec<f64>,
    /// Density: \[m^4\] for areas, \[m^3\] for profiles.
    pub density: Vec<f64>,
}

/// Mean of the areal density `C(q_x, q_y) = |h(q)|^2 / A` over rings of equal `|q|` \[m^4\], with
/// `h(q) = dx dy sum z exp(-i q x)` and A the area: `Sq^2 = 1/(4 pi^2)` times the integral of C over the
/// plane of q.
///
/// Rings are as wide as the smaller of the two wave-number steps and extend to the smaller of the two Nyquist
/// wave numbers. An open surface is first weighted with the product of two Hann windows of mean square 1,
/// which suppresses the spectrum of its edges.
///
/// Source: Jacobs, T. D. B., Junge, T. and Pastewka, L. (2017), Surface Topography: Metrology and Properties
/// 5, 013001.
///
/// # Errors
/// Heights that do not fit the grid or are not finite, a grid with fewer than 4 nodes along an axis.
///
/// ```
/// use stribeck::{Boundary, Grid, metrics::radial_spectrum};
/// let grid = Grid::centred(64, 64, 1e-6, 1e-6)?;
/// let wave: Vec<f64> = grid.nodes().map(|(x, _)| 1e-9 * (x * std::f64::consts::TAU / 8e-6).sin()).collect();
/// let spectrum = radial_spectrum(&grid, &wave, Boundary::Periodic)?;
/// let peak = spectrum.density.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map(|(k, _)| k);
/// assert_eq!(peak, Some(7)); // 64 um / 8 um
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn radial_spectrum(grid: &Grid, heights: &[f64], boundary: Boundary) -> Result<Spectrum, InputError> {
    let (nx, ny) = (grid.nx(), grid.ny());
    require_nodes("grid.nx", nx)?;
    require_nodes("grid.ny", ny)?;
    let field = transformed(grid, heights, [boundary, boundary], Fft2::new(nx, ny))?;
    let [step_x, step_y] = [grid.size_x(), grid.size_y()].map(|size| std::f64::consts::TAU / size);
    let step = step_x.min(step_y);
    let nyquist = (step_x * (nx / 2) as f64).min(step_y * (ny / 2) as f64);
    let rings = (nyquist / step * (1.0 + 1e-9)) as usize;
    let (mut sums, mut counts) = (vec![0.0; rings], vec![0_usize; rings]);
    let area = grid.size_x() * grid.size_y();
    let scale = grid.cell_area() * grid.cell_area() / area;
    for (k, value) in field.iter().enumerate() {
        let (i, j) = (k % nx, k / nx);
        let q = (i.min(nx - i) as f64 * step_x).hypot(j.min(ny - j) as f64 * step_y);
        let ring = (q / step + 0.5) as usize;
        if (1..=rings).contains(&ring) {
            sums[ring - 1] += value.norm_sqr() * scale;
            counts[ring - 1] += 1;
        }
    }
    let rings = sums.iter().zip(&counts).enumerate().filter(|(_, (_, count))| **count > 0);
    let (wavenumber, density) =
        rings.map(|(ring, (sum, count))| ((ring + 1) as f64 * step, sum / *count as f64)).unzip();
    Ok(Spectrum { wavenumber, density })
}

/// Mean of the one-sided density `C(q) = |h(q)|^2 / L` of all profiles along `axis` \[m^3\], with
/// `h(q) = d sum z exp(-i q x)` and the length L: `Rq^2 = 1/pi` times the integral of C over q > 0.
///
/// Profiles of an open surface are weighted with a Hann window of mean square 1. The mean of the whole
/// surface is removed.
///
/// Source: Jacobs, T. D. B., Junge, T. and Pastewka, L. (2017), Surface Topography: Metrology and Properties
/// 5, 013001.
///
/// # Errors
/// Heights that do not fit the grid or are not finite, fewer than 4 nodes along the axis.
///
/// ```
/// use stribeck::{Boundary, Grid, metrics::{Axis, profile_spectrum}};
/// let grid = Grid::centred(64, 4, 1e-6, 1e-6)?;
/// let wave: Vec<f64> = grid.nodes().map(|(x, _)| 1e-9 * (x * std::f64::consts::TAU / 8e-6).sin()).collect();
/// let spectrum = profile_spectrum(&grid, &wave, Axis::X, Boundary::Periodic)?;
/// let variance: f64 = spectrum.density.iter().sum::<f64>() * spectrum.wavenumber[0] / std::f64::consts::PI;
/// assert!((variance / 0.5e-18 - 1.0).abs() < 1e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn profile_spectrum(
    grid: &Grid,
    heights: &[f64],
    axis: Axis,
    boundary: Boundary,
) -> Result<Spectrum, InputError> {
    let (nx, ny) = (grid.nx(), grid.ny());
    let (points, profiles, spacing, along) = match axis {
        Axis::X => (nx, ny, grid.dx(), [boundary, Boundary::Periodic]),
        Axis::Y => (ny, nx, grid.dy(), [Boundary::Periodic, boundary]),
    };
    require_nodes(if axis == Axis::X { "grid.nx" } else { "grid.ny" }, points)?;
    // transform of both axes, summed over one: the mean over its profiles (Parseval)
    let field = transformed(grid, heights, along, Fft2::new(nx, ny))?;
    let length = spacing * points as f64;
    let scale = spacing * spacing / length / (profiles * profiles) as f64;
    let mut density = vec![0.0; points / 2];
    for (k, value) in field.iter().enumerate() {
        let i = if axis == Axis::X { k % nx } else { k / nx };
        let folded = i.min(points - i);
        if folded > 0 {
            // both signs of q share a value; the Nyquist wave number has one sign
            let share = if 2 * folded == points { 1.0 } else { 0.5 };
            density[folded - 1] += share * value.norm_sqr() * scale;
        }
    }
    let step = std::f64::consts::TAU / length;
    let wavenumber = (1..=density.len()).map(|k| k as f64 * step).collect();
    Ok(Spectrum { wavenumber, density })
}

fn require_nodes(field: &str, count: usize) -> Result<(), InputError> {
    InputError::require(count >= 4, field, count as f64, "at least 4 for a spectrum")
}

/// Transform of the deviations from the mean, windowed along open axes.
fn transformed(
    grid: &Grid,
    heights: &[f64],
    [along_x, along_y]: [Boundary; 2],
    mut transform: Fft2,
) -> Result<Vec<Complex64>, InputError> {
    InputError::require_len("heights", heights, grid.len())?;
    require_heights(heights)?;
    let mean = mean(heights.iter().copied());
    let (wx, wy) = (window(grid.nx(), along_x), window(grid.ny(), along_y));
    let mut field = Vec::with_capacity(grid.len());
    for (row, y) in heights.chunks_exact(grid.nx()).zip(&wy) {
        field.extend(row.iter().zip(&wx).map(|(z, x)| Complex64::new((z - mean) * x * y, 0.0)));
    }
    transform.process(&mut field, FftDirection::Forward);
    Ok(field)
}

/// Hann window of mean square 1, or ones for a periodic axis.
fn window(points: usize, boundary: Boundary) -> Vec<f64> {
    match boundary {
        Boundary::Periodic => vec![1.0; points],
        Boundary::Open => {
            let turn = std::f64::consts::TAU / points as f64;
            (0..points).map(|i| (2.0 / 3.0_f64).sqrt() * (1.0 - (turn * i as f64).cos())).collect()
        }
    }
}
