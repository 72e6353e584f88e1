//! A passage as one contact: the last one, with the means over the passage in place of its numbers.

use crate::sim::contact::numbers::{
    ContactNumbers, FilmNumbers, FrictionNumbers, Numbers, PressureNumbers, RoughnessNumbers,
};
use crate::sim::contact::solution::ContactSolution;
use crate::sim::error::SimError;
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::record::StepRecord;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::passage::SolvedPassage;

impl SimBuilder {
    /// [`solve`](Self::solve) of a scene whose roughness moves.
    pub(in crate::sim) fn solve_mean_contact(self) -> Result<ContactSolution, SimError> {
        let mut go_on = |_: &MixedLubricationSim, _: &StepRecord| std::ops::ControlFlow::Continue(());
        let SolvedPassage { solution, sim, too_small } = self.begin_passage()?.run(&mut go_on)?;
        if let Some(error) = too_small {
            return Err(error.into());
        }
        let Some(mean) = solution.mean_record() else {
            // A passage has at least one contact.
            return Err(SimError::Interrupted);
        };
        let report = solution.failure.unwrap_or(mean.report);
        let heat = mean.thermal.map(|numbers| (numbers, Vec::new()));
        let gap = sim.placement.gap.clone();
        let StepRecord { film, pressure, contact, friction, roughness, .. } = mean;
        let numbers = Numbers { film, pressure, contact, friction, roughness };
        let mut contact =
            sim.contact.solution((report, heat), sim.state.clone(), gap, Some(&sim.friction), numbers);
        contact.flash_rise = mean.flash_rise;
        contact.warnings.splice(..0, solution.warnings);
        Ok(contact)
    }
}

/// The last of `records` with the means of all in place of its numbers.
pub(super) fn mean_record(records: &[StepRecord]) -> Option<StepRecord> {
    let last = records.last()?;
    let Numbers { film, pressure, contact, friction, .. } = means(records, last.roughness);
    let flash_rise = mean_of_all(records, |record| record.flash_rise);
    Some(StepRecord { film, pressure, contact, friction, flash_rise, ..last.clone() })
}

/// The mean of `value` over `records`; `None` if a record has none.
fn mean_of_all(records: &[StepRecord], value: fn(&StepRecord) -> Option<f64>) -> Option<f64> {
    let sum: Option<f64> = records.iter().map(value).sum();
    sum.filter(|_| !records.is_empty()).map(|sum| sum / records.len() as f64)
}

/// Means of the numbers of `records`, between surfaces of this `roughness`.
fn means(records: &[StepRecord], roughness: RoughnessNumbers) -> Numbers {
    let mean = |value: fn(&StepRecord) -> f64| records.iter().map(value).sum::<f64>() / records.len() as f64;
    let mean_central = mean(|record| record.film.mean_central);
    let minimum = mean(|record| record.film.minimum);
    let first = records.first();
    Numbers {
        film: FilmNumbers {
            central: mean(|record| record.film.central),
            minimum,
            mean_central,
            minimum_gap: mean(|record| record.film.minimum_gap),
            lambda: roughness.lambda(mean_central),
            minimum_lambda: roughness.lambda(minimum),
            formula_ratio: mean_of_all(records, |record| record.film.formula_ratio),
            formula_lambda: first.and_then(|record| record.film.formula_lambda),
            fluid_fraction: mean_of_all(records, |record| record.film.fluid_fraction),
        },
        pressure: PressureNumbers {
            max: mean(|record| record.pressure.max),
            central: mean(|record| record.pressure.central),
            mean: mean(|record| record.pressure.mean),
            load_outside: mean(|record| record.pressure.load_outside),
        },
        contact: ContactNumbers {
            area_ratio: mean(|record| record.contact.area_ratio),
            load_ratio: mean(|record| record.contact.load_ratio),
            area: mean(|record| record.contact.area),
            corrected_area_ratio: mean(|record| record.contact.corrected_area_ratio),
            corrected_area: mean(|record| record.contact.corrected_area),
            plastic_area: mean(|record| record.contact.plastic_area),
            film_cutoff: first.map_or(0.0, |record| record.contact.film_cutoff),
        },
        friction: FrictionNumbers {
            coefficient: mean(|record| record.friction.coefficient),
            boundary: mean(|record| record.friction.boundary),
            fluid: mean(|record| record.friction.fluid),
            power_loss: mean(|record| record.friction.power_loss),
        },
        roughness,
    }
}
