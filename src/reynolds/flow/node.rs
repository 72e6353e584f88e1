//! The fluid at one node.
//!
//! Computed once per node and evaluation, used by its four faces.

/// Fluid quantities of one node; `_p` and `_h` are derivatives by pressure and film.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::reynolds) struct NodeFlow {
    /// `rho/rho_0`.
    pub(in crate::reynolds) density: f64,
    /// Its derivative \[1/Pa\].
    pub(in crate::reynolds) density_p: f64,
    /// Film in the mobility \[m\]: at least half the contact film, zero if closed.
    pub(super) film: f64,
    /// Its derivative by the film.
    pub(super) film_h: f64,
    /// `h^3 / (12 eta_0)`, for arithmetic means times the slope of the reduced pressure.
    pub(super) mobility: f64,
    /// Its derivative by pressure.
    pub(super) mobility_p: f64,
    /// Its derivative by the film.
    pub(super) mobility_h: f64,
    /// Potential of the pressure flow \[Pa\]: the reduced pressure, or the pressure for arithmetic means.
    pub(super) potential: f64,
    /// Its derivative.
    pub(super) potential_p: f64,
}
