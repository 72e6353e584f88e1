//! What a solve by Newton's method tries, one attempt after the other.

/// Newton steps after which an attempt from the dry contact has stalled: those that converge do so in 10 to 50.
pub(super) const MAX_NEWTON_STEPS: u64 = 60;
/// The same for the attempt whose steps are steps in time for a hundred of them.
const MAX_SLOW_STEPS: u64 = 160;
/// No squeeze.
pub(super) const STEADY: (f64, f64) = (0.0, 0.0);
/// What a solve tries, one after the other while it stalls or diverges, each but the first from the dry contact.
pub(super) const ATTEMPTS: [Attempt; 5] = [
    Attempt {
        trust: 0.03,
        gentle: true,
        first_contact_film: 30.0,
        squeeze: (0.3, 0.85),
        caution: CAREFUL,
        effort: QUICK,
        most_steps: MAX_NEWTON_STEPS,
    },
    Attempt {
        trust: 0.03,
        gentle: true,
        first_contact_film: 10.0,
        squeeze: (0.03, 0.8),
        caution: BOLD,
        effort: THOROUGH,
        most_steps: MAX_NEWTON_STEPS,
    },
    Attempt {
        trust: 0.03,
        gentle: true,
        first_contact_film: 30.0,
        squeeze: (3.0, 0.94),
        caution: CAREFUL,
        effort: QUICK,
        most_steps: MAX_SLOW_STEPS,
    },
    Attempt {
        trust: 0.03,
        gentle: false,
        first_contact_film: 30.0,
        squeeze: STEADY,
        caution: BOLD,
        effort: THOROUGH,
        most_steps: MAX_NEWTON_STEPS,
    },
    Attempt {
        trust: 0.01,
        gentle: false,
        first_contact_film: 100.0,
        squeeze: STEADY,
        caution: BOLD,
        effort: EXACT,
        most_steps: MAX_NEWTON_STEPS,
    },
];
/// What steps whose fluid equations are relaxed by lines try: mostly they take 20 to 60, some that creep up to 180. Where they swing, the
/// slow attempt does not help.
pub(in crate::reynolds) const BY_LINES: [Attempt; 1] = [Attempt { most_steps: 200, ..ATTEMPTS[0] }];
/// Where the residual is low already, single pockets near a fold swing for many steps if they may.
const CAREFUL: Caution = Caution { unforeseen: 0.3, careful_below: 30.0 };
/// Far from the solution the residual has to grow, while plateaus part and close: this reaches contacts that the other does not.
pub(super) const BOLD: Caution = Caution { unforeseen: 0.5, careful_below: 0.0 };
/// Enough for most scenes, and the cheapest.
pub(super) const QUICK: Effort = Effort { start: 0.03, krylov: 0.1 };
/// Where that stalls: errors left at single nodes are as large as the contact film, and starts close to it matter.
pub(super) const THOROUGH: Effort = Effort { start: 1e-7, krylov: 0.01 };
/// What the last attempt makes of scenes whose pockets hold large flows with small differences.
const EXACT: Effort = Effort { start: 1e-7, krylov: 0.001 };

/// How the nonlinear equations are approached.
#[derive(Debug, Clone, Copy)]
pub(in crate::reynolds) struct Attempt {
    /// How far the local equations may take a pressure from where the linear step puts it, in reference pressures.
    pub(super) trust: f64,
    /// Whether large moves are left to the linear steps, which know of all nodes: the start then parts the bodies by the eased
    /// contact film, which is the work of the first step otherwise, and nodes open together (see `Settling`). It saves half of
    /// the steps on fine meshes and a tenth of the convolutions elsewhere; the hardest contacts are reached the other way alone.
    pub(super) gentle: bool,
    /// Contact film of the first step over that of the problem: solids that part early let the fluid find its way.
    pub(super) first_contact_film: f64,
    /// Of the entrainment, and its reduction from one Newton step to the next: steps from the dry contact are steps in time of as
    /// many passages of a cell as the first goes into one, at first. A pocket fills no faster than the fluid gets there, where a
    /// steady step empties and fills it by turns.
    pub(super) squeeze: (f64, f64),
    pub(super) caution: Caution,
    pub(super) effort: Effort,
    /// Newton steps after which it has stalled.
    pub(super) most_steps: u64,
}

/// What a step may do unforeseen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Caution {
    /// Share of the films by which all nodes together may change them as they leave what the linear step foresees. Above it the
    /// trust of the next step is smaller: in smooth, wide contact a thousand nodes that leave it alike open or close the whole of it.
    pub(super) unforeseen: f64,
    /// The residual below which no step may make it grow much (`CAREFUL_JUMP`).
    pub(super) careful_below: f64,
}

/// How well the parts of a solve are solved.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effort {
    /// Gap error of the dry start.
    pub(super) start: f64,
    /// Reduction of the linear residual, rows scaled to pressures, in each Newton step.
    pub(super) krylov: f64,
}
