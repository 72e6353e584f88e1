//! Shear thinning of the flow by pressure.

use stribeck::lubricant::Rheology;
use stribeck::reynolds::ShearThinning;
use stribeck::sim::scene::{FlowThinning, FrictionSpec, GridSpec, InletSpec, Load, SolverKind};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::surface::Form;
use stribeck::{InputError, Status};

/// A steel ball at 0.5 GPa in a thick oil, sliding at half of the entrainment speed: a full film.
fn ball(n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.form = Form::Sphere { radius: 10e-3 };
    scene.load = Load::hertz_pressure(0.5e9);
    scene.motion.entrainment_speed = 1.0;
    scene.motion.slide_roll_ratio = 0.5;
    scene.lubricant =
        Some(scene.lubricant.unwrap().with_eta0(0.04).with_alpha(Some(20e-9)).with_inlet(InletSpec::BoxEdge));
    let a = scene.hertz().unwrap().half_width_x;
    scene.grid = GridSpec::Cells { nx: n, ny: n, x: [-4.5 * a, 1.5 * a], y: [-3.0 * a, 3.0 * a] };
    scene
}

/// The same with the effective viscosity of Eyring's fluid at `stress` \[Pa\].
fn thinned(scene: &Scene, stress: f64) -> Scene {
    with_flow(scene, FlowThinning::Effective, |friction| friction.eyring_stress = Some(stress))
}

/// The same with the fluid that `rheology` makes, thinned in the flow too.
fn with_flow(scene: &Scene, flow: FlowThinning, rheology: impl Fn(&mut FrictionSpec)) -> Scene {
    let mut scene = scene.clone();
    rheology(&mut scene.friction);
    scene.friction.flow_thinning = Some(flow);
    scene
}

fn carreau(exponent: f64) -> impl Fn(&mut FrictionSpec) {
    move |friction| (friction.carreau_stress, friction.carreau_exponent) = (Some(5e6), Some(exponent))
}

const FLOWS: [FlowThinning; 2] = [FlowThinning::Effective, FlowThinning::Directional];

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
fn default_shear_thinning_affects_friction_only() {
    let scene = ball(64);
    let mut friction = scene.clone();
    friction.friction.eyring_stress = Some(5e6);
    let (newtonian, eyring) = (solve(&scene), solve(&friction));
    assert_eq!(newtonian.state, eyring.state);
    assert!(eyring.friction.coefficient < newtonian.friction.coefficient);
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
    let mut smooth = Scene::azam_2019(64);
    smooth.roughness = Default::default();
    smooth.plastic = None;
    smooth.motion.entrainment_speed = 10.0;
    smooth.motion.slide_roll_ratio = 0.5;
    smooth.lubricant.as_mut().unwrap().inlet = InletSpec::BoxEdge;
    let eyring = |friction: &mut FrictionSpec| friction.eyring_stress = Some(5e6);
    for flow in FLOWS {
        for scene in [with_flow(&smooth, flow, eyring), with_flow(&smooth, flow, carreau(0.5))] {
            let films =
                [SolverKind::NewtonKrylov, SolverKind::Multigrid, SolverKind::SemiSystem].map(|kind| {
                    let mut scene = scene.clone();
                    scene.solver.kind = kind;
                    solve(&scene).film.central
                });
            for film in films {
                assert!((film / films[0] - 1.0).abs() < 1e-5, "{films:?}, {flow:?}");
            }
        }
    }
}

/// With an exponent of one, and without sliding, every flow is Newtonian to the last bit.
#[test]
fn newtonian_limits_are_exact() {
    let scene = ball(32);
    let newtonian = solve(&scene);
    for flow in FLOWS {
        assert_eq!(solve(&with_flow(&scene, flow, carreau(1.0))).state, newtonian.state, "{flow:?}");
        let mut rolling = with_flow(&scene, flow, carreau(0.3));
        rolling.motion.slide_roll_ratio = 0.0;
        assert_eq!(solve(&rolling).state, newtonian.state, "{flow:?}");
        let hardly = with_flow(&scene, flow, |friction| friction.eyring_stress = Some(1e15));
        let film = solve(&hardly).film.central / newtonian.film.central;
        assert!((film - 1.0).abs() < 1e-9, "{film}, {flow:?}");
    }
}

/// Where sliding thins the oil of the inlet, less viscosity along the flow lets more of it back out; where it
/// does not, the film is that of the effective viscosity.
#[test]
fn directional_films_are_thinner_where_the_inlet_is_thinned() {
    let ratio = |stress: f64| {
        let eyring = |friction: &mut FrictionSpec| friction.eyring_stress = Some(stress);
        let [effective, directional] =
            FLOWS.map(|flow| solve(&with_flow(&ball(64), flow, eyring)).film.central);
        println!("{stress:e} Pa: directional {:.4} of effective", directional / effective);
        directional / effective
    };
    assert!((ratio(1e7) - 1.0).abs() < 1e-3);
    let [mild, strong, strongest] = [1e6, 5e5, 2e5].map(ratio);
    assert!(1.0 > mild && mild > strong && strong > strongest, "{mild}, {strong}, {strongest}");
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
#[ignore = "slow"]
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
            for (stress, flow) in [1e7, 2e6].into_iter().flat_map(|stress| FLOWS.map(|flow| (stress, flow))) {
                let scene = with_flow(&scene, flow, |friction| friction.eyring_stress = Some(stress));
                let eyring = solve(&scene);
                println!(
                    "seed {seed}, slide-roll {ratio}, {stress:e} Pa, {flow:?}: load ratio {:.4} after {:.4}, {} after {} steps",
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
    for flow in FLOWS {
        let error = solve_contact(&with_flow(&ball(32), flow, |_| ())).unwrap_err().to_string();
        assert!(error.contains("friction.flow_thinning") && error.contains("eyring_stress"), "{error}");
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let eyring = |friction: &mut FrictionSpec| friction.eyring_stress = Some(bad);
            let error = solve_contact(&with_flow(&ball(32), flow, eyring)).unwrap_err().to_string();
            assert!(error.contains("friction.eyring_stress"), "{error}");
        }
        for bad in [0.0, 1.1, f64::NAN] {
            let error = solve_contact(&with_flow(&ball(32), flow, carreau(bad))).unwrap_err().to_string();
            assert!(error.contains("friction.carreau_exponent"), "{error}");
        }
    }
    for bad in [-0.1, f64::INFINITY, f64::NAN] {
        let error = ShearThinning::new(Rheology::eyring(5e6).unwrap(), bad).unwrap_err();
        let field = "shear_thinning.sliding_speed";
        assert!(matches!(&error, InputError::Value { field: named, .. } if named == field), "{error}");
    }
}

/// Stresses and speeds at the ends of their ranges neither panic nor end as converged with numbers that are
/// none.
#[test]
fn absurd_values_end_in_finite_numbers() {
    let values = [(101.0, 0.5), (1e300, 0.5), (101.0, 2.0), (5e6, 1e-300)];
    for ((stress, ratio), flow) in values.into_iter().flat_map(|value| FLOWS.map(|flow| (value, flow))) {
        let eyring = |friction: &mut FrictionSpec| friction.eyring_stress = Some(stress);
        let steep = |friction: &mut FrictionSpec| {
            (friction.carreau_stress, friction.carreau_exponent) = (Some(stress), Some(1e-300));
        };
        for mut scene in [with_flow(&ball(32), flow, eyring), with_flow(&ball(32), flow, steep)] {
            scene.motion.slide_roll_ratio = ratio;
            scene.solver.max_iterations = 30;
            let solution = solve_contact(&scene).unwrap();
            assert!(
                solution.state.pressure.iter().all(|p| p.is_finite()),
                "{stress:e}: {:?}",
                solution.report
            );
            assert!(solution.state.film.iter().all(|h| h.is_finite()), "{stress:e}: {:?}", solution.report);
        }
    }
}
