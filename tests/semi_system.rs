//! The semi-system solver on mixed contacts: the answers of Newton's method, from line relaxations.

use stribeck::reynolds::{Cavitation, FaceMobility, Scheme};
use stribeck::sim::scene::{Roughness, SolverKind};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::{SolverId, Status};

/// The reference scene with composite roughness `rq`, its Gaussian roughness on `length`.
fn scene(n: usize, speed: f64, rq: f64, length: f64, hardness: Option<f64>) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.motion.entrainment_speed = speed;
    scene.plastic = hardness.map(|hardness| scene.plastic.unwrap().with_hardness(hardness));
    let random = |seed| Roughness::gaussian(rq / 2.0_f64.sqrt(), length, seed);
    scene.roughness.ball = random(1);
    scene.roughness.disc = random(2);
    scene
}

fn solve(scene: &Scene, kind: SolverKind) -> ContactSolution {
    let mut scene = scene.clone();
    scene.solver.kind = kind;
    let solution = solve_contact(&scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    assert!(solution.report.residual.max() <= scene.solver.tolerance, "{:?}", solution.report);
    solution
}

/// Solves by both methods; the results may differ within the tolerance.
fn compare(scene: &Scene) -> [ContactSolution; 2] {
    let both = [SolverKind::NewtonKrylov, SolverKind::SemiSystem].map(|kind| solve(scene, kind));
    let [newton, lines] = &both;
    assert_eq!(lines.report.solver, SolverId::SemiSystem);
    let fields = |solution: &ContactSolution| {
        [
            ("load ratio", solution.contact.load_ratio, 1.0),
            ("area ratio", solution.contact.area_ratio, 1.0),
            ("mean film", solution.state.film.iter().sum(), newton.state.film.iter().sum()),
            ("approach", solution.state.approach, newton.state.approach),
            ("plastic depth", solution.state.plastic_depth.iter().sum(), newton.state.film.iter().sum()),
        ]
    };
    for ((name, ours, scale), (_, theirs, _)) in fields(newton).into_iter().zip(fields(lines)) {
        assert!(((ours - theirs) / scale).abs() < 1e-4, "{name}: {ours:e} and {theirs:e}");
    }
    let work = lines.report.work;
    // All work is counted: line passes, and at least two convolutions per step.
    assert!(work.inner_iterations > work.iterations && work.convolutions > 2.0 * work.iterations as f64);
    both
}

#[test]
fn mixed_contacts_match_newtons_method() {
    for (speed, rq, length, hardness, ratio) in [
        (0.05, 60e-9, 10e-6, Some(6e9), 0.02..0.3),
        (0.2, 130e-9, 10e-6, Some(2e9), 0.05..0.5),
        (0.01, 130e-9, 40e-6, None, 0.1..0.5),
        (0.001, 20e-9, 10e-6, None, 0.9..1.0),
    ] {
        let [newton, _] = compare(&scene(64, speed, rq, length, hardness));
        let found = newton.contact.load_ratio;
        assert!(ratio.contains(&found), "load ratio {found} at {speed} m/s");
    }
}

#[test]
fn contacts_converge_for_every_flow_law() {
    for (scheme, face_mobility, cavitation) in [
        (Scheme::FirstOrder, FaceMobility::ReducedPressure, Cavitation::Reynolds),
        (Scheme::Limited, FaceMobility::Wedge, Cavitation::MassConserving),
    ] {
        let mut scene = scene(64, 0.1, 60e-9, 10e-6, Some(6e9));
        scene.solver.scheme = Some(scheme);
        scene.solver.face_mobility = Some(face_mobility);
        scene.solver.cavitation = Some(cavitation);
        compare(&scene);
    }
}

#[test]
fn too_few_iterations_return_a_status() {
    let mut scene = scene(64, 0.1, 130e-9, 10e-6, Some(6e9));
    scene.solver.kind = SolverKind::SemiSystem;
    scene.solver.max_iterations = 5;
    let solution = solve_contact(&scene).unwrap();
    assert_eq!(solution.report.status, Status::MaxIterations);
    assert!(solution.report.residual.max() > scene.solver.tolerance, "{:?}", solution.report);
    assert_eq!(solution.report.work.iterations, 5);
}
