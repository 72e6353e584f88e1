//! Step length control.

use crate::error::InputError;
use crate::with_fields::with_fields;

/// Bounds of a step. One contact solve represents the whole step, so the surfaces must not change much in it.
///
/// ```
/// use stribeck::sim::StepControl;
/// // At most a minute, less if wear or growth is fast.
/// StepControl::new(60.0, 3e-9).validate()?;
/// assert!(StepControl::new(0.0, 3e-9).validate().is_err());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct StepControl {
    /// Longest step \[s\].
    pub longest: f64,
    /// Largest change of wear or tribofilm at any node of either body in a step \[m\]; infinite for no bound.
    /// Plastic depth is not counted: it depends on the step length only where a step is less than one passage.
    pub depth: f64,
}

with_fields!(StepControl { with_longest longest: f64, with_depth depth: f64 });

impl StepControl {
    /// Steps of at most `longest` \[s\] in which no node changes by more than `depth` \[m\].
    pub const fn new(longest: f64, depth: f64) -> Self {
        Self { longest, depth }
    }

    /// Steps of one length \[s\].
    pub fn fixed(time_step: f64) -> Self {
        Self { longest: time_step, depth: f64::INFINITY }
    }

    /// Checks both bounds.
    ///
    /// # Errors
    /// A longest step that is not finite and positive, a depth that is not positive.
    pub fn validate(&self) -> Result<(), InputError> {
        InputError::require_positive("time_step", self.longest)?;
        InputError::require(self.depth > 0.0, "depth", self.depth, "> 0")
    }
}
