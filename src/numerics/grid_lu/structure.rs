//! What the fronts of a matrix hold: of the pieces of the dissection those nodes that its entries link to others.
//!
//! Nodes count by their *rank*, the number of linked nodes that are eliminated before them. The border of a front
//! is made of the ranks that its elimination links to later ones: those of its children's borders that are no
//! pivots of its own, and neighbours of its pivots.

use std::ops::Range;

use super::dense::padded;
use super::dissection::Dissection;
use super::{Matrix, STENCIL};

/// Rank of a node that no entry links to others.
pub(super) const NONE: u32 = u32::MAX;

/// Linked nodes of a piece, and the later ones that their elimination links.
#[derive(Debug, Clone, Default)]
pub(super) struct Front {
    /// Ranks of the nodes that are eliminated.
    pub(super) pivots: Range<usize>,
    /// Where the ranks around them are in [`Structure::borders`], ascending.
    border: Range<usize>,
    /// Where the entries between pivots and border are in [`Structure::edges`].
    edges: Range<usize>,
    /// Where the front's border is in its parent, in [`Structure::runs`].
    runs: Range<usize>,
    /// Whether the piece was not split.
    pub(super) is_leaf: bool,
    /// Where the front's values begin in the factors of all, and in the vectors of all.
    pub(super) factors_at: usize,
    pub(super) vectors_at: usize,
}

/// A pivot and a node of the border that are neighbours.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// The row of the pivot in its block.
    pub(super) pivot: u32,
    /// The place of the other in the border.
    pub(super) border: u32,
    /// Where in the stencil the entry in the row of the pivot is.
    pub(super) of_pivot: u32,
    /// Where the one in the row of the other is.
    pub(super) of_border: u32,
}

/// Nodes of a child's border that follow one another in its parent too.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    /// Place of the first in the border of the child.
    pub(super) from: u32,
    /// Its row in the parent: pivots, padded to whole vectors, then border.
    pub(super) to: u32,
    /// Number of nodes.
    pub(super) length: u32,
}

/// The fronts of a matrix.
#[derive(Debug, Default)]
pub(super) struct Structure {
    /// In the order of the pieces.
    pub(super) fronts: Vec<Front>,
    /// Rank of each node, [`NONE`] of those that are not linked.
    pub(super) rank: Vec<u32>,
    /// Node of each rank.
    pub(super) nodes: Vec<u32>,
    /// Borders, edges and runs of all fronts.
    borders: Vec<u32>,
    edges: Vec<Edge>,
    runs: Vec<Run>,
    /// What is merged into a border.
    merged: [Vec<u32>; 2],
    /// From a node to those of its stencil.
    pub(super) offsets: [isize; STENCIL],
    /// Values in the factors and in the vectors of all fronts.
    pub(super) factors: usize,
    pub(super) vectors: usize,
}

impl Front {
    /// Whether there is nothing to do for the front.
    pub(super) fn is_empty(&self) -> bool {
        self.size() == [0, 0]
    }

    /// Number of pivots and of nodes in the border.
    pub(super) fn size(&self) -> [usize; 2] {
        [self.pivots.len(), self.border.len()]
    }

    /// Rows of the pivots, padded.
    pub(super) fn pivot_rows(&self) -> usize {
        padded(self.pivots.len())
    }

    /// Rows of the border, padded.
    pub(super) fn border_rows(&self) -> usize {
        padded(self.border.len())
    }
}

impl Run {
    /// Its rows in the parent.
    pub(super) fn rows(&self) -> Range<usize> {
        self.to as usize..(self.to + self.length) as usize
    }
}

impl Structure {
    /// That of a matrix in which all neighbours are linked, which is the largest: room for all others.
    pub(super) fn full(dissection: &Dissection, nx: usize, ny: usize) -> Self {
        let offsets = [0, 1, -1, nx as isize, -(nx as isize)];
        let mut structure = Self { offsets, ..Self::default() };
        structure.update(dissection, |node, slot| {
            let (i, j) = (node % nx, node / nx);
            [i + 1 < nx, i > 0, j + 1 < ny, j > 0][slot]
        });
        let most = structure.borders.len();
        structure.runs.reserve(most.saturating_sub(structure.runs.len()));
        structure
    }

    /// Takes over a matrix in which `links` says of a node and its neighbour to the east, west, north or south
    /// (0 to 3) whether one has an entry of the other.
    pub(super) fn update(&mut self, dissection: &Dissection, links: impl Fn(usize, usize) -> bool) {
        self.rank.resize(dissection.order.len(), NONE);
        self.fronts.resize(dissection.pieces.len(), Front::default());
        self.nodes.clear();
        self.borders.clear();
        self.edges.clear();
        self.runs.clear();
        (self.factors, self.vectors) = (0, 0);
        for (piece, front) in dissection.pieces.iter().zip(&mut self.fronts) {
            let first = self.nodes.len();
            for &node in &dissection.order[piece.places.clone()] {
                let is_linked = (0..4).any(|slot| links(node as usize, slot));
                self.rank[node as usize] = if is_linked { self.nodes.len() as u32 } else { NONE };
                if is_linked {
                    self.nodes.push(node);
                }
            }
            front.pivots = first..self.nodes.len();
            front.is_leaf = piece.halves.is_none();
        }
        for (number, piece) in dissection.pieces.iter().enumerate() {
            self.find_edges(number, &links);
            self.find_border(number, piece.halves);
            let front = &mut self.fronts[number];
            (front.factors_at, front.vectors_at) = (self.factors, self.vectors);
            self.factors += front.factors();
            self.vectors += front.pivot_rows() + front.border_rows();
        }
    }

    /// Finds the entries between the pivots of a front and later nodes, with ranks for places in the border.
    fn find_edges(&mut self, number: usize, links: impl Fn(usize, usize) -> bool) {
        let pivots = self.fronts[number].pivots.clone();
        let from = self.edges.len();
        for (pivot, &node) in self.nodes[pivots.clone()].iter().enumerate() {
            let node = node as usize;
            for slot in (0..4).filter(|&slot| links(node, slot)) {
                let other = node.wrapping_add_signed(self.offsets[slot + 1]);
                let rank = self.rank[other];
                if rank as usize >= pivots.end {
                    self.edges.push(Edge {
                        pivot: pivot as u32,
                        border: rank,
                        of_pivot: (STENCIL * node + slot + 1) as u32,
                        of_border: (STENCIL * other + (slot ^ 1) + 1) as u32,
                    });
                }
            }
        }
        self.edges[from..].sort_unstable_by_key(|edge| edge.border);
        self.fronts[number].edges = from..self.edges.len();
    }

    /// Finds the border of a front, the places of its edges in it and the runs of its children.
    fn find_border(&mut self, number: usize, children: Option<[usize; 2]>) {
        let Self { fronts, borders, edges, runs, merged: [of_children, of_edges], .. } = self;
        let front = &fronts[number];
        let (pivots, edges) = (front.pivots.clone(), &mut edges[front.edges.clone()]);
        let later = |child: usize| {
            let border = &borders[fronts[child].border.clone()];
            &border[border.partition_point(|&rank| (rank as usize) < pivots.end)..]
        };
        of_children.clear();
        if let Some([one, other]) = children {
            merge(later(one), later(other), of_children);
        }
        of_edges.clear();
        of_edges.extend(edges.iter().map(|edge| edge.border));
        of_edges.dedup();
        let from = borders.len();
        merge(of_children, of_edges, borders);
        let border = &borders[from..];
        let mut place = 0;
        for edge in edges {
            place += border[place..].iter().take_while(|&&rank| rank < edge.border).count();
            edge.border = place as u32;
        }
        for child in children.into_iter().flatten() {
            let first_run = runs.len();
            add_runs_of(&borders[fronts[child].border.clone()], &pivots, border, runs);
            fronts[child].runs = first_run..runs.len();
        }
        fronts[number].border = from..borders.len();
    }

    /// Puts the entries of a matrix among the pivots of a front into their block.
    #[inline(always)]
    pub(super) fn place_entries(&self, front: &Front, matrix: Matrix<'_>, block: &mut [f32]) {
        let (pivots, rows) = (front.pivots.clone(), front.pivot_rows());
        for (row, &node) in self.nodes[pivots.clone()].iter().enumerate() {
            let node = node as usize;
            for (slot, offset) in self.offsets.iter().enumerate() {
                let entry = matrix.entry(STENCIL * node + slot);
                let column =
                    self.rank.get(node.wrapping_add_signed(*offset)).map_or(NONE, |rank| *rank) as usize;
                if entry != 0.0 && pivots.contains(&column) {
                    block[(column - pivots.start) * rows + row] = entry;
                }
            }
        }
    }

    /// The entries between pivots and border of a front; of a leaf one for each node of the border, in their
    /// order.
    pub(super) fn edges(&self, front: &Front) -> &[Edge] {
        &self.edges[front.edges.clone()]
    }

    /// Where the border of a front is in its parent.
    pub(super) fn runs(&self, front: &Front) -> &[Run] {
        &self.runs[front.runs.clone()]
    }
}

/// Adds the ranks that are in one of two lists, both ascending, to `out`.
fn merge(mut one: &[u32], mut other: &[u32], out: &mut Vec<u32>) {
    while let ([first, rest @ ..], [second, others @ ..]) = (one, other) {
        out.push(*first.min(second));
        if first <= second {
            one = rest;
        }
        if second <= first {
            other = others;
        }
    }
    out.extend_from_slice(one);
    out.extend_from_slice(other);
}

/// Adds the runs of the ranks of a child, all of which are among the `pivots` or in the `border` of its parent.
fn add_runs_of(child: &[u32], pivots: &Range<usize>, border: &[u32], runs: &mut Vec<Run>) {
    let rows = padded(pivots.len());
    let (first, mut place) = (runs.len(), 0);
    for (from, &rank) in child.iter().enumerate() {
        let to = if (rank as usize) < pivots.end {
            rank as usize - pivots.start
        } else {
            place += border[place..].iter().take_while(|&&other| other < rank).count();
            rows + place
        };
        match runs[first..].last_mut() {
            Some(run) if (run.to + run.length) as usize == to && to != rows => run.length += 1,
            _ => runs.push(Run { from: from as u32, to: to as u32, length: 1 }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_come_later_and_are_in_the_parent() {
        for (nx, ny) in [(1, 50), (7, 5), (40, 3), (33, 64)] {
            let dissection = Dissection::new(nx, ny);
            let mut structure = Structure::full(&dissection, nx, ny);
            // A wall through which nothing is linked, and a row that is not linked at all.
            let is_alone = |node: usize| node / nx == ny / 3 || node % nx == nx / 2;
            for walled in [false, true] {
                if walled {
                    let offsets = structure.offsets;
                    structure.update(&dissection, |node, slot| {
                        let (i, j) = (node % nx, node / nx);
                        let other = node.wrapping_add_signed(offsets[slot + 1]);
                        let is_inside = [i + 1 < nx, i > 0, j + 1 < ny, j > 0][slot];
                        is_inside && !is_alone(node) && !is_alone(other)
                    });
                }
                let mut end = 0;
                for (piece, front) in dissection.pieces.iter().zip(&structure.fronts) {
                    assert_eq!(front.pivots.start, end);
                    end = front.pivots.end;
                    assert!(structure.borders[front.border.clone()].iter().all(|&rank| rank as usize >= end));
                    for child in piece.halves.into_iter().flatten() {
                        let child = &structure.fronts[child];
                        let covered: u32 = structure.runs(child).iter().map(|run| run.length).sum();
                        assert_eq!(covered as usize, child.border.len());
                    }
                }
                assert_eq!(end, structure.nodes.len());
                assert!(structure.fronts.last().is_some_and(|root| root.border.is_empty()));
            }
        }
    }
}
