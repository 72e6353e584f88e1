//! Mean flow and mean contact of rough surfaces.
//!
//! The mean flow of a full film is `u h_c - phi_x h^3/(12 eta) dp/dx` with the entrained gap `h_c = h_T + s sigma phi_s`. Between two nodes
//! the integrals of `h_c/(phi_x h^3)` and `1/(phi_x h^3)` take the places of those of `1/h^2` and `1/h^3`.

use super::film::Piece;
use super::{GivenFilm, GivenFilmSolution};
use crate::analytic::{GreenwoodTripp, PatirCheng};
use crate::error::InputError;

/// Roughness of both surfaces of a [`GivenFilm`] in the mean: the nominal film is the distance of their mean planes.
///
/// The flow has the factors of Patir and Cheng ([`PatirCheng`]), solids the mean pressure of Greenwood and Tripp
/// ([`GreenwoodTripp`]), which depends on the film alone: no deformation of the bodies. Use it where surfaces are conformal and pressures
/// are far below those of concentrated contacts.
///
/// ```
/// use stribeck::Grid;
/// use stribeck::analytic::GreenwoodTripp;
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::{FilmThickness, GivenFilm, MeanRoughness};
/// let grid = Grid::from_edges(60, 1, [0.0, 1e-2], [0.0, 1.0])?;
/// let film = FilmThickness::from_function(grid, |x, _| 2e-6 - 1e-4 * x)?;
/// let oil = Lubricant::new(Barus::new(0.01, 0.0)?, Incompressible);
/// let contact = GreenwoodTripp::new(0.05, 0.01, 230e9)?;
/// let rough = MeanRoughness::new([0.2e-6, 0.3e-6], 1.0, contact, 0.1)?;
/// let pad = GivenFilm::new(&film, &oil, [1.0, 0.0]).with_roughness(Some(rough));
/// let solution = pad.solve()?;
/// let solids = solution.contact.ok_or("no roughness")?;
/// assert!(solids.load > 0.0 && solids.load < solution.load);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct MeanRoughness {
    /// Root mean square heights of the lower and of the upper surface \[m\].
    pub rq: [f64; 2],
    /// Flow factors.
    pub flow: PatirCheng,
    /// Pressure and area of contact.
    pub contact: GreenwoodTripp,
    /// Shear stress of solid contact over its pressure.
    pub boundary_friction: f64,
}

/// Solid contact of a [`GivenFilm`] with [`MeanRoughness`].
///
/// ```
/// use stribeck::Grid;
/// use stribeck::analytic::GreenwoodTripp;
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::{FilmThickness, GivenFilm, MeanRoughness};
/// // Parallel planes at twice the roughness.
/// let grid = Grid::from_edges(8, 8, [0.0, 1e-2], [0.0, 1e-2])?;
/// let film = FilmThickness::from_function(grid, |_, _| 1e-6)?;
/// let oil = Lubricant::new(Barus::new(0.01, 0.0)?, Incompressible);
/// let law = GreenwoodTripp::new(0.05, 0.01, 230e9)?;
/// let rough = MeanRoughness::new([0.3e-6, 0.4e-6], 1.0, law, 0.1)?;
/// let solids = GivenFilm::new(&film, &oil, [1.0, 0.0]).with_roughness(Some(rough)).solve()?.contact.ok_or("smooth")?;
/// assert!((solids.load / (law.pressure(2.0) * 1e-4) - 1.0).abs() < 1e-9);
/// assert!((solids.friction / (0.1 * solids.load) - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeanContact {
    /// Mean contact pressure at the nodes \[Pa\]; 0 in feeds.
    pub pressure: Vec<f64>,
    /// Its integral \[N\].
    pub load: f64,
    /// Area of contact \[m^2\].
    pub area: f64,
    /// Friction force of solid contact on either surface \[N\], its absolute value.
    pub friction: f64,
    /// Smallest nominal film over the root mean square height of both surfaces together.
    pub least_separation: f64,
}

impl MeanRoughness {
    /// Roughness with the root mean square heights `rq` of the lower and the upper surface \[m\] and the Peklenik number `gamma`.
    ///
    /// # Errors
    /// Heights that are negative, not finite, or both zero; a Peklenik number outside 1/9 to 9; a coefficient of friction that is negative or not
    /// finite.
    pub fn new(
        rq: [f64; 2],
        gamma: f64,
        contact: GreenwoodTripp,
        boundary_friction: f64,
    ) -> Result<Self, InputError> {
        InputError::require_non_negative("rq.0", rq[0])?;
        InputError::require_non_negative("rq.1", rq[1])?;
        InputError::require_positive("rq", rq[0].hypot(rq[1]))?;
        InputError::require_non_negative("boundary_friction", boundary_friction)?;
        Ok(Self { rq, flow: PatirCheng::new(gamma)?, contact, boundary_friction })
    }

    /// Least film of an equilibrium over the root mean square height of both surfaces, where flow factors end.
    pub(crate) const LEAST_SEPARATION: f64 = 0.5;

    /// Root mean square height of both surfaces together \[m\].
    pub fn composite_rq(&self) -> f64 {
        self.rq[0].hypot(self.rq[1])
    }

    /// Variance of the lower surface less that of the upper, over their sum.
    fn difference(&self) -> f64 {
        let [lower, upper] = self.rq.map(|rq| rq / self.composite_rq());
        lower * lower - upper * upper
    }

    /// The piece with mean conductance and entrainment at the `slip` `(u_1 - u_2)/(u_1 + u_2)`.
    fn averaged(&self, piece: Piece, slip: f64) -> Piece {
        let sigma = self.composite_rq();
        let separation = piece.film() / sigma;
        let [along, _] = self.flow.pressure_flow(separation);
        let by_sliding = slip * self.difference() * self.flow.shear_flow(separation);
        let cubes = piece.cubes / along;
        Piece { squares: cubes * sigma * (self.flow.mean_gap(separation) + by_sliding), cubes }
    }

    /// Factors of the shear stresses in the film `film` \[m\]: of sliding on the lower and the upper surface, of the pressure
    /// gradient.
    pub(super) fn shear_factors(&self, film: f64) -> [f64; 3] {
        let [mean, difference, gradient] = self.flow.shear_stress(film / self.composite_rq());
        let difference = self.difference() * difference;
        [mean - difference, mean + difference, gradient]
    }
}

impl GivenFilm<'_> {
    /// Pieces of the interval that ends at node `(i, j)` of `film`, averaged over the roughness.
    pub(super) fn pieces(&self, film: &super::FilmThickness, i: usize, j: usize) -> [Piece; 2] {
        let [lower, upper] = self.speeds;
        let sum = lower + upper;
        let slip = if sum != 0.0 { (lower - upper) / sum } else { 0.0 };
        let pieces = self.interval(film, i, j).pieces;
        self.roughness.map_or(pieces, |rough| pieces.map(|piece| rough.averaged(piece, slip)))
    }

    /// `1/h^3` integrated from node `(i, j - 1)` to `(i, j)` of `film` \[1/m^2\], over the flow factor.
    pub(super) fn cubes_across(&self, film: &super::FilmThickness, i: usize, j: usize) -> f64 {
        let cubes = film.across(i, j);
        let Some(rough) = self.roughness else { return cubes };
        let grid = film.grid();
        let length = if j == 0 || j == grid.ny() { 0.5 * grid.dy() } else { grid.dy() };
        let [_, across] = rough.flow.pressure_flow((length / cubes).cbrt() / rough.composite_rq());
        cubes / across
    }

    /// The solid contact.
    pub(super) fn contact(&self) -> Option<MeanContact> {
        let rough = self.roughness?;
        let grid = self.film.grid();
        let separations: Vec<f64> =
            self.film.nodes().iter().map(|film| film / rough.composite_rq()).collect();
        let (mut pressure, mut area) = (Vec::with_capacity(grid.len()), 0.0);
        for (fed, &separation) in self.fed(grid).into_iter().zip(&separations) {
            let touches = fed.is_none();
            pressure.push(if touches { rough.contact.pressure(separation) } else { 0.0 });
            area += if touches { rough.contact.area_ratio(separation) * grid.cell_area() } else { 0.0 };
        }
        let load = pressure.iter().sum::<f64>() * grid.cell_area();
        let slides = (self.speeds[0] - self.speeds[1]).abs() > 0.0;
        Some(MeanContact {
            load,
            area,
            friction: if slides { rough.boundary_friction * load } else { 0.0 },
            least_separation: separations.iter().copied().fold(f64::INFINITY, f64::min),
            pressure,
        })
    }

    /// Error for speeds of both signs: their shear flow may exceed the entrainment.
    pub(super) fn validate_roughness(&self) -> Result<(), InputError> {
        let [lower, upper] = self.speeds;
        if self.roughness.is_some() && lower * upper < 0.0 {
            return Err(InputError::Conflict {
                field: format!("speeds = [{lower}, {upper}] m/s"),
                reason: "flow factors of rough surfaces need speeds of one sign, or one surface at rest; leave out the roughness, \
                         or solve in a frame in which one surface rests"
                    .to_owned(),
            });
        }
        Ok(())
    }
}

impl GivenFilmSolution {
    /// Adds load, friction and power of the solid contact of `problem`.
    pub(super) fn add_contact(&mut self, problem: &GivenFilm<'_>) {
        self.contact = problem.contact();
        let Some(contact) = &self.contact else { return };
        let sliding = problem.speeds[1] - problem.speeds[0];
        let friction = contact.friction * sliding.signum();
        self.load += contact.load;
        self.friction[0] += friction;
        self.friction[1] -= friction;
        self.power_loss += contact.friction * sliding.abs();
    }
}
