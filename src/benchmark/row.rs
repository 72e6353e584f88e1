//! One result: a case, a contestant, and the outcome.

use std::fmt;
use std::str::FromStr;

use serde::Serialize;

use super::limits::Quantity;
use crate::displayed::serialize_as_displayed;
use crate::error::InputError;
use crate::report::Status;

/// Outcome of a solve after its check.
///
/// ```
/// use stribeck::benchmark::Verdict;
/// assert_eq!("falsely_converged".parse(), Ok(Verdict::FalselyConverged));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Verdict {
    /// Converged, and verified.
    Converged,
    /// See [`Status::MeshTooCoarse`].
    MeshTooCoarse,
    /// See [`Status::Stalled`].
    Stalled,
    /// See [`Status::MaxIterations`].
    MaxIterations,
    /// See [`Status::Diverged`].
    Diverged,
    /// The case has no solution, or scene or contestant rejected it.
    Refused,
    /// The contestant reported convergence, but the state that it returned is no solution.
    FalselyConverged,
    /// The budget was used up.
    OutOfBudget,
    /// The contestant did not return.
    GivenUp,
    /// The contestant panicked.
    Panicked,
    /// The returned state does not fit the grid.
    WrongGrid,
}

impl Verdict {
    /// All verdicts, in the order of tables.
    pub const ALL: [Self; 11] = [
        Self::Converged,
        Self::MeshTooCoarse,
        Self::Stalled,
        Self::MaxIterations,
        Self::Diverged,
        Self::Refused,
        Self::FalselyConverged,
        Self::OutOfBudget,
        Self::GivenUp,
        Self::Panicked,
        Self::WrongGrid,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::MeshTooCoarse => "mesh_too_coarse",
            Self::Stalled => "stalled",
            Self::MaxIterations => "max_iterations",
            Self::Diverged => "diverged",
            Self::Refused => "refused",
            Self::FalselyConverged => "falsely_converged",
            Self::OutOfBudget => "out_of_budget",
            Self::GivenUp => "given_up",
            Self::Panicked => "panicked",
            Self::WrongGrid => "wrong_grid",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

serialize_as_displayed!(Verdict);

impl FromStr for Verdict {
    type Err = InputError;

    fn from_str(name: &str) -> Result<Self, InputError> {
        let found = Self::ALL.into_iter().find(|verdict| verdict.name() == name);
        found.ok_or_else(|| InputError::Conflict {
            field: "verdict".to_owned(),
            reason: format!("`{name}` is none"),
        })
    }
}

impl From<Status> for Verdict {
    fn from(status: Status) -> Self {
        match status {
            Status::Converged => Self::Converged,
            Status::MaxIterations => Self::MaxIterations,
            Status::Stalled => Self::Stalled,
            Status::MeshTooCoarse => Self::MeshTooCoarse,
            Status::Diverged => Self::Diverged,
            Status::Unverified => Self::FalselyConverged,
        }
    }
}

/// The result of a contestant on a case, at one tolerance and mesh. Numbers without a value are NaN.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Row {
    /// Name of the case.
    pub case: String,
    /// Tags of the case.
    pub tags: Vec<String>,
    /// Varied values of the case.
    pub parameters: Vec<(String, f64)>,
    /// Name of the contestant.
    pub contestant: String,
    /// Tolerance of the residuals.
    pub tolerance: f64,
    /// Cells along x; 0 if the scene does not state them.
    pub cells: usize,
    /// Fingerprint of the scene of the case.
    pub scene: String,
    /// Outcome.
    pub verdict: Verdict,
    /// Solver of the final state; empty without one, as are the next columns.
    pub ran: String,
    /// Its strategy.
    pub strategy: String,
    /// Reported residuals of mass, load and complementarity.
    pub residuals: [f64; 3],
    /// Iterations of the last contact.
    pub iterations: u64,
    /// Reported convolutions of the last contact.
    pub convolutions: f64,
    /// Reported convolutions of all contacts of a history.
    pub all_convolutions: f64,
    /// Displacements that were computed, in equivalents of the grid, without approximations.
    pub displacements: f64,
    /// Processor time of the solving thread on Linux if it is above 0.05 s, else time on the clock \[s\]. Surfaces, elastic
    /// kernels and the check are not included.
    pub seconds: f64,
    /// Smallest gap \[m\].
    pub minimum_gap: f64,
    /// Numbers of the contact, in the order of [`Quantity::ALL`].
    pub values: [f64; 6],
    /// Largest error of the values from the limits of the case; NaN without limits.
    pub error: f64,
    /// The reason of a verdict, or a remark.
    pub reason: String,
}

impl Row {
    /// Whether the contestant solved the case.
    pub fn is_solved(&self) -> bool {
        self.verdict == Verdict::Converged
    }

    /// A number of the contact.
    pub fn value(&self, quantity: Quantity) -> f64 {
        self.values[quantity as usize]
    }

    /// The first tag of the case.
    pub(super) fn group(&self) -> &str {
        self.tags.first().map_or("", String::as_str)
    }

    /// Work: the convolutions that the contestant reports, but at least the displacements that it computed.
    pub fn work(&self) -> f64 {
        if self.displacements.is_nan() {
            self.all_convolutions
        } else {
            self.all_convolutions.max(self.displacements)
        }
    }

    /// Whether both rows are of the same run.
    pub(super) fn is_same_run(&self, other: &Self) -> bool {
        self.case == other.case
            && self.contestant == other.contestant
            && self.tolerance.to_bits() == other.tolerance.to_bits()
            && self.cells == other.cells
            && self.scene == other.scene
    }
}
