//! Contacts that stall from every start: reached from the same contact at other speeds.

use super::{ATTEMPTS, Attempt, THOROUGH, Workspace};
use crate::report::{Status, Work};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;
use crate::reynolds::{ReynoldsError, StoppingRule};

/// Speeds that a way starts from, over that of the problem: thicker films part the solids, without speed the contact is the dry one.
const FIRST_SPEEDS: [f64; 2] = [10.0, 0.1];
/// Ratio of one speed to the next at first; its root is taken where a contact stalls, down to the second number.
const RATIOS: (f64, f64) = (1.5, 1.02);
/// How contacts on the way are solved from the one before.
const FOLLOWING: Attempt = Attempt { trust: 0.03, gentle: false, first_contact_film: 1.0, effort: THOROUGH };

impl Workspace {
    /// The first way that leads to a solution; says whether one does. What the state and the best one hold if none does is that
    /// of another speed.
    pub(super) fn follow_speed(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        work: &mut Work,
    ) -> Result<bool, ReynoldsError> {
        let speed = problem.entrainment_speed;
        let mut arrived = Ok(false);
        for first in FIRST_SPEEDS {
            arrived = self.follow_from(first, speed, problem, state, stop, work);
            if !matches!(arrived, Ok(false)) {
                break;
            }
        }
        problem.entrainment_speed = speed;
        arrived
    }

    /// From `first` times the speed to the speed itself, each contact from the one before.
    fn follow_from(
        &mut self,
        first: f64,
        speed: f64,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
        work: &mut Work,
    ) -> Result<bool, ReynoldsError> {
        problem.entrainment_speed = first * speed;
        state.pressure.fill(0.0);
        if self.attempts(&ATTEMPTS, problem, state, stop, work)? != Status::Converged {
            return Ok(false);
        }
        let mut last = state.clone();
        // Logarithm of the speed over that of the problem.
        let mut way = first.ln();
        let (mut step, least) = (RATIOS.0.ln(), RATIOS.1.ln());
        while way.abs() > 0.0 && step > least {
            let next = way.signum() * (way.abs() - step).max(0.0);
            problem.entrainment_speed = next.exp() * speed;
            match self.attempts(&[FOLLOWING], problem, state, stop, work)? {
                Status::Converged => {
                    way = next;
                    last.clone_from(state);
                }
                Status::MaxIterations => return Ok(false),
                _ => {
                    step *= 0.5;
                    state.clone_from(&last);
                }
            }
        }
        Ok(way.abs() <= 0.0)
    }
}
