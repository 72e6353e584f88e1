//! Flow across the rows of a strip, whose last row is next to the first one.

use std::f64::consts::PI;

use stribeck::analytic::HertzLine;
use stribeck::elastic::StripHalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    Auto, ContactSolver, ContactState, Evaluation, FilmFlows, FlowBalance, LubricatedContact, StoppingRule,
};
use stribeck::sim::scene::{GridSpec, Roughness, SolverKind};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Scene};
use stribeck::thermal::FilmThermal;
use stribeck::{Grid, Status};

/// The example of a mixed strip on fewer cells.
fn scene() -> Scene {
    let mut scene = Scene::from_toml(include_str!("../examples/scenes/strip.toml")).unwrap();
    scene.grid = GridSpec::Strip { nx: 80, ny: 24, x: [-0.3e-3, 0.21e-3], y: Some([-0.1e-3, 0.1e-3]) };
    scene
}

/// The solution with the heights of the scene, shifted by this number of rows.
fn solution(scene: &Scene, shift: usize) -> ContactSolution {
    let grid = scene.grid().unwrap();
    let mut heights = Roughness::gaussian(180e-9, 40e-6, 1).heights(&grid).unwrap();
    heights.rotate_left(shift * grid.nx());
    let solution = MixedLubricationSim::builder(scene.clone()).ball_heights(heights).solve().unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    solution
}

/// A mixed contact, and a full film that warms.
#[test]
fn cyclic_shift_of_rough_strips_leaves_their_numbers() {
    let mut warm = scene();
    warm.motion.entrainment_speed = 1.0;
    let oil = warm.lubricant.as_mut().unwrap();
    (oil.temperature, oil.roelands_s0, oil.thermal) = (Some(353.15), Some(1.1), Some(FilmThermal::default()));
    for (scene, is_mixed) in [(scene(), true), (warm, false)] {
        let numbers = [0, 5, 16].map(|shift| {
            let found = solution(&scene, shift);
            let heat = found.thermal.map_or([0.0; 2], |heat| [heat.film_temperature_max, heat.heat]);
            [
                1.0 + found.contact.load_ratio,
                found.friction.coefficient,
                found.film.minimum,
                found.film.mean_central,
                found.pressure.max,
                1.0 + heat[0],
                1.0 + heat[1],
            ]
        });
        assert_eq!(is_mixed, numbers[0][0] > 1.1, "{numbers:?}");
        for other in &numbers[1..] {
            for (k, (a, b)) in numbers[0].iter().zip(other).enumerate() {
                assert!((a / b - 1.0).abs() < scene.solver.tolerance, "number {k}: {numbers:?}");
            }
        }
    }
}

#[test]
fn solver_by_lines_solves_a_shifted_strip_alike() {
    let mut scene = scene();
    (scene.solver.kind, scene.motion.entrainment_speed) = (SolverKind::SemiSystem, 0.5);
    let found = [0, 9].map(|shift| solution(&scene, shift));
    let frictions = found.map(|solution| solution.friction.coefficient);
    assert!((frictions[0] / frictions[1] - 1.0).abs() < scene.solver.tolerance, "{frictions:?}");
}

const TOLERANCE: f64 = 1e-9;

/// State, flows and flow balance of a roller with the profile `heights(column, row)`, in shares of the box.
fn roller(
    [nx, ny]: [usize; 2],
    speed: f64,
    heights: impl Fn(f64, f64) -> f64,
) -> (ContactState, FilmFlows, FlowBalance) {
    let hertz = HertzLine::from_max_pressure(10e-3, 230e9, 0.8e9).unwrap();
    let grid =
        Grid::strip(nx, ny, [-3.0 * hertz.half_width, 2.0 * hertz.half_width], [0.0, 0.15e-3]).unwrap();
    let gap: Vec<f64> = (grid.nodes().enumerate())
        .map(|(k, (x, _))| x * x / 20e-3 - heights((k % nx) as f64 / nx as f64, (k / nx) as f64 / ny as f64))
        .collect();
    let mut body = StripHalfSpace::new(grid, 230e9, 10e-3).unwrap();
    let oil = Lubricant::new(
        Roelands::new(0.04, 0.6, 1.96e8).unwrap(),
        DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
    );
    let length = grid.size_y();
    let halves = (hertz.half_width, 0.5 * length);
    let mut problem = LubricatedContact::new(&gap, &mut body, hertz.force * length, halves, hertz.pressure)
        .with_lubricant(Some(&oil))
        .with_entrainment_speed(speed)
        .with_reference_film(100e-9);
    let mut state = ContactState::new(&grid);
    let stop = StoppingRule::default().with_tolerance(TOLERANCE);
    let report = Auto::new().solve(&mut problem, &mut state, &stop).unwrap();
    assert_eq!(report.status, Status::Converged, "{report:?}");
    let mut flows = FilmFlows::default();
    let balance = Evaluation::new(grid).film_flows(&problem, &state, &mut flows).unwrap().unwrap();
    (state, flows, balance)
}

/// Ridges oblique to the flow, which drive it across the rows.
fn oblique(x: f64, y: f64) -> f64 {
    60e-9 * (2.0 * PI * (5.0 * x + 2.0 * y)).cos() + 40e-9 * (2.0 * PI * 3.0 * y).sin()
}

#[test]
fn mass_is_conserved_across_the_last_row_of_a_strip() {
    let (nx, ny) = (80, 24);
    let (_, flows, balance) = roller([nx, ny], 0.05, oblique);
    assert!(balance.inflow > 0.0 && balance.imbalance < TOLERANCE, "{balance:?}");
    // Across the flow the strip is endless: as much flows through each of its columns.
    let through = |i: usize| flows.through.iter().skip(i).step_by(nx).sum::<f64>();
    for i in 1..nx - 1 {
        assert!((through(i) / through(nx / 2) - 1.0).abs() < 100.0 * TOLERANCE, "column {i}");
    }
    // Flow leaves the last row for the first one.
    let largest = |row: &[f64]| row.iter().fold(0.0_f64, |most, flow| most.max(flow.abs()));
    let rows: Vec<f64> = flows.north.chunks_exact(nx).map(largest).collect();
    assert!(rows[ny - 1] > 0.1 * largest(&rows), "{rows:?}");
}

#[test]
fn flow_across_the_rows_of_a_strip_shifts_with_its_roughness() {
    let (nx, ny, shift) = (80, 24, 7);
    let (first, flows, _) = roller([nx, ny], 0.05, oblique);
    let (second, moved, _) = roller([nx, ny], 0.05, |x, y| oblique(x, y + shift as f64 / ny as f64));
    let fields =
        [(&flows.north, &moved.north), (&first.film, &second.film), (&first.pressure, &second.pressure)];
    for (k, (field, moved)) in fields.into_iter().enumerate() {
        let mut expected = field.clone();
        expected.rotate_left(shift * nx);
        let largest = expected.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let error = expected.iter().zip(moved).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(error < 1e-6 * largest, "field {k}: {error:e} of {largest:e}");
    }
}

/// One asperity in the middle of the first row, half of it in the last rows.
#[test]
fn film_around_an_asperity_in_the_first_row_is_symmetric() {
    let (nx, ny) = (80, 24);
    let asperity = |x: f64, y: f64| {
        let across = y.min(1.0 - y) / 0.15;
        400e-9 * (-((x - 0.6) / 0.04).powi(2) - across * across).exp()
    };
    let (state, _, _) = roller([nx, ny], 0.02, asperity);
    let largest = |j: usize| state.pressure[j * nx..][..nx].iter().copied().fold(0.0, f64::max);
    assert!(largest(0) > 1.1 * largest(ny / 2), "{:e} and {:e} Pa", largest(0), largest(ny / 2));
    for j in 1..ny {
        let [row, mirrored] = [j, ny - j].map(|j| &state.film[j * nx..][..nx]);
        for (i, (a, b)) in row.iter().zip(mirrored).enumerate() {
            assert!((a / b - 1.0).abs() < 1e-6, "column {i}, row {j}: {a:e} and {b:e}");
        }
    }
}
