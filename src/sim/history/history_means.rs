//! Means over the last tenth of a history, with the same names in JSON, terminal and Python.
//!
//! The last tenth of the steps counts, at least one step. Columns of the contact and of the bodies have a mean;
//! conditions and solver columns do not. Worn volumes are those after the last step.

use crate::sim::history::columns::{COLUMNS, Cell, Column};
use crate::sim::history::record::StepRecord;

/// Tables without means.
const WITHOUT_MEANS: [&str; 3] = ["motion", "residual", "work"];

/// Columns that accumulate over the history.
const TOTALS: [&str; 2] = ["wear.ball_volume", "wear.disc_volume"];

/// The column outside of tables that has a mean.
const FLASH: &str = "flash_rise";

/// Keys of the specific wear rates of ball and disc in the table `wear`.
pub(in crate::sim) const RATES: [&str; 2] = ["ball_specific_rate", "disc_specific_rate"];

/// The columns that have means.
fn averaged() -> impl Iterator<Item = &'static Column> {
    let has_mean = |column: &&Column| {
        column.name == FLASH || column.path().is_some_and(|(table, _)| !WITHOUT_MEANS.contains(&table))
    };
    COLUMNS.iter().filter(has_mean)
}

/// Means over the last tenth of the steps of a history.
///
/// ```
/// use stribeck::sim::{HistoryMeans, MixedLubricationSim, Scene};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(32)).build()?;
/// let mut means = HistoryMeans::new(2);
/// let records = [sim.step(10.0)?, sim.step(10.0)?];
/// records.iter().for_each(|record| means.see(record));
/// assert_eq!(means.mean("contact", "load_ratio"), Some(records[1].contact.load_ratio));
/// assert_eq!(HistoryMeans::new(2).mean("contact", "load_ratio"), None); // no step yet
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone)]
pub struct HistoryMeans {
    /// Number of steps of the history.
    steps: u64,
    /// Sums over the counted steps, for each column that has a mean; `None` if a step has no value.
    sums: Vec<Option<f64>>,
    /// Values of the first and of the last step so far; `None` if the step has no value.
    ends: Vec<[Option<f64>; 2]>,
    /// Number of counted steps so far.
    count: u64,
    /// Number of steps that needed more than one position of the roughness.
    moved: u64,
    /// Load times sliding distance \[N m\].
    load_distance: f64,
    /// Whether the contacts are dry.
    is_dry: bool,
    /// Whether the contacts are lines or strips, whose results are per metre.
    is_line: bool,
}

impl HistoryMeans {
    /// Means of a history of `steps` steps, before its first step.
    pub fn new(steps: u64) -> Self {
        Self {
            steps,
            sums: averaged().map(|_| Some(0.0)).collect(),
            ends: Vec::new(),
            count: 0,
            moved: 0,
            load_distance: 0.0,
            is_dry: false,
            is_line: false,
        }
    }

    /// The means of a line contact or a strip: the table has loads, powers, flows, areas and volumes per metre.
    ///
    /// ```
    /// use stribeck::sim::HistoryMeans;
    /// assert_eq!(HistoryMeans::new(2).of_line().mean("contact", "load_ratio"), None); // no step yet
    /// ```
    #[must_use]
    pub fn of_line(mut self) -> Self {
        self.is_line = true;
        self
    }

    /// Takes in the next step.
    pub fn see(&mut self, record: &StepRecord) {
        self.moved += u64::from(record.attempts > 1);
        self.is_dry = record.report.energy_error.is_some();
        self.load_distance += record.load * record.motion.sliding_speed() * record.time_step;
        let values = averaged().map(|column| number((column.get)(record)));
        if self.ends.is_empty() {
            self.ends = values.map(|value| [value; 2]).collect();
        } else {
            self.ends.iter_mut().zip(values).for_each(|(ends, value)| ends[1] = value);
        }
        if record.step + self.steps.div_ceil(10) >= self.steps {
            for (sum, column) in self.sums.iter_mut().zip(averaged()) {
                let value = number((column.get)(record));
                *sum = if TOTALS.contains(&column.name) {
                    value
                } else {
                    value.and_then(|value| sum.map(|sum| sum + value))
                };
            }
            self.count += 1;
        }
    }

    /// The mean of `key` in `table` (`film.lambda`) over the counted steps, in SI units; for worn volumes the value
    /// after the last step. `None` for other names and for physics not modelled.
    pub fn mean(&self, table: &str, key: &str) -> Option<f64> {
        self.named().find(|(column, _)| column.path() == Some((table, key))).map(|(_, mean)| mean)
    }

    /// Volumes worn off ball and disc over load and sliding distance \[m^3/(N m)\]; `None` without sliding.
    pub fn specific_wear_rates(&self) -> Option<[f64; 2]> {
        let volume = |key| self.mean("wear", key);
        let volumes = [volume("ball_volume")?, volume("disc_volume")?];
        (self.load_distance > 0.0).then(|| volumes.map(|volume| volume / self.load_distance))
    }

    /// Columns with their values after the first and the last step, and their means.
    pub(in crate::sim) fn rows(&self) -> impl Iterator<Item = (&'static Column, [Option<f64>; 3])> {
        self.named().map(|(column, mean)| {
            let ends = averaged().zip(&self.ends).find(|(other, _)| other.name == column.name);
            let [first, last] = ends.map_or([None; 2], |(_, ends)| *ends);
            (column, [first, last, Some(mean).filter(|_| !TOTALS.contains(&column.name))])
        })
    }

    /// Whether the contacts are dry.
    pub(in crate::sim) fn is_dry(&self) -> bool {
        self.is_dry
    }

    /// The SI unit of `column`, of a line contact per metre.
    pub(in crate::sim) fn unit(&self, column: &Column) -> &'static str {
        match column.unit {
            "N" if self.is_line => "N/m",
            "W" if self.is_line => "W/m",
            "m^2" if self.is_line => "m^2/m",
            "m^3" if self.is_line => "m^3/m",
            "m^3/s" if self.is_line => "m^2/s",
            unit => unit,
        }
    }

    /// Columns and their means, without columns that were empty in a step.
    fn named(&self) -> impl Iterator<Item = (&'static Column, f64)> {
        let count = self.count;
        let counted = averaged().zip(&self.sums).filter(move |_| count > 0);
        counted.filter_map(move |(column, sum)| {
            let number = (*sum)?;
            Some((column, if TOTALS.contains(&column.name) { number } else { number / count as f64 }))
        })
    }
}

/// The value of a cell; `None` of an empty one.
fn number(cell: Cell) -> Option<f64> {
    match cell {
        Cell::Number(number) => Some(number),
        Cell::Count(count) => Some(count as f64),
        Cell::Empty | Cell::Word(_) => None,
    }
}

#[cfg(feature = "serde")]
mod named {
    use std::collections::BTreeMap;

    use serde::Serialize;

    use crate::sim::contact::warnings::Warning;
    use crate::sim::history::columns::Column;
    use crate::sim::history::history_means::{HistoryMeans, RATES, averaged};
    use crate::sim::history::simulation::MixedLubricationSim;
    use crate::sim::scene::BODIES;

    /// Final results of a history, ready for output: the means and the worn profiles of `sim`, in SI units.
    #[derive(Debug, Clone, Serialize)]
    pub struct HistoryNumbers {
        steps: u64,
        time: f64,
        averaged_steps: u64,
        moved_steps: u64,
        /// Load times sliding distance \[N m\].
        load_distance: f64,
        roughness_motion: String,
        warnings: Vec<Warning>,
        version: &'static str,
        /// Numbers of the first and of the last step.
        first_step: Tables,
        last_step: Tables,
        #[serde(flatten)]
        tables: Tables,
    }

    /// Numbers by table and key.
    type Tables = BTreeMap<&'static str, Entry>;

    #[derive(Debug, Clone, Serialize)]
    #[serde(untagged)]
    enum Entry {
        Number(f64),
        Profile(Vec<f64>),
        Table(BTreeMap<String, Self>),
    }

    /// Adds the entry `key` to a table.
    fn insert(tables: &mut Tables, table: &'static str, key: &str, entry: Entry) {
        let table = tables.entry(table).or_insert_with(|| Entry::Table(BTreeMap::new()));
        if let Entry::Table(entries) = table {
            entries.insert(key.to_owned(), entry);
        }
    }

    /// The `numbers` of columns with a table and a key.
    fn tables_of(numbers: impl Iterator<Item = (&'static Column, f64)>) -> Tables {
        let mut tables = Tables::new();
        for (column, number) in numbers {
            match column.path() {
                Some((table, key)) => insert(&mut tables, table, key, Entry::Number(number)),
                None => drop(tables.insert(column.name, Entry::Number(number))),
            }
        }
        tables
    }

    impl HistoryMeans {
        /// The results of the history of `sim`, with the names in `docs/running.md`.
        pub fn numbers(&self, sim: &MixedLubricationSim) -> HistoryNumbers {
            let mut tables = tables_of(self.named());
            for (name, rate) in RATES.into_iter().zip(self.specific_wear_rates().into_iter().flatten()) {
                insert(&mut tables, "wear", name, Entry::Number(rate));
            }
            let step = |index: usize| {
                let ends = averaged().zip(&self.ends);
                tables_of(ends.filter_map(|(column, ends)| Some((column, ends[index]?))))
            };
            for (name, body) in BODIES.into_iter().zip(sim.bodies()) {
                let profile = Entry::Profile(sim.worn_profile(body));
                insert(&mut tables, "worn_profile", name, profile);
            }
            HistoryNumbers {
                steps: sim.steps(),
                time: sim.time(),
                averaged_steps: self.count,
                moved_steps: self.moved,
                load_distance: self.load_distance,
                roughness_motion: format!("{:?}", sim.motion()),
                warnings: sim.warnings().to_vec(),
                version: env!("CARGO_PKG_VERSION"),
                first_step: step(0),
                last_step: step(1),
                tables,
            }
        }
    }
}

#[cfg(feature = "serde")]
pub use named::HistoryNumbers;
