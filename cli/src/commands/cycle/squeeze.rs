//! The size of the squeeze terms of a cycle.

use stribeck::sim::{CyclePoint, CycleSolution};

/// Squeeze term from which on a quasi-static cycle is warned of.
const LARGE_SQUEEZE: f64 = 0.1;

/// The contact with the largest squeeze term.
pub(super) fn largest_squeeze(solution: &CycleSolution) -> Option<&CyclePoint> {
    let known = solution.points.iter().filter(|point| point.squeeze_ratio.is_some());
    known.max_by(|a, b| a.squeeze_ratio.unwrap_or(0.0).total_cmp(&b.squeeze_ratio.unwrap_or(0.0)))
}

/// The warning of a quasi-static cycle whose films change within the passage of a half-width.
pub(super) fn squeeze_warning(solution: &CycleSolution) -> Option<String> {
    if !solution.quasi_static {
        return None;
    }
    let large =
        solution.points.iter().filter(|point| point.squeeze_ratio.is_none_or(|ratio| ratio > LARGE_SQUEEZE));
    let count = large.count();
    largest_squeeze(solution).filter(|_| count > 0).map(|point| {
        format!(
            "cycle.quasi_static: at {count} of {} rows the squeeze term is above {LARGE_SQUEEZE} of the entrainment, up to {:.2} at {}; \
             without quasi_static the cycle is solved in time",
            solution.points.len(),
            point.squeeze_ratio.unwrap_or(0.0),
            super::place(point)
        )
    })
}
