//! The semi-system method: line relaxation of the coupled Reynolds and elasticity equations.
//!
//! Two methods under one name: of the hard contact steps like Newton's, with lines in place of the
//! factorisation, of the paper's contact the sweeps that were published with it.

mod lines;
mod sweeps;

use lines::{LineBlock, passes};
use sweeps::{Damping, Sweeps};

use super::newton_krylov::{NewtonKrylov, NewtonSettings};
use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, ReynoldsError, StoppingRule, check_call};
use crate::error::InputError;
use crate::report::{SolveReport, Work};
use crate::solver_id::SolverId;

/// Relaxations that a step combines: with one alone, 20 of 29 scenes of the stability map converge in place
/// of 24.
const RELAXATIONS: usize = 2;

/// Line relaxation along x of the semi-system: one matrix that holds pressure flow and entrainment, the
/// latter by the elastic response of the films, so that its diagonal keeps its weight however thin the film
/// (Ai 1993 and Hu and Zhu 2000 in spirit).
///
/// The unknown of a node is what its side leaves open: pressure, the film that is carried to it, plastic
/// depth, or the fluid pressure between solids that touch. Each step
///
/// 1. relaxes the linearised balances by lines, a tridiagonal system each, Gauss-Seidel from line to line;
/// 2. finds the pressures under solids and under carried films from what these films have to be, by the
///    inverse of the elastic response, and the approach from the load;
/// 3. combines two such relaxations so that the equations, the elastic response whole, lack the least;
/// 4. eliminates every node's own equations, which decides its side.
///
/// Linearisation, sides and starts are those of [`NewtonKrylov`]; no matrix is factorised, and a Krylov space
/// of two directions is all that a step builds up, at two to three times the steps. Starts are steps in time,
/// of a few passages of a cell at first.
///
/// In the paper's contact ([`ContactDefinition::UnifiedReynolds`](super::ContactDefinition::UnifiedReynolds))
/// each sweep takes its pressures at once, with the three nearest influence coefficients in the matrix,
/// under-relaxed; the approach follows the load error. Two numbers decide whether that converges:
/// - `relaxation`: the share of each new pressure that is taken;
/// - `stiffness`: factor on the implicit influence coefficients. With 1, the textbook value, highly loaded
///   contacts end in a limit cycle unless the relaxation is some 0.02: neighbouring lines see each other's
///   deformation one sweep late. Factors of 4 to 8 damp just the elastic part and leave the answer unchanged.
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
    /// Newton's steps with line relaxation.
    relaxed: NewtonKrylov,
    /// Sweeps of the paper's contact, made when they are first needed.
    sweeps: Option<Box<Sweeps>>,
}

impl Clone for SemiSystem {
    /// The copy makes buffers of its own at its first solve.
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
    /// A solver that damps the sweeps of the paper's contact like this.
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

    /// A solver with this damping, which is in range.
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

    fn check(
        &self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        stop: &StoppingRule,
    ) -> Result<(), ReynoldsError> {
        check_call(problem, state, stop)?;
        if problem.lubricant.is_none() {
            let reason = "the problem has no lubricant";
            return Err(ReynoldsError::WrongSolver { solver: self.id(), reason });
        }
        Ok(())
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        self.check(problem, state, stop)?;
        let (solver, grid) = (self.id(), problem.grid());
        if !problem.is_paper() {
            let report = self.relaxed.solve(problem, state, stop)?;
            let Work { iterations, inner_iterations, .. } = report.work;
            // One relaxation more in each step finds what the approach does.
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
