//! Reasons for the early end of a cycle.

use std::fmt;

use crate::sim::error::BoxTooSmall;

/// Reason for the early end of a cycle; the contacts before it are kept.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum CycleEnd {
    /// The observer stopped the cycle.
    Stopped,
    /// A contact did not converge, at shorter steps either.
    NotConverged {
        /// Time of the contact in the cycle \[s\].
        time: f64,
        /// Whether the surfaces entrain no oil at this time: the film drains and solids carry.
        is_at_rest: bool,
        /// Status and residuals of the solve.
        reason: String,
    },
    /// Solids, wear or a tribofilm reach the edge of the box.
    BoxTooSmall {
        /// Time of the contact in the cycle \[s\].
        time: f64,
        /// The edge, and a wider box.
        reason: BoxTooSmall,
    },
}

impl fmt::Display for CycleEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stopped => write!(f, "stopped by the observer"),
            Self::BoxTooSmall { time, reason } => write!(f, "at {time:.6e} s: {reason}"),
            Self::NotConverged { time, is_at_rest, reason } => {
                write!(f, "at {time:.6e} s: {reason}")?;
                if *is_at_rest {
                    write!(
                        f,
                        "; the contact is at rest and its oil drains: end the rest earlier, or more cycle.steps"
                    )?;
                }
                Ok(())
            }
        }
    }
}
