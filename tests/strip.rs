//! Strips: line contacts whose surfaces repeat across the flow. Their elastic kernel, dry and lubricated contacts.

use std::f64::consts::PI;

use stribeck::analytic::{HertzLine, rectangle_potential, strip_potential};
use stribeck::elastic::{DeformationModel, LineHalfSpace, StripHalfSpace};
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    Auto, ContactSolver, ContactState, Dry, LubricatedContact, Multigrid, StoppingRule,
};
use stribeck::sim::scene::{GridSpec, Load, PlasticSpec, Roughness, SolverKind, SolverModel};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Scene, solve_contact};
use stribeck::surface::{Autocorrelation, Form, RandomShape, RandomSurface};
use stribeck::thermal::FilmThermal;
use stribeck::tribochem::{FlashTemperature, ThermalBody};
use stribeck::{Grid, Status};

const RADIUS: f64 = 10e-3;
const MODULUS: f64 = 230e9;
/// Film unit of a cell: `2/(pi E')`.
const UNIT: f64 = 2.0 / (PI * MODULUS);

/// Displacements \[m/Pa\] by one cell of a strip at all offsets of columns and rows.
fn influences(grid: Grid, reference: f64) -> Vec<f64> {
    let mut body = StripHalfSpace::new(grid, MODULUS, reference).unwrap();
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
    let body = StripHalfSpace::new(grid, MODULUS, RADIUS).unwrap();
    assert!((body.influence(1, 2) / found[2 * 10 + 1] - 1.0).abs() < 1e-12);
    assert!((body.influence(0, 6) / body.influence(0, 1) - 1.0).abs() < 1e-12 || body.influence(0, 6) == 0.0);
}

#[test]
fn grids_that_are_no_strip_and_short_references_are_rejected() {
    let plain = Grid::centred(10, 7, 1e-6, 1e-6).unwrap();
    assert!(StripHalfSpace::new(plain, MODULUS, RADIUS).unwrap_err().to_string().contains("Grid::strip"));
    let strip = Grid::strip(10, 7, [0.0, 1e-3], [0.0, 1e-4]).unwrap();
    assert!(StripHalfSpace::new(strip, MODULUS, 1e-4).unwrap_err().to_string().contains("reference"));
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
            (grid, Box::new(StripHalfSpace::new(grid, MODULUS, reference).unwrap()))
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
#[ignore = "slow"]
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

/// A roller of the given Hertz pressure and speed in a scene, with the grid of a line.
fn roller(p_max: f64, speed: f64, nx: usize, x: [f64; 2]) -> Scene {
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Cylinder { radius: 5e-3 };
    scene.load = Load::hertz_pressure(p_max);
    scene.motion.entrainment_speed = speed;
    scene.motion.slide_roll_ratio = 0.5;
    scene.roughness = Default::default();
    scene.plastic = Some(PlasticSpec::new(7e9));
    scene.wear = None;
    scene.friction.boundary_coefficient = 0.115;
    scene.friction.eyring_stress = Some(5e6);
    scene.friction.limiting_stress_coefficient = Some(0.05);
    let oil = scene.lubricant.as_mut().unwrap();
    (oil.eta0, oil.alpha) = (0.01, Some(15e-9));
    scene.grid = GridSpec::Row { nx, x };
    scene
}

/// The same roller as a strip.
fn strip(scene: &Scene, ny: usize, y: Option<[f64; 2]>) -> Scene {
    let mut scene = scene.clone();
    let GridSpec::Row { nx, x } = scene.grid else { panic!("a line") };
    scene.grid = GridSpec::Strip { nx, ny, x, y };
    scene
}

fn converged(builder: stribeck::sim::SimBuilder) -> ContactSolution {
    let solution = builder.solve().unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    solution
}

/// The box cuts the inlet at 3 m/s: pressures at its edge are those of the smooth line in a wider one.
#[test]
fn smooth_strip_has_the_results_of_the_line_per_metre() {
    for speed in [0.02, 3.0] {
        let mut line = roller(1.0e9, speed, 160, [-0.2e-3, 0.15e-3]);
        line.solver.tolerance = 1e-9;
        let solutions = [line.clone(), strip(&line, 6, Some([-0.1e-3, 0.05e-3]))]
            .map(|scene| solve_contact(&scene).unwrap());
        let numbers = solutions.each_ref().map(|found| {
            assert_eq!(found.report.status, Status::Converged);
            let flow = found.flow.unwrap();
            [
                found.hertz.force,
                found.hertz.area,
                found.film.central,
                found.film.minimum,
                found.film.mean_central,
                found.pressure.max,
                1.0 + found.pressure.load_outside,
                flow.inflow,
                flow.outflow,
                found.friction.coefficient,
                1.0 + found.contact.area,
            ]
        });
        for (k, (a, b)) in numbers[0].iter().zip(&numbers[1]).enumerate() {
            assert!((a / b - 1.0).abs() < 2e-6, "number {k} at {speed} m/s: {a:e} {b:e}");
        }
        assert_eq!(speed > 1.0, solutions[1].pressure.load_outside > 0.0, "the box cuts the inlet");
        let text = solutions[1].to_string();
        assert!(
            text.contains("N/m, half-width") && text.contains("m^2/s") && !text.contains("500000"),
            "{text}"
        );
    }
}

/// Solid contact and plastic areas per metre of strips of one and of two periods.
#[test]
fn areas_per_metre_do_not_depend_on_the_number_of_periods() {
    let mut line = roller(1.5e9, 5e-3, 96, [-0.3e-3, 0.21e-3]);
    (line.lubricant, line.plastic) = (None, Some(PlasticSpec::new(3e9)));
    line.solver.tolerance = 1e-7;
    let one = strip(&line, 40, Some([-0.1e-3, 0.1e-3]));
    let heights = Roughness::gaussian(180e-9, 40e-6, 1).heights(&one.grid().unwrap()).unwrap();
    let two = strip(&line, 80, Some([-0.2e-3, 0.2e-3]));
    let doubled = [heights.clone(), heights.clone()].concat();
    let found = [(one, heights), (two, doubled)]
        .map(|(scene, heights)| converged(MixedLubricationSim::builder(scene).ball_heights(heights)).contact);
    let areas =
        found.map(|contact| [contact.area, contact.area_ratio, contact.plastic_area, contact.load_ratio]);
    for (a, b) in areas[0].iter().zip(&areas[1]) {
        assert!((a / b - 1.0).abs() < 2e-3 && *a > 0.0, "{areas:?}");
    }
}

/// One surface, repeated, under a strip and under an ellipsoid of radius ratio 16.
#[test]
#[ignore = "slow"]
fn mixed_strip_agrees_with_a_wide_point_contact() {
    const PERIODS: usize = 10;
    for (length, seed, speed, model) in [
        (40e-6, 2, 0.02, SolverModel::Resolved),
        (20e-6, 2, 0.02, SolverModel::Resolved),
        (40e-6, 2, 0.01, SolverModel::AsperityInlets),
    ] {
        let (nx, ny, x, width) = (80, 40, [-0.3e-3, 0.21e-3], 0.24e-3);
        let mut line = roller(1.5e9, speed, nx, x);
        line.solver.model = model;
        let scene = strip(&line, ny, Some([-0.5 * width, 0.5 * width]));
        let heights = Roughness::gaussian(180e-9, length, seed).heights(&scene.grid().unwrap()).unwrap();
        let mut point = line.clone();
        point.form = Form::Ellipsoid { radius_x: 5e-3, radius_y: 80e-3, angle: 0.0 };
        let half = 0.5 * width * PERIODS as f64;
        point.grid = GridSpec::Cells { nx, ny: PERIODS * ny, x, y: [-half, half] };
        let repeated = heights.repeat(PERIODS);
        let strip = converged(MixedLubricationSim::builder(scene).ball_heights(heights));
        let point = converged(MixedLubricationSim::builder(point).ball_heights(repeated));
        let loads = [strip.contact.load_ratio, point.contact.load_ratio];
        let friction = [strip.friction.coefficient, point.friction.coefficient];
        let case = format!("length {length:e}, {model:?}");
        // Measured, resolved: .006 and .027; 2.7 and 4.0 %.
        assert!((loads[0] - loads[1]).abs() < 0.06, "{case}: loads {loads:?}");
        assert!((friction[0] / friction[1] - 1.0).abs() < 0.08, "{case}: friction {friction:?}");
        assert!(loads[0] > 0.04, "{case} is mixed: loads {loads:?}");
    }
}

/// One surface, drawn on 48 x 24 cells, on these and on three times as many along each side.
#[test]
fn mesh_errors_of_a_mixed_strip_hold_against_a_finer_mesh() {
    let shape = RandomShape::Correlated {
        autocorrelation: Autocorrelation::Gaussian,
        length_x: 40e-6,
        length_y: 40e-6,
    };
    let surface = RandomSurface::new(shape, 180e-9, 2).with_cells(Some([48, 24]));
    let on = |meshes: usize| {
        let line = roller(1.5e9, 0.005, 48 * meshes, [-0.3e-3, 0.21e-3]);
        let mut scene = strip(&line, 24 * meshes, Some([-0.12e-3, 0.12e-3]));
        scene.roughness.ball = Roughness::Random(surface);
        scene.solver.estimate = meshes == 1;
        converged(MixedLubricationSim::builder(scene))
    };
    let (coarse, fine) = (on(1), on(3));
    let estimate = coarse.error_estimate.unwrap();
    let numbers = [&coarse, &fine].map(|found| {
        [
            found.contact.load_ratio,
            found.contact.area_ratio,
            found.film.mean_central / fine.film.mean_central,
            found.friction.coefficient / fine.friction.coefficient,
        ]
    });
    let bounds = [
        estimate.contact_load_ratio,
        estimate.contact_area_ratio,
        estimate.film_mean_central,
        estimate.friction_coefficient,
    ];
    assert!((0.1..0.9).contains(&fine.contact.load_ratio), "mixed: {:?}", fine.contact);
    for (k, bound) in bounds.into_iter().enumerate() {
        let error = (numbers[0][k] - numbers[1][k]).abs();
        assert!(error <= bound && bound < 0.6, "number {k}: {error}, {estimate:?}");
    }
}

/// Cells five times as wide across the flow as along it.
#[test]
fn mixed_strip_with_wide_cells_converges() {
    let line = roller(1.5e9, 5e-3, 128, [-0.3e-3, 0.21e-3]);
    let mut scene = strip(&line, 13, Some([-0.12e-3, 0.12e-3]));
    let (autocorrelation, length_x, length_y) = (Autocorrelation::Gaussian, 20e-6, 90e-6);
    let shape = RandomShape::Correlated { autocorrelation, length_x, length_y };
    scene.roughness.ball = Roughness::Random(RandomSurface::new(shape, 180e-9, 2));
    scene.solver.kind = SolverKind::NewtonKrylov;
    assert!(scene.warnings().is_empty(), "{:?}", scene.warnings());
    let solution = converged(MixedLubricationSim::builder(scene.clone()));
    assert!(solution.contact.load_ratio > 0.1, "{:?}", solution.contact);
    // A shift of the approach by the mean rise of the films saves most of some 280 steps.
    assert!(solution.report.work.iterations < 100, "{:?}", solution.report);
    // Cells that are long along the flow are named before a solve.
    scene.grid = GridSpec::Strip { nx: 26, ny: 64, x: [-0.3e-3, 0.21e-3], y: Some([-0.12e-3, 0.12e-3]) };
    let warnings = scene.warnings();
    let named = |warning: &stribeck::sim::Warning| warning.message.contains("as long along the flow");
    assert!(warnings.iter().any(|warning| warning.field == "grid.nx" && named(warning)), "{warnings:?}");
}

/// A steel roller whose film warms.
#[test]
fn smooth_thermal_strip_has_the_temperatures_of_the_line() {
    for speed in [0.5, 4.0] {
        let mut line = roller(1.0e9, speed, 96, [-0.25e-3, 0.2e-3]);
        let oil = line.lubricant.as_mut().unwrap();
        (oil.temperature, oil.roelands_s0) = (Some(353.15), Some(1.1));
        oil.thermal = Some(FilmThermal::default());
        let [row, rows] = [line.clone(), strip(&line, 6, Some([-0.1e-3, 0.1e-3]))]
            .map(|scene| converged(MixedLubricationSim::builder(scene)));
        let numbers = [&row, &rows].map(|solution| {
            let heat = solution.thermal.unwrap();
            let rises = [heat.film_temperature_max - 353.15, heat.surface_rise_ball, heat.surface_rise_disc];
            [rises[0], rises[1], rises[2], heat.heat, solution.friction.coefficient, solution.film.central]
        });
        for (a, b) in numbers[0].iter().zip(&numbers[1]) {
            assert!((a / b - 1.0).abs() < 2e-3 && *a > 0.0, "{speed} m/s: {numbers:?}");
        }
    }
}

/// Rises by heat that repeats: the middle period of nine on a plain grid, for bodies that move, whose heat does not
/// reach far across the flow; that of a line for equal rows, at rest too.
#[test]
fn flash_temperature_of_a_strip_repeats_across_the_flow() {
    let (nx, ny, x, width) = (40, 16, [-1e-4, 1e-4], 1e-4);
    let strip = Grid::strip(nx, ny, x, [0.0, width]).unwrap();
    let heat: Vec<f64> = (0..nx * ny)
        .map(|k| if k % nx > 5 && k % nx < 25 { 1e8 * (1.0 + (0.7 * k as f64).sin()) } else { 0.0 })
        .collect();
    let rises = |grid: &Grid, heat: &[f64], speeds: [f64; 2]| {
        let mut rises = vec![0.0; grid.len()];
        let mut flash = FlashTemperature::new(grid, [ThermalBody::STEEL; 2], speeds).unwrap();
        assert!(flash.rise(heat, &mut rises).unwrap().maximum > 0.0);
        rises
    };
    let wide = Grid::from_edges(nx, 9 * ny, x, [0.0, 9.0 * width]).unwrap();
    for speeds in [[2.0, 1.0], [1.0, 1.0]] {
        let found = rises(&strip, &heat, speeds);
        let repeated = rises(&wide, &heat.repeat(9), speeds);
        let error = difference(&repeated[4 * nx * ny..5 * nx * ny], &found);
        assert!(error < 1e-3, "{error:e} at {speeds:?}");
    }
    let equal: Vec<f64> = (0..nx * ny).map(|k| if k % nx > 5 && k % nx < 25 { 1e8 } else { 0.0 }).collect();
    let line = Grid::from_edges(nx, 1, x, [-0.5, 0.5]).unwrap();
    for speeds in [[2.0, 1.0], [0.5, 0.0], [0.0, 0.0]] {
        let error = difference(&rises(&strip, &equal, speeds), &rises(&line, &equal[..nx], speeds));
        assert!(error < 1e-3, "{error:e} at {speeds:?}");
    }
}

const TOML: &str = include_str!("../examples/scenes/strip.toml");

#[test]
fn strips_are_read_and_written() {
    let scene = Scene::from_toml(TOML).unwrap();
    let given = GridSpec::Strip { nx: 128, ny: 64, x: [-0.3e-3, 0.21e-3], y: Some([-0.12e-3, 0.12e-3]) };
    assert_eq!(scene.grid, given);
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    // Five correlation lengths across the flow of the longer roughness.
    let mut open = scene.clone();
    open.grid = GridSpec::Strip { nx: 128, ny: 64, x: [-0.3e-3, 0.21e-3], y: None };
    assert_eq!(Scene::from_toml(&open.to_toml().unwrap()).unwrap(), open);
    open.roughness.disc = Roughness::gaussian(20e-9, 60e-6, 3);
    let grid = open.grid().unwrap();
    assert!(grid.is_strip() && (grid.size_y() / 300e-6 - 1.0).abs() < 1e-12);
}

#[test]
fn scenes_without_the_keys_of_a_strip_are_rejected_by_name() {
    for (old, new, expected) in [
        ("across = \"periodic\"", "across = \"mirrored\"", "periodic"),
        ("ny = 64\n", "", "ny"),
        ("ny = 64\n", "ny = 64\ngrows = true\n", "grows"),
        ("ny = 64\n", "ny = 64\naccuracy = 0.01\n", "solver.accuracy checks"),
    ] {
        let error = Scene::from_toml(&TOML.replace(old, new)).unwrap_err().to_string();
        assert!(error.contains(expected), "{new}: {error}");
    }
    for (old, new, expected) in [
        ("kind = \"cylinder\"", "kind = \"sphere\"", "grid.across"),
        ("ny = 64", "ny = 3", "grid.ny"),
        ("y = [-0.12e-3, 0.12e-3]", "y = [0.12e-3, -0.12e-3]", "grid.y"),
    ] {
        let scene = Scene::from_toml(&TOML.replace(old, new)).unwrap();
        let error = solve_contact(&scene).unwrap_err().to_string();
        assert!(error.contains(expected), "{new}: {error}");
    }
    let mut smooth = Scene::from_toml(TOML).unwrap();
    smooth.roughness = Default::default();
    smooth.grid = GridSpec::Strip { nx: 128, ny: 64, x: [-0.3e-3, 0.21e-3], y: None };
    let error = solve_contact(&smooth).unwrap_err().to_string();
    assert!(error.contains("grid.y") && error.contains("correlation lengths"), "{error}");
}

#[test]
fn physics_that_strips_leave_out_is_rejected_by_name() {
    type Change = (&'static str, fn(&mut Scene));
    let changes: [Change; 3] = [
        ("multigrid", |scene| scene.solver.kind = SolverKind::Multigrid),
        ("paper", |scene| scene.solver.contact = stribeck::reynolds::ContactDefinition::UnifiedReynolds),
        ("spin_radius", |scene| scene.motion.spin_radius = Some(1.0)),
    ];
    for (expected, change) in changes {
        let mut scene = Scene::from_toml(TOML).unwrap();
        change(&mut scene);
        let builder = || MixedLubricationSim::builder(scene.clone());
        let [solved, checked] = [builder().solve().err(), builder().check_contact().err()]
            .map(|error| error.map(|error| error.to_string()).unwrap_or_default());
        assert!(solved.contains(expected) && solved == checked, "{expected}: {solved}, {checked}");
    }
    let builder = || MixedLubricationSim::builder(Scene::from_toml(TOML).unwrap());
    let expected = builder().build().unwrap().expectation().unwrap().film.unwrap();
    let hertz = Scene::from_toml(TOML).unwrap().formula_film().unwrap().unwrap();
    assert!((expected.map.central / hertz.map.central - 1.0).abs() < 1e-12, "film of the load per metre");
}
