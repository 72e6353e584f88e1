//! The surfaces of one contact on several meshes.

use crate::grid::Grid;
use crate::sim::contact::setup;
use crate::sim::error::SimError;
use crate::sim::scene::Scene;
use crate::surface::Heights;

/// Heights of ball and disc on their own cells, and their Fourier series at the nodes of any other mesh of
/// the same box. No wave is added or removed: coarse and fine nodes sample the same surface.
#[derive(Debug)]
pub(in crate::sim) struct Surfaces {
    /// Ball and disc on their own cells.
    bodies: [Heights; 2],
}

impl Surfaces {
    /// The surfaces of `scene` on `grid`.
    pub(in crate::sim) fn new(scene: &Scene, grid: &Grid) -> Result<Self, SimError> {
        let of = |roughness, name| -> Result<Heights, SimError> {
            let heights = setup::heights(roughness, grid, name)?.heights;
            Ok(Heights::new(grid.nx(), grid.ny(), None, heights, None)?)
        };
        Ok(Self { bodies: [of(&scene.roughness.ball, "ball")?, of(&scene.roughness.disc, "disc")?] })
    }

    /// Heights on `grid`, which covers the same box.
    pub(in crate::sim) fn on(&self, grid: &Grid) -> Result<[Vec<f64>; 2], SimError> {
        let [ball, disc] = &self.bodies;
        let of = |body: &Heights| -> Result<Vec<f64>, SimError> {
            if body.heights().iter().all(|height| *height == 0.0) {
                return Ok(vec![0.0; grid.len()]);
            }
            series_at_nodes(body, grid.nx(), grid.ny())
        };
        Ok([of(ball)?, of(disc)?])
    }
}

/// The Fourier series of `body` at the centers of `nx` x `ny` cells. For fewer cells than its own, the middle
/// ones of three along each axis of a mesh that resolves all waves are taken.
pub(in crate::sim) fn series_at_nodes(body: &Heights, nx: usize, ny: usize) -> Result<Vec<f64>, SimError> {
    let parts = |cells: usize, holding: usize| if cells < holding { 3 } else { 1 };
    let (along_x, along_y) = (parts(nx, body.nx()), parts(ny, body.ny()));
    let fine = body.resample_fourier(along_x * nx, along_y * ny)?;
    let rows = fine.heights().chunks_exact(along_x * nx).skip(along_y / 2).step_by(along_y);
    Ok(rows.flat_map(|row| row.iter().skip(along_x / 2).step_by(along_x).copied()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fourier_series_has_equal_heights_on_all_meshes() {
        // Two waves; eight cells resolve only one of them.
        let height = |x: f64, y: f64| (6.0 * x + 0.3).cos() + 0.5 * (2.0 * (x - y)).sin();
        let on = |nx: usize, ny: usize| -> Vec<f64> {
            let centre = |i: usize, n: usize| std::f64::consts::TAU * (i as f64 + 0.5) / n as f64;
            (0..nx * ny).map(|k| height(centre(k % nx, nx), centre(k / nx, ny))).collect()
        };
        let body = Heights::new(16, 14, None, on(16, 14), None).unwrap();
        for (nx, ny) in [(8, 7), (16, 14), (32, 28), (9, 20)] {
            for (found, expected) in series_at_nodes(&body, nx, ny).unwrap().iter().zip(on(nx, ny)) {
                assert!((found - expected).abs() < 1e-12, "{nx} x {ny}: {found} {expected}");
            }
        }
    }
}
