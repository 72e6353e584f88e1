//! Converged contacts balance mass by the laws of the lubricant, not by their table alone.

use stribeck::Grid;
use stribeck::analytic::{HertzLine, HertzPoint};
use stribeck::elastic::{HalfSpace, LineHalfSpace};
use stribeck::lubricant::{Barus, DowsonHigginson, Incompressible, Lubricant, Roelands};
use stribeck::reynolds::{
    ContactSolver, ContactState, Evaluation, FaceMobility, LubricatedContact, NewtonKrylov, Scheme,
    StoppingRule,
};

const MODULUS: f64 = 230e9;
const RADIUS: f64 = 10e-3;
/// Viscosity at ambient pressure \[Pa s\].
const ETA: f64 = 0.04;

/// The balances of a line contact, summed with `q = (1 - exp(-alpha p))/alpha` of the law of Barus.
#[test]
fn line_contact_balances_mass_by_the_closed_form_of_barus() {
    let (alpha, speed, n) = (20e-9, 1.0, 512);
    let hertz = HertzLine::from_max_pressure(RADIUS, MODULUS, 0.7e9).unwrap();
    let a = hertz.half_width;
    let grid = Grid::from_edges(n, 1, [-5.0 * a, 2.0 * a], [-0.5, 0.5]).unwrap();
    let gap: Vec<f64> = grid.nodes().map(|(x, _)| x * x / (2.0 * RADIUS)).collect();
    let mut body = LineHalfSpace::new(grid, MODULUS, 100.0 * a).unwrap();
    let oil = Lubricant::new(Barus::new(ETA, alpha).unwrap(), Incompressible);
    let mut problem = LubricatedContact::new(&gap, &mut body, hertz.force, (a, 0.5), 0.7e9)
        .with_lubricant(Some(&oil))
        .with_entrainment_speed(speed)
        .with_scheme(Scheme::FirstOrder)
        .with_face_mobility(FaceMobility::ReducedPressure);
    let mut state = ContactState::new(&grid);
    let stop = StoppingRule::default();
    NewtonKrylov::new().solve(&mut problem, &mut state, &stop).unwrap().require_converged().unwrap();
    let reduced: Vec<f64> = state.fluid_pressure.iter().map(|p| -(-alpha * p).exp_m1() / alpha).collect();
    let flow = |k: usize| {
        let mobility = 0.5 * (state.film[k].powi(3) + state.film[k + 1].powi(3)) / (12.0 * ETA);
        // Pressure is ambient at the edge of the box, half a cell beyond the outermost nodes.
        let cells = if k == 0 || k + 2 == n { 1.5 } else { 1.0 };
        state.mass[k] + mobility * (reduced[k] - reduced[k + 1]) / (speed * cells * grid.dx())
    };
    let imbalance: f64 = (1..n - 1).map(|k| (flow(k) - flow(k - 1)).abs()).sum();
    let load: f64 = state.pressure.iter().sum();
    let mean_film = state.pressure.iter().zip(&state.film).map(|(p, h)| p * h).sum::<f64>() / load;
    let residual = imbalance / mean_film;
    assert!(residual < 3.0 * stop.tolerance, "{residual:e}");
}

/// In a unit of pressure eight times as small the intervals of the table are eight times as narrow: a residual
/// that the table makes would be another one.
#[test]
fn mass_residual_of_a_point_contact_does_not_depend_on_the_unit_of_pressure() {
    let hertz = HertzPoint::from_max_pressure(RADIUS, RADIUS, MODULUS, 1e9).unwrap();
    let a = hertz.half_width_x;
    let grid = Grid::from_edges(64, 64, [-4.0 * a, 2.0 * a], [-3.0 * a, 3.0 * a]).unwrap();
    let wave = |x: f64| (std::f64::consts::TAU * x / (0.5 * a)).cos();
    let gap: Vec<f64> =
        grid.nodes().map(|(x, y)| (x * x + y * y) / (2.0 * RADIUS) + 30e-9 * wave(x) * wave(y)).collect();
    let stop = StoppingRule::default();
    let mut state = ContactState::new(&grid);
    for (unit, alpha) in [(1.0, 22e-9), (8.0, 22e-9), (1.0, 40e-9), (8.0, 40e-9)] {
        let viscosity = Roelands::from_alpha(unit * ETA, alpha / unit, 0.6, unit * 1.96e8).unwrap();
        let oil = Lubricant::new(viscosity, DowsonHigginson::new(0.6e-9 / unit, 1.7e-9 / unit).unwrap());
        let mut body = HalfSpace::new(grid, unit * MODULUS).unwrap();
        let mut problem = LubricatedContact::new(&gap, &mut body, unit * hertz.force, (a, a), unit * 1e9)
            .with_lubricant(Some(&oil))
            .with_entrainment_speed(0.5);
        if unit < 2.0 {
            state = ContactState::new(&grid);
            let report = NewtonKrylov::new().solve(&mut problem, &mut state, &stop).unwrap();
            report.require_converged().unwrap();
        } else {
            let pressures = state.pressure.iter_mut().chain(&mut state.fluid_pressure);
            pressures.for_each(|pressure| *pressure *= unit);
            let residual = Evaluation::new(grid).evaluate(&mut problem, &mut state).unwrap().mass;
            assert!(residual < 3.0 * stop.tolerance, "alpha = {alpha:e}: {residual:e}");
        }
    }
}
