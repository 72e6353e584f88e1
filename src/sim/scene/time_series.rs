//! One scheduled quantity, checked.

use std::path::Path;

use crate::error::InputError;
use crate::sim::scene::Schedule;
use crate::text_file;
use crate::text_table;

/// Relative tolerance of entry times: sums of time steps are rounded.
const ROUNDING: f64 = 1e-9;

/// A quantity as a function of time, defined for all times from 0 on.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::sim) struct TimeSeries {
    /// Whether the function is piecewise constant, otherwise piecewise linear.
    jumps: bool,
    /// Ascending times \[s\].
    times: Vec<f64>,
    /// A value for each time.
    values: Vec<f64>,
}

impl TimeSeries {
    /// Checks `schedule`, whose key is `field`. Values must pass `fits`, described by `requirement`.
    pub(in crate::sim) fn new(
        schedule: &Schedule,
        field: &str,
        fits: impl Fn(f64) -> bool,
        requirement: &'static str,
    ) -> Result<Self, InputError> {
        let series = match schedule {
            Schedule::Constant { value } => {
                InputError::require(fits(*value), &format!("{field}.value"), *value, requirement)?;
                return Ok(Self { jumps: true, times: vec![0.0], values: vec![*value] });
            }
            Schedule::Steps { times, values } => {
                Self { jumps: true, times: times.clone(), values: values.clone() }
            }
            Schedule::Ramps { times, values } => {
                Self { jumps: false, times: times.clone(), values: values.clone() }
            }
            Schedule::Table { path } => {
                let (times, values) = read_table(path, field)?;
                Self { jumps: false, times, values }
            }
        };
        series.check_times(field)?;
        InputError::require_len(&format!("{field}.values"), &series.values, series.times.len())?;
        for (index, value) in series.values.iter().enumerate() {
            InputError::require(fits(*value), &format!("{field}.values[{index}]"), *value, requirement)?;
        }
        Ok(series)
    }

    /// Rejects times that are not finite, do not increase, or begin after zero.
    fn check_times(&self, field: &str) -> Result<(), InputError> {
        let times = format!("{field}.times");
        let Some(first) = self.times.first() else {
            return Err(InputError::Conflict {
                field: times,
                reason: "is empty: there is no value at the start".to_owned(),
            });
        };
        InputError::require_finite(&times, &self.times)?;
        let requirement = "0 or earlier, else there is no value at the start";
        InputError::require(*first <= 0.0, &format!("{times}[0]"), *first, requirement)?;
        for (index, pair) in self.times.windows(2).enumerate() {
            let requirement = "later than the entry before, a schedule does not go back in time";
            InputError::require(pair[1] > pair[0], &format!("{times}[{}]", index + 1), pair[1], requirement)?;
        }
        Ok(())
    }

    /// Number of entries at or before `time`; at least one from time 0 on.
    fn reached(&self, time: f64) -> usize {
        self.times.partition_point(|entry| *entry - ROUNDING * entry.abs() <= time)
    }

    /// The value at `time` \[s\].
    pub(in crate::sim) fn value(&self, time: f64) -> f64 {
        let reached = self.reached(time).max(1);
        let (from, start) = (self.times[reached - 1], self.values[reached - 1]);
        match (self.times.get(reached), self.values.get(reached)) {
            (Some(to), Some(end)) if !self.jumps => {
                let share = ((time - from) / (to - from)).clamp(0.0, 1.0);
                start + share * (end - start)
            }
            _ => start,
        }
    }

    /// The first entry after `time` \[s\].
    pub(in crate::sim) fn next_entry(&self, time: f64) -> Option<f64> {
        self.times.get(self.reached(time)).copied()
    }

    /// Times of the entries \[s\].
    pub(in crate::sim) fn times(&self) -> &[f64] {
        &self.times
    }

    /// Values of the entries.
    pub(in crate::sim) fn values(&self) -> &[f64] {
        &self.values
    }
}

/// Times and values of the table in the file at `path`, named by the key `field`.
pub(in crate::sim) fn read_table(path: &Path, field: &str) -> Result<(Vec<f64>, Vec<f64>), InputError> {
    let unusable = |reason: String| InputError::Conflict {
        field: format!("{field}.path"),
        reason: format!("{}: {reason}", path.display()),
    };
    let text = text_file::read(path).map_err(|error| unusable(error.to_string()))?;
    let (mut times, mut values) = (Vec::new(), Vec::new());
    let mut first = true;
    text_table::rows(&text).try_for_each(|row| {
        let cells: Vec<Option<f64>> = row.cells.iter().map(|cell| cell.parse().ok()).collect();
        match *cells.as_slice() {
            [Some(time), Some(value)] => {
                times.push(time);
                values.push(value);
            }
            // A header line.
            [None, None] if first => {}
            _ => {
                return Err(unusable(format!("line {} is not a time and a value: `{}`", row.line, row.text)));
            }
        }
        first = false;
        Ok(())
    })?;
    Ok((times, values))
}
