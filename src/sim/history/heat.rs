//! Flash temperature in a history: whether it is modelled, and its plan for the present speeds.
//!
//! Frictional heat enters both bodies as moving sources ([`FlashTemperature`]). The rise is added to the bulk
//! temperature in the growth laws and has no effect on the oil. A film with its own temperature includes the
//! rises of both surfaces by the same friction: these replace the flash temperature, so that heat counts once.
//! If the estimated rise of the smooth contact is below 1 K under all conditions of the schedule, the flash
//! temperature is left out unless the scene requires it.

use std::ops::Range;

use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::contact::film_heat::FilmIteration;
use crate::sim::contact::film_temperature;
use crate::sim::contact::formula::formula_film;
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::friction_laws::mean_fluid_stress;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::model::ContactModel;
use crate::sim::scene::operating_schedule::{Conditions, OperatingSchedule};
use crate::sim::scene::{Flash, Scene};
use crate::tribochem::{FlashTemperature, ThermalBody, estimate_rise_under_flux};

/// Estimated flash temperature rise below which it is left out by default \[K\].
const NEGLIGIBLE_RISE: f64 = 1.0;

/// Share of the heat on each side of a contact whose temperature is not computed: it is far from the hottest place.
const LEFT_OUT: f64 = 1e-4;

/// The flash temperature of a history.
#[derive(Debug, Clone)]
pub(in crate::sim) struct Heat {
    /// Whether the rises are modelled.
    pub(in crate::sim) is_modelled: bool,
    /// The plan; `None` if rises are not modelled or are those of the film temperature.
    flash: Option<FlashTemperature>,
    /// Estimate of the largest rise over the entries of the schedule \[K\].
    pub(in crate::sim) estimate: f64,
    /// Conductivity and diffusivity of ball and disc.
    bodies: [ThermalBody; 2],
    /// Speeds of the plan \[m/s\].
    speeds: [f64; 2],
    /// Frictional heat at every node of the contact \[W/m^2\].
    sources: Vec<f64>,
    /// Rise of the surfaces of ball and disc at every node \[K\].
    rises: [Vec<f64>; 2],
}

impl Heat {
    /// The flash temperature for the initial conditions, left out if switched off or negligible by its estimate.
    pub(in crate::sim) fn new(
        scene: &Scene,
        contact: &ContactModel,
        operating_schedule: &OperatingSchedule,
        laws: &Laws,
    ) -> Result<Self, InputError> {
        let bodies = scene.thermal_bodies();
        let mut estimate = 0.0_f64;
        for conditions in operating_schedule.entries() {
            estimate = estimate.max(estimated_rise(scene, contact, &conditions, laws)?);
        }
        let is_modelled = match scene.thermal.flash {
            Flash::On => true,
            Flash::Off => false,
            Flash::Auto => estimate >= NEGLIGIBLE_RISE,
        };
        let speeds = operating_schedule.at(0.0).motion.surface_speeds();
        let needed = is_modelled && !film_temperature::models_film_temperature(scene);
        let flash = if needed { Some(FlashTemperature::new(&contact.grid, bodies, speeds)?) } else { None };
        let zeros = || vec![0.0; contact.grid.len()];
        Ok(Self { is_modelled, flash, estimate, bodies, speeds, sources: zeros(), rises: [zeros(), zeros()] })
    }

    /// Updates the rises of the surfaces by the heat of `friction`, or from the temperature of the film if it is
    /// modelled. Returns the largest rise \[K\]; `None` if not modelled.
    pub(in crate::sim) fn update(
        &mut self,
        friction: &FrictionFields,
        film: Option<&FilmIteration>,
    ) -> Result<Option<f64>, InputError> {
        if let (Some(film), true) = (film, self.is_modelled) {
            for (rises, found) in self.rises.iter_mut().zip(film.surface_rises()) {
                rises.copy_from_slice(found);
            }
            return Ok(Some(self.rises.iter().flatten().fold(0.0, |most, rise| rise.max(most))));
        }
        let Some(flash) = &mut self.flash else { return Ok(None) };
        for (k, source) in self.sources.iter_mut().enumerate() {
            *source = friction.heat(k);
        }
        let [ball, disc] = &mut self.rises;
        let maximum = flash.rise(&self.sources, ball)?.maximum;
        disc.copy_from_slice(ball);
        Ok(Some(maximum))
    }

    /// Rises of the surfaces of ball and disc at every node of the contact \[K\]; zero if not modelled.
    pub(in crate::sim) fn rises(&self) -> [&[f64]; 2] {
        [&self.rises[0], &self.rises[1]]
    }

    /// Makes a new plan if the `speeds` \[m/s\] have changed.
    pub(in crate::sim) fn move_at(&mut self, speeds: [f64; 2], grid: &Grid) -> Result<(), InputError> {
        if let Some(flash) = &mut self.flash
            && speeds.map(f64::to_bits) != self.speeds.map(f64::to_bits)
        {
            *flash = FlashTemperature::new(grid, self.bodies, speeds)?;
            self.speeds = speeds;
        }
        Ok(())
    }
}

/// Largest rise of the surfaces \[K\] of a steady contact under the heat of `friction`, or from the temperature of the
/// `film` if it is modelled. `None` if switched off, and without heat.
pub(in crate::sim) fn steady_rise(
    scene: &Scene,
    contact: &ContactModel,
    friction: &FrictionFields,
    film: Option<&FilmIteration>,
) -> Result<Option<f64>, InputError> {
    let sources: Vec<f64> = (0..contact.grid.len()).map(|k| friction.heat(k)).collect();
    if scene.thermal.flash == Flash::Off || sources.iter().all(|source| *source == 0.0) {
        return Ok(None);
    }
    if let Some(film) = film {
        return Ok(Some(film.surface_rises().into_iter().flatten().fold(0.0, |most, rise| rise.max(most))));
    }
    let speeds = contact.motion.surface_speeds();
    let (grid, sources) = heated_part(&contact.grid, sources)?;
    let mut flash = FlashTemperature::new(&grid, scene.thermal_bodies(), speeds)?;
    let mut rises = vec![0.0; sources.len()];
    Ok(Some(flash.rise(&sources, &mut rises)?.maximum))
}

/// The part of `grid` that holds the `sources` but for `LEFT_OUT` of them on each side, and its sources. The largest rise is
/// where heat enters. A strip and a line are kept whole.
fn heated_part(grid: &Grid, sources: Vec<f64>) -> Result<(Grid, Vec<f64>), InputError> {
    if grid.is_strip() || grid.ny() == 1 {
        return Ok((*grid, sources));
    }
    let (mut columns, mut rows) = (vec![0.0; grid.nx()], vec![0.0; grid.ny()]);
    for (row, sum) in sources.chunks_exact(grid.nx()).zip(&mut rows) {
        *sum = row.iter().sum();
        columns.iter_mut().zip(row).for_each(|(sum, source)| *sum += source);
    }
    let [columns, rows] = [held(&columns), held(&rows)];
    let part = Grid::centred(columns.len(), rows.len(), grid.dx(), grid.dy())?;
    let kept = sources.chunks_exact(grid.nx()).skip(rows.start).take(rows.len());
    let kept = kept.flat_map(|row| row.iter().skip(columns.start).take(columns.len()).copied());
    Ok((part, kept.collect()))
}

/// The lines that hold all of the `heat` of each line but for `LEFT_OUT` on either side; at least two.
fn held(heat: &[f64]) -> Range<usize> {
    let most = LEFT_OUT * heat.iter().sum::<f64>();
    let leading = |heat: &mut dyn Iterator<Item = &f64>| {
        let mut sum = 0.0;
        heat.take_while(|line| {
            sum += **line;
            sum <= most
        })
        .count()
    };
    let (start, behind) = (leading(&mut heat.iter()), leading(&mut heat.iter().rev()));
    let end = heat.len().saturating_sub(behind).max(start + 2).min(heat.len());
    start.min(end.saturating_sub(2))..end
}

/// Largest rise \[K\] of the smooth contact. The full load is carried by solids or by a fluid film of the
/// thickness by formula, whichever is hotter. It is that of a circle under the mean flux; its radius is the
/// geometric mean of the half-widths, or the half-width of a line contact.
fn estimated_rise(
    scene: &Scene,
    contact: &ContactModel,
    conditions: &Conditions,
    laws: &Laws,
) -> Result<f64, InputError> {
    let hertz = contact.hertz_under(scene, conditions.load)?.per_metre(&contact.grid);
    let (motion, mean) = (conditions.motion, hertz.force / hertz.area);
    let (sliding, speeds) = (motion.sliding_speed(), motion.surface_speeds());
    let full = laws.growth.as_ref().map_or(0.0, |law| law.maximum_thickness());
    // Bare surfaces and full tribofilm.
    let coefficient = [0.0, full].map(|film| laws.friction.coefficient(mean, sliding, [film; 2]));
    let coefficient = coefficient[0].max(coefficient[1]);
    InputError::require_non_negative("boundary friction of the law", coefficient)?;
    let mut flux = coefficient * mean * sliding;
    if let Some(lubricant) = &contact.lubricant {
        let law = Some(lubricant.viscosity());
        let film = formula_film(scene, &hertz, motion.entrainment_speed, law, None)?;
        let film = film.map_or(0.0, |film| film.central);
        let rheology = scene.friction.rheology()?;
        let is_line = scene.form.is_line();
        let viscosity = |pressure| lubricant.viscosity().viscosity(pressure);
        let stress = mean_fluid_stress(&viscosity, &rheology, (hertz.pressure, is_line), film, sliding);
        flux = flux.max(stress * sliding);
    }
    estimate_rise_under_flux(scene.thermal_bodies(), speeds, flux, hertz.radius)
}
