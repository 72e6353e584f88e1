//! Nested dissection of a grid, the elimination order of its nodes (George 1973, SIAM J. Numer. Anal. 10,
//! 345-363).
//!
//! The nodes of a periodic grid form a ring. A line of nodes around it leaves two shorter rings, two opposite lines
//! along it leave two rectangles; the separator with fewer nodes is taken.

use std::ops::Range;

use super::periodicity::Periodicity;

/// Largest number of nodes in a leaf of the dissection.
const LEAF: usize = 16;

/// Nodes that are eliminated together: a separator, or a leaf of the dissection.
#[derive(Debug, Clone)]
pub(super) struct Supernode {
    /// Positions of its nodes in the elimination order.
    pub(super) positions: Range<usize>,
    /// The two subdomains that the separator divides; `None` for a leaf.
    pub(super) children: Option<[usize; 2]>,
    /// First supernode of the subtree whose root this is.
    pub(super) first: usize,
}

/// The separator tree in postorder: children before their separator.
#[derive(Debug, Clone)]
pub(super) struct Dissection {
    /// The supernodes; the last one is the root.
    pub(super) supernodes: Vec<Supernode>,
    /// The nodes in elimination order.
    pub(super) order: Vec<u32>,
}

/// A rectangle of nodes.
#[derive(Debug, Clone, Copy)]
struct Region {
    /// First column and one past the last.
    x: (usize, usize),
    /// First row and one past the last.
    y: (usize, usize),
    /// Whether its first and last columns or rows are neighbors.
    periodicity: Periodicity,
}

/// A region in two subdomains without couplings between them, and the separator.
struct Split {
    /// The two subdomains.
    subdomains: [Region; 2],
    /// The lines of the separator; the second is empty except in a ring that is cut open.
    separator: [Region; 2],
}

/// Middle of a range.
fn middle((start, end): (usize, usize)) -> usize {
    start + (end - start) / 2
}

impl Region {
    /// Number of nodes.
    fn len(self) -> usize {
        (self.x.1 - self.x.0) * (self.y.1 - self.y.0)
    }

    /// Indices of the nodes, row by row, on a grid of `nx` columns.
    fn nodes(self, nx: usize) -> impl Iterator<Item = usize> {
        (self.y.0..self.y.1).flat_map(move |j| (self.x.0..self.x.1).map(move |i| j * nx + i))
    }

    /// Splits a rectangle by a line of nodes across its longer side, a ring by a line around it or, where it is
    /// shorter than half its circumference, by two opposite lines along it.
    fn split(self) -> Split {
        let [columns, rows] = [self.x, self.y].map(|(start, end)| end - start);
        match self.periodicity {
            Periodicity::None if columns >= rows => self.split_at_column(),
            Periodicity::None => self.split_at_row(),
            Periodicity::AlongX if 2 * rows >= columns => self.split_at_row(),
            Periodicity::AlongY if 2 * columns >= rows => self.split_at_column(),
            Periodicity::AlongX => Self { x: (self.x.0 + 1, self.x.1), ..self.cut() }
                .split_at_column()
                .with_line(Self { x: (self.x.0, self.x.0 + 1), ..self.cut() }),
            Periodicity::AlongY => Self { y: (self.y.0 + 1, self.y.1), ..self.cut() }
                .split_at_row()
                .with_line(Self { y: (self.y.0, self.y.0 + 1), ..self.cut() }),
        }
    }

    /// The same nodes as a rectangle.
    fn cut(self) -> Self {
        Self { periodicity: Periodicity::None, ..self }
    }

    /// Splits at the middle column.
    fn split_at_column(self) -> Split {
        let (m, x) = (middle(self.x), self.x);
        let [west, east, line, none] =
            [(x.0, m), (m + 1, x.1), (m, m + 1), (m, m)].map(|x| Self { x, ..self });
        Split { subdomains: [west, east], separator: [line, none] }
    }

    /// Splits at the middle row.
    fn split_at_row(self) -> Split {
        let (m, y) = (middle(self.y), self.y);
        let [south, north, line, none] =
            [(y.0, m), (m + 1, y.1), (m, m + 1), (m, m)].map(|y| Self { y, ..self });
        Split { subdomains: [south, north], separator: [line, none] }
    }
}

impl Split {
    /// The split with another line of nodes in the separator.
    fn with_line(self, line: Region) -> Self {
        Self { separator: [line, self.separator[0]], ..self }
    }
}

impl Dissection {
    /// Dissection of a grid of `nx` x `ny` nodes down to leaves of at most 16 nodes. It depends on the grid
    /// alone.
    pub(super) fn new(nx: usize, ny: usize, periodicity: Periodicity) -> Self {
        let mut dissection = Self { supernodes: Vec::new(), order: Vec::with_capacity(nx * ny) };
        dissection.dissect(Region { x: (0, nx), y: (0, ny), periodicity }, nx);
        dissection
    }

    /// Appends the supernodes of a region; returns the index of the last one.
    fn dissect(&mut self, region: Region, nx: usize) -> usize {
        let first = self.supernodes.len();
        let mut pivots = [region, Region { x: (0, 0), ..region }];
        let mut children = None;
        if region.len() > LEAF {
            let split = region.split();
            children = Some(split.subdomains.map(|subdomain| self.dissect(subdomain, nx)));
            pivots = split.separator;
        }
        let start = self.order.len();
        let nodes = pivots.into_iter().flat_map(|lines| lines.nodes(nx));
        self.order.extend(nodes.map(|node| node as u32));
        self.supernodes.push(Supernode { positions: start..self.order.len(), children, first });
        self.supernodes.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_has_one_place_and_halves_come_first() {
        let shapes = [(1, 1), (1, 50), (7, 5), (40, 3), (33, 64), (9, 70), (2, 30)];
        for ((nx, ny), periodicity) in
            shapes.into_iter().flat_map(|shape| Periodicity::ALL.map(|p| (shape, p)))
        {
            let dissection = Dissection::new(nx, ny, periodicity);
            let mut nodes = dissection.order.clone();
            nodes.sort_unstable();
            assert!(nodes.iter().copied().eq(0..(nx * ny) as u32), "{nx} x {ny}");
            let mut end = 0;
            for (number, supernode) in dissection.supernodes.iter().enumerate() {
                assert_eq!(supernode.positions.start, end, "supernodes follow one another");
                end = supernode.positions.end;
                assert!(
                    supernode
                        .children
                        .is_none_or(|children| children[0] < children[1] && children[1] < number)
                );
            }
            assert_eq!(end, nx * ny);
        }
    }
}
