//! Load, speeds, temperature and form of a contact model between its solves.

use crate::error::InputError;
use crate::lubricant::Lubricant;
use crate::reynolds::{FlowBalance, ShearThinning};
use crate::sim::contact::formula::{FormulaFilm, formula_film, stated_film};
use crate::sim::contact::model::ContactModel;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::operating_schedule::Conditions;
use crate::sim::scene::{Motion, Scene};

/// State of a contact model that depends on the conditions.
#[derive(Debug, Clone, Copy)]
pub(in crate::sim) struct SavedConditions {
    /// Hertz contact under the load.
    hertz: HertzContact,
    /// Entrainment speed and slide-roll ratio.
    motion: Motion,
    /// Film formulas.
    formulas: Option<FormulaFilm>,
    /// Central film by formula \[m\].
    stated_film: f64,
    /// Requested load \[N\].
    load: f64,
    /// Shear-thinned viscosity of the pressure flow.
    shear_thinning: Option<ShearThinning>,
    /// Temperature of the lubricant \[K\].
    bulk_temperature: f64,
    /// Flow balance of the last solution.
    flow: Option<FlowBalance>,
}

impl ContactModel {
    /// The Hertz contact under `load` \[N\]; of a strip that of one period under `load` \[N/m\].
    pub(in crate::sim) fn hertz_under(&self, scene: &Scene, load: f64) -> Result<HertzContact, InputError> {
        let is_present = load.to_bits() == self.load.to_bits();
        if is_present { Ok(self.hertz) } else { Ok(scene.hertz_under(load)?.on(&self.grid)) }
    }

    /// Sets load and speeds of `conditions`.
    pub(in crate::sim) fn set_conditions(
        &mut self,
        scene: &Scene,
        conditions: &Conditions,
    ) -> Result<(), InputError> {
        let temperature = conditions.bulk_temperature;
        let warmed = temperature.to_bits() != self.bulk_temperature.to_bits();
        let same = conditions.motion == self.motion && conditions.load.to_bits() == self.load.to_bits();
        if same && !warmed {
            return Ok(());
        }
        self.warm_to(temperature);
        let (hertz, motion) = (self.hertz_under(scene, conditions.load)?, conditions.motion);
        let law = self.lubricant.as_ref().map(Lubricant::viscosity);
        let per_metre = hertz.per_metre(&self.grid);
        let formulas = formula_film(scene, &per_metre, motion.entrainment_speed, law, None)?;
        let stated_film = stated_film(scene, &per_metre, conditions, law)?;
        let shear_thinning = scene.friction.shear_thinning(motion.sliding_speed())?;
        (self.hertz, self.motion, self.formulas, self.stated_film) = (hertz, motion, formulas, stated_film);
        (self.load, self.shear_thinning) = (conditions.load, shear_thinning);
        Ok(())
    }

    /// Sets the form of `scene`; Hertz contact and formulas follow with the next
    /// [`set_conditions`](ContactModel::set_conditions).
    pub(in crate::sim) fn set_form(&mut self, scene: &Scene) -> Result<(), InputError> {
        scene.form.gap_into(&self.grid, &mut self.form_gap)?;
        // No load is equal to NaN: the next conditions are new ones.
        self.load = f64::NAN;
        Ok(())
    }

    /// Sets the bulk `temperature` \[K\] of the lubricant.
    fn warm_to(&mut self, temperature: f64) {
        if temperature.to_bits() != self.bulk_temperature.to_bits() {
            self.lubricant = self.lubricant.take().map(|lubricant| lubricant.at_temperature(temperature));
            self.bulk_temperature = temperature;
        }
    }

    /// State changed by [`ContactModel::set_conditions`], and the flow balance changed by [`ContactModel::solve`].
    pub(in crate::sim) fn saved(&self) -> SavedConditions {
        SavedConditions {
            hertz: self.hertz,
            motion: self.motion,
            formulas: self.formulas,
            stated_film: self.stated_film,
            load: self.load,
            shear_thinning: self.shear_thinning,
            bulk_temperature: self.bulk_temperature,
            flow: self.flow,
        }
    }

    /// Restores the state saved by [`ContactModel::saved`].
    pub(in crate::sim) fn restore_conditions(&mut self, before: SavedConditions) {
        self.hertz = before.hertz;
        self.motion = before.motion;
        self.formulas = before.formulas;
        self.stated_film = before.stated_film;
        self.load = before.load;
        self.shear_thinning = before.shear_thinning;
        self.warm_to(before.bulk_temperature);
        self.flow = before.flow;
    }
}
