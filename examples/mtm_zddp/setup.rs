//! From the options to the two simulations.

use std::path::Path;

use stribeck::sim::scene::{Flash, Roughness};
use stribeck::sim::{MixedLubricationSim, Scene, SimError};
use stribeck::{Grid, InputError, surface};

use crate::options::Options;

/// Bound of every residual of a solve: mass, load and complementarity. One solve stands for hundreds of
/// passages at one position of the roughness, and columns scatter by some 10 % from one position to the next.
const TOLERANCE: f64 = 1e-3;

/// The simulations with and without tribofilm; all else is the same, roughness and its motion included.
pub(crate) fn pair(options: &Options) -> Result<[MixedLubricationSim; 2], SimError> {
    let scene = scene(options);
    let grid = scene.grid()?;
    let disc = options.surface.as_deref().map(|path| disc_heights(path, &grid)).transpose()?;
    let build = |scene: Scene| {
        let builder = MixedLubricationSim::builder(scene);
        match &disc {
            Some(heights) => builder.disc_heights(heights.clone()).build(),
            None => builder.build(),
        }
    };
    Ok([build(scene.clone().with_tribofilm())?, build(scene)?])
}

fn scene(options: &Options) -> Scene {
    let mut scene = Scene::azam_2019(options.grid);
    // Below a kelvin and negligible, but then the history can say so.
    scene.thermal.flash = Flash::On;
    scene.solver.tolerance = TOLERANCE;
    scene.track.seed = options.seed;
    // Seed 1 gives the scene's own surfaces.
    let disc_seed = options.seed.wrapping_mul(2);
    let seeds = [disc_seed.wrapping_sub(1), disc_seed];
    for (roughness, value) in [&mut scene.roughness.ball, &mut scene.roughness.disc].into_iter().zip(seeds) {
        if let Roughness::Random(random) = roughness {
            random.seed = value;
        }
    }
    scene
}

/// The measured surface in `path` on `grid` \[m\]: levelled and resampled where the file says how far apart
/// its points are, else node by node.
fn disc_heights(path: &Path, grid: &Grid) -> Result<Vec<f64>, SimError> {
    let measured = surface::read(path)?;
    if measured.dx().is_some() {
        return Ok(measured.fit_to_grid(grid)?);
    }
    if (measured.nx(), measured.ny()) == (grid.nx(), grid.ny()) {
        return Ok(measured.heights().to_vec());
    }
    let reason = format!(
        "{} holds {} x {} heights without spacing, the grid has {} x {} nodes",
        path.display(),
        measured.nx(),
        measured.ny(),
        grid.nx(),
        grid.ny()
    );
    Err(InputError::Conflict { field: "--surface".to_owned(), reason }.into())
}
