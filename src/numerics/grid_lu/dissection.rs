//! Nested dissection of a grid: the order in which its nodes are eliminated (George 1973, SIAM J. Numer. Anal. 10,
//! 345-363).

use std::ops::Range;

/// Largest number of nodes that are eliminated together without being split further.
const LEAF: usize = 16;

/// Nodes that are eliminated together.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// Their places in the order of elimination.
    pub(super) places: Range<usize>,
    /// The two halves that these nodes part; none of a piece that was not split.
    pub(super) halves: Option<[usize; 2]>,
    /// The first piece of the subtree that this one ends.
    pub(super) first: usize,
}

/// All pieces, halves before the nodes that part them.
#[derive(Debug, Clone)]
pub(super) struct Dissection {
    /// The pieces; the last one is the root.
    pub(super) pieces: Vec<Piece>,
    /// The nodes in the order of elimination.
    pub(super) order: Vec<u32>,
}

/// A rectangle of nodes.
#[derive(Debug, Clone, Copy)]
struct Region {
    /// First column and the one after the last.
    x: (usize, usize),
    /// First row and the one after the last.
    y: (usize, usize),
}

impl Region {
    /// Numbers of the nodes, row by row, on a grid of `nx` columns.
    fn nodes(self, nx: usize) -> impl Iterator<Item = usize> {
        (self.y.0..self.y.1).flat_map(move |j| (self.x.0..self.x.1).map(move |i| j * nx + i))
    }

    /// The two halves and the line of nodes between them, across the longer side.
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
    /// Dissection of a grid of `nx` x `ny` nodes until pieces hold at most 16 nodes; it depends on the grid
    /// alone.
    pub(super) fn new(nx: usize, ny: usize) -> Self {
        let mut dissection = Self { pieces: Vec::new(), order: Vec::with_capacity(nx * ny) };
        dissection.dissect(Region { x: (0, nx), y: (0, ny) }, nx);
        dissection
    }

    /// Adds the pieces of a region; returns the last one.
    fn dissect(&mut self, region: Region, nx: usize) -> usize {
        let first = self.pieces.len();
        let size = (region.x.1 - region.x.0) * (region.y.1 - region.y.0);
        let (halves, last) = if size <= LEAF {
            (None, region)
        } else {
            let [one, other, between] = region.split();
            (Some([self.dissect(one, nx), self.dissect(other, nx)]), between)
        };
        let start = self.order.len();
        self.order.extend(last.nodes(nx).map(|node| node as u32));
        self.pieces.push(Piece { places: start..self.order.len(), halves, first });
        self.pieces.len() - 1
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
            for (number, piece) in dissection.pieces.iter().enumerate() {
                assert_eq!(piece.places.start, end, "pieces follow one another");
                end = piece.places.end;
                assert!(piece.halves.is_none_or(|halves| halves[0] < halves[1] && halves[1] < number));
            }
            assert_eq!(end, nx * ny);
        }
    }
}
