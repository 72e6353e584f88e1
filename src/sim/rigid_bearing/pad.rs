//! Pads of scenes.

use super::{BearingSolution, RigidBearing, Thickness, equilibrium, in_table, relief, require_speed};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::{Feed, GivenFilm, GivenFilmSolution, require_resolved_holes};
use crate::sim::contact::warnings::{coarse_dimples, film_warnings, reject_film_units};
use crate::sim::error::SimError;
use crate::sim::scene::{PadFilm, PadRelief};

/// A pad with its oil.
pub(super) struct Pad<'a> {
    /// The scene.
    pub(super) bearing: &'a RigidBearing,
    /// The oil at its temperature.
    pub(super) lubricant: &'a Lubricant,
    /// Length along the motion \[m\].
    pub(super) length: f64,
    /// Width \[m\]; one metre of a wide pad.
    pub(super) width: f64,
    /// Whether the pad is wide, with forces per metre.
    pub(super) is_wide: bool,
    /// Length of the part before a step \[m\].
    pub(super) step: Option<f64>,
    /// Speed of the moving plane \[m/s\].
    pub(super) speed: f64,
    /// Ends the solve with an error.
    pub(super) interrupted: &'a dyn Fn() -> bool,
}

impl Pad<'_> {
    /// Solves the pad with its `film`.
    pub(super) fn solve_with(&self, film: PadFilm) -> Result<BearingSolution, SimError> {
        InputError::require_positive("given_film.length", self.length)?;
        if self.is_wide && matches!(self.bearing.relief, Some(PadRelief::File { .. })) {
            let reason = "heights need the `width` of the pad".to_owned();
            return Err(InputError::Conflict { field: "given_film.heights".to_owned(), reason }.into());
        }
        InputError::require_positive("given_film.width", self.width)?;
        require_speed(self.speed)?;
        if let Some(step) = self.step {
            let requirement = "at least 0 and below the length: the length of the part before the step";
            InputError::require((0.0..self.length).contains(&step), "given_film.step", step, requirement)?;
        }
        match film {
            PadFilm::Given { inlet, outlet } => {
                InputError::require_positive("given_film.inlet_film", inlet)?;
                InputError::require_positive("given_film.outlet_film", outlet)?;
                reject_film_units([inlet, outlet])?;
                let deepest = if inlet > outlet { "given_film.inlet_film" } else { "given_film.outlet_film" };
                let requirement = "below the length of the pad: the film of Reynolds' equation is thin";
                InputError::require(
                    inlet.max(outlet) < self.length,
                    deepest,
                    inlet.max(outlet),
                    requirement,
                )?;
                self.solve([inlet, outlet])
            }
            PadFilm::Fixed { load, taper } => equilibrium::fixed(self, load, taper),
            PadFilm::Pivoted { load, pivot } => equilibrium::pivoted(self, load, pivot),
        }
    }

    /// Solves with the films `[inlet, outlet]`.
    pub(super) fn solve(&self, [inlet, outlet]: [f64; 2]) -> Result<BearingSolution, SimError> {
        let (bearing, length) = (self.bearing, self.length);
        let thickness = |x: f64| match self.step {
            Some(step) => {
                if x < step {
                    inlet
                } else {
                    outlet
                }
            }
            None => inlet + (outlet - inlet) * x / length,
        };
        let grid = Grid::from_edges(bearing.cells[0], bearing.cells[1], [0.0, length], [0.0, self.width])?;
        let film = relief::film((bearing.relief.as_ref(), bearing.is_periodic), grid, &thickness)?;
        let feeds = self.holes(grid)?;
        let problem = GivenFilm::new(&film, self.lubricant, [self.speed, 0.0])
            .with_edge_pressures(bearing.edge_pressures)
            .with_cavitation_pressure(bearing.cavitation_pressure)
            .with_periodic(bearing.is_periodic)
            .with_feeds(&feeds)
            .with_roughness(bearing.mean_roughness()?);
        let solved = problem.solve_unless(self.interrupted).map_err(in_table)?;
        let mut warnings = film_warnings(&problem, &solved, true);
        warnings.extend(coarse_dimples(bearing.relief.as_ref(), grid));
        let nodes = film.nodes();
        let least = if bearing.relief.is_some() {
            nodes.iter().copied().fold(f64::INFINITY, f64::min)
        } else {
            inlet.min(outlet)
        };
        let thickness = Thickness { nodes, least, speed: self.speed };
        let mut numbers = bearing.numbers(self.lubricant, solved.load, thickness, &solved);
        let ambient = bearing.least_edge_pressure();
        numbers.load_above_edges = (ambient > 0.0).then_some(solved.load - ambient * length * self.width);
        (numbers.inlet_film, numbers.outlet_film) = (Some(inlet), Some(outlet));
        // A ring has no inlet, and pressures that cancel have no center within the pad.
        let center = (numbers.load > 0.0 && !bearing.is_periodic).then(|| center(&solved));
        numbers.pressure_center = center.filter(|center| (0.0..=length).contains(center));
        Ok(BearingSolution { numbers, thickness: nodes.to_vec(), film: solved, warnings })
    }

    /// Depth of the dimples of the pad \[m\]; heights of a file count as none.
    pub(super) fn relief_depth(&self) -> f64 {
        match self.bearing.relief {
            Some(PadRelief::Dimples { depth, .. }) => depth,
            _ => 0.0,
        }
    }

    /// Holes of the pad.
    fn holes(&self, grid: Grid) -> Result<Vec<Feed>, InputError> {
        let Some(holes) = &self.bearing.holes else { return Ok(Vec::new()) };
        let field = |key: &str| format!("given_film.{key}");
        if grid.ny() == 1 {
            let reason = "holes need the `width` of the pad".to_owned();
            return Err(InputError::Conflict { field: field("hole_positions"), reason });
        }
        InputError::require(
            holes.diameter > 0.0 && holes.diameter < self.width,
            &field("hole_diameter"),
            holes.diameter,
            "above 0 and below the width of the pad",
        )?;
        InputError::require_non_negative(&field("supply_pressure"), holes.pressure)?;
        let radius = 0.5 * holes.diameter;
        let feeds = holes.places.iter().map(|&place| {
            let requirement = "at least a radius of the hole from inlet and outlet";
            let fits = place > radius && place < self.length - radius;
            InputError::require(fits, &field("hole_positions"), place, requirement)?;
            Ok(Feed::hole([place, 0.5 * self.width], holes.diameter, holes.pressure))
        });
        let feeds = feeds.collect::<Result<Vec<_>, InputError>>()?;
        require_resolved_holes(&feeds, holes.diameter, grid).map_err(|error| error.within("given_film"))?;
        Ok(feeds)
    }
}

/// Distance of the center of pressure of film and contact from the inlet \[m\].
fn center(solved: &GivenFilmSolution) -> f64 {
    let (grid, contact) = (solved.grid(), solved.contact.as_ref());
    let (mut sum, mut moment) = (0.0, 0.0);
    for (k, ((x, _), fluid)) in grid.nodes().zip(&solved.pressure).enumerate() {
        let pressure = fluid + contact.map_or(0.0, |contact| contact.pressure[k]);
        sum += pressure;
        moment += pressure * x;
    }
    moment / sum
}
