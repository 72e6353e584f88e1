//! How far a Newton step may go, by what the steps before it have made of the residual.

use super::settings::{Attempt, NewtonSettings};

/// A residual is progress if it is at most this times the last that was.
const PROGRESS: f64 = 0.5;

/// Trust and pseudo-transient term of the next step.
#[derive(Debug)]
pub(super) struct Globalisation {
    pub(super) attempt: Attempt,
    largest_trust: f64,
    /// How far a node may leave the forecast \[Pa\].
    pub(super) trust: f64,
    pseudo_transient: f64,
    /// The last residual that was progress, and the steps since.
    halved: f64,
    since_halved: u64,
    /// Whether these have once been [`NewtonSettings::patience`]: bounds are tightened.
    is_tight: bool,
}

impl Globalisation {
    pub(super) fn new(attempt: Attempt, reference_pressure: f64) -> Self {
        let largest_trust = attempt.trust * reference_pressure;
        Self {
            attempt,
            largest_trust,
            trust: largest_trust,
            pseudo_transient: attempt.pseudo_transient.0,
            halved: f64::INFINITY,
            since_halved: 0,
            is_tight: false,
        }
    }

    /// Takes the residual of a step. Where steps have not halved it for long, the bounds are tightened. Those
    /// that ease films do not count.
    pub(super) fn watch(&mut self, residual: f64, eases_films: bool, settings: &NewtonSettings) {
        if eases_films {
            return;
        }
        self.since_halved += 1;
        if residual <= PROGRESS * self.halved {
            (self.halved, self.since_halved) = (residual, 0);
        } else if self.since_halved.is_multiple_of(settings.patience) {
            self.largest_trust *= 0.5;
            self.trust = self.trust.min(self.largest_trust);
            self.is_tight = true;
        }
    }

    /// Whether the residual has not halved for too many steps.
    pub(super) fn has_stalled(&self) -> bool {
        self.since_halved >= self.attempt.steps_to_halve
    }

    /// The pseudo-transient term of a step, full on the way of the `homotopy`.
    pub(super) fn next_pseudo_transient(
        &mut self,
        residual: f64,
        homotopy: bool,
        settings: &NewtonSettings,
    ) -> f64 {
        let share = if homotopy { 1.0 } else { (residual / settings.near_below).min(1.0) };
        let term = share * self.pseudo_transient;
        self.pseudo_transient *= self.attempt.pseudo_transient.1;
        term
    }

    /// Growth of the residual above which a step is taken again: none once bounds are tightened, any in an
    /// attempt that shortens no steps, and where the step `eases_films`, as the residual then is one of other
    /// equations than that before.
    pub(super) fn growth(&self, eases_films: bool) -> f64 {
        let most = self.attempt.growth;
        if eases_films {
            f64::INFINITY
        } else if self.is_tight && most.is_finite() {
            1.0
        } else {
            most
        }
    }

    /// Adapts the trust to the share of the films that a step did not foresee: at most half or twice the last.
    pub(super) fn adapt(&mut self, unforeseen: f64) {
        let change = (self.attempt.unforeseen / unforeseen).clamp(0.5, 2.0);
        self.trust = (self.trust * change).min(self.largest_trust);
    }
}
