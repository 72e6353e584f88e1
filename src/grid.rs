//! The grid: `nx` by `ny` cells of `dx` by `dy`, nodes at cell centers, fields as row-major slices.

use crate::error::InputError;

/// A uniform, cell-centered grid. Node `(i, j)` of a field is entry `j * nx + i`: x (the direction of
/// entrainment) varies fastest. Lengths in metres.
///
/// A grid with one row is a line contact: `dy` is the contact length of all loads and areas, one metre by
/// convention. A [strip](Grid::strip) is a line contact whose surfaces repeat along y.
///
/// ```
/// use stribeck::Grid;
/// let grid = Grid::from_edges(128, 64, [-0.25e-3, 0.25e-3], [-0.125e-3, 0.125e-3])?;
/// assert_eq!(grid.len(), 128 * 64);
/// assert!((grid.x(0) - (-0.25e-3 + 0.5 * grid.dx())).abs() < 1e-18);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Nodes along x.
    nx: usize,
    /// Nodes along y.
    ny: usize,
    /// Node spacing along x \[m\].
    dx: f64,
    /// Node spacing along y \[m\].
    dy: f64,
    /// Coordinate of the first column \[m\].
    x0: f64,
    /// Coordinate of the first row \[m\].
    y0: f64,
    /// Whether the rows repeat along y.
    is_periodic: bool,
}

impl Grid {
    /// Largest accepted number of nodes, a guard against typing errors.
    pub const MAX_NODES: usize = 1 << 26;

    /// Grid of `nx` x `ny` cells of `dx` x `dy` \[m\], centered on the origin.
    ///
    /// # Errors
    /// A count of zero, more than [`Grid::MAX_NODES`] nodes, or a spacing that is not finite and positive.
    pub fn centred(nx: usize, ny: usize, dx: f64, dy: f64) -> Result<Self, InputError> {
        let (half_x, half_y) = (0.5 * dx * nx as f64, 0.5 * dy * ny as f64);
        Self::check(nx, ny)?;
        InputError::require_positive("grid.dx", dx)?;
        InputError::require_positive("grid.dy", dy)?;
        Self::from_edges(nx, ny, [-half_x, half_x], [-half_y, half_y])
    }

    /// Grid of `nx` x `ny` cells that fills the box with outer edges `x` and `y` \[m\].
    ///
    /// # Errors
    /// A count of zero, more than [`Grid::MAX_NODES`] nodes, or edges that are not finite and increasing.
    pub fn from_edges(nx: usize, ny: usize, x: [f64; 2], y: [f64; 2]) -> Result<Self, InputError> {
        Self::check(nx, ny)?;
        for (field, edges) in [("grid.x", x), ("grid.y", y)] {
            InputError::require(edges[0].is_finite(), field, edges[0], "finite")?;
            InputError::require(
                edges[1].is_finite() && edges[1] > edges[0],
                field,
                edges[1],
                "finite and above the lower edge",
            )?;
        }
        let (dx, dy) = ((x[1] - x[0]) / nx as f64, (y[1] - y[0]) / ny as f64);
        InputError::require_positive("grid.dx", dx)?;
        InputError::require_positive("grid.dy", dy)?;
        Ok(Self { nx, ny, dx, dy, x0: x[0] + 0.5 * dx, y0: y[0] + 0.5 * dy, is_periodic: false })
    }

    /// Grid of a strip: a line contact, endless along y, whose surfaces repeat with the width of the box. Deformation and
    /// flow repeat with them: the last row is next to the first one. Loads, areas and flows of fields on it are those of
    /// one period, [`Grid::size_y`].
    ///
    /// # Errors
    /// Those of [`Grid::from_edges`], and fewer than 5 rows.
    ///
    /// ```
    /// use stribeck::Grid;
    /// let strip = Grid::strip(128, 64, [-0.25e-3, 0.25e-3], [-0.1e-3, 0.1e-3])?;
    /// assert!(strip.is_strip() && (strip.size_y() / 0.2e-3 - 1.0).abs() < 1e-12);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn strip(nx: usize, ny: usize, x: [f64; 2], y: [f64; 2]) -> Result<Self, InputError> {
        InputError::require(ny >= 5, "grid.ny", ny as f64, "at least 5 for a strip")?;
        Ok(Self { is_periodic: true, ..Self::from_edges(nx, ny, x, y)? })
    }

    /// The first `nx` x `ny` cells; a strip keeps its period if these are all of its rows.
    pub(crate) fn corner(&self, nx: usize, ny: usize) -> Self {
        Self { nx, ny, is_periodic: self.is_periodic && ny == self.ny, ..*self }
    }

    /// Another mesh of the same box.
    pub(crate) fn with_cells(&self, nx: usize, ny: usize) -> Self {
        let (dx, dy) = (self.size_x() / nx as f64, self.size_y() / ny as f64);
        let (x0, y0) = (self.x0 + 0.5 * (dx - self.dx), self.y0 + 0.5 * (dy - self.dy));
        Self { nx, ny, dx, dy, x0, y0, ..*self }
    }

    /// Rejects a count of zero, and more nodes than [`Grid::MAX_NODES`].
    fn check(nx: usize, ny: usize) -> Result<(), InputError> {
        InputError::require(nx > 0, "grid.nx", nx as f64, "at least 1")?;
        InputError::require(ny > 0, "grid.ny", ny as f64, "at least 1")?;
        let nodes = nx as f64 * ny as f64;
        InputError::require(
            nodes <= Self::MAX_NODES as f64,
            "grid.nx * grid.ny",
            nodes,
            "at most 2^26 (67 million)",
        )
    }

    /// Number of nodes along x.
    pub fn nx(&self) -> usize {
        self.nx
    }
    /// Number of nodes along y.
    pub fn ny(&self) -> usize {
        self.ny
    }
    /// Spacing along x \[m\].
    pub fn dx(&self) -> f64 {
        self.dx
    }
    /// Spacing along y \[m\].
    pub fn dy(&self) -> f64 {
        self.dy
    }
    /// Number of nodes of a field.
    #[expect(clippy::len_without_is_empty, reason = "a grid has at least one node")]
    pub fn len(&self) -> usize {
        self.nx * self.ny
    }
    /// Whether the rows repeat along y, see [`Grid::strip`].
    pub fn is_strip(&self) -> bool {
        self.is_periodic
    }
    /// Whether the first and the last row are edges: not for a line contact, as one row or as a strip.
    pub(crate) fn has_side_edges(&self) -> bool {
        self.ny > 1 && !self.is_periodic
    }
    /// Node north of node `k`, on a strip that in the first row for the last one; `None` across an edge.
    #[inline]
    pub(crate) fn north_of(&self, k: usize) -> Option<usize> {
        let north = k + self.nx;
        if north < self.len() { Some(north) } else { self.is_periodic.then(|| north - self.len()) }
    }
    /// Node south of node `k`, on a strip that in the last row for the first one; `None` across an edge.
    #[inline]
    pub(crate) fn south_of(&self, k: usize) -> Option<usize> {
        if k >= self.nx { Some(k - self.nx) } else { self.is_periodic.then(|| k + self.len() - self.nx) }
    }
    /// Length that the loads, areas and flows of a line contact on this grid refer to; one for a point contact
    /// \[m\].
    pub(crate) fn contact_length(&self) -> f64 {
        if self.is_periodic { self.size_y() } else { 1.0 }
    }
    /// Area of one cell \[m^2\].
    pub fn cell_area(&self) -> f64 {
        self.dx * self.dy
    }
    /// Extent along x \[m\].
    pub fn size_x(&self) -> f64 {
        self.dx * self.nx as f64
    }
    /// Extent along y \[m\].
    pub fn size_y(&self) -> f64 {
        self.dy * self.ny as f64
    }
    /// Coordinate of column `i` \[m\].
    pub fn x(&self, i: usize) -> f64 {
        self.x0 + self.dx * i as f64
    }
    /// Coordinate of row `j` \[m\].
    pub fn y(&self, j: usize) -> f64 {
        self.y0 + self.dy * j as f64
    }

    /// The coordinates `(x, y)` of every node, in the order of a field \[m\].
    pub fn nodes(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        (0..self.ny).flat_map(move |j| (0..self.nx).map(move |i| (self.x(i), self.y(j))))
    }

    /// Value of `field` at `(x, y)` \[m\] by bilinear interpolation (constant beyond the outermost nodes).
    ///
    /// # Errors
    /// [`InputError::Shape`] when `field` does not fit the grid.
    pub fn interpolate(&self, field: &[f64], x: f64, y: f64) -> Result<f64, InputError> {
        InputError::require_len("field", field, self.len())?;
        let locate = |offset: f64, n: usize| {
            let position = offset.clamp(0.0, (n - 1) as f64);
            let low = (position as usize).min(n.saturating_sub(2));
            (low, (low + 1).min(n - 1), position - low as f64)
        };
        let (i0, i1, fx) = locate((x - self.x0) / self.dx, self.nx);
        let (j0, j1, fy) = locate((y - self.y0) / self.dy, self.ny);
        let at = |i: usize, j: usize| field[j * self.nx + i];
        Ok((1.0 - fy) * ((1.0 - fx) * at(i0, j0) + fx * at(i1, j0))
            + fy * ((1.0 - fx) * at(i0, j1) + fx * at(i1, j1)))
    }

    /// Checks that `values` are finite, one per node; an error names the row and column.
    pub(crate) fn require_field(&self, field: &str, values: &[f64]) -> Result<(), InputError> {
        InputError::require_len(field, values, self.len())?;
        InputError::require_finite(field, values).map_err(|error| match error {
            InputError::NotFinite { field, index, value } => {
                InputError::NotFinite { field: self.row(&field, index), index: index % self.nx, value }
            }
            other => other,
        })
    }

    /// Name of the row of `field` that contains node `k`; the name of the field itself for a single row.
    pub(crate) fn row(&self, field: &str, k: usize) -> String {
        if self.ny == 1 { field.to_owned() } else { format!("{field}[{}]", k / self.nx) }
    }

    /// Checks that the system can allocate `bytes` per node.
    pub(crate) fn require_memory(&self, bytes: usize) -> Result<(), InputError> {
        let bytes = self.len().saturating_mul(bytes);
        let mut trial: Vec<u8> = Vec::new();
        let granted = trial.try_reserve_exact(bytes).is_ok();
        // The compiler would remove an unused allocation.
        std::hint::black_box(&mut trial);
        if granted {
            return Ok(());
        }
        Err(InputError::Conflict {
            field: format!("grid.nx * grid.ny = {}", self.len()),
            reason: format!(
                "a contact on so many nodes needs {:.0} GB of memory, more than is available",
                bytes as f64 * 1e-9
            ),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grid_beyond_the_memory_is_rejected() -> Result<(), InputError> {
        let grid = Grid::centred(8, 8, 1e-6, 1e-6)?;
        let refused = grid.require_memory(1 << 50);
        assert!(matches!(&refused, Err(error) if error.to_string().contains("72057594 GB")), "{refused:?}");
        grid.require_memory(1 << 10)
    }
}
