//! The model of one quasi-static contact: parts that stay fixed while surfaces change, and its solution.
//!
//! Solver, elastic bodies and lubricant are built once. Load, speeds and temperature change from step to step by
//! [`ContactModel::set_conditions`]. [`ContactModel::solve`] changes only the given state, the flow balance of the box
//! and the flows through the cells.

use std::sync::atomic::Ordering;

use crate::elastic::WithLocalCompliance;
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::report::{SolveReport, Status};
use crate::reynolds::{
    Cavitation, ContactDefinition, ContactState, EdgePressure, Evaluation, FaceMobility, FilmFlows,
    FlowBalance, LubricatedContact, ReynoldsError, Scheme, ShearThinning, Squeeze, StoppingRule,
};
use crate::sim::contact::boxed_clone::OwnedSolver;
use crate::sim::contact::compliant_films::CompliantFilms;
use crate::sim::contact::components::{CustomComponents, checked_deformation, lubricant, validated_grid};
use crate::sim::contact::far_field::{FarField, Inlet};
use crate::sim::contact::formula::{FormulaFilm, formula_film, stated_film};
use crate::sim::contact::interrupt::Interruptible;
use crate::sim::contact::{film_temperature, setup};
use crate::sim::error::SimError;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::operating_schedule::OperatingSchedule;
use crate::sim::scene::{InletSpec, Motion, Scene};
use crate::solver_id::SolverId;

/// Residual over tolerance up to which a custom solver counts as converged: its films are rounded differently.
const VERIFIED: f64 = 2.0;

/// Grid, elastic bodies, lubricant, load and solver of a scene.
#[derive(Debug, Clone)]
pub(in crate::sim) struct ContactModel {
    /// Grid of all fields.
    pub(in crate::sim) grid: Grid,
    /// Hertz contact of the smooth bodies under the load; of a strip that of one period.
    pub(in crate::sim) hertz: HertzContact,
    /// Gap of the smooth, undeformed bodies \[m\].
    pub(in crate::sim) form_gap: Vec<f64>,
    /// Elastic bodies with interrupt, and compliant tribofilms.
    pub(in crate::sim) deformation: WithLocalCompliance<Interruptible>,
    /// Compliant tribofilms; `None` if they are as stiff as the bodies.
    pub(in crate::sim) films: Option<CompliantFilms>,
    /// The oil at its bulk temperature; `None` for a dry contact.
    pub(in crate::sim) lubricant: Option<Lubricant>,
    /// The solver.
    pub(in crate::sim) solver: Box<dyn OwnedSolver>,
    /// Whether the solver is a custom one, whose solutions are verified.
    pub(in crate::sim) verifies: bool,
    /// Tolerance and largest number of iterations.
    pub(in crate::sim) rule: StoppingRule,
    /// Entrainment scheme.
    pub(in crate::sim) scheme: Scheme,
    /// Law of the pressure flow through a face.
    pub(in crate::sim) face_mobility: FaceMobility,
    /// Cavitation condition.
    pub(in crate::sim) cavitation: Cavitation,
    /// Film supplied at the inlet \[m\]; `None` for a flooded inlet.
    pub(in crate::sim) supplied_film: Option<f64>,
    /// Shear-thinned viscosity of the pressure flow; `None` for a Newtonian flow.
    pub(in crate::sim) shear_thinning: Option<ShearThinning>,
    /// Contact film \[m\].
    pub(in crate::sim) film_cutoff: f64,
    /// Definition of solid contact.
    pub(in crate::sim) contact: ContactDefinition,
    /// Entrainment speed and slide-roll ratio.
    pub(in crate::sim) motion: Motion,
    /// Requested load; that of the Hertz contact is rounded \[N\].
    pub(in crate::sim) load: f64,
    /// Bulk temperature of the lubricant \[K\].
    pub(in crate::sim) bulk_temperature: f64,
    /// Film formulas for the smooth contact; `None` without lubricant.
    pub(in crate::sim) formulas: Option<FormulaFilm>,
    /// Central film by formula with the stated pressure-viscosity coefficient; zero without lubricant \[m\].
    pub(in crate::sim) stated_film: f64,
    /// Evaluates flows of solutions, and states of custom solvers; built at its first use.
    pub(in crate::sim) evaluation: Option<Evaluation>,
    /// Whether the solver keeps its buffers for a further solve.
    pub(in crate::sim) reuses_buffers: bool,
    /// Flow balance of the last solution, per metre for a line contact.
    pub(in crate::sim) flow: Option<FlowBalance>,
    /// Flows through the cells of the last solution; `None` for isothermal films.
    pub(in crate::sim) film_flows: Option<FilmFlows>,
    /// Computes the far field; `None` for an oil supply at the edge of the box.
    pub(in crate::sim) inlet: Option<Inlet>,
    /// The far field; `None` if the box contains the inlet.
    pub(in crate::sim) far_field: Option<FarField>,
}

impl ContactModel {
    /// The contact of `scene` at the start of its schedule, with `custom` components in place of its parts.
    ///
    /// # Errors
    /// A scene out of range; a grid that does not contain the contact; components that do not fit the scene.
    pub(in crate::sim) fn new(scene: &Scene, custom: CustomComponents) -> Result<Self, SimError> {
        let grid = validated_grid(scene)?;
        let operating_schedule = OperatingSchedule::new(scene)?;
        let conditions = operating_schedule.at(0.0);
        let hertz = scene.hertz()?;
        let mut form_gap = vec![0.0; grid.len()];
        scene.form.gap_into(&grid, &mut form_gap)?;
        let has_own_body = custom.deformation.is_some();
        let deformation = checked_deformation(scene, grid, custom.deformation)?;
        let deformation = WithLocalCompliance::new(Interruptible::new(deformation, custom.interrupt));
        let laws = (custom.viscosity, custom.density);
        let lubricant = lubricant(scene, conditions.bulk_temperature, laws)?;
        let law = lubricant.as_ref().map(Lubricant::viscosity);
        film_temperature::validate_film_temperature(scene, law)?;
        let is_flooded = scene.lubricant.is_some_and(|oil| oil.inlet == InletSpec::Flooded);
        let inlet = (is_flooded && scene.solver.model.is_resolved()).then(|| Inlet::new(scene, has_own_body));
        let formulas = formula_film(scene, &hertz, conditions.motion.entrainment_speed, law, None)?;
        let stated_film = stated_film(scene, &hertz, &conditions, law)?;
        Ok(Self {
            formulas,
            stated_film,
            evaluation: None,
            reuses_buffers: true,
            flow: None,
            film_flows: film_temperature::models_film_temperature(scene).then(FilmFlows::default),
            grid,
            hertz: hertz.on(&grid),
            form_gap,
            deformation,
            films: CompliantFilms::of(scene, grid.len())?,
            lubricant,
            verifies: custom.solver.is_some() && !custom.is_checked,
            solver: custom.solver.map_or_else(|| setup::solver(scene), Ok)?,
            rule: setup::stopping_rule(scene)?,
            scheme: scene.scheme(),
            face_mobility: scene.face_mobility(),
            cavitation: scene.cavitation(),
            supplied_film: scene.lubricant.and_then(|lubricant| lubricant.supplied_film),
            shear_thinning: scene.friction.shear_thinning(conditions.motion.sliding_speed())?,
            film_cutoff: scene.solver.film_cutoff,
            contact: scene.solver.contact,
            inlet,
            far_field: None,
            motion: conditions.motion,
            load: conditions.load,
            bulk_temperature: conditions.bulk_temperature,
        })
    }

    /// Sets the tribofilms of ball and disc \[m\] as placed in the contact, for the next solves.
    pub(in crate::sim) fn set_tribofilms(&mut self, films: &[Vec<f64>; 2]) -> Result<(), InputError> {
        match &mut self.films {
            Some(compliant) => compliant.add_to(&mut self.deformation, films),
            None => Ok(()),
        }
    }

    /// Central film of the smooth contact by the formula of its regime; zero without lubricant \[m\].
    pub(in crate::sim) fn formula_film(&self) -> f64 {
        self.formulas.map_or(0.0, |formulas| formulas.central)
    }

    /// The contact problem with the undeformed gap `gap`, pressure limit `limit` and squeeze term `squeeze`; its solver
    /// and its evaluation.
    fn problem<'a>(
        &'a mut self,
        gap: &'a [f64],
        limit: Option<&'a [f64]>,
        squeeze: Option<Squeeze<'a>>,
        edge_pressure: Option<EdgePressure<'a>>,
    ) -> (LubricatedContact<'a>, &'a mut Box<dyn OwnedSolver>, &'a mut Option<Evaluation>) {
        let [half_x, half_y] = self.hertz.half_extents();
        let half_y = if self.grid.is_strip() { 0.5 * self.grid.size_y() } else { half_y };
        let reference_film = self.formula_film().min(self.supplied_film.unwrap_or(f64::INFINITY));
        let problem = LubricatedContact {
            gap,
            deformation: &mut self.deformation,
            lubricant: self.lubricant.as_ref(),
            entrainment_speed: self.motion.entrainment_speed,
            spin_radius: self.motion.spin_radius,
            squeeze,
            load: self.hertz.force,
            pressure_limit: limit,
            film_cutoff: self.film_cutoff,
            contact: self.contact,
            scheme: self.scheme,
            face_mobility: self.face_mobility,
            cavitation: self.cavitation,
            supplied_film: self.supplied_film,
            edge_pressure,
            shear_thinning: self.shear_thinning,
            reference_half_widths: (half_x, half_y),
            reference_pressure: self.hertz.pressure,
            reference_film,
        };
        (problem, &mut self.solver, &mut self.evaluation)
    }

    /// Returns the input errors of [`ContactModel::solve`] without solving.
    pub(in crate::sim) fn check(
        &mut self,
        gap: &[f64],
        limit: Option<&[f64]>,
        state: &ContactState,
    ) -> Result<(), ReynoldsError> {
        let rule = self.rule;
        let (problem, solver, _) = self.problem(gap, limit, None, None);
        solver.check(&problem, state, &rule)
    }

    /// Solves the contact with the undeformed gap `gap`, pressure limit `limit` and squeeze term `squeeze`, from `state`.
    pub(in crate::sim) fn solve(
        &mut self,
        gap: &[f64],
        limit: Option<&[f64]>,
        squeeze: Option<Squeeze<'_>>,
        state: &mut ContactState,
    ) -> Result<SolveReport, SimError> {
        let Some(mut far) = self.far_field.take() else {
            return self.solve_box(gap, limit, (squeeze, None), state);
        };
        let grid = self.grid;
        let smooth = self.face_mobility == FaceMobility::Wedge;
        let solved = far.solve(&grid, gap, smooth, state, |edge, gap, state| {
            self.solve_box(gap, limit, (squeeze, Some(edge)), state)
        });
        self.far_field = Some(far);
        solved
    }

    /// Solves with ambient or given pressure at the edge of the box.
    fn solve_box(
        &mut self,
        gap: &[f64],
        limit: Option<&[f64]>,
        (squeeze, edge): (Option<Squeeze<'_>>, Option<EdgePressure<'_>>),
        state: &mut ContactState,
    ) -> Result<SolveReport, SimError> {
        let (was_interrupted, rule, verifies) = (self.deformation.bodies().begin(), self.rule, self.verifies);
        let reuses_buffers = self.reuses_buffers;
        let mut film_flows = self.film_flows.take();
        let (mut problem, solver, evaluation) = self.problem(gap, limit, squeeze, edge);
        let mut solved = solver.solve(&mut problem, state, &rule);
        if !reuses_buffers {
            // A clone has no buffers.
            *solver = solver.clone();
        }
        if was_interrupted.load(Ordering::Relaxed) {
            self.film_flows = film_flows;
            return Err(SimError::Interrupted);
        }
        let is_law = solver.id() == SolverId::AsperityInlets;
        let is_measured = (problem.lubricant.is_some() && !is_law) || verifies;
        let mut evaluation =
            is_measured.then(|| evaluation.get_or_insert_with(|| Evaluation::new(problem.grid())));
        if let (Some(evaluation), true) = (&mut evaluation, verifies) {
            solved = solved.and_then(|report| verified(report, evaluation, &mut problem, state, &rule));
        }
        let interrupted = was_interrupted.load(Ordering::Relaxed);
        // The state of a solve that diverged may be invalid, without a flow.
        let is_state = state.validate(&problem.grid()).is_ok();
        let measured = match (&solved, evaluation) {
            (Ok(_), Some(evaluation)) if !interrupted && is_state => match &mut film_flows {
                Some(flows) => evaluation.film_flows(&problem, state, flows),
                None => evaluation.flow_balance(&problem, state),
            },
            _ => Ok(None),
        };
        self.film_flows = film_flows;
        if interrupted {
            return Err(SimError::Interrupted);
        }
        let report = solved?;
        let length = self.grid.contact_length();
        self.flow = measured?.map(|flow| FlowBalance {
            inflow: flow.inflow / length,
            outflow: flow.outflow / length,
            ..flow
        });
        Ok(report)
    }
}

/// The report of a custom solver with the evaluated residuals of its state. Films, plastic depths and masses of the
/// state are overwritten with those of its pressures.
fn verified(
    report: SolveReport,
    evaluation: &mut Evaluation,
    problem: &mut LubricatedContact<'_>,
    state: &mut ContactState,
    rule: &StoppingRule,
) -> Result<SolveReport, ReynoldsError> {
    if report.status != Status::Converged {
        return Ok(report);
    }
    let residual = evaluation.evaluate(problem, state)?;
    // NaN does not count as converged.
    let holds = residual.max() <= VERIFIED * rule.tolerance && residual.is_finite();
    let status = if holds { Status::Converged } else { Status::Unverified };
    Ok(SolveReport { status, residual, ..report })
}
