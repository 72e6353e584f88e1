//! A single contact on one mesh, prepared up to the first iteration of its solver.

use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::ContactState;
use crate::sim::contact::film_heat::{self, FilmIteration, SolveContext};
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::interrupt::Interrupt;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::numbers::is_known;
use crate::sim::contact::numbers::{Numbers, StressNumbers};
use crate::sim::contact::solution::ContactSolution;
use crate::sim::contact::warnings::Warning;
use crate::sim::contact::{asperity_inlets, outer_rows, setup};
use crate::sim::error::SimError;
use crate::sim::history::body::Body;
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::custom_parts::ReplacedParts;
use crate::sim::history::heat;
use crate::sim::history::placement::Placement;
use crate::sim::history::track::track_rq;
use crate::sim::history::yielding::Yielding;
use crate::sim::scene::operating_schedule::Conditions;
use crate::sim::scene::{Load, Scene, Schedules};
use crate::surface::Offset;

impl SimBuilder {
    /// The contact on the grid of the scene only, started from the state of `start`. `replaced` parts stand for those of
    /// the scene.
    pub(in crate::sim) fn prepare(
        mut self,
        replaced: ReplacedParts,
        start: impl FnOnce(&Grid) -> Result<ContactState, InputError>,
    ) -> Result<PreparedContact, SimError> {
        self.scene.schedule.read_tables()?;
        let custom = std::mem::take(&mut self.custom);
        let mut contact = ContactModel::new(&self.scene, custom)?;
        if let (Some(plastic), None) = (self.scene.plastic, &self.plasticity) {
            let [ball, disc] = self.scene.hardnesses(plastic.hardness);
            setup::validate_hardness(ball.min(disc), &contact.grid, &contact.hertz)?;
        }
        let laws = self.laws()?;
        let bodies = [self.body(0, &contact, &laws)?, self.body(1, &contact, &laws)?];
        asperity_inlets::require_no_lay(&self.scene, &contact.grid, bodies.each_ref().map(Body::initial))?;
        contact.face_mobility = self.face_mobility(replaced, &bodies);
        contact.deformation.bodies().poll()?;
        let state = start(&contact.grid)?;
        PreparedContact::new((self, replaced), contact, bodies, laws, state)
    }
}

/// The contact on the grid of the scene, started from the state of `start`.
pub(in crate::sim) fn prepare_on_grid(
    scene: &Scene,
    interrupt: Option<&Interrupt>,
    start: impl FnOnce(&Grid) -> Result<ContactState, InputError>,
) -> Result<PreparedContact, SimError> {
    let mut builder = SimBuilder::new(scene.clone());
    builder.custom.interrupt = interrupt.cloned();
    builder.prepare(ReplacedParts::default(), start)
}

/// The contact with given heights of ball and disc on this grid \[m\].
pub(in crate::sim) fn prepare_heights(
    scene: &Scene,
    interrupt: Option<&Interrupt>,
    [ball, disc]: [Vec<f64>; 2],
) -> Result<PreparedContact, SimError> {
    let mut builder = SimBuilder::new(scene.clone()).ball_heights(ball).disc_heights(disc);
    builder.custom.interrupt = interrupt.cloned();
    // The heights are those of the scene on another mesh.
    builder.prepare(ReplacedParts::default(), |grid| Ok(ContactState::new(grid)))
}

/// The contact of two bodies on one mesh before its first iteration.
pub(in crate::sim) struct PreparedContact {
    /// The scene, without the components that are in the fields below, and which of its parts were replaced.
    builder: SimBuilder,
    replaced: ReplacedParts,
    /// Its model with the solver.
    pub(super) model: ContactModel,
    /// The bodies, which no solve changes.
    bodies: [Body; 2],
    /// Laws of friction and plasticity.
    laws: Laws,
    /// Initial pressures.
    pub(super) state: ContactState,
    /// Undeformed gap \[m\].
    gap: Vec<f64>,
    /// Largest pressure per node \[Pa\]; `None` for an elastic contact.
    limit: Option<Vec<f64>>,
    /// Tribofilms of ball and disc \[m\].
    tribofilms: [Vec<f64>; 2],
    /// Shear stresses, computed by the solve.
    friction: FrictionFields,
    /// Temperature of the film; `None` for an isothermal film.
    film_heat: Option<FilmIteration>,
    /// Root mean square heights of ball and disc on the track \[m\].
    rq: [f64; 2],
    /// Warnings before the first iteration.
    pub(in crate::sim) warnings: Vec<Warning>,
}

impl PreparedContact {
    /// Returns all input errors of a solve.
    fn new(
        (builder, replaced): (SimBuilder, ReplacedParts),
        mut model: ContactModel,
        bodies: [Body; 2],
        laws: Laws,
        state: ContactState,
    ) -> Result<Self, SimError> {
        let grid = model.grid;
        let mut placement = Placement::new(grid);
        placement.place(&bodies, &model.form_gap, [Offset::default(); 2])?;
        let Placement { gap, films: tribofilms, depths, .. } = placement;
        model.set_tribofilms(&tribofilms)?;
        let limit = match &laws.plasticity {
            None => None,
            Some(plasticity) => {
                let mut yielding = Yielding::new(grid.len());
                yielding.start(plasticity, &tribofilms, &depths)?;
                Some(yielding.limit)
            }
        };
        model.deformation.bodies().poll()?;
        let friction = FrictionFields::new(&builder.scene, grid.len())?;
        let film_heat = FilmIteration::new(&builder.scene, &model)?;
        model.reuses_buffers = film_heat.is_some();
        let rq = bodies.each_ref().map(|body| track_rq(&grid, model.hertz.half_extents()[1], body.surface()));
        model.check(&gap, limit.as_deref(), &state)?;
        model.deformation.bodies().poll()?;
        let warnings = builder.warnings(replaced, &model, &bodies, &laws);
        Ok(Self {
            builder,
            replaced,
            model,
            bodies,
            laws,
            state,
            gap,
            limit,
            tribofilms,
            friction,
            film_heat,
            rq,
            warnings,
        })
    }

    /// The scene.
    pub(super) fn scene(&self) -> &Scene {
        &self.builder.scene
    }

    /// Sets load, speeds and temperature of the next solve, with its warnings.
    pub(super) fn set_conditions(&mut self, conditions: &Conditions) -> Result<(), SimError> {
        let scene = &mut self.builder.scene;
        conditions.validate(scene.is_lubricated())?;
        let hertz = self.model.hertz_under(scene, conditions.load)?;
        setup::validate_box(&self.model.grid, &hertz, scene.form.is_line())?;
        (scene.load, scene.motion) = (Load::force(conditions.load), conditions.motion);
        scene.thermal.bulk_temperature = conditions.bulk_temperature;
        scene.schedule = Schedules::default();
        self.model.set_conditions(scene, conditions)?;
        self.warnings = self.builder.warnings(self.replaced, &self.model, &self.bodies, &self.laws);
        Ok(())
    }

    /// Solves the contact once.
    pub(in crate::sim) fn solve(mut self) -> Result<ContactSolution, SimError> {
        self.solve_next()
    }

    /// Solves contact and film temperature and evaluates the results. If the solve diverged, the results are
    /// `None`. The next solve starts from an empty state.
    pub(super) fn solve_next(&mut self) -> Result<ContactSolution, SimError> {
        let Self { builder, model, laws, gap, limit, tribofilms, friction, film_heat, .. } = self;
        let scene = &builder.scene;
        let mut state = std::mem::replace(&mut self.state, ContactState::new(&model.grid));
        let given = SolveContext { laws, tribofilms };
        let mut once = |model: &mut ContactModel, state: &mut ContactState| {
            model.solve(gap, limit.as_deref(), None, state)
        };
        let contact = (&mut *model, &mut state, &mut *friction);
        let solved = film_heat::solve(&given, film_heat.as_mut(), contact, &mut once);
        let solved = outer_rows::require_solids_inside(scene, (&*model, &state), solved)?;
        let known = is_known(&state).then_some(&*friction);
        let numbers = Numbers::of(model, &state, known, limit.as_deref(), self.rq)?;
        let stress =
            known.map(|fields| StressNumbers::of(scene, model, &state, fields)).transpose()?.flatten();
        let rise = |fields| heat::steady_rise(scene, model, fields, film_heat.as_ref());
        let flash_rise = known.map(rise).transpose()?.flatten();
        let mut solution = model.solution(solved, state, gap.clone(), known, numbers);
        (solution.stress, solution.flash_rise) = (stress, flash_rise);
        solution.warnings.splice(..0, self.warnings.iter().cloned());
        Ok(solution)
    }
}
