//! Symbolic factorization: the nodes of each front for the sparsity pattern of a matrix.
//!
//! Nodes are numbered by *rank*, the number of coupled nodes eliminated before them. Decoupled nodes, whose
//! row and column are diagonal, belong to no front. The border of a front holds the ranks that its
//! elimination couples: later neighbors of its pivots, and the borders of its children less its own pivots.

use std::ops::Range;

use super::dense::padded;
use super::dissection::Dissection;
use super::periodicity::Neighbors;
use super::real::Real;
use super::{Matrix, STENCIL};

/// Rank of a decoupled node.
pub(super) const DECOUPLED: u32 = u32::MAX;

/// The coupled nodes of a supernode, and the later nodes that their elimination couples.
#[derive(Debug, Clone, Default)]
pub(super) struct Front {
    /// Ranks of the pivots.
    pub(super) pivots: Range<usize>,
    /// Range of the border ranks in [`Structure::borders`], ascending.
    border: Range<usize>,
    /// Range of the entries between pivots and border in [`Structure::edges`].
    edges: Range<usize>,
    /// Range of [`Structure::index_ranges`] that maps the border of the front to its parent.
    index_ranges: Range<usize>,
    /// Whether the supernode is a leaf.
    pub(super) is_leaf: bool,
    /// Offsets of the front's values in the factors and in the vectors of all fronts.
    pub(super) factors_at: usize,
    pub(super) vectors_at: usize,
}

/// Matrix entries that couple a pivot and a border node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// Row of the pivot in its block.
    pub(super) pivot: u32,
    /// Position of the border node in the border.
    pub(super) border: u32,
    /// Index of the stencil entry in the row of the pivot.
    pub(super) of_pivot: u32,
    /// Index of the stencil entry in the row of the border node.
    pub(super) of_border: u32,
}

/// Consecutive border nodes of a child that are also consecutive in its parent.
#[derive(Debug, Clone, Copy)]
pub(super) struct IndexRange {
    /// Position of the first node in the border of the child.
    pub(super) from: u32,
    /// Its row in the parent: pivots, padded to whole vectors, then border.
    pub(super) to: u32,
    /// Number of nodes.
    pub(super) length: u32,
}

/// Fronts of a matrix.
#[derive(Debug, Default)]
pub(super) struct Structure {
    /// Fronts in the order of the supernodes.
    pub(super) fronts: Vec<Front>,
    /// Rank of each node, [`DECOUPLED`] for decoupled ones.
    pub(super) rank: Vec<u32>,
    /// Node of each rank.
    pub(super) nodes: Vec<u32>,
    /// Borders, edges and index ranges of all fronts.
    borders: Vec<u32>,
    edges: Vec<Edge>,
    index_ranges: Vec<IndexRange>,
    /// Workspace of the merge of borders.
    merged: [Vec<u32>; 2],
    /// The stencil of each node.
    pub(super) neighbors: Neighbors,
    /// Total lengths of factors and vectors.
    pub(super) factors: usize,
    pub(super) vectors: usize,
}

impl Front {
    /// Whether the front has neither pivots nor border.
    pub(super) fn is_empty(&self) -> bool {
        self.size() == [0, 0]
    }

    /// Number of pivots and of border nodes.
    pub(super) fn size(&self) -> [usize; 2] {
        [self.pivots.len(), self.border.len()]
    }

    /// Padded number of pivot rows.
    pub(super) fn pivot_rows(&self) -> usize {
        padded(self.pivots.len())
    }

    /// Padded number of border rows.
    pub(super) fn border_rows(&self) -> usize {
        padded(self.border.len())
    }
}

impl IndexRange {
    /// Rows in the parent.
    pub(super) fn rows(&self) -> Range<usize> {
        self.to as usize..(self.to + self.length) as usize
    }
}

impl Structure {
    /// Structure of a matrix that couples all neighbors, which bounds the memory of all others.
    pub(super) fn full(dissection: &Dissection, neighbors: Neighbors) -> Self {
        let mut structure = Self { neighbors, ..Self::default() };
        structure.update(dissection, |node, side| neighbors.has(node, side));
        let most = structure.borders.len();
        structure.index_ranges.reserve(most.saturating_sub(structure.index_ranges.len()));
        structure
    }

    /// Updates the structure for a new sparsity pattern. `is_coupled` states whether a node and its neighbor
    /// to the east, west, north or south (0 to 3) are coupled by a non-zero entry in either row.
    pub(super) fn update(&mut self, dissection: &Dissection, is_coupled: impl Fn(usize, usize) -> bool) {
        self.rank.resize(dissection.order.len(), DECOUPLED);
        self.fronts.resize(dissection.supernodes.len(), Front::default());
        self.nodes.clear();
        self.borders.clear();
        self.edges.clear();
        self.index_ranges.clear();
        (self.factors, self.vectors) = (0, 0);
        // ranks of the coupled nodes
        for (supernode, front) in dissection.supernodes.iter().zip(&mut self.fronts) {
            let first = self.nodes.len();
            for &node in &dissection.order[supernode.positions.clone()] {
                let has_coupling = (0..4).any(|slot| is_coupled(node as usize, slot));
                self.rank[node as usize] = if has_coupling { self.nodes.len() as u32 } else { DECOUPLED };
                if has_coupling {
                    self.nodes.push(node);
                }
            }
            front.pivots = first..self.nodes.len();
            front.is_leaf = supernode.children.is_none();
        }
        // borders, from the leaves to the root
        for (number, supernode) in dissection.supernodes.iter().enumerate() {
            self.collect_edges(number, &is_coupled);
            self.compute_border(number, supernode.children);
            let front = &mut self.fronts[number];
            (front.factors_at, front.vectors_at) = (self.factors, self.vectors);
            self.factors += front.factors();
            self.vectors += front.pivot_rows() + front.border_rows();
        }
    }

    /// Collects the entries between the pivots of a front and later nodes; border positions hold ranks for
    /// now.
    fn collect_edges(&mut self, number: usize, is_coupled: impl Fn(usize, usize) -> bool) {
        let pivots = self.fronts[number].pivots.clone();
        let from = self.edges.len();
        for (pivot, &node) in self.nodes[pivots.clone()].iter().enumerate() {
            let node = node as usize;
            for slot in (0..4).filter(|&slot| is_coupled(node, slot)) {
                let other = self.neighbors.at(node, slot + 1);
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

    /// Computes the border of a front, the border positions of its edges, and the index ranges of its
    /// children.
    fn compute_border(&mut self, number: usize, children: Option<[usize; 2]>) {
        let Self { fronts, borders, edges, index_ranges, merged: [of_children, of_edges], .. } = self;
        let front = &fronts[number];
        let (pivots, edges) = (front.pivots.clone(), &mut edges[front.edges.clone()]);
        let later = |child: usize| {
            let border = &borders[fronts[child].border.clone()];
            &border[border.partition_point(|&rank| (rank as usize) < pivots.end)..]
        };
        // union of the children's borders and of the pivots' later neighbors
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
        // ranks of the edges become positions in the border
        let mut place = 0;
        for edge in edges {
            place += border[place..].iter().take_while(|&&rank| rank < edge.border).count();
            edge.border = place as u32;
        }
        for child in children.into_iter().flatten() {
            let first_range = index_ranges.len();
            append_index_ranges(&borders[fronts[child].border.clone()], &pivots, border, index_ranges);
            fronts[child].index_ranges = first_range..index_ranges.len();
        }
        fronts[number].border = from..borders.len();
    }

    /// Adds the matrix entries among the pivots of a front to their block: in a ring of two nodes the neighbors of
    /// a node on both sides are one node.
    #[inline(always)]
    pub(super) fn place_entries<T: Real>(&self, front: &Front, matrix: Matrix<'_, T>, block: &mut [T]) {
        let (pivots, rows) = (front.pivots.clone(), front.pivot_rows());
        for (row, &node) in self.nodes[pivots.clone()].iter().enumerate() {
            let node = node as usize;
            for slot in 0..STENCIL {
                let entry = matrix.entry(STENCIL * node + slot);
                let other = self.neighbors.at(node, slot);
                let column = self.rank.get(other).map_or(DECOUPLED, |rank| *rank) as usize;
                if entry != T::zero() && pivots.contains(&column) {
                    block[(column - pivots.start) * rows + row] += entry;
                }
            }
        }
    }

    /// The entries between pivots and border of a front. A leaf has one for each border node, in their order.
    pub(super) fn edges(&self, front: &Front) -> &[Edge] {
        &self.edges[front.edges.clone()]
    }

    /// Map of the border of a front to its parent.
    pub(super) fn index_ranges(&self, front: &Front) -> &[IndexRange] {
        &self.index_ranges[front.index_ranges.clone()]
    }
}

/// Appends the union of two ascending lists of ranks to `out`.
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

/// Appends the index ranges of a child, whose ranks are among the `pivots` or in the `border` of its parent.
fn append_index_ranges(
    child: &[u32],
    pivots: &Range<usize>,
    border: &[u32],
    index_ranges: &mut Vec<IndexRange>,
) {
    let rows = padded(pivots.len());
    let (first, mut place) = (index_ranges.len(), 0);
    for (from, &rank) in child.iter().enumerate() {
        let to = if (rank as usize) < pivots.end {
            rank as usize - pivots.start
        } else {
            place += border[place..].iter().take_while(|&&other| other < rank).count();
            rows + place
        };
        match index_ranges[first..].last_mut() {
            Some(range) if (range.to + range.length) as usize == to && to != rows => range.length += 1,
            _ => index_ranges.push(IndexRange { from: from as u32, to: to as u32, length: 1 }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::periodicity::Periodicity;
    use super::*;

    #[test]
    fn borders_come_later_and_are_in_the_parent() {
        let shapes = [(1, 50), (7, 5), (40, 3), (33, 64), (9, 70), (2, 30)];
        for ((nx, ny), periodicity) in
            shapes.into_iter().flat_map(|shape| Periodicity::ALL.map(|p| (shape, p)))
        {
            let neighbors = Neighbors::new(nx, ny, periodicity);
            let dissection = Dissection::new(nx, ny, periodicity);
            let mut structure = Structure::full(&dissection, neighbors);
            // A wall of decoupled edges, and a row of decoupled nodes.
            let is_alone = |node: usize| node / nx == ny / 3 || node % nx == nx / 2;
            for walled in [false, true] {
                if walled {
                    structure.update(&dissection, |node, side| {
                        let other = neighbors.at(node, side + 1);
                        neighbors.has(node, side) && !is_alone(node) && !is_alone(other)
                    });
                }
                let mut end = 0;
                for (supernode, front) in dissection.supernodes.iter().zip(&structure.fronts) {
                    assert_eq!(front.pivots.start, end);
                    end = front.pivots.end;
                    assert!(structure.borders[front.border.clone()].iter().all(|&rank| rank as usize >= end));
                    for child in supernode.children.into_iter().flatten() {
                        let child = &structure.fronts[child];
                        let covered: u32 =
                            structure.index_ranges(child).iter().map(|range| range.length).sum();
                        assert_eq!(covered as usize, child.border.len());
                    }
                }
                assert_eq!(end, structure.nodes.len());
                assert!(structure.fronts.last().is_some_and(|root| root.border.is_empty()));
            }
        }
    }
}
