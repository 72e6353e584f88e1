//! Limits of one solve.

use crate::error::InputError;
use crate::with_fields::with_fields;

/// Limits of seconds and convolutions for one case. Both are checked at each displacement. A contestant that
/// computes none is given up after twice the seconds and one more; its thread is left running until the process
/// ends.
///
/// ```
/// use stribeck::benchmark::Budget;
/// let budget = Budget::default().with_seconds(60.0).with_convolutions(5000.0);
/// assert!(budget.validate().is_ok());
/// assert!(budget.with_seconds(0.0).validate().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Budget {
    /// Time on the clock \[s\]; infinite for no limit. Default 600.
    pub seconds: f64,
    /// Displacements in equivalents of the grid of the case, without approximations; infinite for no limit, the
    /// default.
    pub convolutions: f64,
}

with_fields!(Budget { with_seconds seconds: f64, with_convolutions convolutions: f64 });

impl Default for Budget {
    fn default() -> Self {
        Self { seconds: 600.0, convolutions: f64::INFINITY }
    }
}

impl Budget {
    /// No limits.
    pub fn unlimited() -> Self {
        Self { seconds: f64::INFINITY, convolutions: f64::INFINITY }
    }

    /// Checks that both limits are positive.
    ///
    /// # Errors
    /// A limit that is NaN, zero or negative.
    pub fn validate(&self) -> Result<(), InputError> {
        InputError::require(self.seconds > 0.0, "budget.seconds", self.seconds, "> 0")?;
        InputError::require(self.convolutions > 0.0, "budget.convolutions", self.convolutions, "> 0")
    }
}
