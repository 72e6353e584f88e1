//! Strips: line contacts whose surfaces repeat across the flow. Their elastic kernel, dry and lubricated contacts.

use std::f64::consts::PI;

use stribeck::analytic::{HertzLine, rectangle_potential, strip_potential};
use stribeck::elastic::{DeformationModel, LineHalfSpace, PeriodicHalfSpace};
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    Auto, ContactSolver, ContactState, Dry, LubricatedContact, Multigrid, StoppingRule,
};
use stribeck::{Grid, Status};

const RADIUS: f64 = 10e-3;
const MODULUS: f64 = 230e9;
/// Film unit of a cell: `2/(pi E')`.
const UNIT: f64 = 2.0 / (PI * MODULUS);

/// Displacements \[m/Pa\] by one cell of a strip at all offsets of columns and rows.
fn influences(grid: Grid, reference: f64) -> Vec<f64> {
    let mut body = PeriodicHalfSpace::new(grid, MODULUS, reference).unwrap();
    let mut pressure = vec![0.0; grid.len()];
    pressure[0] = 1.0;
    let mut out = vec![0.0; grid.len()];
    body.displacement(&pressure, &mut out).unwrap();
    out
}

/// Modified Bessel function of the second kind of order zero, by the trapezoidal rule, which converges exponentially.
fn bessel_k0(z: f64) -> f64 {
    let step = 0.02;
    (0..600).map(|i| if i == 0 { 0.5 } else { 1.0 } * step * (-z * (step * f64::from(i)).cosh()).exp()).sum()
}

/// The displacement by Fourier modes along y: a logarithm for the mean, Bessel functions for the others.
fn by_modes(grid: &Grid, reference: f64, x: f64, y: f64) -> f64 {
    let (dx, dy, width) = (grid.dx(), grid.dy(), grid.size_y());
    let mut sum = strip_potential(x, 0.5 * dx, reference);
    for mode in 1..200 {
        let (wave, half) = (2.0 * PI * f64::from(mode) / width, PI * f64::from(mode) * dy / width);
        // Gauss' rule with three points on each of four parts of the cell.
        let mut along = 0.0;
        for part in 0..4 {
            let middle = x + dx * ((f64::from(part) + 0.5) / 4.0 - 0.5);
            let gauss = [(-0.6_f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6_f64.sqrt(), 5.0 / 9.0)];
            along += gauss
                .iter()
                .map(|(s, weight)| weight * dx / 8.0 * bessel_k0(wave * (middle + s * dx / 8.0)))
                .sum::<f64>();
        }
        sum += 2.0 * half.sin() / half * (wave * y).cos() * along;
    }
    2.0 * UNIT * dy / width * sum
}

#[test]
fn kernel_is_the_sum_over_fourier_modes_and_over_images() {
    for (nx, ny, x, y) in [(24, 12, 48e-6, 24e-6), (16, 9, 64e-6, 18e-6), (20, 5, 20e-6, 20e-6)] {
        let grid = Grid::strip(nx, ny, [0.0, x], [0.0, y]).unwrap();
        let found = influences(grid, RADIUS);
        let unit = UNIT * grid.dx().min(grid.dy());
        for (i, j) in [(2, 0), (2, 1), (3, ny / 2), (5, 2), (nx - 1, 1)] {
            let at = by_modes(&grid, RADIUS, grid.dx() * i as f64, grid.dy() * j as f64);
            let error = (found[j * nx + i] - at) / unit;
            assert!(error.abs() < 2e-6, "{nx} x {ny}, offset {i}, {j}: {error:e}");
        }
        // Differences of the potentials of all images converge.
        let half = [0.5 * grid.dx(), 0.5 * grid.dy()];
        let image = |i: usize, j: usize, q: i32| {
            let (x, y) = (grid.dx() * i as f64, grid.dy() * j as f64 + f64::from(q) * grid.size_y());
            rectangle_potential(x, y, half[0], half[1])
        };
        for (i, j) in [(0, 1), (1, 0), (1, ny / 2), (0, ny / 2)] {
            let sum: f64 = (-20_000..=20_000).map(|q| image(i, j, q) - image(0, 0, q)).sum();
            let error = (found[j * nx + i] - found[0] - UNIT * sum) / unit;
            assert!(error.abs() < 1e-7, "{nx} x {ny}, offset {i}, {j}: {error:e}");
        }
    }
}

#[test]
fn kernel_sums_over_a_period_to_that_of_a_line() {
    let grid = Grid::strip(40, 12, [0.0, 80e-6], [0.0, 30e-6]).unwrap();
    let found = influences(grid, RADIUS);
    for i in 0..40 {
        let sum: f64 = (0..12).map(|j| found[j * 40 + i]).sum();
        let line = 2.0 * UNIT * strip_potential(grid.dx() * i as f64, 0.5 * grid.dx(), RADIUS);
        assert!((sum / line - 1.0).abs() < 1e-7, "offset {i}: {sum:e} {line:e}");
    }
}

#[test]
fn kernel_repeats_and_is_symmetric() {
    let grid = Grid::strip(10, 7, [0.0, 20e-6], [0.0, 7e-6]).unwrap();
    let found = influences(grid, RADIUS);
    for i in 0..10 {
        for j in 1..7 {
            let error = found[j * 10 + i] / found[(7 - j) * 10 + i] - 1.0;
            assert!(error.abs() < 1e-12, "{i}, {j}: {error:e}");
        }
    }
    let body = PeriodicHalfSpace::new(grid, MODULUS, RADIUS).unwrap();
    assert!((body.influence(1, 2) / found[2 * 10 + 1] - 1.0).abs() < 1e-12);
    assert!((body.influence(0, 6) / body.influence(0, 1) - 1.0).abs() < 1e-12 || body.influence(0, 6) == 0.0);
}

#[test]
fn grids_that_are_no_strip_and_short_references_are_rejected() {
    let plain = Grid::centred(10, 7, 1e-6, 1e-6).unwrap();
    assert!(PeriodicHalfSpace::new(plain, MODULUS, RADIUS).unwrap_err().to_string().contains("Grid::strip"));
    let strip = Grid::strip(10, 7, [0.0, 1e-3], [0.0, 1e-4]).unwrap();
    assert!(PeriodicHalfSpace::new(strip, MODULUS, 1e-4).unwrap_err().to_string().contains("reference"));
    assert!(Grid::strip(10, 4, [0.0, 1.0], [0.0, 1.0]).unwrap_err().to_string().contains("grid.ny"));
}

/// A contact of rollers of Hertz pressure `p_max` on `rows` rows, as a line for one row; its gap is that of the profile
/// `heights(x, y)`.
struct Rollers {
    grid: Grid,
    body: Box<dyn DeformationModel>,
    gap: Vec<f64>,
    hertz: HertzLine,
}

impl Rollers {
    fn new(
        (nx, rows, width): (usize, usize, f64),
        p_max: f64,
        reference: f64,
        heights: &dyn Fn(f64, f64) -> f64,
    ) -> Self {
        let hertz = HertzLine::from_max_pressure(RADIUS, MODULUS, p_max).unwrap();
        let x = [-3.0 * hertz.half_width, 2.0 * hertz.half_width];
        let (grid, body): (_, Box<dyn DeformationModel>) = if rows == 1 {
            let grid = Grid::from_edges(nx, 1, x, [-0.5, 0.5]).unwrap();
            (grid, Box::new(LineHalfSpace::new(grid, MODULUS, reference).unwrap()))
        } else {
            let grid = Grid::strip(nx, rows, x, [-0.5 * width, 0.5 * width]).unwrap();
            (grid, Box::new(PeriodicHalfSpace::new(grid, MODULUS, reference).unwrap()))
        };
        let gap = grid.nodes().map(|(x, y)| x * x / (2.0 * RADIUS) - heights(x, y)).collect();
        Self { grid, body, gap, hertz }
    }

    fn problem(&mut self) -> LubricatedContact<'_> {
        let (length, hertz) = (self.grid.size_y(), self.hertz);
        let halves = (hertz.half_width, 0.5 * length);
        LubricatedContact::new(&self.gap, &mut *self.body, hertz.force * length, halves, hertz.pressure)
    }

    fn dry(&mut self) -> ContactState {
        let grid = self.grid;
        let mut state = ContactState::new(&grid);
        let report =
            Dry::new().solve(&mut self.problem(), &mut state, &StoppingRule::default().with_tolerance(1e-8));
        assert_eq!(report.unwrap().status, Status::Converged);
        state
    }

    fn lubricated(&mut self, speed: f64, limit: f64) -> ContactState {
        let oil = Lubricant::new(
            Roelands::new(0.04, 0.6, 1.96e8).unwrap(),
            DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
        );
        let (grid, limit) = (self.grid, vec![limit; self.gap.len()]);
        let mut state = ContactState::new(&grid);
        let mut problem = self
            .problem()
            .with_lubricant(Some(&oil))
            .with_entrainment_speed(speed)
            .with_reference_film(100e-9)
            .with_pressure_limit(Some(&limit));
        let report = Auto::new()
            .solve(&mut problem, &mut state, &StoppingRule::default().with_tolerance(1e-9))
            .unwrap();
        assert_eq!(report.status, Status::Converged, "{report:?}");
        state
    }
}

/// Largest difference of the rows of `field` from `row`, over the largest entry of that.
fn difference(field: &[f64], row: &[f64]) -> f64 {
    let largest = row.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let rows = field.chunks_exact(row.len()).flat_map(|values| values.iter().zip(row));
    rows.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / largest
}

fn smooth(_: f64, _: f64) -> f64 {
    0.0
}

/// Ridges across the flow.
fn ridges(x: f64, _: f64) -> f64 {
    60e-9 * (2.0 * PI * x / 45e-6).cos() + 30e-9 * (2.0 * PI * x / 17e-6).sin()
}

#[test]
fn dry_strip_of_equal_rows_is_the_line() {
    for heights in [smooth, ridges] {
        let line = Rollers::new((200, 1, 1.0), 1e9, RADIUS, &heights).dry();
        let strip = Rollers::new((200, 8, 0.2e-3), 1e9, RADIUS, &heights).dry();
        let error = difference(&strip.pressure, &line.pressure);
        assert!(error < 1e-6, "{error:e}");
        assert!((strip.approach / line.approach - 1.0).abs() < 1e-7);
    }
}

#[test]
fn dry_smooth_strip_is_hertz() {
    let mut rollers = Rollers::new((400, 6, 0.1e-3), 1e9, RADIUS, &smooth);
    let state = rollers.dry();
    for ((x, _), p) in rollers.grid.nodes().zip(&state.pressure) {
        let near_rim = (x.abs() / rollers.hertz.half_width - 1.0).abs() < 0.1;
        let error = (p - rollers.hertz.pressure_at(x)).abs() / 1e9;
        assert!(error < if near_rim { 0.05 } else { 2e-3 }, "{error} at {x}");
    }
    let approach = state.approach / rollers.hertz.approach(RADIUS).unwrap() - 1.0;
    assert!(approach.abs() < 1e-3, "{approach:e}");
}

/// Roughness along both axes with the period of the strip.
fn rough(x: f64, y: f64) -> f64 {
    let wave = 2.0 * PI / 0.2e-3;
    80e-9 * (4.0 * wave * y).cos() * (2.0 * PI * x / 40e-6 + 1.0).cos()
        + 50e-9 * (2.0 * wave * y + 2.0 * PI * x / 70e-6).sin()
}

#[test]
fn reference_shifts_the_approach_and_leaves_the_pressure() {
    let states = [0.01, 0.1].map(|reference| Rollers::new((128, 48, 0.2e-3), 1e9, reference, &rough).dry());
    let error = difference(&states[1].pressure, &states[0].pressure);
    assert!(error < 2e-6, "{error:e}");
    let force = HertzLine::from_max_pressure(RADIUS, MODULUS, 1e9).unwrap().force;
    let shift = 4.0 * force / (PI * MODULUS) * 10.0_f64.ln();
    let moved = states[1].approach - states[0].approach;
    assert!((moved / shift - 1.0).abs() < 1e-5, "{moved:e} {shift:e}");
}

#[test]
fn lubricated_strip_of_equal_rows_is_the_line() {
    for (heights, speed, limit) in
        [(smooth as fn(f64, f64) -> f64, 1.0, 4e9), (ridges, 0.001, 4e9), (ridges, 0.001, 1.3e9)]
    {
        let line = Rollers::new((160, 1, 1.0), 0.8e9, RADIUS, &heights).lubricated(speed, limit);
        let strip = Rollers::new((160, 10, 0.2e-3), 0.8e9, RADIUS, &heights).lubricated(speed, limit);
        let errors = [difference(&strip.pressure, &line.pressure), difference(&strip.film, &line.film)];
        assert!(errors.iter().all(|error| *error < 1e-6), "{errors:?} at {speed} m/s");
        assert_eq!(strip.in_contact[..160], line.in_contact[..]);
        assert_eq!(speed < 0.1, line.in_contact.contains(&true), "contact at {speed} m/s");
    }
}

/// Sides are closed to the flow, deformation repeats: a cyclic shift of the rows moves the closed edge only.
#[test]
fn strip_hardly_depends_on_where_its_period_begins() {
    let solve = |shift: f64| {
        let mut rollers = Rollers::new((128, 48, 0.2e-3), 0.8e9, RADIUS, &|x, y| rough(x, y + shift));
        let state = rollers.lubricated(0.3, 4e9);
        let grid = rollers.grid;
        state
            .film
            .iter()
            .zip(grid.nodes())
            .filter(|(_, (x, _))| x.abs() < 0.5e-4)
            .map(|(h, _)| h)
            .sum::<f64>()
    };
    let films = [0.0, 10.0, 27.0].map(|rows| solve(rows / 48.0 * 0.2e-3));
    assert!(films.iter().all(|film| (film / films[0] - 1.0).abs() < 0.01), "{films:?}");
}

#[test]
fn multigrid_rejects_strips() {
    let mut rollers = Rollers::new((64, 64, 0.2e-3), 0.8e9, RADIUS, &smooth);
    let oil = Lubricant::new(
        Roelands::new(0.04, 0.6, 1.96e8).unwrap(),
        DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
    );
    let mut state = ContactState::new(&rollers.grid);
    let mut problem = rollers.problem().with_lubricant(Some(&oil)).with_entrainment_speed(1.0);
    let error = Multigrid::new().solve(&mut problem, &mut state, &StoppingRule::default()).unwrap_err();
    assert!(error.to_string().contains("edges at their sides"), "{error}");
}
