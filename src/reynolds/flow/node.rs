//! The fluid at one node.

/// What the balance needs to know of one node; `_p` and `_h` are derivatives by pressure and film.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::reynolds) struct NodeFlow {
    pub(in crate::reynolds) density: f64,
    pub(in crate::reynolds) density_p: f64,
    /// Film that pressure flows through \[m\]: at least half the contact film, zero where that is closed.
    pub(super) film: f64,
    pub(super) film_h: f64,
    /// `h^3 / (12 eta_0)`, for arithmetic means times the slope of the reduced pressure.
    pub(super) mobility: f64,
    pub(super) mobility_p: f64,
    pub(super) mobility_h: f64,
    pub(super) potential: f64,
    pub(super) potential_p: f64,
}
