//! Single contacts through the builder of simulations: one path for scenes, heights in memory, custom
//! components and finer meshes.
//!
//! `check_contact` and `solve` share one preparation ([`SimBuilder::begin`]). It returns all input errors, so
//! both have the same ones. A scene with an accuracy or an error estimate becomes a series of meshes
//! (`accuracy`), any other one mesh ([`PreparedContact`]).

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
use crate::sim::contact::{asperity_inlets, outer_rows, setup, strip, warnings};
use crate::sim::error::SimError;
use crate::sim::history::body::Body;
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::custom_parts::ReplacedParts;
use crate::sim::history::heat;
use crate::sim::history::placement::Placement;
use crate::sim::history::track::track_rq;
use crate::sim::history::yielding::Yielding;
use crate::sim::scene::{GridSpec, Scene};
use crate::sim::single_contact::accuracy::Meshes;
use crate::sim::single_contact::starvation::starvation;
use crate::surface::Offset;

impl SimBuilder {
    /// Solves the single contact of the bodies in the first position of their roughness under the initial
    /// conditions. It is [`solve_contact`](crate::sim::solve_contact) with the laws, heights and starts given to
    /// this builder. Bodies do not change: growth and wear laws are not called, and a hardness that grows with
    /// the plastic depth of this contact stays at its initial value. Of a scene whose roughness moves
    /// ([`RoughnessState::Moving`](crate::sim::scene::RoughnessState::Moving)) it is the last contact of
    /// [`solve_passage`](Self::solve_passage), with film, pressure, solid contact and friction in the mean of the passage.
    ///
    /// # Errors
    /// A scene, heights or starts that do not fit; a load that the pressure limit cannot carry; custom components
    /// together with an accuracy or an error estimate, which need other meshes. A solve that does not converge is
    /// no error: see the status of the report.
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene, solve_contact};
    /// let scene = Scene::azam_2019(32);
    /// let first = solve_contact(&scene)?;
    /// // The same surfaces from memory, started from the solution.
    /// let heights = |k: usize| MixedLubricationSim::builder(scene.clone()).build().map(|sim| sim.bodies()[k].surface().to_vec());
    /// let builder = MixedLubricationSim::builder(scene.clone()).ball_heights(heights(0)?).disc_heights(heights(1)?);
    /// let again = builder.contact_start(first.state.clone()).solve()?;
    /// assert!((again.film.central / first.film.central - 1.0).abs() < 1e-3);
    /// assert!(again.report.work.iterations < first.report.work.iterations);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn solve(self) -> Result<ContactSolution, SimError> {
        self.solve_observed(|_| {})
    }

    /// As [`solve`](Self::solve); with an accuracy or an error estimate `observer` is called with the solution of
    /// each mesh, the last one included. These solutions have no warnings yet.
    ///
    /// # Errors
    /// As of [`solve`](Self::solve).
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut scene = Scene::azam_2019(32);
    /// scene.solver.estimate = true;
    /// let mut cells = Vec::new();
    /// MixedLubricationSim::builder(scene).solve_observed(|solution| cells.push(solution.grid.nx()))?;
    /// assert_eq!(cells, [16, 32]);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn solve_observed(
        self,
        mut observer: impl FnMut(&ContactSolution),
    ) -> Result<ContactSolution, SimError> {
        let scene = self.scene.clone();
        if !scene.motion.roughness.is_at_rest() {
            return self.solve_mean_contact();
        }
        let flooded = self.flooded();
        let mut solution = match self.begin()? {
            ReadySolve::Mesh(contact) => contact.solve()?,
            ReadySolve::Meshes(meshes) => meshes.solve(&mut observer)?,
        };
        let found = warnings::after_solve(&scene, &solution);
        solution.warnings.extend(found);
        solution.starvation = flooded.map(|flooded| starvation(&solution, flooded)).transpose()?.flatten();
        Ok(solution)
    }

    /// Prepares [`solve`](Self::solve) up to the first iteration of its solver, without solving. Returns the
    /// warnings known by then.
    ///
    /// # Errors
    /// The input errors of [`solve`](Self::solve), an interruption. Errors of a history only are found by
    /// [`check`](Self::check).
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut scene = Scene::azam_2019(32);
    /// let warnings = MixedLubricationSim::builder(scene.clone()).check_contact()?;
    /// assert!(warnings.starts_with(&scene.warnings()));
    /// scene.plastic.as_mut().unwrap().hardness = 1e6; // carries less than the load
    /// let builder = || MixedLubricationSim::builder(scene.clone());
    /// let [checked, solved] = [builder().check_contact().err(), builder().solve().err()]
    ///     .map(|error| error.map(|error| error.to_string()));
    /// assert!(checked.is_some() && checked == solved);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn check_contact(self) -> Result<Vec<Warning>, SimError> {
        if !self.scene.motion.roughness.is_at_rest() {
            return self.check_passage();
        }
        Ok(match self.begin()? {
            ReadySolve::Mesh(contact) => contact.warnings,
            ReadySolve::Meshes(meshes) => meshes.into_warnings(),
        })
    }

    /// Prepares the contact and returns all input errors.
    fn begin(mut self) -> Result<ReadySolve, SimError> {
        strip::validate(&self.scene)?;
        if needs_meshes(&self.scene) {
            if let Some(part) = self.custom_part() {
                return Err(SimError::Input(InputError::Conflict {
                    field: part.to_owned(),
                    reason: "it is known on one grid, an accuracy or an estimate of errors needs several"
                        .to_owned(),
                }));
            }
            let meshes = Meshes::new(&self.scene, self.custom.interrupt.as_ref())?;
            return Ok(ReadySolve::Meshes(meshes));
        }
        let start = self.contact_start.take();
        let replaced = self.replaced();
        let start = |grid: &Grid| Ok(start.unwrap_or_else(|| ContactState::new(grid)));
        Ok(ReadySolve::Mesh(Box::new(self.prepare(replaced, start)?)))
    }

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

/// Whether the single contact of `scene` needs several meshes.
fn needs_meshes(scene: &Scene) -> bool {
    let asked = scene.solver.estimate || scene.solver.accuracy.is_some();
    asked || matches!(scene.grid, GridSpec::Accuracy { .. })
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

/// A checked contact before its first iteration.
enum ReadySolve {
    /// On the grid of the scene.
    Mesh(Box<PreparedContact>),
    /// On several meshes.
    Meshes(Meshes),
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
