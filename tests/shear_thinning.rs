//! Eyring shear thinning of the flow by pressure.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    ContactSolver, ContactState, LubricatedContact, NewtonKrylov, ShearThinning, StoppingRule,
};
use stribeck::sim::scene::{GridSpec, Load, SolverKind};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::surface::Form;
use stribeck::{Grid, InputError, Status};

/// A steel ball at 0.5 GPa in a thick oil, sliding at half of the entrainment speed: a full film.
fn ball(n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.form = Form::Sphere { radius: 10e-3 };
    scene.load = Load::hertz_pressure(0.5e9);
    scene.motion.entrainment_speed = 1.0;
    scene.motion.slide_roll_ratio = 0.5;
    scene.lubricant = Some(scene.lubricant.unwrap().with_eta0(0.04).with_alpha(Some(20e-9)));
    let a = scene.hertz().unwrap().a_x;
    scene.grid = GridSpec::Cells { nx: n, ny: n, x: [-4.5 * a, 1.5 * a], y: [-3.0 * a, 3.0 * a] };
    scene
}

/// The same with shear thinning at `stress` \[Pa\].
fn thinned(scene: &Scene, stress: f64) -> Scene {
    let mut scene = scene.clone();
    (scene.friction.eyring_stress, scene.friction.eyring_in_reynolds) = (Some(stress), true);
    scene
}

fn solve(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    solution
}

#[test]
fn without_sliding_the_fluid_is_newtonian_to_the_last_bit() {
    let mut scene = ball(64);
    scene.motion.slide_roll_ratio = 0.0;
    for kind in [SolverKind::Multigrid, SolverKind::NewtonKrylov] {
        scene.solver.kind = kind;
        let (newtonian, eyring) = (solve(&scene), solve(&thinned(&scene, 1e6)));
        assert_eq!(newtonian.state, eyring.state, "{kind:?}");
        assert_eq!(newtonian.report, eyring.report);
    }
}

#[test]
fn without_being_asked_for_it_thins_friction_alone() {
    let scene = ball(64);
    let mut friction = scene.clone();
    friction.friction.eyring_stress = Some(5e6);
    let (newtonian, eyring) = (solve(&scene), solve(&friction));
    assert_eq!(newtonian.state, eyring.state);
    assert!(eyring.friction_coefficient < newtonian.friction_coefficient);
}

/// The minimum, at the rim, first grows by 0.2 % as the constriction eases, on finer grids too.
#[test]
fn films_fall_with_the_eyring_stress() {
    for kind in [SolverKind::Multigrid, SolverKind::NewtonKrylov] {
        let mut scene = ball(64);
        scene.solver.kind = kind;
        let newtonian = solve(&scene).film;
        // A relative change of the viscosity by x^2 / 6.
        let close = solve(&thinned(&scene, 1e15)).film;
        assert!((close.central / newtonian.central - 1.0).abs() < 1e-9, "{kind:?}: {close:?}");
        let mut last = newtonian;
        for stress in [1e8, 2e7, 1e7, 5e6, 2e6, 1e6] {
            let film = solve(&thinned(&scene, stress)).film;
            println!("{kind:?} at {stress:e} Pa: {:.4} of Newtonian", film.central / newtonian.central);
            assert!(film.central < last.central, "{kind:?} at {stress:e}: {film:?} after {last:?}");
            assert!(film.mean_central < last.mean_central, "{kind:?} at {stress:e}: {film:?}, {last:?}");
            assert!(film.minimum < 1.003 * newtonian.minimum, "{kind:?} at {stress:e}: {film:?}");
            last = film;
        }
        assert!(last.minimum < newtonian.minimum, "{kind:?}: {last:?}");
    }
}

#[test]
fn solvers_agree() {
    let mut scene = Scene::azam_2019(64);
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.motion.entrainment_speed = 10.0;
    scene.motion.slide_roll_ratio = 0.5;
    let scene = thinned(&scene, 5e6);
    let films = [SolverKind::NewtonKrylov, SolverKind::Multigrid, SolverKind::SemiSystem].map(|kind| {
        let mut scene = scene.clone();
        scene.solver.kind = kind;
        solve(&scene).film.central
    });
    for film in films {
        assert!((film / films[0] - 1.0).abs() < 1e-5, "{films:?}");
    }
}

#[test]
fn both_pressure_flows_tend_to_one_film() {
    use stribeck::reynolds::{FaceMobility, Scheme};
    let difference = |n: usize| {
        let films = [FaceMobility::Arithmetic, FaceMobility::ReducedPressure].map(|mobility| {
            let mut scene = thinned(&ball(n), 5e6);
            scene.solver.scheme = Some(Scheme::SecondOrder);
            scene.solver.face_mobility = Some(mobility);
            solve(&scene).film.central
        });
        (films[0] / films[1] - 1.0).abs()
    };
    let (coarse, fine) = (difference(64), difference(128));
    println!("films differ by {coarse:.2e} on 64 and {fine:.2e} on 128 cells");
    assert!(fine < 0.4 * coarse && fine < 0.02, "{coarse} {fine}");
}

#[test]
fn rough_scenes_converge() {
    for seed in 1..=4 {
        let mut scene = Scene::azam_2019(64);
        for (body, offset) in [(&mut scene.roughness.ball, 0), (&mut scene.roughness.disc, 50)] {
            if let stribeck::sim::scene::Roughness::Random(random) = body {
                random.seed = seed + offset;
            }
        }
        for ratio in [0.05, 0.5] {
            scene.motion.slide_roll_ratio = ratio;
            let newtonian = solve(&scene);
            for stress in [1e7, 2e6] {
                let eyring = solve(&thinned(&scene, stress));
                println!(
                    "seed {seed}, slide-roll {ratio}, {stress:e} Pa: load ratio {:.4} after {:.4}, {} after {} steps",
                    eyring.contact.load_ratio,
                    newtonian.contact.load_ratio,
                    eyring.report.work.iterations,
                    newtonian.report.work.iterations
                );
                assert!(eyring.contact.load_ratio > newtonian.contact.load_ratio);
            }
        }
    }
}

#[test]
fn bad_input_is_named() {
    let mut scene = ball(32);
    scene.friction.eyring_in_reynolds = true;
    let error = solve_contact(&scene).unwrap_err().to_string();
    assert!(error.contains("friction.eyring_in_reynolds") && error.contains("eyring_stress"), "{error}");
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = solve_contact(&thinned(&scene, bad)).unwrap_err().to_string();
        assert!(error.contains("friction.eyring_stress"), "{error}");
    }
    let grid = Grid::centred(16, 16, 2e-5, 2e-5).unwrap();
    let gap: Vec<f64> = grid.nodes().map(|(x, y)| (x * x + y * y) / 0.02).collect();
    let oil = Lubricant::new(
        Roelands::new(0.04, 0.6, 1.96e8).unwrap(),
        DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
    );
    let good = ShearThinning { eyring_stress: 5e6, sliding_speed: 0.1 };
    for (thinning, field) in [
        (ShearThinning { eyring_stress: 0.0, ..good }, "shear_thinning.eyring_stress"),
        (ShearThinning { eyring_stress: f64::NAN, ..good }, "shear_thinning.eyring_stress"),
        (ShearThinning { sliding_speed: -0.1, ..good }, "shear_thinning.sliding_speed"),
        (ShearThinning { sliding_speed: f64::INFINITY, ..good }, "shear_thinning.sliding_speed"),
    ] {
        let mut body = HalfSpace::new(grid, 230e9).unwrap();
        let mut problem = LubricatedContact::new(&gap, &mut body, 1.0, (4e-5, 4e-5), 3e8)
            .with_lubricant(Some(&oil))
            .with_entrainment_speed(1.0)
            .with_scheme(Default::default())
            .with_shear_thinning(Some(thinning))
            .with_reference_film(1e-7);
        let error = problem.validate().unwrap_err();
        assert!(matches!(&error, InputError::Value { field: named, .. } if named == field), "{error}");
        let mut state = ContactState::new(&grid);
        assert!(NewtonKrylov::new().solve(&mut problem, &mut state, &StoppingRule::default()).is_err());
    }
}

/// Stresses and speeds at the ends of their ranges neither panic nor end as converged with numbers that are
/// none.
#[test]
fn absurd_values_end_in_finite_numbers() {
    for (stress, ratio) in [(1e-300, 0.5), (1e300, 0.5), (1e-3, 2.0), (5e6, 1e-300)] {
        let mut scene = thinned(&ball(32), stress);
        scene.motion.slide_roll_ratio = ratio;
        scene.solver.max_iterations = 30;
        let solution = solve_contact(&scene).unwrap();
        assert!(solution.state.pressure.iter().all(|p| p.is_finite()), "{stress:e}: {:?}", solution.report);
        assert!(solution.state.film.iter().all(|h| h.is_finite()), "{stress:e}: {:?}", solution.report);
    }
}
