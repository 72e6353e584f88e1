//! Nested dissection of a grid, the elimination order of its nodes (George 1973, SIAM J. Numer. Anal. 10,
//! 345-363).

use std::ops::Range;

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
}

impl Region {
    /// Indices of the nodes, row by row, on a grid of `nx` columns.
    fn nodes(self, nx: usize) -> impl Iterator<Item = usize> {
        (self.y.0..self.y.1).flat_map(move |j| (self.x.0..self.x.1).map(move |i| j * nx + i))
    }

    /// The two subdomains and the separator between them, a line of nodes across the longer side.
    fn split(self) -> [Self; 3] {
        let middle = |(start, end): (usize, usize)| start + (end - start) / 2;
        let (x, y) = (self.x, self.y);
        if x.1 - x.0 >= y.1 - y.0 {
            let m = middle(x);
            [(x.0, m), (m + 1, x.1), (m, m + 1)].map(|x| Self { x, y })
        } else {
            let m = middle(y);
            [(y.0, m), (m + 1, y.1), (m, m + 1)].map(|y| Self { x, y })
        }
    }
}

impl Dissection {
    /// Dissection of a grid of `nx` x `ny` nodes down to leaves of at most 16 nodes. It depends on the grid
    /// alone.
    pub(super) fn new(nx: usize, ny: usize) -> Self {
        let mut dissection = Self { supernodes: Vec::new(), order: Vec::with_capacity(nx * ny) };
        dissection.dissect(Region { x: (0, nx), y: (0, ny) }, nx);
        dissection
    }

    /// Appends the supernodes of a region; returns the index of the last one.
    fn dissect(&mut self, region: Region, nx: usize) -> usize {
        let first = self.supernodes.len();
        let size = (region.x.1 - region.x.0) * (region.y.1 - region.y.0);
        let (children, last) = if size <= LEAF {
            (None, region)
        } else {
            let [one, other, between] = region.split();
            (Some([self.dissect(one, nx), self.dissect(other, nx)]), between)
        };
        let start = self.order.len();
        self.order.extend(last.nodes(nx).map(|node| node as u32));
        self.supernodes.push(Supernode { positions: start..self.order.len(), children, first });
        self.supernodes.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_has_one_place_and_halves_come_first() {
        for (nx, ny) in [(1, 1), (1, 50), (7, 5), (40, 3), (33, 64)] {
            let dissection = Dissection::new(nx, ny);
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
