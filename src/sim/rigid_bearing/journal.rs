//! Journal bearings of scenes.

use super::{BearingNumbers, BearingSolution, RigidBearing, Thickness, in_table, require_speed};
use crate::error::InputError;
use crate::lubricant::Lubricant;
use crate::reynolds::{FilmThickness, GivenFilm, Grooves, Holes, JournalBearing, JournalSolution};
use crate::sim::contact::warnings::film_warnings;
use crate::sim::error::SimError;
use crate::sim::scene::JournalPosition;

/// Length of grooves over the width of their bearing, where it is not given.
const USUAL_GROOVE: f64 = 0.8;

/// Size and motion of a journal.
#[derive(Clone, Copy)]
pub(super) struct JournalSize {
    pub(super) diameter: f64,
    pub(super) width: f64,
    pub(super) clearance: f64,
    pub(super) speed: f64,
}

/// Solves the journal of `size` at `position`.
pub(super) fn solve(
    bearing: &RigidBearing,
    lubricant: &Lubricant,
    (size, position): (JournalSize, JournalPosition),
    interrupted: &dyn Fn() -> bool,
) -> Result<BearingSolution, SimError> {
    let JournalSize { diameter, width, clearance, speed } = size;
    InputError::require_positive("given_film.diameter", diameter)?;
    require_speed(speed)?;
    let radius = 0.5 * diameter;
    let grooves = bearing.grooves.as_ref().map(|spec| {
        let length = spec.length.unwrap_or(USUAL_GROOVE * width);
        Grooves::new(&spec.angles, [spec.width, length], spec.pressure)
    });
    let holes = bearing.holes.as_ref();
    let journal = JournalBearing::new([radius, width, clearance], speed / radius, lubricant)
        .with_cells(bearing.cells)
        .with_roughness(bearing.mean_roughness()?)
        .with_grooves(grooves)
        .with_holes(holes.map(|spec| Holes::new(&spec.places, spec.diameter, spec.pressure)))
        .with_bore(bearing.bore)
        .with_cavitation_pressure(bearing.cavitation_pressure);
    let solved = match position {
        JournalPosition::Eccentricity(eccentricity) => journal.solve_unless(eccentricity, interrupted),
        JournalPosition::Load(load) => journal.equilibrium_unless(load, interrupted),
    };
    numbers(bearing, lubricant, size, solved.map_err(in_table)?)
}

/// Numbers of a solved journal bearing.
fn numbers(
    bearing: &RigidBearing,
    lubricant: &Lubricant,
    size: JournalSize,
    solved: JournalSolution,
) -> Result<BearingSolution, SimError> {
    let grid = solved.film.grid();
    let films = [size.clearance * (1.0 + solved.eccentricity), solved.least_film];
    let film =
        FilmThickness::from_function(grid, |x, _| if x < 0.5 * grid.size_x() { films[0] } else { films[1] })?;
    let problem =
        GivenFilm::new(&film, lubricant, [size.speed, 0.0]).with_roughness(bearing.mean_roughness()?);
    let warnings = film_warnings(&problem, &solved.film, bearing.bore.is_none());
    let thickness = Thickness { nodes: &solved.thickness, least: solved.least_film, speed: size.speed };
    let numbers = BearingNumbers {
        force: Some(solved.force),
        attitude: Some(solved.attitude),
        eccentricity: Some(solved.eccentricity),
        sommerfeld: Some(solved.sommerfeld),
        contact_share: bearing.roughness.is_some().then_some(solved.contact_share),
        groove_flow: bearing.grooves.is_some().then_some(solved.groove_flow),
        hole_flow: bearing.holes.is_some().then_some(solved.hole_flow),
        bore_widening: bearing.bore.is_some().then_some(solved.bore_widening),
        ..bearing.numbers(lubricant, solved.load, thickness, &solved.film)
    };
    Ok(BearingSolution { numbers, film: solved.film, thickness: solved.thickness, warnings })
}
