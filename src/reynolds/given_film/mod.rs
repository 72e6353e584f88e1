//! Rigid surfaces with a film that is given: pressure and content by the Reynolds equation.
//!
//! Apart from the coupled contact: nothing deforms, no load is balanced, no solids touch. Textured bearings
//! and sliders, and closed forms to test cavitation with. The films between the nodes (`film`) make the
//! balances of the cells (`balance`), whose Newton steps (`newton`) are linear systems on the stencil
//! (`linear`); pressures along the rows (`row`) make forces and places of reformation (`solution`).

mod balance;
mod film;
mod linear;
mod newton;
mod row;
mod solution;

pub use film::FilmThickness;
pub use solution::GivenFilmSolution;

use super::ReynoldsError;
use crate::error::InputError;
use crate::lubricant::Lubricant;
use crate::with_fields::with_fields;

/// Sum of the absolute imbalances of all cells, unless rounding leaves more, and imbalance of the box, over
/// the inflow, at which a solve has converged.
const IMBALANCE: f64 = 1e-10;

/// Memory that a solve needs for a node.
const BYTES: usize = 1200;

/// What holds at the two edges of the box across y.
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
    /// Ambient pressure, and as much fluid as the film takes.
    #[default]
    Ambient,
    /// Nothing flows through them: planes of symmetry, or seals. A grid of one row has these.
    Closed,
}

/// Two rigid surfaces with a film that is given.
///
/// Find pressure `p` and content `theta` with
///
/// `d(u theta rho h)/dx = div(rho h^3 / (12 eta) grad p)`, `p >= p_cav`, `0 <= theta <= 1`,
/// `(p - p_cav) (1 - theta) = 0`,
///
/// `u` being the mean of both speeds: mass is conserved where the film ruptures and where it reforms. The
/// film stands still, so that a surface with texture is at rest and one that moves is smooth. Pressure is
/// ambient, and the film is full, at the two edges of the box across x, half a cell beyond the outermost
/// nodes.
///
/// Pressures are absolute or above ambient, as the caller likes; viscosity and density are those of the laws
/// at these pressures, below zero those at zero. On a grid of one row nothing flows across it: surfaces that
/// are wide along y, of which forces and flows are those of the length `dy`, one metre by custom.
///
/// Sources: Elrod and Adams (1974); as one complementary pair Giacopini, Fowell, Dini and Strozzi (2010), doi
/// 10.1115/1.4000794.
///
/// ```
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::{FilmThickness, GivenFilm, SideEdges};
/// use stribeck::{Grid, Status};
/// // A pad that converges from 2 to 1 um on 10 mm, one metre wide.
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
    /// The film between the surfaces; it also fixes the grid.
    pub film: &'a FilmThickness,
    /// The lubricant.
    pub lubricant: &'a Lubricant,
    /// Speeds of the lower and of the upper surface along +x \[m/s\], of any sign.
    pub speeds: [f64; 2],
    /// Pressure at the edges \[Pa\].
    pub ambient_pressure: f64,
    /// Pressure at which the fluid cavitates \[Pa\], at most ambient.
    pub cavitation_pressure: f64,
    /// What holds at the edges across y.
    pub sides: SideEdges,
}

impl<'a> GivenFilm<'a> {
    /// A film between surfaces of these `speeds` \[m/s\], all pressures counted from the ambient one, at
    /// which the fluid cavitates and which holds at all edges.
    pub const fn new(film: &'a FilmThickness, lubricant: &'a Lubricant, speeds: [f64; 2]) -> Self {
        Self {
            film,
            lubricant,
            speeds,
            ambient_pressure: 0.0,
            cavitation_pressure: 0.0,
            sides: SideEdges::Ambient,
        }
    }
}

with_fields!(<'a> GivenFilm<'a> {
    with_speeds speeds: [f64; 2],
    with_ambient_pressure ambient_pressure: f64,
    with_cavitation_pressure cavitation_pressure: f64,
    with_sides sides: SideEdges,
});

impl GivenFilm<'_> {
    /// Solves by Newton's method with a direct factorisation, from coarser grids to that of the film.
    ///
    /// # Errors
    /// Speeds or pressures that are not finite, a cavitation pressure above ambient, more nodes than there is
    /// memory for.
    pub fn solve(&self) -> Result<GivenFilmSolution, ReynoldsError> {
        self.solve_unless(|| false)
    }

    /// The same, given up at the next Newton step once `interrupted` returns true.
    ///
    /// # Errors
    /// As [`solve`](Self::solve), and [`ReynoldsError::Interrupted`].
    pub fn solve_unless(&self, interrupted: impl Fn() -> bool) -> Result<GivenFilmSolution, ReynoldsError> {
        self.validate()?;
        self.film.grid().require_memory(BYTES)?;
        solution::solve(self, &interrupted).ok_or(ReynoldsError::Interrupted)
    }

    /// Mean speed of both surfaces \[m/s\].
    fn entrainment_speed(&self) -> f64 {
        0.5 * self.speeds[0] + 0.5 * self.speeds[1]
    }

    /// Checks speeds, pressures and fields; the error names the first that does not fit.
    fn validate(&self) -> Result<(), InputError> {
        for (field, value) in [
            ("speeds.0", self.speeds[0]),
            ("speeds.1", self.speeds[1]),
            ("ambient_pressure", self.ambient_pressure),
            ("cavitation_pressure", self.cavitation_pressure),
        ] {
            InputError::require(value.is_finite(), field, value, "finite")?;
        }
        InputError::require(
            self.cavitation_pressure <= self.ambient_pressure,
            "cavitation_pressure",
            self.cavitation_pressure,
            "at most the ambient pressure",
        )
    }
}
