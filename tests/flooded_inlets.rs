//! Flooded inlets: films that do not depend on the box.

use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    ContactSolver, ContactState, EdgePressure, LubricatedContact, NewtonKrylov, StoppingRule,
};
use stribeck::sim::scene::{GridSpec, InletSpec, Load, LubricantSpec, Motion, SolverKind};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Scene, solve_contact};
use stribeck::surface::Form;
use stribeck::{Grid, Status};

const MODULUS: f64 = 230e9;

/// A smooth ball of 15 mm in oil of 0.05 Pa s and 22 1/GPa.
fn ball(force: f64, speed: f64) -> Scene {
    let mut scene = Scene::azam_2019(32);
    scene.form = Form::Sphere { radius: 15e-3 };
    scene.elastic.equivalent_modulus = MODULUS;
    scene.load = Load::force(force);
    scene.motion = Motion::new(speed, 0.0);
    scene.lubricant = Some(LubricantSpec::roelands(0.05, 0.6).with_alpha(Some(22e-9)));
    (scene.roughness, scene.plastic, scene.wear) = (Default::default(), None, None);
    scene
}

/// The scene in a box from `inlet` to 1.8 half-widths along the flow and `side` to either side, an eighth of one a cell.
fn in_box(scene: &Scene, inlet: f64, side: f64) -> Scene {
    let mut scene = scene.clone();
    let [a, b] = scene.hertz().unwrap().half_extents();
    let cells = |length: f64| (8.0 * length).round() as usize;
    let (nx, x) = (cells(1.8 - inlet), [inlet * a, 1.8 * a]);
    scene.grid = if scene.form.is_line() {
        GridSpec::Row { nx: 4 * nx, x }
    } else {
        GridSpec::Cells { nx, ny: 2 * cells(side), x, y: [-side * b, side * b] }
    };
    scene
}

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    let inside = solution.state.pressure.iter().sum::<f64>() * solution.grid.cell_area();
    let load = inside + solution.pressure.load_outside;
    assert!((load / solution.hertz.force - 1.0).abs() < 1e-6, "{load}");
    solution
}

/// Limits of boxes that grow and of meshes that are refined, by zero boxes extrapolated and by analytic edges: 243 nm
/// where the bodies begin to deflect (`M = 2.8`), 20.3 um where they are rigid (`M = 0.5`; Brewe and Hamrock 20.1).
#[test]
fn film_of_a_light_ball_is_the_flooded_one_in_any_box() {
    for (speed, film) in [(0.315, 243e-9), (3.15, 20.3e-6)] {
        for (inlet, side) in [(-2.0, 1.8), (-3.3, 1.8), (-5.0, 3.0)] {
            let solution = solved(&in_box(&ball(0.765, speed), inlet, side));
            let error = solution.film.central / film - 1.0;
            assert!(error.abs() < 0.02, "{speed} m/s, {inlet}: {:e}", solution.film.central);
        }
    }
}

/// Rigid cylinders, `h = 4.9 eta u R/W` (Martin 1916, films that rupture where pressure and its slope are zero), in boxes far shorter than
/// their film length `(2 R h)^(1/2)`, up to 130 Hertz half-widths.
#[test]
fn film_of_a_rigid_line_is_the_flooded_one_in_any_box() {
    let mut scene = ball(1.0, 1.0);
    scene.form = Form::Cylinder { radius: 50e-3 };
    scene.load = Load::force(2e3);
    scene.lubricant = Some(LubricantSpec::roelands(0.1, 0.6).with_alpha(Some(1e-10)));
    for speed in [1.0, 5.0, 10.0, 20.0] {
        scene.motion = Motion::new(speed, 0.0);
        let film = 4.896 * 0.1 * speed * 50e-3 / 2e3;
        let given = solved(&in_box(&scene, -4.0, 0.0));
        scene.grid = GridSpec::Accuracy { accuracy: 0.02 };
        let chosen = solved(&scene);
        for solution in [given, chosen] {
            let error = solution.film.central / film - 1.0;
            assert!(error.abs() < 0.03, "{speed} m/s: {:e} {film:e}", solution.film.central);
        }
    }
}

#[test]
fn accuracy_of_a_light_ball_counts_the_box() {
    let mut scene = ball(0.765, 0.315);
    scene.grid = GridSpec::Accuracy { accuracy: 0.05 };
    let solution = solved(&scene);
    let estimate = solution.error_estimate.unwrap();
    let error = (solution.film.central / 243e-9 - 1.0).abs();
    assert!(error < estimate.film_central && estimate.film_central < 0.05, "{error}, {estimate:?}");
    assert!(estimate.film_by_box > 0.0 && estimate.film_by_box < estimate.film_central);
}

/// Boxes of a soft ball, an ellipse across the flow and a roller against one that holds the inlet.
#[test]
fn films_in_short_boxes_are_those_of_a_wide_one() {
    let mut soft = ball(0.005, 0.02);
    soft.elastic.equivalent_modulus = 2e6;
    let mut wide = ball(5.0, 0.4);
    wide.form = Form::Ellipsoid { radius_x: 10e-3, radius_y: 40e-3, angle: 0.0 };
    let mut roller = ball(2e4, 0.5);
    roller.form = Form::Cylinder { radius: 10e-3 };
    for (name, scene) in [("soft", soft), ("ellipse", wide), ("roller", roller)] {
        let reference = solved(&in_box(&scene, -6.0, 6.0));
        for inlet in [-2.0, -3.0] {
            let short = solved(&in_box(&scene, inlet, 1.8));
            for (film, limit) in
                [(short.film.central, reference.film.central), (short.film.minimum, reference.film.minimum)]
            {
                assert!((film / limit - 1.0).abs() < 0.02, "{name} {inlet}: {film:e}, {limit:e}");
            }
            let edge = InletSpec::BoxEdge;
            let mut cut = in_box(&scene, inlet, 1.8);
            cut.lubricant = cut.lubricant.map(|oil| oil.with_inlet(edge));
            assert!(
                solved(&cut).film.central < 0.99 * reference.film.central,
                "{name} {inlet}: the box does not cut"
            );
        }
    }
}

/// Waves of 60 nm, a full film: the mean film of the rough contact in a short box is that in a wide one.
#[test]
fn rough_films_in_a_short_box_are_those_of_a_wide_one() {
    let scene = ball(20.0, 0.5);
    let k = 4.0 * std::f64::consts::PI / scene.hertz().unwrap().half_width_x;
    let [short, wide] = [(-2.25, 1.75), (-6.0, 6.0)].map(|(inlet, side)| {
        let scene = in_box(&scene, inlet, side);
        let waves =
            scene.grid().unwrap().nodes().map(|(x, y)| 60e-9 * (k * x).cos() * (k * y).cos()).collect();
        let solution = MixedLubricationSim::builder(scene).disc_heights(waves).solve().unwrap();
        assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
        solution.film.mean_central
    });
    assert!((short / wide - 1.0).abs() < 0.01, "{short:e}, {wide:e}");
}

#[test]
fn a_box_that_holds_the_inlet_is_solved_as_it_stands() {
    let scene = in_box(&ball(300.0, 0.02), -3.0, 2.0);
    let mut edge = scene.clone();
    edge.lubricant = edge.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
    let [flooded, edge] = [scene, edge].map(|scene| solved(&scene));
    assert_eq!(flooded.state, edge.state);
    assert_eq!(flooded.report, edge.report);
}

#[test]
fn multigrid_needs_ambient_pressure_at_the_edge() {
    let mut scene = in_box(&ball(5.0, 0.5), -3.0, 2.0);
    scene.solver.kind = SolverKind::Multigrid;
    let error = solve_contact(&scene).unwrap_err().to_string();
    assert!(error.contains("multigrid") && error.contains("lubricant.inlet"), "{error}");
    scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
    assert!(solve_contact(&scene).is_ok());
}

#[test]
fn accuracy_refuses_an_oil_that_begins_at_the_box() {
    let mut scene = ball(5.0, 0.5);
    scene.grid = GridSpec::Accuracy { accuracy: 0.05 };
    scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
    let error = solve_contact(&scene).unwrap_err().to_string();
    assert!(error.starts_with("lubricant.inlet") && error.contains("grid.accuracy"), "{error}");
}

/// The pressures of a solution at the edge of a smaller box, with its load outside, give the same film inside.
#[test]
fn edge_pressures_of_a_solution_reproduce_it() {
    let (radius, load) = (10e-3, 20.0);
    let half = (1.5 * load * radius / MODULUS).cbrt();
    let oil = Lubricant::new(
        Roelands::from_alpha(0.04, 20e-9, 0.6, 1.96e8).unwrap(),
        DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
    );
    let pressure = 1.5 * load / (std::f64::consts::PI * half * half);
    let solve = |grid: Grid, edge: Option<EdgePressure<'_>>| {
        let gap: Vec<f64> = grid.nodes().map(|(x, y)| (x * x + y * y) / (2.0 * radius)).collect();
        let mut body = HalfSpace::new(grid, MODULUS).unwrap();
        let mut problem = LubricatedContact::new(&gap, &mut body, load, (half, half), pressure)
            .with_lubricant(Some(&oil))
            .with_entrainment_speed(1.0)
            .with_reference_film(3e-7)
            .with_edge_pressure(edge);
        let mut state = ContactState::new(&grid);
        let report = NewtonKrylov::new().solve(&mut problem, &mut state, &StoppingRule::default()).unwrap();
        report.require_converged().unwrap();
        state
    };
    let cell = half / 8.0;
    let wide = Grid::from_edges(56, 48, [-40.0 * cell, 16.0 * cell], [-24.0 * cell, 24.0 * cell]).unwrap();
    let whole = solve(wide, None);
    let small = Grid::from_edges(34, 28, [-20.0 * cell, 14.0 * cell], [-14.0 * cell, 14.0 * cell]).unwrap();
    let at = |j: usize, i: usize| (j + 10) * 56 + i + 20;
    let field: Vec<f64> = (0..28 * 34).map(|k| whole.fluid_pressure[at(k / 34, k % 34)]).collect();
    let inside: f64 =
        (1..27).flat_map(|j| (1..33).map(move |i| (j, i))).map(|(j, i)| whole.pressure[at(j, i)]).sum();
    let load_outside = Some(load - inside * small.cell_area());
    let part = solve(small, Some(EdgePressure { field: &field, load_outside }));
    let (centre, same) = (14 * 34 + 20, at(14, 20));
    assert!(
        (part.film[centre] / whole.film[same] - 1.0).abs() < 2e-3,
        "{} {}",
        part.film[centre],
        whole.film[same]
    );

    let refused = |edge: EdgePressure<'_>| {
        let gap = vec![0.0; small.len()];
        let mut body = HalfSpace::new(small, MODULUS).unwrap();
        let problem = LubricatedContact::new(&gap, &mut body, load, (half, half), pressure);
        problem.with_edge_pressure(Some(edge)).validate().unwrap_err().to_string()
    };
    assert!(
        refused(EdgePressure { field: &[0.0; 3], load_outside: None }).starts_with("edge_pressure.field")
    );
    let negative = vec![-1.0; small.len()];
    assert!(
        refused(EdgePressure { field: &negative, load_outside: None }).starts_with("edge_pressure.field")
    );
    let too_much = EdgePressure { field: &field, load_outside: Some(2.0 * load) };
    assert!(refused(too_much).starts_with("edge_pressure.load_outside"));
}
