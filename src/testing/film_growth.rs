//! The contract of film growth.

use super::{Contract, IDLE, Violation, close, same, surface_states};
use crate::surface_state::SurfaceState;
use crate::tribochem::FilmGrowthLaw;

/// Initial thicknesses relative to the largest one.
const FILLINGS: [f64; 4] = [0.0, 0.3, 0.8, 1.0];
/// Accepted difference between one step and several over the same time, relative to the largest thickness;
/// the accuracy of the default integration.
const SPLIT_TOLERANCE: f64 = 1e-4;

/// Checks `law` against the contract of [`FilmGrowthLaw`]: the largest thickness is positive; a bare surface
/// has no film; rates and states are finite; inactive nodes are frozen; a film stays between zero and the
/// largest thickness; a step of zero length changes nothing; a short step follows the rate; a step may be
/// divided; fields advance like their nodes.
///
/// # Errors
/// The first violation.
///
/// ```
/// use stribeck::testing::film_growth_law;
/// use stribeck::tribochem::Ghanbarzadeh;
/// film_growth_law(&Ghanbarzadeh::azam_2019())?;
/// # Ok::<(), stribeck::testing::Violation>(())
/// ```
pub fn film_growth_law(law: &dyn FilmGrowthLaw) -> Result<(), Violation> {
    let contract = Contract::of(law);
    let largest = law.maximum_thickness();
    contract.require(largest.is_finite() && largest > 0.0, "the largest thickness is positive", || {
        format!("{largest} m")
    })?;
    let bare = law.thickness(&vec![0.0; states_of(law)]);
    contract.require(bare == 0.0, "a bare surface has no film", || format!("{bare} m"))?;
    for at in surface_states() {
        for filling in FILLINGS {
            check_rate(&contract, law, &at, filling * largest)?;
            check_bounds(&contract, law, &at, filling * largest)?;
            check_cuts(&contract, law, &at, filling * largest)?;
        }
        for filling in [0.3, 0.6] {
            check_derivative(&contract, law, &at, filling * largest)?;
        }
    }
    for filling in FILLINGS {
        let start = filling * largest;
        let end = after(law, &IDLE, start, &[1e6]);
        contract.require(
            same(end, law.thickness(&started(law, start))),
            "an inactive node is frozen",
            || format!("{start} m became {end} m"),
        )?;
        for time in [0.0, 1.0, 1e4] {
            check_field(&contract, law, start, time)?;
        }
    }
    Ok(())
}

/// Number of states, at least one.
fn states_of(law: &dyn FilmGrowthLaw) -> usize {
    law.n_states().max(1)
}

/// States of a film of `thickness` \[m\].
fn started(law: &dyn FilmGrowthLaw, thickness: f64) -> Vec<f64> {
    let mut states = vec![0.0; states_of(law)];
    law.start(thickness, &mut states);
    states
}

/// Thickness after `steps` \[s\] from `start`.
fn after(law: &dyn FilmGrowthLaw, at: &SurfaceState, start: f64, steps: &[f64]) -> f64 {
    let mut states = started(law, start);
    for &step in steps {
        law.advance(at, step, &mut states);
    }
    law.thickness(&states)
}

/// Checks that the rate is finite.
fn check_rate(
    contract: &Contract,
    law: &dyn FilmGrowthLaw,
    at: &SurfaceState,
    thickness: f64,
) -> Result<(), Violation> {
    let rate = law.rate(at, thickness);
    contract
        .require(rate.is_finite(), "rates are finite", || format!("{rate} m/s at {thickness} m and {at:?}"))
}

/// Compares the advance of a field of all points by `time` \[s\], with films of `start` \[m\], with that of
/// its nodes.
fn check_field(contract: &Contract, law: &dyn FilmGrowthLaw, start: f64, time: f64) -> Result<(), Violation> {
    let (points, states) = (surface_states(), started(law, start));
    let mut field = states.repeat(points.len());
    law.advance_all(&points, time, &mut field);
    for (at, node) in points.iter().zip(field.chunks_exact(states.len())) {
        let mut single = states.clone();
        law.advance(at, time, &mut single);
        let agree = node.iter().zip(&single).all(|(a, b)| same(*a, *b));
        contract.require(agree, "fields advance like their nodes", || {
            format!("{node:?} and {single:?} after {time} s from {start} m at {at:?}")
        })?;
    }
    Ok(())
}

/// Checks that a film is neither negative nor thicker than the largest thickness.
fn check_bounds(
    contract: &Contract,
    law: &dyn FilmGrowthLaw,
    at: &SurfaceState,
    start: f64,
) -> Result<(), Violation> {
    let largest = law.maximum_thickness();
    let given = law.thickness(&started(law, start));
    contract.require(close(given, start, largest, 1e-9), "a film starts with its thickness", || {
        format!("{start} m became {given} m")
    })?;
    let now = after(law, at, start, &[0.0]);
    contract.require(close(now, given, largest, 1e-15), "a step of zero length changes nothing", || {
        format!("{given} m became {now} m at {at:?}")
    })?;
    for time in [1e-3, 1.0, 60.0, 1e4, 1e9] {
        let mut states = started(law, start);
        law.advance(at, time, &mut states);
        let finite = states.iter().all(|state| state.is_finite());
        contract.require(finite, "states are finite", || {
            format!("{states:?} after {time} s from {start} m at {at:?}")
        })?;
        let end = law.thickness(&states);
        let within = end >= 0.0 && end <= largest * (1.0 + 1e-9);
        contract.require(within, "the film stays between zero and the largest thickness", || {
            format!("{end} m after {time} s from {start} m at {at:?}")
        })?;
    }
    Ok(())
}

/// Compares a step with five unequal parts of it.
fn check_cuts(
    contract: &Contract,
    law: &dyn FilmGrowthLaw,
    at: &SurfaceState,
    start: f64,
) -> Result<(), Violation> {
    for time in [10.0, 1e3, 1e5] {
        let whole = after(law, at, start, &[time]);
        let cut = [0.05, 0.4, 0.1, 0.25, 0.2].map(|share| share * time);
        let parts = after(law, at, start, &cut);
        let same = close(whole, parts, law.maximum_thickness(), SPLIT_TOLERANCE);
        contract.require(same, "a step may be divided", || {
            format!("{whole} m after {time} s from {start} m at once, {parts} m in five steps, at {at:?}")
        })?;
    }
    Ok(())
}

/// Compares the growth in a short step with the rate; short relative to the time scale of the rate.
fn check_derivative(
    contract: &Contract,
    law: &dyn FilmGrowthLaw,
    at: &SurfaceState,
    start: f64,
) -> Result<(), Violation> {
    let largest = law.maximum_thickness();
    let rate = law.rate(at, start);
    let probe = 1e-4 * largest;
    let slope = (law.rate(at, start + probe) - law.rate(at, start - probe)) / (2.0 * probe);
    let fastest = (rate / largest).abs().max(slope.abs());
    if fastest == 0.0 {
        return Ok(());
    }
    let step = 1e-5 / fastest;
    let found = (after(law, at, start, &[step]) - start) / step;
    // Rounding of the thickness over the step, and curvature within it.
    let accepted = 1e-3 * rate.abs() + 1e-15 * largest / step + 1e-4 * fastest * largest;
    contract.require((found - rate).abs() <= accepted, "a short step follows the rate", || {
        format!("{found} m/s over {step} s from {start} m, rate {rate} m/s, at {at:?}")
    })
}
