//! The coupled contact problem: fluid film, solid contact, plastic limit and load balance in one system.
//!
//! [`LubricatedContact`] defines the problem, and a [`ContactSolver`] advances a [`ContactState`] to its
//! solution. All solvers share one discretization, one stopping rule and one report. Non-convergence is a
//! [`Status`](crate::Status); only invalid input is an error.
//!
//! | solver | method | use |
//! |---|---|---|
//! | [`NewtonKrylov`] | semismooth Newton, block-preconditioned GMRES | mixed and full film |
//! | [`Multigrid`] | full multigrid, hybrid line relaxation | smooth full film |
//! | [`SemiSystem`] | line relaxation of flow and elastic response in one system | mixed and full film |
//! | [`Dry`] | active-set conjugate gradients | no lubricant |
//! | [`AsperityInlets`] | a dry contact and the inlets of its asperities | estimates of rough mixed contacts |
//! | [`Auto`] | selects a solver, with fallback | default |
//!
//! [`GivenFilm`] solves the Reynolds equation alone, between rigid surfaces with a prescribed film; [`JournalBearing`] has
//! such a film, a load vector and an equilibrium.

mod active_set;
mod asperity_inlets;
mod auto;
mod carried_waves;
mod coupled;
mod dry;
mod evaluation;
mod flow;
mod given_film;
mod inner_nodes;
mod journal;
mod multigrid;
mod newton_krylov;
mod problem;
mod residuals;
mod semi_system;
mod squeeze;
mod state;
mod unified_reynolds;
mod validation;

use std::fmt::Debug;

pub use asperity_inlets::AsperityInlets;
pub use auto::Auto;
pub use carried_waves::CarriedWaves;
pub use dry::Dry;
pub use evaluation::Evaluation;
pub(crate) use flow::require_spin;
pub use flow::{Cavitation, FaceMobility, FilmFlows, FlowBalance, Scheme, ShearThinning};
#[cfg(feature = "serde")]
pub(crate) use given_film::require_resolved_holes;
pub use given_film::{
    Feed, FilmThickness, GivenFilm, GivenFilmSolution, MeanContact, MeanRoughness, SideEdges,
};
pub use journal::{ElasticBore, Grooves, Holes, JournalBearing, JournalSolution};
pub use multigrid::Multigrid;
#[cfg(feature = "testing")]
pub(crate) use newton_krylov::FluidBlock;
pub use newton_krylov::{NewtonKrylov, NewtonSettings};
pub(crate) use problem::outermost;
pub use problem::{ContactDefinition, LubricatedContact};
pub use semi_system::SemiSystem;
pub use squeeze::{EdgePressure, Squeeze};
pub use state::ContactState;
use thiserror::Error;
pub(crate) use unified_reynolds::reaches_limit;
pub(crate) use validation::{LEAST_SPEED, SPEED_REQUIREMENT, require_speed};

use crate::error::InputError;
use crate::report::SolveReport;
use crate::solver_id::SolverId;
use crate::with_fields::with_fields;

/// Stopping criterion of a solve.
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
/// Contract of an implementation:
///
/// - It leaves `problem` unchanged, except for internal buffers of the deformation model.
/// - It starts from `state`; a state without pressure requests a cold start. On return `state` is the best
///   state found, and the reported residuals are those of exactly this state, as [`Evaluation`] computes them.
/// - [`Status::Converged`](crate::Status::Converged) requires all residuals at or below the tolerance.
/// - The result depends on problem, state and rule alone, so that a resumed run equals an uninterrupted one.
/// - The first solve on a grid may allocate buffers; later ones do not allocate.
///
/// # Examples
///
/// A solver that delegates to another one under its own name:
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
    /// Identifier of the solver in reports; [`SolverId::Custom`] for a user-defined solver.
    fn id(&self) -> SolverId;

    /// The first property of `problem` outside of the scope of the solver; `None`, the default, if it solves every
    /// problem.
    fn unsupported(&self, problem: &LubricatedContact<'_>) -> Option<&'static str> {
        let _ = problem;
        None
    }

    /// Validates the input of [`solve`](Self::solve) and returns the same error, without solving. The default
    /// checks problem, state and rule, and rejects [unsupported](Self::unsupported) problems.
    ///
    /// # Errors
    /// The errors of [`solve`](Self::solve).
    fn check(
        &self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        stop: &StoppingRule,
    ) -> Result<(), ReynoldsError> {
        check_call(problem, state, stop)?;
        match self.unsupported(problem) {
            Some(reason) => Err(ReynoldsError::WrongSolver { solver: self.id(), reason }),
            None => Ok(()),
        }
    }

    /// Solves `problem` from `state` until `stop` is met.
    ///
    /// # Errors
    /// Input that violates the contract of [`LubricatedContact`], or a problem outside the scope of the
    /// solver.
    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError>;
}

/// Checks common to all solvers.
fn check_call(
    problem: &LubricatedContact<'_>,
    state: &ContactState,
    stop: &StoppingRule,
) -> Result<(), ReynoldsError> {
    problem.validate()?;
    state.validate(&problem.grid())?;
    Ok(stop.validate()?)
}

/// Errors of a solve.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ReynoldsError {
    /// Invalid input.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The problem is outside the scope of the solver.
    #[error("solver {solver} cannot be used: {reason}")]
    WrongSolver {
        /// The solver.
        solver: SolverId,
        /// The unsupported property of the problem.
        reason: &'static str,
    },
    /// The caller interrupted the solve ([`GivenFilm::solve_unless`]).
    #[error("the solve was interrupted")]
    Interrupted,
    /// The contact reaches the edge of the box.
    #[error(
        "the contact reaches the edge of the box at x = {x:.6e} m, y = {y:.6e} m: enlarge the box, or allow it \
         (solver.edge_contact)"
    )]
    EdgeContact {
        /// x of the first contact node at the edge \[m\].
        x: f64,
        /// Its y \[m\].
        y: f64,
    },
}
