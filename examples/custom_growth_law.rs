//! A growth law of one's own: the rate is enough, the library integrates it stably in steps of any length.
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

use std::ops::ControlFlow;

use stribeck::SurfaceState;
use stribeck::sim::{MixedLubricationSim, Scene, SimError, StepRecord};
use stribeck::tribochem::FilmGrowthLaw;

/// Second-order approach to a limit, as fast as friction power is fed into the node.
#[derive(Debug)]
struct PowerDriven;

impl FilmGrowthLaw for PowerDriven {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        let left = 1.0 - thickness / self.maximum_thickness();
        4e-16 * at.shear_stress * at.sliding_speed * left * left
    }

    fn maximum_thickness(&self) -> f64 {
        150e-9
    }
}

fn main() -> Result<(), SimError> {
    let mut sim = MixedLubricationSim::builder(Scene::azam_2019(32)).growth_law(PowerDriven).build()?;
    sim.run(6, 600.0, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        println!("{:5.0} s  mean film on the disc {:6.2} nm", record.time, record.tribofilm.disc_mean * 1e9);
        ControlFlow::Continue(())
    })?;
    Ok(())
}
