//! Many steps in a row, seen by an observer.
//!
//! A fixed number of steps of one length, or steps that are as long as wear and growth allow up to a time.
//! Each step is committed before the observer sees it; what stops a run early leaves the steps before it.

use std::ops::ControlFlow;

use super::SimError;
use super::observer::Observer;
use super::simulation::MixedLubricationSim;
use super::step_control::StepControl;
use crate::error::InputError;

/// How a run ended.
///
/// # Examples
///
/// ```
/// use std::ops::ControlFlow;
/// use stribeck::sim::{MixedLubricationSim, RunEnd, Scene, StepControl, StepRecord};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build()?;
/// let mut go_on = |_: &MixedLubricationSim, _: &StepRecord| ControlFlow::Continue(());
/// assert_eq!(sim.run_until(25.0, &StepControl::fixed(10.0), &mut go_on)?, RunEnd::Finished);
/// assert_eq!((sim.steps(), sim.time()), (3, 25.0)); // the last step is shorter
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunEnd {
    /// All steps were taken.
    Finished,
    /// The observer stopped the run.
    Stopped,
}

impl MixedLubricationSim {
    /// Takes `steps` steps of `time_step` \[s\]; `observer` sees each and may stop the run.
    ///
    /// # Errors
    /// See [`MixedLubricationSim::step`]; the steps before are committed.
    pub fn run(
        &mut self,
        steps: u64,
        time_step: f64,
        observer: &mut impl Observer,
    ) -> Result<RunEnd, SimError> {
        for _ in 0..steps {
            let record = self.step(time_step)?;
            if observer.after_step(self, &record) == ControlFlow::Break(()) {
                return Ok(RunEnd::Stopped);
            }
        }
        Ok(RunEnd::Finished)
    }

    /// Steps until the time `end` \[s\], each as long as `control` allows and none across an entry of a
    /// schedule; `observer` sees each and may stop the run.
    ///
    /// # Errors
    /// See [`MixedLubricationSim::step_within`]; the steps before are committed.
    pub fn run_until(
        &mut self,
        end: f64,
        control: &StepControl,
        observer: &mut impl Observer,
    ) -> Result<RunEnd, SimError> {
        InputError::require(end.is_finite(), "end", end, "finite")?;
        InputError::require(end >= self.time, "end", end, "the time of the simulation or later")?;
        control.validate()?;
        // What rounding leaves of the last step is none.
        while end - self.time > 1e-9 * control.longest {
            let mut left = end - self.time;
            if let Some(entry) = self.timetable.next_entry(self.time) {
                left = left.min(entry - self.time);
            }
            let record = self.step_within(&StepControl { longest: control.longest.min(left), ..*control })?;
            if observer.after_step(self, &record) == ControlFlow::Break(()) {
                return Ok(RunEnd::Stopped);
            }
        }
        Ok(RunEnd::Finished)
    }
}
