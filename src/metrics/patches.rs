//! Connected contact patches.

use crate::boundary::Boundary;
use crate::error::InputError;
use crate::grid::Grid;

/// Excess area of whole cells per perimeter and spacing, `(pi - 1 + ln 2) / 24`.
const PERIMETER_CORRECTION: f64 = (std::f64::consts::PI - 1.0 + std::f64::consts::LN_2) / 24.0;

/// Connected patches of a contact.
///
/// # Examples
///
/// ```
/// use stribeck::metrics::contact_patches;
/// use stribeck::{Boundary, Grid};
/// let grid = Grid::centred(64, 64, 1e-6, 1e-6)?;
/// let disc: Vec<bool> = grid.nodes().map(|(x, y)| x.hypot(y) < 2e-5).collect();
/// let patches = contact_patches(&grid, &disc, Boundary::Open)?;
/// assert_eq!(patches.areas.len(), 1);
/// // The perimeter of the cells equals that of the enclosing square.
/// assert!((patches.perimeter / 160e-6 - 1.0).abs() < 0.03);
/// assert!(patches.corrected_area < patches.areas[0]);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ContactPatches {
    /// Area of each patch \[m^2\], the largest first.
    pub areas: Vec<f64>,
    /// Length of all edges between a node in contact and one that is not \[m\], without the edges of an open
    /// grid.
    pub perimeter: f64,
    /// Contact area \[m^2\] with edge correction.
    pub corrected_area: f64,
}

/// Patches of the nodes flagged `in_contact`. Nodes that share an edge are connected, across the border of a
/// periodic grid too.
///
/// Partly covered cells count as a whole, which overestimates the contact area by a share of the perimeter:
/// `A = A_cells - (pi - 1 + ln 2)/24 * sum of dx dy over the edges`. The corrected area converges faster with
/// the mesh. It is meant for patches of several cells, and is at least zero.
///
/// Source: Yastrebov, V. A., Anciaux, G. and Molinari, J.-F. (2017), Tribology International 114, 161-171.
///
/// # Errors
/// Flags that do not fit the grid.
///
/// ```
/// use stribeck::{Boundary, Grid, metrics::contact_patches};
/// let grid = Grid::centred(4, 2, 1.0, 1.0)?;
/// let flags = [true, true, false, false, false, false, false, true].to_vec();
/// let patches = contact_patches(&grid, &flags, Boundary::Open)?;
/// assert_eq!((patches.areas, patches.perimeter), (vec![2.0, 1.0], 5.0));
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn contact_patches(
    grid: &Grid,
    in_contact: &[bool],
    boundary: Boundary,
) -> Result<ContactPatches, InputError> {
    InputError::require_len("in_contact", in_contact, grid.len())?;
    let mut seen = vec![false; grid.len()];
    let (mut sizes, mut edges_x, mut edges_y) = (Vec::new(), 0_usize, 0_usize);
    let mut open = Vec::new();
    for start in 0..grid.len() {
        if !in_contact[start] || seen[start] {
            continue;
        }
        seen[start] = true;
        open.push(start);
        let mut size = 0_usize;
        while let Some(k) = open.pop() {
            size += 1;
            for (side, neighbour) in neighbours(grid, k, boundary).into_iter().enumerate() {
                let Some(neighbour) = neighbour else { continue };
                if !in_contact[neighbour] {
                    *(if side < 2 { &mut edges_y } else { &mut edges_x }) += 1;
                } else if !seen[neighbour] {
                    seen[neighbour] = true;
                    open.push(neighbour);
                }
            }
        }
        sizes.push(size);
    }
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    let cell = grid.cell_area();
    let whole = sizes.iter().sum::<usize>() as f64 * cell;
    let surplus = PERIMETER_CORRECTION * (edges_x + edges_y) as f64 * cell;
    Ok(ContactPatches {
        areas: sizes.into_iter().map(|size| size as f64 * cell).collect(),
        perimeter: edges_x as f64 * grid.dx() + edges_y as f64 * grid.dy(),
        corrected_area: (whole - surplus).max(0.0),
    })
}

/// The neighbors to the left and right of, below and above node `k`.
fn neighbours(grid: &Grid, k: usize, boundary: Boundary) -> [Option<usize>; 4] {
    let (nx, ny) = (grid.nx(), grid.ny());
    let (i, j) = (k % nx, k / nx);
    let wraps = boundary == Boundary::Periodic;
    [
        if i > 0 { Some(k - 1) } else { wraps.then_some(k + nx - 1) },
        if i + 1 < nx { Some(k + 1) } else { wraps.then_some(k + 1 - nx) },
        if j > 0 { Some(k - nx) } else { wraps.then_some(k + nx * (ny - 1)) },
        if j + 1 < ny { Some(k + nx) } else { wraps.then_some(i) },
    ]
}
