//! Search for the eccentricity at which a bearing carries its load.

use super::bearing::JournalSolution;
use crate::numerics::FalsePosition;
use crate::reynolds::ReynoldsError;

/// Most eccentricities of a search.
const MOST_SOLVES: usize = 60;

/// The solution in `bracket` whose load is `load` within the relative `tolerance`, from a `first` solution at one of its ends;
/// `solve` solves at an eccentricity. A solution of another load is not converged.
pub(super) fn find_load(
    bracket: FalsePosition,
    [load, tolerance]: [f64; 2],
    first: JournalSolution,
    mut solve: impl FnMut(f64) -> Result<JournalSolution, ReynoldsError>,
) -> Result<JournalSolution, ReynoldsError> {
    if (first.load / load - 1.0).abs() < tolerance {
        return Ok(first);
    }
    let evaluate = |eccentricity| {
        let solution = solve(eccentricity)?;
        let excess = solution.load - load;
        Ok::<_, ReynoldsError>((solution, excess))
    };
    let (mut solution, is_found) = bracket.find([tolerance * load, 0.01], MOST_SOLVES, evaluate)?;
    solution.film.mark_search(is_found);
    Ok(solution)
}
