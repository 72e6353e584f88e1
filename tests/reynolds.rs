//! The lubricated solvers: known films, agreement between methods, limits, and failures that must stay typed.

use stribeck::reynolds::{Cavitation, ContactDefinition, FaceMobility, Scheme};
use stribeck::sim::scene::{Roughness, SolverKind};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::{SolverId, Status};

/// The reference scene without roughness and plastic limit.
fn smooth(n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.roughness = Default::default();
    scene.plastic = None;
    scene
}

fn solve(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    solution.report.require_converged().unwrap();
    assert!(solution.report.residual.max() <= scene.solver.tolerance, "{:?}", solution.report);
    solution
}

/// Load by summation, film and pressure bounds, contact only where the film is the cut-off.
fn check_consistency(scene: &Scene, solution: &ContactSolution) {
    let state = &solution.state;
    let inside: f64 = state.pressure.iter().sum::<f64>() * solution.grid.cell_area();
    let load = inside + solution.pressure.load_outside;
    assert!((load / solution.hertz.force - 1.0).abs() < 1e-6, "load {load}");
    let limit = scene.plastic.map_or(f64::INFINITY, |plastic| plastic.hardness);
    let cutoff = scene.solver.film_cutoff;
    for k in 0..state.pressure.len() {
        assert!((0.0..=limit).contains(&state.pressure[k]), "node {k}: {}", state.pressure[k]);
        assert!((0.0..=limit).contains(&state.fluid_pressure[k]), "node {k}");
        assert!(state.film[k] > cutoff - 0.1e-9, "node {k}: film {}", state.film[k]);
        if state.in_contact[k] {
            assert!((state.film[k] - cutoff).abs() < 1e-11, "contact node {k}: film {}", state.film[k]);
        } else {
            let solid = state.pressure[k] - state.fluid_pressure[k];
            assert!(solid.abs() < 1e-3, "open node {k} carries solid pressure {solid}");
        }
    }
}

#[test]
#[ignore = "slow"]
fn smooth_reference_scene_has_the_known_film() {
    // 7.56 nm in the limit of fine meshes, by an independent program.
    let [coarse, fine] = [128, 256].map(|n| solve(&smooth(n)).film.central * 1e9);
    assert!((coarse / 7.56 - 1.0).abs() < 0.02 && (fine / 7.56 - 1.0).abs() < 0.01, "{coarse} and {fine} nm");
    let scene = smooth(256);
    let solution = solve(&scene);
    let peak = solution.pressure.max / 1.15e9;
    assert!((peak - 1.0).abs() < 0.01, "peak {peak} of the Hertz pressure");
    check_consistency(&scene, &solution);
}

#[test]
fn semi_system_and_newton_agree_on_full_films() {
    for speed in [1.0, 10.0] {
        let mut scene = smooth(64);
        scene.motion.entrainment_speed = speed;
        scene.solver.kind = SolverKind::NewtonKrylov;
        let newton = solve(&scene);
        scene.solver.kind = SolverKind::SemiSystem;
        let sweeps = solve(&scene);
        assert_eq!(sweeps.report.solver, SolverId::SemiSystem);
        let difference = sweeps.film.central / newton.film.central - 1.0;
        assert!(difference.abs() < 1e-5, "central film differs by {difference:e} at {speed} m/s");
        let difference = sweeps.state.approach / newton.state.approach - 1.0;
        assert!(difference.abs() < 1e-6, "approach differs by {difference:e} at {speed} m/s");
        check_consistency(&scene, &newton);
        check_consistency(&scene, &sweeps);
    }
}

#[test]
fn textbook_coefficients_fail_and_say_so() {
    let mut scene = smooth(64);
    scene.solver.kind = SolverKind::SemiSystem;
    scene.solver.contact = ContactDefinition::UnifiedReynolds;
    scene.solver.stiffness = 1.0;
    scene.solver.max_iterations = 3000;
    let solution = solve_contact(&scene).unwrap();
    assert_ne!(solution.report.status, Status::Converged, "{:?}", solution.report);
    assert!(solution.report.residual.max() > scene.solver.tolerance);
}

#[test]
#[ignore = "slow"]
fn rough_scenes_converge() {
    let mut work = Vec::new();
    for hardness in [6e9, 2e9] {
        for seed in 1..=8 {
            let mut scene = Scene::azam_2019(64);
            scene.plastic.as_mut().unwrap().hardness = hardness;
            for (body, offset) in [(&mut scene.roughness.ball, 0), (&mut scene.roughness.disc, 50)] {
                if let Roughness::Random(random) = body {
                    random.seed = seed + offset;
                }
            }
            let solution = solve(&scene);
            check_consistency(&scene, &solution);
            let ratio = solution.contact.load_ratio;
            assert!(ratio > 0.02 && ratio < 0.5, "load ratio {ratio}, seed {seed}, hardness {hardness}");
            work.push(solution.report.work.convolutions);
        }
    }
    work.sort_by(f64::total_cmp);
    assert!(work[work.len() - 1] < 12.0 * work[work.len() / 2], "{work:?}");
}

/// Without roughness and away from the boundary, both pressure flows and both schemes tend to one film; at 10
/// m/s the film is thick against the cells and they are close already.
#[test]
fn discretisations_agree_where_the_mesh_resolves_the_film() {
    let mut films = Vec::new();
    for scheme in [Scheme::FirstOrder, Scheme::SecondOrder] {
        for mobility in [FaceMobility::Arithmetic, FaceMobility::ReducedPressure] {
            let mut scene = smooth(128);
            scene.motion.entrainment_speed = 10.0;
            scene.solver.scheme = Some(scheme);
            scene.solver.face_mobility = Some(mobility);
            let solution = solve(&scene);
            check_consistency(&scene, &solution);
            films.push(solution.film.central);
        }
    }
    let spread = |a: f64, b: f64| (a / b - 1.0).abs();
    assert!(spread(films[2], films[3]) < 0.02, "second order: {films:?}");
    assert!(spread(films[0], films[2]) < 0.1, "first and second order: {films:?}");
    assert!(films[0] > films[2], "first-order entrainment is too thick: {films:?}");
}

#[test]
fn rough_smooth_and_published_scenes_have_their_discretisations() {
    let mut scene = Scene::azam_2019(64);
    for (scene, mobility) in [(&scene, FaceMobility::Inlet), (&smooth(64), FaceMobility::Wedge)] {
        assert_eq!((scene.scheme(), scene.face_mobility()), (Scheme::Limited, mobility));
        assert_eq!(scene.cavitation(), Cavitation::MassConserving);
    }
    scene.solver.contact = ContactDefinition::UnifiedReynolds;
    assert_eq!((scene.scheme(), scene.face_mobility()), (Scheme::FirstOrder, FaceMobility::Arithmetic));
    assert_eq!(scene.cavitation(), Cavitation::Reynolds);
    (scene.solver.scheme, scene.solver.face_mobility) =
        (Some(Scheme::SecondOrder), Some(FaceMobility::Wedge));
    assert_eq!((scene.scheme(), scene.face_mobility()), (Scheme::SecondOrder, FaceMobility::Wedge));
}

#[test]
fn slow_rough_contact_tends_to_the_dry_one() {
    let mut scene = Scene::azam_2019(64);
    scene.solver.kind = SolverKind::Dry;
    let dry = solve(&scene);
    scene.solver.kind = SolverKind::Auto;
    let mut previous = 0.0;
    for speed in [1e-2, 1e-3, 1e-4] {
        scene.motion.entrainment_speed = speed;
        let wet = solve(&scene);
        assert!(wet.contact.load_ratio > previous, "load ratio at {speed} m/s");
        previous = wet.contact.load_ratio;
    }
    scene.motion.entrainment_speed = 1e-4;
    let wet = solve(&scene);
    assert!(wet.contact.load_ratio > 0.999, "load ratio {}", wet.contact.load_ratio);
    assert!((wet.contact.area_ratio - dry.contact.area_ratio).abs() < 0.005);
    assert!((wet.pressure.max / dry.pressure.max - 1.0).abs() < 0.01);
    assert!((wet.film.mean_central - dry.film.mean_central).abs() < 1.5 * scene.solver.film_cutoff);
}

#[test]
fn one_step_is_not_called_converged() {
    let mut scene = Scene::azam_2019(32);
    scene.solver.kind = SolverKind::NewtonKrylov;
    scene.solver.max_iterations = 1;
    let solution = solve_contact(&scene).unwrap();
    assert_eq!(solution.report.status, Status::MaxIterations);
    let error = solution.report.require_converged().unwrap_err();
    assert!(error.to_string().contains("max_iterations"), "{error}");
}

#[test]
fn cold_solves_do_not_depend_on_what_the_solver_did_before() {
    use stribeck::elastic::HalfSpace;
    use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
    use stribeck::reynolds::{
        ContactSolver, ContactState, LubricatedContact, NewtonKrylov, Scheme, StoppingRule,
    };
    let scene = Scene::azam_2019(48);
    let (grid, hertz) = (scene.grid().unwrap(), scene.hertz().unwrap());
    let reference = solve_contact(&scene).unwrap();
    let oil = Lubricant::new(
        Roelands::new(0.004, 0.68, 1.96e8).unwrap(),
        DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
    );
    let mut body = HalfSpace::new(grid, scene.elastic.equivalent_modulus).unwrap();
    let limit = vec![6e9; grid.len()];
    let mut problem = LubricatedContact::new(
        &reference.gap,
        &mut body,
        hertz.force,
        (hertz.half_width_x, hertz.half_width_y),
        hertz.pressure,
    )
    .with_lubricant(Some(&oil))
    .with_entrainment_speed(0.1)
    .with_pressure_limit(Some(&limit))
    .with_scheme(Scheme::FirstOrder);
    let mut solver = NewtonKrylov::new();
    let mut states = [ContactState::new(&grid), ContactState::new(&grid)];
    for state in &mut states {
        let report = solver.solve(&mut problem, state, &StoppingRule::default()).unwrap();
        assert_eq!(report.status, Status::Converged);
    }
    assert_eq!(states[0], states[1]);
    // A converged state is its own solution.
    let report = solver.solve(&mut problem, &mut states[1], &StoppingRule::default()).unwrap();
    assert_eq!((report.status, report.work.iterations), (Status::Converged, 0));
}

#[test]
fn loads_beyond_the_limit_are_refused_with_the_largest_one() {
    let mut scene = Scene::azam_2019(32);
    scene.roughness.ball = Roughness::None;
    scene.plastic = Some(stribeck::sim::scene::PlasticSpec::new(2e8));
    let error = solve_contact(&scene).unwrap_err().to_string();
    assert!(error.contains("plastic.hardness") && error.contains("less than"), "{error}");
}
