//! Observers of a run.
//!
//! Files, progress bars and stop conditions are observers; the run itself writes nothing. An observer gets the
//! simulation after each step and cannot change it.

use std::ops::ControlFlow;

use crate::sim::history::record::StepRecord;
use crate::sim::history::simulation::MixedLubricationSim;

/// Called after every committed step; may stop the run.
///
/// Closures `FnMut(&MixedLubricationSim, &StepRecord) -> ControlFlow<()>` are observers.
///
/// # Examples
///
/// ```
/// use std::ops::ControlFlow;
/// use stribeck::sim::{MixedLubricationSim, Observer, RunEnd, Scene, StepRecord};
/// /// Stops the run when the disc is worn by a nanometre somewhere.
/// struct UntilWorn;
/// impl Observer for UntilWorn {
///     fn after_step(&mut self, _sim: &MixedLubricationSim, record: &StepRecord) -> ControlFlow<()> {
///         if record.wear.disc_max > 1e-9 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
///     }
/// }
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build()?;
/// assert_eq!(sim.run(1, 1e5, &mut UntilWorn)?, RunEnd::Stopped);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
pub trait Observer {
    /// Called after a step was committed; [`ControlFlow::Break`] ends the run.
    fn after_step(&mut self, sim: &MixedLubricationSim, record: &StepRecord) -> ControlFlow<()>;
}

impl<F: FnMut(&MixedLubricationSim, &StepRecord) -> ControlFlow<()>> Observer for F {
    fn after_step(&mut self, sim: &MixedLubricationSim, record: &StepRecord) -> ControlFlow<()> {
        self(sim, record)
    }
}
