//! Load, speeds and bulk temperature of a history as functions of time.

use crate::error::InputError;
use crate::reynolds::{LEAST_SPEED, SPEED_REQUIREMENT};
use crate::sim::scene::time_series::TimeSeries;
use crate::sim::scene::{Motion, Scene, Schedule};

/// Operating conditions of a contact.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build()?;
/// let mut conditions = sim.conditions();
/// conditions.motion.entrainment_speed = 1.0;
/// // The present bodies at another speed, without a step:
/// let faster = sim.clone().solve_under(&conditions)?;
/// assert!(faster.moes.map(|moes| moes.m) < sim.scene().formula_film()?.map(|film| film.moes.m));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Conditions {
    /// Normal load \[N\]; of a line contact per metre of its length.
    pub load: f64,
    /// Speeds of the surfaces.
    pub motion: Motion,
    /// Bulk temperature \[K\].
    pub bulk_temperature: f64,
}

/// Conditions as functions of time.
#[derive(Debug, Clone)]
pub(in crate::sim) struct OperatingSchedule {
    /// Conditions of the scene, where nothing is scheduled.
    base: Conditions,
    /// Load over time \[N\].
    load: Option<TimeSeries>,
    /// Entrainment speed over time \[m/s\].
    speed: Option<TimeSeries>,
    /// Slide-roll ratio over time.
    slide_roll_ratio: Option<TimeSeries>,
    /// Bulk temperature over time \[K\].
    temperature: Option<TimeSeries>,
}

impl Scene {
    /// The conditions at `time` \[s\]: values of the schedules, or of the scene without a schedule.
    ///
    /// # Errors
    /// A load, form or modulus out of range; a schedule that goes back in time, has no value at the start or
    /// contains a value out of range; a table that cannot be read.
    pub fn conditions(&self, time: f64) -> Result<Conditions, InputError> {
        InputError::require_non_negative("time", time)?;
        Ok(OperatingSchedule::new(self)?.at(time))
    }
}

impl OperatingSchedule {
    /// Checks the schedules of `scene`.
    pub(in crate::sim) fn new(scene: &Scene) -> Result<Self, InputError> {
        let schedules = &scene.schedule;
        let series = |key: &str, schedule: &Option<Schedule>, fits: fn(f64) -> bool, requirement| {
            let field = format!("schedule.{key}");
            schedule.as_ref().map(|given| TimeSeries::new(given, &field, fits, requirement)).transpose()
        };
        let positive: fn(f64) -> bool = |value| value.is_finite() && value > 0.0;
        let load = series("load", &schedules.load, positive, "finite and > 0")?;
        let speeds = &schedules.entrainment_speed;
        let speed = if scene.is_lubricated() {
            series("entrainment_speed", speeds, |v| v.is_finite() && v >= LEAST_SPEED, SPEED_REQUIREMENT)?
        } else {
            series("entrainment_speed", speeds, |v| v.is_finite() && v >= 0.0, "finite and >= 0")?
        };
        let ratios = &schedules.slide_roll_ratio;
        let slide_roll_ratio = series("slide_roll_ratio", ratios, f64::is_finite, "finite")?;
        let temperatures = &schedules.bulk_temperature;
        let temperature = series("bulk_temperature", temperatures, positive, "finite and > 0")?;
        let base = Conditions {
            load: scene.load.force.unwrap_or(scene.constant_hertz()?.force),
            motion: scene.motion,
            bulk_temperature: scene.thermal.bulk_temperature,
        };
        Ok(Self { base, load, speed, slide_roll_ratio, temperature })
    }

    /// The same `conditions` at all times.
    pub(in crate::sim) fn constant(conditions: Conditions) -> Self {
        Self { base: conditions, load: None, speed: None, slide_roll_ratio: None, temperature: None }
    }

    /// The conditions at `time` \[s\].
    pub(in crate::sim) fn at(&self, time: f64) -> Conditions {
        let value =
            |series: &Option<TimeSeries>, constant| series.as_ref().map_or(constant, |c| c.value(time));
        Conditions {
            load: value(&self.load, self.base.load),
            motion: Motion {
                entrainment_speed: value(&self.speed, self.base.motion.entrainment_speed),
                slide_roll_ratio: value(&self.slide_roll_ratio, self.base.motion.slide_roll_ratio),
                ..self.base.motion
            },
            bulk_temperature: value(&self.temperature, self.base.bulk_temperature),
        }
    }

    /// The scheduled quantities.
    fn series(&self) -> impl Iterator<Item = &TimeSeries> {
        [&self.load, &self.speed, &self.slide_roll_ratio, &self.temperature].into_iter().flatten()
    }

    /// Load \[N\] and entrainment speed \[m/s\] over time, if scheduled.
    pub(in crate::sim) fn load_and_speed(&self) -> [Option<&TimeSeries>; 2] {
        [self.load.as_ref(), self.speed.as_ref()]
    }

    /// The next time after `time` \[s\] at which a schedule has an entry.
    pub(in crate::sim) fn next_entry(&self, time: f64) -> Option<f64> {
        self.series().filter_map(|series| series.next_entry(time)).min_by(f64::total_cmp)
    }

    /// Smallest and largest load \[N\].
    pub(in crate::sim) fn loads(&self) -> [f64; 2] {
        let Some(load) = &self.load else { return [self.base.load; 2] };
        let extreme = |pick: fn(f64, f64) -> f64| load.values().iter().copied().reduce(pick);
        [extreme(f64::min), extreme(f64::max)].map(|load| load.unwrap_or(self.base.load))
    }

    /// The conditions at the start and at all later entries; at a jump, those after it.
    pub(in crate::sim) fn entries(&self) -> Vec<Conditions> {
        let times = self.series().flat_map(TimeSeries::times).copied().filter(|time| *time > 0.0);
        std::iter::once(0.0).chain(times).map(|time| self.at(time)).collect()
    }

    /// Whether ball and disc move at any time.
    pub(in crate::sim) fn moving(&self) -> [bool; 2] {
        let speeds = |time| self.at(time).motion.surface_speeds().map(|speed| speed != 0.0);
        let (mut from, mut moving) = (0.0, speeds(0.0));
        while let Some(to) = self.next_entry(from) {
            // A product of two ramps is a parabola: if it is zero at three points between entries, it is zero everywhere.
            for share in [0.25, 0.5, 0.75, 1.0] {
                let now = speeds(from + share * (to - from));
                moving.iter_mut().zip(now).for_each(|(moving, now)| *moving |= now);
            }
            if to <= from {
                break;
            }
            from = to;
        }
        moving
    }

    /// Mean speeds \[m/s\] of ball and disc from the start to `time` \[s\], for their displacements.
    pub(in crate::sim) fn mean_speeds(&self, time: f64) -> [f64; 2] {
        let changes = self.speed.is_some() || self.slide_roll_ratio.is_some();
        if !changes || time <= 0.0 {
            return self.at(time).motion.surface_speeds();
        }
        let series = [&self.speed, &self.slide_roll_ratio];
        let next = |from: f64| {
            let entries = series.into_iter().flatten().filter_map(|series| series.next_entry(from));
            entries.fold(time, f64::min)
        };
        let (mut from, mut distances) = (0.0, [0.0; 2]);
        while from < time {
            let to = next(from);
            // A product of two ramps is a parabola: two-point Gauss quadrature is exact, and no point lies at a jump.
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            for point in [middle - half / 3.0_f64.sqrt(), middle + half / 3.0_f64.sqrt()] {
                let speeds = self.at(point).motion.surface_speeds();
                distances.iter_mut().zip(speeds).for_each(|(distance, speed)| *distance += half * speed);
            }
            if to <= from {
                break;
            }
            from = to;
        }
        distances.map(|distance| distance / time)
    }
}
