//! Neighbors of the nodes of a grid that may repeat along one of its axes.

/// The axis along which a grid repeats.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Periodicity {
    /// The grid has four edges.
    #[default]
    None,
    /// The node east of the last column is that of the first column in the same row.
    AlongX,
    /// The node north of the last row is that of the first row in the same column.
    AlongY,
}

/// The five-point stencil of each node.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Neighbors {
    nx: usize,
    ny: usize,
    periodicity: Periodicity,
}

impl Periodicity {
    /// All of them.
    #[cfg(test)]
    pub(super) const ALL: [Self; 3] = [Self::None, Self::AlongX, Self::AlongY];
}

impl Neighbors {
    /// Stencils of a grid.
    pub(crate) fn new(nx: usize, ny: usize, periodicity: Periodicity) -> Self {
        Self { nx, ny, periodicity }
    }

    /// Node in `slot` of the stencil of `node`: itself, east, west, north, south. Across an edge it has no meaning
    /// and may be beyond the last node.
    #[inline(always)]
    pub(crate) fn at(&self, node: usize, slot: usize) -> usize {
        let (nx, n) = (self.nx, self.nx * self.ny);
        match (slot, self.periodicity) {
            (0, _) => node,
            (1, Periodicity::AlongX) if node % nx + 1 == nx => node + 1 - nx,
            (2, Periodicity::AlongX) if node.is_multiple_of(nx) => node + nx - 1,
            (3, Periodicity::AlongY) if node + nx >= n => node + nx - n,
            (4, Periodicity::AlongY) if node < nx => node + n - nx,
            (1, _) => node + 1,
            (2, _) => node.wrapping_sub(1),
            (3, _) => node + nx,
            _ => node.wrapping_sub(nx),
        }
    }

    /// Whether the stencil of `node` has a node to the east, west, north or south (0 to 3).
    pub(super) fn has(&self, node: usize, side: usize) -> bool {
        let (i, j) = (node % self.nx, node / self.nx);
        let is_endless = match self.periodicity {
            Periodicity::None => false,
            Periodicity::AlongX => side < 2,
            Periodicity::AlongY => side >= 2,
        };
        is_endless || [i + 1 < self.nx, i > 0, j + 1 < self.ny, j > 0][side]
    }
}
