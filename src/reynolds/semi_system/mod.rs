//! The semi-system method: line relaxation of the coupled Reynolds and elasticity equations.
//!
//! The module has two methods. The hard contact is solved by Newton's method with line relaxation in place of
//! the factorization, the unified Reynolds model by the sweeps of its publication.

mod lines;

use lines::{LineBlock, passes};

use super::newton_krylov::{NewtonKrylov, NewtonSettings};
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::unified_reynolds::{Damping, Sweeps};
use super::{ContactSolver, ReynoldsError, StoppingRule};
use crate::error::InputError;
use crate::report::{SolveReport, Work};
use crate::solver_id::SolverId;

/// Relaxations combined in a step. With one, 20 of 29 scenes of the stability map converge; with two, 24.
const RELAXATIONS: usize = 2;

/// Line relaxation along x of the semi-system. One matrix contains pressure flow and entrainment, the latter
/// through the elastic response of the films, so the diagonal remains dominant for thin films (following Ai
/// 1993, and Hu and Zhu 2000).
///
/// The unknown of a node depends on its state: pressure, advected film, plastic depth, or the pressure of
/// fluid trapped between touching solids. Each step
///
/// 1. relaxes the linearized balances by lines, with a tridiagonal system each, in Gauss-Seidel order;
/// 2. computes the pressures of prescribed displacements, under solids and advected films, by the inverse
///    elastic response, and the approach from the load;
/// 3. combines two such relaxations to minimize the residual of the equations with the full elastic response;
/// 4. eliminates the local equations of each node, which determines its state.
///
/// Linearization, active set and initial states are those of [`NewtonKrylov`]. No matrix is factorized, and
/// the Krylov space has two directions, at the cost of two to three times as many steps. Cold starts use
/// pseudo-time steps, initially a few cell transits long.
///
/// In the unified Reynolds model
/// ([`ContactDefinition::UnifiedReynolds`](super::ContactDefinition::UnifiedReynolds)) each sweep computes
/// the pressures with the three nearest influence coefficients in the matrix, under-relaxed. The approach
/// follows the load error. Two parameters control convergence:
/// - `relaxation`: the share of each pressure change that is applied;
/// - `stiffness`: a factor on the implicit influence coefficients. With the textbook value 1, highly loaded
///   contacts end in a limit cycle unless the relaxation is about 0.02, as the deformation by neighboring
///   lines lags by one sweep. Factors of 4 to 8 damp the elastic part alone and do not change the solution.
///
/// # Examples
///
/// ```
/// use stribeck::reynolds::{ContactSolver, SemiSystem};
/// assert_eq!(SemiSystem::default().id().to_string(), "semi_system");
/// let error = SemiSystem::new(1.5, 6.0).unwrap_err();
/// assert_eq!(error.to_string(), "solver.relaxation = 1.5: must be above 0 and at most 1");
/// ```
#[derive(Debug)]
pub struct SemiSystem {
    /// Relaxation and stiffness of the sweeps.
    damping: Damping,
    /// Newton's method with line relaxation.
    relaxed: NewtonKrylov,
    /// Sweeps of the unified Reynolds model, allocated at first use.
    sweeps: Option<Box<Sweeps>>,
}

impl Clone for SemiSystem {
    /// The clone allocates its own buffers at its first solve.
    fn clone(&self) -> Self {
        Self { damping: self.damping, relaxed: self.relaxed.clone(), sweeps: None }
    }
}

impl Default for SemiSystem {
    /// Relaxation 0.2, stiffness 6.
    fn default() -> Self {
        Self::with(Damping { relaxation: 0.2, stiffness: 6.0 })
    }
}

impl SemiSystem {
    /// A solver with these parameters for the sweeps of the unified Reynolds model.
    ///
    /// # Errors
    /// A relaxation outside (0, 1], a stiffness below 1 or not finite.
    pub fn new(relaxation: f64, stiffness: f64) -> Result<Self, InputError> {
        InputError::require(
            relaxation > 0.0 && relaxation <= 1.0,
            "solver.relaxation",
            relaxation,
            "above 0 and at most 1",
        )?;
        InputError::require(
            stiffness.is_finite() && stiffness >= 1.0,
            "solver.stiffness",
            stiffness,
            "finite and at least 1",
        )?;
        Ok(Self::with(Damping { relaxation, stiffness }))
    }

    /// A solver with valid parameters.
    fn with(damping: Damping) -> Self {
        let settings = NewtonSettings::by_lines(RELAXATIONS);
        let relaxed = NewtonKrylov::by(|grid| Box::new(LineBlock::new(grid)), settings);
        Self { damping, relaxed, sweeps: None }
    }
}

impl ContactSolver for SemiSystem {
    fn id(&self) -> SolverId {
        SolverId::SemiSystem
    }

    fn unsupported(&self, problem: &LubricatedContact<'_>) -> Option<&'static str> {
        if problem.lubricant.is_none() {
            return Some("the problem has no lubricant");
        }
        let has_no_sides = !problem.is_hard() && problem.grid().is_strip();
        has_no_sides
            .then_some("sweeps of the unified Reynolds model need side edges; take contact = \"hard\"")
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        self.check(problem, state, stop)?;
        let (solver, grid) = (self.id(), problem.grid());
        if problem.is_hard() {
            let report = self.relaxed.solve(problem, state, stop)?;
            let Work { iterations, inner_iterations, .. } = report.work;
            // Each step has one additional relaxation, for the response to the approach.
            let inner_iterations = passes(grid.ny()) * (inner_iterations + iterations);
            let work = Work { inner_iterations, ..report.work };
            return Ok(SolveReport { solver, work, strategy: None, ..report });
        }
        let kept = self.sweeps.take().filter(|sweeps| sweeps.coupled.fluid.grid == grid);
        let sweeps = self.sweeps.insert(kept.unwrap_or_else(|| Box::new(Sweeps::new(grid))));
        let damping = self.damping;
        let mut work = Work::default();
        let (status, residuals) = sweeps.solve(problem, state, stop, damping, &mut work)?;
        Ok(SolveReport::new(solver, status, residuals)
            .with_work(work)
            .with_residual_history(sweeps.history.clone()))
    }
}
