//! Settings of Newton's method: the public ones, and constants with the evidence for them.
//!
//! `cargo run --release -p studies --bin ablation` switches the public ones off, halves or doubles them in turn and prints
//! what that costs; trials of the constants are in `journal/newton.md`.

use crate::error::InputError;

/// Settings of [`NewtonKrylov`](super::NewtonKrylov).
///
/// # Examples
///
/// ```
/// use stribeck::reynolds::{NewtonKrylov, NewtonSettings};
/// let mut settings = NewtonSettings::default();
/// settings.krylov_tolerance = 0.03;
/// assert!(NewtonKrylov::with_settings(settings.clone()).is_ok());
/// settings.step_bound = 0.0;
/// let error = NewtonKrylov::with_settings(settings).unwrap_err();
/// assert_eq!(error.to_string(), "newton.step_bound = 0: must be finite and > 0");
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct NewtonSettings {
    /// Distance by which the elimination of a node's own equations may move its pressure from the prediction of
    /// the linear step, in reference pressures; above 0. Default 0.03.
    pub step_bound: f64,
    /// Reduction of the linear residual in each Newton step; between 0 and 1. Default 0.1. Line contacts take
    /// 1e-6: every isolated region is closed on all sides there, and a linear residual stays in it.
    pub krylov_tolerance: f64,
    /// Contact film by which the dry start separates the bodies, over that of the problem; at least 1. Default
    /// 30. The first step has half of it.
    pub first_contact_film: f64,
    /// Pseudo-transient term of the first step over the entrainment, and its reduction from one step to the
    /// next; at least 0, between 0 and 1. Default (0.3, 0.85). With a term `s` the step is one in pseudo-time,
    /// over the time in which the surfaces pass `1/s` cells.
    pub pseudo_transient: (f64, f64),
    /// Residual below which a given state is a warm start, the pseudo-transient term falls in proportion to the
    /// residual, and the cavitation condition is that of the problem; above 0. Default 100.
    pub warm_start_threshold: f64,
    /// Newton steps after which the iteration has stalled unless the residual has halved in them; at least 1.
    /// Default 80.
    pub stall_window: u64,
    /// Ratio of two successive contact films below which continuation has failed; above 1, and from 2 on there
    /// is no continuation. Default 1.03. Where Newton's method stalls or diverges, the contact film is doubled
    /// until it converges, and that solution is followed back to the contact film of the problem.
    pub least_film_ratio: f64,
    /// Largest number of halvings of a step that raises the residual; at most 50. Default 3. Grids of 65 536 nodes and
    /// more take at most one: the time of the others is not won back there (8 contacts on 256 x 256 cells: 16 %).
    pub halvings: u32,
    /// Krylov steps of a linear solve at most.
    pub(super) krylov_steps: usize,
    /// Reduction of the linear residual in a line contact.
    pub(super) krylov_tolerance_on_rows: f64,
    /// Whether isolated regions are eliminated within each step.
    pub(super) eliminates_regions: bool,
}

impl Default for NewtonSettings {
    fn default() -> Self {
        Self {
            step_bound: 0.03,
            krylov_tolerance: 0.1,
            first_contact_film: 30.0,
            pseudo_transient: (0.3, 0.85),
            warm_start_threshold: 100.0,
            stall_window: 80,
            least_film_ratio: 1.03,
            halvings: 3,
            krylov_steps: KRYLOV_STEPS,
            krylov_tolerance_on_rows: 1e-6,
            eliminates_regions: true,
        }
    }
}

// Linear systems.

/// Krylov steps of a linear solve: 1 to 5 are usual; half as many change nothing on the stability map.
const KRYLOV_STEPS: usize = 100;
/// Directions of a linear solve whose film changes are kept: most solves take no more, and where one does, a
/// convolution is little of it.
pub(super) const KEPT_FILMS: usize = 8;

// Starts.

/// Gap error of the dry start times the cells in a half-width: with larger ones the wrong nodes touch.
pub(super) const START_TOLERANCE: f64 = 0.18;

// Globalization.

/// Largest pressure change of a step, in reference pressures times the cells in a reference half-width: the film
/// change of a node by its own pressure is then the same on all meshes.
pub(super) const LARGEST_CHANGE: f64 = 0.05;
/// Wanted linearization error: films that the state has beyond the prediction, over the films. Values of 0.2 to
/// 0.7 cost the same to 10 %.
pub(super) const LINEARIZATION_ERROR: f64 = 0.3;
/// Growth of the residual above which a step is halved: the residual has to grow while contact areas separate and
/// close; no growth at all costs 40 % more steps.
pub(super) const GROWTH: f64 = 2.0;
/// Steps without a halved residual after which the largest step bound is halved, and steps may no longer raise
/// the residual: whole steps can oscillate where two films take turns to limit that of a face.
pub(super) const BACKTRACK_AFTER: u64 = 5;

// Elimination of nodes.

/// Relative change of pressure and film over a step up to which an open node keeps its predicted state: its own
/// equations would move it by some squares of this. Three quarters of the nodes; the number of steps is the same
/// for 0.001, and 7 % higher for 0.01 (24 contacts).
pub(super) const SETTLED_CHANGE: f64 = 1e-3;

/// Nodes of a grid from which on a step is halved at most once.
pub(super) const FINE_GRID: usize = 1 << 16;

// Isolated regions.

/// Newton steps in a window at most.
pub(super) const REGION_STEPS: u32 = 4;
/// Cells along each side of a window, of which the outer ones are held.
pub(super) const WINDOW_SIDE: usize = 20;
/// Share of the residual of all isolated regions that the nodes hold around which windows are placed, and by
/// which a window reduces its own.
pub(super) const REGION_SHARE: f64 = 0.9;
/// Share of the nodes of the grid above which there are too many of them: a residual that is spread so widely is
/// left to the linear solve.
pub(super) const MOST_REGION_NODES: f64 = 0.02;

impl NewtonSettings {
    /// Settings of steps whose fluid equations are relaxed by lines, `relaxations` in each. Isolated regions do
    /// not converge between steps that leave so much of the linear residual, and continuation takes eight times
    /// the time for a tenth more scenes.
    pub(in crate::reynolds) fn by_lines(relaxations: usize) -> Self {
        let default = Self::default();
        Self {
            least_film_ratio: f64::INFINITY,
            krylov_steps: relaxations,
            krylov_tolerance_on_rows: default.krylov_tolerance,
            eliminates_regions: false,
            ..default
        }
    }

    /// Reduction of the linear residual on a grid of so many rows.
    pub(super) fn linear_tolerance(&self, rows: usize) -> f64 {
        if rows > 1 { self.krylov_tolerance } else { self.krylov_tolerance_on_rows }
    }

    /// Checks every setting against its range.
    ///
    /// # Errors
    ///
    /// [`InputError`] that names the field, as `newton.stall_window`.
    pub fn validate(&self) -> Result<(), InputError> {
        InputError::require_positive("newton.step_bound", self.step_bound)?;
        let tolerance = self.krylov_tolerance;
        let is_share = tolerance > 0.0 && tolerance < 1.0;
        InputError::require(is_share, "newton.krylov_tolerance", tolerance, "above 0 and below 1")?;
        InputError::require(
            self.first_contact_film.is_finite() && self.first_contact_film >= 1.0,
            "newton.first_contact_film",
            self.first_contact_film,
            "finite and at least 1",
        )?;
        let (first, reduction) = self.pseudo_transient;
        InputError::require_non_negative("newton.pseudo_transient[0]", first)?;
        let falls = (0.0..1.0).contains(&reduction);
        InputError::require(falls, "newton.pseudo_transient[1]", reduction, "at least 0 and below 1")?;
        InputError::require_positive("newton.warm_start_threshold", self.warm_start_threshold)?;
        let steps = self.stall_window as f64;
        InputError::require(steps >= 1.0, "newton.stall_window", steps, "at least 1")?;
        let ratio = self.least_film_ratio;
        InputError::require(ratio > 1.0, "newton.least_film_ratio", ratio, "above 1")?;
        let halvings = f64::from(self.halvings);
        InputError::require(halvings <= 50.0, "newton.halvings", halvings, "at most 50")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_out_of_range_are_refused_by_name() {
        assert_eq!(NewtonSettings::default().validate(), Ok(()));
        let field = |change: fn(&mut NewtonSettings)| {
            let mut settings = NewtonSettings::default();
            change(&mut settings);
            match settings.validate() {
                Err(InputError::Value { field, .. }) => field,
                other => format!("{other:?}"),
            }
        };
        assert_eq!(field(|s| s.step_bound = 0.0), "newton.step_bound");
        assert_eq!(field(|s| s.krylov_tolerance = 1.0), "newton.krylov_tolerance");
        assert_eq!(field(|s| s.first_contact_film = 0.5), "newton.first_contact_film");
        assert_eq!(field(|s| s.pseudo_transient.0 = -1.0), "newton.pseudo_transient[0]");
        assert_eq!(field(|s| s.pseudo_transient.1 = 1.0), "newton.pseudo_transient[1]");
        assert_eq!(field(|s| s.warm_start_threshold = -1.0), "newton.warm_start_threshold");
        assert_eq!(field(|s| s.stall_window = 0), "newton.stall_window");
        assert_eq!(field(|s| s.least_film_ratio = 1.0), "newton.least_film_ratio");
        assert_eq!(field(|s| s.halvings = 51), "newton.halvings");
    }
}
