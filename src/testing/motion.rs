//! The contract of roughness motion.

use super::{Contract, Violation};
use crate::grid::Grid;
use crate::surface::{Offset, PointRevisit, RoughnessMotion};

/// Speeds \[m/s\] of the check.
const SPEEDS: [f64; 5] = [0.0, 0.1, -0.1, 1e-6, 50.0];
/// Times \[s\].
const TIMES: [f64; 4] = [0.0, 1e-5, 10.0, 7200.0];
/// Indices of solves.
const DRAWS: [u64; 7] = [0, 1, 2, 3, 100, 5041, u64::MAX];

/// Checks `motion` against the contract of [`RoughnessMotion`]: fractions are from 0 to 1; offsets depend on
/// the arguments alone; a fixed body keeps its offset; a body that moves along its track keeps its row.
///
/// # Errors
/// The first violation.
///
/// ```
/// stribeck::testing::roughness_motion(&stribeck::surface::AlongTrack { seed: 4 })?;
/// # Ok::<(), stribeck::testing::Violation>(())
/// ```
pub fn roughness_motion(motion: &dyn RoughnessMotion) -> Result<(), Violation> {
    let contract = Contract::of(motion);
    for (nx, ny) in [(64, 48), (33, 1), (5, 5)] {
        let grid = Grid::centred(nx, ny, 2e-6, 3e-6)
            .map_err(|error| contract.broken("the grid of the check can be made", error.to_string()))?;
        for body in [0, 1] {
            for speed in SPEEDS {
                check(&contract, motion, body, speed, &grid)?;
            }
        }
    }
    Ok(())
}

/// Checks all times and draws of one body at one speed.
fn check(
    contract: &Contract,
    motion: &dyn RoughnessMotion,
    body: usize,
    speed: f64,
    grid: &Grid,
) -> Result<(), Violation> {
    let first = motion.offset(body, 0, 0.0, speed, grid);
    for time in TIMES {
        for draw in DRAWS {
            let offset = motion.offset(body, draw, time, speed, grid);
            let place = || format!("{offset:?} of body {body} at solve {draw}, {time} s and {speed} m/s");
            contract.require(offset.validate().is_ok(), "fractions are numbers from 0 to 1", place)?;
            let again = motion.offset(body, draw, time, speed, grid);
            contract.require(again == offset, "offsets depend on the arguments alone", place)?;
            check_visits(contract, motion.visits(speed), [first, offset], grid, &place)?;
        }
    }
    Ok(())
}

/// Checks that `offset` differs from the `first` one only as far as the type of motion permits.
fn check_visits(
    contract: &Contract,
    visits: PointRevisit,
    [first, offset]: [Offset; 2],
    grid: &Grid,
    place: &impl Fn() -> String,
) -> Result<(), Violation> {
    let row = |offset: Offset| offset.rows % grid.ny();
    match visits {
        PointRevisit::Permanent => {
            contract.require(offset == first, "a body that stays keeps its offset", place)
        }
        PointRevisit::Passing | PointRevisit::Track => contract.require(
            row(offset) == row(first),
            "a body that moves along its track keeps its row",
            place,
        ),
        PointRevisit::Patch => Ok(()),
    }
}
