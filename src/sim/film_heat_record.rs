//! Numbers of a film's temperature in the record of a step.

use std::io::{self, Write};

use super::film_heat::FilmHeatNumbers;

/// Temperatures and heat of the film in a step, under the names that `thermal.*` has in the JSON of a contact:
/// those of the contact that the step was solved for, at its start. The columns of `history.csv` have the same
/// names with units, `film_heat_` before those that say little alone.
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// use stribeck::thermal::FilmThermal;
/// let mut scene = Scene::azam_2019(16);
/// scene.lubricant = scene.lubricant.map(|oil| {
///     let known = oil.with_temperature(Some(353.15)).with_roelands_s0(Some(1.1));
///     known.with_thermal(Some(FilmThermal::default()))
/// });
/// let record = MixedLubricationSim::builder(scene).build()?.step(10.0)?;
/// let heat = record.film_heat.ok_or("not asked for")?;
/// assert!(heat.film_temperature_max > 353.15 && heat.change <= 5e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FilmHeatRecord {
    /// Largest mean temperature across the film \[K\].
    pub film_temperature_max: f64,
    /// Its mean over r <= 2a/3 \[K\].
    pub film_temperature_mean_central: f64,
    /// Largest rises of the surfaces of ball and disc above the bulk temperature \[K\].
    pub surface_rises: [f64; 2],
    /// Heat of the contact \[W\].
    pub heat: f64,
    /// Heat that comes from nowhere over what comes and goes.
    pub imbalance: f64,
    /// Solves of the contact until film and heat agreed.
    pub solves: u64,
    /// What is left of the difference between film and heat, as in [`FilmHeatNumbers::change`].
    pub change: f64,
}

/// Numbers of a record, a column each.
pub(super) const NUMBERS: usize = 8;

impl FilmHeatRecord {
    /// Those of a film.
    pub(super) fn of(heat: &FilmHeatNumbers) -> Self {
        Self {
            film_temperature_max: heat.maximum,
            film_temperature_mean_central: heat.mean_central,
            surface_rises: heat.surface_rises,
            heat: heat.balance.generated,
            imbalance: heat.balance.imbalance(),
            solves: heat.solves as u64,
            change: heat.change,
        }
    }

    /// Writes the cells of the columns, empty without a record, each after a comma.
    pub(super) fn write(record: Option<&Self>, out: &mut impl Write) -> io::Result<()> {
        let Some(record) = record else { return write!(out, "{}", ",".repeat(NUMBERS)) };
        let [ball, disc] = record.surface_rises;
        let temperatures = [record.film_temperature_max, record.film_temperature_mean_central, ball, disc];
        let numbers = temperatures.into_iter().chain([record.heat, record.imbalance]);
        numbers.into_iter().try_for_each(|number| write!(out, ",{number:e}"))?;
        write!(out, ",{},{:e}", record.solves, record.change)
    }

    /// The record of these numbers, in the order of the columns. Solves are a whole number in files of the
    /// crate; of another one the fraction is dropped.
    pub(super) fn from_numbers(numbers: [f64; NUMBERS]) -> Self {
        let [
            film_temperature_max,
            film_temperature_mean_central,
            ball,
            disc,
            heat,
            imbalance,
            solves,
            change,
        ] = numbers;
        let surface_rises = [ball, disc];
        Self {
            film_temperature_max,
            film_temperature_mean_central,
            surface_rises,
            heat,
            imbalance,
            solves: solves as u64,
            change,
        }
    }
}
