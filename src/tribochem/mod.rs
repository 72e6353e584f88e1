//! Tribochemistry: growth and removal of anti-wear films, and the flash temperature.
//!
//! [`FilmGrowthLaw`] is an open trait: a custom law needs a rate and a largest thickness only.
//!
//! | law | growth | removal |
//! |---|---|---|
//! | [`Ghanbarzadeh`] | first order, temperature dependent | first order in the rubbing time; law of the reference scene |
//! | [`ThermalArrhenius`] | first order, thermally activated | |
//! | [`StressActivated`] | first order, activated by shear or normal stress | |
//! | [`ProportionalRemoval`] | constant rate, activated by shear stress | proportional to the film |
//!
//! [`Activation`] is the condition for the activity of a node. [`Tribofilm`] is the film of a body on the
//! nodes of its own surface. [`FlashTemperature`] is the temperature rise by friction heat. With the feature
//! `fit`, `fit_growth_law` fits the constants of a law to a measured film. The hardness of a film belongs to
//! [`crate::plastic`].

mod activation;
mod barrier;
mod cell_heat;
mod film;
mod first_order;
#[cfg(feature = "fit")]
mod fit;
#[cfg(feature = "fit")]
mod fit_error;
mod flash_temperature;
mod ghanbarzadeh;
#[cfg(feature = "fit")]
mod growth_curve;
mod heat_partition;
mod integrate;
#[cfg(feature = "fit")]
mod measured_film;
#[cfg(feature = "fit")]
mod measured_rows;
mod moving_source;
mod proportional_removal;
mod stress_activated;
mod thermal_arrhenius;

use std::fmt::Debug;

pub use activation::Activation;
pub use barrier::ELECTRON_VOLT;
pub use film::Tribofilm;
#[cfg(feature = "benchmark")]
pub(crate) use fit::thicknesses;
#[cfg(feature = "fit")]
pub use fit::{FittedConstant, GrowthFit, fit_growth_law, fit_growth_law_to};
#[cfg(feature = "fit")]
pub use fit_error::FitError;
pub use flash_temperature::{FlashReport, FlashTemperature, estimate_maximum_rise, estimate_rise_under_flux};
pub use ghanbarzadeh::Ghanbarzadeh;
#[cfg(feature = "fit")]
pub use growth_curve::GrowthCurve;
pub use integrate::integrate_rates;
#[cfg(feature = "fit")]
pub use measured_film::MeasuredFilm;
pub use moving_source::ThermalBody;
pub use proportional_removal::ProportionalRemoval;
pub use stress_activated::StressActivated;
pub use thermal_arrhenius::ThermalArrhenius;

use crate::surface_state::SurfaceState;

/// Growth and removal of a tribofilm at a node.
///
/// A law has [`n_states`](Self::n_states) states per node, all zero on a bare surface. A law whose only state
/// is the thickness implements [`rate`](Self::rate) and [`maximum_thickness`](Self::maximum_thickness); the
/// provided [`advance`](Self::advance) integrates it. A law with its own solution or with more states
/// overrides `advance`, and with it `thickness` and `n_states`.
///
/// Contract: rates are finite and depend on the arguments alone. The film of an inactive node (see
/// [`Activation`]) is frozen. States stay finite. A film that starts within `0..=maximum_thickness` stays
/// there.
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::tribochem::FilmGrowthLaw;
///
/// #[derive(Debug)]
/// struct Saturating;
/// impl FilmGrowthLaw for Saturating {
///     fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
///         if at.in_contact { 1e-3 * (100e-9 - thickness) } else { 0.0 }
///     }
///     fn maximum_thickness(&self) -> f64 {
///         100e-9
///     }
/// }
///
/// let mut states = [0.0];
/// let at = SurfaceState::new(1e9, 353.15).with_solid_pressure(1e9)
///     .with_shear_stress(1e8).with_sliding_speed(0.005).with_in_contact(true);
/// Saturating.advance(&at, 5000.0, &mut states);
/// assert!((states[0] - 100e-9 * (1.0 - (-5.0_f64).exp())).abs() < 1e-18);
/// ```
pub trait FilmGrowthLaw: Debug + Send + Sync {
    /// Net growth rate `dh/dt` \[m/s\] of a film of `thickness` \[m\] without further history, with the
    /// states of [`start`](Self::start); zero at an inactive node.
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64;

    /// Thickness limit of growth \[m\], the reference thickness of hardness and wear.
    fn maximum_thickness(&self) -> f64;

    /// Number of states per node; 1 (the thickness) by default.
    fn n_states(&self) -> usize {
        1
    }

    /// Overwrites `states` (`n_states` values) with those of a film of `thickness` \[m\] without further
    /// history.
    fn start(&self, thickness: f64, states: &mut [f64]) {
        states.fill(0.0);
        if let Some(first) = states.first_mut() {
            *first = thickness;
        }
    }

    /// Non-negative thickness \[m\] of the film with these `states`.
    fn thickness(&self, states: &[f64]) -> f64 {
        states.first().copied().unwrap_or(0.0).max(0.0)
    }

    /// Total growth \[m\] so far, removed or not; `None` for a law of the net thickness alone.
    fn grown(&self, states: &[f64]) -> Option<f64> {
        let _ = states;
        None
    }

    /// Advances `states` (of `n_states` values) by `time_step` \[s\] under constant conditions `at`.
    ///
    /// The default is an adaptive exponential Euler integration of [`rate`](Self::rate). It is exact up to
    /// rounding for rates linear in the thickness, and accurate to about 1e-5 of the largest thickness for
    /// smooth rates. It is stable for any step, bounded in work, and does not cross zero, the largest
    /// thickness or an equilibrium of growth and removal. A rate that is not finite freezes the film.
    fn advance(&self, at: &SurfaceState, time_step: f64, states: &mut [f64]) {
        if let Some(thickness) = states.first_mut() {
            let rate = |thickness: f64| self.rate(at, thickness);
            *thickness = integrate::integrate(rate, self.maximum_thickness(), *thickness, time_step);
        }
    }

    /// Advances the states of all nodes, node-major in `states`, by `time_step` \[s\] under the conditions
    /// `at`, one per node.
    ///
    /// The default calls [`advance`](Self::advance) for each node. It is overridden by laws that process
    /// whole fields, with [`integrate_rates`] as the corresponding default integration. Both must agree.
    fn advance_all(&self, at: &[SurfaceState], time_step: f64, states: &mut [f64]) {
        for (at, states) in at.iter().zip(states.chunks_exact_mut(self.n_states().max(1))) {
            self.advance(at, time_step, states);
        }
    }
}
