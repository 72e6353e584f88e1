//! The direct sum over all pairs of nodes: slow and simple, the reference for the convolution.
//!
//! It shares the influence coefficients with the half-space but none of the transforms. Agreement to rounding
//! verifies the convolution.

use super::half_space::influence_table;
use crate::error::InputError;
use crate::grid::Grid;

/// Displacement \[m\] of the half-space under `pressure` \[Pa\] as the plain sum over all pairs of nodes,
/// `O(N^2)`.
///
/// # Errors
/// A pressure that does not fit the grid, a modulus that is not finite and positive.
///
/// ```
/// use stribeck::elastic::direct_displacement;
/// use stribeck::Grid;
/// let grid = Grid::centred(3, 2, 1e-6, 1e-6)?;
/// let u = direct_displacement(&grid, 230e9, &[1e9; 6])?;
/// assert!(u.iter().all(|&u| u > 0.0));
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn direct_displacement(
    grid: &Grid,
    equivalent_modulus: f64,
    pressure: &[f64],
) -> Result<Vec<f64>, InputError> {
    InputError::require_positive("elastic.equivalent_modulus", equivalent_modulus)?;
    InputError::require_len("pressure", pressure, grid.len())?;
    let table = influence_table(grid, equivalent_modulus);
    let (nx, ny) = (grid.nx(), grid.ny());
    let mut out = Vec::with_capacity(grid.len());
    for j in 0..ny {
        for i in 0..nx {
            let mut sum = 0.0;
            for l in 0..ny {
                for k in 0..nx {
                    sum += table[j.abs_diff(l) * nx + i.abs_diff(k)] * pressure[l * nx + k];
                }
            }
            out.push(sum);
        }
    }
    Ok(out)
}
