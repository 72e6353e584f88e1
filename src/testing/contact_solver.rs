//! The contract of contact solvers.
//!
//! The case is a smooth steel ball of 9.525 mm on a plane at a Hertz pressure of 0.5 GPa and 5 m/s, on 48 x
//! 48 nodes over four Hertz radii. It is easy to solve, and the dry limit is known.

use super::{Contract, Violation, close};
use crate::analytic::HertzPoint;
use crate::elastic::HalfSpace;
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::{DowsonHigginson, Lubricant, Roelands};
use crate::report::{SolveReport, Status};
use crate::reynolds::{
    ContactSolver, ContactState, FaceMobility, LubricatedContact, ReynoldsError, Scheme, StoppingRule,
};
use crate::surface::Form;

/// Nodes along each axis.
const NODES: usize = 48;
/// Radius of the ball \[m\].
const RADIUS: f64 = 9.525e-3;
/// Equivalent modulus of the half-space \[Pa\].
const MODULUS: f64 = 230e9;
/// Hertz pressure \[Pa\].
const HERTZ_PRESSURE: f64 = 0.5e9;
/// Entrainment speed \[m/s\].
const SPEED: f64 = 5.0;
/// Contact film \[m\].
const CUTOFF: f64 = 1e-9;

/// Checks `solver` against the contract of [`ContactSolver`] on a smooth steel ball at 0.5 GPa, dry or with a
/// thick oil film (`lubricated`). The solve converges with residuals within the rule; the pressure is
/// non-negative, carries the load and is Hertzian; a restart from the solution stays there; zero iterations
/// are not convergence; invalid input is rejected.
///
/// # Errors
/// The first violation.
///
/// ```
/// stribeck::testing::contact_solver(&mut stribeck::reynolds::Dry::new(), false)?;
/// # Ok::<(), stribeck::testing::Violation>(())
/// ```
pub fn contact_solver(solver: &mut dyn ContactSolver, lubricated: bool) -> Result<(), Violation> {
    let contract = Contract::of(&solver.id().to_string());
    let case = Case::new(lubricated).map_err(|error| contract.broken("the case is valid", error.to_string()));
    let mut case = case?;
    let rule = StoppingRule::default();
    let mut state = ContactState::new(&case.grid);
    let report = case.solve(&contract, solver, &mut state, &rule)?;
    case.check_solution(&contract, &state, &report, &rule)?;
    let again = case.solve(&contract, solver, &mut state, &rule)?;
    contract.require(
        again.status == Status::Converged && again.work.iterations <= report.work.iterations,
        "a restart from the solution is no harder than the solve",
        || format!("{again:?} after {report:?}"),
    )?;
    case.check_solution(&contract, &state, &again, &rule)?;
    case.check_refusals(&contract, solver, &rule)
}

/// A smooth ball on a plane, dry or lubricated.
struct Case {
    /// The grid.
    grid: Grid,
    /// Hertz contact of the bodies.
    hertz: HertzPoint,
    /// Undeformed gap \[m\].
    gap: Vec<f64>,
    /// Elastic bodies.
    body: HalfSpace,
    /// The oil; `None` for the dry case.
    lubricant: Option<Lubricant>,
}

impl Case {
    /// The case, with an oil of 40 mPa s where it is `lubricated`.
    fn new(lubricated: bool) -> Result<Self, InputError> {
        let hertz = HertzPoint::from_max_pressure(RADIUS, RADIUS, MODULUS, HERTZ_PRESSURE)?;
        let spacing = 4.0 * hertz.half_width_x / NODES as f64;
        let grid = Grid::centred(NODES, NODES, spacing, spacing)?;
        let mut gap = vec![0.0; grid.len()];
        Form::Sphere { radius: RADIUS }.gap_into(&grid, &mut gap)?;
        let oil = || -> Result<Lubricant, InputError> {
            Ok(Lubricant::new(Roelands::new(0.04, 0.6, 1.96e8)?, DowsonHigginson::new(0.6e-9, 1.7e-9)?))
        };
        let lubricant = if lubricated { Some(oil()?) } else { None };
        Ok(Self { grid, hertz, gap, body: HalfSpace::new(grid, MODULUS)?, lubricant })
    }

    /// Solves the case.
    fn try_solve(
        &mut self,
        solver: &mut dyn ContactSolver,
        state: &mut ContactState,
        rule: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        let mut problem = LubricatedContact {
            gap: &self.gap,
            deformation: &mut self.body,
            lubricant: self.lubricant.as_ref(),
            entrainment_speed: SPEED,
            spin_radius: None,
            squeeze: None,
            load: self.hertz.force,
            pressure_limit: None,
            film_cutoff: CUTOFF,
            contact: Default::default(),
            scheme: Scheme::default(),
            face_mobility: FaceMobility::default(),
            cavitation: Default::default(),
            supplied_film: None,
            edge_pressure: None,
            shear_thinning: None,
            reference_half_widths: (self.hertz.half_width_x, self.hertz.half_width_y),
            reference_pressure: self.hertz.pressure,
            reference_film: if self.lubricant.is_some() { 400e-9 } else { 0.0 },
        };
        solver.solve(&mut problem, state, rule)
    }

    /// Solves the valid case; an error is a violation.
    fn solve(
        &mut self,
        contract: &Contract,
        solver: &mut dyn ContactSolver,
        state: &mut ContactState,
        rule: &StoppingRule,
    ) -> Result<SolveReport, Violation> {
        self.try_solve(solver, state, rule)
            .map_err(|error| contract.broken("a smooth contact can be solved", error.to_string()))
    }

    /// Checks residuals, load and signs of a converged solution.
    fn check_solution(
        &self,
        contract: &Contract,
        state: &ContactState,
        report: &SolveReport,
        rule: &StoppingRule,
    ) -> Result<(), Violation> {
        contract.require(report.status == Status::Converged, "a smooth contact converges", || {
            format!("{report:?}")
        })?;
        contract.require(
            report.residual.max() <= rule.tolerance,
            "converged residuals are within the rule",
            || format!("{report:?}"),
        )?;
        let load = state.pressure.iter().sum::<f64>() * self.grid.cell_area();
        contract.require(
            close(load, self.hertz.force, self.hertz.force, 2.0 * rule.tolerance),
            "pressure carries the load",
            || format!("{load} of {} N", self.hertz.force),
        )?;
        let cutoff = if self.lubricant.is_some() { CUTOFF } else { 0.0 };
        for (k, (&p, &fluid)) in state.pressure.iter().zip(&state.fluid_pressure).enumerate() {
            contract.require(
                p >= 0.0 && fluid >= 0.0 && fluid <= p * (1.0 + 1e-12),
                "fluid pressure lies between zero and the total",
                || format!("node {k}: {fluid} of {p} Pa"),
            )?;
            let h = state.film[k];
            contract.require(h > cutoff - 0.1 * CUTOFF, "surfaces do not interpenetrate", || {
                format!("node {k}: film {h:e} m")
            })?;
        }
        let peak = state.pressure.iter().copied().fold(0.0, f64::max) / self.hertz.pressure;
        // A thick film smooths the Hertz pressure and adds a pressure spike.
        let accepted = if self.lubricant.is_some() { 0.8..1.5 } else { 0.99..1.01 };
        contract.require(accepted.contains(&peak), "the largest pressure is that of Hertz", || {
            format!("{peak} of it")
        })
    }

    /// Checks that a state of another grid and a NaN tolerance are rejected, and that zero iterations are not
    /// convergence.
    fn check_refusals(
        &mut self,
        contract: &Contract,
        solver: &mut dyn ContactSolver,
        rule: &StoppingRule,
    ) -> Result<(), Violation> {
        let other = Grid::centred(NODES + 1, NODES, 1e-6, 1e-6);
        let other = other.map_err(|error| contract.broken("the case is valid", error.to_string()))?;
        let misfit = self.try_solve(solver, &mut ContactState::new(&other), rule);
        contract.require(misfit.is_err(), "a state of another grid is refused", || {
            "it was accepted".to_owned()
        })?;
        let lax = StoppingRule { tolerance: f64::NAN, ..*rule };
        let lax = self.try_solve(solver, &mut ContactState::new(&self.grid.clone()), &lax);
        contract.require(lax.is_err(), "a NaN tolerance is refused", || "it was accepted".to_owned())?;
        let short = StoppingRule { max_iterations: 0, ..*rule };
        let short = self.solve(contract, solver, &mut ContactState::new(&self.grid.clone()), &short)?;
        contract.require(short.status != Status::Converged, "zero iterations are not convergence", || {
            format!("{short:?}")
        })?;
        if let Some(height) = self.gap.get_mut(7) {
            *height = f64::NAN;
        }
        let broken = self.try_solve(solver, &mut ContactState::new(&self.grid.clone()), rule);
        contract.require(broken.is_err(), "a NaN gap is refused", || "it was accepted".to_owned())
    }
}
