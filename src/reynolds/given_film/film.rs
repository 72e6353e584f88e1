//! Integrals of the film between neighboring nodes.
//!
//! The flow of a full film depends only on the integrals `I_2` and `I_3` of `1/h^2` and `1/h^3`. Steps and
//! grooves between two nodes therefore count at any position. The interval between two nodes has two pieces.
//! They join at the jump of the film, or in the middle if there is none. The film may rupture at the joint.

use crate::error::InputError;
use crate::grid::Grid;

/// Bisections in the search for a film jump.
const HALVINGS: usize = 40;
/// Relative film change below which the film is continuous.
const SMOOTH: f64 = 1e-9;
/// Sampling points on a piece of unit length: Gauss's rule of two points.
const PLACES: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
/// Smallest distance of a jump from either node, over the interval.
const CLOSEST: f64 = 1e-6;

/// Integrals of `1/h^2` \[1/m\] and `1/h^3` \[1/m^2\] over a piece of the interval between two nodes.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Piece {
    /// `I_2` \[1/m\].
    pub(super) squares: f64,
    /// `I_3` \[1/m^2\].
    pub(super) cubes: f64,
}

impl Piece {
    /// A piece with constant film.
    fn constant(film: f64, length: f64) -> Self {
        Self { squares: length / (film * film), cubes: length / (film * film * film) }
    }

    /// Uniform film with the same entrainment at zero pressure difference \[m\].
    pub(super) fn film(self) -> f64 {
        self.squares / self.cubes
    }

    /// Two pieces in series.
    pub(super) fn and(self, other: Self) -> Self {
        Self { squares: self.squares + other.squares, cubes: self.cubes + other.cubes }
    }
}

/// The interval along x between two nodes, or between the edge of the box and a node, in the order of x.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct FaceIntegral {
    /// Position of the joint of the two pieces, over the length of the interval.
    pub(super) share: f64,
    /// The pieces before and after the joint.
    pub(super) pieces: [Piece; 2],
}

impl FaceIntegral {
    /// The interval with x reversed.
    pub(super) fn reversed(self) -> Self {
        let [first, second] = self.pieces;
        Self { share: 1.0 - self.share, pieces: [second, first] }
    }
}

/// Thickness of the film between two rigid surfaces, on a [`Grid`].
///
/// The flow between two nodes uses the film between them, not a mean of two nodes.
/// [`from_nodes`](Self::from_nodes) assumes a constant film per cell, with jumps at the cell faces.
/// [`from_function`](Self::from_function) samples the film between the nodes and finds one jump there, at any
/// position.
///
/// ```
/// use stribeck::Grid;
/// use stribeck::reynolds::FilmThickness;
/// // A step at a third of the box, inside a cell.
/// let grid = Grid::from_edges(10, 1, [0.0, 3e-3], [0.0, 1.0])?;
/// let film = FilmThickness::from_function(grid, |x, _| if x < 1e-3 { 2e-6 } else { 1e-6 })?;
/// assert_eq!(film.nodes()[0], 2e-6);
/// assert!(FilmThickness::from_nodes(grid, &[0.0; 10]).is_err());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FilmThickness {
    /// The grid of the nodes.
    grid: Grid,
    /// Film at the nodes \[m\].
    nodes: Vec<f64>,
    /// Intervals along x, `nx + 1` per row.
    along: Vec<FaceIntegral>,
    /// `1/h^3` integrated over the intervals along y, `ny + 1` rows of `nx` \[1/m^2\]. On a strip the first and the last
    /// row are the two halves of the interval from the last row of nodes to the first one.
    across: Vec<f64>,
}

impl FilmThickness {
    /// A film that is constant in each cell: `film` \[m\] has one value per node. Second order if texture
    /// edges lie on cell faces, else first order.
    ///
    /// # Errors
    /// A field that does not fit the grid, or a value that is not finite and positive.
    pub fn from_nodes(grid: Grid, film: &[f64]) -> Result<Self, InputError> {
        Self::from_halves(grid, film, |near, _, length| {
            let Piece { squares, cubes } = Piece::constant(near, length);
            [squares, cubes]
        })
    }

    /// A film with the values `film` \[m\] at the nodes. `integrals` has those of `1/h^2` and `1/h^3` over the half of the interval
    /// between two nodes that is near to one of them, from the film there, that of the other node and the length of the half.
    ///
    /// # Errors
    /// Those of [`from_nodes`](Self::from_nodes).
    pub(in crate::reynolds) fn from_halves(
        grid: Grid,
        film: &[f64],
        integrals: impl Fn(f64, f64, f64) -> [f64; 2],
    ) -> Result<Self, InputError> {
        let piece = |near, far, length| {
            let [squares, cubes] = integrals(near, far, length);
            Piece { squares, cubes }
        };
        InputError::require_len("film", film, grid.len())?;
        check_values(film)?;
        let (nx, ny) = (grid.nx(), grid.ny());
        let (half_x, half_y) = (0.5 * grid.dx(), 0.5 * grid.dy());
        // Half cells on both sides of each face.
        let mut along = Vec::with_capacity((nx + 1) * ny);
        for row in film.chunks_exact(nx) {
            for i in 0..=nx {
                let (west, east) = neighbours(row, i);
                let inside = i > 0 && i < nx;
                let length = if inside { half_x } else { 0.5 * half_x };
                let pieces = [piece(west, east, length), piece(east, west, length)];
                along.push(FaceIntegral { share: 0.5, pieces });
            }
        }
        // The same along y.
        let mut across = Vec::with_capacity(nx * (ny + 1));
        let at_side = |j: usize| grid.is_strip() && (j == 0 || j == ny);
        for j in 0..=ny {
            for i in 0..nx {
                if at_side(j) {
                    let [near, far] = if j == 0 { [0, ny - 1] } else { [ny - 1, 0] };
                    across.push(piece(film[near * nx + i], film[far * nx + i], half_y).cubes);
                    continue;
                }
                let [south, north] = [j.max(1) - 1, j.min(ny - 1)].map(|j| film[j * nx + i]);
                let length = if j > 0 && j < ny { half_y } else { 0.5 * half_y };
                across.push(piece(south, north, length).cubes + piece(north, south, length).cubes);
            }
        }
        Ok(Self { grid, nodes: film.to_vec(), along, across })
    }

    /// The film `thickness(x, y)` \[m\]. Second order if the film has at most one jump between two nodes of a
    /// row or column, at any position. Of several jumps between two nodes one is resolved. The function is
    /// also evaluated on the edges of the box.
    ///
    /// # Errors
    /// A value that is not finite and positive.
    pub fn from_function(grid: Grid, thickness: impl Fn(f64, f64) -> f64) -> Result<Self, InputError> {
        let (nx, ny, dx, dy) = (grid.nx(), grid.ny(), grid.dx(), grid.dy());
        let nodes: Vec<f64> = grid.nodes().map(|(x, y)| thickness(x, y)).collect();
        check_values(&nodes)?;
        let ends = |i: usize, n: usize, first: f64, d: f64| {
            let start = if i == 0 { first - 0.5 * d } else { first + d * (i - 1) as f64 };
            let end = if i == n { first + d * (n as f64 - 0.5) } else { first + d * i as f64 };
            [start, end]
        };
        // Each interval is sampled between its nodes.
        let mut along = Vec::with_capacity((nx + 1) * ny);
        for y in (0..ny).map(|j| grid.y(j)) {
            for i in 0..=nx {
                along.push(face_integral(|x| thickness(x, y), ends(i, nx, grid.x(0), dx)));
            }
        }
        let mut across = Vec::with_capacity(nx * (ny + 1));
        for j in 0..=ny {
            let ends = ends(j, ny, grid.y(0), dy);
            for x in (0..nx).map(|i| grid.x(i)) {
                let [south, north] = face_integral(|y| thickness(x, y), ends).pieces;
                across.push(south.cubes + north.cubes);
            }
        }
        // A film that is zero or not finite between nodes shows in an integral.
        let pieces = along
            .iter()
            .flat_map(|face_integral| face_integral.pieces)
            .flat_map(|piece| [piece.squares, piece.cubes]);
        if let Some(bad) = pieces.chain(across.iter().copied()).find(|v| !(v.is_finite() && *v > 0.0)) {
            return Err(InputError::Conflict {
                field: "film".to_owned(),
                reason: format!(
                    "an integral of 1/h^2 or 1/h^3 between two nodes is {bad}: the film must be finite and above 0 there"
                ),
            });
        }
        Ok(Self { grid, nodes, along, across })
    }

    /// The grid.
    pub fn grid(&self) -> Grid {
        self.grid
    }

    /// The film at the nodes \[m\].
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// The interval that ends at node `(i, j)`; `i = nx` ends at the edge of the box.
    pub(super) fn along(&self, i: usize, j: usize) -> FaceIntegral {
        self.along[j * (self.grid.nx() + 1) + i]
    }

    /// The interval of row `j` from the last node over the end of a period to the first one, joined at that end.
    pub(super) fn over_end(&self, j: usize) -> FaceIntegral {
        let [last, first] = [self.grid.nx(), 0].map(|i| {
            let [one, other] = self.along(i, j).pieces;
            one.and(other)
        });
        FaceIntegral { share: 0.5, pieces: [last, first] }
    }

    /// `1/h^3` integrated from node `(i, j - 1)` to `(i, j)`; `j = ny` ends at the edge of the box.
    pub(super) fn across(&self, i: usize, j: usize) -> f64 {
        self.across[j * self.grid.nx() + i]
    }

    /// The film mirrored in x: `x` becomes `x_first + x_last - x`.
    pub(super) fn mirrored(&self) -> Self {
        let nx = self.grid.nx();
        let rows = |field: &[f64]| field.chunks_exact(nx).flat_map(|row| row.iter().rev().copied()).collect();
        Self {
            grid: self.grid,
            nodes: rows(&self.nodes),
            along: self
                .along
                .chunks_exact(nx + 1)
                .flat_map(|row| row.iter().rev().map(|face_integral| face_integral.reversed()))
                .collect(),
            across: rows(&self.across),
        }
    }

    /// The film on half the nodes along each side with more than `least` nodes; `None` if there is no such
    /// side.
    pub(super) fn coarser(&self, least: usize) -> Option<Self> {
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        let half = |n: usize| if n > least { n.div_ceil(2) } else { n };
        let make = if self.grid.is_strip() { Grid::strip } else { Grid::from_edges };
        let (coarse_x, coarse_y) = (half(nx), half(ny));
        if (coarse_x, coarse_y) == (nx, ny) {
            return None;
        }
        // The same box with half the cells.
        let edges = |first: f64, d: f64, n: usize| [first - 0.5 * d, first + d * (n as f64 - 0.5)];
        let x = edges(self.grid.x(0), self.grid.dx(), nx);
        let y = edges(self.grid.y(0), self.grid.dy(), ny);
        let grid = make(coarse_x, coarse_y, x, y).ok()?;
        // Films of the nearest nodes.
        let of = |i: usize, n: usize, coarse: usize| ((2 * i + 1) * n / (2 * coarse)).min(n - 1);
        let film: Vec<f64> = (0..coarse_y)
            .flat_map(|j| (0..coarse_x).map(move |i| of(j, ny, coarse_y) * nx + of(i, nx, coarse_x)))
            .map(|k| self.nodes[k])
            .collect();
        Self::from_nodes(grid, &film).ok()
    }
}

/// Error for a film that is not finite and positive.
fn check_values(film: &[f64]) -> Result<(), InputError> {
    InputError::require_finite("film", film)?;
    match film.iter().position(|&h| h <= 0.0) {
        None => Ok(()),
        Some(k) => InputError::require_positive(&format!("film[{k}]"), film[k]),
    }
}

/// The films on both sides of face `i` of a row.
fn neighbours(row: &[f64], i: usize) -> (f64, f64) {
    (row[i.max(1) - 1], row[i.min(row.len() - 1)])
}

/// The two pieces between `ends`, joined at the film jump or in the middle.
fn face_integral(film: impl Fn(f64) -> f64, ends: [f64; 2]) -> FaceIntegral {
    let [start, end] = ends;
    let at = |share: f64| film(start + share * (end - start));
    let (mut low, mut high) = (0.0, 1.0);
    let (mut film_low, mut film_high) = (at(low), at(high));
    // Bisection for the steepest change of the film.
    for _ in 0..HALVINGS {
        if (film_high - film_low).abs() <= SMOOTH * film_low.min(film_high) {
            break;
        }
        let middle = 0.5 * (low + high);
        let between = at(middle);
        if (between - film_low).abs() > (film_high - between).abs() {
            (high, film_high) = (middle, between);
        } else {
            (low, film_low) = (middle, between);
        }
    }
    let jumps = (film_high - film_low).abs() > SMOOTH * film_low.min(film_high);
    let share = if jumps { (0.5_f64 * (low + high)).clamp(CLOSEST, 1.0 - CLOSEST) } else { 0.5 };
    // Gauss' rule on both sides of it.
    let piece = |from: f64, to: f64| {
        let length = 0.5 * (to - from) * (end - start);
        let [one, other] = PLACES.map(|place| Piece::constant(at(from + place * (to - from)), length));
        one.and(other)
    };
    FaceIntegral { share, pieces: [piece(0.0, share), piece(share, 1.0)] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jumps_are_found_at_any_position() {
        for edge in [1e-5, 0.1, 0.5, 0.77, 0.999] {
            let found = face_integral(|x| if x < edge { 3.0 } else { 1.0 + 0.1 * x }, [0.0, 1.0]);
            assert!((found.share - edge).abs() < 2e-6, "{edge}: {}", found.share);
            assert!((found.pieces[0].cubes - found.share / 27.0).abs() < 1e-9);
        }
        // A jump closer to a node than the smallest distance is moved to that distance.
        let close = face_integral(|x| if x < 1e-8 { 3.0 } else { 1.0 }, [0.0, 1.0]);
        assert!((close.share - CLOSEST).abs() < 1e-12);
        // A slope is not a jump.
        assert!((face_integral(|x| 1.0 + 0.3 * x, [0.0, 1.0]).share - 0.5).abs() < 1e-12);
    }

    #[test]
    fn error_names_the_position_of_a_non_positive_film() {
        let grid = Grid::from_edges(3, 1, [0.0, 3.0], [0.0, 1.0]).unwrap();
        let error = |film: &[f64]| FilmThickness::from_nodes(grid, film).unwrap_err().to_string();
        assert!(error(&[1.0, -2.0, 1.0]).contains("film[1] = -2"));
        assert!(error(&[1.0, 1.0, f64::NAN]).contains("film[2] = NaN"));
        assert!(error(&[1.0]).contains("film has 1 values, expected 3"));
        assert!(FilmThickness::from_function(grid, |x, _| if x > 2.8 { 0.0 } else { 1.0 }).is_err());
    }
}
