//! Warnings of the steps of a history.

use crate::lubricant::Lubricant;
use crate::sim::contact::warnings;
use crate::sim::history::body::Body;
use crate::sim::history::record::StepRecord;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::operating_schedule::Conditions;

impl MixedLubricationSim {
    /// Warnings about the first contact.
    pub(in crate::sim) fn warn_of_first(&mut self, record: &StepRecord) {
        let seen = warnings::SolvedContact {
            hertz: &self.contact.hertz,
            dx: self.contact.grid.dx(),
            smooth: record.roughness.composite_rq == 0.0,
            central_film: record.film.central,
            minimum_film: record.film.minimum,
            friction: record.friction.coefficient,
            load_ratio: record.contact.load_ratio,
            temperatures: record.thermal.map(|heat| [heat.film_temperature_max, record.bulk_temperature]),
        };
        self.warnings.extend(warnings::of_contact(&self.scene, &seen, false));
    }

    /// Warnings about physics that the scene leaves out under these conditions and about errors of the mesh, each once a
    /// run.
    pub(in crate::sim) fn warn_of_left_out(&mut self, record: &StepRecord, conditions: Conditions) {
        let point = warnings::OperatingPoint {
            hertz: &self.contact.hertz,
            conditions,
            viscosity: self.contact.lubricant.as_ref().map(Lubricant::viscosity),
            composite_rq: record.roughness.composite_rq,
            largest_pressure: Some(record.pressure.max),
            friction: [record.friction.boundary, record.friction.fluid],
            film: record.film.mean_central,
            load_ratio: record.contact.load_ratio,
            yield_ratio: None,
        };
        let mut found = warnings::left_out(&self.scene, &point);
        let rough = record.roughness.composite_rq > 0.0;
        let is_said = self.warnings.iter().any(|warning| warning.field.starts_with("error_estimate."));
        if let Some(estimate) = record.error_estimate.filter(|_| !is_said) {
            found.extend(warnings::large_errors(&estimate, rough));
        }
        found.retain(|warning| self.warnings.iter().all(|known| known.field != warning.field));
        self.warnings.extend(found);
    }

    /// Warnings about deep wear and about steps that wear too much, each once a run.
    pub(in crate::sim) fn warn_of_wear(&mut self, record: &StepRecord) {
        let is_said =
            |fields: &[&str]| self.warnings.iter().any(|known| fields.contains(&known.field.as_str()));
        let deep = (!is_said(&warnings::DEEP_WEAR))
            .then(|| warnings::deep_wear([record.wear.ball_max, record.wear.disc_max], self.half_width()));
        let long = (!is_said(&[warnings::LONG_STEP])).then(|| {
            let modulus = self.scene.equivalent_modulus().ok()?;
            let depth = self.worn_in_step();
            warnings::long_step(record.time_step, depth, &self.contact.grid, (record.pressure.max, modulus))
        });
        self.warnings.extend(deep.flatten().into_iter().chain(long.flatten()));
    }

    /// Sum of the largest wear of a node of either body in the last step \[m\].
    fn worn_in_step(&self) -> f64 {
        let bodies = self.bodies.iter().zip(&self.backup);
        let largest = |(now, before): (&Body, &Body)| {
            let worn = now.wear().iter().zip(before.wear()).map(|(now, before)| now - before);
            worn.fold(0.0, f64::max)
        };
        bodies.map(largest).sum()
    }
}
