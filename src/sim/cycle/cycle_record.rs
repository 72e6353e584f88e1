//! One solved cycle of a history.

use crate::sim::cycle::CyclePoint;
use crate::sim::history::simulation::MixedLubricationSim;

/// A solved cycle of a history and the bodies at its end, in SI units; numbers of a line contact are per metre.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct CycleRecord {
    /// Cycles of the history up to the end of this one.
    pub cycles: f64,
    /// Least film of the cycle \[m\].
    pub film_minimum: f64,
    /// Largest pressure of the cycle \[Pa\].
    pub pressure_max: f64,
    /// Share of the load on solids, mean of the contacts.
    pub contact_load_ratio: f64,
    /// Friction coefficient, mean of the contacts.
    pub friction_coefficient: f64,
    /// Volume worn off the ball since the start of the history \[m^3\].
    pub wear_ball_volume: f64,
    /// Volume worn off the disc \[m^3\].
    pub wear_disc_volume: f64,
    /// Largest worn depth of the ball \[m\].
    pub wear_ball_max: f64,
    /// Largest worn depth of the disc \[m\].
    pub wear_disc_max: f64,
    /// Largest thickness of the tribofilm on the ball \[m\].
    pub tribofilm_ball_max: f64,
    /// Largest thickness of the tribofilm on the disc \[m\].
    pub tribofilm_disc_max: f64,
}

impl CycleRecord {
    /// The cycle with the contacts `points`, after which `sim` has taken `cycles`.
    pub(super) fn of(cycles: f64, points: &[CyclePoint], sim: &MixedLubricationSim) -> Self {
        let mean =
            |value: fn(&CyclePoint) -> f64| points.iter().map(value).sum::<f64>() / points.len() as f64;
        let largest = |field: &[f64]| field.iter().copied().fold(0.0, f64::max);
        let [ball, disc] = sim.bodies();
        let length = sim.grid().contact_length();
        Self {
            cycles,
            film_minimum: points.iter().map(|point| point.film_minimum).fold(f64::INFINITY, f64::min),
            pressure_max: points.iter().map(|point| point.pressure_max).fold(0.0, f64::max),
            contact_load_ratio: mean(|point| point.contact_load_ratio),
            friction_coefficient: mean(|point| point.friction_coefficient),
            wear_ball_volume: ball.worn_volume() / length,
            wear_disc_volume: disc.worn_volume() / length,
            wear_ball_max: largest(ball.wear()),
            wear_disc_max: largest(disc.wear()),
            tribofilm_ball_max: largest(ball.tribofilm()),
            tribofilm_disc_max: largest(disc.tribofilm()),
        }
    }

    /// Names of the columns of [`csv`](Self::csv).
    pub const COLUMNS: &'static str = "cycles,film_minimum_m,pressure_max_Pa,contact_load_ratio,friction_coefficient,\
         wear_ball_volume_m3,wear_disc_volume_m3,wear_ball_max_m,wear_disc_max_m,tribofilm_ball_max_m,tribofilm_disc_max_m";

    /// A line of comma-separated values.
    ///
    /// ```
    /// use stribeck::sim::CycleRecord;
    /// assert_eq!(CycleRecord::COLUMNS.split(',').count(), 11);
    /// ```
    pub fn csv(&self) -> String {
        let values = [
            self.cycles,
            self.film_minimum,
            self.pressure_max,
            self.contact_load_ratio,
            self.friction_coefficient,
            self.wear_ball_volume,
            self.wear_disc_volume,
            self.wear_ball_max,
            self.wear_disc_max,
            self.tribofilm_ball_max,
            self.tribofilm_disc_max,
        ];
        values.map(|value| format!("{value:e}")).join(",")
    }
}
