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
use crate::report::SolveReport;
use crate::reynolds::ContactState;
use crate::sim::contact::error_estimate::ErrorEstimate;
use crate::sim::contact::film_heat::FilmIteration;
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::interrupt::Interrupt;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::SimError;
use crate::sim::history::body::Body;
use crate::sim::history::contact_exposure::StepBuffers;
use crate::sim::history::half_mesh::HalfMesh;
use crate::sim::history::heat::Heat;
use crate::sim::history::placement::{Placement, SurfaceMotion};
use crate::sim::history::record::StepRecord;
use crate::sim::history::squeeze_memory::SqueezeMemory;
use crate::sim::history::step_control::StepControl;
use crate::sim::history::yielding::Yielding;
use crate::sim::scene::Scene;
use crate::sim::scene::operating_schedule::{Conditions, OperatingSchedule};

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
    pub(in crate::sim) buffers: StepBuffers,
    /// Mass of the squeeze term.
    pub(in crate::sim) squeezed: Vec<f64>,
    /// The bodies before the present step.
    pub(in crate::sim) backup: [Body; 2],
    /// The contact before the present step.
    pub(in crate::sim) before: ContactState,
    /// Factor of the time of wear and growth: the cycles that a solved one stands for.
    pub(in crate::sim) represented_cycles: f64,
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
            represented_cycles: 1.0,
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
        match self.step_in_box(control) {
            Err(SimError::BoxTooSmall(edge)) if self.scene.grid.grows() => {
                self.step_in_wider_box(control, edge)
            }
            outcome => outcome,
        }
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
        let rq = self.roughness();
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
        self.warn_of_wear(&record);
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
}
