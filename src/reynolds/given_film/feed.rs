//! Grooves and holes that feed a film.

use std::f64::consts::SQRT_2;

use crate::error::InputError;
use crate::grid::Grid;

/// Least share of the way between two nodes that is beyond the edge of a feed.
const LEAST_SHARE: f64 = 0.02;

/// Distance of `position` from the middle of a `range`, over half of its length.
fn offset(range: [f64; 2], position: f64) -> f64 {
    (position - 0.5 * (range[0] + range[1])) / (0.5 * (range[1] - range[0]))
}

/// Share of the way between two neighboring nodes that is outside of all `feeds`; one of both nodes may be in a feed.
pub(super) fn free_share(feeds: &[Feed], first: (f64, f64), second: (f64, f64)) -> f64 {
    let of = |point| feeds.iter().find(|feed| feed.contains(point));
    match (of(first), of(second)) {
        (Some(feed), None) => feed.share_beyond(first, second),
        (None, Some(feed)) => feed.share_beyond(second, first),
        _ => 1.0,
    }
}

/// Error for round `holes` of a `diameter` \[m\] one of which has no node of `grid`.
pub(crate) fn require_resolved_holes(holes: &[Feed], diameter: f64, grid: Grid) -> Result<(), InputError> {
    let is_resolved = |hole: &Feed| grid.nodes().any(|point| hole.contains(point));
    if holes.iter().all(is_resolved) {
        return Ok(());
    }
    // A circle as wide as the diagonal of a cell has a node anywhere.
    let cells = |size: f64| (SQRT_2 * size / diameter).ceil();
    let [nx, ny] = [cells(grid.size_x()), cells(grid.size_y())];
    Err(InputError::Conflict {
        field: format!("hole_diameter = {diameter:e} m"),
        reason: format!(
            "a hole lies between the nodes of {} x {} cells; nx = {nx} and ny = {ny}, or larger holes",
            grid.nx(),
            grid.ny()
        ),
    })
}

/// A rectangle or a circle of a [`GivenFilm`](super::GivenFilm) with a prescribed pressure: a groove, pocket or hole that is deep
/// beside the film. All nodes within it have its pressure; the flow to a node beside it starts at its edge.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::{Feed, FilmThickness, GivenFilm};
/// // Oil of 1 MPa flows from a groove in the middle of a film of 10 um to both edges, 45 mm away.
/// let grid = Grid::from_edges(100, 1, [0.0, 0.1], [0.0, 1.0])?;
/// let film = FilmThickness::from_function(grid, |_, _| 1e-5)?;
/// let oil = Lubricant::new(Barus::new(0.01, 0.0)?, Incompressible);
/// let groove = [Feed::new([0.045, 0.055], [0.0, 1.0], 1e6)];
/// let solution = GivenFilm::new(&film, &oil, [0.0, 0.0]).with_feeds(&groove).solve()?;
/// let exact = 2.0 * 1e-15 * 1e6 / (12.0 * 0.01 * 0.045); // h^3 p/(12 eta L)
/// assert!((solution.feed_flows[0] / exact - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Feed {
    /// Range along x \[m\].
    pub x: [f64; 2],
    /// Range along y \[m\].
    pub y: [f64; 2],
    /// Pressure \[Pa\].
    pub pressure: f64,
    /// Whether it is the ellipse within these ranges.
    pub is_round: bool,
}

impl Feed {
    /// A feed over the ranges `x` and `y` \[m\] at `pressure` \[Pa\].
    pub const fn new(x: [f64; 2], y: [f64; 2], pressure: f64) -> Self {
        Self { x, y, pressure, is_round: false }
    }

    /// A round hole of a `diameter` about its `center` \[m\] at `pressure` \[Pa\].
    pub const fn hole(center: [f64; 2], diameter: f64, pressure: f64) -> Self {
        let ([x, y], radius) = (center, 0.5 * diameter);
        Self { x: [x - radius, x + radius], y: [y - radius, y + radius], pressure, is_round: true }
    }

    /// Whether a point is inside.
    pub(in crate::reynolds) fn contains(&self, (x, y): (f64, f64)) -> bool {
        let [along, across] = [offset(self.x, x), offset(self.y, y)];
        if self.is_round {
            along * along + across * across <= 1.0
        } else {
            along.abs() <= 1.0 && across.abs() <= 1.0
        }
    }

    /// The edges of the feed along one axis at the position `other` along the other axis.
    fn edges(&self, range: [f64; 2], (other_range, other): ([f64; 2], f64)) -> [f64; 2] {
        if !self.is_round {
            return range;
        }
        let middle = 0.5 * (range[0] + range[1]);
        let half = 0.5 * (range[1] - range[0]) * (1.0 - offset(other_range, other).powi(2)).max(0.0).sqrt();
        [middle - half, middle + half]
    }

    /// Share of the way from the node `inside` to its neighbor `outside` that is beyond the edge.
    fn share_beyond(&self, inside: (f64, f64), outside: (f64, f64)) -> f64 {
        let ranges = [
            (self.edges(self.x, (self.y, inside.1)), inside.0, outside.0),
            (self.edges(self.y, (self.x, inside.0)), inside.1, outside.1),
        ];
        let shares =
            ranges.into_iter().filter(|(_, from, to)| (to - from).abs() > 0.0).map(|(range, from, to)| {
                let edge = if to > from { range[1] } else { range[0] };
                (to - edge) / (to - from)
            });
        shares.fold(1.0, f64::min).max(LEAST_SHARE)
    }

    /// The feed with `x` mirrored about the middle of `ends`.
    pub(super) fn mirrored(self, ends: [f64; 2]) -> Self {
        let sum = ends[0] + ends[1];
        Self { x: [sum - self.x[1], sum - self.x[0]], ..self }
    }

    /// Error for the feed `index` with a pressure below that of cavitation or without a node.
    pub(super) fn validate(&self, index: usize, grid: Grid, cavitation: f64) -> Result<(), InputError> {
        InputError::require(
            self.pressure.is_finite() && self.pressure >= cavitation,
            &format!("feeds.{index}.pressure"),
            self.pressure,
            "finite and at least the cavitation pressure",
        )?;
        if grid.nodes().any(|point| self.contains(point)) {
            return Ok(());
        }
        Err(InputError::Conflict {
            field: format!("feeds.{index}"),
            reason: format!(
                "x from {:e} to {:e} m and y from {:e} to {:e} m have no node of the grid; a larger feed or more cells",
                self.x[0], self.x[1], self.y[0], self.y[1]
            ),
        })
    }
}
