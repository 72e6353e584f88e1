//! A smooth contact to a target accuracy: box and mesh from the scale of the film, coarse-to-fine solves, an
//! error estimate.
//!
//! Between three meshes whose cells halve, a result changes by `d_2` and then `d_1`. The estimate is 1.5 times
//! the largest of three errors: `|d_1|/3` and `|d_2|/15` (second order) and `|d_1| r/(1 - r)` with
//! `r = |d_1/d_2|` (observed order). The error of the box ([`InletScale`]), whose length is chosen for it, is
//! added.

use super::WorkUsed;
use super::plan::{BOX_SHARE, Plan};
use crate::error::InputError;
use crate::report::Status;
use crate::reynolds::ContactState;
use crate::sim::contact::error_estimate::ErrorEstimate;
use crate::sim::contact::interrupt::Interrupt;
use crate::sim::contact::mesh_error;
use crate::sim::contact::oil;
use crate::sim::contact::setup;
use crate::sim::contact::solution::ContactSolution;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::SimError;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::{GridSpec, Scene};
use crate::sim::single_contact::prepared::prepare_on_grid;

/// Ratio of the cells of one mesh to those of the next finer one.
const RATIO: f64 = 2.0;
/// Number of meshes of one estimate.
const LEVELS: u32 = 3;
/// Largest ratio of successive differences that is extrapolated; above it a result counts as not converging.
const SLOWEST: f64 = 0.8;
/// Safety factor of the estimate.
const SAFETY: f64 = 1.5;
/// Growth of a pressure spike on finer meshes over its height; it grew by up to 0.4 when cells of this size
/// were halved twice.
const SPIKE_GROWTH: f64 = 0.5;
/// Exponent of the viscosity at the Hertz pressure above which spikes grow that much.
const SHARP: f64 = 10.0;
/// A spike is a local maximum of the pressure downstream of this fraction of the half-width.
const SPIKE_FROM: f64 = 0.5;
/// Most further refinements before the best result is returned.
const ROUNDS: u32 = 3;

/// A smooth contact in a box and on meshes chosen for an accuracy.
pub(in crate::sim) struct MeshChoice {
    /// The scene; its grid is replaced on each mesh.
    scene: Scene,
    /// Hertz contact of the smooth bodies.
    hertz: HertzContact,
    /// Target relative error.
    accuracy: f64,
    /// Initial box and cells.
    plan: Plan,
    /// Expected growth of a pressure spike in the limit, over its height.
    spike_growth: f64,
    /// Interrupt of the solve.
    interrupt: Option<Interrupt>,
    /// Warnings before the first solve.
    pub(super) warnings: Vec<Warning>,
}

/// Cells of the finest of the first meshes of `scene`.
pub(super) fn finest(scene: &Scene, accuracy: f64) -> Result<GridSpec, SimError> {
    setup::validate(scene)?;
    let hertz = scene.hertz()?;
    let plan = Plan::of(scene, &hertz, accuracy)?.with_layer(scene)?.first(scene, &hertz)?;
    Ok(plan.cells(&hertz, 0, scene.form.is_line())?)
}

impl MeshChoice {
    /// The first meshes of `scene`.
    pub(super) fn new(scene: &Scene, accuracy: f64, interrupt: Option<&Interrupt>) -> Result<Self, SimError> {
        setup::validate(scene)?;
        let hertz = scene.hertz()?;
        let plan = Plan::of(scene, &hertz, accuracy)?.with_layer(scene)?.first(scene, &hertz)?;
        let temperature = scene.conditions(0.0)?.bulk_temperature;
        let exponent =
            oil::viscosity(scene, temperature)?.map_or(0.0, |law| law.log_slope(0.0) * hertz.pressure);
        let spike_growth = SPIKE_GROWTH * (exponent / SHARP).min(1.0).powi(2);
        let on = |level| -> Result<Scene, InputError> {
            Ok(Scene { grid: plan.cells(&hertz, level, scene.form.is_line())?, ..scene.clone() })
        };
        let coarsest = prepare_on_grid(&on(LEVELS - 1)?, interrupt, |grid| Ok(ContactState::new(grid)))?;
        // The finer meshes need more memory.
        setup::validate_memory(&on(0)?.grid()?, scene.is_lubricated())?;
        let (scene, interrupt, warnings) = (scene.clone(), interrupt.cloned(), coarsest.warnings);
        Ok(Self { scene, hertz, accuracy, plan, spike_growth, interrupt, warnings })
    }

    /// Solves until the estimated error of the central film (of the maximum pressure if dry) is at most the
    /// accuracy, or reports the estimate reached.
    pub(super) fn solve(
        self,
        observer: &mut dyn FnMut(&ContactSolution),
    ) -> Result<ContactSolution, SimError> {
        let Self { mut scene, hertz, accuracy, mut plan, spike_growth, interrupt, .. } = self;
        let mut work = WorkUsed::default();
        let mut round = 0;
        loop {
            round += 1;
            let mut seen = |solution: &ContactSolution| {
                work.add(solution);
                observer(solution);
            };
            let meshes = Meshes::solve((&mut scene, interrupt.as_ref()), &hertz, &plan, &mut seen)?;
            let (mut solution, estimate) = meshes.estimate(scene.is_lubricated(), spike_growth);
            let reached = estimate.map_or(f64::INFINITY, |e| e.of_smooth(scene.is_lubricated()));
            let by_box = solution.box_error;
            let mesh = (reached - by_box) / (accuracy - by_box.min(BOX_SHARE * accuracy));
            let finer = Plan { cell: plan.cell * (0.8 / mesh).sqrt().clamp(0.5, 0.9), ..plan };
            let affordable = finer.cells(&hertz, 0, scene.form.is_line()).is_ok_and(|grid| {
                let finer = Scene { grid, ..scene.clone() };
                finer.grid().and_then(|grid| setup::validate_memory(&grid, finer.is_lubricated())).is_ok()
            });
            if reached <= accuracy || round == ROUNDS || !affordable {
                solution.report.work = work.on(&solution.grid);
                solution.error_estimate = estimate;
                return Ok(solution);
            }
            plan = finer;
        }
    }
}

/// The finest solution, the previous one, and the results `[central film, minimum film, maximum pressure]` of
/// all converged meshes, finest last.
struct Meshes {
    /// Solution on the finest mesh.
    finest: ContactSolution,
    /// Solution on the mesh before it.
    middle: Option<ContactSolution>,
    /// Results of the converged meshes, finest last.
    numbers: Vec<[f64; 3]>,
}

impl Meshes {
    /// Solves on all meshes, coarsest first. `observer` is called with each solution.
    fn solve(
        (scene, interrupt): (&mut Scene, Option<&Interrupt>),
        hertz: &HertzContact,
        plan: &Plan,
        observer: &mut dyn FnMut(&ContactSolution),
    ) -> Result<Self, SimError> {
        let mut numbers = Vec::new();
        let (mut middle, mut previous): (Option<ContactSolution>, Option<ContactSolution>) = (None, None);
        for level in (0..LEVELS).rev() {
            scene.grid = plan.cells(hertz, level, scene.form.is_line())?;
            let contact = prepare_on_grid(scene, interrupt, |grid| Ok(ContactState::new(grid)))?;
            let solution = contact.solve()?;
            observer(&solution);
            if solution.report.status == Status::Converged {
                numbers.push([solution.film.central, solution.film.minimum, solution.pressure.max]);
            } else {
                // Results of coarser meshes cannot be compared with one that did not converge.
                numbers.clear();
            }
            middle = previous.replace(solution);
        }
        let finest = previous.ok_or_else(|| InputError::Conflict {
            field: "grid.accuracy".to_owned(),
            reason: "no mesh was solved".to_owned(),
        })?;
        Ok(Self { finest, middle, numbers })
    }

    /// The finest solution and its estimate, which needs two converged meshes.
    fn estimate(self, lubricated: bool, spike_growth: f64) -> (ContactSolution, Option<ErrorEstimate>) {
        let numbers = match self.numbers.as_slice() {
            [.., coarsest, middle, finest] => Some((Some(coarsest), middle, finest)),
            [middle, finest] => Some((None, middle, finest)),
            _ => None,
        };
        let changes =
            self.middle.and_then(|middle| mesh_error::estimate(&(&middle).into(), &(&self.finest).into()));
        let errors = numbers.zip(changes).map(|((coarsest, middle, finest), changes)| {
            let of = |k: usize| relative_error(coarsest.map(|c| c[k]), middle[k], finest[k]);
            let box_error = self.finest.box_error;
            let film = |k, share| if lubricated { of(k) + share * box_error } else { 0.0 };
            let spike = highest_spike(&self.finest);
            let overtaken = (1.0 + spike_growth) * spike / self.finest.pressure.max - 1.0;
            ErrorEstimate {
                film_central: film(0, 1.0),
                film_minimum: film(1, mesh_error::BOX_MINIMUM),
                pressure_max: of(2).max(overtaken),
                ..changes
            }
        });
        (self.finest, errors)
    }
}

/// The highest local maximum of the pressure along the middle row in the outlet half \[Pa\]; zero if there is
/// none.
fn highest_spike(solution: &ContactSolution) -> f64 {
    let (nx, ny) = (solution.grid.nx(), solution.grid.ny());
    let row = solution.state.pressure.chunks_exact(nx).nth(ny / 2).unwrap_or_default();
    let behind = |i: usize| solution.grid.x(i) > SPIKE_FROM * solution.hertz.half_width_x;
    row.windows(3)
        .enumerate()
        .filter(|(i, p)| behind(i + 1) && p[1] > p[0] && p[1] >= p[2])
        .map(|(_, p)| p[1])
        .fold(0.0, f64::max)
}

/// Estimated relative error of the last of up to three values, see [`ErrorEstimate`].
fn relative_error(coarsest: Option<f64>, middle: f64, finest: f64) -> f64 {
    // Second order: the error is the difference divided by these.
    let (by_last, by_before) = (RATIO.powi(2) - 1.0, RATIO.powi(4) - 1.0);
    let last = (finest - middle).abs();
    let error = match coarsest {
        // Without a third mesh the order is unknown: assume first order.
        None => last,
        Some(coarsest) => {
            let before = (middle - coarsest).abs();
            let ratio = if before > 0.0 { (last / before).min(SLOWEST) } else { SLOWEST };
            let observed = last * ratio / (1.0 - ratio);
            observed.max(last / by_last).max(before / by_before)
        }
    };
    SAFETY * error / finest.abs()
}
