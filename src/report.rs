//! Solve reports: status, residuals and work.
//!
//! A report is plain data with the same meaning for every solver. [`SolveReport::require_converged`] turns a
//! status into an error where a solution is required.

use std::fmt;
use std::ops::AddAssign;

use thiserror::Error;

use crate::displayed::serialize_as_displayed;
use crate::solver_id::SolverId;
use crate::strategy::Strategy;

/// The outcome of an iterative solve. All but [`Status::Converged`] leave the best state found.
///
/// # Examples
///
/// ```
/// use stribeck::Status;
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.solver.max_iterations = 1;
/// // Too few iterations: a status, not an error; the state is the best one found.
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
    /// The iteration limit was reached.
    MaxIterations,
    /// The residuals stopped decreasing.
    Stalled,
    /// The mesh is too coarse for a positive film: films fall to the contact film or below although the
    /// expected film is well above it.
    MeshTooCoarse,
    /// The residuals diverged or are not finite.
    Diverged,
    /// A custom solver reported convergence, but the residuals evaluated by the crate exceed the tolerance.
    Unverified,
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
            Self::Unverified => "unverified",
        })
    }
}

/// Residuals of the discrete problem, dimensionless and evaluated in the same way for every solver.
///
/// `h_m` is the pressure-weighted mean film, `a_x` and `a_y` are the reference contact half-widths.
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
    /// Sum of the absolute mass imbalances of the cells with fluid under pressure, or of all cells with
    /// mass-conserving cavitation. The scale is the mass flow of the mean film `h_m` through the contact
    /// width `2 a_y`, or the inflow of the box if that is less. Zero without lubricant.
    ///
    /// With mass-conserving cavitation and moving surfaces it bounds the imbalance of the [flow through the
    /// box](crate::reynolds::FlowBalance).
    pub mass: f64,
    /// `|sum of pressure - load| / load`.
    pub load: f64,
    /// Violation of the inequalities, the larger of two values: fluid accumulation in cavitated cells (scaled
    /// as `mass`; with mass-conserving cavitation part of `mass`), and the gap error of solid contact plus
    /// penetration elsewhere, averaged over the Hertz area and divided by `h_m`.
    pub complementarity: f64,
}

impl Residuals {
    /// Initial value, larger than the residuals of any state.
    pub(crate) const UNKNOWN: Self = Self { mass: f64::INFINITY, load: 0.0, complementarity: 0.0 };

    /// The largest of the three; infinite if one is NaN.
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
    /// The three residuals by name.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { mass, load, complementarity } = self;
        write!(f, "mass {mass:.1e}, load {load:.1e}, complementarity {complementarity:.1e}")
    }
}

/// Work of a solve.
///
/// # Examples
///
/// ```
/// let mut work = stribeck::Work::default();
/// work.convolutions = 12.25; // twelve on the grid and one without padding
/// work += work;
/// assert_eq!(work.convolutions, 24.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Work {
    /// Elastic convolutions in equivalents of the finest grid. A convolution on a coarser grid counts by its
    /// share of nodes; a pressure estimate, without padding, as a quarter.
    pub convolutions: f64,
    /// Outer iterations: sweeps, Newton steps or active-set passes.
    pub iterations: u64,
    /// Inner iterations: Krylov or conjugate-gradient steps, or line passes of the semi-system.
    pub inner_iterations: u64,
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.convolutions += other.convolutions;
        self.iterations += other.iterations;
        self.inner_iterations += other.inner_iterations;
    }
}

/// The outcome of a contact solve.
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
    /// The solver of the final state.
    pub solver: SolverId,
    /// Status of the solve.
    pub status: Status,
    /// Residuals of the returned state.
    pub residual: Residuals,
    /// Bound on the relative energy error of a dry contact
    /// ([`DryOutcome::energy_error`](crate::elastic::DryOutcome::energy_error)). It holds for any solver.
    /// `None` with a lubricant, where no energy is minimized, and for solvers without it.
    pub energy_error: Option<f64>,
    /// Total work, including starts and fallbacks.
    pub work: Work,
    /// The strategy that led to the state; `None` for solvers with a single one.
    pub strategy: Option<Strategy>,
    /// Smallest and largest load ratio within the accuracy of [`AsperityInlets`](crate::reynolds::AsperityInlets); `None` for
    /// other solvers.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub load_ratio_range: Option<[f64; 2]>,
    /// Whether the flow through the valleys of asperity inlets converged. Without it the oil in the valleys has no pressure of its own.
    /// `None` for other solvers.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub has_valley_flow: Option<bool>,
    /// Residuals of each start and after each outer iteration, in order. Intermediate values may belong to
    /// modified equations: thicker contact films, Reynolds' condition, or pseudo-time steps. For a solve from
    /// a single start the last residuals are those of the state. Empty for solvers without a history, such as
    /// [`Dry`](crate::reynolds::Dry).
    #[cfg_attr(feature = "serde", serde(skip))]
    pub residual_history: Vec<Residuals>,
}

impl SolveReport {
    /// A report without energy error, work, strategy and history.
    pub fn new(solver: SolverId, status: Status, residual: Residuals) -> Self {
        Self {
            solver,
            status,
            residual,
            energy_error: None,
            work: Work::default(),
            strategy: None,
            load_ratio_range: None,
            has_valley_flow: None,
            residual_history: Vec::new(),
        }
    }

    /// Sets the energy error.
    pub fn with_energy_error(self, energy_error: f64) -> Self {
        Self { energy_error: Some(energy_error), ..self }
    }

    /// Sets the work of the whole solve.
    pub fn with_work(self, work: Work) -> Self {
        Self { work, ..self }
    }

    /// Sets the strategy.
    pub fn with_strategy(self, strategy: Strategy) -> Self {
        Self { strategy: Some(strategy), ..self }
    }

    /// Sets the residuals of each start and after each outer iteration.
    pub fn with_residual_history(self, residual_history: Vec<Residuals>) -> Self {
        Self { residual_history, ..self }
    }

    /// Adds the work and history of a preceding solve.
    pub(crate) fn preceded_by(mut self, mut first: Self) -> Self {
        self.work += first.work;
        first.residual_history.append(&mut self.residual_history);
        Self { residual_history: first.residual_history, ..self }
    }

    /// Adds the work of a subsequent solve with a discarded state.
    pub(crate) fn followed_by(mut self, second: Self) -> Self {
        // Summation in the order of `preceded_by`, for equal rounding.
        let mut work = second.work;
        work += self.work;
        self.residual_history.extend(second.residual_history);
        Self { work, ..self }
    }

    /// Returns an error unless the solve converged.
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
    /// Status, solver, residuals and work on one line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { solver, status, residual, work, .. } = self;
        write!(
            f,
            "{status} by {solver}; residuals {residual}; {} iterations, {:.0} convolutions",
            work.iterations, work.convolutions
        )
    }
}

/// Error of a solve that was required to converge.
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
