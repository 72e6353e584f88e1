//! Watching a run.
//!
//! Files, progress bars and conditions to stop are observers; the run itself writes nothing. An observer sees
//! the simulation after the step and cannot change it.

use std::ops::ControlFlow;

use super::record::StepRecord;
use super::simulation::MixedLubricationSim;

/// Sees every committed step and may stop the run.
///
/// Closures `FnMut(&MixedLubricationSim, &StepRecord) -> ControlFlow<()>` are observers.
pub trait Observer {
    /// Called after a step was committed; [`ControlFlow::Break`] ends the run.
    fn after_step(&mut self, sim: &MixedLubricationSim, record: &StepRecord) -> ControlFlow<()>;
}

impl<F: FnMut(&MixedLubricationSim, &StepRecord) -> ControlFlow<()>> Observer for F {
    fn after_step(&mut self, sim: &MixedLubricationSim, record: &StepRecord) -> ControlFlow<()> {
        self(sim, record)
    }
}
