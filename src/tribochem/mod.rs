//! Tribochemistry: growth and removal of anti-wear films, and the flash temperature that drives some of it.
//!
//! [`FilmGrowthLaw`] is an open set: an own law needs a rate and a largest thickness, nothing else.
//!
//! | law | growth | removal |
//! |---|---|---|
//! | [`Ghanbarzadeh`] | first order, by temperature | first order, with the time of rubbing; the law of the reference scene |
//! | [`ThermalArrhenius`] | first order, over an energy barrier | |
//! | [`StressActivated`] | first order, over a barrier that shear or normal stress lowers | |
//! | [`ProportionalRemoval`] | steady, over a barrier that shear stress lowers | in proportion to the film |
//!
//! [`Activation`] is the condition under which a node takes part. [`Tribofilm`] is the film of one body,
//! carried on the nodes of that body's own surface; [`FlashTemperature`] is the temperature rise that
//! friction heat causes. With the feature `fit`, `fit_growth_law` finds the constants of a law from a
//! measured film. The hardness of a film belongs to [`crate::plastic`].

mod activation;
mod barrier;
mod film;
mod first_order;
#[cfg(feature = "fit")]
mod fit;
mod flash_temperature;
mod ghanbarzadeh;
#[cfg(feature = "fit")]
mod growth_curve;
mod heat_partition;
mod integrate;
mod moving_source;
mod proportional_removal;
mod stress_activated;
mod thermal_arrhenius;

use std::fmt::Debug;

pub use activation::Activation;
pub use barrier::ELECTRON_VOLT;
pub use film::Tribofilm;
#[cfg(feature = "fit")]
pub use fit::{FitError, FittedConstant, GrowthFit, fit_growth_law};
pub use flash_temperature::{FlashReport, FlashTemperature, estimate_maximum_rise, estimate_rise_under_flux};
pub use ghanbarzadeh::Ghanbarzadeh;
#[cfg(feature = "fit")]
pub use growth_curve::GrowthCurve;
pub use integrate::integrate_rates;
pub use moving_source::ThermalBody;
pub use proportional_removal::ProportionalRemoval;
pub use stress_activated::StressActivated;
pub use thermal_arrhenius::ThermalArrhenius;

use crate::rubbing::RubbingPoint;

/// How a tribofilm grows and is removed at one node.
///
/// A law keeps [`n_states`](Self::n_states) numbers a node, all zero on a bare surface. A law whose only
/// state is the thickness writes [`rate`](Self::rate) and [`maximum_thickness`](Self::maximum_thickness); the
/// provided [`advance`](Self::advance) integrates it. A law with a solution of its own, or with more states,
/// overrides `advance`, and with it `thickness` and `n_states`.
///
/// Contract: rates are finite and depend on the arguments alone; an inactive node (see [`Activation`]) is
/// frozen, it neither grows nor loses film; states stay finite; a film that starts within
/// `0..=maximum_thickness` stays there.
///
/// ```
/// use stribeck::RubbingPoint;
/// use stribeck::tribochem::FilmGrowthLaw;
///
/// #[derive(Debug)]
/// struct Saturating;
/// impl FilmGrowthLaw for Saturating {
///     fn rate(&self, at: &RubbingPoint, thickness: f64) -> f64 {
///         if at.in_contact { 1e-3 * (100e-9 - thickness) } else { 0.0 }
///     }
///     fn maximum_thickness(&self) -> f64 {
///         100e-9
///     }
/// }
///
/// let mut states = [0.0];
/// let at = RubbingPoint::new(1e9, 353.15).with_solid_pressure(1e9)
///     .with_shear_stress(1e8).with_sliding_speed(0.005).with_in_contact(true);
/// Saturating.advance(&at, 5000.0, &mut states);
/// assert!((states[0] - 100e-9 * (1.0 - (-5.0_f64).exp())).abs() < 1e-18);
/// ```
pub trait FilmGrowthLaw: Debug + Send + Sync {
    /// Net growth rate `dh/dt` \[m/s\] of a film of `thickness` \[m\] without further history, that is with
    /// the states that [`start`](Self::start) gives it; zero at an inactive node.
    fn rate(&self, at: &RubbingPoint, thickness: f64) -> f64;

    /// The thickness \[m\] that growth alone approaches; hardness and wear scale with the film relative to
    /// it.
    fn maximum_thickness(&self) -> f64;

    /// Number of states a node; 1 (the thickness) unless overridden.
    fn n_states(&self) -> usize {
        1
    }

    /// Overwrites `states` (of `n_states` values) with those of a film of `thickness` \[m\] and no further
    /// history.
    fn start(&self, thickness: f64, states: &mut [f64]) {
        states.fill(0.0);
        if let Some(first) = states.first_mut() {
            *first = thickness;
        }
    }

    /// Thickness \[m\], never negative, of the film with these `states`.
    fn thickness(&self, states: &[f64]) -> f64 {
        states.first().copied().unwrap_or(0.0).max(0.0)
    }

    /// Thickness \[m\] grown so far in total, removed or not, where the law can tell; `None` where only the
    /// net thickness is known.
    fn grown(&self, states: &[f64]) -> Option<f64> {
        let _ = states;
        None
    }

    /// Advances `states` (of `n_states` values) by `time_step` \[s\] under constant conditions `at`.
    ///
    /// By default an adaptive exponential Euler integration of [`rate`](Self::rate): exact up to rounding
    /// where the rate is linear in the thickness, to about 1e-5 of the largest thickness where it is smooth;
    /// stable for any step, bounded in work, never across zero, the largest thickness or a balance of growth
    /// and removal. A rate that is not finite freezes the film.
    fn advance(&self, at: &RubbingPoint, time_step: f64, states: &mut [f64]) {
        if let Some(thickness) = states.first_mut() {
            let rate = |thickness: f64| self.rate(at, thickness);
            *thickness = integrate::integrate(rate, self.maximum_thickness(), *thickness, time_step);
        }
    }

    /// Advances the states of all nodes, node-major in `states`, by `time_step` \[s\] under the conditions
    /// `at`, one a node.
    ///
    /// By default node by node with [`advance`](Self::advance); for laws that work on whole fields at once,
    /// whose default integration is [`integrate_rates`]. Both must come to the same.
    fn advance_all(&self, at: &[RubbingPoint], time_step: f64, states: &mut [f64]) {
        for (at, states) in at.iter().zip(states.chunks_exact_mut(self.n_states().max(1))) {
            self.advance(at, time_step, states);
        }
    }
}
