//! Journal bearings: films of eccentric circles, load vector, equilibrium under a load.
//!
//! | file | content |
//! |---|---|
//! | `feeds` | grooves and holes of the bush |
//! | `bore` | deflection of journal and bush under the pressure of the film |

mod bore;
mod feeds;

pub use bore::ElasticBore;
pub use feeds::{Grooves, Holes};

use super::ReynoldsError;
use super::given_film::{FilmThickness, GivenFilm, GivenFilmSolution, MeanRoughness};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::numerics::FalsePosition;
use crate::with_fields::with_fields;

/// Largest eccentricity of an equilibrium of smooth surfaces.
const MOST_ECCENTRIC: f64 = 0.99;
/// Least film of an equilibrium of rough surfaces over their root mean square height.
const LEAST_SEPARATION: f64 = 0.5;
/// Largest clearance over the radius; the film is that of a thin gap.
const MOST_CLEARANCE: f64 = 0.1;
/// Relative error of the load of an equilibrium.
const LOAD_TOLERANCE: f64 = 1e-6;
/// Most solves of an equilibrium.
const MOST_SOLVES: usize = 60;
/// Change of the attitude angle \[rad\] below which grooves keep their position to the line of centers.
const ATTITUDE_TOLERANCE: f64 = 1e-3;
/// Part of the way to either end within which the eccentricity moves with the angle of the feeds.
const NEAR: f64 = 0.03;
/// First attitude angle \[rad\], that of moderate loads.
const FIRST_ATTITUDE: f64 = 0.8;
/// Share of the change of the attitude angle that a step takes.
const DAMPING: f64 = 0.8;
/// Most positions of the grooves at one eccentricity.
const MOST_POSITIONS: usize = 20;

/// A journal that turns in a bush of finite width, with the film `h = c (1 + e cos phi)`.
///
/// The angle `phi` begins where the gap is widest, in the direction of rotation. There the film is supplied at ambient
/// pressure, unless the bush has [`Grooves`] or [`Holes`]; at both sides pressure is ambient too. The film cavitates at ambient pressure with conservation of mass
/// ([`GivenFilm`]). Axes are parallel, the state is steady.
///
/// Short bearings (Ocvirk): `W = eta omega R L^3/(4 c^2) e/(1 - e^2)^2 sqrt(pi^2 (1 - e^2) + 16 e^2)`.
/// Source: Ocvirk (1952), Short-bearing approximation for full journal bearings, NACA TN 2808.
///
/// ```
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::JournalBearing;
/// let oil = Lubricant::new(Barus::new(0.02, 0.0)?, Incompressible);
/// let bearing = JournalBearing::new([25e-3, 50e-3, 25e-6], 300.0, &oil).with_cells([90, 20]);
/// let solution = bearing.solve(0.5)?;
/// // Butenschoen's table: Sommerfeld number 0.890, attitude angle 56.7 degrees.
/// assert!((solution.sommerfeld / 0.8903 - 1.0).abs() < 0.03);
/// assert!((solution.attitude.to_degrees() - 56.7).abs() < 1.0);
/// let under = bearing.equilibrium(solution.load)?;
/// assert!((under.eccentricity - 0.5).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct JournalBearing<'a> {
    /// Radius of the journal \[m\].
    pub radius: f64,
    /// Width of the bearing \[m\].
    pub width: f64,
    /// Radial clearance: difference of the radii \[m\].
    pub clearance: f64,
    /// Angular speed of the journal \[rad/s\].
    pub angular_speed: f64,
    /// The lubricant.
    pub lubricant: &'a Lubricant,
    /// Cells around the journal and across the width.
    pub cells: [usize; 2],
    /// Grooves in the bush.
    pub grooves: Option<Grooves<'a>>,
    /// Round holes that feed the film.
    pub holes: Option<Holes<'a>>,
    /// Deflection of journal and bush under the pressure of the film; rigid without it.
    pub bore: Option<ElasticBore>,
    /// Roughness of journal (lower surface) and bush in the mean.
    pub roughness: Option<MeanRoughness>,
}

/// A solved [`JournalBearing`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct JournalSolution {
    /// Distance of the axes over the clearance.
    pub eccentricity: f64,
    /// Load \[N\], the magnitude of the force of film and contact on the journal.
    pub load: f64,
    /// Components of that force \[N\]: towards the widest gap, and across in the direction of rotation there.
    pub force: [f64; 2],
    /// Share of the load that solid contact carries, its force along the load; 0 for smooth surfaces.
    pub contact_share: f64,
    /// Attitude angle between the load and the line of centers \[rad\].
    pub attitude: f64,
    /// Sommerfeld number `W psi^2/(L D eta omega)` with `psi = c/R` and the viscosity at ambient pressure.
    pub sommerfeld: f64,
    /// Least film \[m\].
    pub least_film: f64,
    /// Flow from the grooves \[m^3/s at the density of zero pressure\]; 0 without grooves.
    pub groove_flow: f64,
    /// Flow from the holes \[m^3/s at the density of zero pressure\]; 0 without holes.
    pub hole_flow: f64,
    /// Largest widening of the film by the deflection of journal and bush \[m\]; 0 of rigid ones.
    pub bore_widening: f64,
    /// The unrolled film: `x = R phi`; the lower surface is the journal.
    pub film: GivenFilmSolution,
}

impl<'a> JournalBearing<'a> {
    /// A bearing of `[radius, width, clearance]` \[m\] with the angular speed of its journal \[rad/s\], on 180 x 40 cells.
    pub const fn new(size: [f64; 3], angular_speed: f64, lubricant: &'a Lubricant) -> Self {
        let [radius, width, clearance] = size;
        Self {
            radius,
            width,
            clearance,
            angular_speed,
            lubricant,
            cells: [180, 40],
            grooves: None,
            holes: None,
            bore: None,
            roughness: None,
        }
    }
}

with_fields!(<'a> JournalBearing<'a> {
    with_cells cells: [usize; 2],
    with_grooves grooves: Option<Grooves<'a>>,
    with_holes holes: Option<Holes<'a>>,
    with_bore bore: Option<ElasticBore>,
    with_roughness roughness: Option<MeanRoughness>,
});

impl JournalBearing<'_> {
    /// Solves at an `eccentricity` of the axes over the clearance, 0 to below 1.
    ///
    /// # Errors
    /// A value out of range, a grid that exceeds the memory.
    pub fn solve(&self, eccentricity: f64) -> Result<JournalSolution, ReynoldsError> {
        self.solve_unless(eccentricity, &|| false)
    }

    /// The eccentricity at which the film carries `load` \[N\], by false position (Illinois).
    ///
    /// # Errors
    /// A value out of range, a load that needs an eccentricity above 0.99 (for rough surfaces also a film below half the root mean square
    /// height), a grid that exceeds the memory.
    pub fn equilibrium(&self, load: f64) -> Result<JournalSolution, ReynoldsError> {
        self.equilibrium_unless(load, &|| false)
    }

    /// Like [`equilibrium`](Self::equilibrium), but ends with an error soon after `interrupted` returns true.
    ///
    /// # Errors
    /// Those of [`equilibrium`](Self::equilibrium), and [`ReynoldsError::Interrupted`].
    pub fn equilibrium_unless(
        &self,
        load: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        InputError::require_positive("load", load)?;
        self.with_settled_load(|attitude, last| {
            let near = last.filter(|_| self.bore.is_none()).map(|last| last.eccentricity);
            match near
                .map(|near| self.equilibrium_near(load, attitude, near, interrupted))
                .transpose()?
                .flatten()
            {
                Some(solution) => Ok(solution),
                None => self.equilibrium_at(load, attitude, interrupted),
            }
        })
    }

    /// The equilibrium under `load` with grooves at the `attitude` angle.
    fn equilibrium_at(
        &self,
        load: f64,
        attitude: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        if let Some(bore) = self.bore {
            return bore::equilibrium(self, bore, [load, attitude], interrupted);
        }
        let most = self.most_eccentric();
        let solution = self.solve_at(most, attitude, interrupted)?;
        if solution.load < load {
            return Err(InputError::Conflict {
                field: format!("load = {load} N"),
                reason: format!(
                    "the film carries {:.6} N at an eccentricity of {most}; a smaller load, a thicker oil, a \
                     higher speed or a smaller clearance",
                    solution.load
                ),
            }
            .into());
        }
        // The load is zero at the eccentricity zero and grows with it, steeply near one: where false position is slow,
        // halving brackets the root.
        let bracket = FalsePosition::new([0.0, -load], [most, solution.load - load], None);
        self.narrowed(bracket, (load, attitude), solution, interrupted)
    }

    /// The equilibrium at an eccentricity in `bracket`, from a `solution` at one of its ends.
    fn narrowed(
        &self,
        mut bracket: FalsePosition,
        (load, attitude): (f64, f64),
        mut solution: JournalSolution,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        for _ in 0..MOST_SOLVES {
            if (solution.load / load - 1.0).abs() < LOAD_TOLERANCE {
                break;
            }
            let eccentricity = bracket.next(0.01);
            solution = self.solve_at(eccentricity, attitude, interrupted)?;
            bracket.add(eccentricity, solution.load - load);
        }
        Ok(solution)
    }

    /// The equilibrium close to the eccentricity `near`; `None` if it is not there.
    fn equilibrium_near(
        &self,
        load: f64,
        attitude: f64,
        near: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<Option<JournalSolution>, ReynoldsError> {
        let here = self.solve_at(near, attitude, interrupted)?;
        let excess = here.load - load;
        let beyond = if excess > 0.0 { near - NEAR * near } else { near + NEAR * (1.0 - near) };
        let other = self.solve_at(beyond, attitude, interrupted)?;
        if excess * (other.load - load) > 0.0 {
            return Ok(None);
        }
        let mut ends = [[near, excess], [beyond, other.load - load]];
        ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let bracket = FalsePosition::new(ends[0], ends[1], None);
        self.narrowed(bracket, (load, attitude), here, interrupted).map(Some)
    }

    /// Largest eccentricity of an equilibrium.
    fn most_eccentric(&self) -> f64 {
        let thinnest = |rough: MeanRoughness| 1.0 - LEAST_SEPARATION * rough.composite_rq() / self.clearance;
        self.roughness.map_or(MOST_ECCENTRIC, |rough| thinnest(rough).max(MOST_ECCENTRIC))
    }

    /// Solves unless `interrupted`; grooves have a fixed angle to the load, whose direction is found by iteration.
    pub(crate) fn solve_unless(
        &self,
        eccentricity: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        self.with_settled_load(|attitude, _| self.solve_at(eccentricity, attitude, interrupted))
    }

    /// The solution of `solve` at the attitude angle that it has itself: feeds have fixed angles to the load. `solve` takes the angle and the
    /// last solution.
    fn with_settled_load(
        &self,
        solve: impl Fn(f64, Option<&JournalSolution>) -> Result<JournalSolution, ReynoldsError>,
    ) -> Result<JournalSolution, ReynoldsError> {
        let (mut attitude, mut last) = (FIRST_ATTITUDE, None);
        for position in 0..MOST_POSITIONS {
            let solution = solve(attitude, last.as_ref())?;
            let change = solution.attitude - attitude;
            if !self.is_fed() || solution.eccentricity == 0.0 || change.abs() < ATTITUDE_TOLERANCE {
                return Ok(solution);
            }
            // The first angle is a guess.
            attitude += if position == 0 { change } else { DAMPING * change };
            last = Some(solution);
        }
        Err(InputError::Conflict {
            field: "supply_pressure".to_owned(),
            reason: "the direction of the load does not settle; a lower supply pressure or another angle"
                .to_owned(),
        }
        .into())
    }

    /// Solves with feeds at the `attitude` angle of the load.
    fn solve_at(
        &self,
        eccentricity: f64,
        attitude: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        let requirement = "at least 0 and below 1: the distance of the axes over the radial clearance";
        InputError::require((0.0..1.0).contains(&eccentricity), "eccentricity", eccentricity, requirement)?;
        match self.bore {
            None => self.film_at([eccentricity, attitude], &[], interrupted),
            Some(bore) => bore::solve(self, bore, [eccentricity, attitude], interrupted),
        }
    }

    /// The grid of the film with feeds at the `attitude` angle of the load.
    fn grid(&self, attitude: f64) -> Result<Grid, InputError> {
        Grid::from_edges(self.cells[0], self.cells[1], self.supply(attitude).ends, [0.0, self.width])
    }

    /// Solves the film at `[eccentricity, attitude]`, with the film wider by `widening` \[m\] on the nodes, or not if that is empty.
    fn film_at(
        &self,
        [eccentricity, attitude]: [f64; 2],
        widening: &[f64],
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        self.validate()?;
        let grid = self.grid(attitude)?;
        let supply = self.supply(attitude);
        self.validate_holes(&supply)?;
        let (land, pressure) = (supply.land, supply.end_pressure);
        let gap = |x: f64| self.clearance * (1.0 + eccentricity * (x / self.radius).cos());
        let film = FilmThickness::from_function(grid, |x, y| {
            gap(x)
                + if widening.is_empty() { 0.0 } else { grid.interpolate(widening, x, y).unwrap_or(f64::NAN) }
        })?;
        let speed = self.angular_speed * self.radius;
        let mut solution = GivenFilm::new(&film, self.lubricant, [speed, 0.0])
            .with_edge_pressures([pressure, pressure, 0.0, 0.0])
            .with_lands(land)
            .with_end_hole(supply.end_hole)
            .with_feeds(&supply.feeds)
            .with_roughness(self.roughness)
            .solve_unless(interrupted)?;
        // Through both lands beside the first groove, `w h^3 p/(12 eta l)`.
        let viscosity = self.lubricant.viscosity().viscosity(0.0);
        let through_land = match supply.first_groove {
            Some([middle, width]) if land > 0.0 => {
                width * gap(middle).powi(3) * pressure / (12.0 * viscosity * land)
            }
            _ => 0.0,
        };
        solution.add_side_flow(through_land);
        let [cosine, sine] = self.moments(&solution, &solution.pressure);
        let contact = solution.contact.as_ref();
        let contact = contact.map_or([0.0; 2], |contact| self.moments(&solution, &contact.pressure));
        // The film pushes the journal inwards, against the direction of the angle.
        let in_groove = self.force_in_groove(&supply);
        let force = [-cosine - contact[0] - in_groove[0], -sine - contact[1] - in_groove[1]];
        let load = force[0].hypot(force[1]);
        let psi = self.clearance / self.radius;
        let area = 2.0 * self.width * self.radius;
        let [holes, grooves] = supply.flows(&solution.feed_flows);
        let at_ends = 2.0 * through_land - solution.edge_flows[0] - solution.edge_flows[1];
        let begins_at_hole = supply.end_hole > 0.0;
        let least = film.nodes().iter().copied().fold(f64::INFINITY, f64::min);
        Ok(JournalSolution {
            eccentricity,
            load,
            force,
            contact_share: if load > 0.0 {
                0.0 - (contact[0] * force[0] + contact[1] * force[1]) / (load * load)
            } else {
                0.0
            },
            attitude: (-self.angular_speed.signum() * force[1]).atan2(force[0]),
            sommerfeld: load * psi * psi / (area * viscosity * self.angular_speed.abs()),
            least_film: if widening.is_empty() { self.clearance * (1.0 - eccentricity) } else { least },
            groove_flow: if self.grooves.is_some() { grooves + at_ends } else { 0.0 },
            hole_flow: if begins_at_hole { holes + at_ends } else { holes },
            bore_widening: widening.iter().copied().fold(0.0, f64::max),
            film: solution,
        })
    }

    /// Integrals of `p cos phi` and `p sin phi` of a `pressure` over the bearing \[N\], by the midpoints of the cells.
    fn moments(&self, solution: &GivenFilmSolution, pressure: &[f64]) -> [f64; 2] {
        let grid = solution.grid();
        let mut moments = [0.0; 2];
        for ((x, _), pressure) in grid.nodes().zip(pressure) {
            let (sin, cos) = (x / self.radius).sin_cos();
            moments[0] += pressure * grid.cell_area() * cos;
            moments[1] += pressure * grid.cell_area() * sin;
        }
        moments
    }

    /// Checks all values.
    fn validate(&self) -> Result<(), InputError> {
        InputError::require_positive("radius", self.radius)?;
        InputError::require_positive("width", self.width)?;
        InputError::require_positive("clearance", self.clearance)?;
        InputError::require(
            self.clearance <= MOST_CLEARANCE * self.radius,
            "clearance",
            self.clearance,
            "at most a tenth of the radius: it is the difference of the radii",
        )?;
        InputError::require(
            self.angular_speed.is_finite() && self.angular_speed != 0.0,
            "angular_speed",
            self.angular_speed,
            "finite and not 0",
        )?;
        if let Some(bore) = self.bore {
            bore.validate()?;
        }
        match self.grooves {
            Some(grooves) => self.validate_grooves(grooves),
            None => Ok(()),
        }
    }
}
