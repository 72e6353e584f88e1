//! The history of a contact: solve, flatten, grow, wear, move.
//!
//! One step, in this order:
//!
//! 1. conditions: load, speeds and temperature at the start of the step;
//! 2. solve: the bodies at the next position of the roughness, at further ones if that does not converge,
//!    with friction and, if modelled, the film temperature;
//! 3. flash temperature under the solved pressures;
//! 4. commit: flattening, half of the film growth, wear, the other half; the step is shortened if a node
//!    changes by more than the bound;
//! 5. record, and the masses for the squeeze term of the next contact.
//!
//! Bodies change in 4 only, and only if 2 has converged; an error restores the previous state.

use crate::error::InputError;
use crate::lubricant::Lubricant;
use crate::report::SolveReport;
use crate::reynolds::ContactState;
use crate::sim::contact::error_estimate::ErrorEstimate;
use crate::sim::contact::film_heat::{self, FilmIteration, SolveContext, Solved};
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::interrupt::Interrupt;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::numbers::{DepthNumbers, Numbers, PlasticNumbers, WearNumbers};
use crate::sim::contact::outer_rows::{self, Change};
use crate::sim::contact::strip;
use crate::sim::contact::warnings::{self, Warning};
use crate::sim::error::SimError;
use crate::sim::history::body::Body;
use crate::sim::history::contact_exposure::{ContactExposure, StepBuffers};
use crate::sim::history::exposure;
use crate::sim::history::half_mesh::HalfMesh;
use crate::sim::history::heat::Heat;
use crate::sim::history::placement::{Offsets, Placement, SurfaceMotion};
use crate::sim::history::record::StepRecord;
use crate::sim::history::squeeze_memory::{Entrainment, SqueezeMemory};
use crate::sim::history::step_control::StepControl;
use crate::sim::history::yielding::Yielding;
use crate::sim::scene::Scene;
use crate::sim::scene::operating_schedule::{Conditions, OperatingSchedule};

/// Most positions of the roughness tried in a step.
const MAX_ATTEMPTS: u32 = 8;
/// Most reductions of the length of a step.
const MAX_CUTS: usize = 40;

/// A rough lubricated contact whose surfaces yield, grow a tribofilm and wear in sliding.
///
/// Each step solves the quasi-static contact of the present surfaces. Tribofilm and wear advance under its
/// pressures for the exposure time of the nodes ([`Exposure`](crate::sim::scene::Exposure)), the plastic depth
/// is added, and the roughness of both bodies moves to its next position. One solve represents all passages
/// within the step. Irreversible changes need a converged solve: if it does not converge, the step tries other
/// positions of the roughness; if all fail, the step is an error and the state is unchanged.
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, RunEnd, Scene, StepRecord};
/// use std::ops::ControlFlow;
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(32).with_tribofilm()).build()?;
/// let mut wear = Vec::new();
/// let end = sim.run(3, 10.0, &mut |_: &MixedLubricationSim, record: &StepRecord| {
///     wear.push(record.wear.disc_mean);
///     ControlFlow::Continue(())
/// })?;
/// assert_eq!(end, RunEnd::Finished);
/// assert!(wear[2] > wear[0]);
/// assert!(sim.ledger_residual()? < 1e-20);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
///
/// Clones are independent and continue exactly as the original would. They share laws but no buffers; the
/// solver allocates its buffers again at its first solve.
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build()?;
/// sim.step(60.0)?;
/// let mut other = sim.clone();
/// let short = std::thread::spawn(move || other.step(10.0)).join().expect("no panic")?;
/// assert!(sim.step(60.0)?.wear.disc_mean > short.wear.disc_mean);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone)]
pub struct MixedLubricationSim {
    /// The scene it was built from.
    pub(in crate::sim) scene: Scene,
    /// Conditions over time.
    pub(in crate::sim) operating_schedule: OperatingSchedule,
    /// The contact problem with its solver.
    pub(in crate::sim) contact: ContactModel,
    /// Laws of plasticity, wear, growth and friction.
    pub(in crate::sim) laws: Laws,
    /// Flash temperature of the present contact.
    pub(in crate::sim) heat: Heat,
    /// Motion of the roughness and squeeze.
    pub(in crate::sim) surface_motion: SurfaceMotion,
    /// Ball and disc after the last step.
    pub(in crate::sim) bodies: [Body; 2],
    /// Solution of the last step.
    pub(in crate::sim) state: ContactState,
    /// Start of the first solve; `None` for a cold start.
    pub(in crate::sim) contact_start: Option<ContactState>,
    /// Masses of the last two contacts.
    pub(in crate::sim) squeeze_memory: SqueezeMemory,
    /// Simulated time \[s\].
    pub(in crate::sim) time: f64,
    /// Number of committed steps.
    pub(in crate::sim) step: u64,
    /// Number of roughness positions tried; with the seed, the state of the random generator.
    pub(in crate::sim) draws: u64,
    /// Bodies at their positions in the present step.
    pub(in crate::sim) placement: Placement,
    /// Pressure limit and flattening.
    pub(in crate::sim) yielding: Yielding,
    /// Shear stresses.
    pub(in crate::sim) friction: FrictionFields,
    /// Temperature of the film; `None` for an isothermal film.
    pub(in crate::sim) film_heat: Option<FilmIteration>,
    /// The contact on half the cells; `None` if the scene requests no errors.
    pub(in crate::sim) half_mesh: Option<Box<HalfMesh>>,
    /// Buffers on the nodes of a body.
    buffers: StepBuffers,
    /// Mass of the squeeze term.
    squeezed: Vec<f64>,
    /// The bodies before the present step.
    pub(in crate::sim) backup: [Body; 2],
    /// The contact before the present step.
    before: ContactState,
    /// Whether the grid may be a strip: in passages and cycles, which have no wear.
    pub(in crate::sim) takes_strips: bool,
    /// Warnings so far.
    pub(in crate::sim) warnings: Vec<Warning>,
    /// Interrupt of solves, also in a wider box.
    pub(in crate::sim) interrupt: Option<Interrupt>,
    /// Custom components.
    #[cfg(feature = "serde")]
    pub(in crate::sim) custom_identity: crate::sim::history::identity::CustomIdentity,
}

impl MixedLubricationSim {
    /// A simulation at time zero from the parts of its builder.
    pub(in crate::sim) fn assemble(
        (scene, operating_schedule, warnings): (Scene, OperatingSchedule, Vec<Warning>),
        contact: ContactModel,
        bodies: [Body; 2],
        laws: Laws,
        heat: Heat,
        surface_motion: SurfaceMotion,
    ) -> Result<Self, InputError> {
        let grid = contact.grid;
        Ok(Self {
            state: ContactState::new(&grid),
            contact_start: None,
            squeeze_memory: SqueezeMemory::new(grid.len()),
            placement: Placement::new(grid),
            yielding: Yielding::new(grid.len()),
            friction: FrictionFields::new(&scene, grid.len())?,
            film_heat: FilmIteration::new(&scene, &contact)?,
            half_mesh: None,
            buffers: StepBuffers::new(grid.len()),
            squeezed: vec![0.0; grid.len()],
            scene,
            operating_schedule,
            contact,
            laws,
            heat,
            surface_motion,
            backup: bodies.clone(),
            bodies,
            time: 0.0,
            step: 0,
            draws: 0,
            before: ContactState::new(&grid),
            takes_strips: false,
            warnings,
            interrupt: None,
            #[cfg(feature = "serde")]
            custom_identity: crate::sim::history::identity::CustomIdentity::default(),
        })
    }

    /// Takes one step of `time_step` \[s\] under the conditions at its start.
    ///
    /// # Errors
    /// A time step that is not finite and positive; a contact that did not converge at any position of the
    /// roughness; solids, wear or a tribofilm at the edge of a box that does not grow; a value of a law that is
    /// not finite; an [interrupt](crate::sim::SimBuilder::interrupt). The state is then unchanged, so that a
    /// further step of this length fails too.
    pub fn step(&mut self, time_step: f64) -> Result<StepRecord, SimError> {
        self.step_within(&StepControl::fixed(time_step))
    }

    /// Takes one step as long as `control` allows: one contact solve, then the longest step under its pressures in
    /// which no node wears or grows by more than the bound. The record holds its length.
    ///
    /// # Errors
    /// As of [`MixedLubricationSim::step`], and laws that exceed the bound in any time.
    pub fn step_within(&mut self, control: &StepControl) -> Result<StepRecord, SimError> {
        control.validate()?;
        self.require_no_strip_history()?;
        match self.step_in_box(control) {
            Err(SimError::BoxTooSmall(edge)) if self.scene.grid.grows() => {
                self.step_in_wider_box(control, edge)
            }
            outcome => outcome,
        }
    }

    /// Rejects histories of strips, unless passages and cycles take their steps.
    fn require_no_strip_history(&self) -> Result<(), InputError> {
        if self.takes_strips { Ok(()) } else { strip::require_single_contact(&self.scene) }
    }

    /// As [`step_within`](Self::step_within), without widening the box.
    pub(in crate::sim) fn step_in_box(&mut self, control: &StepControl) -> Result<StepRecord, SimError> {
        let (draws, saved) = (self.draws, self.contact.saved());
        self.before.clone_from(&self.state);
        for (backup, body) in self.backup.iter_mut().zip(&self.bodies) {
            backup.clone_from(body);
        }
        let outcome = self.take_step(control);
        if outcome.is_err() {
            self.draws = draws;
            self.contact.restore_conditions(saved);
            std::mem::swap(&mut self.state, &mut self.before);
            std::mem::swap(&mut self.bodies, &mut self.backup);
        }
        outcome
    }

    /// Takes a step; an error leaves contact and bodies in their intermediate state.
    fn take_step(&mut self, control: &StepControl) -> Result<StepRecord, SimError> {
        let conditions = self.conditions();
        self.contact.set_conditions(&self.scene, &conditions)?;
        self.heat.move_at(conditions.motion.surface_speeds(), &self.contact.grid)?;
        let (solved, offsets, attempts) = self.solve_at_some_position()?;
        let error_estimate = self.estimate_errors(&conditions, &solved.0)?;
        let flash_rise = self.heat.update(&self.friction, self.film_heat.as_ref())?;
        let rq = self.roughness()?;
        let time_step = self.commit_within(control, offsets)?;
        self.require_changes_inside()?;
        let mut record = self.record((solved, attempts), flash_rise, (conditions, rq), time_step)?;
        record.error_estimate = error_estimate;
        self.time = record.time;
        if let Some(heat) = &mut self.film_heat {
            heat.commit();
        }
        let at = (conditions.motion.entrainment_speed, self.contact.film_cutoff);
        self.squeeze_memory.keep(&self.state, at, time_step);
        if self.step == 0 {
            self.warn_of_first(&record);
        }
        self.warn_of_left_out(&record, conditions);
        if self.warnings.iter().all(|warning| !warnings::DEEP_WEAR.contains(&warning.field.as_str())) {
            let depths = [record.wear.ball_max, record.wear.disc_max];
            self.warnings.extend(warnings::deep_wear(depths, self.half_width()));
        }
        self.step += 1;
        Ok(record)
    }

    /// Estimated errors of the contact solved under `conditions`. `None` if not requested, with squeeze, or if the contact
    /// on half the cells does not converge.
    fn estimate_errors(
        &mut self,
        conditions: &Conditions,
        report: &SolveReport,
    ) -> Result<Option<ErrorEstimate>, SimError> {
        let Some(half) = self.half_mesh.as_mut().filter(|_| !self.surface_motion.squeeze) else {
            return Ok(None);
        };
        let limit = self.laws.plasticity.is_some().then_some(self.yielding.limit.as_slice());
        let fine = (&self.contact, report, &self.state, &self.friction, limit);
        half.estimate(&self.laws, conditions, &self.placement, fine)
    }

    /// Warnings about the first contact.
    fn warn_of_first(&mut self, record: &StepRecord) {
        let seen = warnings::SolvedContact {
            hertz: &self.contact.hertz,
            dx: self.contact.grid.dx(),
            smooth: record.roughness.composite_rq == 0.0,
            largest_pressure: record.pressure.max,
            central_film: record.film.central,
            friction: record.friction.coefficient,
            load_ratio: record.contact.load_ratio,
            temperatures: record.thermal.map(|heat| [heat.film_temperature_max, record.bulk_temperature]),
        };
        self.warnings.extend(warnings::of_contact(&self.scene, &seen, false));
    }

    /// Warnings about physics that the scene leaves out under these conditions and about errors of the mesh, each once a
    /// run.
    fn warn_of_left_out(&mut self, record: &StepRecord, conditions: Conditions) {
        let point = warnings::OperatingPoint {
            hertz: &self.contact.hertz,
            conditions,
            viscosity: self.contact.lubricant.as_ref().map(Lubricant::viscosity),
            smooth: record.roughness.composite_rq == 0.0,
            friction: [record.friction.boundary, record.friction.fluid],
            film: record.film.mean_central,
            load_ratio: record.contact.load_ratio,
            yield_ratio: None,
        };
        let mut found = warnings::left_out(&self.scene, &point);
        let rough = record.roughness.composite_rq > 0.0;
        let is_said = self.warnings.iter().any(|warning| warning.field.starts_with("error_estimate."));
        if let Some(estimate) = record.error_estimate.filter(|_| !is_said) {
            found.extend(warnings::large_errors(&estimate, rough));
        }
        found.retain(|warning| self.warnings.iter().all(|known| known.field != warning.field));
        self.warnings.extend(found);
    }

    /// Commits the longest step that `control` allows and returns its length.
    fn commit_within(&mut self, control: &StepControl, offsets: Offsets) -> Result<f64, SimError> {
        let mut time_step = control.longest;
        for _ in 0..MAX_CUTS {
            self.commit(time_step, offsets)?;
            let change = self.largest_change();
            if change.min(control.depth) > self.half_width() {
                return Err(SimError::Input(InputError::Conflict {
                    field: format!("time_step = {time_step:e}"),
                    reason: format!(
                        "a node would change by {change:.1e} m, more than the half-width of the contact: take shorter steps, or check \
                         the coefficient of wear"
                    ),
                }));
            }
            if change <= control.depth {
                return Ok(time_step);
            }
            for (body, backup) in self.bodies.iter_mut().zip(&self.backup) {
                body.clone_from(backup);
            }
            time_step *= (0.98 * control.depth / change).clamp(0.02, 0.98);
        }
        Err(SimError::Input(InputError::Conflict {
            field: format!("depth = {:?}", control.depth),
            reason: format!("the laws change a node by more than it even within {time_step:e} s"),
        }))
    }

    /// Rejects a step in which wear or a tribofilm has reached the edge of the box.
    fn require_changes_inside(&self) -> Result<(), SimError> {
        if self.scene.solver.edge_contact {
            return Ok(());
        }
        let Conditions { motion, bulk_temperature, .. } = self.conditions();
        let speeds = motion.surface_speeds();
        let growth = self.laws.growth.as_deref();
        let by_solids = growth.is_some_and(|law| outer_rows::needs_solids(law, bulk_temperature));
        for (body, (now, before)) in self.bodies.iter().zip(&self.backup).enumerate() {
            let change = Change {
                body,
                visits: exposure::visits(self.surface_motion.motion.as_ref(), speeds[body]),
                wear: [now.wear(), before.wear()],
                film: by_solids.then(|| [now.tribofilm(), before.tribofilm()]),
            };
            let contact_film = self.scene.solver.film_cutoff;
            change.require_inside(&self.contact.grid, &self.contact.hertz, contact_film)?;
        }
        Ok(())
    }

    /// Smaller half-width of the Hertz contact \[m\].
    fn half_width(&self) -> f64 {
        self.contact.hertz.half_width_x.min(self.contact.hertz.half_width_y)
    }

    /// Largest change of wear or film of any node since the backup \[m\].
    fn largest_change(&self) -> f64 {
        let fields = self.bodies.iter().zip(&self.backup).flat_map(|(now, before)| {
            let wear = now.wear().iter().zip(before.wear());
            wear.chain(now.tribofilm().iter().zip(before.tribofilm()))
        });
        fields.fold(0.0, |largest, (now, before)| largest.max((now - before).abs()))
    }

    /// Solves the contact at the next position of the roughness, or at further ones if that fails.
    fn solve_at_some_position(&mut self) -> Result<(Solved, Offsets, u32), SimError> {
        let mut attempt = 1;
        loop {
            let offsets = self.offsets()?;
            self.draws += 1;
            let (report, heat) = self.solve_at(offsets)?;
            match report.require_converged() {
                Ok(()) => return Ok(((report, heat), offsets, attempt)),
                // Without another position a further attempt would be the same.
                Err(source) if attempt >= MAX_ATTEMPTS || self.offsets()? == offsets => {
                    return Err(SimError::NotConverged { step: self.step, attempts: attempt, source });
                }
                // With squeeze a solve starts from the previous state: restore the last converged one.
                Err(_) => {
                    self.state.clone_from(&self.before);
                    attempt += 1;
                }
            }
        }
    }

    /// Offsets of the roughness at the next solve.
    fn offsets(&self) -> Result<Offsets, InputError> {
        let speeds = self.operating_schedule.mean_speeds(self.time);
        self.surface_motion.offsets(self.draws, self.time, speeds, &self.contact.grid)
    }

    /// Returns the input errors of the next solve without solving.
    pub(in crate::sim) fn check_first_contact(&mut self) -> Result<(), SimError> {
        self.require_no_strip_history()?;
        let offsets = self.offsets()?;
        let Self { bodies, contact, laws, state, contact_start, placement, yielding, .. } = self;
        placement.place(bodies, &contact.form_gap, offsets)?;
        contact.set_tribofilms(&placement.films)?;
        let limit = match &laws.plasticity {
            None => None,
            Some(models) => {
                yielding.start(models, &placement.films, &placement.depths)?;
                Some(yielding.limit.as_slice())
            }
        };
        Ok(contact.check(&placement.gap, limit, contact_start.as_ref().unwrap_or(state))?)
    }

    /// Solves the contact of the bodies at `offsets` with its shear stresses and, if modelled, the film
    /// temperature.
    pub(in crate::sim) fn solve_at(&mut self, offsets: Offsets) -> Result<Solved, SimError> {
        let Self { contact, laws, state, placement, yielding, squeeze_memory, squeezed, .. } = self;
        placement.place(&self.bodies, &contact.form_gap, offsets)?;
        contact.set_tribofilms(&placement.films)?;
        let squeeze = if self.surface_motion.squeeze {
            squeeze_memory.squeeze(self.step, Entrainment::of(contact), squeezed)?
        } else {
            None
        };
        // With squeeze the previous film is close to the next one: keep it as a start. Otherwise the roughness
        // has moved far, and the dry contact is as good a start.
        match self.contact_start.as_ref().filter(|_| self.step == 0) {
            Some(start) => state.clone_from(start),
            None if squeeze.is_none() => state.pressure.fill(0.0),
            None => {}
        }
        if let Some(heat) = &mut self.film_heat {
            heat.move_at(contact.motion.surface_speeds(), &contact.grid)?;
        }
        let given = SolveContext { laws, tribofilms: &placement.films };
        let models = laws.plasticity.as_ref();
        let mut once = |contact: &mut ContactModel, state: &mut ContactState| {
            yielding.solve(models, placement, contact, squeeze, state)
        };
        let heat = self.film_heat.as_mut();
        let solved = film_heat::solve(&given, heat, (contact, state, &mut self.friction), &mut once);
        outer_rows::require_solids_inside(&self.scene, (contact, state), solved)
    }

    /// Applies flattening, wear and film growth of a step of `time_step` \[s\] to the bodies.
    fn commit(&mut self, time_step: f64, offsets: Offsets) -> Result<(), SimError> {
        let Conditions { motion, bulk_temperature, .. } = self.conditions();
        let Self { bodies, contact, laws, state, yielding, friction, buffers, .. } = self;
        let (grid, speeds) = (&contact.grid, motion.surface_speeds());
        let (track, roughness_motion) = (&self.scene.track, self.surface_motion.motion.as_ref());
        let time_weight = |exposure| {
            exposure::time_weight((track, exposure), roughness_motion, grid, &contact.hertz, speeds)
        };
        let wear_exposure = self.scene.wear.map_or(track.exposure, |wear| wear.exposure);
        let contact_exposure = ContactExposure {
            grid,
            state,
            friction,
            rises: self.heat.rises(),
            bulk: bulk_temperature,
            sliding: motion.sliding_speed(),
            offsets,
            time_weight: time_weight(track.exposure)?,
            wear_time_weight: time_weight(wear_exposure)?,
        };
        if laws.plasticity.is_some() {
            yielding.share(&state.plastic_depth)?;
            buffers.flatten(bodies, &contact_exposure, &yielding.split, time_step)?;
        }
        buffers.wear_and_grow(bodies, &contact_exposure, laws, time_step)
    }

    /// Root mean square roughness of both bodies on the track \[m\].
    fn roughness(&self) -> Result<[f64; 2], InputError> {
        let [ball, disc] = &self.bodies;
        Ok([self.track_rq(&ball.surface)?, self.track_rq(&disc.surface)?])
    }

    /// The record of the step of length `time_step` just taken, whose contact was solved under `conditions` on
    /// surfaces of roughness `rq`.
    fn record(
        &self,
        ((report, heat), attempts): (Solved, u32),
        flash_rise: Option<f64>,
        (conditions, rq): (Conditions, [f64; 2]),
        time_step: f64,
    ) -> Result<StepRecord, SimError> {
        let limit = self.laws.plasticity.is_some().then_some(self.yielding.limit.as_slice());
        let numbers = Numbers::of(&self.contact, &self.state, Some(&self.friction), limit, rq)?;
        let depths = |field: fn(&Body) -> &[f64]| {
            DepthNumbers::of(self.bodies.each_ref().map(field), |values| self.mean_on_track(values))
        };
        let [ball, disc] = self.bodies.each_ref().map(|body| body.volumes(self.contact.grid.cell_area()));
        let volume = (ball?.plastic + disc?.plastic) / self.contact.grid.contact_length();
        Ok(StepRecord {
            step: self.step,
            time: self.time + time_step,
            time_step,
            load: conditions.load,
            motion: conditions.motion,
            bulk_temperature: conditions.bulk_temperature,
            roughness: numbers.roughness,
            film: numbers.film,
            pressure: numbers.pressure,
            contact: numbers.contact,
            friction: numbers.friction,
            flow: self.contact.flow,
            thermal: heat.map(|(numbers, _)| numbers),
            flash_rise,
            wear: WearNumbers::of(depths(Body::wear)?, self.bodies.each_ref().map(Body::worn_volume)),
            tribofilm: depths(Body::tribofilm)?,
            plastic: PlasticNumbers { volume },
            error_estimate: None,
            attempts,
            report,
        })
    }
}
