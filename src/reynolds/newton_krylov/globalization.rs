//! Globalization: how far a Newton step goes, towards which equations, and when the iteration has stalled.

use super::homotopy::Homotopy;
use super::settings::{
    BACKTRACK_AFTER, FINE_GRID, GROWTH, LARGEST_CHANGE, LINEARIZATION_ERROR, NewtonSettings,
};
use crate::reynolds::problem::LubricatedContact;

/// Reduction of the residual that counts as progress.
const PROGRESS: f64 = 0.5;
/// Pseudo-transient term of a step over the time in which the surfaces pass one cell.
const CELL_PASSAGE: f64 = 1.0;

/// Step bound, pseudo-transient term, homotopy and stall window of one run of the iteration.
#[derive(Debug)]
pub(super) struct Globalization {
    homotopy: Homotopy,
    first_contact_film: f64,
    warm_start_threshold: f64,
    /// Whether a step may be halved.
    may_backtrack: bool,
    /// Bound of the pressure change by which a node may leave the prediction, and its largest value \[Pa\].
    step_bound: f64,
    largest_step_bound: f64,
    /// Pseudo-transient term of the next step and its reduction.
    pseudo_transient: (f64, f64),
    /// The residual after the last progress, and the steps since.
    progress_residual: f64,
    steps_since_progress: u64,
    stall_window: u64,
    halvings: u32,
    /// Whether the residual has once not halved in [`BACKTRACK_AFTER`] steps.
    requires_decrease: bool,
}

/// The choices for one step.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepControl {
    /// Whether contact film or cavitation of the problem are those of the homotopy.
    pub(super) is_homotopy: bool,
    /// Pseudo-transient term over the entrainment.
    pub(super) pseudo_transient: f64,
    /// Distance by which a node may leave the prediction \[Pa\].
    pub(super) step_bound: f64,
    /// Residual above which the step is halved.
    pub(super) acceptable: f64,
    /// Halvings at most.
    halvings: u32,
}

impl StepControl {
    /// Shares of the step to be tried in turn.
    pub(super) fn step_lengths(self) -> impl Iterator<Item = f64> {
        (0..=self.halvings).map(|halvings| 0.5_f64.powi(halvings.cast_signed()))
    }
}

impl Globalization {
    /// Towards the contact film and the cavitation that `problem` has now.
    pub(super) fn new(problem: &LubricatedContact<'_>, settings: &NewtonSettings) -> Self {
        let largest_step_bound = settings.step_bound * problem.reference_pressure;
        Self {
            homotopy: Homotopy::new(problem),
            first_contact_film: settings.first_contact_film,
            warm_start_threshold: settings.warm_start_threshold,
            may_backtrack: true,
            step_bound: largest_step_bound,
            largest_step_bound,
            pseudo_transient: settings.pseudo_transient,
            progress_residual: f64::INFINITY,
            steps_since_progress: 0,
            stall_window: settings.stall_window,
            halvings: if problem.grid().len() < FINE_GRID {
                settings.halvings
            } else {
                settings.halvings.min(1)
            },
            requires_decrease: false,
        }
    }

    /// Settings of a warm start: no pseudo-transient term.
    pub(super) fn for_warm_start(&mut self) {
        self.pseudo_transient = (0.0, 0.0);
    }

    /// Sets the pseudo-transient term of the first step and its reduction.
    pub(super) fn set_pseudo_transient(&mut self, pseudo_transient: (f64, f64)) {
        self.pseudo_transient = pseudo_transient;
    }

    /// Settings of continuation from the solution with another contact film: whole steps, as halved ones return
    /// to the same states where a few nodes cavitate and open in turn, and a pseudo-transient term that begins
    /// larger and falls half as fast.
    pub(super) fn for_continuation(&mut self) {
        self.may_backtrack = false;
        self.pseudo_transient = (CELL_PASSAGE, self.pseudo_transient.1.sqrt());
    }

    /// Gives `problem` the first contact film of the homotopy and Reynolds' condition of cavitation.
    pub(super) fn start_homotopy(&self, problem: &mut LubricatedContact<'_>) {
        self.homotopy.start(problem, self.first_contact_film);
    }

    /// Gives `problem` back its contact film and its cavitation.
    pub(super) fn finish_homotopy(&self, problem: &mut LubricatedContact<'_>) {
        self.homotopy.finish(problem);
    }

    /// Whether the equations of `problem` differ from those to be solved.
    pub(super) fn is_homotopy(&self, problem: &LubricatedContact<'_>) -> bool {
        self.homotopy.is_active(problem)
    }

    /// Gives `problem` its own cavitation once the contact film is its own and `residual` is low: the gaps of
    /// the dry contact are empty, and fill layer by layer where mass is conserved. Says whether it did.
    pub(super) fn restore_cavitation(&self, problem: &mut LubricatedContact<'_>, residual: f64) -> bool {
        let is_due = self.homotopy.is_active(problem)
            && !self.homotopy.has_raised_cutoff(problem)
            && residual < self.warm_start_threshold;
        if is_due {
            self.homotopy.finish(problem);
        }
        is_due
    }

    /// Takes the residual of a state. Without a halved residual for long, the step bound is tightened. States
    /// with a raised contact film do not count.
    pub(super) fn update_progress(&mut self, problem: &LubricatedContact<'_>, residual: f64) {
        // Residuals with another contact film do not compare.
        if self.homotopy.has_raised_cutoff(problem) {
            return;
        }
        self.steps_since_progress += 1;
        if residual <= PROGRESS * self.progress_residual {
            (self.progress_residual, self.steps_since_progress) = (residual, 0);
        // Without progress the step bound shrinks, and residuals may no longer grow.
        } else if self.steps_since_progress.is_multiple_of(BACKTRACK_AFTER) {
            self.largest_step_bound *= 0.5;
            self.step_bound = self.step_bound.min(self.largest_step_bound);
            self.requires_decrease = true;
        }
    }

    /// Whether the residual has not halved within the stall window.
    pub(super) fn has_stalled(&self) -> bool {
        self.steps_since_progress >= self.stall_window
    }

    /// Chooses the next step from a state with `residual`, and lowers the contact film of `problem` during
    /// the homotopy.
    pub(super) fn begin_step(&mut self, problem: &mut LubricatedContact<'_>, residual: f64) -> StepControl {
        let is_homotopy = self.homotopy.is_active(problem);
        // A residual with another contact film is no measure of the step.
        let growth = if self.homotopy.has_raised_cutoff(problem) || !self.may_backtrack {
            f64::INFINITY
        } else if self.requires_decrease {
            1.0
        } else {
            GROWTH
        };
        // Next contact film of the homotopy.
        if is_homotopy {
            self.homotopy.advance(problem);
        }
        // The pseudo-transient term vanishes with the residual, and decays from step to step.
        let share = if is_homotopy { 1.0 } else { (residual / self.warm_start_threshold).min(1.0) };
        let pseudo_transient = share * self.pseudo_transient.0;
        self.pseudo_transient.0 *= self.pseudo_transient.1;
        StepControl {
            is_homotopy,
            pseudo_transient,
            step_bound: self.step_bound,
            acceptable: growth * residual,
            halvings: self.halvings,
        }
    }

    /// Length of the step, at most one, under which no pressure changes by more than [`LARGEST_CHANGE`] allows; `largest`
    /// \[Pa\] is the largest change under the full step.
    pub(super) fn capped_step_length(problem: &LubricatedContact<'_>, largest: f64) -> f64 {
        let in_references = LARGEST_CHANGE * problem.reference_half_widths.0 / problem.grid().dx();
        (in_references * problem.reference_pressure / largest).min(1.0)
    }

    /// Adapts the step bound to the linearization error of the last step, by a factor of a half to two.
    pub(super) fn update_step_bound(&mut self, linearization_error: f64) {
        // Towards the step whose linearization error is as large as wanted.
        let change = (LINEARIZATION_ERROR / linearization_error).clamp(0.5, 2.0);
        self.step_bound = (self.step_bound * change).min(self.largest_step_bound);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elastic::HalfSpace;
    use crate::grid::Grid;
    use crate::reynolds::Cavitation;

    /// Runs `check` on a contact of a reference pressure of 1 GPa and a contact film of 1 nm.
    fn with_problem(check: impl FnOnce(&mut LubricatedContact<'_>)) {
        let grid = Grid::centred(8, 8, 1e-6, 1e-6).unwrap();
        let (gap, mut body) = (vec![0.0; grid.len()], HalfSpace::new(grid, 230e9).unwrap());
        check(&mut LubricatedContact::new(&gap, &mut body, 1.0, (4e-6, 4e-6), 1e9));
    }

    #[test]
    fn homotopy_halves_the_contact_film_and_restores_cavitation_at_a_low_residual() {
        with_problem(|problem| {
            let mut globalization = Globalization::new(problem, &NewtonSettings::default());
            globalization.start_homotopy(problem);
            assert!((problem.film_cutoff / 30e-9 - 1.0).abs() < 1e-12);
            for film in [15e-9, 7.5e-9, 3.75e-9, 1.875e-9, 1e-9] {
                assert!(
                    !globalization.restore_cavitation(problem, 1e-9),
                    "the contact film is not the own one"
                );
                let control = globalization.begin_step(problem, 1e9);
                assert!((problem.film_cutoff / film - 1.0).abs() < 1e-12 && control.acceptable.is_infinite());
            }
            assert!(!globalization.restore_cavitation(problem, 101.0) && globalization.is_homotopy(problem));
            assert!(globalization.restore_cavitation(problem, 99.0));
            assert!(problem.cavitation == Cavitation::MassConserving && !globalization.is_homotopy(problem));
        });
    }

    #[test]
    fn step_bound_is_halved_and_growth_excluded_after_five_steps_without_progress() {
        with_problem(|problem| {
            let mut globalization = Globalization::new(problem, &NewtonSettings::default());
            globalization.update_progress(problem, 8.0);
            let control = globalization.begin_step(problem, 8.0);
            assert_eq!((control.step_bound, control.acceptable), (0.03 * 1e9, 16.0));
            for _ in 0..5 {
                globalization.update_progress(problem, 5.0);
            }
            let control = globalization.begin_step(problem, 5.0);
            assert_eq!((control.step_bound, control.acceptable), (0.015 * 1e9, 5.0));
            // A large linearization error halves it again, a small one returns it to its largest value.
            globalization.update_step_bound(9.0);
            assert!((globalization.begin_step(problem, 5.0).step_bound - 7.5e6).abs() < 1.0);
            globalization.update_step_bound(1e-9);
            globalization.update_step_bound(1e-9);
            assert!((globalization.begin_step(problem, 5.0).step_bound - 1.5e7).abs() < 1.0);
        });
    }

    #[test]
    fn iteration_has_stalled_when_the_residual_does_not_halve_within_the_window() {
        with_problem(|problem| {
            let mut globalization = Globalization::new(problem, &NewtonSettings::default());
            for step in 0..=80 {
                assert!(!globalization.has_stalled(), "step {step}");
                globalization.update_progress(problem, 1.0 - 1e-3 * f64::from(step));
            }
            assert!(globalization.has_stalled());
            globalization.update_progress(problem, 0.5);
            assert!(!globalization.has_stalled());
        });
    }

    #[test]
    fn pseudo_transient_term_falls_by_its_reduction_and_with_the_residual() {
        with_problem(|problem| {
            let mut globalization = Globalization::new(problem, &NewtonSettings::default());
            let [far, near] =
                [1e3, 50.0].map(|residual| globalization.begin_step(problem, residual).pseudo_transient);
            assert!((far - 0.3).abs() < 1e-12 && (near - 0.5 * 0.3 * 0.85).abs() < 1e-12, "{far} {near}");
            globalization.for_warm_start();
            assert!(globalization.begin_step(problem, 1e3).pseudo_transient.abs() < f64::MIN_POSITIVE);
        });
    }
}
