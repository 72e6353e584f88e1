//! Newton's method on pressure and film fraction, from coarse grids to the given one.
//!
//! The sides are halved down to about 12 nodes, and each grid starts from the solution of the next coarser
//! one. One step solves the linear system for all cells, updates the unknowns, and sweeps along the flow.
//! After an increase of the residual, the sum of all absolute imbalances, steps are shorter until one leads to a new
//! smallest residual. Convergence: a residual of `GivenFilm::imbalance` of the inflow, or of the rounding error.

use super::GivenFilm;
use super::balance::{Balance, BoundaryFlux};
use super::film::FilmThickness;
use super::linear::LinearSolver;
use crate::numerics::STENCIL;
use crate::report::Status;

/// Number of nodes along a side below which it is not halved.
const COARSEST: usize = 12;
/// Residual over the inflow at which a coarser grid is converged: its cells err by more.
const COARSE_TOLERANCE: f64 = 1e-2;

/// Sweeps after each step.
const SWEEPS: usize = 3;
/// Smallest step length.
const SHORTEST: f64 = 0.125;

/// Result of Newton's method on one grid.
#[derive(Debug)]
pub(super) struct Solved<'a> {
    /// The balances of the grid.
    pub(super) balance: Balance<'a>,
    /// Pressure or film fraction of each cell in one unknown (see `balance`).
    pub(super) unknowns: Vec<f64>,
    /// Status at the end.
    pub(super) status: Status,
    /// Sum of the absolute imbalances of all cells over the inflow.
    pub(super) residual: f64,
    /// Flow through the edges.
    pub(super) boundary_flux: BoundaryFlux,
    /// Newton steps on this grid.
    pub(super) steps: u64,
    /// Solves with a factorised matrix.
    pub(super) substitutions: u64,
    /// Newton steps on all coarser grids together.
    pub(super) coarse_steps: u64,
}

/// Solution of a coarser grid, the start of the next finer one.
struct Start {
    /// Film on the coarser grid.
    film: FilmThickness,
    /// Pressures there \[Pa\].
    pressure: Vec<f64>,
    /// Film fractions there.
    theta: Vec<f64>,
    /// Newton steps on this and all coarser grids.
    steps: u64,
}

/// Solves `problem` with the film `film`, entrained at `speed` along +x, 0 or more; `None` if `interrupted`.
pub(super) fn solve<'a>(
    problem: &GivenFilm<'a>,
    film: &'a FilmThickness,
    speed: f64,
    interrupted: &dyn Fn() -> bool,
) -> Option<Solved<'a>> {
    let mut films = Vec::new();
    while let Some(coarser) = films.last().unwrap_or(film).coarser(COARSEST) {
        films.push(coarser);
    }
    let mut start = None;
    while let Some(film) = films.pop() {
        let solved = on_grid(problem, &film, speed, (start.as_ref(), COARSE_TOLERANCE), interrupted)?;
        let pressure = (0..).zip(&solved.unknowns).map(|(k, &s)| solved.balance.pressure(k, s)).collect();
        let theta = solved.unknowns.iter().map(|&s| 1.0 + s.min(0.0)).collect();
        let steps = solved.steps + solved.coarse_steps;
        drop(solved);
        start = Some(Start { film, pressure, theta, steps });
    }
    on_grid(problem, film, speed, (start.as_ref(), problem.imbalance), interrupted)
}

/// Length of the Newton steps on one grid.
struct StepLength {
    /// Share of the whole step.
    share: f64,
    /// Residual before the last step.
    last: f64,
}

impl StepLength {
    /// Length of the step from a state with this residual. Steps that oscillate between sets of cavitated cells are
    /// shortened, until they lead to a new best state.
    fn after(&mut self, residual: f64, is_best: bool) -> f64 {
        if is_best {
            self.share = 1.0_f64.min(2.0 * self.share);
        } else if residual >= self.last {
            self.share = SHORTEST.max(0.5 * self.share);
        }
        self.last = residual;
        self.share
    }
}

/// Propagates film fractions along the flow, in sweeps over the `rows` in both orders.
fn propagate(balance: &mut Balance<'_>, unknowns: &mut [f64], rows: usize) {
    balance.update(unknowns);
    for sweep in 0..SWEEPS {
        if sweep % 2 == 0 {
            balance.sweep(unknowns, 0..rows);
        } else {
            balance.sweep(unknowns, (0..rows).rev());
        }
    }
}

/// Newton's method on one grid, to a tolerance; `None` if `interrupted`.
///
/// After each step, sweeps over the cells along the flow propagate the film fractions through the cavitated
/// cells. The linear system cannot do this, because it keeps the set of cavitated cells fixed. Without
/// sweeps, fronts move by only a few cells per step.
fn on_grid<'a>(
    problem: &GivenFilm<'a>,
    film: &'a FilmThickness,
    speed: f64,
    (start, tolerance): (Option<&Start>, f64),
    interrupted: &dyn Fn() -> bool,
) -> Option<Solved<'a>> {
    let grid = film.grid();
    let zeros = |values: usize| vec![0.0; values * grid.len()];
    let mut balance = Balance::new(problem, film, speed);
    let mut unknowns = first_unknowns(&balance, start);
    let (mut outflow, mut stencil, mut change) = (zeros(1), zeros(STENCIL), zeros(1));
    let mut best = (f64::INFINITY, unknowns.clone());
    let mut linear = LinearSolver::new(grid, problem.periodicity());
    let (mut steps, mut substitutions) = (0, 0);
    let mut step_length = StepLength { share: 1.0, last: f64::INFINITY };
    let status = loop {
        if interrupted() {
            return None;
        }
        // Evaluate the balances and their derivatives at the current state.
        balance.update(&unknowns);
        let boundary_flux = balance.linearise(&mut outflow, &mut stencil);
        let residual = outflow.iter().map(|f| f.abs()).sum::<f64>();
        // Keep the best state.
        let is_best = residual < best.0;
        if is_best {
            best.0 = residual;
            best.1.copy_from_slice(&unknowns);
        }
        // Check convergence of the cells and of the box.
        let bound = boundary_flux.rounding.max(tolerance * boundary_flux.inflow);
        if residual <= bound && boundary_flux.imbalance() <= tolerance {
            break Status::Converged;
        }
        if steps == problem.most_steps {
            break Status::MaxIterations;
        }
        // Solve the linear system.
        let solved = residual.is_finite().then(|| linear.solve(&stencil, &outflow, &mut change));
        let Some(count) = solved.flatten() else { break Status::Diverged };
        let share = step_length.after(residual, is_best);
        for (k, (s, change)) in unknowns.iter_mut().zip(&change).enumerate() {
            *s = balance.moved(k, *s, share * change);
        }
        propagate(&mut balance, &mut unknowns, grid.ny());
        substitutions += count;
        steps += 1;
    };
    if status != Status::Converged {
        unknowns.copy_from_slice(&best.1);
        balance.update(&unknowns);
    }
    let boundary_flux = balance.linearise(&mut outflow, &mut stencil);
    let residual = outflow.iter().map(|f| f.abs()).sum::<f64>();
    let residual = if residual > 0.0 { residual / boundary_flux.inflow } else { 0.0 };
    let coarse_steps = start.map_or(0, |start| start.steps);
    Some(Solved { balance, unknowns, status, residual, boundary_flux, steps, substitutions, coarse_steps })
}

/// Unknowns interpolated from the coarser grid; the mean pressure of the edges on the coarsest.
fn first_unknowns(balance: &Balance<'_>, start: Option<&Start>) -> Vec<f64> {
    let grid = balance.film.grid();
    let at = |start: &Start, field: &[f64], [x, y]: [f64; 2]| {
        // The field matches its grid.
        start.film.grid().interpolate(field, x, y).unwrap_or_default()
    };
    grid.nodes()
        .enumerate()
        .map(|(k, (x, y))| match start {
            Some(start) => {
                let pressure = at(start, &start.pressure, [x, y]);
                balance.unknown(k, pressure, at(start, &start.theta, [x, y]))
            }
            None => balance.unknown(k, balance.edge_mean, 1.0),
        })
        .collect()
}
