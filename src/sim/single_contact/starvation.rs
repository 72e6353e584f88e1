//! The film of a starved contact over that of the flooded one.

use crate::Status;
use crate::sim::contact::numbers::StarvationNumbers;
use crate::sim::contact::solution::ContactSolution;
use crate::sim::error::SimError;
use crate::sim::history::builder::SimBuilder;

impl SimBuilder {
    /// The flooded contact of a scene that limits the supply of oil; `None` without a limit, and with custom parts, which
    /// belong to one solve.
    pub(super) fn flooded(&self) -> Option<Self> {
        let mut scene = self.scene.clone();
        let oil = scene.lubricant.as_mut().filter(|oil| oil.supplied_film.is_some())?;
        oil.supplied_film = None;
        if !scene.is_lubricated() || self.custom_part().is_some() {
            return None;
        }
        // The errors of the starved contact are those that matter.
        (scene.solver.accuracy, scene.solver.estimate, scene.stress) = (None, false, None);
        let mut builder = Self::new(scene);
        builder.custom.interrupt = self.custom.interrupt.clone();
        Some(builder)
    }
}

/// The film of `starved` over that of the `flooded` contact; `None` if either is not solved.
pub(super) fn starvation(
    starved: &ContactSolution,
    flooded: SimBuilder,
) -> Result<Option<StarvationNumbers>, SimError> {
    if starved.report.status != Status::Converged {
        return Ok(None);
    }
    let flooded = flooded.solve()?;
    let is_solved = flooded.report.status == Status::Converged;
    Ok(is_solved.then(|| StarvationNumbers {
        flooded_film: flooded.film.central,
        film_ratio: starved.film.central / flooded.film.central,
    }))
}
