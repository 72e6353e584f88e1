//! One quasi-static contact: the pieces that stay fixed while surfaces change, and its solution in numbers.

use super::accuracy::{self, ErrorEstimate};
use super::friction::{FrictionFields, FrictionShares, boundary_law};
use super::hertz::HertzContact;
use super::scene::{GridSpec, Motion, Scene};
use super::setup::FormulaFilm;
use super::timetable::{Conditions, Timetable};
use super::{SimError, setup};
use crate::elastic::{DeformationModel, HalfSpace, LineHalfSpace};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::{DensityLaw, Lubricant, ViscosityLaw};
use crate::metrics;
use crate::report::SolveReport;
use crate::reynolds::{
    Cavitation, ContactDefinition, ContactSolver, ContactState, Evaluation, FaceMobility, FlowBalance,
    LubricatedContact, Scheme, ShearThinning, Squeeze, StoppingRule, reaches_limit,
};

/// Grid, elastic body, lubricant, load and solver of a scene.
#[derive(Debug)]
pub(super) struct ContactModel {
    pub(super) grid: Grid,
    pub(super) hertz: HertzContact,
    /// Gap of the smooth, undeformed bodies \[m\].
    pub(super) form_gap: Vec<f64>,
    pub(super) deformation: Box<dyn DeformationModel>,
    pub(super) lubricant: Option<Lubricant>,
    pub(super) solver: Box<dyn ContactSolver>,
    rule: StoppingRule,
    scheme: Scheme,
    face_mobility: FaceMobility,
    cavitation: Cavitation,
    supplied_film: Option<f64>,
    shear_thinning: Option<ShearThinning>,
    film_cutoff: f64,
    contact: ContactDefinition,
    pub(super) motion: Motion,
    /// Load that was asked for; that of the Hertz contact is rounded \[N\].
    load: f64,
    /// Film formulas of the smooth contact; none without lubricant.
    formulas: Option<FormulaFilm>,
    /// Central film by formula, by the pressure-viscosity coefficient that is stated for it; zero without lubricant \[m\].
    pub(super) stated_film: f64,
    /// Measures the flow of solutions; none without lubricant.
    evaluation: Option<Evaluation>,
    /// That of the last one.
    pub(super) flow: Option<FlowBalance>,
}

/// What a user puts in place of the scene's own parts.
#[derive(Debug, Default)]
pub(super) struct Overrides {
    pub(super) deformation: Option<Box<dyn DeformationModel>>,
    pub(super) viscosity: Option<Box<dyn ViscosityLaw>>,
    pub(super) density: Option<Box<dyn DensityLaw>>,
    pub(super) solver: Option<Box<dyn ContactSolver>>,
}

impl ContactModel {
    pub(super) fn new(scene: &Scene, overrides: Overrides) -> Result<Self, SimError> {
        setup::validate(scene)?;
        let grid = scene.grid()?;
        let timetable = Timetable::new(scene)?;
        let conditions = timetable.at(0.0);
        let hertz = scene.hertz()?;
        setup::validate_box(&grid, &hertz, scene.form.is_line())?;
        for load in timetable.loads().into_iter().filter(|_| scene.schedule.load.is_some()) {
            let hertz = scene.hertz_under(load)?;
            setup::validate_box(&grid, &hertz, scene.form.is_line())?;
            if let Some(plastic) = scene.plastic {
                let [ball, disc] = scene.hardnesses(plastic.hardness);
                setup::validate_hardness(ball.min(disc), &grid, &hertz)?;
            }
        }
        setup::validate_film_cutoff(scene)?;
        setup::validate_memory(&grid, scene.is_lubricated())?;
        let mut form_gap = vec![0.0; grid.len()];
        scene.form.gap_into(&grid, &mut form_gap)?;
        let own_deformation = overrides.deformation.is_some();
        let deformation = match overrides.deformation {
            Some(model) if model.grid() != grid => {
                return Err(SimError::Input(InputError::Conflict {
                    field: "deformation".to_owned(),
                    reason: "the model lives on another grid than the scene".to_owned(),
                }));
            }
            Some(model) => model,
            None => half_space(scene, grid)?,
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
        let missing =
            [("viscosity", overrides.viscosity.is_some()), ("density", overrides.density.is_some())];
        if let (None, Some((law, _))) = (&scene.lubricant, missing.iter().find(|(_, given)| *given)) {
            return Err(SimError::Input(InputError::Conflict {
                field: (*law).to_owned(),
                reason: "a law is given, but the scene has no lubricant".to_owned(),
            }));
        }
        let viscosity = overrides.viscosity.map_or_else(|| setup::viscosity(scene), |law| Ok(Some(law)))?;
        let density = overrides.density.map_or_else(|| setup::density(scene), |law| Ok(Some(law)))?;
        let lubricant = match (scene.is_lubricated(), viscosity, density) {
            (true, Some(viscosity), Some(density)) => Some(Lubricant::from_boxed(viscosity, density)),
            _ => None,
        };
        let law = lubricant.as_ref().map(Lubricant::viscosity);
        let formulas = setup::formula_film(scene, &hertz, conditions.motion.entrainment_speed, law, None)?;
        let stated_film = stated_film(scene, &hertz, &conditions, law)?;
        Ok(Self {
            formulas,
            stated_film,
            evaluation: lubricant.is_some().then(|| Evaluation::new(grid)),
            flow: None,
            grid,
            hertz,
            form_gap,
            deformation,
            lubricant,
            solver: overrides.solver.map_or_else(|| setup::solver(scene), Ok)?,
            rule: setup::stopping_rule(scene)?,
            scheme: scene.scheme(),
            face_mobility: scene.face_mobility(),
            cavitation: scene.solver.cavitation,
            supplied_film: scene.lubricant.and_then(|lubricant| lubricant.supplied_film),
            shear_thinning: scene.friction.shear_thinning(conditions.motion.sliding_speed())?,
            film_cutoff: scene.solver.film_cutoff,
            contact: scene.solver.contact,
            motion: conditions.motion,
            load: conditions.load,
        })
    }

    /// The Hertz contact under `load` \[N\].
    pub(super) fn hertz_under(&self, scene: &Scene, load: f64) -> Result<HertzContact, InputError> {
        if load.to_bits() == self.load.to_bits() { Ok(self.hertz) } else { scene.hertz_under(load) }
    }

    /// Takes over the load and the speeds of `conditions`.
    pub(super) fn put_under(&mut self, scene: &Scene, conditions: &Conditions) -> Result<(), InputError> {
        let same = conditions.motion == self.motion && conditions.load.to_bits() == self.load.to_bits();
        if same {
            return Ok(());
        }
        let (hertz, motion) = (self.hertz_under(scene, conditions.load)?, conditions.motion);
        let law = self.lubricant.as_ref().map(Lubricant::viscosity);
        let formulas = setup::formula_film(scene, &hertz, motion.entrainment_speed, law, None)?;
        let stated_film = stated_film(scene, &hertz, conditions, law)?;
        let shear_thinning = scene.friction.shear_thinning(motion.sliding_speed())?;
        (self.hertz, self.motion, self.formulas, self.stated_film) = (hertz, motion, formulas, stated_film);
        (self.load, self.shear_thinning) = (conditions.load, shear_thinning);
        Ok(())
    }

    /// Central film of the smooth contact by formula; zero without lubricant \[m\].
    pub(super) fn formula_film(&self) -> f64 {
        self.formulas.map_or(0.0, |formulas| formulas.central)
    }

    /// Solves the contact with the undeformed gap `gap`, pressure limit `limit` and squeeze term `squeeze`, from `state`.
    pub(super) fn solve(
        &mut self,
        gap: &[f64],
        limit: Option<&[f64]>,
        squeeze: Option<Squeeze<'_>>,
        state: &mut ContactState,
    ) -> Result<SolveReport, SimError> {
        let reference_film = self.formula_film().min(self.supplied_film.unwrap_or(f64::INFINITY));
        let mut problem = LubricatedContact {
            gap,
            deformation: &mut *self.deformation,
            lubricant: self.lubricant.as_ref(),
            entrainment_speed: self.motion.entrainment_speed,
            squeeze,
            load: self.hertz.load,
            pressure_limit: limit,
            film_cutoff: self.film_cutoff,
            contact: self.contact,
            scheme: self.scheme,
            face_mobility: self.face_mobility,
            cavitation: self.cavitation,
            supplied_film: self.supplied_film,
            shear_thinning: self.shear_thinning,
            reference_half_widths: (self.hertz.a_x, self.hertz.a_y),
            reference_pressure: self.hertz.p_max,
            reference_film,
        };
        let report = self.solver.solve(&mut problem, state, &self.rule)?;
        self.flow = match &mut self.evaluation {
            Some(evaluation) => evaluation.flow_balance(&problem, state)?,
            None => None,
        };
        Ok(report)
    }
}

/// The solution of one contact.
#[derive(Debug, Clone)]
pub struct ContactSolution {
    /// How the solve ended, residuals and work.
    pub report: SolveReport,
    /// The grid.
    pub grid: Grid,
    /// Hertz contact of the smooth bodies.
    pub hertz: HertzContact,
    /// Moes parameters `(M, L)`; none for a dry contact.
    pub moes: Option<(f64, f64)>,
    /// Entrainment scheme, pressure flow and solid contact; none for a dry contact.
    pub discretisation: Option<(Scheme, FaceMobility, ContactDefinition)>,
    /// What holds where the fluid cavitates; none for a dry contact.
    pub cavitation: Option<Cavitation>,
    /// What flows into the box and out of it; none for a dry contact.
    pub flow: Option<FlowBalance>,
    /// Fields and approach.
    pub state: ContactState,
    /// Undeformed gap, form and roughness \[m\].
    pub gap: Vec<f64>,
    /// Estimated errors; only where the scene asks for an accuracy in place of a grid.
    pub error_estimate: Option<ErrorEstimate>,
    /// Film numbers.
    pub film: FilmNumbers,
    /// Contact numbers.
    pub contact: ContactNumbers,
    /// Friction coefficient, from boundary friction under the solid pressure and shear of the fluid; zero without
    /// sliding.
    pub friction_coefficient: f64,
    /// Part of the friction coefficient that solid contact makes.
    pub friction_boundary: f64,
    /// Part of the friction coefficient that shear of the fluid makes.
    pub friction_fluid: f64,
}

/// Film thickness of a solution \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmNumbers {
    /// At x = y = 0, interpolated between nodes.
    pub central: f64,
    /// Smallest over the nodes that carry pressure.
    pub minimum: f64,
    /// Mean over r <= 2a/3.
    pub mean_central: f64,
    /// Smallest over all nodes.
    pub minimum_gap: f64,
}

impl FilmNumbers {
    const UNKNOWN: Self =
        Self { central: f64::NAN, minimum: f64::NAN, mean_central: f64::NAN, minimum_gap: f64::NAN };
}

/// Pressure and contact of a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactNumbers {
    /// Largest pressure, between nodes where the peak is resolved (see [`metrics::peak`]) \[Pa\].
    pub max_pressure: f64,
    /// Pressure at x = y = 0 \[Pa\].
    pub central_pressure: f64,
    /// Area of solid contact inside the Hertz ellipse over its area.
    pub area_ratio: f64,
    /// Share of the load that solid contact carries.
    pub load_ratio: f64,
    /// Area of solid contact \[m^2\].
    pub area: f64,
    /// Area of nodes at the pressure limit \[m^2\].
    pub plastic_area: f64,
    /// Film at which solids touch, without which the ratios say little; zero in a dry contact \[m\].
    pub film_cutoff: f64,
}

impl ContactNumbers {
    const UNKNOWN: Self = Self {
        max_pressure: f64::NAN,
        central_pressure: f64::NAN,
        area_ratio: f64::NAN,
        load_ratio: f64::NAN,
        area: f64::NAN,
        plastic_area: f64::NAN,
        film_cutoff: f64::NAN,
    };
}

/// Solves the single contact of `scene`, surfaces as they are. With an accuracy in place of a grid the contact is solved on
/// finer and finer meshes, the last of which is returned.
///
/// # Errors
/// A scene that does not fit; a load that the pressure limit cannot carry. Not converging is a status of the report.
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.lubricant = None; // dry
/// scene.roughness = Default::default(); // smooth
/// scene.plastic = None; // elastic
/// let solution = solve_contact(&scene)?;
/// solution.report.require_converged().unwrap();
/// assert!((solution.contact.max_pressure / 1.15e9 - 1.0).abs() < 3e-3);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
pub fn solve_contact(scene: &Scene) -> Result<ContactSolution, SimError> {
    match scene.grid {
        GridSpec::Accuracy { accuracy } => accuracy::solve(scene, accuracy),
        _ => solve_on_grid(scene, |grid| Ok(ContactState::new(grid))),
    }
}

/// Solves the contact on the grid of the scene from the state that `start` makes.
pub(super) fn solve_on_grid(
    scene: &Scene,
    start: impl FnOnce(&Grid) -> Result<ContactState, InputError>,
) -> Result<ContactSolution, SimError> {
    let mut model = ContactModel::new(scene, Overrides::default())?;
    let grid = model.grid;
    let ball = setup::heights(&scene.roughness.ball, &grid, "ball")?;
    let disc = setup::heights(&scene.roughness.disc, &grid, "disc")?;
    let gap: Vec<f64> =
        model.form_gap.iter().zip(ball.iter().zip(&disc)).map(|(form, (b, d))| form - b - d).collect();
    let limit = match scene.plastic {
        None => None,
        Some(plastic) => {
            let [ball, disc] = scene.hardnesses(plastic.hardness);
            let softer = ball.min(disc);
            setup::validate_hardness(softer, &grid, &model.hertz)?;
            Some(vec![softer; grid.len()])
        }
    };
    let mut state = start(&grid)?;
    let report = model.solve(&gap, limit.as_deref(), None, &mut state)?;
    let law = boundary_law(&scene.friction, None)?;
    let mut friction = FrictionFields::new(scene, grid.len())?;
    let known = is_known(&state);
    if known {
        friction.update(&model, &state, law.as_ref(), None)?;
    }
    let numbers = Numbers::of(&model, &state, known.then_some(&friction), limit.as_deref())?;
    Ok(model.solution(report, state, gap, numbers))
}

/// Whether a state is a state: one of a solve that diverged may be none.
pub(super) fn is_known(state: &ContactState) -> bool {
    state.pressure.iter().chain(&state.film).all(|value| value.is_finite())
}

/// The numbers of a solved contact.
pub(super) struct Numbers {
    film: FilmNumbers,
    contact: ContactNumbers,
    friction: FrictionShares,
}

impl Numbers {
    /// Those of `state`; without `friction` the solve diverged, which is a status, and its numbers are unknown.
    pub(super) fn of(
        model: &ContactModel,
        state: &ContactState,
        friction: Option<&FrictionFields>,
        limit: Option<&[f64]>,
    ) -> Result<Self, InputError> {
        let Some(friction) = friction else {
            let (film, contact) = (FilmNumbers::UNKNOWN, ContactNumbers::UNKNOWN);
            return Ok(Self { film, contact, friction: FrictionShares::UNKNOWN });
        };
        Ok(Self {
            film: film_numbers(model, state)?,
            contact: contact_numbers(model, state, &friction.solid, limit)?,
            friction: friction.shares(model)?,
        })
    }
}

impl ContactModel {
    /// The solution that a solve with this model has led to.
    pub(super) fn solution(
        &self,
        report: SolveReport,
        state: ContactState,
        gap: Vec<f64>,
        numbers: Numbers,
    ) -> ContactSolution {
        let lubricated = self.lubricant.is_some();
        ContactSolution {
            report,
            grid: self.grid,
            hertz: self.hertz,
            moes: self.formulas.map(|formulas| formulas.moes),
            film: numbers.film,
            contact: numbers.contact,
            friction_coefficient: numbers.friction.coefficient,
            friction_boundary: numbers.friction.boundary,
            friction_fluid: numbers.friction.fluid,
            discretisation: lubricated.then_some((self.scheme, self.face_mobility, self.contact)),
            cavitation: lubricated.then_some(self.cavitation),
            flow: self.flow,
            state,
            gap,
            error_estimate: None,
        }
    }
}

/// Central film by formula, by the coefficient that is stated for it, else the slope of the law; zero without lubricant \[m\].
fn stated_film(
    scene: &Scene,
    hertz: &HertzContact,
    conditions: &Conditions,
    law: Option<&dyn ViscosityLaw>,
) -> Result<f64, InputError> {
    let alpha = scene.lubricant.and_then(|lubricant| lubricant.formula_alpha);
    let film = setup::formula_film(scene, hertz, conditions.motion.entrainment_speed, law, alpha)?;
    Ok(film.map_or(0.0, |film| film.central))
}

/// The elastic bodies of the scene. Displacements of a line contact count from the distance of the radius, or the length of
/// the box where that is longer.
fn half_space(scene: &Scene, grid: Grid) -> Result<Box<dyn DeformationModel>, InputError> {
    let modulus = scene.equivalent_modulus()?;
    Ok(if scene.form.is_line() {
        let reference = scene.form.radii().0.max(grid.size_x());
        Box::new(LineHalfSpace::new(grid, modulus, reference)?)
    } else {
        Box::new(HalfSpace::new(grid, modulus)?)
    })
}

pub(super) fn film_numbers(model: &ContactModel, state: &ContactState) -> Result<FilmNumbers, InputError> {
    Ok(FilmNumbers {
        central: model.grid.interpolate(&state.film, 0.0, 0.0)?,
        minimum: metrics::minimum_film(&state.film, &state.pressure)?.unwrap_or(0.0),
        mean_central: metrics::average_central_film(
            &model.grid,
            &state.film,
            model.hertz.a_x,
            model.hertz.a_y,
        )?,
        minimum_gap: metrics::minimum_gap(&state.film)?,
    })
}

pub(super) fn contact_numbers(
    model: &ContactModel,
    state: &ContactState,
    solid: &[f64],
    limit: Option<&[f64]>,
) -> Result<ContactNumbers, InputError> {
    let statistics = metrics::contact_statistics(
        &model.grid,
        &state.in_contact,
        solid,
        model.hertz.load,
        model.hertz.a_x,
        model.hertz.a_y,
    )?;
    let ellipse = std::f64::consts::PI * model.hertz.a_x * model.hertz.a_y;
    // Between nodes no more than the node of the largest pressure may carry.
    let top = state.pressure.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    let bound = top.and_then(|(k, _)| limit?.get(k).copied()).unwrap_or(f64::INFINITY);
    let at_limit = limit.map_or(0, |limit| {
        state.pressure.iter().zip(limit).filter(|(p, limit)| reaches_limit(**p, **limit)).count()
    });
    Ok(ContactNumbers {
        max_pressure: metrics::peak(&model.grid, &state.pressure)?.min(bound),
        central_pressure: model.grid.interpolate(&state.pressure, 0.0, 0.0)?,
        area_ratio: statistics.area_ratio * ellipse / model.hertz.area,
        load_ratio: statistics.load_ratio,
        area: statistics.area,
        plastic_area: at_limit as f64 * model.grid.cell_area(),
        film_cutoff: if model.lubricant.is_some() { model.film_cutoff } else { 0.0 },
    })
}
