//! Where a window lies in the whole grid.

use crate::grid::Grid;
use crate::reynolds::flow::MARGIN;

/// The place of a window of fixed size. On a strip a window may reach across the last row into the first.
#[derive(Debug, Clone, Copy)]
pub(super) struct WindowPlace {
    /// Columns and rows of the window and of the whole grid.
    size: [usize; 2],
    whole: [usize; 2],
    /// Whether the whole grid repeats along each axis.
    repeats: [bool; 2],
    /// Column and row of the whole grid that are the first of the window.
    start: [usize; 2],
}

impl WindowPlace {
    /// At the first node of the `whole` grid; `window` is at most as large as it.
    pub(super) fn new(whole: &Grid, window: &Grid) -> Self {
        let repeats = [false, whole.is_strip()];
        let [whole, size] = [whole, window].map(|grid| [grid.nx(), grid.ny()]);
        Self { size, whole, repeats, start: [0, 0] }
    }

    /// Whether the window is the whole grid along an axis along which that repeats.
    fn is_ring(self, axis: usize) -> bool {
        self.repeats[axis] && self.size[axis] == self.whole[axis]
    }

    /// The place around node `k` of the whole grid, inside of it.
    pub(super) fn around(self, k: usize) -> Self {
        let Self { size, whole, .. } = self;
        let at = [k % whole[0], k / whole[0]];
        let start = std::array::from_fn(|axis| {
            let (at, whole, half) = (at[axis], whole[axis], size[axis] / 2);
            if self.repeats[axis] && !self.is_ring(axis) {
                (at + whole - half) % whole
            } else {
                at.saturating_sub(half).min(whole - size[axis])
            }
        });
        Self { start, ..self }
    }

    /// Node of the whole grid at which row `j` of the window begins.
    pub(super) fn row_start(self, j: usize) -> usize {
        let row = self.start[1] + j;
        // Only on a strip does a window reach across the last row.
        let row = if row < self.whole[1] { row } else { row - self.whole[1] };
        self.start[0] + row * self.whole[0]
    }

    /// Node of the whole grid that node `q` of the window is.
    pub(super) fn node(self, q: usize) -> usize {
        self.row_start(q / self.size[0]) + q % self.size[0]
    }

    /// Whether the balance of node `q` of the window depends on nodes of the window alone.
    pub(super) fn is_core(self, q: usize) -> bool {
        let at = [q % self.size[0], q / self.size[0]];
        (0..2).all(|axis| {
            let (i, n) = (at[axis], self.size[axis]);
            n == 1 || self.is_ring(axis) || (i >= MARGIN && i + MARGIN < n)
        })
    }

    /// Whether node `k` of the whole grid is in the core of the window.
    pub(super) fn solves_for(self, k: usize) -> bool {
        let at = [k % self.whole[0], k / self.whole[0]];
        // Column and row of the node in the window, which no window has in front of its start.
        let inside: [usize; 2] = std::array::from_fn(|axis| {
            let (at, start) = (at[axis], self.start[axis]);
            if at >= start {
                at - start
            } else if self.repeats[axis] {
                at + self.whole[axis] - start
            } else {
                usize::MAX
            }
        });
        (0..2).all(|axis| inside[axis] < self.size[axis])
            && self.is_core(inside[0] + inside[1] * self.size[0])
    }

    /// Whether two windows of one size have common nodes.
    pub(super) fn overlaps(self, other: Self) -> bool {
        (0..2).all(|axis| {
            let distance = self.start[axis].abs_diff(other.start[axis]);
            let around = if self.repeats[axis] { self.whole[axis] - distance } else { distance };
            distance.min(around) < self.size[axis]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn window_solves_for_its_core_and_overlaps_others_with_common_nodes() {
        let edges = [0.0, 1.0];
        let strip = Grid::strip(50, 40, edges, edges).unwrap();
        for whole in [Grid::from_edges(50, 40, edges, edges).unwrap(), strip] {
            check_windows(&whole);
        }
    }

    fn check_windows(whole: &Grid) {
        let place = WindowPlace::new(whole, &whole.corner(20, 20));
        for k in [0, 49, 20 * 50 + 25, 39 * 50, 39 * 50 + 49] {
            let window = place.around(k);
            let nodes: Vec<usize> = (0..400).map(|q| window.node(q)).collect();
            assert!(nodes.contains(&k), "node {k}");
            for other in 0..2000 {
                let in_core = (0..400).any(|q| nodes[q] == other && window.is_core(q));
                assert_eq!(window.solves_for(other), in_core, "{k} {other}");
                let second = place.around(other);
                let common = (0..400).any(|q| nodes.contains(&second.node(q)));
                assert_eq!(window.overlaps(second), common, "{k} {other}");
            }
        }
    }

    #[test]
    fn window_of_all_rows_of_a_strip_solves_for_all_of_them() {
        let whole = Grid::strip(50, 8, [0.0, 1.0], [0.0, 1.0]).unwrap();
        let window = whole.corner(20, 8);
        assert!(window.is_strip());
        let place = WindowPlace::new(&whole, &window).around(7 * 50 + 25);
        assert!((0..8).all(|j| place.solves_for(j * 50 + 25)));
        assert!((0..160).all(|q| place.node(q) / 50 == q / 20), "rows are those of the strip");
    }
}
