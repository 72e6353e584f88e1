//! The contacts of a cycle, one after the other.

use crate::error::InputError;
use crate::reynolds::ContactState;
use crate::sim::cycle::{CycleEnd, CyclePoint, CycleRecord, CycleSolution, set_conditions, skipped};
use crate::sim::error::SimError;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::history::squeeze_memory::mirror_rows;
use crate::sim::scene::cycle_table::{CycleRow, CycleTable};

/// Least entrainment speed over the largest one of the cycle.
const LEAST_ENTRAINMENT: f64 = 1e-9;
/// Most rounds of a cycle that repeats.
const MOST_ROUNDS: usize = 5;
/// Relative difference of the last central film from that one cycle before, from which on a further round is solved.
const CLOSURE: f64 = 1e-4;

/// Most times that a step is halved.
const MOST_HALVINGS: u32 = 5;

/// The contacts of one round.
#[derive(Default)]
struct Round {
    points: Vec<CyclePoint>,
    /// Hertz half-width along x of each \[m\].
    half_widths: Vec<f64>,
    /// Largest way of the entrained film in a step, in half-widths.
    largest_step: f64,
    /// Reason for an early end.
    ended_early: Option<CycleEnd>,
}

/// A simulation that follows a cycle.
pub(super) struct Drive {
    sim: MixedLubricationSim,
    table: CycleTable,
    /// Steps of equal time in a cycle in time.
    steps: usize,
    /// Direction of the flow in the frame of the scene: the simulation is mirrored where it is -1.
    direction: f64,
}

impl Drive {
    /// `sim` at the start of `table`, whose flow is along +x.
    pub(super) fn new(sim: MixedLubricationSim, table: CycleTable) -> Result<Self, InputError> {
        let steps = skipped::steps(&sim.scene, &table)?;
        Ok(Self { sim, table, steps, direction: 1.0 })
    }

    /// Solves all contacts.
    pub(super) fn run(
        mut self,
        observer: &mut dyn FnMut(&CyclePoint) -> bool,
    ) -> Result<CycleSolution, SimError> {
        let (start_up, cycle) = self.rows();
        let (mut round, mut cycles) = (Round::default(), Vec::new());
        // Bodies neither wear nor grow a film before the first cycle.
        self.sim.represented_cycles = 0.0;
        self.pass(&start_up, &mut round, observer)?;
        let (rounds, represented) = self.table.history.unwrap_or((MOST_ROUNDS, 0.0));
        self.sim.represented_cycles = represented;
        let mut closure = 0.0;
        for number in 1..=rounds {
            let before = round.points.last().map(|point| point.film_central);
            if round.ended_early.is_some() {
                break;
            }
            round = Round::default();
            self.pass(&cycle, &mut round, observer)?;
            let last = round.points.last().map(|point| point.film_central);
            closure = before.zip(last).map_or(0.0, |(before, last)| (last / before - 1.0).abs());
            if self.table.history.is_some() && round.ended_early.is_none() {
                cycles.push(CycleRecord::of(number as f64 * represented, &round.points, &self.sim));
            } else if closure <= CLOSURE {
                break;
            }
        }
        let Round { mut points, half_widths, largest_step, ended_early } = round;
        set_squeeze_ratios(&mut points, &half_widths, self.table.once || ended_early.is_some());
        Ok(CycleSolution {
            grid: self.sim.grid(),
            points,
            cycles,
            quasi_static: self.table.quasi_static,
            is_moving: false,
            largest_step,
            closure,
            ended_early,
            warnings: self.sim.warnings().to_vec(),
        })
    }

    /// Solves the contacts at all `rows` but the last, each up to the time of the next one.
    fn pass(
        &mut self,
        rows: &[CycleRow],
        round: &mut Round,
        observer: &mut dyn FnMut(&CyclePoint) -> bool,
    ) -> Result<(), SimError> {
        let mut before = None;
        for pair in rows.windows(2) {
            let (row, time_step) = (pair[0], pair[1].time - pair[0].time);
            let point = if before.is_none() && self.table.once && self.sim.steps() > 0 {
                self.steady_contact(&row, time_step)
            } else {
                self.contact_after(before.as_ref(), &row, time_step, MOST_HALVINGS)
            };
            let point = match point {
                Err(error @ SimError::NotConverged { .. }) if self.sim.steps() > 0 => {
                    round.ended_early = Some(CycleEnd::NotConverged {
                        time: row.time,
                        is_at_rest: row.entrainment() == 0.0,
                        reason: error.to_string(),
                    });
                    return Ok(());
                }
                Err(SimError::BoxTooSmall(reason)) if self.sim.steps() > 0 => {
                    round.ended_early = Some(CycleEnd::BoxTooSmall { time: row.time, reason });
                    return Ok(());
                }
                point => point?,
            };
            before = Some(row);
            let half_width = self.sim.contact.hertz.half_extents()[0];
            let way = row.entrainment().abs() * time_step / half_width;
            round.largest_step = round.largest_step.max(way);
            round.half_widths.push(half_width);
            round.points.push(point);
            if !observer(&point) {
                round.ended_early = Some(CycleEnd::Stopped);
                return Ok(());
            }
        }
        Ok(())
    }

    /// The rows before the cycle begins, and those of the cycle. The last row of each only ends the one before it.
    fn rows(&self) -> (Vec<CycleRow>, Vec<CycleRow>) {
        let table = &self.table;
        let [first, length] = table.span();
        let Some(last) = table.rows.last().copied() else { return (Vec::new(), Vec::new()) };
        let after = |step: f64| CycleRow { time: last.time + step, ..last };
        if table.quasi_static {
            let mut rows = table.rows.clone();
            if table.once {
                rows.push(after(length / table.rows.len() as f64));
            }
            return (Vec::new(), rows);
        }
        let step = length / self.steps as f64;
        let at = |k: usize| {
            let row = table.at(first + k as f64 * step);
            row.map_or(last, |row| CycleRow { time: first + k as f64 * step, ..row })
        };
        let cycle: Vec<CycleRow> = (0..=self.steps).map(at).collect();
        if table.once {
            return (Vec::new(), cycle.into_iter().chain([after(step)]).collect());
        }
        // From the largest entrainment speed to the end of the cycle before.
        let speed = |k: &usize| cycle[*k].entrainment().abs();
        let start = (0..self.steps).max_by(|a, b| speed(a).total_cmp(&speed(b))).unwrap_or(0);
        let before = cycle[start..].iter().map(|row| CycleRow { time: row.time - length, ..*row });
        (before.collect(), cycle)
    }

    /// Solves the steady contact at `row`, with which a further cycle begins that runs once.
    fn steady_contact(&mut self, row: &CycleRow, time_step: f64) -> Result<CyclePoint, SimError> {
        let squeeze = std::mem::replace(&mut self.sim.surface_motion.squeeze, false);
        let point = self.contact(row, time_step);
        self.sim.surface_motion.squeeze = squeeze;
        self.sim.squeeze_memory.settle();
        point
    }

    /// Solves the contact at `row`, which lasts `time_step` \[s\]. Where it does not converge, the step from the row `before`
    /// is halved, up to `halvings` times, by contacts in which the bodies neither wear nor grow a film.
    fn contact_after(
        &mut self,
        before: Option<&CycleRow>,
        row: &CycleRow,
        time_step: f64,
        halvings: u32,
    ) -> Result<CyclePoint, SimError> {
        let point = self.contact(row, time_step);
        let Some(before) = before.filter(|_| halvings > 0 && self.sim.surface_motion.squeeze) else {
            return point;
        };
        if !matches!(point, Err(SimError::NotConverged { .. })) {
            return point;
        }
        let middle = before.towards(row, 0.5);
        self.sim.squeeze_memory.halve_step();
        let represented = std::mem::replace(&mut self.sim.represented_cycles, 0.0);
        let half = self.contact_after(Some(before), &middle, 0.5 * (row.time - before.time), halvings - 1);
        self.sim.represented_cycles = represented;
        half?;
        self.contact_after(Some(&middle), row, time_step, halvings - 1)
    }

    /// Solves the contact at `row`, which lasts `time_step` \[s\].
    fn contact(&mut self, row: &CycleRow, time_step: f64) -> Result<CyclePoint, SimError> {
        let entrainment = row.entrainment();
        if entrainment * self.direction < 0.0 {
            self.mirror()?;
        }
        let speed = entrainment.abs().max(LEAST_ENTRAINMENT * self.table.largest_entrainment());
        let sliding = self.direction * (row.speeds[0] - row.speeds[1]);
        set_conditions(&mut self.sim, row, [speed, sliding])?;
        let record = self.sim.step_with_restart(time_step)?;
        Ok(CyclePoint::of(row, self.table.turn, &record, &self.sim.contact))
    }

    /// Mirrors the simulation in x, so that a flow along -x is one along +x.
    fn mirror(&mut self) -> Result<(), InputError> {
        let Self { sim, direction, .. } = self;
        let nx = sim.contact.grid.nx();
        *direction = -*direction;
        mirror_state(&mut sim.state, nx);
        sim.squeeze_memory.mirror(nx);
        if let Some(heat) = &mut sim.film_heat {
            // Temperatures are found anew from no rise.
            drop(heat.take_start());
        }
        sim.bodies.iter_mut().try_for_each(|body| body.mirror(nx))
    }
}

/// Reverses all rows of a state.
fn mirror_state(state: &mut ContactState, nx: usize) {
    let ContactState { pressure, fluid_pressure, film, plastic_depth, theta, mass, in_contact, .. } = state;
    for field in [pressure, fluid_pressure, film, plastic_depth, theta, mass] {
        mirror_rows(field, nx);
    }
    mirror_rows(in_contact, nx);
}

/// Sets the size of the squeeze terms by central differences of the films; at the ends of a cycle that runs `once` by
/// one-sided ones.
pub(super) fn set_squeeze_ratios(points: &mut [CyclePoint], half_widths: &[f64], once: bool) {
    let count = points.len();
    if count < 3 {
        return;
    }
    let entrainment = |point: &CyclePoint| 0.5 * (point.ball_speed + point.disc_speed).abs();
    // Slower ones are dead points, at which the table is rounded.
    let least = LEAST_ENTRAINMENT * points.iter().map(entrainment).fold(0.0, f64::max);
    let ratios: Vec<Option<f64>> = (0..count)
        .map(|k| {
            let [before, after] = if once {
                [k.saturating_sub(1), (k + 1).min(count - 1)]
            } else {
                [(k + count - 1) % count, (k + 1) % count]
            };
            let (from, to, point) = (points[before], points[after], points[k]);
            // Across the end of a cycle the steps beside the row are taken as equal.
            let time = if to.time > from.time {
                to.time - from.time
            } else if k == 0 {
                2.0 * (to.time - point.time)
            } else {
                2.0 * (point.time - from.time)
            };
            let speed = entrainment(&point);
            let rate = (to.film_central - from.film_central).abs() / time;
            let ratio = rate * half_widths.get(k)? / (speed * point.film_central);
            (speed > least && ratio.is_finite()).then_some(ratio)
        })
        .collect();
    points.iter_mut().zip(ratios).for_each(|(point, ratio)| point.squeeze_ratio = ratio);
}
