//! A measured surface from its file into a running contact: read, level, fit to the grid, rub.
//!
//! ```text
//! cargo run --release --example measured_surface [-- FILE]
//! ```
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

use std::error::Error;
use std::ops::ControlFlow;
use std::path::PathBuf;

use stribeck::metrics::height_statistics;
use stribeck::sim::scene::GridSpec;
use stribeck::sim::{MixedLubricationSim, Scene, StepRecord};
use stribeck::surface::{self, Form};

/// A cut out of a file of an instrument.
const SAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/surfaces/cut.x3p");

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map_or_else(|| PathBuf::from(SAMPLE), PathBuf::from);
    let measured = surface::read(&path)?;
    let (Some(dx), Some(dy)) = (measured.dx(), measured.dy()) else {
        return Err("the file does not say how far apart its points are".into());
    };
    let (nx, ny) = (measured.nx(), measured.ny());
    println!(
        "{nx} x {ny} points, {:.3} x {:.3} um apart, {} undefined",
        1e6 * dx,
        1e6 * dy,
        measured.undefined()
    );

    // A small ball: a patch of the size of its contact was measured, not one of the size of a large one.
    let mut scene = Scene::azam_2019(64).with_tribofilm();
    scene.form = Form::Sphere { radius: 1e-3 };
    scene.load.hertz_pressure = Some(0.8e9);
    let a = scene.hertz()?.half_width_x;
    scene.grid = GridSpec::Cells { nx: 64, ny: 64, x: [-2.0 * a, 2.0 * a], y: [-2.0 * a, 2.0 * a] };
    scene.solver.tolerance = 1e-3;

    // Levelled, holes filled, mirrored until it fills the box. Its own height may be anything: here a
    // fine-ground one.
    let mut heights = measured.fit_to_grid(&scene.grid()?)?;
    let sq = height_statistics(&heights)?.sq;
    println!("Sq {:.1} nm as measured, scaled to 50 nm", 1e9 * sq);
    heights.iter_mut().for_each(|height| *height *= 50e-9 / sq);

    let mut sim = MixedLubricationSim::builder(scene).disc_heights(heights).build()?;
    println!(
        "{:>8} {:>9} {:>11} {:>13} {:>10}",
        "time, s", "lambda", "load ratio", "disc Sq, nm", "film, nm"
    );
    sim.run(6, 60.0, &mut |_: &MixedLubricationSim, step: &StepRecord| {
        println!(
            "{:8.0} {:9.3} {:11.3} {:13.2} {:10.2}",
            step.time,
            step.film.lambda.unwrap_or(f64::NAN),
            step.contact.load_ratio,
            1e9 * step.roughness.disc_rq,
            1e9 * step.tribofilm.disc_mean
        );
        ControlFlow::Continue(())
    })?;
    assert!(sim.ledger_residual()? < 1e-20, "every nanometre is accounted for");
    Ok(())
}
