//! The history of a contact: solve, grow, wear, flatten, move on.

use std::ops::ControlFlow;

use super::SimError;
use super::body::Body;
use super::builder::SimBuilder;
use super::contact::{ContactModel, contact_numbers, film_numbers};
use super::hertz::HertzContact;
use super::observer::Observer;
use super::record::StepRecord;
use super::scene::Scene;
use crate::error::InputError;
use crate::grid::Grid;
use crate::metrics;
use crate::plastic::{PlasticityModel, split_depth_into};
use crate::report::SolveReport;
use crate::reynolds::ContactState;
use crate::rubbing::RubbingPoint;
use crate::surface::{RoughnessMotion, add_shifted, copy_shifted};
use crate::tribochem::{FilmGrowthLaw, FlashTemperature};
use crate::wear::WearLaw;

/// Positions of the roughness that a step tries before it gives up.
const MAX_ATTEMPTS: u32 = 8;

/// The laws of a run; absent ones cost nothing.
#[derive(Debug)]
pub(super) struct Laws {
    pub(super) plasticity: Option<Box<dyn PlasticityModel>>,
    pub(super) growth: Option<Box<dyn FilmGrowthLaw>>,
    pub(super) wear: Option<Box<dyn WearLaw>>,
}

/// Where the roughness of ball and disc stands, in nodes.
type Shifts = [(usize, usize); 2];

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
/// Each step solves the quasi-static contact of the surfaces as they stand, advances tribofilm and wear over the
/// time step under its pressures, applies the plastic depth, and moves the roughness of both bodies to the
/// next position. One solve stands for all passages within the step. Nothing irreversible happens unless the
/// solve converged: where it did not, the step tries other positions of the roughness, and if all fail the step is
/// an error and the state is as before.
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
#[derive(Debug)]
pub struct MixedLubricationSim {
    scene: Scene,
    contact: ContactModel,
    laws: Laws,
    flash: Option<FlashTemperature>,
    motion: RoughnessMotion,
    bodies: [Body; 2],
    state: ContactState,
    time: f64,
    step: u64,
    draws: u64,
    fields: Fields,
    backup: [Body; 2],
}

/// Fields of the step in progress, all in the frame of the contact unless a name says otherwise.
#[derive(Debug)]
struct Fields {
    gap: Vec<f64>,
    heights: Vec<f64>,
    films: [Vec<f64>; 2],
    depths: [Vec<f64>; 2],
    limit: Vec<f64>,
    body_limits: [Vec<f64>; 2],
    split: [Vec<f64>; 2],
    on_body: Vec<f64>,
    solid: Vec<f64>,
    viscosity: Vec<f64>,
    shear: Vec<f64>,
    heat: Vec<f64>,
    rise: Vec<f64>,
}

impl Fields {
    fn new(n: usize) -> Self {
        let zeros = || vec![0.0; n];
        let pair = || [zeros(), zeros()];
        Self {
            gap: zeros(),
            heights: zeros(),
            films: pair(),
            depths: pair(),
            limit: zeros(),
            body_limits: pair(),
            split: pair(),
            on_body: zeros(),
            solid: zeros(),
            viscosity: zeros(),
            shear: zeros(),
            heat: zeros(),
            rise: zeros(),
        }
    }
}

impl MixedLubricationSim {
    /// A builder that makes the simulation of `scene`.
    pub fn builder(scene: Scene) -> SimBuilder {
        SimBuilder::new(scene)
    }

    pub(super) fn assemble(
        scene: Scene,
        contact: ContactModel,
        bodies: [Body; 2],
        laws: Laws,
        flash: Option<FlashTemperature>,
        motion: RoughnessMotion,
    ) -> Self {
        let grid = contact.grid;
        Self {
            scene,
            state: ContactState::new(&grid),
            fields: Fields::new(grid.len()),
            contact,
            laws,
            flash,
            motion,
            backup: bodies.clone(),
            bodies,
            time: 0.0,
            step: 0,
            draws: 0,
        }
    }

    /// The grid of the contact and of both bodies' patches.
    pub fn grid(&self) -> Grid {
        self.contact.grid
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Hertz contact of the smooth bodies.
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

    /// Whether the flash temperature is modelled.
    pub fn models_flash_temperature(&self) -> bool {
        self.flash.is_some()
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

    /// Takes one step of `time_step` \[s\].
    ///
    /// # Errors
    /// A time step that is negative or not finite; a contact that did not converge at any tried position of the
    /// roughness; a law that returned a value that is not finite. Bodies and time are then as before.
    pub fn step(&mut self, time_step: f64) -> Result<StepRecord, SimError> {
        InputError::require_positive("time_step", time_step)?;
        let (report, shifts, attempts) = self.solve_somewhere()?;
        let flash_rise = self.rub()?;
        for (backup, body) in self.backup.iter_mut().zip(&self.bodies) {
            backup.clone_from(body);
        }
        if let Err(error) = self.commit(time_step, shifts) {
            std::mem::swap(&mut self.bodies, &mut self.backup);
            return Err(error);
        }
        self.time += time_step;
        let record = self.record(report, attempts, flash_rise)?;
        self.step += 1;
        Ok(record)
    }

    /// Solves the contact at the next position of the roughness, or at further ones where that fails.
    fn solve_somewhere(&mut self) -> Result<(SolveReport, Shifts, u32), SimError> {
        let (nx, ny) = (self.contact.grid.nx(), self.contact.grid.ny());
        let tries = if self.motion == RoughnessMotion::Fixed { 1 } else { MAX_ATTEMPTS };
        let mut attempt = 1;
        loop {
            let draw = self.draws;
            let shifts = [0, 1].map(|body| self.motion.shift(body, draw, nx, ny));
            self.draws += 1;
            let report = self.solve_at(shifts)?;
            match report.require_converged() {
                Ok(report) => return Ok((report, shifts, attempt)),
                Err(source) if attempt >= tries => {
                    return Err(SimError::NotConverged { step: self.step, attempts: attempt, source });
                }
                Err(_) => attempt += 1,
            }
        }
    }

    fn solve_at(&mut self, shifts: Shifts) -> Result<SolveReport, SimError> {
        let (nx, ny) = (self.contact.grid.nx(), self.contact.grid.ny());
        let Self { fields, bodies, contact, laws, state, .. } = self;
        fields.gap.copy_from_slice(&contact.form_gap);
        for (index, body) in bodies.iter().enumerate() {
            copy_shifted(&body.surface, nx, ny, shifts[index], &mut fields.heights)?;
            for (gap, z) in fields.gap.iter_mut().zip(&fields.heights) {
                *gap -= z;
            }
            copy_shifted(body.film_thickness(), nx, ny, shifts[index], &mut fields.films[index])?;
            copy_shifted(body.plastic_depth(), nx, ny, shifts[index], &mut fields.depths[index])?;
        }
        let limit = match &laws.plasticity {
            None => None,
            Some(model) => {
                let [ball_film, disc_film] = &fields.films;
                let [ball_depth, disc_depth] = &fields.depths;
                model.contact_limit_into(
                    [ball_film, disc_film],
                    [ball_depth, disc_depth],
                    &mut fields.limit,
                )?;
                Some(fields.limit.as_slice())
            }
        };
        // The roughness has moved: the last pressures are no better a start than the dry contact.
        state.pressure.fill(0.0);
        contact.solve(&fields.gap, limit, state)
    }

    /// Shear, heat and temperature under the solved pressures; returns the largest flash rise \[K\].
    fn rub(&mut self) -> Result<f64, SimError> {
        let Self { fields, contact, state, scene, flash, .. } = self;
        let sliding = scene.motion.sliding_speed();
        for (k, solid) in fields.solid.iter_mut().enumerate() {
            *solid = state.solid_pressure(k);
        }
        fields.shear.fill(0.0);
        if let Some(lubricant) = &contact.lubricant {
            lubricant.viscosity().fill(&state.fluid_pressure, &mut fields.viscosity);
            let limit = Some(scene.friction.limiting_shear_stress);
            metrics::viscous_shear_into(&fields.viscosity, &state.film, sliding, limit, &mut fields.shear)?;
        }
        let boundary = scene.friction.boundary_coefficient;
        for (heat, (solid, shear)) in fields.heat.iter_mut().zip(fields.solid.iter().zip(&fields.shear)) {
            *heat = (boundary * solid + shear) * sliding;
        }
        match flash {
            None => Ok(0.0),
            Some(flash) => Ok(flash.rise(&fields.heat, &mut fields.rise)?.maximum),
        }
    }

    /// Applies wear, film growth and flattening to the bodies. The film grows half before and half after the wear, so
    /// that the wear coefficient is that of the middle of the step.
    fn commit(&mut self, time_step: f64, shifts: Shifts) -> Result<(), SimError> {
        let Self { fields, bodies, contact, laws, state, scene, .. } = self;
        let (nx, ny) = (contact.grid.nx(), contact.grid.ny());
        let boundary = scene.friction.boundary_coefficient;
        let (bulk, sliding) = (scene.thermal.bulk_temperature, scene.motion.sliding_speed());
        if let Some(model) = &laws.plasticity {
            flatten(model.as_ref(), fields, bodies, state, (nx, ny), shifts)?;
        }
        for (body, (sx, sy)) in bodies.iter_mut().zip(shifts) {
            let point = |node: usize| {
                // Where this node of the body stands in the frame of the contact.
                let (i, j) = ((node % nx + nx - sx) % nx, (node / nx + ny - sy) % ny);
                let k = j * nx + i;
                RubbingPoint {
                    pressure: state.pressure[k],
                    solid_pressure: fields.solid[k],
                    shear_stress: boundary * fields.solid[k] + fields.shear[k],
                    temperature: bulk + fields.rise[k],
                    sliding_speed: sliding,
                    film_thickness: state.film[k],
                    in_contact: state.in_contact[k],
                }
            };
            if let (Some(law), Some(film)) = (&laws.growth, &mut body.film) {
                film.advance(law.as_ref(), 0.5 * time_step, point)?;
            }
            if let Some(law) = &laws.wear {
                let thickness = body.film.as_ref().map(|film| film.thickness());
                body.wear.advance(law.as_ref(), time_step, |node| {
                    (point(node), thickness.map_or(0.0, |thickness| thickness[node]))
                })?;
            }
            if let (Some(law), Some(film)) = (&laws.growth, &mut body.film) {
                film.advance(law.as_ref(), 0.5 * time_step, point)?;
            }
            body.rebuild()?;
        }
        Ok(())
    }

    fn record(&self, report: SolveReport, attempts: u32, flash_rise: f64) -> Result<StepRecord, SimError> {
        let (state, grid) = (&self.state, self.contact.grid);
        let film = film_numbers(&self.contact, state)?;
        let contact = contact_numbers(&self.contact, state, &self.fields.solid, None)?;
        let rq = [
            metrics::height_statistics(&self.bodies[0].surface)?.sq,
            metrics::height_statistics(&self.bodies[1].surface)?.sq,
        ];
        let composite_rq = metrics::composite_rq(rq[0], rq[1]);
        let over_rq = |film: f64| if composite_rq > 0.0 { film / composite_rq } else { 0.0 };
        let carrying = state.pressure.iter().filter(|p| **p > 0.0).count().max(1);
        let mean = |field: &[f64]| field.iter().sum::<f64>() / field.len() as f64;
        let largest = |field: &[f64]| field.iter().copied().fold(0.0, f64::max);
        let [ball, disc] = &self.bodies;
        let area = grid.cell_area();
        Ok(StepRecord {
            step: self.step,
            time: self.time,
            rq,
            composite_rq,
            average_film: film.mean_central,
            lambda: over_rq(film.mean_central),
            lambda_old: over_rq(self.contact.formula_film()),
            area_ratio: contact.area_ratio,
            load_ratio: contact.load_ratio,
            max_pressure: contact.max_pressure,
            mean_pressure: state.pressure.iter().sum::<f64>() / carrying as f64,
            mean_wear: [mean(ball.wear_depth()), mean(disc.wear_depth())],
            max_wear: [largest(ball.wear_depth()), largest(disc.wear_depth())],
            mean_film: [mean(ball.film_thickness()), mean(disc.film_thickness())],
            plastic_volume: ball.volumes(area)?.plastic + disc.volumes(area)?.plastic,
            flash_rise,
            friction_coefficient: metrics::friction_coefficient(
                &grid,
                self.scene.friction.boundary_coefficient,
                &self.fields.solid,
                &self.fields.shear,
                self.contact.hertz.load,
            )?,
            minimum_gap: film.minimum_gap,
            attempts,
            report,
        })
    }
}

/// Adds the plastic depth of the solve to the softer body of each node.
fn flatten(
    model: &dyn PlasticityModel,
    fields: &mut Fields,
    bodies: &mut [Body; 2],
    state: &ContactState,
    (nx, ny): (usize, usize),
    shifts: Shifts,
) -> Result<(), SimError> {
    for index in 0..2 {
        let nodes = fields.films[index].iter().zip(&fields.depths[index]);
        for (limit, (film, depth)) in fields.body_limits[index].iter_mut().zip(nodes) {
            *limit = model.pressure_limit(*film, *depth);
        }
    }
    let [ball, disc] = &mut fields.split;
    let [ball_limit, disc_limit] = &fields.body_limits;
    split_depth_into(&state.plastic_depth, [ball_limit, disc_limit], [ball, disc])?;
    for (index, body) in bodies.iter_mut().enumerate() {
        fields.on_body.fill(0.0);
        add_shifted(&fields.split[index], nx, ny, shifts[index], &mut fields.on_body)?;
        body.plastic.add(&fields.on_body)?;
    }
    Ok(())
}
