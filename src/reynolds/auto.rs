//! Automatic choice of the solver.
//!
//! ```text
//! no lubricant ───────────────────> Dry
//! paper's contact ────────────────> hard contact first; SemiSystem where anything touches
//! smooth full film on many nodes ─> Multigrid ──not converged──> NewtonKrylov
//!   after a step in time ─────────> NewtonKrylov
//! all else ───────────────────────> NewtonKrylov ──not converged, nothing touches──> SemiSystem
//! ```
//!
//! Sweeps after Newton's method are accepted only if their residual is smaller.

use super::multigrid::{HandOver, expects_full_film};
use super::problem::{ContactDefinition, LubricatedContact};
use super::state::ContactState;
use super::{
    ContactSolver, Dry, Multigrid, NewtonKrylov, ReynoldsError, SemiSystem, StoppingRule, check_call,
};
use crate::report::{SolveReport, Status};
use crate::solver_id::SolverId;

/// Newton's method takes over from multigrid after this number of cycles, which cost more than it does. It starts
/// from their state if the residual is below this bound, for as many steps at most, and then from the given state: from a
/// nearly solved one it takes a few steps, or hundreds.
const HAND_OVER: HandOver = HandOver { cycles: 11, residual: 1.0 };

/// Up to this number of nodes Newton's method needs fewer convolutions than multigrid cycles, and factorization is
/// cheap.
const FEW_NODES: usize = 64 * 64;

/// Expected film over contact film above which solid contact of smooth surfaces is an error of the mesh; the
/// minimum film is at least a quarter of the central film.
const FILM_OVER_CONTACT: f64 = 10.0;

/// Uses [`Dry`] without a lubricant. Uses [`Multigrid`] if a smooth full film is expected on more than 64 x 64
/// nodes and the contact does not follow another one in time; [`NewtonKrylov`] continues if the tolerance is not reached, and
/// solves all other contacts. If it does not
/// converge and no solids touch, [`SemiSystem`] is tried, which would not converge in solid contact. The report
/// names the solver whose state was kept ([`SolverId::MultigridThenNewton`] if Newton's method continued from
/// multigrid) and sums the work of all.
///
/// A smooth contact whose film by formula is at least ten times the contact film, but whose solids touch on this
/// mesh, ends as [`Status::MeshTooCoarse`].
///
/// With [`ContactDefinition::UnifiedReynolds`] the hard contact is solved first. Without solid contact it is the
/// solution; otherwise [`SemiSystem`] starts from the given state.
///
/// # Examples
///
/// ```
/// use stribeck::SolverId;
/// use stribeck::sim::{Scene, solve_contact};
/// // The default solver of scenes; reports name the one it has chosen.
/// let mut scene = Scene::azam_2019(32);
/// assert_eq!(solve_contact(&scene)?.report.solver, SolverId::NewtonKrylov);
/// scene.lubricant = None;
/// scene.motion.slide_roll_ratio = 0.0;
/// assert_eq!(solve_contact(&scene)?.report.solver, SolverId::Dry);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Auto {
    /// For problems without a lubricant.
    dry: Dry,
    /// For smooth full films; slow convergence ends in a hand-over.
    multigrid: Multigrid,
    /// For all other lubricated problems.
    newton: NewtonKrylov,
    /// For the paper's contact, and for full films on which Newton's method fails.
    sweeps: SemiSystem,
    /// Saved state to return to if a solver fails.
    kept: Option<ContactState>,
    /// Start of a solve with the paper's contact.
    paper_start: Option<ContactState>,
}

impl Auto {
    /// A solver; each method allocates its buffers at its first use.
    pub fn new() -> Self {
        Self::with_dry(Dry::new())
    }

    /// A solver that accepts a dry contact at the edge of the box (see [`Dry::allowing_edge_contact`]).
    pub fn allowing_edge_contact() -> Self {
        Self::with_dry(Dry::allowing_edge_contact())
    }

    /// All solvers with their defaults except `dry`.
    fn with_dry(dry: Dry) -> Self {
        Self {
            dry,
            multigrid: Multigrid::handing_over(HAND_OVER),
            newton: NewtonKrylov::new(),
            sweeps: SemiSystem::default(),
            kept: None,
            paper_start: None,
        }
    }
}

impl Default for Auto {
    fn default() -> Self {
        Self::new()
    }
}

impl ContactSolver for Auto {
    fn id(&self) -> SolverId {
        SolverId::Auto
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        if problem.lubricant.is_none() {
            return self.dry.solve(problem, state, stop);
        }
        check_call(problem, state, stop)?;
        if !problem.is_hard() {
            return self.paper(problem, state, stop);
        }
        let mut report = self.lubricated(problem, state, stop)?;
        let touches = state.in_contact.contains(&true);
        if touches && problem.squeeze.is_none() && expects_full_film(problem, FILM_OVER_CONTACT) {
            report.status = Status::MeshTooCoarse;
        }
        Ok(report)
    }
}

impl Auto {
    /// The paper's contact: the hard one if no solids touch, otherwise sweeps.
    fn paper(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        let given = self.paper_start.get_or_insert_with(|| state.clone());
        given.clone_from(state);
        // Without solid contact both definitions have the same solution.
        let mut hard = problem.copied().with_contact(ContactDefinition::Hard);
        let open = self.lubricated(&mut hard, state, stop)?;
        let touches = state.in_contact.contains(&true);
        if open.status == Status::Converged && !touches {
            return Ok(open);
        }
        if let Some(given) = &self.paper_start {
            state.clone_from(given);
        }
        Ok(self.sweeps.solve(problem, state, stop)?.preceded_by(open))
    }

    /// The hard contact: multigrid if suitable, followed or replaced by Newton's method.
    fn lubricated(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        // A step in time begins near its solution, where Newton's method converges quadratically.
        let is_next_step = problem.squeeze.is_some() && state.pressure.iter().any(|&p| p > 0.0);
        if is_next_step || !Multigrid::suits(problem) || problem.gap.len() <= FEW_NODES {
            return self.newton_then_sweeps(problem, state, stop);
        }
        // Multigrid first; its start is kept for Newton's method.
        let given = self.kept.get_or_insert_with(|| state.clone());
        given.clone_from(state);
        let first = match self.multigrid.solve(problem, state, stop) {
            // A custom deformation model without coarser grids.
            Err(ReynoldsError::WrongSolver { .. }) => return self.newton_then_sweeps(problem, state, stop),
            first => first?,
        };
        if first.status == Status::Converged {
            return Ok(first);
        }
        // Newton's method continues a state that is nearly solved, for a few steps, else begins again.
        let too_coarse = first.status == Status::MeshTooCoarse;
        let mut before = first;
        if !too_coarse && before.residual.max() < HAND_OVER.residual {
            let few = stop.with_max_iterations(stop.max_iterations.min(HAND_OVER.cycles));
            let mut continued = self.newton.solve(problem, state, &few)?;
            if continued.status == Status::Converged {
                continued.solver = SolverId::MultigridThenNewton;
                return Ok(continued.preceded_by(before));
            }
            before = continued.preceded_by(before);
        }
        if let Some(given) = &self.kept {
            state.clone_from(given);
        }
        // From the given state.
        let mut second = self.newton_then_sweeps(problem, state, stop)?.preceded_by(before);
        if too_coarse && second.status != Status::Converged {
            second.status = Status::MeshTooCoarse;
        }
        Ok(second)
    }

    /// Newton's method, then sweeps if it did not converge and no solids touch; the better state is kept.
    fn newton_then_sweeps(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        let first = self.newton.solve(problem, state, stop)?;
        if first.status == Status::Converged || state.in_contact.contains(&true) {
            return Ok(first);
        }
        // A full film: sweeps may still converge.
        let kept = self.kept.get_or_insert_with(|| state.clone());
        kept.clone_from(state);
        let second = self.sweeps.solve(problem, state, stop)?;
        // The better of both states.
        let off_load = second.residual.load > first.residual.load.max(stop.tolerance);
        if second.residual.max() <= first.residual.max() && !off_load {
            return Ok(second.preceded_by(first));
        }
        state.clone_from(kept);
        Ok(first.followed_by(second))
    }
}
