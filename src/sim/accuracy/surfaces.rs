//! The surfaces of one contact on several meshes.

use crate::grid::Grid;
use crate::sim::scene::Scene;
use crate::sim::{SimError, setup};
use crate::surface::Heights;

/// Heights of ball and disc on the cells that hold them, and by their Fourier series on any others of the same box: the same
/// waves on every mesh that resolves them, the others are left out.
#[derive(Debug)]
pub(super) struct Surfaces {
    bodies: [Heights; 2],
}

impl Surfaces {
    /// Those of `scene` on `grid`.
    pub(super) fn new(scene: &Scene, grid: &Grid) -> Result<Self, SimError> {
        let of = |roughness, name| -> Result<Heights, SimError> {
            let heights = setup::heights(roughness, grid, name)?;
            Ok(Heights::new(grid.nx(), grid.ny(), None, heights, None)?)
        };
        Ok(Self { bodies: [of(&scene.roughness.ball, "ball")?, of(&scene.roughness.disc, "disc")?] })
    }

    /// Heights on `grid`, which fills the same box.
    pub(super) fn on(&self, grid: &Grid) -> Result<[Vec<f64>; 2], SimError> {
        let [ball, disc] = &self.bodies;
        let of = |body: &Heights| -> Result<Vec<f64>, SimError> {
            if body.heights().iter().all(|height| *height == 0.0) {
                return Ok(vec![0.0; grid.len()]);
            }
            Ok(body.resample_fourier(grid.nx(), grid.ny())?.heights().to_vec())
        };
        Ok([of(ball)?, of(disc)?])
    }
}
