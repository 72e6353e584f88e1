//! Conditions over time as written in a scene file.

#[cfg(feature = "serde")]
use std::path::Path;
use std::path::PathBuf;

use crate::error::InputError;

/// Schedules of a history; without one the value of the scene is constant.
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scene;
/// use stribeck::sim::scene::Schedule;
/// let mut scene = Scene::azam_2019(32);
/// scene.schedule.entrainment_speed = Some(Schedule::ramps(&[(0.0, 0.1), (100.0, 0.3)]));
/// assert!((scene.conditions(50.0)?.motion.entrainment_speed - 0.2).abs() < 1e-12);
/// assert_eq!(scene.conditions(1e4)?.motion.entrainment_speed, 0.3); // constant after the last entry
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct Schedules {
    /// Normal load \[N\], of a line contact per length \[N/m\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub load: Option<Schedule>,
    /// Entrainment speed \[m/s\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub entrainment_speed: Option<Schedule>,
    /// Sliding over entrainment speed.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub slide_roll_ratio: Option<Schedule>,
    /// Bulk temperature \[K\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub bulk_temperature: Option<Schedule>,
}

impl Schedules {
    /// Whether nothing is scheduled.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Replaces paths of tables by their contents.
    pub(in crate::sim) fn read_tables(&mut self) -> Result<(), InputError> {
        for (key, schedule) in self.present_mut() {
            if let Schedule::Table { path } = schedule {
                let (times, values) = crate::sim::scene::time_series::read_table(path, key)?;
                *schedule = Schedule::Ramps { times, values };
            }
        }
        Ok(())
    }

    /// Makes paths of tables relative to `folder`.
    #[cfg(feature = "serde")]
    pub(super) fn locate_tables(&mut self, folder: &Path) {
        for (_, schedule) in self.present_mut() {
            if let Schedule::Table { path } = schedule {
                *path = folder.join(&path);
            }
        }
    }

    /// The given schedules and their keys.
    fn present_mut(&mut self) -> impl Iterator<Item = (&'static str, &mut Schedule)> {
        [
            ("schedule.load", &mut self.load),
            ("schedule.entrainment_speed", &mut self.entrainment_speed),
            ("schedule.slide_roll_ratio", &mut self.slide_roll_ratio),
            ("schedule.bulk_temperature", &mut self.bulk_temperature),
        ]
        .into_iter()
        .filter_map(|(key, schedule)| schedule.as_mut().map(|schedule| (key, schedule)))
    }
}

/// A quantity as a function of time. Times \[s\] increase, the first is 0 or earlier; the value is constant
/// after the last entry.
///
/// ```
/// use stribeck::sim::{Scene, Schedule};
/// let mut scene = Scene::azam_2019(32);
/// scene.schedule.load = Some(Schedule::steps(&[(0.0, 20.0), (600.0, 40.0)]));
/// scene.schedule.entrainment_speed = Some(Schedule::ramps(&[(0.0, 0.1), (100.0, 0.3)]));
/// let now = scene.conditions(50.0)?;
/// assert_eq!(now.load, 20.0);
/// assert!((now.motion.entrainment_speed - 0.2).abs() < 1e-15);
/// assert_eq!(scene.conditions(600.0)?.load, 40.0);
/// scene.schedule.load = Some(Schedule::steps(&[(0.0, 20.0), (600.0, -40.0)]));
/// let error = scene.conditions(0.0).unwrap_err();
/// assert_eq!(error.to_string(), "schedule.load.values[1] = -40: must be finite and > 0");
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)
)]
#[non_exhaustive]
pub enum Schedule {
    /// One value for all times.
    Constant {
        /// The value.
        value: f64,
    },
    /// Each value holds from its time until the next.
    Steps {
        /// Times \[s\].
        times: Vec<f64>,
        /// Values from these times on.
        values: Vec<f64>,
    },
    /// Linear from each time to the next.
    Ramps {
        /// Times \[s\].
        times: Vec<f64>,
        /// Values at these times.
        values: Vec<f64>,
    },
    /// A file of comma-separated values, linear between its lines. Each line has a time \[s\] and a value. Lines that
    /// begin with `#` and a first line of names are skipped.
    Table {
        /// The file, relative to the scene file.
        path: PathBuf,
    },
}

impl Schedule {
    /// Values that hold from their times \[s\] on, as pairs of time and value.
    pub fn steps(points: &[(f64, f64)]) -> Self {
        let (times, values) = points.iter().copied().unzip();
        Self::Steps { times, values }
    }

    /// Values at times \[s\], linear in between, as pairs of time and value.
    pub fn ramps(points: &[(f64, f64)]) -> Self {
        let (times, values) = points.iter().copied().unzip();
        Self::Ramps { times, values }
    }
}
