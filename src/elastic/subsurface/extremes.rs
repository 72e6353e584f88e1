//! The largest stresses over depth.

use super::{StressField, subsurface_stress};
use crate::error::InputError;
use crate::grid::Grid;

/// A largest stress and its position.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::elastic::stress_extremes;
/// // A band of constant pressure of half-width a: the largest orthogonal shear lies below its edges.
/// let grid = Grid::centred(161, 1, 0.025, 1.0)?;
/// let pressure: Vec<f64> = grid.nodes().map(|(x, _)| if x.abs() < 1.0 { 1e9 } else { 0.0 }).collect();
/// let depths: Vec<f64> = (0..20).map(|k| 0.1 * f64::from(k)).collect();
/// let largest = stress_extremes(&grid, 0.3, &depths, &pressure, None)?.orthogonal_shear;
/// assert!((largest.x.abs() - 1.0).abs() < 0.1);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Extreme {
    /// The stress \[Pa\], interpolated between depths by a parabola.
    pub stress: f64,
    /// Its depth \[m\].
    pub depth: f64,
    /// Position along x \[m\].
    pub x: f64,
    /// Position along y \[m\].
    pub y: f64,
}

/// The largest stresses below a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct StressExtremes {
    /// Largest von Mises stress.
    pub von_mises: Extreme,
    /// Largest magnitude of the orthogonal shear stress `xz`, whose range loads a point during each
    /// overrolling: the measure of rolling fatigue of Lundberg and Palmgren (1947), Acta Polytechnica,
    /// Mechanical Engineering Series 1, no. 3. Residual stresses of a rolled surface cannot compensate it.
    /// The elastic shakedown limit of free rolling is therefore reached when it equals the yield stress in
    /// shear (Johnson 1985, Contact Mechanics, section 9.2; exact in plane strain).
    pub orthogonal_shear: Extreme,
}

/// The largest stresses in a half-space of Poisson's ratio `poisson` under `pressure` and `traction` \[Pa\],
/// over the nodes of `grid` and increasing `depths` \[m\]; see [`subsurface_stress`].
///
/// # Errors
/// No depths, depths that do not increase, and the errors of [`subsurface_stress`].
///
/// ```
/// use stribeck::elastic::stress_extremes;
/// use stribeck::Grid;
/// let grid = Grid::centred(65, 65, 1.0 / 30.0, 1.0 / 30.0)?;
/// let pressure: Vec<f64> = grid.nodes().map(|(x, y)| 1e9 * (1.0 - x * x - y * y).max(0.0).sqrt()).collect();
/// let depths: Vec<f64> = (0..12).map(|k| 0.08 * f64::from(k)).collect();
/// let largest = stress_extremes(&grid, 0.3, &depths, &pressure, None)?;
/// assert!((largest.von_mises.depth - 0.48).abs() < 0.01);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn stress_extremes(
    grid: &Grid,
    poisson: f64,
    depths: &[f64],
    pressure: &[f64],
    traction: Option<&[f64]>,
) -> Result<StressExtremes, InputError> {
    require_increasing(depths)?;
    let (mut mises, mut shear) = (Vec::new(), Vec::new());
    for &depth in depths {
        let field = subsurface_stress(grid, poisson, depth, pressure, traction)?;
        mises.push(largest(field.von_mises()));
        shear.push(largest(orthogonal(&field)));
    }
    Ok(StressExtremes { von_mises: over(grid, depths, &mises), orthogonal_shear: over(grid, depths, &shear) })
}

/// Rejects an empty list of depths and depths that do not increase.
pub(in crate::elastic) fn require_increasing(depths: &[f64]) -> Result<(), InputError> {
    if !depths.is_empty() && depths.windows(2).all(|pair| pair[0] < pair[1]) {
        return Ok(());
    }
    let reason = "must be increasing, and at least one".to_owned();
    Err(InputError::Conflict { field: "depths".to_owned(), reason })
}

/// Magnitude of the orthogonal shear stress under each node.
pub(in crate::elastic) fn orthogonal(field: &StressField) -> impl Iterator<Item = f64> + '_ {
    field.xz.iter().map(|stress| stress.abs())
}

/// Node and value of the largest stress.
pub(in crate::elastic) fn largest(values: impl Iterator<Item = f64>) -> (usize, f64) {
    values.enumerate().fold((0, 0.0), |best, (k, value)| if value > best.1 { (k, value) } else { best })
}

/// The largest of the values over depth, at the vertex of the parabola through it and its neighbors.
pub(in crate::elastic) fn over(grid: &Grid, depths: &[f64], values: &[(usize, f64)]) -> Extreme {
    let (k, (node, stress)) = values
        .iter()
        .enumerate()
        .fold((0, (0, 0.0)), |best, (k, value)| if value.1 > best.1.1 { (k, *value) } else { best });
    let (x, y) = (grid.x(node % grid.nx()), grid.y(node / grid.nx()));
    let mut extreme = Extreme { stress, depth: depths[k], x, y };
    if (1..depths.len() - 1).contains(&k) {
        let (before, after) = (depths[k] - depths[k - 1], depths[k + 1] - depths[k]);
        let slopes = [(stress - values[k - 1].1) / before, (values[k + 1].1 - stress) / after];
        // Twice the second divided difference.
        let curvature = 2.0 * (slopes[1] - slopes[0]) / (before + after);
        if curvature < 0.0 {
            let slope = (slopes[0] * after + slopes[1] * before) / (before + after);
            extreme.depth -= slope / curvature;
            extreme.stress -= 0.5 * slope * slope / curvature;
        }
    }
    extreme
}
