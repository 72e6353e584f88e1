//! One quasi-static contact: the pieces that stay fixed while surfaces change, and its solution in numbers.
//!
//! The solver, the elastic bodies and the oil are made once; load, speeds and temperature change from step to
//! step by [`ContactModel::put_under`]. [`ContactModel::solve`] changes nothing but the state that it is
//! given, the flow of the box and the flows through the cells.

use std::sync::atomic::Ordering;

use crate::elastic::{HalfSpace, LayeredHalfSpace, LineHalfSpace, WithLocalCompliance};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::{DensityLaw, Lubricant, ViscosityLaw};
use crate::report::{SolveReport, Status};
use crate::reynolds::{
    Cavitation, ContactDefinition, ContactState, EdgePressure, Evaluation, FaceMobility, FilmFlows,
    FlowBalance, LubricatedContact, ReynoldsError, Scheme, ShearThinning, Squeeze, StoppingRule,
    require_spin,
};
use crate::sim::contact::boxed_clone::{OwnedModel, OwnedSolver};
use crate::sim::contact::compliant_films::CompliantFilms;
use crate::sim::contact::far_field::{FarField, Inlet};
use crate::sim::contact::formula::{FormulaFilm, formula_film, stated_film};
use crate::sim::contact::interrupt::{Interrupt, Interruptible};
use crate::sim::contact::{custom_laws, film_heat, setup};
use crate::sim::error::SimError;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::operating_schedule::{Conditions, OperatingSchedule};
use crate::sim::scene::{InletSpec, Motion, PlasticSpec, Scene};

/// Residuals over the tolerance up to which a solver from outside has converged: films carry the rounding of
/// another sum.
const CONFIRMED: f64 = 2.0;

/// Grid, elastic body, lubricant, load and solver of a scene.
#[derive(Debug, Clone)]
pub(in crate::sim) struct ContactModel {
    /// Grid of all fields.
    pub(in crate::sim) grid: Grid,
    /// Hertz contact of the smooth bodies under the load.
    pub(in crate::sim) hertz: HertzContact,
    /// Gap of the smooth, undeformed bodies \[m\].
    pub(in crate::sim) form_gap: Vec<f64>,
    /// Elastic bodies, asked once an iteration whether the solve is to end, and tribofilms.
    pub(in crate::sim) deformation: WithLocalCompliance<Interruptible>,
    /// Tribofilms with elastic constants of their own; none where they give way as the bodies do.
    pub(in crate::sim) films: Option<CompliantFilms>,
    /// The oil at its bulk temperature; none for a dry contact.
    pub(in crate::sim) lubricant: Option<Lubricant>,
    /// The solver of the scene, or that of the user.
    pub(in crate::sim) solver: Box<dyn OwnedSolver>,
    /// Whether the solver is one of the user's, whose states are evaluated before they count.
    pub(in crate::sim) confirms: bool,
    /// Tolerance and largest number of iterations.
    pub(in crate::sim) rule: StoppingRule,
    /// Discretisation of entrainment.
    pub(in crate::sim) scheme: Scheme,
    /// Law of the pressure flow through a face.
    pub(in crate::sim) face_mobility: FaceMobility,
    /// What becomes of the fluid where its pressure would fall below zero.
    pub(in crate::sim) cavitation: Cavitation,
    /// Film that the inlet gets \[m\]; none where it is flooded.
    pub(in crate::sim) supplied_film: Option<f64>,
    /// What sliding leaves of the viscosity for the flow by pressure; none where that is not modelled.
    pub(in crate::sim) shear_thinning: Option<ShearThinning>,
    /// Film at which solids touch \[m\].
    pub(in crate::sim) film_cutoff: f64,
    /// What solid contact is.
    pub(in crate::sim) contact: ContactDefinition,
    /// Entrainment speed and slide-roll ratio.
    pub(in crate::sim) motion: Motion,
    /// Load that was asked for; that of the Hertz contact is rounded \[N\].
    pub(in crate::sim) load: f64,
    /// That of the lubricant \[K\].
    pub(in crate::sim) bulk_temperature: f64,
    /// Film formulas of the smooth contact; none without lubricant.
    pub(in crate::sim) formulas: Option<FormulaFilm>,
    /// Central film by formula, by the pressure-viscosity coefficient that is stated for it; zero without
    /// lubricant \[m\].
    pub(in crate::sim) stated_film: f64,
    /// Measures the flow of solutions, and evaluates those of solvers from outside; made when it is first used.
    pub(in crate::sim) evaluation: Option<Evaluation>,
    /// Whether another solve follows: the solver keeps its buffers for it.
    pub(in crate::sim) reuses_buffers: bool,
    /// Flow into the last solution and out of it.
    pub(in crate::sim) flow: Option<FlowBalance>,
    /// Flows through the cells of the last solution; none where films have the bulk temperature.
    pub(in crate::sim) film_flows: Option<FilmFlows>,
    /// Finds the fluid outside of the box; none where the oil begins at its edge.
    pub(in crate::sim) inlet: Option<Inlet>,
    /// The fluid outside of the box; none where the box holds the inlet.
    pub(in crate::sim) far_field: Option<FarField>,
}

/// What changes of a contact model from step to step.
#[derive(Debug, Clone, Copy)]
pub(in crate::sim) struct SavedConditions {
    /// Hertz contact under the load.
    hertz: HertzContact,
    /// Entrainment speed and slide-roll ratio.
    motion: Motion,
    /// Film formulas.
    formulas: Option<FormulaFilm>,
    /// Central film by formula \[m\].
    stated_film: f64,
    /// Load that was asked for \[N\].
    load: f64,
    /// What sliding leaves of the viscosity for the flow by pressure.
    shear_thinning: Option<ShearThinning>,
    /// Temperature of the lubricant \[K\].
    bulk_temperature: f64,
    /// Flow of the last solution.
    flow: Option<FlowBalance>,
}

/// What a user puts in place of the scene's own parts.
#[derive(Debug, Default)]
pub(in crate::sim) struct CustomComponents {
    /// Elastic bodies in place of the half-space.
    pub(in crate::sim) deformation: Option<Box<dyn OwnedModel>>,
    /// Viscosity law in place of that of the scene.
    pub(in crate::sim) viscosity: Option<Box<dyn ViscosityLaw>>,
    /// Density law in place of that of the scene.
    pub(in crate::sim) density: Option<Box<dyn DensityLaw>>,
    /// Solver in place of that of the scene; what it calls converged is evaluated before it counts.
    pub(in crate::sim) solver: Option<Box<dyn OwnedSolver>>,
    /// What may end a solve early.
    pub(in crate::sim) interrupt: Option<Interrupt>,
}

impl ContactModel {
    /// The contact of `scene` at the start of its schedule, with `overrides` in place of its parts.
    ///
    /// # Errors
    /// A scene out of range; a grid that does not hold the contact; parts that do not fit the scene.
    pub(in crate::sim) fn new(scene: &Scene, custom: CustomComponents) -> Result<Self, SimError> {
        setup::validate(scene)?;
        let grid = scene.grid()?;
        let operating_schedule = OperatingSchedule::new(scene)?;
        let conditions = operating_schedule.at(0.0);
        let hertz = scene.hertz()?;
        setup::validate_box(&grid, &hertz, scene.form.is_line())?;
        if let Some(radius) = scene.motion.spin_radius {
            let supplied = scene.lubricant.is_some_and(|lubricant| lubricant.supplied_film.is_some());
            let is_paper = scene.solver.contact == ContactDefinition::UnifiedReynolds;
            require_spin(("motion.spin_radius", radius), &grid, supplied, is_paper)?;
        }
        setup::validate_film_cutoff(scene)?;
        setup::validate_memory(&grid, scene.is_lubricated())?;
        let mut form_gap = vec![0.0; grid.len()];
        scene.form.gap_into(&grid, &mut form_gap)?;
        let has_own_body = custom.deformation.is_some();
        let deformation = checked_deformation(scene, grid, custom.deformation)?;
        let deformation = WithLocalCompliance::new(Interruptible::new(deformation, custom.interrupt));
        let missing = [("viscosity", custom.viscosity.is_some()), ("density", custom.density.is_some())];
        if let (None, Some((law, _))) = (&scene.lubricant, missing.iter().find(|(_, given)| *given)) {
            return Err(SimError::Input(InputError::Conflict {
                field: (*law).to_owned(),
                reason: "a law is given, but the scene has no lubricant".to_owned(),
            }));
        }
        let temperature = conditions.bulk_temperature;
        let viscosity = match custom.viscosity {
            None => setup::viscosity(scene, temperature)?,
            Some(law) => {
                let law = law.at_temperature(temperature).unwrap_or(law);
                custom_laws::require_viscosity(&*law, temperature)?;
                Some(law)
            }
        };
        let density = match custom.density {
            None => setup::density(scene, temperature)?,
            Some(law) => {
                let law = law.at_temperature(temperature).unwrap_or(law);
                custom_laws::require_density(&*law)?;
                Some(law)
            }
        };
        let lubricant = match (scene.is_lubricated(), viscosity, density) {
            (true, Some(viscosity), Some(density)) => Some(Lubricant::from_boxed(viscosity, density)),
            _ => None,
        };
        let law = lubricant.as_ref().map(Lubricant::viscosity);
        film_heat::validate(scene, law)?;
        let is_flooded = scene.lubricant.is_some_and(|oil| oil.inlet == InletSpec::Flooded);
        let inlet = is_flooded.then(|| Inlet::new(scene, has_own_body));
        let formulas = formula_film(scene, &hertz, conditions.motion.entrainment_speed, law, None)?;
        let stated_film = stated_film(scene, &hertz, &conditions, law)?;
        Ok(Self {
            formulas,
            stated_film,
            evaluation: None,
            reuses_buffers: true,
            flow: None,
            film_flows: film_heat::is_asked(scene).then(FilmFlows::default),
            grid,
            hertz,
            form_gap,
            deformation,
            films: CompliantFilms::of(scene, grid.len())?,
            lubricant,
            confirms: custom.solver.is_some(),
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

    /// The Hertz contact under `load` \[N\].
    pub(in crate::sim) fn hertz_under(&self, scene: &Scene, load: f64) -> Result<HertzContact, InputError> {
        if load.to_bits() == self.load.to_bits() { Ok(self.hertz) } else { scene.hertz_under(load) }
    }

    /// Takes over the load and the speeds of `conditions`.
    pub(in crate::sim) fn set_conditions(
        &mut self,
        scene: &Scene,
        conditions: &Conditions,
    ) -> Result<(), InputError> {
        let temperature = conditions.bulk_temperature;
        let warmed = temperature.to_bits() != self.bulk_temperature.to_bits();
        let same = conditions.motion == self.motion && conditions.load.to_bits() == self.load.to_bits();
        if same && !warmed {
            return Ok(());
        }
        self.warm_to(temperature);
        let (hertz, motion) = (self.hertz_under(scene, conditions.load)?, conditions.motion);
        let law = self.lubricant.as_ref().map(Lubricant::viscosity);
        let formulas = formula_film(scene, &hertz, motion.entrainment_speed, law, None)?;
        let stated_film = stated_film(scene, &hertz, conditions, law)?;
        let shear_thinning = scene.friction.shear_thinning(motion.sliding_speed())?;
        (self.hertz, self.motion, self.formulas, self.stated_film) = (hertz, motion, formulas, stated_film);
        (self.load, self.shear_thinning) = (conditions.load, shear_thinning);
        Ok(())
    }

    /// Takes the lubricant to a bulk `temperature` \[K\].
    fn warm_to(&mut self, temperature: f64) {
        if temperature.to_bits() != self.bulk_temperature.to_bits() {
            self.lubricant = self.lubricant.take().map(|lubricant| lubricant.at_temperature(temperature));
            self.bulk_temperature = temperature;
        }
    }

    /// What [`ContactModel::put_under`] changes, and the flow of the box, which [`ContactModel::solve`] does.
    pub(in crate::sim) fn saved(&self) -> SavedConditions {
        SavedConditions {
            hertz: self.hertz,
            motion: self.motion,
            formulas: self.formulas,
            stated_film: self.stated_film,
            load: self.load,
            shear_thinning: self.shear_thinning,
            bulk_temperature: self.bulk_temperature,
            flow: self.flow,
        }
    }

    /// Puts back what another contact has changed.
    pub(in crate::sim) fn restore_conditions(&mut self, before: SavedConditions) {
        self.hertz = before.hertz;
        self.motion = before.motion;
        self.formulas = before.formulas;
        self.stated_film = before.stated_film;
        self.load = before.load;
        self.shear_thinning = before.shear_thinning;
        self.warm_to(before.bulk_temperature);
        self.flow = before.flow;
    }

    /// Central film of the smooth contact by formula; zero without lubricant \[m\].
    pub(in crate::sim) fn formula_film(&self) -> f64 {
        self.formulas.map_or(0.0, |formulas| formulas.central)
    }

    /// The contact with the undeformed gap `gap`, pressure limit `limit` and squeeze term `squeeze`, what
    /// solves it and what measures it.
    fn problem<'a>(
        &'a mut self,
        gap: &'a [f64],
        limit: Option<&'a [f64]>,
        squeeze: Option<Squeeze<'a>>,
        edge_pressure: Option<EdgePressure<'a>>,
    ) -> (LubricatedContact<'a>, &'a mut Box<dyn OwnedSolver>, &'a mut Option<Evaluation>) {
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
            reference_half_widths: self.hertz.half_extents().into(),
            reference_pressure: self.hertz.pressure,
            reference_film,
        };
        (problem, &mut self.solver, &mut self.evaluation)
    }

    /// Refuses what [`ContactModel::solve`] refuses before the first iteration.
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

    /// Solves the contact with the undeformed gap `gap`, pressure limit `limit` and squeeze term `squeeze`,
    /// from `state`.
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

    /// The same with ambient or other pressure at the edge of the box.
    fn solve_box(
        &mut self,
        gap: &[f64],
        limit: Option<&[f64]>,
        (squeeze, edge): (Option<Squeeze<'_>>, Option<EdgePressure<'_>>),
        state: &mut ContactState,
    ) -> Result<SolveReport, SimError> {
        let (heeded, rule, confirms) = (self.deformation.bodies().begin(), self.rule, self.confirms);
        let reuses_buffers = self.reuses_buffers;
        let mut film_flows = self.film_flows.take();
        let (mut problem, solver, evaluation) = self.problem(gap, limit, squeeze, edge);
        let mut solved = solver.solve(&mut problem, state, &rule);
        if !reuses_buffers {
            // A copy has no buffers yet.
            *solver = solver.clone();
        }
        let is_measured = problem.lubricant.is_some() || confirms;
        let mut evaluation =
            is_measured.then(|| evaluation.get_or_insert_with(|| Evaluation::new(problem.grid())));
        if let (Some(evaluation), true) = (&mut evaluation, confirms) {
            solved = solved.and_then(|report| confirmed(report, evaluation, &mut problem, state, &rule));
        }
        let interrupted = heeded.load(Ordering::Relaxed);
        // A solve that diverged may leave a state without numbers, which has no flow.
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
        self.flow = measured?;
        Ok(report)
    }
}

/// The report of a solver from outside with the residuals that its state has. Films, plastic depths and
/// masses of the state are then those that follow from its pressures.
fn confirmed(
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
    // No number is no solution either.
    let holds = residual.max() <= CONFIRMED * rule.tolerance && residual.is_finite();
    let status = if holds { Status::Converged } else { Status::Unverified };
    Ok(SolveReport { status, residual, ..report })
}

/// Checks that the grid and the hardness of `plastic`, if any, do for the smallest and the largest load of
/// the schedule.
pub(in crate::sim) fn validate_loads(
    scene: &Scene,
    plastic: Option<PlasticSpec>,
    grid: &Grid,
    operating_schedule: &OperatingSchedule,
) -> Result<(), InputError> {
    if scene.schedule.load.is_none() {
        return Ok(());
    }
    for load in operating_schedule.loads() {
        let hertz = scene.hertz_under(load)?;
        setup::validate_box(grid, &hertz, scene.form.is_line())?;
        if let Some(plastic) = plastic {
            let [ball, disc] = scene.hardnesses(plastic.hardness);
            setup::validate_hardness(ball.min(disc), grid, &hertz)?;
        }
    }
    Ok(())
}

/// The elastic model in place of that of the scene, or that of the scene; it must live on the grid and have a
/// stiffness.
fn checked_deformation(
    scene: &Scene,
    grid: Grid,
    own: Option<Box<dyn OwnedModel>>,
) -> Result<Box<dyn OwnedModel>, SimError> {
    let own_deformation = own.is_some();
    let deformation = match own {
        Some(model) if model.grid() != grid => {
            return Err(SimError::Input(InputError::Conflict {
                field: "deformation".to_owned(),
                reason: "the model lives on another grid than the scene".to_owned(),
            }));
        }
        Some(model) => model,
        None => half_space(scene, grid, scene.form.radii().0.max(grid.size_x()))?,
    };
    let influence = deformation.influence(0, 0);
    if !influence.is_normal() || influence < 0.0 {
        return Err(SimError::Input(InputError::Conflict {
            field: if own_deformation { "deformation" } else { "grid" }.to_owned(),
            reason: format!(
                "a cell of {:.3e} x {:.3e} m deflects by {influence:e} m under a pressure of 1 Pa, which must be a \
                 positive number and no subnormal one",
                grid.dx(),
                grid.dy()
            ),
        }));
    }
    Ok(deformation)
}

/// The elastic bodies of the scene. Displacements of a line contact count from the distance `reference` \[m\].
pub(in crate::sim) fn half_space(
    scene: &Scene,
    grid: Grid,
    reference: f64,
) -> Result<Box<dyn OwnedModel>, InputError> {
    let modulus = scene.equivalent_modulus()?;
    Ok(match (scene.layer()?, scene.form.is_line()) {
        (None, false) => Box::new(HalfSpace::new(grid, modulus)?),
        (None, true) => Box::new(LineHalfSpace::new(grid, modulus, reference)?),
        (Some(layer), false) => Box::new(LayeredHalfSpace::new(grid, modulus, layer)?),
        (Some(layer), true) => Box::new(LayeredHalfSpace::plane_strain(grid, modulus, layer, reference)?),
    })
}
