//! Film thickness measures.

use super::ellipse::Ellipse;
use crate::error::InputError;
use crate::grid::Grid;

/// Share of the Hertz radii that bounds the central region.
pub(crate) const CENTRAL: f64 = 2.0 / 3.0;

/// Mean central film \[m\]: the mean of `max(film, 0)` over the nodes with
/// `(x/a_x)^2 + (y/a_y)^2 <= (2/3)^2`, for Hertz semi-axes `a_x`, `a_y` \[m\] at the origin of the grid.
///
/// Negative gaps (overlaps in a solution with errors) count as zero.
/// Source: Zhu, D. and Hu, Y. Z. (2001), Tribology Transactions 44, 383-390 (the two-thirds region).
///
/// # Errors
/// A film that does not fit the grid or is not finite, semi-axes that are not positive, no node in the
/// region.
///
/// ```
/// use stribeck::{Grid, metrics::mean_central_film};
/// let grid = Grid::centred(16, 16, 1e-6, 1e-6)?;
/// let mean = mean_central_film(&grid, &[5e-9; 256], 6e-6, 6e-6)?;
/// assert!((mean - 5e-9).abs() < 1e-20);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn mean_central_film(grid: &Grid, film: &[f64], a_x: f64, a_y: f64) -> Result<f64, InputError> {
    mean_central_film_in(grid, film, &Ellipse::upright(a_x, a_y)?)
}

/// Mean central film for an ellipse at any angle.
pub(crate) fn mean_central_film_in(grid: &Grid, film: &[f64], ellipse: &Ellipse) -> Result<f64, InputError> {
    grid.require_field("film", film)?;
    let (mut sum, mut count) = (0.0, 0_usize);
    for ((x, y), h) in grid.nodes().zip(film) {
        if is_central(x, y, ellipse) {
            sum += h.max(0.0);
            count += 1;
        }
    }
    if count == 0 {
        return Err(InputError::Conflict {
            field: "a_x, a_y".to_owned(),
            reason: "no node of the grid lies within two thirds of the Hertz radii".to_owned(),
        });
    }
    Ok(sum / count as f64)
}

/// Whether the point lies in the central region.
pub(crate) fn is_central(x: f64, y: f64, ellipse: &Ellipse) -> bool {
    ellipse.radius_squared(x, y) <= CENTRAL * CENTRAL
}

/// Smallest film \[m\] among the nodes with `pressure` > 0; `None` without such nodes.
///
/// # Errors
/// Slices of different lengths, values that are not finite.
///
/// ```
/// let least = stribeck::metrics::minimum_film(&[3e-9, 1e-9, 2e-9], &[1e6, 0.0, 1e6])?;
/// assert_eq!(least, Some(2e-9));
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn minimum_film(film: &[f64], pressure: &[f64]) -> Result<Option<f64>, InputError> {
    InputError::require_len("pressure", pressure, film.len())?;
    InputError::require_finite("film", film)?;
    InputError::require_finite("pressure", pressure)?;
    let loaded = film.iter().zip(pressure).filter(|&(_, &p)| p > 0.0);
    Ok(loaded.map(|(&h, _)| h).min_by(f64::total_cmp))
}

/// Smallest value \[m\] of a gap, including negative values: the largest overlap of the surfaces.
///
/// # Errors
/// An empty slice, a value that is not finite.
///
/// ```
/// let least = stribeck::metrics::minimum_gap(&[3e-9, -1e-9])?;
/// assert!((least + 1e-9).abs() < 1e-24);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn minimum_gap(gap: &[f64]) -> Result<f64, InputError> {
    InputError::require_finite("gap", gap)?;
    gap.iter().copied().min_by(f64::total_cmp).ok_or_else(|| InputError::Shape {
        field: "gap".to_owned(),
        expected: 1,
        found: 0,
    })
}

/// Film over roughness, `film / composite_rq`; infinite for perfectly smooth surfaces.
///
/// # Errors
/// A film or a roughness that is negative or not finite; both zero.
///
/// ```
/// let lambda = stribeck::metrics::lambda_ratio(9.36e-9, 131.5e-9)?;
/// assert!((lambda - 0.071).abs() < 0.001);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn lambda_ratio(film: f64, composite_rq: f64) -> Result<f64, InputError> {
    InputError::require_non_negative("film", film)?;
    InputError::require_non_negative("composite_rq", composite_rq)?;
    let defined = film > 0.0 || composite_rq > 0.0;
    InputError::require(defined, "composite_rq", composite_rq, "above zero where the film is zero")?;
    Ok(film / composite_rq)
}
