//! The heat pass of a history: whether it is worth its time, and its plan for the speeds that hold.
//!
//! Heat of friction goes into both bodies as moving sources ([`FlashTemperature`]); the rise adds to the bulk
//! temperature that the laws of growth see. It does not act back on the oil. A film with a temperature of its
//! own has found the rises of both surfaces already, with the heat of the same friction: they take the place
//! of the flash temperature, each for its body, and no heat counts twice. Where the smooth contact would
//! get warmer by less than 1 K under all conditions of the schedule, the pass is left out unless the scene
//! asks for it.

use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::contact::film_heat::{self, FilmIteration};
use crate::sim::contact::formula::formula_film;
use crate::sim::contact::friction::{FrictionFields, mean_fluid_stress};
use crate::sim::contact::laws::Laws;
use crate::sim::contact::model::ContactModel;
use crate::sim::scene::operating_schedule::{Conditions, OperatingSchedule};
use crate::sim::scene::{Flash, Scene};
use crate::tribochem::{FlashTemperature, ThermalBody, estimate_rise_under_flux};

/// Flash temperature rise below which the heat pass is left out unless asked for \[K\].
const NEGLIGIBLE_RISE: f64 = 1.0;

/// The heat pass.
#[derive(Debug, Clone)]
pub(in crate::sim) struct Heat {
    /// Whether the rises are modelled.
    pub(in crate::sim) is_modelled: bool,
    /// What finds them; none where they are not modelled and where those of the film take their place.
    flash: Option<FlashTemperature>,
    /// Estimate of the largest rise under the conditions at the entries of the schedule \[K\].
    pub(in crate::sim) estimate: f64,
    /// Conductivity and diffusivity of ball and disc.
    bodies: [ThermalBody; 2],
    /// Speeds that the plan is made for \[m/s\].
    speeds: [f64; 2],
    /// Heat of friction at every node of the contact \[W/m^2\].
    sources: Vec<f64>,
    /// Rise of the surfaces of ball and disc at every node \[K\].
    rises: [Vec<f64>; 2],
}

impl Heat {
    /// The pass for the conditions at the start, left out where it is switched off or its estimate is
    /// negligible.
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
        let needed = is_modelled && !film_heat::is_asked(scene);
        let flash = if needed { Some(FlashTemperature::new(&contact.grid, bodies, speeds)?) } else { None };
        let zeros = || vec![0.0; contact.grid.len()];
        Ok(Self { is_modelled, flash, estimate, bodies, speeds, sources: zeros(), rises: [zeros(), zeros()] })
    }

    /// Rises of the surfaces under the heat of `friction`, those of a film with a temperature of its own where
    /// there is one; returns the largest \[K\], none where they are not modelled.
    pub(in crate::sim) fn rub(
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

    /// Rises of the surfaces of ball and disc at every node of the contact \[K\]; zeros where they are not
    /// modelled.
    pub(in crate::sim) fn rises(&self) -> [&[f64]; 2] {
        [&self.rises[0], &self.rises[1]]
    }

    /// Plans anew where the surfaces move at other `speeds` \[m/s\] than before.
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

/// Largest rise \[K\] of the smooth contact, all of its load on solids or all of it on a fluid film of the
/// thickness that the formulas give, whichever is hotter: that of a circle under the mean flux, whose radius
/// is the geometric mean of the half-widths, or the half-width of a line contact.
fn estimated_rise(
    scene: &Scene,
    contact: &ContactModel,
    conditions: &Conditions,
    laws: &Laws,
) -> Result<f64, InputError> {
    let hertz = contact.hertz_under(scene, conditions.load)?;
    let (motion, mean) = (conditions.motion, hertz.force / hertz.area);
    let (sliding, speeds) = (motion.sliding_speed(), motion.surface_speeds());
    let full = laws.growth.as_ref().map_or(0.0, |law| law.maximum_thickness());
    // Bare or covered.
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
