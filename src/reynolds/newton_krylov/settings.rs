//! The numbers of Newton's method on the coupled problem.
//!
//! What each is worth is measured by `cargo run --release --example ablation`.

use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::problem::LubricatedContact;

/// How [`NewtonKrylov`](super::NewtonKrylov) goes about a contact.
///
/// The defaults are those of every solve by Newton's method; the semi-system takes others. `cargo run --release
/// --example ablation` switches each off or doubles it in turn and says what that costs.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct NewtonSettings {
    /// The numbers by which a contact is solved from a state that is near, else from the dry contact.
    pub attempt: Attempt,
    /// Ratio of two contact films one after the other below which following has failed; above 1, and from 2 on
    /// nothing is followed. Where the attempt stalls or diverges, the contact film is doubled until it converges,
    /// and that solution is followed to the contact film of the problem: by whole steps of the attempt, whose
    /// pseudo-transient term begins with 1 and falls by the root of its reduction, and by ratios of contact films
    /// that are halved in their logarithm where they fail.
    pub least_film_ratio: f64,
    /// Krylov steps of a linear solve; from 1 to 10 000.
    pub krylov_steps: usize,
    /// What takes the place of [`Attempt::krylov_tolerance`] in a line contact, whose nodes are on one row:
    /// every pocket is closed on all sides there, and what a linear system leaves in one stays in it; between 0
    /// and 1.
    pub krylov_tolerance_on_rows: f64,
    /// Largest pressure change of one step, in reference pressures times the cells in a reference half-width;
    /// above 0. What a node changes of its own film is then the same on all meshes.
    pub largest_change: f64,
    /// The residual below which a state is near the solution: one that is given is taken for a start, the
    /// pseudo-transient term falls in proportion to the residual, and cavitation is that of the problem; above
    /// 0. Near the solution a step in time holds back the approach, and the whole contact with it.
    pub near_below: f64,
    /// How often a step is taken again at half its length at most ([`Attempt::growth`]).
    pub halvings: u32,
    /// After as many steps without a halved residual the largest trust is halved, and steps may not let the
    /// residual grow any more; at least 1. Where two differences of films take turns to limit the film of a
    /// face, whole steps may go to and fro for good.
    pub patience: u64,
    /// What is done about pockets between the steps.
    pub pockets: PocketSettings,
}

/// How the fluid of pockets, whose films their own pressures hardly move, is solved for within each Newton
/// step of a contact that conserves mass: by Newton's method on small windows around the nodes that lack
/// most, all around held (nonlinear elimination). Which of their nodes cavitate is then settled without
/// convolutions.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PocketSettings {
    /// Newton steps in a window at most; 0 leaves pockets to the steps of the whole. No more are taken once the
    /// nodes of the window lack less than what [`share`](Self::share) leaves of all.
    pub steps: u32,
    /// Cells along each side of a window; at least 8.
    pub side: usize,
    /// Share of what all pockets lack that the nodes lack around which windows are laid; between 0 and 1.
    pub share: f64,
    /// Share of the nodes of the grid above which those nodes are too many: what is lacking so widely is
    /// the work of linear steps; between 0 and 1.
    pub most_nodes: f64,
}

/// One attempt of a solve by [`NewtonKrylov`](super::NewtonKrylov).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Attempt {
    /// How far the elimination of a node's own equations may take its pressure from where the linear step
    /// puts it, in reference pressures; above 0.
    pub trust: f64,
    /// Contact film by which the dry start parts the bodies, over that of the problem; at least 1. The first
    /// step has half of it. Solids that part early let the fluid find its way.
    pub first_contact_film: f64,
    /// Pseudo-transient term of the first step over the entrainment, and its reduction from one step to the
    /// next; at least 0, between 0 and 1. A term `s` makes of a step one in time: as long as the surfaces take
    /// to pass `1/s` cells, since a pocket fills no faster than the fluid gets there.
    pub pseudo_transient: (f64, f64),
    /// Share of the films by which all nodes together may change them as they leave what the linear step
    /// foresees; above 0. Above it the trust of the next step is smaller.
    pub unforeseen: f64,
    /// Gap error of the dry start times the cells in a half-width; above 0.
    pub start_tolerance: f64,
    /// Reduction of the linear residual in each Newton step; between 0 and 1.
    pub krylov_tolerance: f64,
    /// Growth of the residual above which a step is taken again at half its length, unless it lowers the contact
    /// film, as the residual then is one of other equations than that before; at least 1. Infinite: steps are
    /// never shortened, which gets out of cycles in which shorter ones are caught, and astray elsewhere.
    pub growth: f64,
    /// Newton steps after which the attempt has stalled unless the residual has halved in them; at least 1.
    pub steps_to_halve: u64,
}

/// The basis of a linear solve holds twice as many vectors.
const MOST_KRYLOV_STEPS: usize = 10_000;
/// Cells along a window that has some that are not held.
const LEAST_SIDE: usize = 8;

/// No pseudo-transient term.
pub(super) const STEADY: (f64, f64) = (0.0, 0.0);

impl Default for Attempt {
    fn default() -> Self {
        Self {
            trust: 0.03,
            first_contact_film: 30.0,
            pseudo_transient: (0.3, 0.85),
            unforeseen: 0.3,
            start_tolerance: 0.18,
            krylov_tolerance: 0.1,
            growth: 2.0,
            steps_to_halve: 80,
        }
    }
}

impl Default for NewtonSettings {
    fn default() -> Self {
        Self {
            attempt: Attempt::default(),
            least_film_ratio: 1.03,
            krylov_steps: 100,
            krylov_tolerance_on_rows: 1e-6,
            largest_change: 0.05,
            near_below: 100.0,
            halvings: 3,
            patience: 5,
            pockets: PocketSettings::default(),
        }
    }
}

impl NewtonSettings {
    /// Largest pressure change of one step in reference pressures.
    pub(super) fn largest_change(&self, problem: &LubricatedContact<'_>) -> f64 {
        self.largest_change * problem.reference_half_widths.0 / problem.grid().dx()
    }

    /// The attempt as it is on `grid`.
    pub(super) fn attempt_on(&self, grid: &Grid) -> Attempt {
        if grid.ny() > 1 {
            return self.attempt;
        }
        Attempt { krylov_tolerance: self.krylov_tolerance_on_rows, ..self.attempt }
    }

    /// Those of steps whose fluid equations are relaxed by lines, `relaxations` in each. Without pockets, which
    /// do not settle between steps that leave as much of the linear residual, and without thicker contact films,
    /// which take eight times the time for a tenth more scenes.
    pub(in crate::reynolds) fn by_lines(relaxations: usize) -> Self {
        Self {
            least_film_ratio: f64::INFINITY,
            pockets: PocketSettings { steps: 0, ..PocketSettings::default() },
            krylov_steps: relaxations,
            krylov_tolerance_on_rows: Attempt::default().krylov_tolerance,
            ..Self::default()
        }
    }

    /// Checks every number against its range.
    ///
    /// # Errors
    ///
    /// [`InputError`] that names the field, as `newton.patience` or `newton.attempt.trust`.
    pub fn validate(&self) -> Result<(), InputError> {
        let ratio = self.least_film_ratio;
        InputError::require(ratio > 1.0, "newton.least_film_ratio", ratio, "above 1")?;
        let steps = self.krylov_steps;
        let in_range = (1..=MOST_KRYLOV_STEPS).contains(&steps);
        InputError::require(in_range, "newton.krylov_steps", steps as f64, "from 1 to 10000")?;
        require_share("newton.krylov_tolerance_on_rows", self.krylov_tolerance_on_rows)?;
        self.attempt.validate("newton.attempt")?;
        require_count("newton.patience", self.patience as f64)?;
        InputError::require_positive("newton.largest_change", self.largest_change)?;
        InputError::require_positive("newton.near_below", self.near_below)?;
        self.pockets.validate()
    }
}

impl Default for PocketSettings {
    fn default() -> Self {
        Self { steps: 4, side: 20, share: 0.9, most_nodes: 0.02 }
    }
}

impl PocketSettings {
    fn validate(&self) -> Result<(), InputError> {
        let side = self.side as f64;
        InputError::require(self.side >= LEAST_SIDE, "newton.pockets.side", side, "at least 8")?;
        require_share("newton.pockets.share", self.share)?;
        require_share("newton.pockets.most_nodes", self.most_nodes)
    }
}

impl Attempt {
    fn validate(&self, at: &str) -> Result<(), InputError> {
        InputError::require_positive(&format!("{at}.trust"), self.trust)?;
        InputError::require(
            self.first_contact_film.is_finite() && self.first_contact_film >= 1.0,
            &format!("{at}.first_contact_film"),
            self.first_contact_film,
            "finite and at least 1",
        )?;
        let (first, reduction) = self.pseudo_transient;
        InputError::require_non_negative(&format!("{at}.pseudo_transient[0]"), first)?;
        InputError::require(
            (0.0..1.0).contains(&reduction),
            &format!("{at}.pseudo_transient[1]"),
            reduction,
            "at least 0 and below 1",
        )?;
        InputError::require_positive(&format!("{at}.unforeseen"), self.unforeseen)?;
        InputError::require_positive(&format!("{at}.start_tolerance"), self.start_tolerance)?;
        require_share(&format!("{at}.krylov_tolerance"), self.krylov_tolerance)?;
        InputError::require(self.growth >= 1.0, &format!("{at}.growth"), self.growth, "at least 1")?;
        require_count(&format!("{at}.steps_to_halve"), self.steps_to_halve as f64)
    }
}

fn require_count(field: &str, count: f64) -> Result<(), InputError> {
    InputError::require(count >= 1.0, field, count, "at least 1")
}

fn require_share(field: &str, share: f64) -> Result<(), InputError> {
    InputError::require(share > 0.0 && share < 1.0, field, share, "above 0 and below 1")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_out_of_range_are_named() {
        assert_eq!(NewtonSettings::default().validate(), Ok(()));
        let field = |change: fn(&mut NewtonSettings)| {
            let mut settings = NewtonSettings::default();
            change(&mut settings);
            match settings.validate() {
                Err(InputError::Value { field, .. }) => field,
                other => format!("{other:?}"),
            }
        };
        assert_eq!(field(|s| s.patience = 0), "newton.patience");
        assert_eq!(field(|s| s.attempt.growth = 0.5), "newton.attempt.growth");
        assert_eq!(field(|s| s.near_below = -1.0), "newton.near_below");
        assert_eq!(field(|s| s.attempt.trust = 0.0), "newton.attempt.trust");
        assert_eq!(field(|s| s.least_film_ratio = 1.0), "newton.least_film_ratio");
        assert_eq!(field(|s| s.largest_change = 0.0), "newton.largest_change");
        assert_eq!(field(|s| s.krylov_tolerance_on_rows = 0.0), "newton.krylov_tolerance_on_rows");
        assert_eq!(field(|s| s.pockets.side = 7), "newton.pockets.side");
        assert_eq!(field(|s| s.pockets.share = 1.5), "newton.pockets.share");
        assert_eq!(field(|s| s.attempt.krylov_tolerance = 1.0), "newton.attempt.krylov_tolerance");
        assert_eq!(field(|s| s.attempt.pseudo_transient.1 = 1.0), "newton.attempt.pseudo_transient[1]");
    }
}
