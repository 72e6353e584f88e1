//! Quasi-static cycles whose roughness moves: each row is a passage of the surfaces under its conditions.

use std::ops::ControlFlow;

use crate::error::InputError;
use crate::sim::cycle::drive::set_squeeze_ratios;
use crate::sim::cycle::{CycleEnd, CyclePoint, CycleSolution, set_conditions};
use crate::sim::error::{BoxTooSmall, SimError};
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::record::StepRecord;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::passage::{ReadyPassage, SolvedPassage};
use crate::sim::scene::cycle_table::{CycleRow, CycleTable};

/// The passages at all rows of `table`, each from a steady contact on.
pub(super) fn solve(
    builder: SimBuilder,
    table: &CycleTable,
    observer: &mut dyn FnMut(&CyclePoint) -> bool,
) -> Result<CycleSolution, SimError> {
    let rows = table.distinct_rows();
    require_flow(rows, table)?;
    let length = builder.scene.motion.passage;
    let start = builder.in_motion()?;
    let mut solution = CycleSolution {
        grid: start.grid(),
        points: Vec::with_capacity(rows.len()),
        cycles: Vec::new(),
        quasi_static: true,
        is_moving: true,
        largest_step: 0.0,
        closure: 0.0,
        ended_early: None,
        warnings: start.warnings().to_vec(),
    };
    let mut half_widths = Vec::with_capacity(rows.len());
    for row in rows {
        let SolvedPassage { solution: passage, sim, too_small } = match passage_at(&start, row, length) {
            Err(error @ SimError::NotConverged { .. }) if !solution.points.is_empty() => {
                let (time, reason) = (row.time, error.to_string());
                solution.ended_early = Some(CycleEnd::NotConverged { time, is_at_rest: false, reason });
                break;
            }
            Err(SimError::BoxTooSmall(reason)) if !solution.points.is_empty() => {
                solution.ended_early = Some(CycleEnd::BoxTooSmall { time: row.time, reason });
                break;
            }
            passage => passage?,
        };
        solution.ended_early = early_end(row.time, too_small, passage.ended_early.as_deref());
        if solution.ended_early.is_some() {
            break;
        }
        let new = sim.warnings().iter().filter(|warning| !solution.warnings.contains(warning));
        let new: Vec<_> = new.cloned().collect();
        solution.warnings.extend(new);
        let Some(mean) = passage.mean_record() else { break };
        let half_width = sim.contact.hertz.half_extents()[0];
        let way = row.entrainment() * passage.time_step / half_width;
        solution.largest_step = solution.largest_step.max(way);
        half_widths.push(half_width);
        let point = CyclePoint::of(row, table.turn, &mean, &sim.contact);
        solution.points.push(point);
        if !observer(&point) {
            solution.ended_early = Some(CycleEnd::Stopped);
            break;
        }
    }
    set_squeeze_ratios(&mut solution.points, &half_widths, table.once || solution.ended_early.is_some());
    Ok(solution)
}

/// The end of a cycle by the passage at `time` that met the edge of its box or ended early.
fn early_end(time: f64, too_small: Option<BoxTooSmall>, ended_early: Option<&str>) -> Option<CycleEnd> {
    match (too_small, ended_early) {
        (Some(reason), _) => Some(CycleEnd::BoxTooSmall { time, reason }),
        (None, Some(reason)) => {
            let reason = format!("the passage ended early: {reason}");
            Some(CycleEnd::NotConverged { time, is_at_rest: false, reason })
        }
        (None, None) => None,
    }
}

/// The passage at `row`.
fn passage_at(
    start: &MixedLubricationSim,
    row: &CycleRow,
    length: Option<f64>,
) -> Result<SolvedPassage, SimError> {
    let mut sim = start.clone();
    set_conditions(&mut sim, row, [row.entrainment(), row.speeds[0] - row.speeds[1]])?;
    let mut go_on = |_: &MixedLubricationSim, _: &StepRecord| ControlFlow::Continue(());
    ReadyPassage::new(sim, length)?.run(&mut go_on)
}

/// Rejects rows that entrain no oil along +x.
fn require_flow(rows: &[CycleRow], table: &CycleTable) -> Result<(), InputError> {
    for (index, row) in rows.iter().enumerate() {
        InputError::require(
            row.entrainment() > 0.0,
            &format!("{}: 0.5 (cycle.ball_speed + cycle.disc_speed)", table.source.row(index)),
            row.entrainment(),
            "> 0, roughness that moves (motion.roughness) passes with a film along +x; leave such rows out, or leave motion.roughness out",
        )?;
    }
    Ok(())
}
