//! Search for the eccentricity at which a bearing carries its load.

use super::bearing::JournalSolution;
use crate::numerics::FalsePosition;
use crate::report::Status;
use crate::reynolds::ReynoldsError;

/// Most eccentricities of a search.
const MOST_SOLVES: usize = 60;

/// The solution in `bracket` whose load is `load` within the relative `tolerance`, from a `solution` at one of its ends;
/// `solve` solves at an eccentricity. A solution of another load is not converged.
pub(super) fn find_load(
    mut bracket: FalsePosition,
    [load, tolerance]: [f64; 2],
    mut solution: JournalSolution,
    mut solve: impl FnMut(f64) -> Result<JournalSolution, ReynoldsError>,
) -> Result<JournalSolution, ReynoldsError> {
    for _ in 0..MOST_SOLVES {
        if (solution.load / load - 1.0).abs() < tolerance {
            return Ok(solution);
        }
        let eccentricity = bracket.next(0.01);
        solution = solve(eccentricity)?;
        bracket.add(eccentricity, solution.load - load);
    }
    if solution.film.report.status == Status::Converged {
        solution.film.report.status = Status::MaxIterations;
    }
    Ok(solution)
}
