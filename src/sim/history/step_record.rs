//! The record of a step: its numbers from contact, friction and bodies.

use crate::sim::contact::film_heat::Solved;
use crate::sim::contact::numbers::{DepthNumbers, Numbers, PlasticNumbers, WearNumbers};
use crate::sim::error::SimError;
use crate::sim::history::body::Body;
use crate::sim::history::record::StepRecord;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::operating_schedule::Conditions;

impl MixedLubricationSim {
    /// The record of the step of length `time_step` just taken, whose contact was solved under `conditions` on
    /// surfaces of roughness `rq`.
    pub(in crate::sim) fn record(
        &self,
        ((report, heat), attempts): (Solved, u32),
        flash_rise: Option<f64>,
        (conditions, rq): (Conditions, [f64; 2]),
        time_step: f64,
    ) -> Result<StepRecord, SimError> {
        let limit = self.laws.plasticity.is_some().then_some(self.yielding.limit.as_slice());
        let numbers = Numbers::of(&self.contact, &self.state, Some(&self.friction), limit, rq)?;
        let depths = |field: fn(&Body) -> &[f64]| {
            DepthNumbers::of(self.bodies.each_ref().map(field), |values| self.mean_on_track(values))
        };
        let [ball, disc] = self.bodies.each_ref().map(|body| body.volumes(self.contact.grid.cell_area()));
        let length = self.contact.grid.contact_length();
        let volume = (ball?.plastic + disc?.plastic) / length;
        let worn_volumes = self.bodies.each_ref().map(|body| body.worn_volume() / length);
        Ok(StepRecord {
            step: self.step,
            time: self.time + time_step,
            time_step,
            load: conditions.load,
            motion: conditions.motion,
            bulk_temperature: conditions.bulk_temperature,
            roughness: numbers.roughness,
            film: numbers.film,
            pressure: numbers.pressure,
            contact: numbers.contact,
            friction: numbers.friction,
            flow: self.contact.flow,
            thermal: heat.map(|(numbers, _)| numbers),
            flash_rise,
            wear: WearNumbers::of(
                depths(Body::wear)?,
                worn_volumes,
                self.scars(conditions.motion.surface_speeds()),
            ),
            tribofilm: depths(Body::tribofilm)?,
            plastic: PlasticNumbers { volume },
            error_estimate: None,
            attempts,
            report,
        })
    }
}
