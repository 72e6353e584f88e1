//! Wear: rates of height loss, worn depth, and the height balance of surfaces.
//!
//! [`WearLaw`] is an open set. [`Archard`] is the law of the reference scene; [`FrictionalEnergy`] uses the frictional
//! energy. [`WearDepth`] is the worn depth of a body, node by node; [`SurfaceLedger`] combines initial heights, wear,
//! plastic depth and film.

mod archard;
mod depth;
mod duty;
mod frictional_energy;
mod ledger;
mod pressure;

use std::fmt::Debug;

pub use archard::Archard;
pub use depth::WearDepth;
pub use duty::track_duty_factor;
pub use frictional_energy::FrictionalEnergy;
pub use ledger::{SurfaceLedger, Volumes};
pub use pressure::WearPressure;

use crate::surface_state::SurfaceState;

/// The rate at which a body loses height at a node.
///
/// Contract: finite and non-negative for all finite inputs, zero without sliding and without load, not decreasing with
/// sliding speed and load. Only the substrate wears, not the film.
///
/// # Examples
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::wear::WearLaw;
/// /// Wear by solid contact only: `k p_s u_s`, with `k` \[1/Pa\].
/// #[derive(Debug)]
/// struct SolidWear(f64);
/// impl WearLaw for SolidWear {
///     fn depth_rate(&self, at: &SurfaceState, _film_thickness: f64) -> f64 {
///         self.0 * at.solid_pressure * at.sliding_speed
///     }
/// }
/// let at = SurfaceState::new(1e9, 300.0).with_solid_pressure(1e9).with_sliding_speed(0.1);
/// let mut rates = [0.0; 2];
/// SolidWear(1e-18).depth_rates(&[at, at.with_sliding_speed(0.0)], &[0.0; 2], &mut rates);
/// assert!((rates[0] - 1e-10).abs() < 1e-24 && rates[1] == 0.0);
/// ```
pub trait WearLaw: Debug + Send + Sync {
    /// Wear rate \[m/s\] at a node in the state `at` under `film_thickness` \[m\] of tribofilm.
    fn depth_rate(&self, at: &SurfaceState, film_thickness: f64) -> f64;

    /// Overwrites `rates` \[m/s\] with those of all nodes, in the states `at` and under `film_thickness` \[m\], slices of one
    /// length. The default calls [`depth_rate`](Self::depth_rate) for each node, which an override must reproduce.
    fn depth_rates(&self, at: &[SurfaceState], film_thickness: &[f64], rates: &mut [f64]) {
        for (rate, (at, film)) in rates.iter_mut().zip(at.iter().zip(film_thickness)) {
            *rate = self.depth_rate(at, *film);
        }
    }
}
