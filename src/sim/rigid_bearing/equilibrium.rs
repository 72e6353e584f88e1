//! Equilibrium of pads under a load.
//!
//! The load of a film falls with its thickness, of an isoviscous oil with the square of it. It is found by false position
//! between logarithms of film and load. The film of a pivoted pad has the same ratio of inlet to outlet at each load, as long as
//! the oil is isoviscous: the outer search is over this ratio, the inner one over the film.

use std::f64::consts::LN_2;

use super::BearingSolution;
use super::pad::Pad;
use crate::error::InputError;
use crate::numerics::FalsePosition;
use crate::report::Status;
use crate::reynolds::MeanRoughness;
use crate::sim::error::SimError;

/// Relative error of the load.
const LOAD_TOLERANCE: f64 = 1e-6;
/// Error of the center of pressure over the length of the pad.
const CENTER_TOLERANCE: f64 = 1e-5;
/// Load of the best shape without side flow, Rayleigh's step, over `eta u L^2 B/h^2` with the film h of its outlet.
const MOST_LOAD: f64 = 0.206;
/// Load of a film over the given one below which its logarithm is that of this ratio.
const LEAST_RATIO: f64 = 1e-3;
/// Part by which a step over the film goes beyond the film that an isoviscous oil would have.
const BEYOND: f64 = 0.05;
/// Least outlet film over the difference of the films within a pad, as that of a journal of the eccentricity 0.99.
const LEAST_FILM: f64 = 0.01;
/// Film over the upper bound above which the motion carries next to nothing.
const THICKEST: f64 = 10.0;
/// Film ratios of pivoted pads, less one.
const RATIOS: [f64; 2] = [0.01, 100.0];
/// Most films of a bracket, of a search over the film and of one over the ratio.
const MOST_STEPS: usize = 60;

/// The film of a pad with a fixed `taper` under `load`.
pub(super) fn fixed(pad: &Pad<'_>, load: f64, taper: f64) -> Result<BearingSolution, SimError> {
    InputError::require_positive("given_film.load", load)?;
    InputError::require_non_negative("given_film.taper", taper)?;
    let (bearing, films) = (pad.bearing, |outlet: f64| [outlet + taper, outlet]);
    if taper == 0.0 && bearing.relief.is_none() && bearing.holes.is_none() && bearing.roughness.is_none() {
        let reason = "parallel smooth surfaces carry no load; a taper above 0, or a pivot".to_owned();
        return Err(InputError::Conflict { field: "given_film.taper = 0".to_owned(), reason }.into());
    }
    let search = Search { pad, load, depth: taper, is_parallel: taper == 0.0, films: &films };
    search.solve(first_film(pad, load))
}

/// The film of a pad under `load` whose center of pressure is at `pivot`.
pub(super) fn pivoted(pad: &Pad<'_>, load: f64, pivot: f64) -> Result<BearingSolution, SimError> {
    InputError::require_positive("given_film.load", load)?;
    let requirement = "above 0 and below the length: the distance of the pivot from the inlet";
    InputError::require(pivot > 0.0 && pivot < pad.length, "given_film.pivot", pivot, requirement)?;
    let mut film = first_film(pad, load);
    let mut at = |ratio: f64| {
        let ratio = 1.0 + ratio.exp();
        let films = |outlet: f64| [ratio * outlet, outlet];
        let solution = Search { pad, load, depth: 0.0, is_parallel: false, films: &films }.solve(film)?;
        film = solution.numbers.outlet_film.unwrap_or(film);
        let center = solution.numbers.pressure_center.unwrap_or(f64::NAN);
        Ok::<_, SimError>((solution, (center - pivot) / pad.length))
    };
    // The center moves towards the outlet as the film narrows more.
    let mut ratio = 0.0_f64;
    let (mut solution, mut ahead) = at(ratio)?;
    while solution.film.report.status == Status::Converged && ahead.abs() > CENTER_TOLERANCE {
        let next = if ahead > 0.0 { ratio - LN_2 } else { ratio + LN_2 };
        if !(RATIOS[0].ln()..RATIOS[1].ln()).contains(&next) {
            return Err(out_of_reach(pivot, &solution).into());
        }
        let (other, other_ahead) = match at(next) {
            Err(SimError::Input(_)) => return Err(out_of_reach(pivot, &solution).into()),
            other => other?,
        };
        if ahead * other_ahead < 0.0 {
            let bracket = FalsePosition::new([ratio, ahead], [next, other_ahead], None);
            let (mut solution, is_found) = bracket.find([CENTER_TOLERANCE, 0.0], MOST_STEPS, at)?;
            solution.film.mark_search(is_found);
            return Ok(solution);
        }
        (ratio, solution, ahead) = (next, other, other_ahead);
    }
    Ok(solution)
}

/// Error for a pivot beyond the center of pressure of the last film.
fn out_of_reach(pivot: f64, last: &BearingSolution) -> InputError {
    let numbers = &last.numbers;
    let [inlet, outlet] =
        [numbers.inlet_film, numbers.outlet_film].map(|film| 1e6 * film.unwrap_or(f64::NAN));
    let center = 1e3 * numbers.pressure_center.unwrap_or(f64::NAN);
    let (change, side) = if center > 1e3 * pivot { ("less", "behind") } else { ("more", "before") };
    InputError::Conflict {
        field: "given_film.pivot".to_owned(),
        reason: format!(
            "{:.4} mm behind the inlet: a film that narrows from {inlet:.4} to {outlet:.4} um has its center of pressure {center:.4} mm behind it, and \
             no film that narrows {change} carries the load; a pivot {side} that, or another load",
            1e3 * pivot
        ),
    }
}

/// An upper bound of the outlet film that carries `load` with an isoviscous oil.
fn first_film(pad: &Pad<'_>, load: f64) -> f64 {
    let viscosity = pad.lubricant.viscosity().viscosity(0.0);
    pad.length * (MOST_LOAD * viscosity * pad.speed * pad.width / load).sqrt()
}

/// The search for the film that carries a load.
struct Search<'a> {
    pad: &'a Pad<'a>,
    /// The load \[N\].
    load: f64,
    /// Difference of the films within the pad \[m\].
    depth: f64,
    /// Whether the films at both ends are the same.
    is_parallel: bool,
    /// Films at inlet and outlet, from that at the outlet.
    films: &'a dyn Fn(f64) -> [f64; 2],
}

impl Search<'_> {
    /// The solution at the logarithm of the thinner film, and the logarithm of its load over the given one.
    fn at(&self, film: f64) -> Result<(BearingSolution, f64), SimError> {
        let solution = self.pad.solve((self.films)(film.exp()))?;
        let excess = (solution.numbers.load / self.load).max(LEAST_RATIO).ln();
        Ok((solution, excess))
    }

    /// The solution that carries the load, searched from an outlet film.
    fn solve(&self, first: f64) -> Result<BearingSolution, SimError> {
        let least = self.least_film();
        let mut position = first.max(least).ln();
        let (mut solution, mut excess) = self.at(position)?;
        for _ in 0..MOST_STEPS {
            if excess.abs() < LOAD_TOLERANCE || solution.film.report.status != Status::Converged {
                return Ok(solution);
            }
            // The thinnest film carries too little, or edges and holes alone carry too much.
            if (excess < 0.0 && position <= least.ln()) || position > (THICKEST * first).ln() {
                break;
            }
            // An isoviscous oil has half of this change; a film of half or twice the thickness at most.
            let step = (0.5 * (1.0 + BEYOND) * excess).clamp(-LN_2, LN_2);
            let next = (position + step).max(least.ln());
            let (other, other_excess) = self.at(next)?;
            if other.film.report.status != Status::Converged {
                break;
            }
            if excess * other_excess < 0.0 {
                let bracket = FalsePosition::new([position, excess], [next, other_excess], None);
                let (mut solution, is_found) =
                    bracket.find([LOAD_TOLERANCE, 0.0], MOST_STEPS, |film| self.at(film))?;
                solution.film.mark_search(is_found);
                return Ok(solution);
            }
            (position, solution, excess) = (next, other, other_excess);
        }
        Err(self.unbalanced(solution.numbers.load, position.exp()).into())
    }

    /// Least film at the thinner end of the pad \[m\].
    fn least_film(&self) -> f64 {
        let smooth = LEAST_FILM * (self.depth + self.pad.relief_depth());
        match self.pad.bearing.composite_rq().map(|rq| MeanRoughness::LEAST_SEPARATION * rq) {
            Some(rough) if smooth > 0.0 => smooth.min(rough),
            Some(rough) => rough,
            None => smooth.max(f64::MIN_POSITIVE),
        }
    }

    /// Error for a load that no film carries, with the load `carried` at the last film.
    fn unbalanced(&self, carried: f64, film: f64) -> InputError {
        let (load, per) = (self.load, if self.pad.is_wide { "/m" } else { "" });
        let reason = if carried > load {
            format!(
                "pressures at edges and holes alone carry {carried:.6} N{per} at a film of {film:.3e} m; a larger load, or lower pressures"
            )
        } else if self.is_parallel {
            format!(
                "the pad carries {carried:.6} N{per} at a film of {film:.3e} m, and thinner films no more: the dimples of parallel surfaces carry little, and \
                 only around a ring (periodic) whose oil cavitates below ambient; a smaller load, a taper above 0, or a pivot"
            )
        } else {
            format!(
                "the pad carries {carried:.6} N{per} at a film of {film:.3e} m; a smaller load, a thicker oil, a higher speed or a smaller taper"
            )
        };
        InputError::Conflict { field: format!("given_film.load = {load} N{per}"), reason }
    }
}
