//! Waves of the film that the flow carries: a correction of the squeeze term that keeps their amplitude.
//!
//! Where pressure moves no oil, the mass `m = theta rho/rho_0 h` of a cell is carried at the entrainment speed `u`,
//! `m(x, t) = m(x - u dt, t - dt)`. Differences in time and upwind faces damp a wave that is carried; a wave of 12 cells would keep
//! a few per cent of its amplitude across a contact.
//!
//! The correction is a flux `c` through each face that is known before the solve (a deferred correction). Let `g(x)` be the
//! wave at the time to come, x in cells, and `nu`, `nu'` the cells that it passes in the coming step and in the last one. The change
//! of the last step is the wave alone, without the film that stands still: `d(x) = g(x + nu) - g(x + nu + nu')`. With the shift operator
//! `exp(a D)`, `D = d/dx`, the backward difference in time is `T(D) g`, and the flux whose differences cancel it is
//! `G = -T / (nu 2 sinh(D/2)) g`. The upwind faces give `exp(-D/2) g` and half a limited slope instead, so that
//!
//! `c = R d - (slope)/2`, `R(D) = (G - exp(-D/2)) / (exp(nu D) - exp((nu + nu') D))`.
//!
//! `R(D)` has no singularity at `D = 0`. Its value on the polynomial through six nodes is the weighted sum that is used here, exact
//! for waves that are polynomials of up to the sixth degree, and for all waves at one cell a step. The slope of the wave at the time to
//! come follows from d in the same way; the limiter is applied to the slope of the whole film, with and without the
//! wave.
//!
//! The six nodes lie upstream of the face, the further the more cells a step passes. By the amplification factors of all
//! waves the scheme is then stable for 0.2 to 2.25 cells a step, also with steps that vary by 30 %.

use crate::error::InputError;
use crate::reynolds::flow::Scheme;

/// Nodes of a weighted sum.
const POINTS: usize = 6;
/// Terms of a power series in `D`: one more for the flux, whose first term cancels.
const TERMS: usize = POINTS + 1;
/// Cells that a step may pass. Outside of this range the amplification factor of some waves is above one.
const CELLS: [f64; 2] = [0.2, 2.25];
/// Largest ratio of successive steps.
const LARGEST_RATIO: f64 = 2.0;

/// Coefficients of a power series in `D`.
type Series = [f64; TERMS];

/// The last two contacts of a history, newest first, and the steps from them to the next one.
///
/// # Examples
///
/// A wave of eight cells that is carried by one cell a step, in first-order time and space. The mass to which the squeeze
/// term refers then contains the wave at its new place, since the upwind flux would shift it by half a cell only:
///
/// ```
/// use std::f64::consts::PI;
/// use stribeck::reynolds::{CarriedWaves, Scheme};
/// let wave = |cells: f64| (0..24).map(|i| 1.0 + 0.1 * (2.0 * PI * (i as f64 - cells) / 8.0).cos()).collect::<Vec<_>>();
/// let (old, last, next) = (wave(0.0), wave(1.0), wave(2.0));
/// let carried = CarriedWaves {
///     masses: [&last, &old],
///     films: [&last, &old],
///     is_full: &[true; 24],
///     cells: [1.0, 1.0],
///     nx: 24,
///     scheme: Scheme::FirstOrder,
///     second_order: false,
/// };
/// let mut previous = last.clone();
/// carried.correct(&mut previous)?;
/// // Implicit upwind: (1 + nu) m_i - nu m_(i-1) = previous.
/// assert!((2.0 * next[12] - next[11] - previous[12]).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct CarriedWaves<'a> {
    /// `theta rho/rho_0 h` of every cell \[m\].
    pub masses: [&'a [f64]; 2],
    /// Films \[m\].
    pub films: [&'a [f64]; 2],
    /// Whether a cell was full of oil under pressure and without solid contact both times. Other cells, and faces with one within their
    /// weighted sums, have no correction.
    pub is_full: &'a [bool],
    /// Cells that the entrainment passes in the coming step and in the last one, in the direction of +x.
    pub cells: [f64; 2],
    /// Cells along x.
    pub nx: usize,
    /// Discretization of the entrainment.
    pub scheme: Scheme,
    /// Whether the squeeze term is of second order in time.
    pub second_order: bool,
}

impl CarriedWaves<'_> {
    /// Adds the correction to the mass `previous` to which the squeeze term refers \[m\]. The sum of the masses changes by no more
    /// than the rounding, and no mass becomes negative. Outside of 0.2 to 2.25 cells a step, and where one step is more than
    /// twice as long as the other, nothing is added.
    ///
    /// # Errors
    /// Fields of different lengths.
    pub fn correct(&self, previous: &mut [f64]) -> Result<(), InputError> {
        for field in self.masses.iter().chain(&self.films) {
            InputError::require_len("carried field", field, previous.len())?;
        }
        let fits =
            self.is_full.len() == previous.len() && self.nx > 0 && previous.len().is_multiple_of(self.nx);
        if !fits {
            let (field, reason) = ("nx".to_owned(), "fields are not rows of this length".to_owned());
            return Err(InputError::Conflict { field, reason });
        }
        let [next, last] = self.cells;
        let is_stable = self.cells.iter().all(|cells| (CELLS[0]..=CELLS[1]).contains(cells));
        if !is_stable || next > LARGEST_RATIO * last || last > LARGEST_RATIO * next {
            return Ok(());
        }
        let weights = Weights::new(self.cells, self.second_order);
        let mut row = Row::new(self.nx);
        for first in (0..previous.len()).step_by(self.nx) {
            row.differences(self, first);
            row.fluxes(self, first, &weights);
            row.apply(&mut previous[first..first + self.nx], weights.scale);
        }
        Ok(())
    }
}

/// Weights of the changes of the last step at the nodes around a face.
struct Weights {
    /// Nodes before the upstream node of the face.
    before: usize,
    /// Flux of the correction without the slope.
    flux: [f64; POINTS],
    /// Difference of the wave between the next node upstream and the upstream node at the time to come.
    next_slope: [f64; POINTS],
    /// The same at the last time.
    last_slope: [f64; POINTS],
    /// Cells that pass a face in the time step of the squeeze term.
    scale: f64,
}

impl Weights {
    fn new([next, last]: [f64; 2], second_order: bool) -> Self {
        let ratio = next / last;
        // Factors of the last two masses in the backward difference.
        let [newest, oldest] =
            if second_order { [1.0 + ratio, ratio * ratio / (1.0 + ratio)] } else { [1.0, 0.0] };
        let scale = if second_order { next * (1.0 + ratio) / (1.0 + 2.0 * ratio) } else { next };
        let change = combined([(1.0, next), (-1.0, next + last)]);
        let in_time = combined([(newest / next, next), (-oldest / next, next + last)]);
        let flux = quotient(&in_time, &combined([(1.0, 0.5), (-1.0, -0.5)]));
        // The first term of the flux is 1, that of the upwind face too.
        let mut beyond = [0.0; TERMS];
        beyond[..TERMS - 1].copy_from_slice(&flux[1..]);
        let upwind = shift(-0.5);
        beyond.iter_mut().zip(&upwind).for_each(|(term, upwind)| *term -= upwind);
        let slope = |place: f64| quotient(&combined([(1.0, place - 0.5), (-1.0, place - 1.5)]), &change);
        // The number of nodes upstream by which all amplification factors are at most one: from 3 to 5, with steps at 1 and 11/6
        // cells.
        let nodes = 2.0 + (1.2 * next + 0.8).floor();
        let places = std::array::from_fn(|node| node as f64 - nodes - 0.5);
        let weights = |series: &Series| weights(series, &places);
        Self {
            before: nodes as usize,
            flux: weights(&quotient(&beyond, &change)),
            next_slope: weights(&slope(0.0)),
            last_slope: weights(&slope(next)),
            scale,
        }
    }

    /// The weighted sum for the face behind node `i`.
    fn sum(&self, weights: &[f64; POINTS], change: &[f64], i: usize) -> f64 {
        weights.iter().zip(&change[i - self.before..]).map(|(weight, change)| weight * change).sum()
    }
}

/// `(exp(a D) - 1) / D`.
fn shift(a: f64) -> Series {
    let mut term = 1.0;
    std::array::from_fn(|power| {
        term *= a / (power + 1) as f64;
        term
    })
}

/// Sum of the factors times their shifts.
fn combined(parts: [(f64, f64); 2]) -> Series {
    let [(one, by), (other, other_by)] = parts;
    let (first, second) = (shift(by), shift(other_by));
    std::array::from_fn(|power| one * first[power] + other * second[power])
}

/// Quotient of two power series.
fn quotient(numerator: &Series, denominator: &Series) -> Series {
    let mut found = [0.0; TERMS];
    for power in 0..TERMS {
        let known: f64 = (0..power).map(|lower| found[lower] * denominator[power - lower]).sum();
        found[power] = (numerator[power] - known) / denominator[0];
    }
    found
}

/// Weights of values at the `places`, so that their sum is the power series in `D` of the polynomial through them, at zero.
fn weights(series: &Series, places: &[f64; POINTS]) -> [f64; POINTS] {
    std::array::from_fn(|node| {
        // Coefficients of Lagrange's polynomial of the node.
        let mut polynomial = [0.0; POINTS];
        polynomial[0] = 1.0;
        for other in (0..POINTS).filter(|other| *other != node) {
            let distance = places[node] - places[other];
            for power in (0..POINTS).rev() {
                let lower = if power > 0 { polynomial[power - 1] } else { 0.0 };
                polynomial[power] = (lower - places[other] * polynomial[power]) / distance;
            }
        }
        let mut factorial = 1.0;
        let mut sum = 0.0;
        for (power, (term, coefficient)) in series.iter().zip(&polynomial).enumerate() {
            factorial *= power.max(1) as f64;
            sum += factorial * term * coefficient;
        }
        sum
    })
}

/// Fields of one row of cells.
struct Row {
    /// Change of the mass in the last step \[m\].
    mass: Vec<f64>,
    /// Change of the film in the last step, times the mass over the film \[m\].
    film: Vec<f64>,
    /// Difference of the film from the next node upstream, times the same \[m\].
    slope: Vec<f64>,
    /// Flux of the correction through the face behind each node \[m\].
    flux: Vec<f64>,
}

impl Row {
    fn new(nx: usize) -> Self {
        let zeros = || vec![0.0; nx];
        Self { mass: zeros(), film: zeros(), slope: zeros(), flux: zeros() }
    }

    /// Changes and slopes of the row that begins at the node `first`.
    fn differences(&mut self, carried: &CarriedWaves<'_>, first: usize) {
        let [mass, mass_before] = carried.masses.map(|mass| &mass[first..first + carried.nx]);
        let [film, film_before] = carried.films.map(|film| &film[first..first + carried.nx]);
        for i in 0..carried.nx {
            let density = if film[i] > 0.0 { mass[i] / film[i] } else { 0.0 };
            self.mass[i] = mass[i] - mass_before[i];
            self.film[i] = density * (film[i] - film_before[i]);
            self.slope[i] = if i == 0 { 0.0 } else { density * (film[i] - film[i - 1]) };
        }
    }

    /// Fluxes of the correction. Those of faces near a cell that is not full are zero.
    fn fluxes(&mut self, carried: &CarriedWaves<'_>, first: usize, weights: &Weights) {
        self.flux.fill(0.0);
        let is_full = &carried.is_full[first..first + carried.nx];
        // Slopes on both sides of the upstream node are needed, those of the next face too.
        let (before, points) = (weights.before, POINTS + 1);
        for i in before..(carried.nx + before).saturating_sub(points) {
            if !is_full[i - before..i - before + points].iter().all(|full| *full) {
                continue;
            }
            let slope = self.wave_slope(carried.scheme, weights, i);
            self.flux[i] = weights.sum(&weights.flux, &self.mass, i) - 0.5 * slope;
        }
    }

    /// The contribution of the wave to the slope that the entrainment adds to the film of node `i` at the time to come.
    fn wave_slope(&self, scheme: Scheme, weights: &Weights, i: usize) -> f64 {
        let of_mass = || weights.sum(&weights.next_slope, &self.mass, i);
        match scheme {
            Scheme::FirstOrder => 0.0,
            Scheme::SecondOrder => of_mass(),
            Scheme::Limited => {
                let at = |node: usize| {
                    let [next, last] = [&weights.next_slope, &weights.last_slope]
                        .map(|weights_of| weights.sum(weights_of, &self.film, node));
                    (self.slope[node] - last, next)
                };
                let ((standing, wave), (standing_ahead, wave_ahead)) = (at(i), at(i + 1));
                let whole = minmod(standing + wave, standing_ahead + wave_ahead);
                whole - minmod(standing, standing_ahead) + of_mass() - wave
            }
        }
    }

    /// Adds the differences of the fluxes, times `scale`, to the mass `previous`. A cell loses at most half of its mass through
    /// each face.
    fn apply(&mut self, previous: &mut [f64], scale: f64) {
        let most = 0.5 / scale;
        for i in 0..previous.len().saturating_sub(1) {
            self.flux[i] = self.flux[i].clamp(-most * previous[i + 1].max(0.0), most * previous[i].max(0.0));
        }
        for (i, mass) in previous.iter_mut().enumerate() {
            let inflow = if i == 0 { 0.0 } else { self.flux[i - 1] };
            *mass -= scale * (self.flux[i] - inflow);
        }
    }
}

/// The smaller of two numbers of one sign, zero if their signs differ.
fn minmod(a: f64, b: f64) -> f64 {
    if a * b <= 0.0 {
        0.0
    } else if a.abs() <= b.abs() {
        a
    } else {
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(cells: f64, length: f64) -> Vec<f64> {
        let place = |i: usize| 2.0 * std::f64::consts::PI * (i as f64 - cells) / length;
        (0..64).map(|i| 1.0 + 0.1 * place(i).cos()).collect()
    }

    /// Residual of the discretized transport of a wave of `length` cells over its amplitude, with equal steps.
    fn residual(length: f64, cells: f64, second_order: bool) -> f64 {
        let at = |step: f64| wave(step * cells, length);
        let (old, last, next) = (at(0.0), at(1.0), at(2.0));
        let scheme = if second_order { Scheme::SecondOrder } else { Scheme::FirstOrder };
        let carried = CarriedWaves {
            masses: [&last, &old],
            films: [&last, &old],
            is_full: &[true; 64],
            cells: [cells; 2],
            nx: 64,
            scheme,
            second_order,
        };
        let combine =
            |(last, old): (&f64, &f64)| if second_order { last + (last - old) / 3.0 } else { *last };
        let mut previous: Vec<f64> = last.iter().zip(&old).map(combine).collect();
        carried.correct(&mut previous).unwrap();
        let face = |i: usize| match scheme {
            Scheme::SecondOrder => 1.5 * next[i] - 0.5 * next[i - 1],
            _ => next[i],
        };
        let scale = if second_order { cells / 1.5 } else { cells };
        (20..44)
            .map(|i| (next[i] + scale * (face(i) - face(i - 1)) - previous[i]).abs() / 0.1)
            .fold(0.0, f64::max)
    }

    #[test]
    fn waves_are_carried_exactly_by_one_cell_a_step() {
        for length in [3.0, 8.0, 20.0] {
            for second_order in [false, true] {
                let found = residual(length, 1.0, second_order);
                assert!(found < 1e-12, "{length} cells, second order {second_order}: {found:e}");
            }
        }
    }

    #[test]
    fn residual_of_a_carried_wave_is_of_sixth_order() {
        for (cells, second_order) in [(0.5, true), (2.0, true), (0.5, false), (1.5, false)] {
            let [long, short] = [32.0, 16.0].map(|length| residual(length, cells, second_order));
            let order = (short / long).log2();
            assert!(
                (6.0..8.5).contains(&order),
                "{cells} cells, {second_order}: {short:e}, {long:e}, {order}"
            );
        }
    }

    #[test]
    fn corrections_conserve_the_sum_and_leave_standing_films() {
        let (old, last) = (wave(0.0, 9.0), wave(1.3, 9.0));
        let mut is_full = [true; 64];
        is_full[30] = false;
        let with = |old: &[f64], last: &[f64]| {
            let cells = [1.3; 2];
            let (masses, films, scheme) = ([last, old], [last, old], Scheme::Limited);
            let carried =
                CarriedWaves { masses, films, is_full: &is_full, cells, nx: 32, scheme, second_order: true };
            let mut previous = last.to_vec();
            carried.correct(&mut previous).unwrap();
            previous
        };
        let corrected = with(&old, &last);
        assert!((corrected.iter().sum::<f64>() - last.iter().sum::<f64>()).abs() < 1e-12);
        assert!(corrected.iter().zip(&last).any(|(a, b)| (a - b).abs() > 1e-3));
        assert!((corrected[30] - last[30]).abs() < 1e-15, "a cell that is not full");
        assert_eq!(with(&last, &last), last);
    }
}
