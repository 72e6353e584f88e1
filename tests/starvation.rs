//! Contacts whose inlet is supplied with less than fills it.

use stribeck::lubricant::{DensityLaw, DowsonHigginson};
use stribeck::reynolds::{Cavitation, Scheme};
use stribeck::sim::scene::{GridSpec, Load, SolverKind};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::surface::Form;
use stribeck::{SolverId, Status};

/// A smooth ball.
fn ball() -> Scene {
    let mut scene = Scene::azam_2019(64);
    (scene.roughness, scene.plastic) = (Default::default(), None);
    scene.solver.cavitation = Some(Cavitation::MassConserving);
    scene
}

/// A smooth roller.
fn roller() -> Scene {
    let mut scene = ball();
    scene.form = Form::Cylinder { radius: 0.01 };
    scene.load = Load::hertz_pressure(0.6e9);
    scene.motion.entrainment_speed = 1.0;
    let a = scene.hertz().unwrap().half_width_x;
    scene.grid = GridSpec::Row { nx: 256, x: [-4.0 * a, 2.0 * a] };
    scene
}

fn supplied(mut scene: Scene, film: f64) -> Scene {
    scene.lubricant.as_mut().unwrap().supplied_film = Some(film);
    scene
}

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    solution.report.require_converged().unwrap();
    let flow = solution.flow.unwrap();
    assert!(flow.imbalance <= scene.solver.tolerance, "{flow:?}");
    solution
}

/// The central film at ambient density.
fn central_mass(scene: &Scene, solution: &ContactSolution) -> f64 {
    let oil = scene.lubricant.unwrap();
    let density = DowsonHigginson::new(oil.density_a, oil.density_b).unwrap();
    density.ratio(solution.pressure.central) * solution.film.central
}

#[test]
fn a_film_falls_from_the_flooded_one_to_what_is_supplied() {
    for (scene, narrow) in [(ball(), 4e-9), (roller(), 50e-9)] {
        let flooded = solved(&scene);
        let thick = solved(&supplied(scene.clone(), 1e-2));
        assert!((thick.film.central / flooded.film.central - 1.0).abs() < 1e-5, "more than the inlet holds");
        let whole = central_mass(&scene, &flooded);
        let mut last = whole * (1.0 + 1e-6);
        for over_film in [100.0, 5.0, 2.0, 1.2, 0.8] {
            let supply = over_film * whole;
            let solution = solved(&supplied(scene.clone(), supply));
            let mass = central_mass(&scene, &solution);
            assert!(mass < last, "{mass:e} after {last:e} at {supply:e}");
            assert!(mass < supply * (1.0 + 1e-3), "{mass:e} of a supply of {supply:e}");
            last = mass;
        }
        let film = solved(&supplied(scene.clone(), 100.0 * whole)).film.central;
        assert!(
            (film / flooded.film.central - 1.0).abs() < 0.01,
            "{film:e}, flooded {:e}",
            flooded.film.central
        );
        // A film so thin is that of the inlet, compressed.
        let mass = central_mass(&scene, &solved(&supplied(scene.clone(), narrow)));
        assert!((mass / narrow - 1.0).abs() < 2e-3, "{mass:e} of {narrow:e}");
    }
}

/// Without pressure flow every row carries its own supply; beside the contact all rows together do.
#[test]
fn supplied_flow_equals_the_outflow() {
    let supply = 20e-9;
    let mut scene = supplied(ball(), supply);
    scene.solver.scheme = Some(Scheme::FirstOrder);
    let solution = solved(&scene);
    let (grid, state) = (solution.grid, &solution.state);
    let speed = scene.motion.entrainment_speed;
    let (mut dry_rows, mut leaving) = (0, 0.0);
    for j in 1..grid.ny() - 1 {
        let row = j * grid.nx()..(j + 1) * grid.nx();
        let out = state.mass[row.end - 2];
        leaving += speed * grid.dy() * out;
        // Nor is any pressure in the rows beside it.
        let beside = row.start - grid.nx()..row.end + grid.nx();
        if state.fluid_pressure[beside].iter().all(|p| *p <= 0.0) {
            dry_rows += 1;
            assert!((out / supply - 1.0).abs() < 1e-12, "{out:e} in row {j}");
        }
        assert!((state.theta[row.start] - supply / state.film[row.start]).abs() < 1e-12, "row {j}");
    }
    assert!(dry_rows > 10, "{dry_rows}");
    let flow = solution.flow.unwrap();
    let rows = (grid.ny() - 2) as f64;
    assert!((flow.inflow / (speed * rows * grid.dy() * supply) - 1.0).abs() < 1e-12, "{flow:?}");
    assert!((leaving / flow.outflow - 1.0).abs() < 1e-12, "{leaving:e}, {flow:?}");
}

/// The cycles of multigrid and the lines of the semi-system know too little of the fluid that a starved inlet
/// hands on from cell to cell.
#[test]
#[ignore = "slow"]
fn solvers_agree_or_end_as_stalled() {
    use SolverKind::{Auto, Multigrid, NewtonKrylov, SemiSystem};
    let solve = |supply: f64, kind: SolverKind| {
        let mut scene = supplied(ball(), supply);
        scene.solver.kind = kind;
        if [Auto, NewtonKrylov].contains(&kind) { solved(&scene) } else { solve_contact(&scene).unwrap() }
    };
    for (supply, able, unable) in [
        (1e-3, vec![SemiSystem, Multigrid], vec![]),
        (1e-7, vec![SemiSystem], vec![]),
        (20e-9, vec![], vec![SemiSystem, Multigrid]),
    ] {
        let film = solve(supply, NewtonKrylov).film.central;
        let auto = solve(supply, Auto);
        assert_eq!(auto.report.solver, SolverId::NewtonKrylov);
        assert!((auto.film.central / film - 1.0).abs() < 1e-5, "{:e} and {film:e}", auto.film.central);
        for kind in able {
            let solution = solve(supply, kind);
            assert_eq!(solution.report.status, Status::Converged, "{kind:?} at {supply:e}");
            assert!((solution.film.central / film - 1.0).abs() < 1e-5, "{kind:?} at {supply:e}");
        }
        for kind in unable {
            let status = solve(supply, kind).report.status;
            // Multigrid says that the mesh is too coarse where its best state touches.
            let touches = kind == Multigrid && status == Status::MeshTooCoarse;
            assert!(touches || status == Status::Stalled, "{kind:?} at {supply:e}: {status:?}");
        }
    }
}

#[test]
fn supplies_that_do_not_fit_are_refused() {
    for (film, text) in [(0.0, "0"), (-1e-8, "-1e-8"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let error = solve_contact(&supplied(ball(), film)).unwrap_err().to_string();
        assert!(error.contains(&format!("lubricant.supplied_film = {text}")), "{error}");
    }
    let mut scene = supplied(ball(), 1e-8);
    scene.solver.cavitation = Some(Cavitation::Reynolds);
    let error = solve_contact(&scene).unwrap_err().to_string();
    assert!(error.contains("lubricant.supplied_film = 1e-8") && error.contains("mass_conserving"), "{error}");
    // A dry contact needs no supply.
    scene.solver.kind = SolverKind::Dry;
    assert!(solve_contact(&scene).is_ok());
}

#[test]
#[cfg(feature = "serde")]
fn scenes_keep_their_supply() {
    let scene = supplied(ball(), 2e-8);
    let text = scene.to_toml().unwrap();
    assert_eq!(Scene::from_toml(&text).unwrap(), scene);
    assert!(!ball().to_toml().unwrap().contains("supplied_film"));
}
