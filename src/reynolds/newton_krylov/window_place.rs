//! Where a window lies in the whole grid.

use crate::grid::Grid;
use crate::reynolds::flow::MARGIN;

/// The place of a window of fixed size.
#[derive(Debug, Clone, Copy)]
pub(super) struct WindowPlace {
    /// Columns and rows of the window and of the whole grid.
    size: [usize; 2],
    whole: [usize; 2],
    /// Column and row of the whole grid that are the first of the window.
    start: [usize; 2],
}

impl WindowPlace {
    /// At the first node of the `whole` grid; `window` is at most as large as it.
    pub(super) fn new(whole: &Grid, window: &Grid) -> Self {
        let [whole, size] = [whole, window].map(|grid| [grid.nx(), grid.ny()]);
        Self { size, whole, start: [0, 0] }
    }

    /// The place around node `k` of the whole grid, inside of it.
    pub(super) fn around(self, k: usize) -> Self {
        let Self { size, whole, .. } = self;
        let at = [k % whole[0], k / whole[0]];
        let start =
            std::array::from_fn(|axis| at[axis].saturating_sub(size[axis] / 2).min(whole[axis] - size[axis]));
        Self { start, ..self }
    }

    /// Node of the whole grid that is the first node of the window.
    pub(super) fn first(self) -> usize {
        self.start[0] + self.start[1] * self.whole[0]
    }

    /// Node of the whole grid that node `q` of the window is.
    pub(super) fn node(self, q: usize) -> usize {
        self.first() + q % self.size[0] + q / self.size[0] * self.whole[0]
    }

    /// Whether the balance of node `q` of the window depends on nodes of the window alone.
    pub(super) fn is_core(self, q: usize) -> bool {
        let inside = |i: usize, n: usize| n == 1 || (i >= MARGIN && i + MARGIN < n);
        inside(q % self.size[0], self.size[0]) && inside(q / self.size[0], self.size[1])
    }

    /// Whether node `k` of the whole grid is in the core of the window.
    pub(super) fn solves_for(self, k: usize) -> bool {
        let at = [k % self.whole[0], k / self.whole[0]];
        let is_inside =
            (0..2).all(|axis| (self.start[axis]..self.start[axis] + self.size[axis]).contains(&at[axis]));
        is_inside && self.is_core(at[0] - self.start[0] + (at[1] - self.start[1]) * self.size[0])
    }

    /// Whether two windows of one size have common nodes.
    pub(super) fn overlaps(self, other: Self) -> bool {
        (0..2).all(|axis| self.start[axis].abs_diff(other.start[axis]) < self.size[axis])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn window_solves_for_its_core_and_overlaps_others_with_common_nodes() {
        let whole = Grid::centred(50, 40, 1e-6, 1e-6).unwrap();
        let place = WindowPlace::new(&whole, &whole.corner(20, 20));
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
}
