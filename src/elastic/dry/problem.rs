//! The dry contact problem and the outcome of a solve.

/// Find pressure `p` and approach `delta` with `g = gap + K p - delta` and `0 <= p <= limit` such that
/// `g >= 0` where `p = 0`, `g = 0` where `0 < p < limit`, `g <= 0` where `p = limit`, and the sum of `p`
/// times the cell area equals the load.
///
/// # Examples
///
/// A rigid flat punch:
///
/// ```
/// use stribeck::Grid;
/// use stribeck::elastic::{DryProblem, DrySolver, HalfSpace};
/// let grid = Grid::centred(32, 32, 1e-5, 1e-5)?;
/// let gap: Vec<f64> = grid.nodes().map(|(x, y)| if x.hypot(y) > 1e-4 { 1e-3 } else { 0.0 }).collect();
/// let problem = DryProblem { gap: &gap, load: 10.0, limit: None };
/// let mut pressure = vec![0.0; grid.len()];
/// let mut body = HalfSpace::new(grid, 230e9)?;
/// let outcome = DrySolver::new(grid.len()).solve(&problem, &mut body, &mut pressure, 1e-6, 500)?;
/// // It sinks in by F/(E' a), its modulus being half of E'.
/// assert!((outcome.approach / (10.0 / (230e9 * 1e-4)) - 1.0).abs() < 0.03);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct DryProblem<'a> {
    /// Undeformed gap per node \[m\].
    pub gap: &'a [f64],
    /// Load \[N\].
    pub load: f64,
    /// Pressure limit per node \[Pa\]; `None` for elastic contact.
    pub limit: Option<&'a [f64]>,
}

impl DryProblem<'_> {
    /// Pressure limit of node `k` \[Pa\], infinite without limits.
    pub(super) fn limit_of(&self, k: usize) -> f64 {
        self.limit.map_or(f64::INFINITY, |limit| limit[k])
    }
}

/// The outcome of a dry solve; all values belong to the returned pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct DryOutcome {
    /// Mean absolute gap error on contact nodes plus penetration elsewhere, relative to the pressure-weighted
    /// mean displacement.
    pub gap_error: f64,
    /// Upper bound of the relative energy error: the energy `1/2 p K p + gap p` exceeds its minimum by at
    /// most this share of the elastic energy `1/2 p K p`. The bound is the duality gap of Frank and Wolfe
    /// (1956, Naval Research Logistics Quarterly 3, 95-110): the sum of `p (v - w)` with `v = gap + K p` and
    /// `w` the minimum of `v` over the nodes below their limit; nodes at the limit with `v < w` are left out.
    /// It holds for any pressure, however it was computed.
    pub energy_error: f64,
    /// Approach of the bodies \[m\].
    pub approach: f64,
    /// Elastic convolutions in equivalents of this grid: a convolution on a coarser grid counts by its share
    /// of nodes, a pressure estimate as a quarter.
    pub convolutions: f64,
    /// Active-set passes on this grid.
    pub passes: u64,
    /// Conjugate-gradient steps on this grid.
    pub steps: u64,
    /// Whether `gap_error` reached the tolerance.
    pub converged: bool,
}
