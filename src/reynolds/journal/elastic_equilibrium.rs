//! Journal bearings whose surfaces deflect under the pressure of the film.
//!
//! The film is wider by `K p`, with the influence `K` of the bodies. A state is a fixed point of `w -> K p(w)` at one eccentricity, found
//! with Anderson's acceleration. Eccentricities are approached from small ones in steps that leave the film positive.

use faer::Mat;

use super::bearing::{JournalBearing, JournalSolution};
use super::elastic_bore::{ElasticBore, Influence};
use super::load_search::find_load;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{FalsePosition, least_squares};
use crate::reynolds::ReynoldsError;

/// Largest eccentricity; that of an elastic bearing may be above 1.
const MOST_ECCENTRIC: f64 = 5.0;
/// Difference of the widening and that of its pressure, over the least film.
const TOLERANCE: f64 = 3e-4;
/// Relative error of the load of an equilibrium.
const LOAD_TOLERANCE: f64 = 2e-4;
/// Most films of one eccentricity.
const MOST_FILMS: usize = 80;
/// States that the acceleration combines.
const DEPTH: usize = 6;
/// Singular values of the last changes, over the largest one, that count as zero.
const UNDETERMINED: f64 = 1e-8;
/// First eccentricity, and largest step of it.
const FIRST: f64 = 0.3;
const LARGEST_STEP: f64 = 0.1;
/// Share of the least film by which a step may narrow it.
const NARROWING: f64 = 0.4;

/// A bearing whose eccentricity changes in steps.
struct Walk<'a> {
    bearing: &'a JournalBearing<'a>,
    attitude: f64,
    grid: Grid,
    influence: Influence,
    interrupted: &'a dyn Fn() -> bool,
    /// Widening of the current state \[m\].
    widening: Vec<f64>,
    /// Eccentricity of the current state.
    eccentricity: f64,
}

/// Solves at `[eccentricity, attitude]`.
pub(super) fn solve(
    bearing: &JournalBearing<'_>,
    bore: ElasticBore,
    [eccentricity, attitude]: [f64; 2],
    interrupted: &dyn Fn() -> bool,
) -> Result<JournalSolution, ReynoldsError> {
    let mut walk = Walk::new(bearing, bore, attitude, interrupted)?;
    let mut solution = walk.to(eccentricity.min(FIRST))?;
    while walk.eccentricity < eccentricity {
        let next = (walk.eccentricity + walk.step(&solution)).min(eccentricity);
        solution = walk.to(next)?;
    }
    Ok(solution)
}

/// The equilibrium under `[load, attitude]`.
pub(super) fn equilibrium(
    bearing: &JournalBearing<'_>,
    bore: ElasticBore,
    [load, attitude]: [f64; 2],
    interrupted: &dyn Fn() -> bool,
) -> Result<JournalSolution, ReynoldsError> {
    let mut walk = Walk::new(bearing, bore, attitude, interrupted)?;
    let (mut low, mut solution) = ([0.0, -load], walk.to(FIRST)?);
    while solution.load < load {
        // Keep the last eccentricity that carries too little, and go on.
        low = [walk.eccentricity, solution.load - load];
        let next = walk.eccentricity + walk.step(&solution);
        if next > MOST_ECCENTRIC {
            let found = [load, solution.load, walk.eccentricity];
            return Err(bearing.overload(found, "a smaller load, or stiffer bodies").into());
        }
        solution = walk.to(next)?;
    }
    let bracket = FalsePosition::new(low, [walk.eccentricity, solution.load - load], None);
    // The load is about as exact as the widening of the film.
    find_load(bracket, [load, LOAD_TOLERANCE], solution, |eccentricity| walk.to(eccentricity))
}

impl<'a> Walk<'a> {
    fn new(
        bearing: &'a JournalBearing<'a>,
        bore: ElasticBore,
        attitude: f64,
        interrupted: &'a dyn Fn() -> bool,
    ) -> Result<Self, ReynoldsError> {
        bearing.validate()?;
        let grid = bearing.grid(attitude)?;
        let influence = Influence::new(bore, grid)?;
        let widening = vec![0.0; grid.len()];
        Ok(Self { bearing, attitude, grid, influence, interrupted, widening, eccentricity: 0.0 })
    }

    /// The next step of the eccentricity.
    fn step(&self, solution: &JournalSolution) -> f64 {
        (NARROWING * solution.least_film / self.bearing.clearance).min(LARGEST_STEP)
    }

    /// The state at an `eccentricity`, from the current one.
    fn to(&mut self, eccentricity: f64) -> Result<JournalSolution, ReynoldsError> {
        let mut mixing = Anderson::default();
        for _ in 0..MOST_FILMS {
            let solution =
                self.bearing.film_at([eccentricity, self.attitude], &self.widening, self.interrupted)?;
            let target = self.influence.widening(&total_pressure(&solution))?;
            let change: Vec<f64> = target.iter().zip(&self.widening).map(|(to, from)| to - from).collect();
            let largest = change.iter().fold(0.0, |most: f64, change| most.max(change.abs()));
            if largest <= TOLERANCE * solution.least_film {
                self.eccentricity = eccentricity;
                return Ok(solution);
            }
            // Pressures fall with the cube of the film or so.
            let share = 1.0 / (1.0 + 3.0 * largest / solution.least_film);
            let next = mixing.next(&self.widening, &change, share);
            self.widening = self.positive(eccentricity, next, &change, share);
        }
        Err(InputError::Conflict {
            field: "bore".to_owned(),
            reason: format!(
                "the deflection does not settle at an eccentricity of {eccentricity:.4}; a smaller load, stiffer bodies or more cells"
            ),
        }
        .into())
    }

    /// The widening `next`, or one nearer to the current one if it narrows the film by too much.
    fn positive(&self, eccentricity: f64, next: Vec<f64>, change: &[f64], share: f64) -> Vec<f64> {
        let is_open = self.grid.nodes().zip(next.iter().zip(&self.widening)).all(|((x, _), (next, now))| {
            let rigid = self.bearing.gap(eccentricity, x);
            rigid + next > (1.0 - 2.0 * NARROWING) * (rigid + now)
        });
        if is_open {
            return next;
        }
        self.widening.iter().zip(change).map(|(now, change)| now + 0.1 * share * change).collect()
    }
}

/// Pressure of film and asperities \[Pa\].
fn total_pressure(solution: &JournalSolution) -> Vec<f64> {
    let film = &solution.film.pressure;
    match &solution.film.contact {
        None => film.clone(),
        Some(contact) => film.iter().zip(&contact.pressure).map(|(fluid, solid)| fluid + solid).collect(),
    }
}

/// Anderson's acceleration of a fixed-point iteration: the combination of the last states whose changes are least.
#[derive(Default)]
struct Anderson {
    /// Last states and their changes, the newest last.
    states: Vec<[Vec<f64>; 2]>,
}

impl Anderson {
    /// The state after `now` with the `change` of a full step; a plain step takes a `share` of it.
    fn next(&mut self, now: &[f64], change: &[f64], share: f64) -> Vec<f64> {
        if self.states.len() == DEPTH {
            self.states.remove(0);
        }
        let differences: Vec<[Vec<f64>; 2]> = self
            .states
            .iter()
            .map(|[state, past]| {
                let less = |from: &[f64], of: &[f64]| from.iter().zip(of).map(|(a, b)| a - b).collect();
                [less(now, state), less(change, past)]
            })
            .collect();
        self.states.push([now.to_vec(), change.to_vec()]);
        let matrix = Mat::from_fn(change.len(), differences.len(), |i, k| differences[k][1][i]);
        let none = differences.is_empty();
        let weights = if none { None } else { least_squares(&matrix, change, UNDETERMINED) };
        let weights = weights.unwrap_or_else(|| vec![0.0; differences.len()]);
        let mut next: Vec<f64> = now.iter().zip(change).map(|(now, change)| now + share * change).collect();
        for ([state, past], weight) in differences.iter().zip(&weights) {
            for (next, (state, past)) in next.iter_mut().zip(state.iter().zip(past)) {
                *next -= weight * (state + share * past);
            }
        }
        next
    }
}
