//! Many steps in sequence, with an observer.
//!
//! A run has a fixed number of equal steps, or steps as long as wear and growth allow up to a final time. Each
//! step is committed before the observer is called; the steps before an early stop are kept.

use std::ops::ControlFlow;

use crate::error::InputError;
use crate::sim::error::SimError;
use crate::sim::history::observer::Observer;
use crate::sim::history::record::StepRecord;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::history::step_control::StepControl;

/// Tolerance of the end of a run, as a fraction of a step: sums of steps are rounded.
const ROUNDING: f64 = 1e-9;
/// Requirement on a step that is not negligible against the end time.
const TOO_SHORT: &str = "longer than the rounding of the end time, else no step changes the time";

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
    /// Takes `steps` steps of `time_step` \[s\]. `observer` is called after each and may stop the run.
    ///
    /// # Errors
    /// See [`MixedLubricationSim::step`]; earlier steps remain committed.
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

    /// Takes steps until the time `end` \[s\], each as long as `control` allows and none across an entry of a
    /// schedule. `observer` is called after each and may stop the run.
    ///
    /// # Errors
    /// See [`MixedLubricationSim::step_within`]; earlier steps remain committed.
    pub fn run_until(
        &mut self,
        end: f64,
        control: &StepControl,
        observer: &mut impl Observer,
    ) -> Result<RunEnd, SimError> {
        InputError::require(end.is_finite(), "end", end, "finite")?;
        InputError::require(end >= self.time, "end", end, "the time of the simulation or later")?;
        control.validate()?;
        InputError::require(end + control.longest > end, "time_step", control.longest, TOO_SHORT)?;
        let rounding = ROUNDING * control.longest;
        while end - self.time > rounding {
            let left =
                self.operating_schedule.next_entry(self.time).map_or(end, |entry| entry.min(end)) - self.time;
            // A continued run takes the same steps as an uninterrupted one.
            let whole = left >= control.longest - rounding;
            let longest = if whole { control.longest } else { left };
            let record = self.step_within(&StepControl { longest, ..*control })?;
            if observer.after_step(self, &record) == ControlFlow::Break(()) {
                return Ok(RunEnd::Stopped);
            }
        }
        Ok(RunEnd::Finished)
    }

    /// As [`step`](Self::step). A contact that does not converge from the last one is solved again from no pressure.
    ///
    /// # Errors
    /// As of [`step`](Self::step).
    pub(in crate::sim) fn step_with_restart(&mut self, time_step: f64) -> Result<StepRecord, SimError> {
        match self.step(time_step) {
            Err(SimError::NotConverged { .. }) => {
                self.state.pressure.fill(0.0);
                self.step(time_step)
            }
            outcome => outcome,
        }
    }

    /// Number of steps that [`run_until`](Self::run_until) takes to `end` \[s\] if none is longer than `longest`
    /// \[s\] and no change of depth shortens them.
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build()?;
    /// assert_eq!(sim.steps_until(25.0, 10.0), 3);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn steps_until(&self, end: f64, longest: f64) -> u64 {
        let (mut time, mut steps) = (self.time, 0.0);
        while end - time > ROUNDING * longest {
            let next = self.operating_schedule.next_entry(time).map_or(end, |entry| entry.min(end));
            if next <= time {
                break;
            }
            steps += ((next - time) / longest - ROUNDING).ceil().max(1.0);
            time = next;
        }
        steps as u64
    }
}
