//! Surfaces that turn about a point beside the contact: entrainment along y.
//!
//! Their mean speed is `u = U (1 - y/R)` along x and `v = U x/R` along y, with the radius of spin `R`. What is
//! carried through a face between two rows is `v (rho_a + rho_b)/2` times the film `2 h_a h_b/(h_a + h_b)`,
//! that of the exact flow through a film which is linear between the two nodes, as is the mobility of the
//! face. Where the node upstream is not filled, it is its content `theta` times that.

use std::ops::Range;

use super::node::NodeFlow;
use crate::error::{InputError, format_number};
use crate::grid::Grid;
use crate::reynolds::problem::inner_rows;

/// Refuses a `radius` of spin \[m\], named `field`, about whose centre surfaces would move backwards within
/// `grid`, and what knows no spin: a line contact, a supplied film, the paper's contact.
pub(crate) fn require_spin(
    (field, radius): (&str, f64),
    grid: &Grid,
    is_supplied: bool,
    is_paper: bool,
) -> Result<(), InputError> {
    InputError::require(radius.is_finite(), field, radius, "finite")?;
    let (first, last) = (grid.y(0), grid.y(grid.ny().saturating_sub(1)));
    let extent = first.abs().max(last.abs());
    let reason = if grid.ny() == 1 {
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

/// Which way turning surfaces carry fluid along the columns of a grid.
#[derive(Debug, Clone, Default)]
pub(in crate::reynolds) struct Course {
    /// Nodes in a row.
    nx: usize,
    /// Rows that have balances.
    rows: Range<usize>,
    /// Whether it is towards lower y, by column.
    is_south: Vec<bool>,
}

impl Course {
    /// The inner nodes of column `i` from its upstream end.
    pub(in crate::reynolds) fn downstream(&self, i: usize) -> impl Iterator<Item = usize> + use<> {
        let (nx, is_south, ends) = (self.nx, self.is_south[i], self.rows.start + self.rows.end);
        self.rows.clone().map(move |j| if is_south { ends - 1 - j } else { j } * nx + i)
    }

    /// Faces, by their first nodes, through which fluid enters inner node `k` and leaves it.
    #[inline]
    pub(in crate::reynolds) fn faces(&self, k: usize) -> [usize; 2] {
        if self.is_south[k % self.nx] { [k, k - self.nx] } else { [k - self.nx, k] }
    }

    /// One where fluid in the column of node `k` moves towards higher y, else minus one.
    #[inline]
    pub(in crate::reynolds) fn sign(&self, k: usize) -> f32 {
        if self.is_south[k % self.nx] { -1.0 } else { 1.0 }
    }
}

/// What turning surfaces carry through the faces between rows.
#[derive(Debug, Clone, Default)]
pub(super) struct Spin {
    /// Nodes in a row.
    nx: usize,
    /// `w` of the rows.
    wedges: Vec<f64>,
    /// `v dx/(U dy)` of the columns.
    columns: Vec<f64>,
    /// Which way that is.
    pub(super) course: Course,
    /// Flow through the faces to the north of the nodes where all gaps are filled \[m\].
    full: Vec<f64>,
    /// The same with the content upstream.
    carried: Vec<f64>,
    /// Of nodes that are not filled, what of their inflow they carry on to the next row; zero elsewhere.
    pub(super) passed: Vec<f64>,
}

impl Spin {
    /// Becomes that of surfaces which turn about a point at the distance `radius` \[m\]; `wedge` is `w` at
    /// the centre.
    pub(super) fn configure(&mut self, grid: &Grid, radius: f64, wedge: f64) {
        let per_row = wedge * grid.dx() / grid.dy();
        self.nx = grid.nx();
        self.wedges.clear();
        self.wedges.extend((0..grid.ny()).map(|j| wedge * (1.0 - grid.y(j) / radius)));
        self.columns.clear();
        self.columns.extend((0..grid.nx()).map(|i| per_row * grid.x(i) / radius));
        (self.course.nx, self.course.rows) = (grid.nx(), inner_rows(grid));
        self.course.is_south.clear();
        self.course.is_south.extend(self.columns.iter().map(|column| *column < 0.0));
        for field in [&mut self.full, &mut self.carried, &mut self.passed] {
            field.resize(grid.len(), 0.0);
        }
    }

    /// `w` of the row of node `k`.
    #[inline]
    pub(super) fn wedge(&self, k: usize) -> f64 {
        self.wedges[k / self.nx]
    }

    /// `v dx/(U dy)` of the column of node `k`: what is carried to the north of it over a filled film.
    #[inline]
    pub(super) fn column(&self, k: usize) -> f64 {
        self.columns[k % self.nx]
    }

    /// Takes the flow between full gaps.
    pub(super) fn update(&mut self, nodes: &[NodeFlow]) {
        for k in 0..nodes.len() - self.nx {
            self.full[k] = self.column(k) * carried(&nodes[k], &nodes[k + self.nx]);
        }
        self.carried.copy_from_slice(&self.full);
        self.passed.fill(0.0);
    }

    /// What enters inner node `k` from the row upstream, and what leaves it with its own gap filled.
    #[inline]
    pub(super) fn through(&self, k: usize) -> [f64; 2] {
        let [enters, leaves] = self.course.faces(k);
        [self.carried[enters].abs(), self.full[leaves].abs()]
    }

    /// What leaves inner node `k` beyond what enters it, contents as they are.
    #[inline]
    pub(super) fn outflow(&self, k: usize) -> f64 {
        self.carried[k] - self.carried[k - self.nx]
    }

    /// Flow through the face to the north of node `k`.
    #[inline]
    pub(super) fn north(&self, k: usize) -> f64 {
        self.carried[k]
    }

    /// Lets node `k` have the `content` and carry on the share `passed` of a change of what enters it.
    pub(super) fn fill(&mut self, k: usize, content: f64, passed: f64) {
        let [_, leaves] = self.course.faces(k);
        self.carried[leaves] = content * self.full[leaves];
        self.passed[k] = passed;
    }

    /// Derivatives of the flow through the face to the north of node `k` between full gaps: by both
    /// pressures, then by both films.
    pub(super) fn derivatives(&self, k: usize, nodes: &[NodeFlow]) -> [f64; 4] {
        let [a, b] = [&nodes[k], &nodes[k + self.nx]];
        carried_derivatives(a, b).map(|by| self.column(k) * by)
    }
}

/// Film of the exact flow between two films; zero where one is closed.
#[inline]
fn face_film(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if sum == 0.0 { 0.0 } else { 2.0 * a * b / sum }
}

/// What a face between full gaps carries over the speed \[m\].
#[inline]
pub(super) fn carried(a: &NodeFlow, b: &NodeFlow) -> f64 {
    0.5 * (a.density + b.density) * face_film(a.film, b.film)
}

/// Its derivatives by both pressures, then by both films.
#[inline]
pub(super) fn carried_derivatives(a: &NodeFlow, b: &NodeFlow) -> [f64; 4] {
    let (film, sum) = (face_film(a.film, b.film), a.film + b.film);
    if sum == 0.0 {
        return [0.0; 4];
    }
    let density = a.density + b.density;
    let by = |other: f64| density * (other / sum).powi(2);
    [0.5 * film * a.density_p, 0.5 * film * b.density_p, by(b.film) * a.film_h, by(a.film) * b.film_h]
}
