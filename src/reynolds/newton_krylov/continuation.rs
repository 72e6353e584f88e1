//! Contacts that stall from every start: reached by following the fluid in time as it fills the dry contact.

use super::Workspace;
use super::settings::{Attempt, STEADILY};
use crate::report::Status;
use crate::reynolds::flow::Cavitation;
use crate::reynolds::problem::{LubricatedContact, Squeeze};
use crate::reynolds::state::ContactState;
use crate::reynolds::{ReynoldsError, StoppingRule};
use crate::strategy::Strategy;

/// First time step, over the time in which the fluid passes a cell, and the one after which the steady
/// contact is near; where it is not, it is tried again after steps longer by [`LATER`].
const TIME_STEPS: (f64, f64) = (1.0, 1000.0);
const LATER: f64 = 10.0;
/// Time steps after which the way has led nowhere.
const MAX_TIME_STEPS: usize = 80;
/// The same on a row, whose pockets are closed on all sides and fill slowly.
const MAX_TIME_STEPS_ON_ROW: usize = 400;
/// How each contact on the way is solved from the one before.
const FOLLOWING: Attempt = Attempt { first_contact_film: 1.0, most_steps: 15, ..STEADILY };
/// How the last one is.
const ARRIVING: Attempt = Attempt { most_steps: STEADILY.most_steps, ..FOLLOWING };
/// Residual to which they are solved at first, and its reduction where the contact rests there and the steady
/// one stalls from it.
const ON_THE_WAY: (f64, f64) = (1e-3, 0.1);
/// Growth of the time step after a solve of at most so many Newton steps.
const GROWTH: [(u64, f64); 3] = [(6, 2.0), (9, 1.3), (FOLLOWING.most_steps, 1.15)];
/// Share of the time step that is taken where a solve stalls.
const SHORTER_TIME: f64 = 0.3;

impl Workspace {
    /// Other ways to a contact that stalls from the dry one; says whether one of them leads to a solution. If
    /// not, state and best one are those of some contact on the way.
    ///
    /// Where mass is conserved, the contact with Reynolds' condition comes first: its gaps are full, and
    /// drain from there.
    pub(super) fn take_another_way(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<bool, ReynoldsError> {
        if problem.cavitation == Cavitation::Reynolds {
            self.start_dry(problem, state, FOLLOWING.start_tolerance)?;
            return self.follow_time(problem, state, stop);
        }
        self.strategy = Strategy::FromReynolds;
        problem.cavitation = Cavitation::Reynolds;
        state.pressure.fill(0.0);
        let full = self.solve_full(problem, state, stop);
        problem.cavitation = Cavitation::MassConserving;
        if full? {
            let start = state.clone();
            self.strategy = Strategy::FromReynolds;
            if self.attempts(&[ARRIVING], problem, state, stop)? == Status::Converged {
                return Ok(true);
            }
            state.clone_from(&start);
        } else {
            self.start_dry(problem, state, FOLLOWING.start_tolerance)?;
        }
        self.follow_time(problem, state, stop)
    }

    /// Solves a contact with Reynolds' condition, in time if need be.
    fn solve_full(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<bool, ReynoldsError> {
        match self.all_attempts(problem, state, stop)? {
            Status::Converged => Ok(true),
            Status::MaxIterations => Ok(false),
            _ => {
                self.start_dry(problem, state, FOLLOWING.start_tolerance)?;
                self.follow_time(problem, state, stop)
            }
        }
    }

    /// Follows the fluid in time, from the contact of `state` whose gap is full of it, until it rests; says
    /// whether it comes to rest at a solution. If not, state and best one are those of some time.
    ///
    /// Pockets between solids fill and drain as slowly as their rims let them. Each of these times is a
    /// contact with a squeeze term, which changes little in a short step; what has no solution near by in a
    /// steady contact is passed in time.
    fn follow_time(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<bool, ReynoldsError> {
        self.strategy = Strategy::InTime;
        self.coupled.configure(problem);
        // All gaps are full.
        self.coupled.fluid.set_cavitation(Cavitation::Reynolds);
        self.coupled.evaluate(problem, state)?;
        self.work.convolutions += self.coupled.convolutions;
        let mut last = state.clone();
        let mut carried = state.mass.clone();
        let passing = problem.grid().dx() / problem.entrainment_speed;
        let (mut time_step, mut longest) = (TIME_STEPS.0 * passing, TIME_STEPS.1 * passing);
        let mut on_the_way = StoppingRule { tolerance: ON_THE_WAY.0.max(stop.tolerance), ..*stop };
        let mut rests = false;
        let most = if problem.grid().ny() > 1 { MAX_TIME_STEPS } else { MAX_TIME_STEPS_ON_ROW };
        for _ in 0..most {
            if rests || time_step > longest {
                match self.attempts(&[ARRIVING], problem, state, stop)? {
                    Status::Converged => return Ok(true),
                    Status::MaxIterations => return Ok(false),
                    _ if rests => {
                        on_the_way.tolerance = (ON_THE_WAY.1 * on_the_way.tolerance).max(stop.tolerance);
                    }
                    _ => longest *= LATER,
                }
                state.clone_from(&last);
            }
            let before = self.work.iterations;
            let squeeze = squeeze_since(&last.mass, time_step, problem.squeeze, &mut carried);
            let mut moment = problem.squeezed(squeeze);
            match self.attempts(&[FOLLOWING], &mut moment, state, &on_the_way)? {
                Status::Converged => {
                    last.clone_from(state);
                    let steps = self.work.iterations - before;
                    rests = steps == 0;
                    time_step *=
                        GROWTH.iter().find(|(most, _)| steps <= *most).map_or(1.0, |(_, growth)| *growth);
                }
                Status::MaxIterations => return Ok(false),
                _ => {
                    rests = false;
                    time_step *= SHORTER_TIME;
                    state.clone_from(&last);
                }
            }
        }
        Ok(false)
    }
}

/// The squeeze term of the contact `time_step` after it carried the mass `last`, and its `own` one beside it:
/// both together are one over a shorter step from a mean of what they refer to, which is written to
/// `carried`.
fn squeeze_since<'a>(
    last: &[f64],
    time_step: f64,
    own: Option<Squeeze<'_>>,
    carried: &'a mut [f64],
) -> Squeeze<'a> {
    carried.copy_from_slice(last);
    let Some(own) = own else { return Squeeze { previous_mass: carried, time_step } };
    let share = time_step / (time_step + own.time_step);
    for (carried, mass) in carried.iter_mut().zip(own.previous_mass) {
        *carried += share * (mass - *carried);
    }
    Squeeze { previous_mass: carried, time_step: share * own.time_step }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_squeeze_terms_are_one() {
        let own = Squeeze { previous_mass: &[5e-9], time_step: 3e-3 };
        let (last, time_step, mass) = (2e-9, 1e-3, 4e-9);
        let mut carried = [0.0];
        let alone = squeeze_since(&[last], time_step, None, &mut carried);
        assert_eq!((alone.previous_mass, alone.time_step), (&[last][..], time_step));
        let both = squeeze_since(&[last], time_step, Some(own), &mut carried);
        let rate = |squeeze: Squeeze<'_>| (mass - squeeze.previous_mass[0]) / squeeze.time_step;
        let sum = (mass - last) / time_step + rate(own);
        assert!((rate(both) / sum - 1.0).abs() < 1e-12, "{} and {sum}", rate(both));
    }
}
