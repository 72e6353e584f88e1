//! Homotopy from a thick contact film, and Reynolds' condition of cavitation, to those of the problem.

use crate::reynolds::flow::Cavitation;
use crate::reynolds::problem::LubricatedContact;

/// Target values of the homotopy; the present ones are in the solver's copy of the problem.
#[derive(Debug, Clone, Copy)]
pub(super) struct Homotopy {
    film_cutoff: f64,
    cavitation: Cavitation,
}

impl Homotopy {
    /// To the contact film and the cavitation of `problem`.
    pub(super) fn new(problem: &LubricatedContact<'_>) -> Self {
        Self { film_cutoff: problem.film_cutoff, cavitation: problem.cavitation }
    }

    /// Gives `problem` a contact film `ratio` times the target, and Reynolds' condition.
    pub(super) fn start(&self, problem: &mut LubricatedContact<'_>, ratio: f64) {
        problem.film_cutoff = self.film_cutoff * ratio;
        problem.cavitation = Cavitation::Reynolds;
    }

    /// Whether the contact film or the cavitation of `problem` still differs from its target.
    pub(super) fn is_active(&self, problem: &LubricatedContact<'_>) -> bool {
        self.has_raised_cutoff(problem) || self.cavitation != problem.cavitation
    }

    /// Whether the contact film of `problem` is above the target.
    pub(super) fn has_raised_cutoff(&self, problem: &LubricatedContact<'_>) -> bool {
        problem.film_cutoff > self.film_cutoff
    }

    /// Halves the contact film of `problem`, down to the target.
    pub(super) fn advance(&self, problem: &mut LubricatedContact<'_>) {
        problem.film_cutoff = (0.5 * problem.film_cutoff).max(self.film_cutoff);
    }

    /// Gives `problem` the target values.
    pub(super) fn finish(&self, problem: &mut LubricatedContact<'_>) {
        (problem.film_cutoff, problem.cavitation) = (self.film_cutoff, self.cavitation);
    }
}
