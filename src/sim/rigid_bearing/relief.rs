//! Films of pads with dimples or measured heights.

use std::f64::consts::PI;
use std::path::Path;

use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::FilmThickness;
use crate::sim::error::SimError;
use crate::sim::scene::PadRelief;
#[cfg(feature = "formats")]
use crate::surface;

/// Part of a pitch by which the pad may be shorter than its dimples.
const ROUNDING: f64 = 1e-9;
/// Fewest cells along the diameter of a dimple.
const CELLS_IN_DIMPLE: f64 = 4.0;

/// The film of `thickness` over x, plus the depth of the relief, which may repeat along the motion.
pub(super) fn film(
    (relief, is_periodic): (Option<&PadRelief>, bool),
    grid: Grid,
    thickness: &dyn Fn(f64) -> f64,
) -> Result<FilmThickness, SimError> {
    Ok(match relief {
        None => FilmThickness::from_function(grid, |x, _| thickness(x))?,
        Some(&PadRelief::Dimples { diameter, depth, density }) => {
            let dimples = Dimples::new(grid, [diameter, depth, density], is_periodic)?;
            FilmThickness::from_function(grid, |x, y| thickness(x) + dimples.depth_at(x, y))?
        }
        Some(PadRelief::File { path, spacing }) => {
            let heights = heights(path, *spacing, grid)?;
            let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let film: Vec<f64> =
                grid.nodes().zip(heights).map(|((x, _), z)| thickness(x) + highest - z).collect();
            FilmThickness::from_nodes(grid, &film)?
        }
    })
}

/// Dimples on a square lattice in the middle of the pad.
struct Dimples {
    diameter: f64,
    depth: f64,
    /// Distances of their middles along x and y \[m\].
    pitch: [f64; 2],
    /// Corner of the lattice \[m\] and its cells along x and y.
    corner: [f64; 2],
    count: [f64; 2],
}

impl Dimples {
    /// Dimples of `[diameter, depth, density]`; around a ring their distance divides the length.
    fn new(grid: Grid, [diameter, depth, density]: [f64; 3], is_periodic: bool) -> Result<Self, InputError> {
        InputError::require_positive("given_film.dimple_diameter", diameter)?;
        InputError::require_positive("given_film.dimple_depth", depth)?;
        InputError::require(
            depth < diameter,
            "given_film.dimple_depth",
            depth,
            "below dimple_diameter: the Reynolds equation holds in films that are long beside their thickness",
        )?;
        InputError::require(
            density > 0.0 && density < 0.25 * PI,
            "given_film.dimple_density",
            density,
            "above 0 and below pi/4, at which dimples on a square lattice touch",
        )?;
        let (cell, size) = (grid.dx().max(grid.dy()), [grid.size_x(), grid.size_y()]);
        if grid.ny() == 1 {
            return Err(conflict("dimple_diameter", "dimples need the `width` of the pad".to_owned()));
        }
        if diameter < CELLS_IN_DIMPLE * cell {
            return Err(conflict(
                "dimple_diameter",
                format!(
                    "{diameter:e} m is less than {CELLS_IN_DIMPLE} cells of {cell:.3e} m; more cells (nx, ny), or larger dimples"
                ),
            ));
        }
        let square = diameter * (0.25 * PI / density).sqrt();
        let along = if is_periodic { size[0] / (size[0] / square).round().max(1.0) } else { square };
        let pitch = [along, square * square / along];
        let count = [0, 1].map(|k| (size[k] / pitch[k] + ROUNDING).floor());
        if count[0] < 1.0 || count[1] < 1.0 {
            return Err(conflict(
                "dimple_density",
                format!("the pitch of {square:.3e} m exceeds the pad; smaller or denser dimples"),
            ));
        }
        let first = [grid.x(0) - 0.5 * grid.dx(), grid.y(0) - 0.5 * grid.dy()];
        let corner = [0, 1].map(|k| first[k] + 0.5 * (size[k] - count[k] * pitch[k]));
        Ok(Self { diameter, depth, pitch, corner, count })
    }

    /// Depth at a point \[m\].
    fn depth_at(&self, x: f64, y: f64) -> f64 {
        let mut distance = 0.0;
        for (place, k) in [x, y].into_iter().zip(0..) {
            let cells = (place - self.corner[k]) / self.pitch[k];
            if cells < 0.0 || cells >= self.count[k] {
                return 0.0;
            }
            distance += ((cells.fract() - 0.5) * self.pitch[k]).powi(2);
        }
        self.depth * (1.0 - 4.0 * distance / (self.diameter * self.diameter)).max(0.0)
    }
}

/// Heights of a file on the nodes of `grid` \[m\].
#[cfg(feature = "formats")]
fn heights(path: &Path, spacing: Option<f64>, grid: Grid) -> Result<Vec<f64>, SimError> {
    let refused =
        |reason: String| SimError::from(conflict("heights", format!("{}: {reason}", path.display())));
    // Errors of the reader begin with the path.
    let mut heights = surface::read(path).map_err(|error| conflict("heights", error.to_string()))?;
    match (spacing, heights.dx()) {
        (Some(_), Some(dx)) => {
            return Err(refused(format!("the file has a spacing of {dx:e} m; leave out `spacing`")));
        }
        (None, None) => {
            return Err(refused(
                "the file has no scale; give the spacing of its points, spacing = \"5 um\"".to_owned(),
            ));
        }
        (Some(spacing), None) => {
            InputError::require_positive("given_film.spacing", spacing)?;
            heights = heights.with_spacing(spacing, spacing).map_err(|error| refused(error.to_string()))?;
        }
        (None, Some(_)) => {}
    }
    heights.resample(&grid).map_err(|error| refused(error.to_string()))
}

#[cfg(not(feature = "formats"))]
fn heights(_path: &Path, _spacing: Option<f64>, _grid: Grid) -> Result<Vec<f64>, SimError> {
    Err(conflict("heights", "surface files need the feature `formats`".to_owned()).into())
}

/// An error of the key `given_film.key`.
fn conflict(key: &str, reason: String) -> InputError {
    InputError::Conflict { field: format!("given_film.{key}"), reason }
}
