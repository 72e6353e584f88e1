//! Spin: surfaces that rotate about a point beside the contact; entrainment along y.
//!
//! Their mean speed is `u = U (1 - y/R)` along x and `v = U x/R` along y, with the radius of spin `R`. The entrained
//! flux through a face between two rows is `v (rho_a + rho_b)/2` times the film `2 h_a h_b/(h_a + h_b)` of the exact
//! flow through a linear film between the two nodes, like the mobility of the face. If the upstream node is not
//! filled, it is multiplied by its film fraction `theta`.

use std::ops::Range;

use super::node::NodeFlow;
use crate::error::{InputError, format_number};
use crate::grid::Grid;
use crate::reynolds::inner_nodes::inner_rows;

/// Rejects a `radius` of spin \[m\] under the key `field` for which surfaces within `grid` would move backwards,
/// and problems without spin: a line contact, a supplied film, the paper's contact.
pub(crate) fn require_spin(
    (field, radius): (&str, f64),
    grid: &Grid,
    is_supplied: bool,
    is_paper: bool,
) -> Result<(), InputError> {
    InputError::require(radius.is_finite(), field, radius, "finite")?;
    let (first, last) = (grid.y(0), grid.y(grid.ny().saturating_sub(1)));
    let extent = first.abs().max(last.abs());
    let reason = if !grid.has_side_edges() {
        "a line contact has no second axis to turn in".to_owned()
    } else if radius.abs() <= extent {
        format!(
            "surfaces would move backwards beyond the centre, the box reaches to |y| = {extent:.6e} m; take a larger \
             radius, or a narrower box"
        )
    } else if is_supplied {
        "supplied_film is that of the edge at lower x, and turning surfaces carry fluid in at others too"
            .to_owned()
    } else if is_paper {
        "the paper's contact moves along x alone".to_owned()
    } else {
        return Ok(());
    };
    Err(InputError::Conflict { field: format!("{field} = {}", format_number(radius)), reason })
}

/// Sweep order along the columns of a grid: the flow direction of spinning surfaces.
#[derive(Debug, Clone, Default)]
pub(in crate::reynolds) struct SweepOrder {
    /// Nodes in a row.
    nx: usize,
    /// Rows with balances.
    rows: Range<usize>,
    /// Whether the flow is towards lower y, by column.
    is_south: Vec<bool>,
}

impl SweepOrder {
    /// The inner nodes of column `i` in flow direction.
    pub(in crate::reynolds) fn downstream(&self, i: usize) -> impl Iterator<Item = usize> + use<> {
        let (nx, is_south, ends) = (self.nx, self.is_south[i], self.rows.start + self.rows.end);
        self.rows.clone().map(move |j| if is_south { ends - 1 - j } else { j } * nx + i)
    }

    /// Inflow and outflow faces of inner node `k`, by their first nodes.
    #[inline]
    pub(in crate::reynolds) fn faces(&self, k: usize) -> [usize; 2] {
        if self.is_south[k % self.nx] { [k, k - self.nx] } else { [k - self.nx, k] }
    }

    /// Plus one if the flow in the column of node `k` is towards higher y, otherwise minus one.
    #[inline]
    pub(in crate::reynolds) fn sign(&self, k: usize) -> f32 {
        if self.is_south[k % self.nx] { -1.0 } else { 1.0 }
    }
}

/// Entrainment between rows by spinning surfaces.
#[derive(Debug, Clone, Default)]
pub(super) struct Spin {
    /// Nodes in a row.
    nx: usize,
    /// `w` of the rows.
    wedges: Vec<f64>,
    /// `v dx/(U dy)` of the columns.
    columns: Vec<f64>,
    /// Flow direction of the columns.
    pub(super) sweep_order: SweepOrder,
    /// Entrained flow through the faces north of the nodes at film fraction one \[m\].
    full: Vec<f64>,
    /// The same at the film fraction of the upstream node.
    entrained: Vec<f64>,
    /// Fraction of a change of inflow that nodes advect to the next row if not filled; zero elsewhere.
    pub(super) advected_fraction: Vec<f64>,
}

impl Spin {
    /// Sets the spin of surfaces that rotate about a point at the distance `radius` \[m\]; `wedge` is `w` in the
    /// center row.
    pub(super) fn configure(&mut self, grid: &Grid, radius: f64, wedge: f64) {
        let per_row = wedge * grid.dx() / grid.dy();
        self.nx = grid.nx();
        // Speeds of the rows along x and of the columns along y.
        self.wedges.clear();
        self.wedges.extend((0..grid.ny()).map(|j| wedge * (1.0 - grid.y(j) / radius)));
        self.columns.clear();
        self.columns.extend((0..grid.nx()).map(|i| per_row * grid.x(i) / radius));
        (self.sweep_order.nx, self.sweep_order.rows) = (grid.nx(), inner_rows(grid));
        // Flow direction of the columns.
        self.sweep_order.is_south.clear();
        self.sweep_order.is_south.extend(self.columns.iter().map(|column| *column < 0.0));
        for field in [&mut self.full, &mut self.entrained, &mut self.advected_fraction] {
            field.resize(grid.len(), 0.0);
        }
    }

    /// `w` of the row of node `k`.
    #[inline]
    pub(super) fn wedge(&self, k: usize) -> f64 {
        self.wedges[k / self.nx]
    }

    /// `v dx/(U dy)` of the column of node `k`: entrained flow to the north per film at film fraction one.
    #[inline]
    pub(super) fn column(&self, k: usize) -> f64 {
        self.columns[k % self.nx]
    }

    /// Updates the entrained flow at film fraction one.
    pub(super) fn update(&mut self, nodes: &[NodeFlow]) {
        for k in 0..nodes.len() - self.nx {
            self.full[k] = self.column(k) * entrained(&nodes[k], &nodes[k + self.nx]);
        }
        self.entrained.copy_from_slice(&self.full);
        self.advected_fraction.fill(0.0);
    }

    /// Entrained flow into inner node `k` from the row upstream, and out of it at film fraction one.
    #[inline]
    pub(super) fn through(&self, k: usize) -> [f64; 2] {
        let [enters, leaves] = self.sweep_order.faces(k);
        [self.entrained[enters].abs(), self.full[leaves].abs()]
    }

    /// Net entrained outflow of inner node `k` at the present film fractions.
    #[inline]
    pub(super) fn outflow(&self, k: usize) -> f64 {
        self.entrained[k] - self.entrained[k - self.nx]
    }

    /// Entrained flow through the face north of node `k`.
    #[inline]
    pub(super) fn north(&self, k: usize) -> f64 {
        self.entrained[k]
    }

    /// Sets the film fraction of node `k` and the fraction of a change of its inflow that it advects.
    pub(super) fn set_film_fraction(&mut self, k: usize, theta: f64, advected_fraction: f64) {
        let [_, leaves] = self.sweep_order.faces(k);
        self.entrained[leaves] = theta * self.full[leaves];
        self.advected_fraction[k] = advected_fraction;
    }

    /// Derivatives of the entrained flow through the face north of node `k` at film fraction one: by both pressures,
    /// then by both films.
    pub(super) fn derivatives(&self, k: usize, nodes: &[NodeFlow]) -> [f64; 4] {
        let [a, b] = [&nodes[k], &nodes[k + self.nx]];
        entrained_derivatives(a, b).map(|by| self.column(k) * by)
    }
}

/// Film of the exact flow between two films; zero if one is closed.
#[inline]
fn face_film(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if sum == 0.0 { 0.0 } else { 2.0 * a * b / sum }
}

/// Entrained flow through a face at film fraction one over the speed \[m\].
#[inline]
pub(super) fn entrained(a: &NodeFlow, b: &NodeFlow) -> f64 {
    0.5 * (a.density + b.density) * face_film(a.film, b.film)
}

/// Derivatives of [`entrained`] by both pressures, then by both films.
#[inline]
pub(super) fn entrained_derivatives(a: &NodeFlow, b: &NodeFlow) -> [f64; 4] {
    let (film, sum) = (face_film(a.film, b.film), a.film + b.film);
    if sum == 0.0 {
        return [0.0; 4];
    }
    let density = a.density + b.density;
    let by = |other: f64| density * (other / sum).powi(2);
    [0.5 * film * a.density_p, 0.5 * film * b.density_p, by(b.film) * a.film_h, by(a.film) * b.film_h]
}
