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
use crate::sim::scene::Scene;
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
        let warnings = self.warnings(replaced, &contact, &bodies, &laws);
        contact.face_mobility = self.face_mobility(replaced, &bodies);
        contact.deformation.bodies().poll()?;
        let state = start(&contact.grid)?;
        let mut prepared = PreparedContact::new(self.scene, contact, bodies, laws, state)?;
        prepared.warnings = warnings;
        Ok(prepared)
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
    /// The scene.
    scene: Scene,
    /// Its model with the solver.
    model: ContactModel,
    /// Laws of friction and plasticity.
    laws: Laws,
    /// Initial pressures.
    state: ContactState,
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
        scene: Scene,
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
        let friction = FrictionFields::new(&scene, grid.len())?;
        let film_heat = FilmIteration::new(&scene, &model)?;
        model.reuses_buffers = film_heat.is_some();
        let rq = bodies.each_ref().map(|body| track_rq(&grid, model.hertz.half_extents()[1], body.surface()));
        model.check(&gap, limit.as_deref(), &state)?;
        model.deformation.bodies().poll()?;
        let warnings = Vec::new();
        Ok(Self { scene, model, laws, state, gap, limit, tribofilms, friction, film_heat, rq, warnings })
    }

    /// Solves contact and film temperature and evaluates the results. If the solve diverged, the results are
    /// `None`.
    pub(in crate::sim) fn solve(self) -> Result<ContactSolution, SimError> {
        let Self {
            scene,
            mut model,
            laws,
            mut state,
            gap,
            limit,
            tribofilms,
            mut friction,
            mut film_heat,
            ..
        } = self;
        let given = SolveContext { laws: &laws, tribofilms: &tribofilms };
        let mut once = |model: &mut ContactModel, state: &mut ContactState| {
            model.solve(&gap, limit.as_deref(), None, state)
        };
        let contact = (&mut model, &mut state, &mut friction);
        let solved = film_heat::solve(&given, film_heat.as_mut(), contact, &mut once);
        let solved = outer_rows::require_solids_inside(&scene, (&model, &state), solved)?;
        let known = is_known(&state).then_some(&friction);
        let numbers = Numbers::of(&model, &state, known, limit.as_deref(), self.rq)?;
        let stress =
            known.map(|fields| StressNumbers::of(&scene, &model, &state, fields)).transpose()?.flatten();
        let rise = |fields| heat::steady_rise(&scene, &model, fields, film_heat.as_ref());
        let flash_rise = known.map(rise).transpose()?.flatten();
        let mut solution = model.solution(solved, state, gap, known, numbers);
        (solution.stress, solution.flash_rise) = (stress, flash_rise);
        solution.warnings.splice(..0, self.warnings);
        Ok(solution)
    }
}
