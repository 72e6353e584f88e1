//! Nested dissection of a grid: the order in which its nodes are eliminated, and what each elimination
//! touches (George 1973, SIAM J. Numer. Anal. 10, 345-363).

use std::ops::Range;

use super::STENCIL;
use super::dense::padded;

/// Largest number of nodes that are eliminated together without being split further.
const LEAF: usize = 16;

/// Nodes that are eliminated together.
#[derive(Debug, Clone)]
pub(super) struct Front {
    /// Their places in the order of elimination.
    pub(super) pivots: Range<usize>,
    /// Places of the nodes around them that are eliminated later, ascending.
    pub(super) border: Vec<usize>,
    /// Fronts whose remainders are added to this one.
    pub(super) children: Vec<Child>,
    /// Entries of the stencil among the pivots.
    pub(super) entries: Vec<Entry>,
    /// Entries of the stencil between pivots and border; of a leaf one for each node of the border, in their
    /// order.
    pub(super) edges: Vec<Edge>,
    /// The first front of the subtree that this one ends.
    pub(super) first: usize,
}

/// A front as its parent sees it.
#[derive(Debug, Clone)]
pub(super) struct Child {
    /// Its number.
    pub(super) front: usize,
    /// Where the nodes of its border are in the parent.
    pub(super) runs: Vec<Run>,
}

/// An entry of the stencil in the block of the pivots.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    /// Where it is in the stencil.
    pub(super) from: usize,
    /// Where it goes in the block.
    pub(super) to: usize,
}

/// A pivot and a node of the border that are neighbours.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// The row of the pivot in the block.
    pub(super) pivot: usize,
    /// The place of the other in the border.
    pub(super) border: usize,
    /// Where in the stencil the entry in the row of the pivot is.
    pub(super) of_pivot: usize,
    /// Where the one in the row of the other is.
    pub(super) of_border: usize,
}

/// Nodes of a child's border that follow one another in its parent too.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    /// Place of the first in the border of the child.
    pub(super) from: usize,
    /// Its row in the parent: pivots, padded to whole vectors, then border.
    pub(super) to: usize,
    /// Number of nodes.
    pub(super) length: usize,
}

impl Front {
    /// Rows of the pivots, padded.
    pub(super) fn pivot_rows(&self) -> usize {
        padded(self.pivots.len())
    }

    /// Rows of the border, padded.
    pub(super) fn border_rows(&self) -> usize {
        padded(self.border.len())
    }
}

/// All fronts, children before their parents.
#[derive(Debug, Clone)]
pub(super) struct Dissection {
    /// The fronts; the last one is the root, which has no border.
    pub(super) fronts: Vec<Front>,
    /// Place of each node in the order of elimination.
    pub(super) place: Vec<usize>,
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

    /// Nodes of the grid next to the region.
    fn neighbours(self, nx: usize, ny: usize) -> Vec<usize> {
        let mut found = Vec::new();
        let sides = [(self.y.0 > 0, self.y.0.wrapping_sub(1)), (self.y.1 < ny, self.y.1)];
        for (_, j) in sides.into_iter().filter(|side| side.0) {
            found.extend((self.x.0..self.x.1).map(|i| j * nx + i));
        }
        let sides = [(self.x.0 > 0, self.x.0.wrapping_sub(1)), (self.x.1 < nx, self.x.1)];
        for (_, i) in sides.into_iter().filter(|side| side.0) {
            found.extend((self.y.0..self.y.1).map(|j| j * nx + i));
        }
        found
    }
}

impl Dissection {
    /// Dissection of a grid of `nx` x `ny` nodes until pieces hold at most 16 nodes; it depends on the grid
    /// alone.
    pub(super) fn new(nx: usize, ny: usize) -> Self {
        let mut dissection = Self { fronts: Vec::new(), place: vec![0; nx * ny] };
        let mut eliminated = 0;
        dissection.dissect(Region { x: (0, nx), y: (0, ny) }, nx, ny, &mut eliminated);
        dissection.link();
        dissection.place_entries(nx, ny);
        dissection
    }

    /// Adds the fronts of a region; returns the last one. Borders hold nodes, not places yet.
    fn dissect(&mut self, region: Region, nx: usize, ny: usize, eliminated: &mut usize) -> usize {
        let size = (region.x.1 - region.x.0) * (region.y.1 - region.y.0);
        let (parts, last) = if size <= LEAF {
            (Vec::new(), region)
        } else {
            let [one, other, between] = region.split();
            (vec![one, other], between)
        };
        let first = self.fronts.len();
        let children: Vec<Child> = parts
            .into_iter()
            .map(|part| Child { front: self.dissect(part, nx, ny, eliminated), runs: Vec::new() })
            .collect();
        let start = *eliminated;
        for node in last.nodes(nx) {
            self.place[node] = *eliminated;
            *eliminated += 1;
        }
        let border = region.neighbours(nx, ny);
        self.fronts.push(Front {
            pivots: start..*eliminated,
            border,
            children,
            entries: Vec::new(),
            edges: Vec::new(),
            first,
        });
        self.fronts.len() - 1
    }

    /// Turns nodes into places, and finds the borders of children in their parents.
    fn link(&mut self) {
        for front in &mut self.fronts {
            for node in &mut front.border {
                *node = self.place[*node];
            }
            front.border.sort_unstable();
        }
        let mut row_of = vec![0; self.place.len()];
        for parent in 0..self.fronts.len() {
            let front = &self.fronts[parent];
            let rows = (0..front.pivots.len()).chain(front.pivot_rows()..);
            for (place, row) in front.pivots.clone().chain(front.border.iter().copied()).zip(rows) {
                row_of[place] = row;
            }
            let mut children = front.children.clone();
            for child in &mut children {
                let rows = self.fronts[child.front].border.iter().map(|&place| row_of[place]);
                child.runs = runs(rows, self.fronts[parent].pivot_rows());
            }
            self.fronts[parent].children = children;
        }
    }

    /// Finds the front that eliminates each entry of the stencil.
    fn place_entries(&mut self, nx: usize, ny: usize) {
        let mut node_at = vec![0; self.place.len()];
        for (node, &place) in self.place.iter().enumerate() {
            node_at[place] = node;
        }
        for front in &mut self.fronts {
            let rows = front.pivot_rows();
            for (row, place) in front.pivots.clone().enumerate() {
                let k = node_at[place];
                front.entries.push(Entry { from: STENCIL * k, to: row * rows + row });
                let (i, j) = (k % nx, k / nx);
                let inside = [i + 1 < nx, i > 0, j + 1 < ny, j > 0];
                let nodes = [k + 1, k.wrapping_sub(1), k + nx, k.wrapping_sub(nx)];
                for slot in (0..4).filter(|&slot| inside[slot]) {
                    let other = self.place[nodes[slot]];
                    let of_pivot = STENCIL * k + slot + 1;
                    if front.pivots.contains(&other) {
                        let column = other - front.pivots.start;
                        front.entries.push(Entry { from: of_pivot, to: column * rows + row });
                    } else if other >= front.pivots.end {
                        let border = front.border.partition_point(|&node| node < other);
                        let of_border = STENCIL * nodes[slot] + (slot ^ 1) + 1;
                        front.edges.push(Edge { pivot: row, border, of_pivot, of_border });
                    }
                }
            }
            front.edges.sort_unstable_by_key(|edge| edge.border);
        }
    }
}

/// Joins rows that follow one another on the same side of row `boundary`.
fn runs(rows: impl Iterator<Item = usize>, boundary: usize) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (from, to) in rows.enumerate() {
        match runs.last_mut() {
            Some(run) if run.to + run.length == to && to != boundary => run.length += 1,
            _ => runs.push(Run { from, to, length: 1 }),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_has_one_place_and_borders_come_later() {
        for (nx, ny) in [(1, 1), (1, 50), (7, 5), (40, 3), (33, 64)] {
            let dissection = Dissection::new(nx, ny);
            let mut places = dissection.place.clone();
            places.sort_unstable();
            assert!(places.iter().copied().eq(0..nx * ny), "{nx} x {ny}");
            let mut end = 0;
            for front in &dissection.fronts {
                assert_eq!(front.pivots.start, end, "fronts follow one another");
                end = front.pivots.end;
                assert!(front.border.iter().all(|&place| place >= end), "borders are eliminated later");
            }
        }
    }
}
