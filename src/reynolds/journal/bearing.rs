//! A journal bearing, and the film at one position of its axis.

use super::elastic_bore::ElasticBore;
use super::feeds::{Bush, Grooves, Holes, Supply};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::ReynoldsError;
use crate::reynolds::given_film::{FilmThickness, GivenFilm, GivenFilmSolution, MeanRoughness};
use crate::with_fields::with_fields;

/// Largest clearance over the radius; the film is that of a thin gap.
const MOST_CLEARANCE: f64 = 0.1;

/// A journal that turns in a bush of finite width, with the film `h = c (1 + e cos phi)`.
///
/// The angle `phi` begins where the gap is widest, in the direction of rotation. There the film is supplied at ambient
/// pressure, unless the bush has [`Grooves`] or [`Holes`]; at both sides pressure is ambient too. The film cavitates at ambient pressure, or below it, with conservation of mass
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
    /// Pressure at which the film cavitates \[Pa\], relative to ambient; at most 0.
    pub cavitation_pressure: f64,
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
    /// Film thickness at its nodes \[m\].
    pub thickness: Vec<f64>,
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
            cavitation_pressure: 0.0,
        }
    }
}

with_fields!(<'a> JournalBearing<'a> {
    with_cells cells: [usize; 2],
    with_grooves grooves: Option<Grooves<'a>>,
    with_holes holes: Option<Holes<'a>>,
    with_bore bore: Option<ElasticBore>,
    with_roughness roughness: Option<MeanRoughness>,
    with_cavitation_pressure cavitation_pressure: f64,
});

impl JournalBearing<'_> {
    /// Whether the bush has grooves or holes, whose angles count from the load.
    pub(super) fn is_fed(&self) -> bool {
        self.grooves.is_some() || self.holes.is_some()
    }

    /// The bush as its feeds see it.
    pub(super) fn bush(&self) -> Bush<'_> {
        Bush {
            radius: self.radius,
            width: self.width,
            turn: self.angular_speed.signum(),
            grooves: self.grooves,
            holes: self.holes,
        }
    }

    /// The grid of the film with feeds at the `attitude` angle of the load.
    pub(super) fn grid(&self, attitude: f64) -> Result<Grid, InputError> {
        Grid::from_edges(self.cells[0], self.cells[1], self.bush().supply(attitude).ends, [0.0, self.width])
    }

    /// Solves the film at `[eccentricity, attitude]`, with the film wider by `widening` \[m\] on the nodes, or not if that is empty.
    pub(super) fn film_at(
        &self,
        [eccentricity, attitude]: [f64; 2],
        widening: &[f64],
        interrupted: &dyn Fn() -> bool,
    ) -> Result<JournalSolution, ReynoldsError> {
        self.validate()?;
        let grid = self.grid(attitude)?;
        let supply = self.bush().supply(attitude);
        self.bush().validate_holes(&supply, grid)?;
        let pressure = supply.end_pressure;
        let film = self.film_thickness(grid, eccentricity, widening)?;
        let speed = self.angular_speed * self.radius;
        let mut solution = GivenFilm::new(&film, self.lubricant, [speed, 0.0])
            .with_edge_pressures([pressure, pressure, 0.0, 0.0])
            .with_cavitation_pressure(self.cavitation_pressure)
            .with_lands(supply.land)
            .with_end_hole(supply.end_hole)
            .with_feeds(&supply.feeds)
            .with_roughness(self.roughness)
            .solve_unless(interrupted)?;
        let viscosity = self.lubricant.viscosity().viscosity(0.0);
        let through_land = self.flow_through_land(&supply, eccentricity);
        solution.add_side_flow(through_land);
        let [cosine, sine] = self.moments(&solution, &solution.pressure);
        let contact = solution.contact.as_ref();
        let contact = contact.map_or([0.0; 2], |contact| self.moments(&solution, &contact.pressure));
        // The film pushes the journal inwards, against the direction of the angle.
        let in_groove = self.bush().force_in_groove(&supply);
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
            thickness: film.nodes().to_vec(),
        })
    }

    /// Flow through each of the lands beside the first groove, `w h^3 p/(12 eta l)` \[m^3/s\].
    fn flow_through_land(&self, supply: &Supply, eccentricity: f64) -> f64 {
        let viscosity = self.lubricant.viscosity().viscosity(0.0);
        match supply.first_groove {
            Some([middle, width]) if supply.land > 0.0 => {
                width * self.gap(eccentricity, middle).powi(3) * supply.end_pressure
                    / (12.0 * viscosity * supply.land)
            }
            _ => 0.0,
        }
    }

    /// Film of the round bore at the distance `x` from its widest place \[m\].
    pub(super) fn gap(&self, eccentricity: f64, x: f64) -> f64 {
        self.clearance * (1.0 + eccentricity * (x / self.radius).cos())
    }

    /// The film, wider by `widening` \[m\] on the nodes.
    fn film_thickness(
        &self,
        grid: Grid,
        eccentricity: f64,
        widening: &[f64],
    ) -> Result<FilmThickness, InputError> {
        FilmThickness::from_function(grid, |x, y| {
            let widening =
                if widening.is_empty() { 0.0 } else { grid.interpolate(widening, x, y).unwrap_or(f64::NAN) };
            self.gap(eccentricity, x) + widening
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
    pub(super) fn validate(&self) -> Result<(), InputError> {
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
        let requirement = "at most 0: the pressure at the sides is ambient";
        let cavitation = self.cavitation_pressure;
        InputError::require(cavitation <= 0.0, "cavitation_pressure", cavitation, requirement)?;
        if let Some(bore) = self.bore {
            bore.validate()?;
        }
        self.bush().validate_grooves()
    }
}
