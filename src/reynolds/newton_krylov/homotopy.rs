//! Film homotopy: from thick contact films, and Reynolds' condition, to those of the problem.

use super::settings::NewtonSettings;
use crate::reynolds::flow::Cavitation;
use crate::reynolds::problem::LubricatedContact;

/// Where the way leads, and the condition of cavitation that holds now.
#[derive(Debug, Clone, Copy)]
pub(super) struct Homotopy {
    /// Contact film of the problem \[m\]; the cut-off that the problem carries is the one that holds now.
    pub(super) film_cutoff: f64,
    pub(super) condition: Cavitation,
}

impl Homotopy {
    /// Whether equations other than those of the problem are solved.
    pub(super) fn is_on(&self, problem: &LubricatedContact<'_>) -> bool {
        self.eases_films(problem) || self.condition != problem.cavitation
    }

    /// Whether the contact film is not yet that of the problem.
    pub(super) fn eases_films(&self, problem: &LubricatedContact<'_>) -> bool {
        problem.film_cutoff > self.film_cutoff
    }

    /// Whether `residual` is low enough, with the contact film of the problem, for the condition of the
    /// problem, which then holds: the gaps of the dry contact are empty, and fill layer by layer where mass
    /// is conserved.
    pub(super) fn arrives(
        &mut self,
        problem: &LubricatedContact<'_>,
        residual: f64,
        settings: &NewtonSettings,
    ) -> bool {
        let arrives = !self.eases_films(problem)
            && self.condition != problem.cavitation
            && residual < settings.near_below;
        if arrives {
            self.condition = problem.cavitation;
        }
        arrives
    }

    /// The next contact film, half of the present one.
    pub(super) fn go_on(&self, problem: &mut LubricatedContact<'_>) {
        problem.film_cutoff = (0.5 * problem.film_cutoff).max(self.film_cutoff);
    }
}
