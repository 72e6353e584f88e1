//! The coupled contact problem: fluid film, solid contact, plastic limit and load balance in one system.
//!
//! [`LubricatedContact`] states the problem, a [`ContactSolver`] solves it in a [`ContactState`], and all
//! solvers share one discretisation, one stopping rule and one report. Non-convergence is a
//! [`Status`](crate::Status); only a broken contract is an error.
//!
//! | solver | method | use |
//! |---|---|---|
//! | [`NewtonKrylov`] | semismooth Newton, block-preconditioned GMRES | mixed and full film |
//! | [`Multigrid`] | full multigrid, hybrid line relaxation | smooth full film |
//! | [`SemiSystem`] | line relaxation of flow and elastic response in one system | mixed and full film |
//! | [`Dry`] | active-set conjugate gradients | no lubricant |
//! | [`Auto`] | picks and falls back | default |
//!
//! [`GivenFilm`] is the Reynolds equation alone, between rigid surfaces.

mod active_set;
mod auto;
mod coupled;
mod dry;
mod evaluation;
mod flow;
mod given_film;
mod multigrid;
mod newton_krylov;
mod problem;
mod semi_system;
mod state;

use std::fmt::Debug;

pub use auto::Auto;
pub(crate) use coupled::reaches_limit;
pub use dry::Dry;
pub use evaluation::Evaluation;
pub(crate) use flow::require_spin;
pub use flow::{Cavitation, FaceMobility, FilmFlows, FlowBalance, Scheme, ShearThinning};
pub use given_film::{FilmThickness, GivenFilm, GivenFilmSolution, SideEdges};
pub use multigrid::Multigrid;
pub use newton_krylov::{Attempt, NewtonKrylov, NewtonSettings, PocketSettings};
pub use problem::{ContactDefinition, EdgePressure, LubricatedContact, Squeeze};
pub(crate) use problem::{LEAST_SPEED, SPEED_REQUIREMENT, outermost, require_speed};
pub use semi_system::SemiSystem;
pub use state::ContactState;
use thiserror::Error;

use crate::error::InputError;
use crate::report::SolveReport;
use crate::solver_id::SolverId;
use crate::with_fields::with_fields;

/// When a solve ends.
///
/// # Examples
///
/// ```
/// use stribeck::reynolds::StoppingRule;
/// let rule = StoppingRule::default().with_tolerance(1e-8);
/// assert!(rule.validate().is_ok() && rule.max_iterations == 20_000);
/// assert!(rule.with_tolerance(0.5).validate().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct StoppingRule {
    /// Bound for each of the three [residuals](crate::Residuals).
    pub tolerance: f64,
    /// Largest number of outer iterations (sweeps, Newton steps, active-set passes).
    pub max_iterations: u64,
}

with_fields!(StoppingRule { with_tolerance tolerance: f64, with_max_iterations max_iterations: u64 });

impl Default for StoppingRule {
    /// Residuals of 1e-6, at most 20 000 iterations.
    fn default() -> Self {
        Self::new(1e-6, 20_000)
    }
}

impl StoppingRule {
    /// Residuals of `tolerance`, at most `max_iterations` outer iterations.
    pub const fn new(tolerance: f64, max_iterations: u64) -> Self {
        Self { tolerance, max_iterations }
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// A tolerance outside (0, 0.1].
    pub fn validate(&self) -> Result<(), InputError> {
        InputError::require(
            self.tolerance > 0.0 && self.tolerance <= 0.1,
            "solver.tolerance",
            self.tolerance,
            "above 0 and at most 0.1",
        )
    }
}

/// Solves a [`LubricatedContact`].
///
/// Contract: leave `problem` as it is, but for what the deformation model remembers; start from `state` (a
/// state without any pressure asks for a cold start), leave the best state found in it, and report residuals
/// of exactly that state. Buffers may be made at the first solve; later ones on the same grid do not
/// allocate. What is found depends on problem, state and rule alone, so that a resumed run is the
/// uninterrupted one. Residuals are those of [`Evaluation`]. Never report
/// [`Status::Converged`](crate::Status::Converged) with a residual above the tolerance.
///
/// # Examples
///
/// A solver that asks another one and calls itself so:
///
/// ```
/// use stribeck::reynolds::{ContactSolver, ContactState, Dry, LubricatedContact, ReynoldsError, StoppingRule};
/// use stribeck::{SolveReport, SolverId};
/// #[derive(Debug, Default)]
/// struct Mine(Dry);
/// impl ContactSolver for Mine {
///     fn id(&self) -> SolverId {
///         SolverId::Custom("mine")
///     }
///     fn solve(
///         &mut self,
///         problem: &mut LubricatedContact<'_>,
///         state: &mut ContactState,
///         stop: &StoppingRule,
///     ) -> Result<SolveReport, ReynoldsError> {
///         let mut report = self.0.solve(problem, state, stop)?;
///         report.solver = self.id();
///         Ok(report)
///     }
/// }
/// assert_eq!(Mine::default().id().to_string(), "mine");
/// ```
pub trait ContactSolver: Debug + Send + Sync {
    /// What reports call the solver; [`SolverId::Custom`] outside of the crate.
    fn id(&self) -> SolverId;

    /// Refuses what [`solve`](Self::solve) would refuse before its first iteration, with the same error;
    /// nothing is solved. The default checks problem, state and rule. A solver that is not made for every
    /// problem says so here too.
    ///
    /// # Errors
    /// As of [`solve`](Self::solve).
    fn check(
        &self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        stop: &StoppingRule,
    ) -> Result<(), ReynoldsError> {
        check_call(problem, state, stop)
    }

    /// Solves `problem` from `state` until `stop`.
    ///
    /// # Errors
    /// Input that breaks the contract of [`LubricatedContact`], or a problem the solver is not made for.
    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError>;
}

/// What every solver checks before it starts.
fn check_call(
    problem: &LubricatedContact<'_>,
    state: &ContactState,
    stop: &StoppingRule,
) -> Result<(), ReynoldsError> {
    problem.validate()?;
    state.validate(&problem.grid())?;
    Ok(stop.validate()?)
}

/// Why a solve could not be attempted.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ReynoldsError {
    /// The problem breaks its contract.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The solver is not made for this problem.
    #[error("solver {solver} cannot be used: {reason}")]
    WrongSolver {
        /// The solver.
        solver: SolverId,
        /// What the problem has that the solver cannot treat.
        reason: &'static str,
    },
    /// The solve was ended from outside ([`GivenFilm::solve_unless`]).
    #[error("the solve was interrupted")]
    Interrupted,
    /// The contact reaches the edge of the box.
    #[error(
        "the contact reaches the edge of the box at x = {x:.6e} m, y = {y:.6e} m: enlarge the box, or allow it \
         (solver.edge_contact)"
    )]
    EdgeContact {
        /// Where \[m\].
        x: f64,
        /// Where \[m\].
        y: f64,
    },
}
