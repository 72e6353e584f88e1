//! Rigid surfaces with a prescribed film: pressure and film fraction by the Reynolds equation.
//!
//! This module is independent of the coupled contact: no deformation, and solid contact only in the mean. It
//! treats textured bearings and sliders, and tests cavitation against closed forms.
//!
//! | file | content |
//! |---|---|
//! | `film` | integrals of the film between the nodes |
//! | `feed` | grooves and holes with a prescribed pressure |
//! | `faces`, `balance` | flow coefficients between the nodes; mass balances of the cells |
//! | `newton`, `linear` | Newton's method; its linear systems |
//! | `roughness` | mean flow and mean contact of rough surfaces |
//! | `row`, `solution` | pressure profiles of the rows; forces, flows and reformation |

mod balance;
mod faces;
mod feed;
mod film;
mod linear;
mod newton;
mod roughness;
mod row;
mod solution;

pub use feed::Feed;
pub(crate) use feed::require_resolved_holes;
use film::FaceIntegral;
pub use film::FilmThickness;
pub use roughness::{MeanContact, MeanRoughness};
pub use solution::GivenFilmSolution;

use std::f64::consts::PI;

use super::ReynoldsError;
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::numerics::Periodicity;
use crate::with_fields::with_fields;

/// Convergence bound of bearings.
const IMBALANCE: f64 = 1e-10;

/// Largest number of Newton steps of bearings on one grid.
const MOST_STEPS: u64 = 100;

/// Positions of the edges in lists of four: at the smallest and largest x, at the smallest and largest y.
const WEST: usize = 0;
const EAST: usize = 1;
const SOUTH: usize = 2;
const NORTH: usize = 3;

/// Fewest nodes around a period and across it.
const LEAST_RING: usize = 3;

/// Memory of a solve per node.
const BYTES: usize = 1200;

/// Boundary condition at the two edges of the box across y.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::{FilmThickness, GivenFilm, SideEdges};
/// let grid = Grid::from_edges(40, 20, [0.0, 1e-2], [0.0, 1e-2])?;
/// let film = FilmThickness::from_function(grid, |x, _| 2e-6 - 1e-4 * x)?;
/// let oil = Lubricant::new(Barus::new(0.01, 0.0)?, Incompressible);
/// let pad = GivenFilm::new(&film, &oil, [1.0, 0.0]);
/// let load = |sides| pad.with_sides(sides).solve().map(|solution| solution.load);
/// assert!(load(SideEdges::Closed)? > 2.0 * load(SideEdges::Ambient)?); // a square pad leaks
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum SideEdges {
    /// The pressures of these edges, with unlimited supply of fluid.
    #[default]
    Ambient,
    /// No flow: planes of symmetry, or seals. A grid of one row has closed edges.
    Closed,
}

/// Two rigid surfaces with a prescribed film.
///
/// Find pressure `p` and film fraction `theta` with
///
/// `d(u theta rho h)/dx = div(rho h^3 / (12 eta) grad p)`, `p >= p_cav`, `0 <= theta <= 1`,
/// `(p - p_cav) (1 - theta) = 0`,
///
/// where `u` is the mean of both speeds. Mass is conserved at rupture and reformation. The film is steady: a
/// textured surface is at rest, and a moving surface is smooth. On a [strip](Grid::strip) the film repeats along y, and
/// there are no side edges. At the edges of the box, half a cell beyond the
/// outermost nodes, pressures are given and the film is full; so it is in [`Feed`]s.
///
/// Pressures may be absolute or relative to ambient. Viscosity and density follow the laws at these
/// pressures, and at zero for negative ones. A grid of one row represents surfaces that are wide along y,
/// without side flow. Forces and flows are then those of the length `dy`, one meter by convention.
///
/// Sources: Elrod and Adams (1974); complementarity form by Giacopini, Fowell, Dini and Strozzi (2010), doi
/// 10.1115/1.4000794.
///
/// ```
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::{FilmThickness, GivenFilm, SideEdges};
/// use stribeck::{Grid, Status};
/// // A pad that converges from 2 to 1 um on 10 mm, one meter wide.
/// let grid = Grid::from_edges(200, 1, [0.0, 1e-2], [0.0, 1.0])?;
/// let film = FilmThickness::from_function(grid, |x, _| 2e-6 - 1e-4 * x)?;
/// let oil = Lubricant::new(Barus::new(0.01, 0.0)?, Incompressible);
/// let solution = GivenFilm::new(&film, &oil, [1.0, 0.0]).with_sides(SideEdges::Ambient).solve()?;
/// assert_eq!(solution.report.status, Status::Converged);
/// // 6 eta U L^2 / h_1^2 (ln 2 - 2/3) for films of 2 to 1.
/// let exact = 6.0 * 0.01 * 1e-4 / 1e-12 * (2.0_f64.ln() - 2.0 / 3.0);
/// assert!((solution.load / exact - 1.0).abs() < 1e-4);
/// assert!(solution.flow.imbalance <= 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct GivenFilm<'a> {
    /// The film between the surfaces, with its grid.
    pub film: &'a FilmThickness,
    /// The lubricant.
    pub lubricant: &'a Lubricant,
    /// Speeds of the lower and of the upper surface along +x \[m/s\], of any sign.
    pub speeds: [f64; 2],
    /// Pressures at the edges of the smallest and largest x, and of the smallest and largest y \[Pa\].
    pub edge_pressures: [f64; 4],
    /// Pressure at which the fluid cavitates \[Pa\], at most that of any edge and feed.
    pub cavitation_pressure: f64,
    /// Boundary condition at the edges across y.
    pub sides: SideEdges,
    /// Whether the film repeats along x with the length of the box, as around a ring: the flow out of one end
    /// enters at the other. Needs a pressure above that of cavitation at a side or in a feed, and at least three rows and columns.
    pub is_periodic: bool,
    /// Grooves and holes.
    pub feeds: &'a [Feed],
    /// Roughness of both surfaces in the mean; smooth surfaces without it.
    pub roughness: Option<MeanRoughness>,
    /// Distance from the sides along the edges across x, over which the pressures of these edges fall linearly to those of
    /// the sides \[m\].
    pub lands: f64,
    /// Diameter of a round hole in the middle of the edges across x \[m\]: beside it their pressure falls to that of the sides as in a film of
    /// uniform thickness, with `ln tan(pi |y|/(2 B))` at the distance y from its middle; 0 without one.
    pub end_hole: f64,
    /// Convergence bound over the inflow, for the sum of the absolute imbalances of all cells (or its rounding error, if
    /// larger) and for the imbalance of the box.
    pub(in crate::reynolds) imbalance: f64,
    /// Largest number of Newton steps on one grid.
    pub(in crate::reynolds) most_steps: u64,
}

impl<'a> GivenFilm<'a> {
    /// A film between surfaces at `speeds` \[m/s\]. Pressures are relative to ambient, which is also the
    /// cavitation pressure and the pressure at all edges.
    pub const fn new(film: &'a FilmThickness, lubricant: &'a Lubricant, speeds: [f64; 2]) -> Self {
        Self {
            film,
            lubricant,
            speeds,
            edge_pressures: [0.0; 4],
            cavitation_pressure: 0.0,
            sides: SideEdges::Ambient,
            is_periodic: false,
            feeds: &[],
            roughness: None,
            lands: 0.0,
            end_hole: 0.0,
            imbalance: IMBALANCE,
            most_steps: MOST_STEPS,
        }
    }
}

with_fields!(<'a> GivenFilm<'a> {
    with_speeds speeds: [f64; 2],
    with_edge_pressures edge_pressures: [f64; 4],
    with_cavitation_pressure cavitation_pressure: f64,
    with_sides sides: SideEdges,
    with_periodic is_periodic: bool,
    with_feeds feeds: &'a [Feed],
    with_roughness roughness: Option<MeanRoughness>,
    with_lands lands: f64,
    with_end_hole end_hole: f64,
});

impl GivenFilm<'_> {
    /// The same pressure \[Pa\] at all edges.
    #[must_use]
    pub fn with_ambient_pressure(self, pressure: f64) -> Self {
        self.with_edge_pressures([pressure; 4])
    }

    /// Solves by Newton's method with a direct factorization, from coarser grids to that of the film.
    ///
    /// # Errors
    /// Speeds or pressures that are not finite, speeds of both signs with roughness, a cavitation pressure above that of an edge or feed, a feed without a
    /// node, a grid that exceeds the memory.
    pub fn solve(&self) -> Result<GivenFilmSolution, ReynoldsError> {
        self.solve_unless(|| false)
    }

    /// Like [`solve`](Self::solve), but stops at the next Newton step after `interrupted` returns true.
    ///
    /// # Errors
    /// The errors of [`solve`](Self::solve), and [`ReynoldsError::Interrupted`].
    pub fn solve_unless(&self, interrupted: impl Fn() -> bool) -> Result<GivenFilmSolution, ReynoldsError> {
        self.validate()?;
        self.film.grid().require_memory(BYTES)?;
        solution::solve(self, &interrupted).ok_or(ReynoldsError::Interrupted)
    }

    /// The axis along which the film repeats.
    fn periodicity(&self) -> Periodicity {
        match (self.is_periodic, self.film.grid().is_strip()) {
            (true, _) => Periodicity::AlongX,
            (false, true) => Periodicity::AlongY,
            (false, false) => Periodicity::None,
        }
    }

    /// The interval of `film` along x that ends at node `(i, j)`; of a periodic film the first and the last one are those
    /// over its end.
    fn interval(&self, film: &FilmThickness, i: usize, j: usize) -> FaceIntegral {
        if self.is_periodic && (i == 0 || i == film.grid().nx()) {
            film.over_end(j)
        } else {
            film.along(i, j)
        }
    }

    /// Pressures of the nodes in feeds \[Pa\].
    fn fed(&self, grid: Grid) -> Vec<Option<f64>> {
        let at = |point| self.feeds.iter().find(|feed| feed.contains(point)).map(|feed| feed.pressure);
        grid.nodes().map(at).collect()
    }

    /// Pressure at the edge `WEST` or `EAST` in row `j` of `grid` \[Pa\].
    fn end_pressure(&self, edge: usize, j: usize, grid: Grid) -> f64 {
        let south = grid.y(j) - grid.y(0) + 0.5 * grid.dy();
        let north = grid.size_y() - south;
        let (distance, side) = if south < north { (south, SOUTH) } else { (north, NORTH) };
        let (whole, side) = (self.edge_pressures[edge], self.edge_pressures[side]);
        let from_middle = 0.5 * grid.size_y() - distance;
        if self.end_hole > 0.0 && from_middle > 0.5 * self.end_hole {
            let fall = |offset: f64| (0.5 * PI * offset / grid.size_y()).tan().ln();
            return side + (whole - side) * fall(from_middle) / fall(0.5 * self.end_hole);
        }
        if distance < self.lands { side + (whole - side) * distance / self.lands } else { whole }
    }

    /// Mean speed of both surfaces \[m/s\].
    fn entrainment_speed(&self) -> f64 {
        0.5 * self.speeds[0] + 0.5 * self.speeds[1]
    }

    /// Error for a periodic film with too few nodes, or that nothing feeds.
    fn validate_period(&self) -> Result<(), InputError> {
        if !self.is_periodic {
            return Ok(());
        }
        let (grid, conflict) = (self.film.grid(), |field: &str, reason: String| {
            Err(InputError::Conflict { field: field.to_owned(), reason })
        });
        if grid.nx() < LEAST_RING || grid.ny() < LEAST_RING {
            let found = format!("found {} x {}", grid.nx(), grid.ny());
            return conflict(
                "is_periodic",
                format!("a film that repeats along x needs at least 3 x 3 nodes, {found}"),
            );
        }
        if grid.is_strip() {
            return conflict(
                "is_periodic",
                "a film on a strip repeats along y; along x or y, not both".to_owned(),
            );
        }
        let sides = if self.sides == SideEdges::Ambient { &self.edge_pressures[SOUTH..] } else { &[] };
        let mut supplies = sides.iter().copied().chain(self.feeds.iter().map(|feed| feed.pressure));
        if supplies.any(|pressure| pressure > self.cavitation_pressure) {
            return Ok(());
        }
        conflict(
            "cavitation_pressure",
            "a film that repeats along x loses oil where its pressure is above that of its sides, and draws in none: it runs dry; a \
             cavitation pressure below that of the sides, such as -1 bar, or a feed"
                .to_owned(),
        )
    }

    /// Checks speeds and pressures; the error names the first invalid field.
    fn validate(&self) -> Result<(), InputError> {
        for (field, value) in [
            ("speeds.0", self.speeds[0]),
            ("speeds.1", self.speeds[1]),
            ("cavitation_pressure", self.cavitation_pressure),
        ] {
            InputError::require(value.is_finite(), field, value, "finite")?;
        }
        for (edge, pressure) in self.edge_pressures.into_iter().enumerate() {
            InputError::require(
                pressure.is_finite() && pressure >= self.cavitation_pressure,
                &format!("edge_pressures.{edge}"),
                pressure,
                "finite and at least the cavitation pressure",
            )?;
        }
        self.validate_roughness()?;
        self.validate_period()?;
        InputError::require_non_negative("lands", self.lands)?;
        let grid = self.film.grid();
        InputError::require(
            self.end_hole >= 0.0 && self.end_hole < grid.size_y(),
            "end_hole",
            self.end_hole,
            "at least 0 and below the width of the film",
        )?;
        let mut feeds = self.feeds.iter().enumerate();
        feeds.try_for_each(|(index, feed)| feed.validate(index, grid, self.cavitation_pressure))
    }
}
