//! Journal bearings: films of eccentric circles, load vector, equilibrium under a load.

use std::f64::consts::{PI, TAU};

use super::ReynoldsError;
use super::given_film::{Feed, FilmThickness, GivenFilm, GivenFilmSolution, MeanRoughness};
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
/// First attitude angle \[rad\], that of moderate loads.
const FIRST_ATTITUDE: f64 = 0.8;
/// Share of the change of the attitude angle that a step takes.
const DAMPING: f64 = 0.8;
/// Most positions of the grooves at one eccentricity.
const MOST_POSITIONS: usize = 20;

/// Axial grooves in the middle of the width of the bush.
///
/// In the lands between a groove and the sides its pressure falls linearly to that of the sides. The film begins and ends full, with the pressure of the groove; the groove itself has no friction. The first angle of the list
/// is where the film begins.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Grooves<'a> {
    /// Angles of their middles from the load \[rad\], in the direction of rotation.
    pub angles: &'a [f64],
    /// Width along the circumference \[m\].
    pub width: f64,
    /// Length along the axis \[m\], less than the width of the bearing under a pressure: the flow from a corner of groove
    /// and side is infinite.
    pub length: f64,
    /// Pressure above ambient \[Pa\].
    pub pressure: f64,
}

impl<'a> Grooves<'a> {
    /// Grooves of the `[width, length]` \[m\] and the `pressure` \[Pa\] above ambient at `angles` from the load \[rad\].
    pub const fn new(angles: &'a [f64], [width, length]: [f64; 2], pressure: f64) -> Self {
        Self { angles, width, length, pressure }
    }
}

/// A rigid journal that turns in a rigid bush of finite width, with the film `h = c (1 + e cos phi)`.
///
/// The angle `phi` begins where the gap is widest, in the direction of rotation. There the film is supplied at ambient
/// pressure, unless the bush has [`Grooves`]; at both sides pressure is ambient too. The film cavitates at ambient pressure with conservation of mass
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
            roughness: None,
        }
    }
}

with_fields!(<'a> JournalBearing<'a> {
    with_cells cells: [usize; 2],
    with_grooves grooves: Option<Grooves<'a>>,
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
        self.with_settled_load(|attitude| self.equilibrium_at(load, attitude, interrupted))
    }

    /// The equilibrium under `load` with grooves at the `attitude` angle.
    fn equilibrium_at(
        &self,
        load: f64,
        attitude: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        let most = self.most_eccentric();
        let mut solution = self.solve_at(most, attitude, interrupted)?;
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
        let mut bracket = FalsePosition::new([0.0, -load], [most, solution.load - load], None);
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
        self.with_settled_load(|attitude| self.solve_at(eccentricity, attitude, interrupted))
    }

    /// The solution of `solve` at the attitude angle that it has itself: grooves have fixed angles to the load.
    fn with_settled_load(
        &self,
        solve: impl Fn(f64) -> Result<JournalSolution, ReynoldsError>,
    ) -> Result<JournalSolution, ReynoldsError> {
        let mut attitude = FIRST_ATTITUDE;
        for _ in 0..MOST_POSITIONS {
            let solution = solve(attitude)?;
            let change = solution.attitude - attitude;
            if self.grooves.is_none() || solution.eccentricity == 0.0 || change.abs() < ATTITUDE_TOLERANCE {
                return Ok(solution);
            }
            attitude += DAMPING * change;
        }
        Err(InputError::Conflict {
            field: "grooves".to_owned(),
            reason: "the direction of the load does not settle; a lower supply pressure or another angle"
                .to_owned(),
        }
        .into())
    }

    /// Solves with grooves at the `attitude` angle of the load.
    fn solve_at(
        &self,
        eccentricity: f64,
        attitude: f64,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        self.validate(eccentricity)?;
        let (sides, circumference) = ([0.0, self.width], TAU * self.radius);
        // The load points to the angle pi - attitude from the widest gap.
        let turn = self.angular_speed.signum();
        let middles: Vec<f64> = self.grooves.map_or_else(Vec::new, |grooves| {
            grooves.angles.iter().map(|angle| self.radius * (PI + turn * (angle - attitude))).collect()
        });
        let (width, pressure) = self.grooves.map_or((0.0, 0.0), |grooves| (grooves.width, grooves.pressure));
        let land = self.grooves.map_or(0.0, |grooves| 0.5 * (self.width - grooves.length));
        let along = [land, self.width - land];
        let start = middles.first().map_or(0.0, |middle| middle + 0.5 * width);
        let feeds: Vec<Feed> = middles
            .iter()
            .skip(1)
            .map(|middle| start + (middle - start).rem_euclid(circumference))
            .map(|middle| Feed::new([middle - 0.5 * width, middle + 0.5 * width], along, pressure))
            .collect();
        let ends = [start, start + circumference - width];
        let grid = Grid::from_edges(self.cells[0], self.cells[1], ends, sides)?;
        let gap = |x: f64| self.clearance * (1.0 + eccentricity * (x / self.radius).cos());
        let film = FilmThickness::from_function(grid, |x, _| gap(x))?;
        let speed = self.angular_speed * self.radius;
        let mut solution = GivenFilm::new(&film, self.lubricant, [speed, 0.0])
            .with_edge_pressures([pressure, pressure, 0.0, 0.0])
            .with_lands(land)
            .with_feeds(&feeds)
            .with_roughness(self.roughness)
            .solve_unless(interrupted)?;
        // The film pushes the journal inwards, against the direction of the angle.
        let groove = middles.first().map_or(0.0, |middle| middle / self.radius);
        // Over the length of the first groove, and half of its pressure over both lands beside it.
        let length = self.width - land;
        let in_groove = 2.0 * pressure * self.radius * length * (0.5 * width / self.radius).sin();
        // Through both lands beside the first groove, `w h^3 p/(12 eta l)`.
        let viscosity = self.lubricant.viscosity().viscosity(0.0);
        let through_land = match middles.first() {
            Some(&middle) if land > 0.0 => width * gap(middle).powi(3) * pressure / (12.0 * viscosity * land),
            _ => 0.0,
        };
        solution.add_side_flow(through_land);
        let [cosine, sine] = self.moments(&solution, &solution.pressure);
        let contact = solution.contact.as_ref();
        let contact = contact.map_or([0.0; 2], |contact| self.moments(&solution, &contact.pressure));
        let force =
            [-cosine - contact[0] - in_groove * groove.cos(), -sine - contact[1] - in_groove * groove.sin()];
        let load = force[0].hypot(force[1]);
        let psi = self.clearance / self.radius;
        let area = 2.0 * self.width * self.radius;
        Ok(JournalSolution {
            eccentricity,
            load,
            force,
            contact_share: if load > 0.0 {
                0.0 - (contact[0] * force[0] + contact[1] * force[1]) / (load * load)
            } else {
                0.0
            },
            attitude: (-turn * force[1]).atan2(force[0]),
            sommerfeld: load * psi * psi / (area * viscosity * self.angular_speed.abs()),
            least_film: self.clearance * (1.0 - eccentricity),
            groove_flow: if self.grooves.is_some() {
                let into_film: f64 = solution.feed_flows.iter().sum();
                into_film - solution.edge_flows[0] - solution.edge_flows[1] + 2.0 * through_land
            } else {
                0.0
            },
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

    /// Error for grooves that are out of range or overlap.
    fn validate_grooves(&self, grooves: Grooves<'_>) -> Result<(), InputError> {
        InputError::require_positive("groove_width", grooves.width)?;
        InputError::require_positive("groove_length", grooves.length)?;
        let fits =
            if grooves.pressure > 0.0 { grooves.length < self.width } else { grooves.length <= self.width };
        InputError::require(
            fits,
            "groove_length",
            grooves.length,
            "below the width of the bearing; without supply_pressure at most that width",
        )?;
        InputError::require(
            grooves.pressure.is_finite() && grooves.pressure >= 0.0,
            "supply_pressure",
            grooves.pressure,
            "finite and at least 0: it is above ambient",
        )?;
        let conflict = |reason: &str| {
            Err(InputError::Conflict {
                field: format!("groove_angles = {:?} rad", grooves.angles),
                reason: reason.to_owned(),
            })
        };
        if grooves.angles.is_empty() || !grooves.angles.iter().all(|angle| angle.is_finite()) {
            return conflict("must be one or more finite angles from the load, in the direction of rotation");
        }
        let mut sorted: Vec<f64> = grooves.angles.iter().map(|angle| angle.rem_euclid(TAU)).collect();
        sorted.sort_by(f64::total_cmp);
        sorted.extend(sorted.first().map(|first| first + TAU));
        if sorted.windows(2).any(|pair| (pair[1] - pair[0]) * self.radius <= 2.0 * grooves.width) {
            return conflict(
                "the grooves must be apart by more than their width; narrower grooves, or other angles",
            );
        }
        Ok(())
    }

    /// Checks all values.
    fn validate(&self, eccentricity: f64) -> Result<(), InputError> {
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
        if let Some(grooves) = self.grooves {
            self.validate_grooves(grooves)?;
        }
        let requirement = "at least 0 and below 1: the distance of the axes over the radial clearance";
        InputError::require((0.0..1.0).contains(&eccentricity), "eccentricity", eccentricity, requirement)
    }
}
