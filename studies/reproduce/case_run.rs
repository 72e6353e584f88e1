//! The history of a case with one seed.

use std::path::PathBuf;

use stribeck::Grid;
use stribeck::sim::scene::Roughness;
use stribeck::sim::{MixedLubricationSim, SimError};
use stribeck::surface::Heights;

use crate::cases::Case;
use crate::options::Options;

/// One history.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run {
    pub(crate) case: Case,
    pub(crate) seed: u64,
    pub(crate) film: bool,
    pub(crate) time_step: f64,
}

impl Run {
    /// Its folder.
    pub(crate) fn folder(&self, options: &Options) -> PathBuf {
        let film = if self.film { "with" } else { "without" };
        options.out.join(format!("{}_seed{}_{film}", self.case.name, self.seed))
    }

    /// The simulation at its start. Roughness is made on the grid of the variant and brought to a finer one
    /// by its Fourier series.
    pub(crate) fn build(&self) -> Result<MixedLubricationSim, SimError> {
        let scene = self.case.scene(self.seed, self.film);
        let [ball, disc] = [self.heights(&scene.roughness.ball)?, self.heights(&scene.roughness.disc)?];
        MixedLubricationSim::builder(scene).ball_heights(ball).disc_heights(disc).build()
    }

    fn heights(&self, roughness: &Roughness) -> Result<Vec<f64>, SimError> {
        let (n, half) = (self.case.surface_cells, 0.5 * self.case.side);
        let grid = Grid::from_edges(n, n, [-half, half], [-half, half])?;
        let Roughness::Random(random) = roughness else {
            return Ok(vec![0.0; self.case.cells * self.case.cells]);
        };
        let surface = Heights::new(n, n, Some([grid.dx(), grid.dy()]), random.generate(&grid)?, None)?;
        Ok(surface.resample_fourier(self.case.cells, self.case.cells)?.heights().to_vec())
    }
}
