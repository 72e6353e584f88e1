//! Flow coefficients of the intervals between neighboring nodes.

use super::feed::free_share;
use super::film::FilmThickness;
use super::{GivenFilm, SideEdges};

/// Flow coefficients of the interval between two nodes along x.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Face {
    /// `I_2 / I_3` of the interval \[m\].
    pub(super) film: f64,
    /// The same of its first piece \[m\].
    pub(super) first_film: f64,
    /// `1 / (12 eta_0 u I_3)` of the interval \[m/Pa\].
    pub(super) conductance: f64,
    /// The same of its first piece \[m/Pa\].
    pub(super) first_conductance: f64,
    /// Share of the interval outside of feeds.
    pub(super) free_share: f64,
}

/// The faces along x, with coefficients of entrainment and pressure flow.
pub(super) fn faces_along(
    problem: &GivenFilm<'_>,
    film: &FilmThickness,
    entrained: f64,
    drag: f64,
) -> Vec<Face> {
    let grid = film.grid();
    let (nx, ny) = (grid.nx(), grid.ny());
    let node = |i: usize, j: usize| (grid.x(i), grid.y(j));
    let mut faces = Vec::with_capacity((nx + 1) * ny);
    for (j, i) in (0..ny).flat_map(|j| (0..=nx).map(move |i| (j, i))) {
        // Film and flow resistance of the two half cells at the face.
        let [first, second] = problem.pieces(film, i, j);
        let whole = first.and(second);
        // A feed may cover a part of the way between the two nodes.
        let free_share =
            if 0 < i && i < nx { free_share(problem.feeds, node(i - 1, j), node(i, j)) } else { 1.0 };
        faces.push(Face {
            film: entrained * whole.film(),
            first_film: entrained * first.film(),
            conductance: 1.0 / (drag * free_share * whole.cubes),
            first_conductance: 1.0 / (drag * free_share * first.cubes),
            free_share,
        });
    }
    faces
}

/// Conductances of the faces along y; zero at closed sides. On a strip the sides are one face, from the last row to the
/// first one.
pub(super) fn conductances_across(problem: &GivenFilm<'_>, film: &FilmThickness, drag: f64) -> Vec<f64> {
    let grid = film.grid();
    let (nx, ny, aspect) = (grid.nx(), grid.ny(), grid.dx() / grid.dy());
    let node = |i: usize, j: usize| (grid.x(i), grid.y(j));
    let is_strip = grid.is_strip();
    let is_closed = ny == 1 || (problem.sides == SideEdges::Closed && !is_strip);
    let mut across = Vec::with_capacity(nx * (ny + 1));
    for (j, i) in (0..=ny).flat_map(|j| (0..nx).map(move |i| (j, i))) {
        let is_side = j == 0 || j == ny;
        let share = if is_side { 1.0 } else { free_share(problem.feeds, node(i, j - 1), node(i, j)) };
        let is_shut = is_closed && is_side;
        let cubes = if is_side && is_strip {
            problem.cubes_across(film, i, 0) + problem.cubes_across(film, i, ny)
        } else {
            problem.cubes_across(film, i, j)
        };
        across.push(if is_shut { 0.0 } else { aspect / (drag * share * cubes) });
    }
    across
}
