//! How much of a contact is solid.

use super::film::{normalised_radius_squared, require_semi_axes};
use crate::error::InputError;
use crate::grid::Grid;

/// Size and load of the solid contact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ContactStatistics {
    /// Area of all nodes in contact \[m^2\].
    pub area: f64,
    /// Area of the nodes in contact within the Hertz ellipse over the area of the ellipse `pi a_x a_y`.
    ///
    /// Cells count whole, so complete contact on a coarse grid gives 1 only to within the cells on the rim.
    pub area_ratio: f64,
    /// Share of the load carried by solid contact, over all nodes in contact, within the ellipse or not.
    pub load_ratio: f64,
}

/// Solid contact of the nodes flagged `in_contact`, which carry `solid_pressure` \[Pa\], under `load` \[N\], compared with
/// the Hertz ellipse of semi-axes `a_x`, `a_y` \[m\] centred on the origin of the grid.
///
/// # Errors
/// Slices that do not fit the grid, pressures that are not finite, a load or semi-axes that are not positive.
///
/// ```
/// use stribeck::{Grid, metrics::contact_statistics};
/// let grid = Grid::centred(4, 4, 1e-6, 1e-6)?;
/// let mut in_contact = [false; 16];
/// in_contact[5] = true;
/// let contact = contact_statistics(&grid, &in_contact, &[1e9; 16], 2e-3, 2e-6, 2e-6)?;
/// assert!((contact.area - 1e-12).abs() < 1e-24);
/// assert!((contact.load_ratio - 0.5).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn contact_statistics(
    grid: &Grid,
    in_contact: &[bool],
    solid_pressure: &[f64],
    load: f64,
    a_x: f64,
    a_y: f64,
) -> Result<ContactStatistics, InputError> {
    InputError::require_len("in_contact", in_contact, grid.len())?;
    InputError::require_len("solid_pressure", solid_pressure, grid.len())?;
    InputError::require_finite("solid_pressure", solid_pressure)?;
    InputError::require_positive("load", load)?;
    require_semi_axes(a_x, a_y)?;
    let (mut touching, mut inside, mut pressure) = (0_usize, 0_usize, 0.0);
    for (k, (x, y)) in grid.nodes().enumerate().filter(|&(k, _)| in_contact[k]) {
        touching += 1;
        inside += usize::from(normalised_radius_squared(x, y, a_x, a_y) <= 1.0);
        pressure += solid_pressure[k];
    }
    let cell = grid.cell_area();
    Ok(ContactStatistics {
        area: touching as f64 * cell,
        area_ratio: inside as f64 * cell / (std::f64::consts::PI * a_x * a_y),
        load_ratio: pressure * cell / load,
    })
}
