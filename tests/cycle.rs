//! Contacts over a cycle of load, speeds and radius, through zero speed and reversed flow.

use std::f64::consts::{PI, TAU};

use stribeck::sim::scene::{CycleSpec, GridSpec, Roughness, RoughnessState};
use stribeck::sim::{CycleEnd, CyclePoint, MixedLubricationSim, Scene, solve_contact};

use crate::common::runs::cycle as solve;

/// A steel roller on a row of cells, symmetric about its middle.
fn roller(nx: usize) -> Scene {
    Scene::from_toml(&format!(
        "form = {{ kind = \"cylinder\", radius = 10e-3 }}\nelastic.equivalent_modulus = 230e9\nload.force = 1e5\n\
         motion.entrainment_speed = 1.0\nmotion.slide_roll_ratio = 0.2\n[lubricant]\neta0 = 0.02\nalpha = 18e-9\nroelands_z = 0.6\n\
         inlet = \"box_edge\"\n[friction]\neyring_stress = 5e6\n[grid]\nnx = {nx}\nx = [-0.4e-3, 0.4e-3]"
    ))
    .unwrap()
}

/// A disc that reciprocates under a ball at rest, from its largest speed on, over a stroke of `stroke` half-widths.
fn reciprocating(mut scene: Scene, stroke: f64, steps: usize) -> Scene {
    let half_width = scene.hertz().unwrap().half_width_x;
    let speed = scene.motion.entrainment_speed;
    let period = PI * stroke * half_width / (2.0 * speed);
    let mut cycle = CycleSpec::default();
    cycle.time = (0..=120).map(|k| period * f64::from(k) / 120.0).collect();
    let cosine = |k: i32| if k % 60 == 30 { 0.0 } else { (TAU * f64::from(k % 120) / 120.0).cos() };
    cycle.ball_speed = vec![0.0; 121];
    cycle.disc_speed = (0..=120).map(|k| 2.0 * speed * cosine(k)).collect();
    cycle.steps = Some(steps);
    scene.cycle = Some(cycle);
    scene
}

fn refused(change: impl FnOnce(&mut Scene)) -> String {
    let mut scene = reciprocating(roller(64), 10.0, 40);
    change(&mut scene);
    MixedLubricationSim::builder(scene).solve_cycle(&mut |_| true).unwrap_err().to_string()
}

#[test]
fn films_of_both_strokes_are_mirror_images() {
    let points = solve(reciprocating(roller(128), 60.0, 240)).points;
    let half = points.len() / 2;
    for (there, back) in points[..half].iter().zip(&points[half..]) {
        let values: [fn(&CyclePoint) -> f64; 4] =
            [|p| p.film_central, |p| p.film_minimum, |p| p.pressure_max, |p| p.friction_power];
        for value in values {
            let (a, b) = (value(there), value(back));
            assert!((a - b).abs() <= 1e-6 * a.max(b), "at {} s: {a:e}, {b:e}", there.time);
        }
    }
}

/// Squeeze keeps oil in the contact where the speed is zero, and the least film follows the dead point (Hooke 1986).
#[test]
#[ignore = "slow"]
fn least_film_of_a_ball_follows_the_dead_point() {
    let scene = Scene::from_toml(
        "form = { kind = \"sphere\", radius = 10e-3 }\nelastic.equivalent_modulus = 230e9\nload.force = 20\n\
         motion.entrainment_speed = 0.1\n[lubricant]\neta0 = 0.1\nalpha = 18e-9\nroelands_z = 0.6\n[grid]\nnx = 48\nny = 48\n\
         x = [-0.4e-3, 0.4e-3]\ny = [-0.4e-3, 0.4e-3]",
    )
    .unwrap();
    let steady = solve_contact(&scene).unwrap().film;
    let points = solve(reciprocating(scene, 40.0, 160)).points;
    let period = 160.0 * (points[1].time - points[0].time);
    let stroke = || points.iter().filter(|p| (0.0..0.5).contains(&(p.time / period)));
    let least = stroke().min_by(|a, b| a.film_minimum.total_cmp(&b.film_minimum)).unwrap();
    assert!((0.25..0.35).contains(&(least.time / period)), "least film at {} periods", least.time / period);
    assert!(
        least.film_minimum > 2e-9 && least.film_minimum < 0.5 * steady.minimum,
        "{:e}",
        least.film_minimum
    );
    let dead = stroke()
        .min_by(|a, b| (a.time / period - 0.25).abs().total_cmp(&(b.time / period - 0.25).abs()))
        .unwrap();
    assert!(dead.disc_speed.abs() < 1e-12 && dead.film_central > 0.2 * steady.central, "{dead:?}");
    assert_eq!(dead.squeeze_ratio, None, "there is no entrainment to compare with");
}

#[test]
fn constant_table_equals_the_steady_contact() {
    let steady = solve_contact(&roller(128)).unwrap();
    for quasi_static in [false, true] {
        let mut scene = roller(128);
        let mut cycle = CycleSpec::default();
        (cycle.time, cycle.load, cycle.steps) = (vec![0.0, 1e-3, 2e-3], vec![1e5; 3], Some(10));
        cycle.quasi_static = quasi_static;
        scene.cycle = Some(cycle);
        let points = solve(scene).points;
        assert_eq!(points.len(), if quasi_static { 2 } else { 10 });
        for point in points {
            let pairs = [
                (point.film_central, steady.film.central),
                (point.pressure_max, steady.pressure.max),
                (point.friction_coefficient, steady.friction.coefficient),
            ];
            assert!(pairs.iter().all(|(a, b)| (a / b - 1.0).abs() < 1e-5), "{pairs:?}");
            assert!((point.friction_power / (point.friction_coefficient * 1e5 * 0.2) - 1.0).abs() < 1e-9);
        }
    }
}

/// A contact that widens at a constant rate draws in oil as one whose entrainment is faster by this rate. The film in its
/// middle entered a half-width earlier.
#[test]
fn film_of_a_growing_load_is_that_of_the_faster_moving_edge() {
    let half_width = |load: f64| (8.0 * load * 10e-3 / (PI * 230e9)).sqrt();
    let (first, last, growth) = (4e4, 1.6e5, 0.15);
    let duration = (half_width(last) - half_width(first)) / growth;
    let mut cycle = CycleSpec::default();
    (cycle.once, cycle.steps) = (true, Some(120));
    for k in 0..=40 {
        let s = f64::from(k) / 40.0;
        cycle.time.push(s * duration);
        cycle.load.push(first * (1.0 + s).powi(2));
    }
    let mut scene = roller(256);
    scene.cycle = Some(cycle);
    let solution = solve(scene);
    let film = solution.points.last().unwrap().film_central;
    let entered = first * (2.0 - half_width(last) / duration).powi(2);
    let steady = |load: f64, speed: f64| {
        let mut scene = roller(256);
        (scene.load.force, scene.motion.entrainment_speed) = (Some(load), speed);
        solve_contact(&scene).unwrap().film.central
    };
    let expected = steady(entered, 1.0 + growth);
    assert!((film / expected - 1.0).abs() < 0.02, "{film:e} {expected:e}");
    assert!(film / steady(last, 1.0) > 1.07, "{film:e} {:e}", steady(last, 1.0));
}

/// Contacts with another load and radius are those of scenes with these values.
#[test]
fn quasi_static_rows_equal_single_contacts() {
    let mut scene = roller(128);
    let mut cycle = CycleSpec::default();
    (cycle.time, cycle.quasi_static, cycle.once) = (vec![0.0, 1.0, 2.0], true, true);
    (cycle.load, cycle.radius) = (vec![1e5, 5e4, 8e4], vec![10e-3, 15e-3, 7e-3]);
    (cycle.ball_speed, cycle.disc_speed) = (vec![1.1, -2.0, 0.5], vec![0.9, -1.0, 0.4]);
    scene.cycle = Some(cycle);
    let points = solve(scene).points;
    assert_eq!(points.len(), 3);
    for point in points {
        let mut single = roller(128);
        single.load = stribeck::sim::scene::Load::force(point.load);
        single.form = stribeck::surface::Form::Cylinder { radius: point.radius };
        single.motion.entrainment_speed = 0.5 * (point.ball_speed + point.disc_speed).abs();
        single.motion.slide_roll_ratio =
            (point.ball_speed - point.disc_speed) / (0.5 * (point.ball_speed + point.disc_speed));
        let steady = solve_contact(&single).unwrap();
        let pairs = [
            (point.film_central, steady.film.central),
            (point.film_minimum, steady.film.minimum),
            (point.hertz_pressure, steady.hertz.pressure),
            (point.friction_coefficient, steady.friction.coefficient),
        ];
        assert!(pairs.iter().all(|(a, b)| (a / b - 1.0).abs() < 1e-5), "{pairs:?}");
        assert!(point.residual_load < 1e-6);
    }
}

/// Each row of a cycle of moving roughness is the passage of a scene with its values.
#[test]
fn quasi_static_rows_of_moving_roughness_equal_passages() {
    let mut scene = roller(96);
    scene.roughness.ball = Roughness::gaussian(0.05e-6, 80e-6, 1);
    (scene.motion.roughness, scene.motion.passage) = (RoughnessState::Moving, Some(0.1e-3));
    let mut cycle = CycleSpec::default();
    (cycle.time, cycle.quasi_static, cycle.once) = (vec![0.0, 1.0], true, true);
    (cycle.load, cycle.radius) = (vec![1e5, 5e4], vec![10e-3, 15e-3]);
    (cycle.ball_speed, cycle.disc_speed) = (vec![1.1, 2.0], vec![0.9, 1.0]);
    scene.cycle = Some(cycle);
    let solution = solve(scene.clone());
    assert!(solution.is_moving && solution.points.len() == 2);
    for point in solution.points {
        let mut single = scene.clone();
        single.cycle = None;
        single.load = stribeck::sim::scene::Load::force(point.load);
        single.form = stribeck::surface::Form::Cylinder { radius: point.radius };
        let speed = 0.5 * (point.ball_speed + point.disc_speed);
        single.motion.entrainment_speed = speed;
        single.motion.slide_roll_ratio = (point.ball_speed - point.disc_speed) / speed;
        let mean = solve_contact(&single).unwrap();
        let pairs = [
            (point.film_central, mean.film.central),
            (point.film_mean_central, mean.film.mean_central),
            (point.film_minimum, mean.film.minimum),
            (point.pressure_max, mean.pressure.max),
            (point.friction_coefficient, mean.friction.coefficient),
            (point.hertz_pressure, mean.hertz.pressure),
        ];
        assert!(pairs.iter().all(|(a, b)| (a / b - 1.0).abs() < 1e-6), "{pairs:?}");
        single.motion.roughness = RoughnessState::AtRest;
        single.motion.passage = None;
        let rest = solve_contact(&single).unwrap().film.minimum;
        assert!((point.film_minimum / rest - 1.0).abs() > 0.01, "{} {rest}", point.film_minimum);
    }
}

#[test]
fn tables_are_refused_by_row_field_and_value() {
    type Change = fn(&mut CycleSpec);
    let cases: [(Change, &[&str]); 10] = [
        (|c| c.time[7] = c.time[6], &["cycle.time[7]", "does not go back"]),
        (|c| c.load = vec![1e5; 4], &["cycle.load", "121"]),
        (|c| (c.radius = vec![1e-2; 121], c.radius[5] = -1e-2).0, &["cycle.radius[5]", "-0.01"]),
        (|c| (c.load = vec![1e5; 121], c.load[5] = f64::NAN).0, &["cycle.load[5]", "NaN"]),
        (|c| c.disc_speed = vec![0.0; 121], &["no oil is entrained"]),
        (|c| c.disc_speed[120] = 1.0, &["cycle.disc_speed[120]", "once = true"]),
        (|c| c.period = Some(1e-9), &["cycle.period", "1e-9"]),
        (|c| c.steps = Some(3), &["cycle.steps", "3"]),
        (|c| c.time.clear(), &["cycle.time", "missing"]),
        (
            |c| {
                c.quasi_static = true;
                (c.disc_speed[40], c.disc_speed[41]) = (0.0, 0.0);
            },
            &["row 41 of [cycle]: cycle.ball_speed + cycle.disc_speed = 0", "no film"],
        ),
    ];
    for (change, words) in cases {
        let error = refused(|scene| change(scene.cycle.as_mut().unwrap()));
        assert!(words.iter().all(|word| error.contains(word)), "{words:?}: {error}");
    }
}

#[test]
fn scenes_without_a_cycle_are_refused_by_reason() {
    type Change = fn(&mut Scene);
    let cases: [(Change, &str); 9] = [
        (|s| s.cycle = None, "is missing"),
        (|s| s.lubricant = None, "dry"),
        (|s| s.grid = GridSpec::Row { nx: 64, x: [-0.4e-3, 0.2e-3] }, "symmetric"),
        (|s| s.solver.accuracy = Some(0.05), "solver.accuracy"),
        (|s| s.solver.model = stribeck::sim::scene::SolverModel::AsperityInlets, "quasi_static"),
        (|s| s.motion.roughness = RoughnessState::Moving, "add quasi_static = true"),
        (
            |s| {
                s.motion.roughness = RoughnessState::Moving;
                s.cycle.as_mut().unwrap().quasi_static = true;
            },
            "row 31 of [cycle]: 0.5 (cycle.ball_speed + cycle.disc_speed)",
        ),
        (
            |s| {
                s.motion.roughness = RoughnessState::Moving;
                (s.cycle.as_mut().unwrap().quasi_static, s.cycle.as_mut().unwrap().repeat) = (true, Some(3));
            },
            "leave cycle.repeat out",
        ),
        (|s| s.cycle.as_mut().unwrap().load = vec![1e8; 121], "row 1 of [cycle]: load = 100"),
    ];
    for (change, word) in cases {
        let error = refused(change);
        assert!(error.contains(word), "{word}: {error}");
    }
}

#[test]
fn cycle_tables_are_read_with_units() {
    let folder = tempfile::tempdir().unwrap();
    let base = roller(64).to_toml().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(
        &path,
        format!("{base}\n[cycle]\ntable = \"flank.csv\"\nperiod = \"20 ms\"\nquasi_static = true\n"),
    )
    .unwrap();
    let table = folder.path().join("flank.csv");
    let solved = |text: &str| {
        std::fs::write(&table, text).unwrap();
        MixedLubricationSim::builder(Scene::load(&path).unwrap()).solve_cycle(&mut |_| true)
    };
    let points = solved(
        "angle (deg), load (N/mm), radius (mm), bulk_temperature (degC)\n0, 100, 10, 80\n90, 50, 12, 90\n",
    )
    .unwrap()
    .points;
    assert_eq!(points.len(), 2);
    let found = [
        points[1].time,
        points[1].angle.unwrap(),
        points[1].load,
        points[1].radius,
        points[1].bulk_temperature,
    ];
    for (a, b) in found.into_iter().zip([5e-3, TAU / 4.0, 5e4, 12e-3, 363.15]) {
        assert!((a / b - 1.0).abs() < 1e-12, "{found:?}");
    }
    for (text, words) in [
        ("time, load\n0, 1e5\n1,\n", ["line 3", "load is empty"]),
        ("time, load\n0, 1e5\n1, 1e5, 3\n", ["line 3", "3 values"]),
        ("time, load\n0, heavy\n", ["line 2", "`heavy`"]),
        ("time, weight\n0, 1\n", ["weight", "bulk_temperature"]),
        ("", ["flank.csv", "is empty"]),
        ("time;load (kN/m)\n0;100,5\n", ["line 2", "decimal point"]),
        ("time;load\n0;\n", ["line 2", "load is empty"]),
        ("time, load, load\n0, 1, 1\n", ["line 1", "load is there twice"]),
        (
            "# rig\n\ntime (ms), load\n0, 1e5\n1, 1e5\n0.5, 1e5\n",
            ["line 6, time (ms) = 0.5: ", "above the row before"],
        ),
        ("time, load (kN/m)\n0, 100\n1, -120\n", ["line 3, load (kN/m) = -120: ", "> 0"]),
        ("time (ms), load (kN/m)\n0, 100\n1, 1e5\n", ["flank.csv, line 3: load = 100", "MN/m"]),
    ] {
        let error = solved(text).unwrap_err().to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{words:?}: {error}");
    }
    let scene = Scene::load(&path).unwrap();
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
}

/// Stop and start: the film of a contact at rest thins by squeeze and comes back with the speed.
#[test]
fn film_thins_at_rest_and_returns_with_the_speed() {
    let mut scene = roller(96);
    scene.motion.slide_roll_ratio = 0.0;
    let steady = solve_contact(&scene).unwrap().film.central;
    let mut cycle = CycleSpec::default();
    (cycle.time, cycle.steps) = (vec![0.0, 2e-3, 3e-3, 8e-3, 9e-3, 12e-3], Some(240));
    let speed = vec![1.0, 1.0, 0.0, 0.0, 1.0, 1.0];
    (cycle.ball_speed, cycle.disc_speed) = (speed.clone(), speed);
    scene.cycle = Some(cycle);
    let points = solve(scene).points;
    let rest: Vec<&CyclePoint> = points.iter().filter(|point| point.ball_speed == 0.0).collect();
    assert!(
        rest.len() > 90 && rest.windows(2).all(|p| p[1].film_minimum <= p[0].film_minimum * (1.0 + 1e-9))
    );
    assert!(rest.iter().all(|point| point.film_central > 0.2 * steady && point.film_minimum > 1e-9));
    assert!((points.last().unwrap().film_central / steady - 1.0).abs() < 0.01);
}

/// Solids that reach the edge of the box end a cycle, which keeps the contacts before it.
#[test]
fn solids_at_the_edge_of_the_box_end_a_cycle_that_keeps_its_contacts() {
    let scene = Scene::from_toml(
        "form = { kind = \"cylinder\", radius = 5e-3 }\nelastic.equivalent_modulus = 230e9\nload.hertz_pressure = 1.2e9\n\
         motion = { entrainment_speed = 0.1, slide_roll_ratio = 0.25 }\nlubricant = { eta0 = 0.003, alpha = 15e-9, roelands_z = 0.6 }\n\
         [grid]\nacross = \"periodic\"\nnx = 59\nny = 8\nx = [-0.25e-3, 0.12e-3]\ny = [-0.025e-3, 0.025e-3]\n\
         [roughness]\nball = { kind = \"gaussian\", rq = 0.3e-6, length_x = 25e-6, length_y = 25e-6, seed = 2 }\n\
         disc = { kind = \"gaussian\", rq = 0.3e-6, length_x = 25e-6, length_y = 25e-6, seed = 2 }\n\
         [cycle]\ntime = [0, 1, 2]\nload = [2e4, 1e5, 1.9e5]\nonce = true\nquasi_static = true\n",
    )
    .unwrap();
    let solution = MixedLubricationSim::builder(scene).solve_cycle(&mut |_| true).unwrap();
    assert_eq!(solution.points.len(), 1);
    let Some(CycleEnd::BoxTooSmall { time, reason }) = solution.ended_early else {
        panic!("{:?}", solution.ended_early)
    };
    assert_eq!((time, reason.field), (1.0, "grid.x"));
}
