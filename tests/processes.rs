//! Processes in the simulation: yielding and reloading, hardening, wear, friction, motion, length of steps.
#![expect(clippy::float_cmp, reason = "tests")]

use std::f64::consts::PI;
use std::ops::ControlFlow;

use stribeck::Status;
use stribeck::elastic::{DeformationModel, HalfSpace};
use stribeck::plastic::{ElasticPerfectlyPlastic, IsotropicHardening};
use stribeck::reynolds::{
    ContactSolver, ContactState, Dry, FaceMobility, LubricatedContact, Scheme, StoppingRule,
};
use stribeck::sim::scene::{Flash, SolverKind, WearLawSpec};
use stribeck::sim::{MixedLubricationSim, Scene, StepControl, StepRecord, solve_contact};
use stribeck::surface::{Advected, Fixed};

/// Rough, dry and quick.
fn dry(n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.solver.kind = SolverKind::Dry;
    scene
}

fn run_until(sim: &mut MixedLubricationSim, end: f64, control: StepControl) -> Vec<StepRecord> {
    let mut records = Vec::new();
    sim.run_until(end, &control, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        records.push(record.clone());
        ControlFlow::Continue(())
    })
    .unwrap();
    records
}

/// Dry contact of `gap` under `load` with a uniform `limit`.
fn press(gap: &[f64], body: &mut HalfSpace, load: f64, limit: f64) -> ContactState {
    let grid = body.grid();
    let limit = vec![limit; grid.len()];
    let mut state = ContactState::new(&grid);
    let mut problem = LubricatedContact::new(gap, body, load, (149.83e-6, 149.83e-6), 1.15e9)
        .with_pressure_limit(Some(&limit))
        .with_scheme(Scheme::default())
        .with_face_mobility(FaceMobility::default());
    let rule = StoppingRule::default().with_tolerance(1e-9);
    let report = Dry::new().solve(&mut problem, &mut state, &rule).unwrap();
    assert_eq!(report.status, Status::Converged, "{report:?}");
    state
}

#[test]
fn reloading_below_the_past_load_is_elastic() {
    let scene = dry(64);
    let (grid, hertz, hardness) = (scene.grid().unwrap(), scene.hertz().unwrap(), 3e9);
    let mut body = HalfSpace::new(grid, 229.67e9).unwrap();
    let gap = solve_contact(&scene).unwrap().gap;
    let first = press(&gap, &mut body, hertz.force, hardness);
    let yielded = first.plastic_depth.iter().filter(|d| **d > 0.0).count();
    assert!(yielded > 50, "{yielded} nodes");
    // A contact that nowhere exceeds the hardness has at least this area.
    let area = first.pressure.iter().filter(|p| **p > 0.0).count() as f64 * grid.cell_area();
    assert!(area >= hertz.force / hardness, "{area}");
    let flattened: Vec<f64> = gap.iter().zip(&first.plastic_depth).map(|(g, d)| g + d).collect();
    for share in [0.3, 0.7, 0.95] {
        let again = press(&flattened, &mut body, share * hertz.force, hardness);
        let most = again.plastic_depth.iter().copied().fold(0.0, f64::max);
        assert_eq!(most, 0.0, "at {share} of the load");
        assert!(again.pressure.iter().all(|p| *p <= hardness), "at {share} of the load");
    }
    // The same load finds the same contact, and a higher one yields again.
    let same = press(&flattened, &mut body, hertz.force, hardness);
    let most = same.plastic_depth.iter().copied().fold(0.0, f64::max);
    assert!(most < 1e-13, "{most}");
    assert!((same.approach / first.approach - 1.0).abs() < 1e-6);
    let more = press(&flattened, &mut body, 1.1 * hertz.force, hardness);
    assert!(more.plastic_depth.iter().copied().fold(0.0, f64::max) > 1e-10);
}

#[test]
fn contact_area_is_never_below_that_of_full_yielding() {
    for hardness in [2e9, 6e9] {
        let mut scene = dry(64);
        scene.plastic.as_mut().unwrap().hardness = hardness;
        let solution = solve_contact(&scene).unwrap();
        solution.report.require_converged().unwrap();
        let hertz = solution.hertz;
        let touching = solution.state.pressure.iter().filter(|p| **p > 0.0).count() as f64;
        let ratio = touching * solution.grid.cell_area() / (PI * hertz.half_width_x * hertz.half_width_y);
        let bound = hertz.force / (hardness * PI * hertz.half_width_x * hertz.half_width_y);
        println!("{hardness:e} Pa: area {ratio:.3}, bound {bound:.3}");
        assert!(ratio >= bound);
    }
}

#[test]
fn a_hardening_contact_meets_its_law_and_then_stays_elastic() {
    let (hardness, modulus) = (3e9, 1e16);
    let mut scene = dry(48);
    scene.wear = None;
    scene.plastic.as_mut().unwrap().hardness = hardness;
    let perfect = ElasticPerfectlyPlastic::uniform(hardness).unwrap();
    let hardening = IsotropicHardening::new(perfect.clone(), modulus).unwrap();
    let still = |scene: &Scene| MixedLubricationSim::builder(scene.clone()).motion(Fixed);
    let mut soft = still(&scene).plasticity(perfect).build().unwrap();
    let mut hard = still(&scene).plasticity(hardening).build().unwrap();
    let (soft_first, hard_first) = (soft.step(1.0).unwrap(), hard.step(1.0).unwrap());
    assert!(hard_first.plastic.volume > 0.0);
    assert!(hard_first.plastic.volume < 0.9 * soft_first.plastic.volume, "{hard_first:?} {soft_first:?}");
    assert!(hard_first.pressure.max > 1.02 * hardness, "{}", hard_first.pressure.max);
    let yielded = hard.state().plastic_depth.iter().filter(|depth| **depth > 1e-12).count();
    assert!(hard_first.contact.plastic_area > 0.99 * yielded as f64 * hard.grid().cell_area());
    let [ball, disc] = hard.bodies();
    for k in 0..hard.grid().len() {
        let depth = ball.plastic_depth()[k];
        // Equally hard bodies share the depth.
        assert_eq!(depth, disc.plastic_depth()[k]);
        let limit = hardness + modulus * depth;
        let p = hard.state().pressure[k];
        assert!(p <= limit * 1.002, "node {k}: {p} of {limit}");
        if depth > 1e-12 {
            assert!(p >= limit * 0.998, "node {k}: {p} of {limit}");
        }
    }
    // The key of the scene does the same.
    scene.plastic.as_mut().unwrap().hardening_modulus = Some(modulus);
    let mut named = still(&scene).build().unwrap();
    assert_eq!(named.step(1.0).unwrap().plastic.volume, hard_first.plastic.volume);
    let hard_second = hard.step(1.0).unwrap();
    let more = hard_second.plastic.volume / hard_first.plastic.volume - 1.0;
    assert!((0.0..2e-3).contains(&more), "{more}");
}

#[test]
fn steps_by_depth_keep_to_it_and_add_up() {
    let mut sim = MixedLubricationSim::builder(dry(32).with_tribofilm()).build().unwrap();
    let control = StepControl::new(60.0, 2e-9);
    let (mut wear, mut film) = (vec![0.0; sim.grid().len()], vec![0.0; sim.grid().len()]);
    let mut shortest = f64::INFINITY;
    sim.run_until(300.0, &control, &mut |sim: &MixedLubricationSim, record: &StepRecord| {
        let disc = &sim.bodies()[1];
        for (before, now) in [(&mut wear, disc.wear()), (&mut film, disc.tribofilm())] {
            for (before, now) in before.iter_mut().zip(now) {
                assert!((now - *before).abs() <= 2e-9, "{} in {} s", now - *before, record.time_step);
                *before = *now;
            }
        }
        shortest = shortest.min(record.time_step);
        ControlFlow::Continue(())
    })
    .unwrap();
    assert!((sim.time() - 300.0).abs() < 1e-6, "{}", sim.time());
    assert!(shortest < 20.0, "{shortest} s");
    assert!(sim.ledger_residual().unwrap() < 1e-20);
    // Without a bound the steps are as long as they may be.
    let mut sim = MixedLubricationSim::builder(dry(32)).build().unwrap();
    let records = run_until(&mut sim, 150.0, StepControl::new(60.0, f64::INFINITY));
    let steps: Vec<f64> = records.iter().map(|record| record.time_step).collect();
    assert_eq!(steps, [60.0, 60.0, 30.0]);
    for control in [StepControl::new(60.0, 0.0), StepControl::new(f64::NAN, 1e-9)] {
        assert!(sim.step_within(&control).is_err(), "{control:?}");
    }
}

/// The contact of a step stands for all of it: first order in its length.
#[test]
fn the_error_of_long_steps_falls_with_their_length() {
    let worn = |time_step: f64| {
        let mut sim = MixedLubricationSim::builder(dry(32)).motion(Fixed).build().unwrap();
        let _ = run_until(&mut sim, 240.0, StepControl::fixed(time_step));
        sim.bodies()[1].wear().to_vec()
    };
    let exact = worn(1.25);
    let scale = exact.iter().map(|depth| depth * depth).sum::<f64>().sqrt();
    let errors = [40.0, 20.0, 10.0].map(|time_step| {
        let depths = worn(time_step);
        depths.iter().zip(&exact).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt() / scale
    });
    println!("relative errors of the wear depth with steps of 40, 20, 10 s: {errors:.4?}");
    assert!(errors[0] < 0.2, "{errors:?}");
    for pair in errors.windows(2) {
        // Towards 2, and more against a reference whose own steps are not infinitely short.
        assert!((1.6..3.0).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

/// Between nodes too, the mean depth is that of force and distance: the wear of the body is that of the contact.
#[test]
fn convected_roughness_wears_by_force_and_distance() {
    let mut scene = dry(32);
    let WearLawSpec::Archard(spec) = &mut scene.wear.as_mut().unwrap().law else { panic!("not by Archard") };
    spec.film_coefficient = spec.coefficient;
    let mut sim = MixedLubricationSim::builder(scene).motion(Advected).build().unwrap();
    // A third of a cell on the disc, another part on the ball.
    let time_step = 0.3 * sim.grid().dx() / 0.0975;
    let records = run_until(&mut sim, 6.0 * time_step, StepControl::fixed(time_step));
    assert_eq!(records.len(), 6);
    let (load, area) = (sim.hertz().force, sim.grid().size_x() * sim.grid().size_y());
    // The contact clock: the middle of the track ages by the time of the test.
    let exposed = sim.time() * sim.grid().size_x() / (2.0 * sim.hertz().half_width_x);
    let expected = 5.45e-8 * load * 0.005 * exposed / (6e9 * area);
    for wear in records[5].wear.mean() {
        assert!((wear / expected - 1.0).abs() < 2e-6, "{wear} {expected}");
    }
    assert!(sim.ledger_residual().unwrap() < 1e-20);
}

#[test]
fn squeeze_changes_the_film_of_a_passing_wave_and_no_steady_film() {
    let mut scene = Scene::azam_2019(32);
    (scene.wear, scene.plastic) = (None, None);
    scene.motion.entrainment_speed = 2.0;
    scene.roughness = Default::default();
    let run = |heights: Option<Vec<f64>>, squeeze: bool, steps: f64| {
        let mut builder = MixedLubricationSim::builder(scene.clone()).motion(Advected);
        if squeeze {
            builder = builder.with_squeeze();
        }
        if let Some(heights) = heights {
            builder = builder.disc_heights(heights);
        }
        let mut sim = builder.build().unwrap();
        let time_step = 0.5 * sim.grid().dx() / 2.0;
        let records = run_until(&mut sim, steps * time_step, StepControl::fixed(time_step));
        (records, sim.state().film.clone())
    };
    let ((steady, _), (transient, _)) = (run(None, false, 4.0), run(None, true, 4.0));
    assert!(transient.iter().all(|record| record.report.status == Status::Converged));
    for (a, b) in steady.iter().zip(&transient) {
        assert!((a.film.mean_central / b.film.mean_central - 1.0).abs() < 1e-4, "{a:?} {b:?}");
    }
    let grid = scene.grid().unwrap();
    let wave: Vec<f64> = grid.nodes().map(|(x, _)| 20e-9 * (2.0 * PI * x / 125e-6).cos()).collect();
    let ((_, quasi), (_, moving)) = (run(Some(wave.clone()), false, 24.0), run(Some(wave), true, 24.0));
    let apart = quasi.iter().zip(&moving).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("films differ by up to {apart:e} m");
    assert!(apart > 1e-9, "squeeze changes the film under a passing wave: {apart}");
}

/// In steps below a fifth of a cell, in which waves have no correction.
#[test]
#[ignore = "slow"]
fn a_squeezed_history_is_of_second_order_in_time() {
    let mut scene = Scene::azam_2019(32);
    (scene.wear, scene.plastic) = (None, None);
    scene.motion.entrainment_speed = 2.0;
    scene.motion.slide_roll_ratio = 0.0;
    scene.roughness = Default::default();
    scene.solver.tolerance = 1e-8;
    let grid = scene.grid().unwrap();
    let wave: Vec<f64> = grid.nodes().map(|(x, _)| 10e-9 * (2.0 * PI * x / 250e-6).cos()).collect();
    let film = |steps: u32| {
        let builder = MixedLubricationSim::builder(scene.clone()).motion(Advected);
        let mut sim = builder.with_squeeze().disc_heights(wave.clone()).build().unwrap();
        let time_step = 8.0 * grid.dx() / 2.0 / f64::from(steps);
        // The contact is solved before the step: one more for the end of the last.
        run_until(&mut sim, (f64::from(steps) + 1.0) * time_step, StepControl::fixed(time_step));
        sim.state().film.clone()
    };
    let [coarse, middle, fine] = [64, 128, 256].map(film);
    let apart = |a: &[f64], b: &[f64]| {
        let inside = grid.nodes().zip(a.iter().zip(b)).filter(|((x, y), _)| x.hypot(*y) < 1e-4);
        inside.map(|(_, (a, b))| (a - b).powi(2)).sum::<f64>().sqrt()
    };
    let order = (apart(&coarse, &middle) / apart(&middle, &fine)).log2();
    assert!(order > 1.7, "order {order}");
}

#[test]
fn friction_is_boundary_on_solids_and_shear_on_fluid() {
    // Solids alone carry: the boundary coefficient.
    let mut scene = dry(32);
    let mu = |scene: &Scene| {
        let solution = solve_contact(scene).unwrap();
        solution.report.require_converged().unwrap();
        solution.friction.coefficient
    };
    assert!((mu(&scene) / 0.115 - 1.0).abs() < 1e-5, "{}", mu(&scene));
    scene.motion.slide_roll_ratio = 0.0;
    assert_eq!(mu(&scene), 0.0);
    // Fluid alone carries: at most the limiting stress over the mean pressure, less by Eyring, whatever the
    // boundary.
    let mut scene = Scene::azam_2019(48);
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.motion.entrainment_speed = 5.0;
    scene.lubricant.as_mut().unwrap().eta0 = 0.02;
    let newtonian = mu(&scene);
    scene.friction.eyring_stress = Some(5e6);
    let eyring = mu(&scene);
    scene.friction.boundary_coefficient = 10.0;
    assert_eq!(mu(&scene), eyring);
    println!("Newtonian with limit {newtonian:.4}, Eyring {eyring:.4}");
    assert!(newtonian < 1e8 / 0.767e9 * 1.05 && newtonian > 0.05, "{newtonian}");
    assert!(eyring > 0.01 && eyring < 0.8 * newtonian, "{eyring}");
}

#[test]
fn heat_comes_from_solids_and_from_fluid() {
    // A smooth thick film at high sliding: all heat is that of the fluid.
    let mut scene = Scene::azam_2019(32);
    scene.roughness = Default::default();
    (scene.plastic, scene.wear) = (None, None);
    scene.motion.entrainment_speed = 5.0;
    scene.motion.slide_roll_ratio = 0.4;
    scene.lubricant.as_mut().unwrap().eta0 = 0.02;
    scene.thermal.flash = Flash::On;
    let mut sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    let record = sim.step(1e-3).unwrap();
    assert_eq!(record.contact.load_ratio, 0.0);
    let rise = record.flash_rise.unwrap();
    assert!(rise > 1.0, "{rise}");
    // Without the fluid's stress there is none.
    scene.friction.limiting_shear_stress = 100.0;
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    assert!(sim.step(1e-3).unwrap().flash_rise.unwrap() < 1e-3 * rise);
}
