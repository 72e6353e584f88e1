//! Rows of a benchmark.

use std::path::Path;

use serde::Serialize;

use super::row::Row;
use super::table;
use crate::sim::SimError;

/// The rows of one or several benchmarks, as a table, in words, and in pictures (SVG).
///
/// ```
/// use stribeck::benchmark::{Benchmark, Case, Contestant, Results};
/// use stribeck::sim::Scene;
/// let cases = vec![Case::new("reference", Scene::azam_2019(24))];
/// let results = Benchmark::new(cases).contestant(Contestant::named("auto")?).run()?;
/// let row = &results.rows()[0];
/// assert!(row.is_solved() && row.work() > 0.0, "{row:?}");
/// // The table holds every bit.
/// assert_eq!(Results::from_csv(&results.to_csv())?.to_csv(), results.to_csv());
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Results {
    rows: Vec<Row>,
}

impl Results {
    pub(super) fn new(rows: Vec<Row>) -> Self {
        Self { rows }
    }

    /// All rows, contestant by contestant.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The rows with those of `other` appended.
    #[must_use]
    pub fn merged(mut self, other: Self) -> Self {
        self.rows.extend(other.rows);
        self
    }

    /// The rows as CSV in SI units; values that are unknown are empty.
    pub fn to_csv(&self) -> String {
        table::text(&self.rows)
    }

    /// Rows from the text of [`to_csv`](Self::to_csv).
    ///
    /// # Errors
    /// [`SimError::Scene`] with line and column of a value that cannot be read.
    pub fn from_csv(text: &str) -> Result<Self, SimError> {
        table::parse(text).map(Self::new).map_err(|reason| SimError::Scene { reason })
    }

    /// Rows of the file of a benchmark.
    ///
    /// # Errors
    /// As of [`from_csv`](Self::from_csv), and a file that cannot be read.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, SimError> {
        table::read(path.as_ref()).map(Self::new)
    }

    /// Names of the contestants, in their order.
    pub fn contestants(&self) -> Vec<&str> {
        distinct(self.rows.iter().map(|row| row.contestant.as_str()))
    }

    /// Rows of a contestant.
    pub fn of<'a>(&'a self, contestant: &'a str) -> impl Iterator<Item = &'a Row> {
        self.rows.iter().filter(move |row| row.contestant == contestant)
    }

    /// For each combination of case, tolerance and mesh that every contestant has, its rows in the order of
    /// `contestants`.
    pub(super) fn problems(&self, contestants: &[&str]) -> Vec<Vec<&Row>> {
        let Some(first) = contestants.first() else { return Vec::new() };
        let is_same = |a: &Row, b: &Row| {
            a.case == b.case && a.cells == b.cells && a.tolerance.to_bits() == b.tolerance.to_bits()
        };
        self.of(first)
            .filter_map(|row| {
                let of = |name: &&str| {
                    self.rows.iter().find(|other| other.contestant == **name && is_same(row, other))
                };
                contestants.iter().map(of).collect()
            })
            .collect()
    }
}

/// The different values, in the order of their first appearance.
pub(super) fn distinct<T: PartialEq>(values: impl Iterator<Item = T>) -> Vec<T> {
    values.fold(Vec::new(), |mut seen, value| {
        if !seen.contains(&value) {
            seen.push(value);
        }
        seen
    })
}
