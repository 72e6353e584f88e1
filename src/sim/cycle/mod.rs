//! Contacts whose load, speeds, radius and temperature change over a cycle: gear flanks, cams, reciprocating rigs.
//!
//! The frame moves with the contact. By default the cycle is solved in time with squeeze, through zero speed and reversed
//! flow: where the entrainment changes its sign, the contact is mirrored in x (`mirror`), exact on a box that is
//! symmetric. Quasi-static cycles solve each row as a steady contact, or, where the roughness moves, as a passage of the
//! surfaces (`passages`).

mod cells;
mod cycle_record;
mod drive;
mod end;
mod extremes;
mod opposite;
mod passages;
mod point;
mod skipped;
mod temperature;
mod wake;

use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::contact::warnings::Warning;
use crate::sim::contact::{setup, strip};
use crate::sim::error::SimError;
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::cycle_table::{CycleRow, CycleTable};
use crate::sim::scene::operating_schedule::{Conditions, OperatingSchedule};
use crate::sim::scene::{Flash, GridSpec, InletSpec, Motion, RoughnessState, Scene};
use crate::surface::{Fixed, Form};
use crate::units::by_size;

pub use cycle_record::CycleRecord;
pub use end::CycleEnd;
pub use extremes::{CycleExtremes, CycleRowScene};
pub use point::CyclePoint;

/// Relative difference of the distances of both edges along x of a box that counts as symmetric.
const SYMMETRIC: f64 = 1e-9;

/// A solved cycle.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct CycleSolution {
    /// The grid.
    pub grid: Grid,
    /// Contacts of the last cycle in the order of time.
    pub points: Vec<CyclePoint>,
    /// The solved cycles of a history; empty for unchanged bodies.
    pub cycles: Vec<CycleRecord>,
    /// Whether the contacts are steady ones, or passages.
    pub quasi_static: bool,
    /// Whether the roughness moves: the numbers of each contact are means over a passage.
    pub is_moving: bool,
    /// Largest way of the entrained film in a step, in half-widths of the Hertz contact.
    pub largest_step: f64,
    /// Relative difference of the last central film from that one cycle before; zero for a cycle that does not repeat.
    pub closure: f64,
    /// Reason for an early end.
    pub ended_early: Option<CycleEnd>,
    /// Warnings.
    pub warnings: Vec<Warning>,
}

impl SimBuilder {
    /// Solves the cycle of the scene ([`CycleSpec`](crate::sim::scene::CycleSpec)); `observer` is called after each contact
    /// and may return false to stop. Oil is supplied at the edges of the box. The roughness is at rest in the contact; a
    /// quasi-static cycle can have [`RoughnessState::Moving`]: each row is then a
    /// [passage](SimBuilder::solve_passage) under its conditions. A cycle that repeats begins before its first row, at its largest entrainment speed, and is solved again
    /// until its last film repeats. With [`repeat`](crate::sim::scene::CycleSpec::repeat) it is the history of the bodies:
    /// they wear and grow tribofilms from cycle to cycle. Without it wear is left out.
    ///
    /// A contact that does not converge is solved again behind contacts at shorter steps from the one before.
    ///
    /// # Errors
    /// A table or a scene that does not fit, with row, field and value; flow along -x in a box that is not symmetric. A
    /// contact that does not converge is no error: see [`CycleSolution::ended_early`].
    ///
    /// ```
    /// use stribeck::sim::scene::{CycleSpec, GridSpec};
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut scene = Scene::azam_2019(24);
    /// (scene.roughness, scene.plastic) = (Default::default(), None);
    /// let mut cycle = CycleSpec::default();
    /// (cycle.time, cycle.steps) = (vec![0.0, 1e-3, 2e-3], Some(16));
    /// (cycle.ball_speed, cycle.disc_speed) = (vec![2.0, -2.0, 2.0], vec![0.0; 3]);
    /// scene.cycle = Some(cycle);
    /// let solution = MixedLubricationSim::builder(scene).solve_cycle(&mut |_| true)?;
    /// assert_eq!(solution.points.len(), 16);
    /// assert!(solution.points.iter().all(|point| point.film_central > 1e-9));
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn solve_cycle(
        self,
        observer: &mut dyn FnMut(&CyclePoint) -> bool,
    ) -> Result<CycleSolution, SimError> {
        let ReadyCycle { builder, table, is_flooded, warnings } = self.ready_cycle()?;
        if !builder.scene.motion.roughness.is_at_rest() {
            let mut solution = passages::solve(builder, &table, observer)?;
            solution.warnings.extend(warnings);
            return Ok(solution);
        }
        let sim = builder.build()?;
        let cut = cut_inlet(&sim, is_flooded)?;
        let mut solution = drive::Drive::new(sim, table)?.run(observer)?;
        solution.warnings.extend(cut.into_iter().chain(warnings));
        Ok(solution)
    }

    /// The warnings of [`solve_cycle`](Self::solve_cycle) that do not need its solution.
    ///
    /// # Errors
    /// As [`solve_cycle`](Self::solve_cycle).
    pub fn check_cycle(self) -> Result<Vec<Warning>, SimError> {
        let ReadyCycle { builder, is_flooded, warnings, .. } = self.ready_cycle()?;
        if !builder.scene.motion.roughness.is_at_rest() {
            return Ok(builder.check_contact()?.into_iter().chain(warnings).collect());
        }
        let sim = builder.build()?;
        let cut = cut_inlet(&sim, is_flooded)?;
        Ok(sim.warnings().iter().cloned().chain(cut).chain(warnings).collect())
    }

    /// The checked cycle of the scene.
    fn ready_cycle(mut self) -> Result<ReadyCycle, SimError> {
        let table = CycleTable::new(&self.scene)?;
        let is_flooded = self.scene.lubricant.is_some_and(|oil| oil.inlet == InletSpec::Flooded);
        let estimate = self.scene.solver.estimate.then(no_estimate);
        self.scene = cycle_scene(self.scene, &table)?;
        let grid = self.scene.grid()?;
        require_rows(&self.scene, &grid, &table)?;
        let mut warnings: Vec<Warning> = estimate.into_iter().collect();
        if self.scene.motion.roughness.is_at_rest() {
            warnings.extend(skipped::skipped_motion(&self.scene, &table)?);
            warnings.extend(wake::left_the_box(&grid, &table));
            self.motion = Some(std::sync::Arc::new(Fixed));
            self.squeeze = !table.quasi_static;
        }
        warnings.extend(cells::few_in_narrowest(&self.scene, &grid, &table)?);
        warnings.extend(opposite::opposite_surfaces(&self.scene, &table));
        warnings.extend(temperature::without_effect(&self.scene, &table)?);
        Ok(ReadyCycle { builder: self, table, is_flooded, warnings })
    }
}

/// A checked cycle before its first contact.
struct ReadyCycle {
    /// The simulation at its largest entrainment speed.
    builder: SimBuilder,
    table: CycleTable,
    /// Whether the scene has a flooded inlet.
    is_flooded: bool,
    warnings: Vec<Warning>,
}

/// The warning that the box of `sim` cuts its inlet, if the scene of the cycle is flooded.
fn cut_inlet(sim: &MixedLubricationSim, is_flooded: bool) -> Result<Option<Warning>, InputError> {
    if is_flooded { sim.contact.cut_inlet(&sim.scene) } else { Ok(None) }
}

/// The warning that the errors of the mesh are those of a single contact.
fn no_estimate() -> Warning {
    Warning::new(
        "solver.estimate",
        f64::NAN,
        "errors of the mesh are estimated for single contacts, not over a cycle".to_owned(),
        "`stribeck solve` estimates them for the contact of the scene; for the cycle compare two meshes"
            .to_owned(),
    )
}

/// `scene` at the row of the largest entrainment speed, as all rows need it.
fn cycle_scene(mut scene: Scene, table: &CycleTable) -> Result<Scene, SimError> {
    require_cycle(&scene, table)?;
    let fastest = |a: &&CycleRow, b: &&CycleRow| a.entrainment().abs().total_cmp(&b.entrainment().abs());
    if let Some(row) = table.rows.iter().max_by(fastest) {
        set_row(&mut scene, row);
        scene.motion.entrainment_speed = row.entrainment().abs();
        scene.motion.slide_roll_ratio = (row.speeds[0] - row.speeds[1]) / row.entrainment();
    }
    if let Some(oil) = &mut scene.lubricant {
        oil.inlet = InletSpec::BoxEdge;
    }
    if scene.thermal.flash == Flash::Auto {
        scene.thermal.flash = Flash::On;
    }
    (scene.schedule, scene.cycle) = (Default::default(), None);
    scene.solver.estimate = false;
    if table.history.is_none() {
        (scene.wear, scene.track) = (None, Default::default());
    }
    Ok(scene)
}

/// Half-widths along x of the Hertz contacts of the rows of `table` \[m\].
fn half_widths(scene: &Scene, table: &CycleTable) -> Result<Vec<f64>, InputError> {
    let mut at = scene.clone();
    let half_width = |row: &CycleRow| {
        set_row(&mut at, row);
        Ok(at.constant_hertz()?.half_extents()[0])
    };
    table.rows.iter().map(half_width).collect()
}

/// Sets radius, load and temperature of `row`.
pub(in crate::sim::cycle) fn set_row(scene: &mut Scene, row: &CycleRow) {
    let mut form = scene.form.reduced();
    if let Form::Sphere { radius } | Form::Cylinder { radius } = &mut form {
        *radius = row.radius;
        scene.form = form;
    }
    (scene.load.force, scene.load.hertz_pressure) = (Some(row.load), None);
    scene.thermal.bulk_temperature = row.bulk_temperature;
}

/// Puts `sim` under the load, the radius and the temperature of `row` and these speeds of entrainment and sliding \[m/s\].
pub(in crate::sim::cycle) fn set_conditions(
    sim: &mut MixedLubricationSim,
    row: &CycleRow,
    [entrainment_speed, sliding]: [f64; 2],
) -> Result<(), SimError> {
    let slide_roll_ratio = sliding / entrainment_speed;
    let motion = Motion { entrainment_speed, slide_roll_ratio, ..sim.scene.motion };
    let conditions = Conditions { load: row.load, motion, bulk_temperature: row.bulk_temperature };
    let radius = sim.scene.form.radii().0;
    set_row(&mut sim.scene, row);
    if radius.to_bits() != row.radius.to_bits() {
        sim.contact.set_form(&sim.scene)?;
    }
    sim.operating_schedule = OperatingSchedule::constant(conditions);
    Ok(())
}

/// Rejects scenes that have no cycle.
fn require_cycle(scene: &Scene, table: &CycleTable) -> Result<(), InputError> {
    strip::validate(scene)?;
    let picks_grid = matches!(scene.grid, GridSpec::Accuracy { .. }) || scene.grid.grows();
    let is_moving = scene.motion.roughness == RoughnessState::Moving;
    let is_turned = scene.form.angle() != 0.0 || scene.motion.spin_radius.is_some();
    let found = [
        (!scene.is_lubricated(), "a dry contact has no film over a cycle; add [lubricant]"),
        (picks_grid, "[grid] must have nx and x (and ny and y): one box for all rows"),
        (
            is_moving && !table.quasi_static,
            "motion.roughness = \"moving\" needs steps of one cell of the faster surface; add quasi_static = true: each row is then a \
             passage under its conditions",
        ),
        (
            is_moving && table.history.is_some(),
            "surfaces in motion (motion.roughness = \"moving\") neither wear nor grow tribofilms; leave cycle.repeat out",
        ),
        (
            scene.solver.accuracy.is_some(),
            "solver.accuracy chooses the mesh of a single contact; leave it out and compare two meshes",
        ),
        (
            !scene.solver.model.is_resolved() && !table.quasi_static,
            "solver.model = \"asperity_inlets\" has no squeeze; add quasi_static = true",
        ),
        (
            scene.tribofilm.is_some() && table.history.is_none(),
            "a tribofilm grows from cycle to cycle; add cycle.repeat, or leave [tribofilm] out",
        ),
        (
            scene.stress.is_some(),
            "stresses below the surface ([stress]) are those of one contact; leave them out",
        ),
        (
            is_turned && table.reverses(),
            "the flow turns back, which needs a contact that is symmetric in x: no form.angle, no motion.spin_radius",
        ),
    ];
    match found.into_iter().find(|(applies, _)| *applies) {
        Some((_, reason)) => {
            Err(InputError::Conflict { field: "cycle".to_owned(), reason: reason.to_owned() })
        }
        None => Ok(()),
    }
}

/// Rejects rows whose contact does not fit into the box.
fn require_rows(scene: &Scene, grid: &Grid, table: &CycleTable) -> Result<(), InputError> {
    let mut at = scene.clone();
    for (index, row) in table.rows.iter().enumerate() {
        set_row(&mut at, row);
        let fits = at.constant_hertz().and_then(|hertz| {
            setup::validate_box(grid, &hertz, at.form.is_line())?;
            setup::validate_room(&at, grid, &hertz)
        });
        fits.map_err(|error| InputError::Conflict {
            field: format!(
                "{}: load = {}, radius = {}",
                table.source.row(index),
                by_size(row.load, if at.form.is_line() { "N/m" } else { "N" }),
                by_size(row.radius, "m")
            ),
            reason: error.to_string(),
        })?;
    }
    let [low, high] = [grid.x(0), grid.x(grid.nx() - 1)];
    if table.reverses() && (low + high).abs() > SYMMETRIC * grid.size_x() {
        return Err(InputError::Conflict {
            field: "grid.x".to_owned(),
            reason: format!(
                "the flow of the cycle turns back, which needs a box that is symmetric: x = [-{:.4e}, {:.4e}]",
                -low + 0.5 * grid.dx(),
                -low + 0.5 * grid.dx()
            ),
        });
    }
    Ok(())
}
