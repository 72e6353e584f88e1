//! The surfaces of one contact on several meshes.

use crate::grid::Grid;
use crate::sim::contact::setup;
use crate::sim::error::SimError;
use crate::sim::scene::{Roughness, Scene};
use crate::surface::series_at_nodes;

/// Heights of ball and disc on their own cells, and their Fourier series at the nodes of any other mesh of
/// the same box. No wave is added or removed: coarse and fine nodes sample the same surface.
#[derive(Debug)]
pub(in crate::sim) struct Surfaces {
    /// Heights of ball and disc.
    bodies: [Vec<f64>; 2],
    /// Their cells along x and y.
    cells: [[usize; 2]; 2],
}

impl Surfaces {
    /// The surfaces of `scene` on `grid`, or on the cells on which their heights are drawn.
    pub(in crate::sim) fn new(scene: &Scene, grid: &Grid) -> Result<Self, SimError> {
        let of = |roughness: &Roughness, name: &str| -> Result<(Vec<f64>, [usize; 2]), SimError> {
            let grid = setup::own_mesh(roughness, grid, name)?;
            Ok((setup::heights(roughness, &grid, name)?.heights, [grid.nx(), grid.ny()]))
        };
        let (ball, of_ball) = of(&scene.roughness.ball, "ball")?;
        let (disc, of_disc) = of(&scene.roughness.disc, "disc")?;
        Ok(Self { bodies: [ball, disc], cells: [of_ball, of_disc] })
    }

    /// Heights on `grid`, which covers the same box.
    pub(in crate::sim) fn on(&self, grid: &Grid) -> Result<[Vec<f64>; 2], SimError> {
        let of = |heights: &[f64], cells| -> Result<Vec<f64>, SimError> {
            if heights.iter().all(|height| *height == 0.0) {
                return Ok(vec![0.0; grid.len()]);
            }
            Ok(series_at_nodes(heights, cells, [grid.nx(), grid.ny()])?)
        };
        let [ball, disc] = &self.bodies;
        Ok([of(ball, self.cells[0])?, of(disc, self.cells[1])?])
    }
}
