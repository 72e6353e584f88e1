//! Film homotopy: from thick contact films, and Reynolds' condition, to those of the problem.
//!
//! What holds now is in the solver's copy of the problem, where the way leads in [`Homotopy`].

use super::settings::NewtonSettings;
use crate::reynolds::flow::Cavitation;
use crate::reynolds::problem::LubricatedContact;

/// Contact film and condition of cavitation that the way leads to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Homotopy {
    film_cutoff: f64,
    cavitation: Cavitation,
}

impl Homotopy {
    /// To those of `problem`.
    pub(super) fn to(problem: &LubricatedContact<'_>) -> Self {
        Self { film_cutoff: problem.film_cutoff, cavitation: problem.cavitation }
    }

    /// Gives `problem` those that the way leads to.
    pub(super) fn end(&self, problem: &mut LubricatedContact<'_>) {
        (problem.film_cutoff, problem.cavitation) = (self.film_cutoff, self.cavitation);
    }

    /// Whether equations other than those at the end are solved.
    pub(super) fn is_on(&self, problem: &LubricatedContact<'_>) -> bool {
        self.eases_films(problem) || self.cavitation != problem.cavitation
    }

    /// Whether the contact film is not yet the last one.
    pub(super) fn eases_films(&self, problem: &LubricatedContact<'_>) -> bool {
        problem.film_cutoff > self.film_cutoff
    }

    /// Whether `residual` is low enough, with the last contact film, for the last condition of cavitation: the
    /// gaps of the dry contact are empty, and fill layer by layer where mass is conserved.
    pub(super) fn may_end(
        &self,
        problem: &LubricatedContact<'_>,
        residual: f64,
        settings: &NewtonSettings,
    ) -> bool {
        !self.eases_films(problem) && self.cavitation != problem.cavitation && residual < settings.near_below
    }

    /// The next contact film, half of the present one.
    pub(super) fn go_on(&self, problem: &mut LubricatedContact<'_>) {
        problem.film_cutoff = (0.5 * problem.film_cutoff).max(self.film_cutoff);
    }
}
