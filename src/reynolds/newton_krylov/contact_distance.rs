//! How far nodes are from solid contact.

use crate::grid::Grid;
use crate::reynolds::active_set::Kind;
use crate::reynolds::problem::inner_rows;

/// Cells from every inner node of a grid to the nearest node in contact, along the axis on which these are
/// more, at most `most`.
#[derive(Debug)]
pub(super) struct ContactDistance {
    grid: Grid,
    most: f32,
    cells: Vec<f32>,
}

impl ContactDistance {
    pub(super) fn new(grid: Grid, most: f32) -> Self {
        Self { grid, most, cells: vec![most; grid.len()] }
    }

    /// Takes the nodes in contact.
    pub(super) fn update(&mut self, kinds: &[Kind]) {
        for (cells, kind) in self.cells.iter_mut().zip(kinds) {
            *cells = if kind.is_contact() { 0.0 } else { self.most };
        }
        // Every node hears of the contact before it, then of the contact after it.
        let nx = self.grid.nx();
        let columns = 1..nx - 1;
        for j in inner_rows(&self.grid) {
            for k in columns.clone().map(|i| j * nx + i) {
                self.hear(k, [k - 1, k - nx - 1, k - nx, k - nx + 1]);
            }
        }
        for j in inner_rows(&self.grid).rev() {
            for k in columns.clone().rev().map(|i| j * nx + i) {
                self.hear(k, [k + 1, k + nx + 1, k + nx, k + nx - 1]);
            }
        }
    }

    fn hear(&mut self, k: usize, neighbours: [usize; 4]) {
        let nearest = neighbours.map(|neighbour| self.cells[neighbour]).into_iter().fold(self.most, f32::min);
        self.cells[k] = self.cells[k].min(nearest + 1.0);
    }

    /// Of inner node `k`.
    pub(super) fn at(&self, k: usize) -> f32 {
        self.cells[k]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reynolds::active_set::{Fluid, Solid};
    use crate::reynolds::problem::interior;

    #[test]
    fn distances_are_those_to_the_nearest_contact() {
        let grid = Grid::centred(17, 13, 1e-6, 1e-6).unwrap();
        let open = Kind { fluid: Fluid::Active, solid: Solid::Open };
        let mut kinds = vec![open; grid.len()];
        // One of them on the outermost nodes.
        let touching = [(3, 2), (11, 9), (16, 5), (5, 4)];
        for (i, j) in touching {
            kinds[j * grid.nx() + i].solid = Solid::Contact;
        }
        let most = 5.0;
        let mut distance = ContactDistance::new(grid, most);
        distance.update(&kinds);
        for k in interior(&grid) {
            let (i, j) = (k % grid.nx(), k / grid.nx());
            let nearest = touching.iter().map(|(a, b)| i.abs_diff(*a).max(j.abs_diff(*b))).min().unwrap();
            let expected = (nearest as f32).min(most);
            assert!((distance.at(k) - expected).abs() < 0.5, "node {i}, {j}: {}", distance.at(k));
        }
    }
}
