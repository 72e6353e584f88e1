//! What a history ends with: means over its last tenth, under the names that JSON, terminal and Python share.
//!
//! The last tenth of the steps is taken, one step at least. A number is an entry of `NAMES` and one of
//! `numbers`, in the same place; the table in `docs/running.md` lists them.

use std::fmt;

use super::record::StepRecord;

/// Names of the numbers, table and key, in the order of [`numbers`].
const NAMES: [(&str, &str); 18] = [
    ("contact", "area_ratio"),
    ("contact", "load_ratio"),
    ("film", "mean_central"),
    ("film", "minimum_gap"),
    ("film", "lambda"),
    ("film", "formula_lambda"),
    ("pressure", "max"),
    ("friction", "coefficient"),
    ("roughness", "ball_rq"),
    ("roughness", "disc_rq"),
    ("roughness", "composite_rq"),
    ("wear", "ball_in_contact"),
    ("wear", "disc_in_contact"),
    ("wear", "ball_mean"),
    ("wear", "disc_mean"),
    ("tribofilm", "ball_in_contact"),
    ("tribofilm", "disc_in_contact"),
    ("plastic", "volume"),
];

/// Numbers of one step, in the order of [`NAMES`].
fn numbers(record: &StepRecord) -> [f64; NAMES.len()] {
    [
        record.area_ratio,
        record.load_ratio,
        record.average_film,
        record.minimum_gap,
        record.lambda,
        record.formula_lambda,
        record.max_pressure,
        record.friction_coefficient,
        record.rq[0],
        record.rq[1],
        record.composite_rq,
        record.track_wear[0],
        record.track_wear[1],
        record.mean_wear[0],
        record.mean_wear[1],
        record.track_film[0],
        record.track_film[1],
        record.plastic_volume,
    ]
}

/// Means over the last tenth of the steps of a history.
///
/// ```
/// use stribeck::sim::{HistoryMeans, MixedLubricationSim, Scene};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(32)).build()?;
/// let mut means = HistoryMeans::new(2);
/// let records = [sim.step(10.0)?, sim.step(10.0)?];
/// records.iter().for_each(|record| means.see(record));
/// assert_eq!(means.mean("contact", "load_ratio"), Some(records[1].load_ratio));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone)]
pub struct HistoryMeans {
    /// Steps of the whole history.
    steps: u64,
    /// Sums over the steps that count.
    sums: [f64; NAMES.len()],
    /// Steps that count, so far.
    count: u64,
    /// Steps whose contact took more than one position of the roughness.
    moved: u64,
}

impl HistoryMeans {
    /// Of a history of `steps` steps, none of which was seen yet.
    pub fn new(steps: u64) -> Self {
        Self { steps, sums: [0.0; NAMES.len()], count: 0, moved: 0 }
    }

    /// Takes in the next step.
    pub fn see(&mut self, record: &StepRecord) {
        self.moved += u64::from(record.attempts > 1);
        if record.step + self.steps.div_ceil(10) >= self.steps {
            for (sum, number) in self.sums.iter_mut().zip(numbers(record)) {
                *sum += number;
            }
            self.count += 1;
        }
    }

    /// The mean of `key` in `table` (as in `film.lambda`) over the steps of the last tenth that were seen, in
    /// SI units; none for other names.
    pub fn mean(&self, table: &str, key: &str) -> Option<f64> {
        self.named().find(|(name, ..)| *name == (table, key)).map(|(_, mean)| mean)
    }

    /// Names with their means; zero before any step counts.
    fn named(&self) -> impl Iterator<Item = ((&'static str, &'static str), f64)> {
        let count = self.count.max(1) as f64;
        NAMES.into_iter().zip(self.sums).map(move |(name, sum)| (name, sum / count))
    }
}

impl fmt::Display for HistoryMeans {
    /// One line a number, with its unit.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, ((table, key), mean)) in self.named().enumerate() {
            let end = if index == 0 { "" } else { "\n" };
            let unit = match (table, key) {
                ("pressure", _) => " Pa",
                ("plastic", _) => " m^3",
                ("contact" | "friction", _) | (_, "lambda" | "formula_lambda") => "",
                _ => " m",
            };
            write!(f, "{end}{:<28} {mean:.6e}{unit}", format!("{table}.{key}"))?;
        }
        Ok(())
    }
}

#[cfg(feature = "serde")]
mod named {
    use std::collections::BTreeMap;

    use serde::Serialize;

    use super::HistoryMeans;
    use crate::sim::scene::BODIES;
    use crate::sim::{MixedLubricationSim, Warning};

    /// What a history ends with, ready to be written: the means and the worn profiles of `sim`, all in SI
    /// units.
    #[derive(Debug, Clone, Serialize)]
    pub struct HistoryNumbers {
        steps: u64,
        time: f64,
        averaged_steps: u64,
        moved_steps: u64,
        motion: String,
        warnings: Vec<Warning>,
        version: &'static str,
        #[serde(flatten)]
        tables: BTreeMap<&'static str, BTreeMap<String, Entry>>,
    }

    #[derive(Debug, Clone, Serialize)]
    #[serde(untagged)]
    enum Entry {
        Mean(f64),
        Profile(Vec<f64>),
    }

    impl HistoryMeans {
        /// The numbers of the history that `sim` has run, under their names in `docs/running.md`.
        pub fn numbers(&self, sim: &MixedLubricationSim) -> HistoryNumbers {
            let mut tables: BTreeMap<_, BTreeMap<_, _>> = BTreeMap::new();
            for ((table, key), mean) in self.named() {
                tables.entry(table).or_default().insert(key.to_owned(), Entry::Mean(mean));
            }
            for (name, body) in BODIES.into_iter().zip(sim.bodies()) {
                let profile = Entry::Profile(sim.worn_profile(body));
                tables.entry("wear").or_default().insert(format!("{name}_profile"), profile);
            }
            HistoryNumbers {
                steps: sim.steps(),
                time: sim.time(),
                averaged_steps: self.count,
                moved_steps: self.moved,
                motion: format!("{:?}", sim.motion()),
                warnings: sim.warnings().to_vec(),
                version: env!("CARGO_PKG_VERSION"),
                tables,
            }
        }
    }
}

#[cfg(feature = "serde")]
pub use named::HistoryNumbers;
