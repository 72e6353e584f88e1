//! Solid contact, wear and tribofilms in the two outermost rows and columns of the box.
//!
//! Contact outside of the box is not computed, so a contact that reaches its edge is cut. Three quantities are checked
//! on each side:
//!
//! | quantity | measure | reaches the edge from |
//! |---|---|---|
//! | solid contact | share of the load on solids in the two rows | [`LOAD_SHARE`]; of a dry contact any |
//! | wear | worn depth of a body that wears there | the contact film, and [`DEPTH_SHARE`] of the largest |
//! | tribofilm | thickness of a film that grows there | the same, of laws that need solid contact |
//!
//! Depths below the contact film do not separate solids. A body that moves along x wears and grows in all columns of its
//! patch, so only its rows are checked; one at random positions along both axes has no edge.

use crate::grid::Grid;
use crate::report::Status;
use crate::reynolds::{ContactState, ReynoldsError};
use crate::sim::contact::film_heat::Solved;
use crate::sim::contact::model::ContactModel;
use crate::sim::error::{BoxTooSmall, EdgeQuantity, SimError};
use crate::sim::scene::Scene;
use crate::sim::scene::hertz::HertzContact;
use crate::surface::PointRevisit;
use crate::surface_state::SurfaceState;
use crate::tribochem::FilmGrowthLaw;

/// Number of outermost rows and columns that are checked if there are at least [`FEW`], and in dry contacts. Otherwise
/// one, as two would be a large part of the box.
const ROWS: usize = 2;
/// See [`ROWS`].
const FEW: usize = 32;
/// Fraction of the load on solids at the edge: about as much is cut off outside.
const LOAD_SHARE: f64 = 1e-4;
/// Fraction of the largest depth of a body.
const DEPTH_SHARE: f64 = 0.01;
/// Smallest distance of an edge from the center in a wider box, in Hertz half-widths.
const ROOM: f64 = 1.5;
/// Pressure and shear of a fluid, to identify growth laws that need no solid contact \[Pa\].
const FLUID_STRESS: f64 = 1e8;

/// A row (constant y) or a column (constant x) of cells at one side of the box.
#[derive(Clone, Copy, PartialEq)]
enum Axis {
    /// Columns, at the edges of `grid.x`.
    X,
    /// Rows, at the edges of `grid.y`.
    Y,
}

/// One quantity at the edges of one axis.
struct Edge {
    /// Values at the low and at the high side.
    values: [f64; 2],
    /// Nodes of the largest entries on both sides.
    nodes: [usize; 2],
}

impl Edge {
    /// Sum or maximum of the entries of `field` in the outermost rows of both sides of `axis`.
    fn of(grid: &Grid, axis: Axis, (sums, dry): (bool, bool), field: impl Fn(usize) -> f64) -> Self {
        let mut edge = Self { values: [0.0; 2], nodes: [0; 2] };
        let mut largest = [0.0; 2];
        for k in 0..grid.len() {
            let (place, count) = match axis {
                Axis::X => (k % grid.nx(), grid.nx()),
                Axis::Y => (k / grid.nx(), grid.ny()),
            };
            let rows = if dry || count >= FEW { ROWS } else { 1 };
            for (side, outer) in [place < rows, place + rows >= count].into_iter().enumerate() {
                let value = if outer { field(k) } else { 0.0 };
                if value > largest[side] {
                    (largest[side], edge.nodes[side]) = (value, k);
                }
                edge.values[side] = if sums { edge.values[side] + value } else { largest[side] };
            }
        }
        edge
    }

    /// The error for a value above `least`.
    fn require(
        &self,
        quantity: EdgeQuantity,
        least: f64,
        axis: Axis,
        (grid, hertz): (&Grid, &HertzContact),
    ) -> Result<(), BoxTooSmall> {
        let side = usize::from(self.values[1] > self.values[0]);
        if self.values[side] <= least {
            return Ok(());
        }
        let (node, value) = (self.nodes[side], self.values[side]);
        let (field, edges, cells) = wider(axis, self.values.map(|value| value > least), grid, hertz);
        let (x, y) = (grid.x(node % grid.nx()), grid.y(node / grid.nx()));
        Err(BoxTooSmall { quantity, value, x, y, field, edges, cells })
    }
}

/// Key, edges and cells of a wider box: `sides` that were reached move out to 1.5 times their distance from the center,
/// at least [`ROOM`] half-widths.
fn wider(axis: Axis, sides: [bool; 2], grid: &Grid, hertz: &HertzContact) -> (&'static str, [f64; 2], usize) {
    let [half_x, half_y] = hertz.half_extents();
    let (field, first, step, count, half_width) = match axis {
        Axis::X => ("grid.x", grid.x(0), grid.dx(), grid.nx(), half_x),
        Axis::Y => ("grid.y", grid.y(0), grid.dy(), grid.ny(), half_y),
    };
    let low = first - 0.5 * step;
    let old = [-low, low + step * count as f64];
    let [below, above] = [0, 1].map(|side| {
        let wanted = (1.5 * old[side]).max(ROOM * half_width);
        if sides[side] { ((wanted - old[side]) / step).ceil().max(ROWS as f64) } else { 0.0 }
    });
    let edges = [-(old[0] + below * step), old[1] + above * step];
    (field, edges, count + (below + above) as usize)
}

/// Axes with edges; only x for a line contact.
fn axes(grid: &Grid) -> &'static [Axis] {
    if grid.has_side_edges() { &[Axis::Y, Axis::X] } else { &[Axis::X] }
}

/// Returns `solved`, the contact of `model` in `state`, unless it converged with solid contact in the outermost rows and
/// `scene` does not allow that.
pub(in crate::sim) fn require_solids_inside(
    scene: &Scene,
    (model, state): (&ContactModel, &ContactState),
    solved: Result<Solved, SimError>,
) -> Result<Solved, SimError> {
    let is_final = match &solved {
        Ok((report, _)) => report.status == Status::Converged,
        Err(error) => matches!(error, SimError::Reynolds(ReynoldsError::EdgeContact { .. })),
    };
    if is_final && !scene.solver.edge_contact {
        let (grid, hertz) = (&model.grid, &model.hertz);
        let per_load = grid.cell_area() / hertz.force;
        let dry = model.lubricant.is_none();
        let least = if dry { 0.0 } else { LOAD_SHARE };
        for &axis in axes(grid) {
            let edge = Edge::of(grid, axis, (true, dry), |k| per_load * state.solid_pressure(k));
            edge.require(EdgeQuantity::Solids, least, axis, (grid, hertz))?;
        }
    }
    solved
}

/// One body after a step and before it.
pub(in crate::sim) struct Change<'a> {
    /// 0 the ball, 1 the disc.
    pub(in crate::sim) body: usize,
    /// Points of the patch that pass the contact.
    pub(in crate::sim) visits: PointRevisit,
    /// Worn depth after and before the step \[m\].
    pub(in crate::sim) wear: [&'a [f64]; 2],
    /// Tribofilm after and before the step \[m\]; `None` for laws that need no solid contact.
    pub(in crate::sim) film: Option<[&'a [f64]; 2]>,
}

impl Change<'_> {
    /// Rejects wear and film above the `contact_film` \[m\] that increase in the outermost rows.
    pub(in crate::sim) fn require_inside(
        &self,
        grid: &Grid,
        hertz: &HertzContact,
        contact_film: f64,
    ) -> Result<(), BoxTooSmall> {
        let [wear, film] = [
            [EdgeQuantity::BallWear, EdgeQuantity::BallTribofilm],
            [EdgeQuantity::DiscWear, EdgeQuantity::DiscTribofilm],
        ][self.body];
        for (quantity, fields) in [(wear, Some(self.wear)), (film, self.film)] {
            let Some([now, before]) = fields else { continue };
            let largest = now.iter().copied().fold(0.0, f64::max);
            let least = contact_film.max(DEPTH_SHARE * largest);
            for &axis in axes(grid).iter().filter(|axis| self.has_edge(**axis)) {
                let rising = |k: usize| if now[k] > before[k] { now[k] } else { 0.0 };
                Edge::of(grid, axis, (false, false), rising).require(quantity, least, axis, (grid, hertz))?;
            }
        }
        Ok(())
    }

    /// Whether the patch of the body has an edge along `axis`.
    fn has_edge(&self, axis: Axis) -> bool {
        match self.visits {
            PointRevisit::Permanent => true,
            PointRevisit::Passing | PointRevisit::Track => axis == Axis::Y,
            PointRevisit::Patch => false,
        }
    }
}

/// Whether a film of `law` grows at `temperature` \[K\] in solid contact only.
pub(in crate::sim) fn needs_solids(law: &dyn FilmGrowthLaw, temperature: f64) -> bool {
    let fluid = SurfaceState::new(FLUID_STRESS, temperature).with_shear_stress(FLUID_STRESS);
    law.rate(&fluid.with_sliding_speed(1.0), 0.0) <= 0.0
}
