//! Pads of scenes.

use super::{BearingSolution, RigidBearing, Thickness, in_table, relief, require_speed};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::{Feed, GivenFilm, require_resolved_holes};
use crate::sim::contact::warnings::film_warnings;
use crate::sim::error::SimError;

/// Solves a pad of `[length, width, speed]` with the film `thickness` over x, without its relief.
pub(super) fn solve(
    bearing: &RigidBearing,
    lubricant: &Lubricant,
    ([length, width, speed], thickness): ([f64; 3], &dyn Fn(f64) -> f64),
    interrupted: &dyn Fn() -> bool,
) -> Result<BearingSolution, SimError> {
    InputError::require_positive("given_film.length", length)?;
    InputError::require_positive("given_film.width", width)?;
    require_speed(speed)?;
    InputError::require_positive("given_film.inlet_film", thickness(0.0))?;
    InputError::require_positive("given_film.outlet_film", thickness(length))?;
    let grid = Grid::from_edges(bearing.cells[0], bearing.cells[1], [0.0, length], [0.0, width])?;
    let film = relief::film(bearing.relief.as_ref(), grid, thickness)?;
    let feeds = holes(bearing, [length, width], grid)?;
    let problem = GivenFilm::new(&film, lubricant, [speed, 0.0])
        .with_edge_pressures(bearing.edge_pressures)
        .with_cavitation_pressure(bearing.cavitation_pressure)
        .with_feeds(&feeds)
        .with_roughness(bearing.mean_roughness()?);
    let solved = problem.solve_unless(interrupted).map_err(in_table)?;
    let warnings = film_warnings(&problem, &solved, true);
    let nodes = film.nodes();
    let least = if bearing.relief.is_some() {
        nodes.iter().copied().fold(f64::INFINITY, f64::min)
    } else {
        thickness(0.0).min(thickness(length))
    };
    let mut numbers = bearing.numbers(lubricant, solved.load, Thickness { nodes, least, speed }, &solved);
    let ambient = bearing.edge_pressures.into_iter().fold(f64::INFINITY, f64::min);
    numbers.load_above_edges = (ambient > 0.0).then_some(solved.load - ambient * length * width);
    Ok(BearingSolution { numbers, thickness: nodes.to_vec(), film: solved, warnings })
}

/// Holes of a pad of `[length, width]`.
fn holes(bearing: &RigidBearing, [length, width]: [f64; 2], grid: Grid) -> Result<Vec<Feed>, InputError> {
    let Some(holes) = &bearing.holes else { return Ok(Vec::new()) };
    let field = |key: &str| format!("given_film.{key}");
    if grid.ny() == 1 {
        let reason = "holes need the `width` of the pad".to_owned();
        return Err(InputError::Conflict { field: field("hole_positions"), reason });
    }
    InputError::require(
        holes.diameter > 0.0 && holes.diameter < width,
        &field("hole_diameter"),
        holes.diameter,
        "above 0 and below the width of the pad",
    )?;
    InputError::require_non_negative(&field("supply_pressure"), holes.pressure)?;
    let radius = 0.5 * holes.diameter;
    let feeds = holes.places.iter().map(|&place| {
        let requirement = "at least a radius of the hole from inlet and outlet";
        let fits = place > radius && place < length - radius;
        InputError::require(fits, &field("hole_positions"), place, requirement)?;
        Ok(Feed::hole([place, 0.5 * width], holes.diameter, holes.pressure))
    });
    let feeds = feeds.collect::<Result<Vec<_>, InputError>>()?;
    require_resolved_holes(&feeds, holes.diameter, grid).map_err(|error| error.within("given_film"))?;
    Ok(feeds)
}
