//! The size of the squeeze terms of a cycle.

use stribeck::sim::CyclePoint;

use super::solved::Solved;

/// Squeeze term from which on a quasi-static cycle is warned of.
const LARGE_SQUEEZE: f64 = 0.1;

/// The contact with the largest squeeze term.
pub(super) fn largest_squeeze(solution: &Solved) -> Option<&CyclePoint> {
    let known = solution.points.iter().filter(|point| point.squeeze_ratio.is_some());
    known.max_by(|a, b| a.squeeze_ratio.unwrap_or(0.0).total_cmp(&b.squeeze_ratio.unwrap_or(0.0)))
}

/// The warning of a quasi-static cycle whose films change within the passage of a half-width, or that has rows at rest.
pub(super) fn squeeze_warning(solution: &Solved) -> Option<String> {
    if !solution.quasi_static {
        return None;
    }
    let is_at_rest = |point: &CyclePoint| point.ball_speed + point.disc_speed == 0.0;
    let is_large = |point: &CyclePoint| {
        is_at_rest(point) || point.squeeze_ratio.is_some_and(|ratio| ratio > LARGE_SQUEEZE)
    };
    let count = solution.points.iter().filter(|point| is_large(point)).count();
    let largest = match solution.points.iter().find(|point| is_at_rest(point)) {
        Some(point) => format!("without bound at {}, where the entrainment is zero", super::place(point)),
        None => {
            let point = largest_squeeze(solution)?;
            format!("up to {:.2} at {}", point.squeeze_ratio.unwrap_or(0.0), super::place(point))
        }
    };
    (count > 0).then(|| {
        format!(
            "cycle.quasi_static: at {count} of {} rows the squeeze term, which is left out, is above {LARGE_SQUEEZE} of the entrainment, \
             {largest}; without quasi_static the cycle is solved in time",
            solution.points.len()
        )
    })
}
