//! The history of a contact: solve, grow, wear, flatten, move on.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::SimError;
use super::body::Body;
use super::builder::SimBuilder;
use super::contact::ContactModel;
use super::exposure::{self, Ageing};
use super::friction::FrictionFields;
use super::heat::Heat;
use super::hertz::HertzContact;
use super::observer::Observer;
use super::per_body::PerBody;
use super::record::StepRecord;
use super::scene::Scene;
use super::solution::{contact_numbers, film_numbers};
use super::squeeze_memory::SqueezeMemory;
use super::step_control::StepControl;
use super::timetable::{Conditions, Timetable};
use super::warnings::{self, Warning};
use super::yielding::Yielding;
use crate::boundary_friction::BoundaryFriction;
use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::grid::Grid;
use crate::metrics;
use crate::plastic::PlasticityModel;
use crate::report::{SolveReport, Status};
use crate::reynolds::ContactState;
use crate::rubbing::RubbingPoint;
use crate::surface::{FourierShift, Offset, RoughnessMotion, add_blended, blend_shifted, copy_shifted};
use crate::tribochem::{FilmGrowthLaw, Tribofilm};
use crate::wear::WearLaw;

/// Positions of the roughness that a step tries before it gives up.
const MAX_ATTEMPTS: u32 = 8;
/// Solves in which limit and depth of a hardening contact must have met.
const MAX_HARDENING: usize = 40;
/// Accepted distance between both, relative to the limit.
const HARDENING_TOLERANCE: f64 = 1e-3;
/// A patch of nodes that yield together gives way more than a single one, by about this factor.
const PATCH_COMPLIANCE: f64 = 4.0;
/// Attempts to find the length of a step.
const MAX_CUTS: usize = 40;

/// The laws of a run, shared by its copies; absent ones cost nothing.
#[derive(Debug, Clone)]
pub(super) struct Laws {
    pub(super) plasticity: Option<PerBody<dyn PlasticityModel>>,
    pub(super) growth: Option<Arc<dyn FilmGrowthLaw>>,
    pub(super) wear: Option<PerBody<dyn WearLaw>>,
    pub(super) friction: Arc<dyn BoundaryFriction>,
}

/// How the contact moves on from step to step.
#[derive(Debug, Clone)]
pub(super) struct Travel {
    pub(super) motion: Arc<dyn RoughnessMotion>,
    /// Whether a contact feels the squeeze of the film before it.
    pub(super) squeeze: bool,
}

/// Where the roughness of ball and disc stands.
type Offsets = [Offset; 2];

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunEnd {
    /// All steps were taken.
    Finished,
    /// The observer stopped the run.
    Stopped,
}

/// A rough lubricated contact whose surfaces flatten, grow a tribofilm and wear as they rub.
///
/// Each step solves the quasi-static contact of the surfaces as they stand, advances tribofilm and wear under
/// its pressures for the time that the step exposes the nodes to it ([`Exposure`](super::scene::Exposure)),
/// applies the plastic depth, and moves the roughness of both bodies to the next position. One solve stands
/// for all passages within the step. Nothing irreversible happens unless the solve converged: where it did
/// not, the step tries other positions of the roughness, and if all fail the step is an error and the state
/// is as before.
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, RunEnd, Scene, StepRecord};
/// use std::ops::ControlFlow;
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(32).with_tribofilm()).build()?;
/// let mut wear = Vec::new();
/// let end = sim.run(3, 10.0, &mut |_: &MixedLubricationSim, record: &StepRecord| {
///     wear.push(record.mean_wear[1]);
///     ControlFlow::Continue(())
/// })?;
/// assert_eq!(end, RunEnd::Finished);
/// assert!(wear[2] > wear[0]);
/// assert!(sim.ledger_residual()? < 1e-20);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
///
/// A clone goes its own way from where the original stands, step by step to the last bit as the original
/// would. Laws are shared, buffers are not; the buffers of the solver are made anew at its first solve.
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build()?;
/// sim.step(60.0)?;
/// let mut other = sim.clone();
/// let short = std::thread::spawn(move || other.step(10.0)).join().expect("no panic")?;
/// assert!(sim.step(60.0)?.mean_wear[1] > short.mean_wear[1]);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone)]
pub struct MixedLubricationSim {
    pub(super) scene: Scene,
    timetable: Timetable,
    pub(super) contact: ContactModel,
    pub(super) laws: Laws,
    heat: Heat,
    pub(super) travel: Travel,
    between_nodes: FourierShift,
    pub(super) bodies: [Body; 2],
    pub(super) state: ContactState,
    pub(super) squeeze_memory: SqueezeMemory,
    pub(super) time: f64,
    pub(super) step: u64,
    /// Positions of the roughness that were tried; with the seed the state of the random numbers.
    pub(super) draws: u64,
    pub(super) fields: Fields,
    pub(super) backup: [Body; 2],
    /// The contact before the step in progress.
    before: ContactState,
    warnings: Vec<Warning>,
    /// What was put in place of parts of the scene.
    #[cfg(feature = "serde")]
    pub(super) own_parts: super::identity::OwnParts,
}

/// Fields of the step in progress, all in the frame of the contact unless a name says otherwise.
#[derive(Debug, Clone)]
pub(super) struct Fields {
    pub(super) gap: Vec<f64>,
    heights: Vec<f64>,
    pub(super) films: [Vec<f64>; 2],
    depths: [Vec<f64>; 2],
    on_body: Vec<f64>,
    /// What the nodes of a body feel.
    points: Vec<RubbingPoint>,
    wear_rates: Vec<f64>,
    heat: Vec<f64>,
    rise: Vec<f64>,
    /// Mass that the squeeze refers to.
    squeezed: Vec<f64>,
    pub(super) friction: FrictionFields,
    pub(super) yielding: Yielding,
}

impl Fields {
    fn new(scene: &Scene, n: usize) -> Result<Self, InputError> {
        let zeros = || vec![0.0; n];
        let pair = || [zeros(), zeros()];
        Ok(Self {
            gap: zeros(),
            heights: zeros(),
            films: pair(),
            depths: pair(),
            on_body: zeros(),
            points: Vec::with_capacity(n),
            wear_rates: zeros(),
            heat: zeros(),
            rise: zeros(),
            squeezed: zeros(),
            friction: FrictionFields::new(scene, n)?,
            yielding: Yielding::new(n),
        })
    }
}

impl MixedLubricationSim {
    /// A builder that makes the simulation of `scene`.
    pub fn builder(scene: Scene) -> SimBuilder {
        SimBuilder::new(scene)
    }

    pub(super) fn assemble(
        (scene, timetable, warnings): (Scene, Timetable, Vec<Warning>),
        contact: ContactModel,
        bodies: [Body; 2],
        laws: Laws,
        heat: Heat,
        travel: Travel,
    ) -> Result<Self, InputError> {
        let grid = contact.grid;
        Ok(Self {
            state: ContactState::new(&grid),
            squeeze_memory: SqueezeMemory::new(grid.len()),
            fields: Fields::new(&scene, grid.len())?,
            between_nodes: FourierShift::new(grid.nx()),
            scene,
            timetable,
            contact,
            laws,
            heat,
            travel,
            backup: bodies.clone(),
            bodies,
            time: 0.0,
            step: 0,
            draws: 0,
            before: ContactState::new(&grid),
            warnings,
            #[cfg(feature = "serde")]
            own_parts: super::identity::OwnParts::default(),
        })
    }

    /// How the roughness moves from step to step.
    pub fn motion(&self) -> &dyn RoughnessMotion {
        self.travel.motion.as_ref()
    }

    /// Whether each contact feels the squeeze of the film before it.
    pub fn has_squeeze(&self) -> bool {
        self.travel.squeeze
    }

    /// The grid of the contact and of both bodies' patches.
    pub fn grid(&self) -> Grid {
        self.contact.grid
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What acts on the contact at the time that has passed.
    pub fn conditions(&self) -> Conditions {
        self.timetable.at(self.time)
    }

    /// Hertz contact of the smooth bodies under the load of the last step.
    pub fn hertz(&self) -> HertzContact {
        self.contact.hertz
    }

    /// Time that has passed \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps that were committed.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Ball and disc.
    pub fn bodies(&self) -> &[Body; 2] {
        &self.bodies
    }

    /// Pressures and film of the last solve, in the frame of the contact.
    pub fn state(&self) -> &ContactState {
        &self.state
    }

    /// What is unlikely to be meant or to hold: that of [`Scene::warnings`], of heights that were read or
    /// given, and after the first step of its contact. The list is that of the whole run, no step repeats it.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Whether the flash temperature is modelled.
    pub fn models_flash_temperature(&self) -> bool {
        self.heat.flash.is_some()
    }

    /// Largest flash temperature rise that the smooth contact would have \[K\] under the conditions at any
    /// entry of the schedule, by which it is modelled or left out unless the scene says which: by boundary
    /// friction under all of the load, or by shear of a fluid film of the thickness that the formulas give,
    /// whichever is hotter (see [`estimate_rise_under_flux`](crate::tribochem::estimate_rise_under_flux)).
    pub fn flash_estimate(&self) -> f64 {
        self.heat.estimate
    }

    /// Largest difference over both bodies between the surface and `initial - wear - plastic + film` \[m\].
    ///
    /// # Errors
    /// Never for a simulation that was built: its fields have one length.
    pub fn ledger_residual(&self) -> Result<f64, InputError> {
        let [ball, disc] = &self.bodies;
        Ok(ball.ledger()?.residual(&ball.surface)?.max(disc.ledger()?.residual(&disc.surface)?))
    }

    /// Takes `steps` steps of `time_step` \[s\]; `observer` sees each and may stop the run.
    ///
    /// # Errors
    /// See [`MixedLubricationSim::step`]; the steps before are committed.
    pub fn run(
        &mut self,
        steps: u64,
        time_step: f64,
        observer: &mut impl Observer,
    ) -> Result<RunEnd, SimError> {
        for _ in 0..steps {
            let record = self.step(time_step)?;
            if observer.after_step(self, &record) == ControlFlow::Break(()) {
                return Ok(RunEnd::Stopped);
            }
        }
        Ok(RunEnd::Finished)
    }

    /// Steps until the time `end` \[s\], each as long as `control` allows and none across an entry of a
    /// schedule; `observer` sees each and may stop the run.
    ///
    /// # Errors
    /// See [`MixedLubricationSim::step_within`]; the steps before are committed.
    pub fn run_until(
        &mut self,
        end: f64,
        control: &StepControl,
        observer: &mut impl Observer,
    ) -> Result<RunEnd, SimError> {
        InputError::require(end.is_finite(), "end", end, "finite")?;
        control.validate()?;
        // What rounding leaves of the last step is none.
        while end - self.time > 1e-9 * control.longest {
            let mut left = end - self.time;
            if let Some(entry) = self.timetable.next_entry(self.time) {
                left = left.min(entry - self.time);
            }
            let record = self.step_within(&StepControl { longest: control.longest.min(left), ..*control })?;
            if observer.after_step(self, &record) == ControlFlow::Break(()) {
                return Ok(RunEnd::Stopped);
            }
        }
        Ok(RunEnd::Finished)
    }

    /// Takes one step of `time_step` \[s\] under the conditions that hold at its start.
    ///
    /// # Errors
    /// A time step that is negative or not finite; a contact that did not converge at any tried position of
    /// the roughness; a law that returned a value that is not finite; an [interrupt](SimBuilder::interrupt).
    /// Everything is then as before, so that another step of this length fails again.
    pub fn step(&mut self, time_step: f64) -> Result<StepRecord, SimError> {
        self.step_within(&StepControl::fixed(time_step))
    }

    /// Takes one step, as long as `control` allows: one solve of the contact, and then the longest step under
    /// its pressures in which no node wears or grows by more than the depth. The record holds its length.
    ///
    /// # Errors
    /// As of [`MixedLubricationSim::step`], and laws that change a node by more than the depth in any time.
    pub fn step_within(&mut self, control: &StepControl) -> Result<StepRecord, SimError> {
        control.validate()?;
        let (draws, circumstances) = (self.draws, self.contact.circumstances());
        self.before.clone_from(&self.state);
        for (backup, body) in self.backup.iter_mut().zip(&self.bodies) {
            backup.clone_from(body);
        }
        let outcome = self.take_step(control);
        if outcome.is_err() {
            self.draws = draws;
            self.contact.return_to(circumstances);
            std::mem::swap(&mut self.state, &mut self.before);
            std::mem::swap(&mut self.bodies, &mut self.backup);
        }
        outcome
    }

    /// The same; an error leaves contact and bodies as they were when it came.
    fn take_step(&mut self, control: &StepControl) -> Result<StepRecord, SimError> {
        let conditions = self.conditions();
        self.contact.put_under(&self.scene, &conditions)?;
        self.heat.move_at(conditions.motion.surface_speeds(), &self.contact.grid)?;
        let (report, offsets, attempts) = self.solve_somewhere()?;
        let flash_rise = self.rub()?;
        let rq = self.roughness()?;
        let time_step = self.commit_within(control, offsets)?;
        let record = self.record((report, attempts), flash_rise, (conditions, rq), time_step)?;
        self.time = record.time;
        self.squeeze_memory.keep(&self.state.mass, time_step);
        if self.step == 0 && record.composite_rq == 0.0 {
            self.warnings.extend(warnings::excess_pressure(record.max_pressure, self.contact.hertz.p_max));
        }
        self.step += 1;
        Ok(record)
    }

    /// Commits the longest step that `control` allows and returns its length.
    fn commit_within(&mut self, control: &StepControl, offsets: Offsets) -> Result<f64, SimError> {
        let mut time_step = control.longest;
        for _ in 0..MAX_CUTS {
            self.commit(time_step, offsets)?;
            let change = self.largest_change();
            if change <= control.depth {
                return Ok(time_step);
            }
            for (body, backup) in self.bodies.iter_mut().zip(&self.backup) {
                body.clone_from(backup);
            }
            time_step *= (0.98 * control.depth / change).clamp(0.02, 0.98);
        }
        Err(SimError::Input(InputError::Conflict {
            field: format!("step.depth = {:?}", control.depth),
            reason: format!("the laws change a node by more than it even within {time_step:e} s"),
        }))
    }

    /// Largest change of wear or film of any node since the backup \[m\].
    fn largest_change(&self) -> f64 {
        let fields = self.bodies.iter().zip(&self.backup).flat_map(|(now, before)| {
            let wear = now.wear_depth().iter().zip(before.wear_depth());
            wear.chain(now.film_thickness().iter().zip(before.film_thickness()))
        });
        fields.fold(0.0, |largest, (now, before)| largest.max((now - before).abs()))
    }

    /// Solves the contact at the next position of the roughness, or at further ones where that fails.
    fn solve_somewhere(&mut self) -> Result<(SolveReport, Offsets, u32), SimError> {
        let mut attempt = 1;
        loop {
            let offsets = self.offsets()?;
            self.draws += 1;
            let report = self.solve_at(offsets)?;
            match report.require_converged() {
                Ok(()) => return Ok((report, offsets, attempt)),
                // A motion that has no other position has no other contact.
                Err(source) if attempt >= MAX_ATTEMPTS || self.offsets()? == offsets => {
                    return Err(SimError::NotConverged { step: self.step, attempts: attempt, source });
                }
                Err(_) => attempt += 1,
            }
        }
    }

    /// Where the roughness stands at the next solve, within the patch.
    fn offsets(&self) -> Result<Offsets, InputError> {
        let (motion, grid, speeds) =
            (&self.travel.motion, self.contact.grid, self.timetable.mean_speeds(self.time));
        let [ball, disc] = [0, 1].map(|body| motion.offset(body, self.draws, self.time, speeds[body], &grid));
        ball.validate_as("motion: offset.fraction of the ball")?;
        disc.validate_as("motion: offset.fraction of the disc")?;
        Ok([ball, disc].map(|offset| Offset {
            columns: offset.columns % grid.nx(),
            rows: offset.rows % grid.ny(),
            ..offset
        }))
    }

    /// Surfaces, films and depths of both bodies as they lie at `offsets`.
    fn place(&mut self, offsets: Offsets) -> Result<(), InputError> {
        let (nx, ny) = (self.contact.grid.nx(), self.contact.grid.ny());
        let Self { fields, bodies, contact, between_nodes, .. } = self;
        fields.gap.copy_from_slice(&contact.form_gap);
        for (index, body) in bodies.iter().enumerate() {
            let offset = offsets[index];
            if offset.fraction == 0.0 {
                copy_shifted(&body.surface, nx, ny, (offset.columns, offset.rows), &mut fields.heights)?;
            } else {
                between_nodes.apply(&body.surface, ny, offset, &mut fields.heights)?;
            }
            for (gap, z) in fields.gap.iter_mut().zip(&fields.heights) {
                *gap -= z;
            }
            blend_shifted(body.film_thickness(), nx, ny, offset, &mut fields.films[index])?;
            blend_shifted(body.plastic_depth(), nx, ny, offset, &mut fields.depths[index])?;
        }
        Ok(())
    }

    pub(super) fn solve_at(&mut self, offsets: Offsets) -> Result<SolveReport, SimError> {
        self.place(offsets)?;
        let Self { fields, contact, laws, state, travel, squeeze_memory, step, .. } = self;
        let squeeze =
            if travel.squeeze { squeeze_memory.squeeze(*step, &mut fields.squeezed)? } else { None };
        // A film that is squeezed was there a moment ago; roughness that has moved far makes the last
        // pressures no better a start than the dry contact.
        if squeeze.is_none() {
            state.pressure.fill(0.0);
        }
        let Some(model) = &laws.plasticity else {
            return contact.solve(&fields.gap, None, squeeze, state);
        };
        fields.yielding.start(model, &fields.films, &fields.depths)?;
        let mut report = contact.solve(&fields.gap, Some(&fields.yielding.limit), squeeze, state)?;
        if !model.each().iter().any(|model| model.hardens()) {
            return Ok(report);
        }
        let compliance = PATCH_COMPLIANCE * contact.deformation.influence(0, 0);
        for _ in 0..MAX_HARDENING {
            let (films, depths) = (&fields.films, &fields.depths);
            let distance = fields.yielding.harden(model, films, depths, &state.plastic_depth, compliance);
            if report.status != Status::Converged || distance <= HARDENING_TOLERANCE {
                return Ok(report);
            }
            let before = report;
            report =
                contact.solve(&fields.gap, Some(&fields.yielding.limit), squeeze, state)?.preceded_by(before);
        }
        report.status = Status::MaxIterations;
        Ok(report)
    }

    /// Shear, heat and temperature under the solved pressures; returns the largest flash rise \[K\], none
    /// where it is not modelled.
    fn rub(&mut self) -> Result<Option<f64>, SimError> {
        let Self { fields, contact, laws, state, heat, .. } = self;
        fields.friction.update(contact, state, laws.friction.as_ref(), &fields.films)?;
        let Some(flash) = &mut heat.flash else { return Ok(None) };
        for (k, heat) in fields.heat.iter_mut().enumerate() {
            *heat = fields.friction.heat(k);
        }
        Ok(Some(flash.rise(&fields.heat, &mut fields.rise)?.maximum))
    }

    /// What a step of a second does to ball and disc as they move under `conditions`.
    fn ageing(&self, conditions: &Conditions) -> Result<[Ageing; 2], InputError> {
        let (track, motion) = (&self.scene.track, self.travel.motion.as_ref());
        let speeds = conditions.motion.surface_speeds();
        exposure::ageing(track, motion, &self.contact.grid, &self.contact.hertz, speeds)
    }

    /// Adds the print of the contact to the plastic depth of the bodies.
    fn flatten(&mut self, ageing: [Ageing; 2], time_step: f64, offsets: Offsets) -> Result<(), SimError> {
        let Self { fields, bodies, contact, state, .. } = self;
        let (nx, ny) = (contact.grid.nx(), contact.grid.ny());
        fields.yielding.share(&state.plastic_depth)?;
        for (index, body) in bodies.iter_mut().enumerate() {
            fields.on_body.fill(0.0);
            add_blended(&fields.yielding.split[index], nx, ny, offsets[index], &mut fields.on_body)?;
            let share = ageing[index].print(time_step);
            fields.on_body.iter_mut().for_each(|depth| *depth *= share);
            body.plastic.add(&fields.on_body)?;
        }
        Ok(())
    }

    /// Applies wear, film growth and flattening to the bodies. The film grows half before and half after the
    /// wear, so that the wear coefficient is that of the middle of the step.
    fn commit(&mut self, time_step: f64, offsets: Offsets) -> Result<(), SimError> {
        let conditions = self.conditions();
        let ageing = self.ageing(&conditions)?;
        if self.laws.plasticity.is_some() {
            self.flatten(ageing, time_step, offsets)?;
        }
        let Self { fields, bodies, contact, laws, state, .. } = self;
        let (nx, ny) = (contact.grid.nx(), contact.grid.ny());
        let (bulk, sliding) = (conditions.bulk_temperature, conditions.motion.sliding_speed());
        let Fields { points, wear_rates, rise, friction, .. } = fields;
        let on_grid = |k: usize| RubbingPoint {
            pressure: state.pressure[k],
            solid_pressure: friction.solid[k],
            shear_stress: friction.stress(k),
            temperature: bulk + rise[k],
            sliding_speed: sliding,
            film_thickness: state.film[k],
            in_contact: state.in_contact[k],
        };
        for (index, (body, offset)) in bodies.iter_mut().zip(offsets).enumerate() {
            let exposed = ageing[index].rate * time_step;
            let point = |node: usize| {
                // Where this node of the body stands in the frame of the contact: on a node, or short of it.
                let (i, j) = ((node % nx + nx - offset.columns) % nx, (node / nx + ny - offset.rows) % ny);
                let at = on_grid(j * nx + i);
                if offset.fraction == 0.0 {
                    return at;
                }
                at.towards(&on_grid(j * nx + (i + nx - 1) % nx), offset.fraction)
            };
            points.clear();
            points.extend((0..nx * ny).map(point));
            if let (Some(law), Some(film)) = (&laws.growth, &mut body.film) {
                film.advance_all(law.as_ref(), 0.5 * exposed, points)?;
            }
            if let Some(law) = &laws.wear {
                let thickness = body.film.as_ref().map_or(body.no_film.as_slice(), Tribofilm::thickness);
                body.wear.advance_all(law.each()[index], exposed, (points, thickness), wear_rates)?;
            }
            if let (Some(law), Some(film)) = (&laws.growth, &mut body.film) {
                film.advance_all(law.as_ref(), 0.5 * exposed, points)?;
            }
            body.rebuild()?;
        }
        Ok(())
    }

    /// Root mean square roughness of both bodies on the track \[m\].
    fn roughness(&self) -> Result<[f64; 2], InputError> {
        let [ball, disc] = &self.bodies;
        Ok([self.track_rq(&ball.surface)?, self.track_rq(&disc.surface)?])
    }

    /// The record of the step of length `time_step` that the bodies have just taken, whose contact was solved
    /// under `conditions` on surfaces of roughness `rq`.
    fn record(
        &self,
        (report, attempts): (SolveReport, u32),
        flash_rise: Option<f64>,
        (conditions, rq): (Conditions, [f64; 2]),
        time_step: f64,
    ) -> Result<StepRecord, SimError> {
        let (state, grid) = (&self.state, self.contact.grid);
        let film = film_numbers(&self.contact, state)?;
        let limit = self.laws.plasticity.is_some().then_some(self.fields.yielding.limit.as_slice());
        let contact = contact_numbers(&self.contact, state, &self.fields.friction.solid, limit)?;
        let friction = self.fields.friction.shares(&self.contact)?;
        let composite_rq = metrics::composite_rq(rq[0], rq[1]);
        let over_rq = |film: f64| if composite_rq > 0.0 { film / composite_rq } else { 0.0 };
        let carrying = state.pressure.iter().filter(|p| **p > 0.0).count().max(1);
        let mean = |field: &[f64]| field.iter().sum::<f64>() / field.len() as f64;
        let largest = |field: &[f64]| field.iter().copied().fold(0.0, f64::max);
        let [ball, disc] = &self.bodies;
        let area = grid.cell_area();
        Ok(StepRecord {
            step: self.step,
            time: self.time + time_step,
            time_step,
            rq,
            composite_rq,
            average_film: film.mean_central,
            lambda: over_rq(film.mean_central),
            formula_lambda: over_rq(self.contact.stated_film),
            area_ratio: contact.area_ratio,
            load_ratio: contact.load_ratio,
            max_pressure: contact.max_pressure,
            mean_pressure: state.pressure.iter().sum::<f64>() / carrying as f64,
            mean_wear: [mean(ball.wear_depth()), mean(disc.wear_depth())],
            max_wear: [largest(ball.wear_depth()), largest(disc.wear_depth())],
            mean_film: [mean(ball.film_thickness()), mean(disc.film_thickness())],
            track_wear: [self.mean_on_track(ball.wear_depth())?, self.mean_on_track(disc.wear_depth())?],
            track_film: [
                self.mean_on_track(ball.film_thickness())?,
                self.mean_on_track(disc.film_thickness())?,
            ],
            plastic_volume: ball.volumes(area)?.plastic + disc.volumes(area)?.plastic,
            flash_rise,
            friction_coefficient: friction.coefficient,
            friction_boundary: friction.boundary,
            friction_fluid: friction.fluid,
            load: conditions.load,
            motion: conditions.motion,
            bulk_temperature: conditions.bulk_temperature,
            minimum_gap: film.minimum_gap,
            flow: self.contact.flow,
            attempts,
            report,
        })
    }
}
