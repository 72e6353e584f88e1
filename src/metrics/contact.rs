//! Size and load of the solid contact.

use std::f64::consts::{LN_2, PI};

use super::ellipse::Ellipse;
use crate::error::InputError;
use crate::grid::Grid;

/// Excess area per contact transition, in cells: `(pi - 1 + ln 2)/24`, the average over all directions of a
/// straight edge.
const EXCESS: f64 = (PI - 1.0 + LN_2) / 24.0;

/// Area and load share of the solid contact.
///
/// A cell counts as a whole if its node is in contact, which overestimates the area by a share of the cells
/// along the edge. With `M` transitions between contact and gap along all grid lines, the corrected area is
/// `A - c M dx dy`, `c = (pi - 1 + ln 2)/24`. Its error decreases faster with the cell size. On fine grids
/// the limit lies between the two values, so their difference estimates the error without a second solve.
///
/// Source: Yastrebov, V. A., Anciaux, G. and Molinari, J.-F. (2017), Tribology International 114, 161-171.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::metrics::contact_statistics;
/// let grid = Grid::centred(64, 64, 1e-6, 1e-6)?;
/// // Solids carry the whole load on the right half of the contact.
/// let touching: Vec<bool> = grid.nodes().map(|(x, y)| x > 0.0 && x.hypot(y) < 2e-5).collect();
/// let pressure: Vec<f64> = touching.iter().map(|touches| if *touches { 1e9 } else { 0.0 }).collect();
/// let load = pressure.iter().sum::<f64>() * grid.cell_area();
/// let statistics = contact_statistics(&grid, &touching, &pressure, load, 2e-5, 2e-5)?;
/// assert!((statistics.area_ratio - 0.5).abs() < 0.01);
/// assert!((statistics.load_ratio - 1.0).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ContactStatistics {
    /// Area of all nodes in contact \[m^2\].
    pub area: f64,
    /// Area of the nodes in contact within the Hertz ellipse, over the area of the ellipse `pi a_x a_y`.
    ///
    /// Cells count as a whole, so complete contact on a coarse grid gives 1 only up to the cells on the edge
    /// of the ellipse.
    pub area_ratio: f64,
    /// Area of all nodes in contact, with edge correction \[m^2\].
    pub corrected_area: f64,
    /// The corrected area within the Hertz ellipse, over the area of the ellipse.
    pub corrected_area_ratio: f64,
    /// Share of the load carried by solid contact, over all nodes in contact inside and outside of the
    /// ellipse.
    pub load_ratio: f64,
}

/// Solid contact of the nodes flagged `in_contact` with `solid_pressure` \[Pa\] under `load` \[N\], relative
/// to the Hertz ellipse of semi-axes `a_x`, `a_y` \[m\] at the origin of the grid.
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
/// assert!((contact.corrected_area / 1e-12 - (1.0 - 4.0 * 0.11811)).abs() < 1e-4); // four transitions
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
    statistics_in(grid, in_contact, solid_pressure, load, &Ellipse::upright(a_x, a_y)?)
}

/// Contact statistics for an ellipse at any angle.
pub(crate) fn statistics_in(
    grid: &Grid,
    in_contact: &[bool],
    solid_pressure: &[f64],
    load: f64,
    ellipse: &Ellipse,
) -> Result<ContactStatistics, InputError> {
    InputError::require_len("in_contact", in_contact, grid.len())?;
    grid.require_field("solid_pressure", solid_pressure)?;
    InputError::require_positive("load", load)?;
    let (mut all, mut inside, mut pressure) = (Count::default(), Count::default(), 0.0);
    for (k, (x, y)) in grid.nodes().enumerate().filter(|&(k, _)| in_contact[k]) {
        let changes = open_neighbours(grid, in_contact, k);
        all.add(changes);
        if ellipse.radius_squared(x, y) <= 1.0 {
            inside.add(changes);
        }
        pressure += solid_pressure[k];
    }
    let (cell, ellipse) = (grid.cell_area(), ellipse.area());
    Ok(ContactStatistics {
        area: all.nodes as f64 * cell,
        area_ratio: inside.nodes as f64 * cell / ellipse,
        corrected_area: all.corrected() * cell,
        corrected_area_ratio: inside.corrected() * cell / ellipse,
        load_ratio: pressure * cell / load,
    })
}

/// Number of nodes in contact, and of transitions between contact and gap.
#[derive(Debug, Clone, Copy, Default)]
struct Count {
    nodes: usize,
    changes: usize,
}

impl Count {
    fn add(&mut self, changes: usize) {
        self.nodes += 1;
        self.changes += changes;
    }

    /// Number of cells in contact, with edge correction.
    fn corrected(self) -> f64 {
        self.nodes as f64 - EXCESS * self.changes as f64
    }
}

/// Number of neighbors of node `k`, up to four, that are not in contact.
fn open_neighbours(grid: &Grid, in_contact: &[bool], k: usize) -> usize {
    let (nx, column) = (grid.nx(), k % grid.nx());
    let neighbours = [
        (column > 0).then(|| k - 1),
        (column + 1 < nx).then_some(k + 1),
        k.checked_sub(nx),
        (k + nx < grid.len()).then_some(k + nx),
    ];
    neighbours.into_iter().flatten().filter(|&other| !in_contact[other]).count()
}
