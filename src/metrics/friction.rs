//! Friction from the boundary film and from shear of the lubricant.

use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Rheology;

/// Overwrites `shear` \[Pa\] with the shear stress of the lubricant at each node, that of `rheology` at the
/// shear rate `|u_s| / h`.
///
/// `viscosity` \[Pa s\] and `film` \[m\] are fields of one length, `sliding_speed` \[m/s\] is the difference
/// of the surface speeds (its sign does not matter). Nodes without a film (`film <= 0`) have no viscous
/// shear: the boundary film carries them. Gaps count as full: where the fluid cavitates, multiply the stress by
/// the film fraction `theta`. Real lubricants shear at some 5 to 10 % of the pressure at most; a
/// Newtonian one without a limit is far too stiff in a concentrated contact. A limit of `rheology` by the
/// pressure, which is not known here, is left out: see [`Rheology::shear_stress_under`].
///
/// # Errors
/// Slices of different lengths, values that are not finite, a negative viscosity.
///
/// ```
/// let mut shear = [0.0; 2];
/// let oil = stribeck::lubricant::Rheology::newtonian().with_limit(1e6)?;
/// stribeck::metrics::viscous_shear_into(&[0.1, 10.0], &[1e-6, 1e-6], -0.5, &oil, &mut shear)?;
/// assert!((shear[0] - 5e4).abs() < 1e-9 && (shear[1] - 1e6).abs() < 1e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn viscous_shear_into(
    viscosity: &[f64],
    film: &[f64],
    sliding_speed: f64,
    rheology: &Rheology,
    shear: &mut [f64],
) -> Result<(), InputError> {
    fill_shear((viscosity, film), sliding_speed, |_, eta, rate| rheology.shear_stress(eta, rate), shear)
}

/// [`viscous_shear_into`] with the `stress` \[Pa\] of a node by its number, viscosity \[Pa s\] and shear
/// rate \[1/s\].
pub(crate) fn fill_shear(
    (viscosity, film): (&[f64], &[f64]),
    sliding_speed: f64,
    stress: impl Fn(usize, f64, f64) -> f64,
    shear: &mut [f64],
) -> Result<(), InputError> {
    InputError::require_len("film", film, viscosity.len())?;
    InputError::require_len("shear", shear, viscosity.len())?;
    InputError::require_finite("film", film)?;
    InputError::require(sliding_speed.is_finite(), "sliding_speed", sliding_speed, "finite")?;
    if let Some(&bad) = viscosity.iter().find(|v| !(v.is_finite() && **v >= 0.0)) {
        return InputError::require_non_negative("viscosity", bad);
    }
    let speed = sliding_speed.abs();
    for (k, ((tau, eta), h)) in shear.iter_mut().zip(viscosity).zip(film).enumerate() {
        *tau = if *h > 0.0 { stress(k, *eta, speed / h) } else { 0.0 };
    }
    Ok(())
}

/// Coefficient of friction: `(mu_b sum p_solid + sum tau) dA / load`.
///
/// `solid_pressure` \[Pa\] is the pressure that solid contact carries, `viscous_shear` \[Pa\] the shear
/// stress of the lubricant (see [`viscous_shear_into`]), `boundary_friction` the coefficient of the boundary
/// film, `load` in N.
///
/// # Errors
/// Fields that do not fit the grid or are not finite, a negative boundary friction, a load that is not
/// positive.
///
/// ```
/// use stribeck::{Grid, metrics::friction_coefficient};
/// let grid = Grid::centred(2, 1, 1e-6, 1e-6)?;
/// let mu = friction_coefficient(&grid, 0.1, &[1e9, 0.0], &[0.0, 2e7], 1e-3)?;
/// assert!((mu - 0.12).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn friction_coefficient(
    grid: &Grid,
    boundary_friction: f64,
    solid_pressure: &[f64],
    viscous_shear: &[f64],
    load: f64,
) -> Result<f64, InputError> {
    InputError::require_non_negative("boundary_friction", boundary_friction)?;
    InputError::require_positive("load", load)?;
    for (field, values) in [("solid_pressure", solid_pressure), ("viscous_shear", viscous_shear)] {
        grid.require_field(field, values)?;
    }
    let boundary = boundary_friction * solid_pressure.iter().sum::<f64>();
    let viscous = viscous_shear.iter().sum::<f64>();
    Ok((boundary + viscous) * grid.cell_area() / load)
}
