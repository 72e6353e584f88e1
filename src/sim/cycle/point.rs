//! One contact of a cycle.

use std::f64::consts::TAU;

use crate::sim::contact::model::ContactModel;
use crate::sim::history::record::StepRecord;
use crate::sim::scene::cycle_table::CycleRow;

/// Results at one time of a cycle, in SI units; those of a line contact are per metre.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct CyclePoint {
    /// Time \[s\].
    pub time: f64,
    /// Angle \[rad\]; `None` for a table of times.
    pub angle: Option<f64>,
    /// Load \[N\].
    pub load: f64,
    /// Speed of the ball relative to the contact \[m/s\].
    pub ball_speed: f64,
    /// Speed of the disc relative to the contact \[m/s\].
    pub disc_speed: f64,
    /// Reduced radius \[m\]; that of an ellipsoid along x.
    pub radius: f64,
    /// Bulk temperature \[K\].
    pub bulk_temperature: f64,
    /// Hertz pressure of the smooth bodies \[Pa\].
    pub hertz_pressure: f64,
    /// Central film of a smooth steady contact at this speed by the formula of its regime
    /// ([`FormulaFilm`](crate::sim::FormulaFilm)), over the relative density of the oil at the Hertz pressure \[m\].
    pub formula_film: f64,
    /// Central film \[m\].
    pub film_central: f64,
    /// Smallest film of nodes under pressure \[m\].
    pub film_minimum: f64,
    /// Mean film over r <= 2a/3 \[m\].
    pub film_mean_central: f64,
    /// Largest pressure \[Pa\].
    pub pressure_max: f64,
    /// Share of the load on solids.
    pub contact_load_ratio: f64,
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Power of friction \[W\].
    pub friction_power: f64,
    /// Largest flash temperature rise \[K\]; `None` if not modelled.
    pub flash_rise: Option<f64>,
    /// Size of the squeeze term: change of the central film in the time in which the entrained film passes a half-width,
    /// over the film. `None` at dead points, where the entrainment vanishes.
    pub squeeze_ratio: Option<f64>,
    /// Volume worn off the ball since the start of the history \[m^3\].
    pub wear_ball_volume: f64,
    /// Volume worn off the disc \[m^3\].
    pub wear_disc_volume: f64,
    /// Load residual of the solve.
    pub residual_load: f64,
    /// Iterations of the solver.
    pub iterations: u64,
}

impl CyclePoint {
    /// From the `record` of `contact` under the conditions of `row`.
    pub(super) fn of(row: &CycleRow, turn: Option<f64>, record: &StepRecord, contact: &ContactModel) -> Self {
        let hertz_pressure = contact.hertz.pressure;
        let density = contact.lubricant.as_ref().map_or(1.0, |oil| oil.density().ratio(hertz_pressure));
        let formula_film = contact.formulas.map_or(0.0, |formulas| formulas.central) / density;
        let friction = record.friction.coefficient;
        Self {
            time: row.time,
            angle: turn.map(|turn| row.time / turn * TAU),
            load: row.load,
            ball_speed: row.speeds[0],
            disc_speed: row.speeds[1],
            radius: row.radius,
            bulk_temperature: row.bulk_temperature,
            hertz_pressure,
            formula_film,
            film_central: record.film.central,
            film_minimum: record.film.minimum,
            film_mean_central: record.film.mean_central,
            pressure_max: record.pressure.max,
            contact_load_ratio: record.contact.load_ratio,
            friction_coefficient: friction,
            friction_power: friction * row.load * (row.speeds[0] - row.speeds[1]).abs(),
            flash_rise: record.flash_rise,
            squeeze_ratio: None,
            wear_ball_volume: record.wear.ball_volume,
            wear_disc_volume: record.wear.disc_volume,
            residual_load: record.report.residual.load,
            iterations: record.report.work.iterations,
        }
    }

    /// Names of the columns of [`csv`](Self::csv).
    pub const COLUMNS: &'static str = "time_s,angle_rad,load_N,ball_speed_m_per_s,disc_speed_m_per_s,radius_m,bulk_temperature_K,\
         hertz_pressure_Pa,formula_film_m,film_central_m,film_minimum_m,film_mean_central_m,pressure_max_Pa,contact_load_ratio,\
         friction_coefficient,friction_power_W,flash_rise_K,squeeze_ratio,wear_ball_volume_m3,wear_disc_volume_m3,\
         residual_load,iterations";

    /// A line of comma-separated values; unknown ones are empty.
    ///
    /// ```
    /// use stribeck::sim::CyclePoint;
    /// assert_eq!(CyclePoint::COLUMNS.split(',').count(), 22);
    /// ```
    pub fn csv(&self) -> String {
        let values = [
            Some(self.time),
            self.angle,
            Some(self.load),
            Some(self.ball_speed),
            Some(self.disc_speed),
            Some(self.radius),
            Some(self.bulk_temperature),
            Some(self.hertz_pressure),
            Some(self.formula_film),
            Some(self.film_central),
            Some(self.film_minimum),
            Some(self.film_mean_central),
            Some(self.pressure_max),
            Some(self.contact_load_ratio),
            Some(self.friction_coefficient),
            Some(self.friction_power),
            self.flash_rise,
            self.squeeze_ratio,
            Some(self.wear_ball_volume),
            Some(self.wear_disc_volume),
            Some(self.residual_load),
        ];
        let cells = values.map(|value| value.map_or_else(String::new, |value| format!("{value:e}")));
        format!("{},{}", cells.join(","), self.iterations)
    }
}
