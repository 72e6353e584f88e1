//! What a solve reports: how it ended, how well the equations hold, what it cost.
//!
//! A report is data: it decides nothing and is the same from every solver. [`SolveReport::require_converged`]
//! turns a status into an error where a solution is needed.

use std::fmt;
use std::ops::AddAssign;

use thiserror::Error;

use crate::displayed::serialize_as_displayed;
use crate::solver_id::SolverId;
use crate::strategy::Strategy;

/// How an iterative solve ended. Everything but [`Status::Converged`] leaves the best state found.
///
/// # Examples
///
/// ```
/// use stribeck::Status;
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.solver.max_iterations = 1;
/// // Too few: a status, not an error, and the state is the best one found.
/// let solution = solve_contact(&scene)?;
/// assert_eq!(solution.report.status, Status::MaxIterations);
/// assert!(solution.report.residual.is_finite());
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Status {
    /// All residuals are at or below the tolerance.
    Converged,
    /// The iteration limit came first.
    MaxIterations,
    /// The residuals no longer fell.
    Stalled,
    /// The mesh is too coarse to hold a positive film: films fall to the contact film or below although the
    /// film expected of the contact is well above it.
    MeshTooCoarse,
    /// The residuals grew without bound or were no longer finite.
    Diverged,
    /// A solver from outside of the crate says that it has converged, but the residuals of its state, as the
    /// crate evaluates them, are above the tolerance.
    Unconfirmed,
}

serialize_as_displayed!(Status);

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Converged => "converged",
            Self::MaxIterations => "max_iterations",
            Self::Stalled => "stalled",
            Self::MeshTooCoarse => "mesh_too_coarse",
            Self::Diverged => "diverged",
            Self::Unconfirmed => "unconfirmed",
        })
    }
}

/// How far the state is from solving the discrete problem; all dimensionless, computed the same way for every
/// solver.
///
/// With `h_m` the pressure-weighted mean film and `a_x`, `a_y` the reference contact half-widths:
///
/// # Examples
///
/// ```
/// let mut residuals = stribeck::Residuals::default();
/// residuals.load = 1e-3;
/// assert_eq!(residuals.max(), 1e-3);
/// residuals.mass = f64::NAN;
/// assert!(!residuals.is_finite() && residuals.max() == f64::INFINITY);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Residuals {
    /// Sum of the absolute mass imbalances of the cells that hold fluid under pressure, of all cells where
    /// cavitation conserves mass, over the mass that the mean film `h_m` carries through the contact width
    /// `2 a_y`, or that flows into the box where that is less. Zero without lubricant.
    ///
    /// Where cavitation conserves mass and the surfaces move it bounds the imbalance of the
    /// [flow through the box](crate::reynolds::FlowBalance).
    pub mass: f64,
    /// `|sum of pressure - load| / load`.
    pub load: f64,
    /// Violation of the inequalities: fluid that builds up in cavitated cells (scaled as `mass`; with
    /// Reynolds' condition alone, `mass` counts it else), and the gap error of solid contact plus penetration
    /// elsewhere, averaged over the Hertz area and divided by `h_m`; the larger.
    pub complementarity: f64,
}

impl Residuals {
    /// Before any state is known: larger than those of all states.
    pub(crate) const UNKNOWN: Self = Self { mass: f64::INFINITY, load: 0.0, complementarity: 0.0 };

    /// The largest of the three; infinite where one is no number.
    pub fn max(&self) -> f64 {
        let all = [self.mass, self.load, self.complementarity];
        if all.iter().any(|residual| residual.is_nan()) {
            return f64::INFINITY;
        }
        all.into_iter().fold(0.0, f64::max)
    }

    /// Whether all three are finite.
    pub fn is_finite(&self) -> bool {
        self.mass.is_finite() && self.load.is_finite() && self.complementarity.is_finite()
    }
}

impl fmt::Display for Residuals {
    /// The three by name.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { mass, load, complementarity } = self;
        write!(f, "mass {mass:.1e}, load {load:.1e}, complementarity {complementarity:.1e}")
    }
}

/// Work done, by cause.
///
/// # Examples
///
/// ```
/// let mut work = stribeck::Work::default();
/// work.convolutions = 12.25; // twelve on the grid, one without padding
/// work += work;
/// assert_eq!(work.convolutions, 24.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Work {
    /// Elastic convolutions in equivalents of the finest grid: a coarser one counts by its share of nodes, a
    /// pressure estimate, whose transforms need no padding, as a quarter.
    pub convolutions: f64,
    /// Outer iterations: sweeps, Newton steps or active-set passes.
    pub iterations: u64,
    /// Inner iterations: Krylov or conjugate-gradient steps, passes over all lines of the semi-system.
    pub inner_iterations: u64,
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.convolutions += other.convolutions;
        self.iterations += other.iterations;
        self.inner_iterations += other.inner_iterations;
    }
}

/// The outcome of one solve of a contact.
///
/// # Examples
///
/// ```
/// use stribeck::{Residuals, SolveReport, SolverId, Status};
/// let report = SolveReport::new(SolverId::Custom("mine"), Status::Stalled, Residuals::default());
/// assert_eq!(report.status.to_string(), "stalled");
/// assert!(report.to_string().starts_with("stalled by mine; residuals mass 0.0e0, load 0.0e0"));
/// let error = report.require_converged().unwrap_err();
/// assert!(error.to_string().starts_with("mine ended as stalled"));
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
#[must_use = "a solve that did not converge is a status, not an error"]
pub struct SolveReport {
    /// The solver that produced the final state.
    pub solver: SolverId,
    /// How the solve ended.
    pub status: Status,
    /// Residuals of the state that was returned.
    pub residual: Residuals,
    /// Of dry contacts: what the energy lies above its minimum at most, over the elastic energy
    /// ([`DryOutcome::energy_error`](crate::elastic::DryOutcome::energy_error)). It holds whatever the solver
    /// did. None with a lubricant, which has no energy to minimise, and from solvers that do not tell.
    pub energy_error: Option<f64>,
    /// Work of the whole solve, starts and fallbacks included.
    pub work: Work,
    /// The way that led to the state; none from solvers that know one alone.
    pub strategy: Option<Strategy>,
    /// Residuals of each start and after each outer iteration, in order, for plots. On the way to a solution
    /// they may be those of other equations than the problem's: of thicker contact films, of Reynolds'
    /// condition, of a contact on the way in time. Where one start is all that a solve needs, the last are
    /// those of the state. Empty from solvers that do not tell, [`Dry`](crate::reynolds::Dry) among them.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub residual_history: Vec<Residuals>,
}

impl SolveReport {
    /// A report with nothing beside these.
    pub fn new(solver: SolverId, status: Status, residual: Residuals) -> Self {
        Self {
            solver,
            status,
            residual,
            energy_error: None,
            work: Work::default(),
            strategy: None,
            residual_history: Vec::new(),
        }
    }

    /// The same with an energy error.
    pub fn with_energy_error(self, energy_error: f64) -> Self {
        Self { energy_error: Some(energy_error), ..self }
    }

    /// The same with the work of the whole solve.
    pub fn with_work(self, work: Work) -> Self {
        Self { work, ..self }
    }

    /// The same with the way that led to the state.
    pub fn with_strategy(self, strategy: Strategy) -> Self {
        Self { strategy: Some(strategy), ..self }
    }

    /// The same with the residuals of each start and after each outer iteration.
    pub fn with_residual_history(self, residual_history: Vec<Residuals>) -> Self {
        Self { residual_history, ..self }
    }

    /// Counts in what a solve before this one took.
    pub(crate) fn preceded_by(mut self, mut first: Self) -> Self {
        self.work += first.work;
        first.residual_history.append(&mut self.residual_history);
        Self { residual_history: first.residual_history, ..self }
    }

    /// Counts in what a solve after this one took, whose state was not kept.
    pub(crate) fn followed_by(mut self, second: Self) -> Self {
        // The sum that `preceded_by` makes, in its order: rounding is the same.
        let mut work = second.work;
        work += self.work;
        self.residual_history.extend(second.residual_history);
        Self { work, ..self }
    }

    /// Refuses a solve that did not converge.
    ///
    /// # Errors
    /// [`NotConverged`], with a copy of the report.
    pub fn require_converged(&self) -> Result<(), NotConverged> {
        match self.status {
            Status::Converged => Ok(()),
            _ => Err(NotConverged { report: Box::new(self.clone()) }),
        }
    }
}

impl fmt::Display for SolveReport {
    /// Status, solver, residuals and work in one line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { solver, status, residual, work, .. } = self;
        write!(
            f,
            "{status} by {solver}; residuals {residual}; {} iterations, {:.0} convolutions",
            work.iterations, work.convolutions
        )
    }
}

/// A solve that had to converge did not.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "{} ended as {} with residuals mass {:.2e}, load {:.2e}, complementarity {:.2e}",
    report.solver, report.status, report.residual.mass, report.residual.load, report.residual.complementarity
)]
#[non_exhaustive]
pub struct NotConverged {
    /// The report of the solve.
    pub report: Box<SolveReport>,
}
