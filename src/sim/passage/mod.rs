//! Single contacts whose roughness moves: means over a passage of the surfaces.
//!
//! The roughness of each body moves at its speed, and the film squeezes and carries waves. Each step passes one cell of the
//! faster surface. After a start-up, in which the film is carried from the inlet edge of the box to the end of the Hertz
//! contact, means are taken over the passage.

mod mean_contact;
mod pitches;

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::error::InputError;
use crate::grid::Grid;
use crate::report::SolveReport;
use crate::sim::contact::strip;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::{BoxTooSmall, SimError};
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::observer::Observer;
use crate::sim::history::record::StepRecord;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::{GridSpec, RoughnessState, Scene};
use crate::surface::Advected;

/// Most contacts of a passage.
const MOST_CONTACTS: f64 = 1e6;

/// Mean of a quantity over the contacts of a passage, and its scatter.
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scatter;
/// let scatter = Scatter::of(&[1.0, 3.0]);
/// assert_eq!((scatter.mean, scatter.minimum, scatter.maximum), (2.0, 1.0, 3.0));
/// assert!((scatter.standard_deviation - 1.0).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Scatter {
    /// Mean.
    pub mean: f64,
    /// Standard deviation about the mean.
    pub standard_deviation: f64,
    /// Smallest value.
    pub minimum: f64,
    /// Largest value.
    pub maximum: f64,
}

impl Scatter {
    /// That of `values`; NaN without values.
    pub fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
        let extreme = |pick: fn(f64, f64) -> f64| values.iter().copied().reduce(pick).unwrap_or(f64::NAN);
        Self {
            mean,
            standard_deviation: variance.sqrt(),
            minimum: extreme(f64::min),
            maximum: extreme(f64::max),
        }
    }
}

/// Means over the contacts of a passage, under the names of a single contact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct PassageNumbers {
    /// Mean film over r <= 2a/3 \[m\].
    pub film_mean_central: Scatter,
    /// Smallest film of nodes under pressure \[m\].
    pub film_minimum: Scatter,
    /// Largest pressure \[Pa\].
    pub pressure_max: Scatter,
    /// Share of the load on solids.
    pub contact_load_ratio: Scatter,
    /// Friction coefficient.
    pub friction_coefficient: Scatter,
}

impl PassageNumbers {
    /// Those of the contacts in `records`.
    fn of(records: &[StepRecord]) -> Self {
        let of = |value: fn(&StepRecord) -> f64| Scatter::of(&records.iter().map(value).collect::<Vec<_>>());
        Self {
            film_mean_central: of(|record| record.film.mean_central),
            film_minimum: of(|record| record.film.minimum),
            pressure_max: of(|record| record.pressure.max),
            contact_load_ratio: of(|record| record.contact.load_ratio),
            friction_coefficient: of(|record| record.friction.coefficient),
        }
    }
}

/// A passage of rough surfaces through a contact.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct PassageSolution {
    /// The grid.
    pub grid: Grid,
    /// Hertz contact of the smooth bodies; of a line contact per metre.
    pub hertz: HertzContact,
    /// Time in which the faster surface passes one cell \[s\].
    pub time_step: f64,
    /// Number of contacts of the start-up.
    pub start_up: usize,
    /// All contacts, those of the start-up first.
    pub records: Vec<StepRecord>,
    /// Means over the contacts after the start-up.
    pub means: PassageNumbers,
    /// Reason for an early end: a contact that did not converge, or one whose solids reach the edge of the box. Means are
    /// those of the contacts before it.
    pub ended_early: Option<String>,
    /// Report of the contact that did not converge.
    pub failure: Option<SolveReport>,
    /// Warnings.
    pub warnings: Vec<Warning>,
}

impl PassageSolution {
    /// The contacts after the start-up.
    pub fn passage(&self) -> &[StepRecord] {
        self.records.get(self.start_up..).unwrap_or_default()
    }

    /// The last contact, with the means of the passage in place of its numbers; those of all contacts of a passage that
    /// ended in the start-up.
    pub(in crate::sim) fn mean_record(&self) -> Option<StepRecord> {
        let passage = self.passage();
        mean_contact::mean_record(if passage.is_empty() { &self.records } else { passage })
    }
}

/// A passage before its first contact.
pub(in crate::sim) struct ReadyPassage {
    sim: MixedLubricationSim,
    time_step: f64,
    start_up: usize,
    contacts: usize,
}

/// A passage after its last contact.
pub(in crate::sim) struct SolvedPassage {
    pub(in crate::sim) solution: PassageSolution,
    /// The simulation at its end.
    pub(in crate::sim) sim: MixedLubricationSim,
    /// The box whose edge ended the passage.
    pub(in crate::sim) too_small: Option<BoxTooSmall>,
}

impl SimBuilder {
    /// Solves the contact with its roughness in motion ([`RoughnessState::Moving`]) under the conditions at time zero.
    /// `observer` is called after each contact, in the start-up too, and may stop the passage.
    ///
    /// Asperities that yield stay flattened when they pass again. Wear and growth of a tribofilm are left out.
    ///
    /// # Errors
    /// A scene that does not fit: dry, a box that grows or is chosen by an accuracy, the law of asperity inlets. A contact
    /// that does not converge is no error: see [`PassageSolution::ended_early`].
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use stribeck::sim::{MixedLubricationSim, Scene, StepRecord};
    /// let mut scene = Scene::azam_2019(24);
    /// (scene.motion.slide_roll_ratio, scene.plastic) = (0.5, None);
    /// scene.motion.entrainment_speed = 5.0;
    /// let mut films = Vec::new();
    /// let passage = MixedLubricationSim::builder(scene).solve_passage(&mut |_: &MixedLubricationSim, record: &StepRecord| {
    ///     films.push(record.film.mean_central);
    ///     ControlFlow::Continue(())
    /// })?;
    /// assert_eq!(films.len(), passage.records.len());
    /// assert!(passage.means.film_mean_central.standard_deviation > 0.0);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn solve_passage(self, observer: &mut impl Observer) -> Result<PassageSolution, SimError> {
        Ok(self.begin_passage()?.run(observer)?.solution)
    }

    /// The warnings of [`solve_passage`](Self::solve_passage) that are known before its first contact, and the number of its
    /// contacts with those of the start-up.
    ///
    /// # Errors
    /// The input errors of [`solve_passage`](Self::solve_passage).
    pub fn check_passage(self) -> Result<(Vec<Warning>, usize), SimError> {
        let mut ready = self.begin_passage()?;
        ready.sim.check_first_contact()?;
        Ok((ready.sim.warnings().to_vec(), ready.contacts))
    }

    /// The simulation of the passage, and its steps.
    pub(in crate::sim) fn begin_passage(self) -> Result<ReadyPassage, SimError> {
        let length = self.scene.motion.passage;
        ReadyPassage::new(self.in_motion()?, length)
    }

    /// The simulation of surfaces that pass with their roughness, under the conditions at time zero.
    pub(in crate::sim) fn in_motion(mut self) -> Result<MixedLubricationSim, SimError> {
        require_passage(&self.scene)?;
        self.scene = steady_scene(self.scene)?;
        self.motion = Some(Arc::new(Advected));
        self.squeeze = true;
        let sim = self.build()?;
        pitches::require_whole(sim.scene(), sim.grid().size_x())?;
        Ok(sim)
    }
}

impl ReadyPassage {
    /// The passage of the film length `length` \[m\], by default that of the box, through the contact of `sim`, whose
    /// surfaces are [in motion](SimBuilder::in_motion).
    pub(in crate::sim) fn new(sim: MixedLubricationSim, length: Option<f64>) -> Result<Self, SimError> {
        let (grid, conditions) = (sim.grid(), sim.conditions());
        let length = length.unwrap_or(grid.size_x());
        InputError::require_positive("motion.passage", length)?;
        let fastest = conditions.motion.surface_speeds().map(f64::abs).into_iter().fold(0.0, f64::max);
        // Cells that the mean flow passes in a step in which the faster surface passes one.
        let film_step = grid.dx() * conditions.motion.entrainment_speed / fastest;
        let upstream = 0.5 * grid.dx() - grid.x(0);
        let hertz = sim.contact.hertz_under(&sim.scene, conditions.load)?;
        let start_up = ((upstream + hertz.half_extents()[0]) / film_step).ceil();
        let contacts = start_up + (length / film_step).ceil().max(1.0);
        let requirement = "short enough for at most 1e6 steps of one cell";
        InputError::require(contacts <= MOST_CONTACTS, "motion.passage", length, requirement)?;
        let time_step = grid.dx() / fastest;
        Ok(Self { sim, time_step, start_up: start_up as usize, contacts: contacts as usize })
    }

    /// Solves all contacts.
    pub(in crate::sim) fn run(self, observer: &mut impl Observer) -> Result<SolvedPassage, SimError> {
        let Self { mut sim, time_step, start_up, contacts } = self;
        let (mut records, mut ended_early, mut failure) = (Vec::with_capacity(contacts), None, None);
        let mut too_small = None;
        while records.len() < contacts {
            match sim.step_with_restart(time_step) {
                Ok(record) => {
                    let flow = observer.after_step(&sim, &record);
                    records.push(record);
                    if flow == ControlFlow::Break(()) {
                        ended_early = Some("stopped by the observer".to_owned());
                        break;
                    }
                }
                Err(SimError::NotConverged { source, step, .. }) if !records.is_empty() => {
                    ended_early = Some(format!("contact {step} was not solved: {source}"));
                    failure = Some(*source.report);
                    break;
                }
                Err(SimError::BoxTooSmall(error)) if !records.is_empty() => {
                    ended_early = Some(error.to_string());
                    too_small = Some(error);
                    break;
                }
                Err(error) => return Err(error),
            }
        }
        let solution = PassageSolution {
            grid: sim.grid(),
            hertz: sim.hertz(),
            time_step,
            start_up,
            means: PassageNumbers::of(records.get(start_up..).unwrap_or_default()),
            records,
            ended_early,
            failure,
            warnings: sim.warnings().to_vec(),
        };
        Ok(SolvedPassage { solution, sim, too_small })
    }
}

/// `scene` under its conditions at time zero for all times, with its roughness at rest and without wear.
fn steady_scene(mut scene: Scene) -> Result<Scene, SimError> {
    scene.schedule.read_tables()?;
    let start = scene.conditions(0.0)?;
    if scene.schedule.load.is_some() {
        (scene.load.force, scene.load.hertz_pressure) = (Some(start.load), None);
    }
    (scene.motion, scene.thermal.bulk_temperature) = (start.motion, start.bulk_temperature);
    (scene.motion.roughness, scene.motion.passage) = (RoughnessState::AtRest, None);
    (scene.schedule, scene.track, scene.wear) = (Default::default(), Default::default(), None);
    Ok(scene)
}

/// Rejects scenes whose roughness cannot be in motion.
fn require_passage(scene: &Scene) -> Result<(), InputError> {
    strip::validate(scene)?;
    let picks_grid = matches!(scene.grid, GridSpec::Accuracy { .. }) || scene.grid.grows();
    let found = [
        (!scene.is_lubricated(), "a dry contact has no film that squeezes; leave it out"),
        (picks_grid, "[grid] must have nx and x (and ny and y), the steps are those of one cell"),
        (
            scene.solver.accuracy.is_some() || scene.solver.estimate,
            "errors of the mesh (solver.estimate, solver.accuracy) are not estimated; compare two meshes",
        ),
        (
            !scene.solver.model.is_resolved(),
            "solver.model = \"asperity_inlets\" has no squeeze; leave one of the two out",
        ),
        (
            scene.stress.is_some(),
            "stresses below the surface ([stress]) are those of one contact; leave them out",
        ),
    ];
    match found.into_iter().find(|(applies, _)| *applies) {
        Some((_, reason)) => Err(InputError::Conflict {
            field: "motion.roughness = \"moving\"".to_owned(),
            reason: reason.to_owned(),
        }),
        None => Ok(()),
    }
}
