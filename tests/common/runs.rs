//! Histories and cycles from their first to their last contact.

use std::ops::ControlFlow;

use stribeck::sim::{CycleSolution, MixedLubricationSim, Scene, StepRecord};

/// The simulation after so many steps of `time_step` \[s\], and their records.
pub(crate) fn run(scene: Scene, steps: u64, time_step: f64) -> (MixedLubricationSim, Vec<StepRecord>) {
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    let mut records = Vec::new();
    sim.run(steps, time_step, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        records.push(record.clone());
        ControlFlow::Continue(())
    })
    .unwrap();
    (sim, records)
}

/// The cycle of `scene`, which has all its contacts.
pub(crate) fn cycle(scene: Scene) -> CycleSolution {
    let solution = MixedLubricationSim::builder(scene).solve_cycle(&mut |_| true).unwrap();
    assert_eq!(solution.ended_early, None);
    solution
}
