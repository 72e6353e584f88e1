//! The checked conditions of a cycle, as functions of time.

use crate::error::InputError;
use crate::sim::scene::Scene;
use crate::sim::scene::cycle_source::CycleSource;
use crate::surface::Form;

/// Relative difference of the last row from the first one of a cycle that repeats.
const CLOSED: f64 = 1e-6;
const FEWEST_STEPS: usize = 8;

/// Conditions at one time of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::sim) struct CycleRow {
    /// Time \[s\].
    pub(in crate::sim) time: f64,
    /// Load \[N\].
    pub(in crate::sim) load: f64,
    /// Speeds of ball and disc relative to the contact \[m/s\].
    pub(in crate::sim) speeds: [f64; 2],
    /// Reduced radius \[m\]; that of an ellipsoid along x.
    pub(in crate::sim) radius: f64,
    /// Bulk temperature \[K\].
    pub(in crate::sim) bulk_temperature: f64,
}

impl CycleRow {
    /// Entrainment speed, negative for a flow along -x \[m/s\].
    pub(in crate::sim) fn entrainment(&self) -> f64 {
        0.5 * self.speeds[0] + 0.5 * self.speeds[1]
    }

    /// The row a share `s` of the way to the row `to`.
    pub(in crate::sim) fn towards(&self, to: &Self, s: f64) -> Self {
        let mix = |a: f64, b: f64| a + s * (b - a);
        Self {
            time: mix(self.time, to.time),
            load: mix(self.load, to.load),
            speeds: [0, 1].map(|body| mix(self.speeds[body], to.speeds[body])),
            radius: mix(self.radius, to.radius),
            bulk_temperature: mix(self.bulk_temperature, to.bulk_temperature),
        }
    }
}

/// A checked cycle.
#[derive(Debug, Clone)]
pub(in crate::sim) struct CycleTable {
    /// At least two rows, ascending in time.
    pub(in crate::sim) rows: Vec<CycleRow>,
    /// Time of 2 pi \[s\], if the table has angles.
    pub(in crate::sim) turn: Option<f64>,
    /// Steps of equal time, if given.
    pub(in crate::sim) steps: Option<usize>,
    /// Whether each row is a steady contact.
    pub(in crate::sim) quasi_static: bool,
    /// Whether the cycle runs once.
    pub(in crate::sim) once: bool,
    /// Solved cycles of a history, and the cycles that each stands for; `None` for unchanged bodies.
    pub(in crate::sim) history: Option<(usize, f64)>,
    /// Origin of the rows.
    pub(in crate::sim) source: CycleSource,
}

impl CycleTable {
    /// The rows without the last one of a cycle that repeats, which is its first one.
    pub(in crate::sim) fn distinct_rows(&self) -> &[CycleRow] {
        let count = if self.once { self.rows.len() } else { self.rows.len().saturating_sub(1) };
        self.rows.get(..count).unwrap_or_default()
    }

    /// Checks the table of `scene`.
    ///
    /// # Errors
    /// A file that cannot be read; lists of different lengths; values out of range, times that go back, a cycle that
    /// repeats and does not end as it begins, with row, field and value.
    pub(in crate::sim) fn new(scene: &Scene) -> Result<Self, InputError> {
        let Some(spec) = &scene.cycle else {
            let reason = "is missing: a cycle needs times or angles, and speeds or loads".to_owned();
            return Err(InputError::Conflict { field: "cycle".to_owned(), reason });
        };
        let (spec, source) = match &spec.table {
            None => (spec.clone(), CycleSource::Lists),
            Some(path) => spec.read(path, scene.form.is_line())?,
        };
        let times = spec.times(&source)?;
        let force = scene.load.force.unwrap_or(scene.constant_hertz()?.force);
        let own = [
            ("load", &spec.load, force),
            ("ball_speed", &spec.ball_speed, scene.motion.surface_speeds()[0]),
            ("disc_speed", &spec.disc_speed, scene.motion.surface_speeds()[1]),
            ("radius", &spec.radius, scene.form.radii().0),
            ("bulk_temperature", &spec.bulk_temperature, scene.thermal.bulk_temperature),
        ];
        for (key, values, _) in &own {
            check_column(key, values, times.len(), &source)?;
        }
        if !spec.radius.is_empty() && matches!(scene.form.reduced(), Form::Ellipsoid { .. }) {
            let reason =
                "an ellipsoid has two; the radius of a cycle is that of a sphere or cylinder".to_owned();
            return Err(InputError::Conflict { field: "cycle.radius".to_owned(), reason });
        }
        let at = |row: usize| own.map(|(_, values, constant)| values.get(row).copied().unwrap_or(constant));
        let rows = times.iter().enumerate().map(|(row, time)| {
            let [load, ball, disc, radius, bulk_temperature] = at(row);
            CycleRow { time: *time, load, speeds: [ball, disc], radius, bulk_temperature }
        });
        let steps = spec.steps;
        if let Some(steps) = steps {
            InputError::require(steps >= FEWEST_STEPS, "cycle.steps", steps as f64, "at least 8")?;
        }
        let turn = spec.period.filter(|_| !spec.angle.is_empty());
        let (quasi_static, once) = (spec.quasi_static, spec.once);
        let history = spec.history()?;
        let mut table = Self { rows: rows.collect(), turn, steps, quasi_static, once, history, source };
        table.require_motion()?;
        table.close(spec.period)?;
        Ok(table)
    }

    /// Rejects a table without entrainment, and steady contacts at rest.
    fn require_motion(&self) -> Result<(), InputError> {
        let conflict =
            |field: String, reason: &str| Err(InputError::Conflict { field, reason: reason.to_owned() });
        let largest = self.largest_entrainment();
        if largest <= 0.0 {
            return conflict(
                "cycle.ball_speed + cycle.disc_speed".to_owned(),
                "is 0 in all rows: no oil is entrained",
            );
        }
        let rests = |row: &CycleRow| row.entrainment() == 0.0;
        let pause = self.rows.windows(2).position(|pair| pair.iter().all(rests));
        match pause.filter(|_| self.quasi_static) {
            Some(row) => conflict(
                format!("{}: cycle.ball_speed + cycle.disc_speed = 0", self.source.row(row)),
                "is 0 in the next row too: a quasi-static contact at rest has no film; leave quasi_static out, the film then \
                 drains by squeeze",
            ),
            None => Ok(()),
        }
    }

    /// Appends the first row at the end of the `period` of a cycle that repeats, or checks that the last row is the first
    /// one.
    fn close(&mut self, period: Option<f64>) -> Result<(), InputError> {
        let [Some(first), Some(last)] = [self.rows.first().copied(), self.rows.last().copied()] else {
            return Ok(());
        };
        if self.once {
            return Ok(());
        }
        let end = first.time + period.unwrap_or(last.time - first.time);
        let field = "cycle.period";
        let requirement =
            "at least the time between the first and the last row; leave it out to take this time";
        let rounding = CLOSED * (last.time - first.time);
        InputError::require(end >= last.time - rounding, field, end - first.time, requirement)?;
        if end > last.time + rounding {
            self.rows.push(CycleRow { time: end, ..first });
            return Ok(());
        }
        let scale = self.rows.iter().flat_map(|row| row.speeds).fold(0.0_f64, |most, v| most.max(v.abs()));
        let row = self.rows.len() - 1;
        for (key, a, b, scale) in [
            ("load", first.load, last.load, first.load),
            ("ball_speed", first.speeds[0], last.speeds[0], scale),
            ("disc_speed", first.speeds[1], last.speeds[1], scale),
            ("radius", first.radius, last.radius, first.radius),
            ("bulk_temperature", first.bulk_temperature, last.bulk_temperature, first.bulk_temperature),
        ] {
            let requirement = "the value of the first row, the cycle repeats; once = true runs it once";
            let closed = (a - b).abs() <= CLOSED * scale;
            self.source.require(closed, (key, row), b, requirement)?;
        }
        Ok(())
    }

    /// Largest entrainment speed of a row \[m/s\].
    pub(in crate::sim) fn largest_entrainment(&self) -> f64 {
        self.rows.iter().map(|row| row.entrainment().abs()).fold(0.0, f64::max)
    }

    /// Whether oil flows along -x at any time.
    pub(in crate::sim) fn reverses(&self) -> bool {
        self.rows.iter().any(|row| row.entrainment() < 0.0)
    }

    /// First time and length \[s\].
    pub(in crate::sim) fn span(&self) -> [f64; 2] {
        let [first, last] = [self.rows.first(), self.rows.last()].map(|row| row.map_or(0.0, |row| row.time));
        [first, last - first]
    }

    /// The conditions at `time` \[s\], linear between rows.
    pub(in crate::sim) fn at(&self, time: f64) -> Option<CycleRow> {
        let next = self.rows.partition_point(|row| row.time <= time).clamp(1, self.rows.len().max(2) - 1);
        let (from, to) = (self.rows.get(next - 1)?, self.rows.get(next)?);
        Some(from.towards(to, ((time - from.time) / (to.time - from.time)).clamp(0.0, 1.0)))
    }
}

/// Rejects a column of another length than the times, and values out of range.
fn check_column(key: &str, values: &[f64], rows: usize, source: &CycleSource) -> Result<(), InputError> {
    if !values.is_empty() {
        InputError::require_len(&format!("cycle.{key}"), values, rows)?;
    }
    let (is_speed, requirement) = match key {
        "load" => (false, "finite and > 0; leave rows without load out"),
        "radius" => (false, "finite and > 0, the reduced radius of both bodies"),
        "bulk_temperature" => (false, "finite and above 0 K"),
        _ => (true, "finite"),
    };
    for (row, value) in values.iter().enumerate() {
        let fits = value.is_finite() && (is_speed || *value > 0.0);
        source.require(fits, (key, row), *value, requirement)?;
    }
    Ok(())
}
