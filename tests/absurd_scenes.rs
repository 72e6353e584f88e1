//! Random scenes, absurd ones included: each ends in convergence, in a status or in an error that names the
//! fault.

#![expect(clippy::print_stdout, reason = "tests")]

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc;
use std::time::Duration;

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use stribeck::Status;
use stribeck::sim::scene::{
    ArchardSpec, FilmElasticSpec, GridSpec, Load, PlasticSpec, SolverKind, TribofilmSpec, WearLawSpec,
    WearSpec,
};
use stribeck::sim::{MixedLubricationSim, Scene, SimError, solve_contact};
use stribeck::surface::Form;
use stribeck::testing::{absurd_scenes, pressures, scenes};

/// Time after which a scene counts as hanging: the slowest takes seconds.
const PATIENCE: Duration = Duration::from_secs(300);

/// How a scene ended, in a word; an error if that is none of the ways in which it may.
fn outcome(scene: &Scene, heights: usize) -> Result<String, String> {
    let single = match solve_contact(scene) {
        Ok(solution) => {
            let report = solution.report;
            if report.status == Status::Converged {
                let state = &solution.state;
                let fields = [&state.pressure, &state.fluid_pressure, &state.film, &state.plastic_depth];
                if !fields.into_iter().flatten().all(|value| value.is_finite()) {
                    return Err("a field that is not finite as success".to_owned());
                }
                if !solution.pressure.max.is_finite() || !solution.film.central.is_finite() {
                    return Err("a number that is not finite as success".to_owned());
                }
                if report.residual.max() > scene.solver.tolerance {
                    return Err(format!("converged with {:?}", report.residual));
                }
                let inside = state.pressure.iter().sum::<f64>() * solution.grid.cell_area();
                let load = inside + solution.pressure.load_outside;
                if (load / solution.hertz.force - 1.0).abs() > 2.0 * scene.solver.tolerance + 1e-12 {
                    return Err(format!("converged with {load} N instead of {} N", solution.hertz.force));
                }
            }
            report.status.to_string()
        }
        Err(error) => named(&error)?,
    };
    let mut builder = MixedLubricationSim::builder(scene.clone());
    // None, empty, too few and not finite heights.
    builder = match heights {
        0 => builder.ball_heights(Vec::new()),
        1 => builder.disc_heights(vec![0.0; 7]),
        2 => builder.disc_heights(vec![f64::NAN; scene.grid().map_or(1, |grid| grid.len().min(1 << 20))]),
        _ => builder,
    };
    let history = match builder.build() {
        Ok(mut sim) => match sim.step(10.0).and_then(|_| sim.step(10.0)) {
            Ok(record) => {
                let numbers = [
                    record.film.lambda.unwrap_or(0.0),
                    record.contact.load_ratio,
                    record.pressure.max,
                    record.wear.ball_mean,
                    record.tribofilm.disc_mean,
                    record.friction.coefficient,
                    record.roughness.disc_rq,
                ];
                if !numbers.iter().all(|value| value.is_finite()) {
                    return Err(format!("a record that is not finite: {record:?}"));
                }
                "steps".to_owned()
            }
            Err(SimError::NotConverged { .. }) => "step not converged".to_owned(),
            Err(error) => named(&error)?,
        },
        Err(error) => named(&error)?,
    };
    Ok(format!("{single} / {history}"))
}

/// The kind of an error that names the fault.
fn named(error: &SimError) -> Result<String, String> {
    let text = error.to_string();
    match error {
        SimError::Input(_) | SimError::Surface(_) if text.contains(['=', ':', '.', ' ']) => {
            Ok("refused".to_owned())
        }
        SimError::Reynolds(_) => Ok("refused by the solver".to_owned()),
        SimError::BoxTooSmall(_) => Ok("a box too small".to_owned()),
        _ => Err(format!("an error of no use: {text}")),
    }
}

fn tried(scene: &Scene, heights: usize) -> Result<String, String> {
    let (sender, receiver) = mpsc::channel();
    let copy = scene.clone();
    std::thread::spawn(move || {
        let result = catch_unwind(AssertUnwindSafe(|| outcome(&copy, heights)));
        // The receiver is gone if the result is late.
        let _ = sender.send(result);
    });
    match receiver.recv_timeout(PATIENCE) {
        Ok(Ok(result)) => result,
        Ok(Err(_)) => Err("a panic".to_owned()),
        Err(_) => Err("no end".to_owned()),
    }
}

fn try_scenes(count: usize) {
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        TestRng::from_seed(RngAlgorithm::ChaCha, b"scenes of stribeck, absurd ones!"),
    );
    let strategy = (prop_oneof![1 => scenes().boxed(), 3 => absurd_scenes().boxed()], 0_usize..12);
    let mut ends = BTreeMap::new();
    let mut failures = Vec::new();
    for case in 0..count {
        let (scene, heights) = strategy.new_tree(&mut runner).unwrap().current();
        match tried(&scene, heights) {
            Ok(end) => *ends.entry(end).or_insert(0) += 1,
            Err(reason) => failures.push(format!("scene {case}: {reason}: {scene:?}")),
        }
    }
    for (end, number) in &ends {
        println!("{number:5} {end}");
    }
    assert!(failures.is_empty(), "{} of {count}:\n{}", failures.len(), failures.join("\n"));
    assert!(ends.keys().any(|end| end.starts_with("converged")), "nothing converged");
}

#[test]
fn random_invalid_scenes_end_in_a_status_or_a_named_error() {
    try_scenes(60);
}

#[test]
#[ignore = "takes minutes"]
fn thousand_random_invalid_scenes_end_in_a_status_or_a_named_error() {
    try_scenes(1000);
}

/// Failures found by random scenes: a start above the pressure limit, wear beyond the range of numbers.
#[test]
fn scenes_of_earlier_failures_end_in_a_status() {
    let mut start = Scene::azam_2019(16);
    start.solver.kind = SolverKind::SemiSystem;
    start.solver.max_iterations = 500;
    start.plastic = Some(PlasticSpec::new(6e8));
    let mut worn = Scene::azam_2019(16);
    worn.lubricant = None;
    worn.solver.edge_contact = true;
    let law = ArchardSpec { coefficient: 1e300, film_coefficient: 0.0, ..ArchardSpec::default() };
    worn.wear = Some(WearSpec::azam_2019().with_law(WearLawSpec::Archard(law)));
    for scene in [start, worn] {
        if let Err(reason) = tried(&scene, 11) {
            panic!("{reason}: {scene:?}");
        }
    }
}

/// Every key of a scene file that has a number, in a contact of 12 x 12 nodes.
fn every_number() -> String {
    let (_, document) = include_str!("../docs/scene_history.md").split_once("## A complete scene").unwrap();
    let scene = document.split("```toml").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    scene
        .replace("nx = 128", "nx = 12")
        .replace("ny = 128", "ny = 12")
        .replace("max_iterations = 20000", "max_iterations = 300")
        .replace("10e-6", "1e-4")
        .replace("[grid]", "alpha = 1.5e-8\n[grid]")
        .replace("[load]", "[elastic.tribofilm]\nmodulus = 30e9\npoisson = 0.3\n[load]")
        .replace("[friction]", "hardening_modulus = 1e16\n[friction]")
        .replace("[tribofilm]", "eyring_stress = 5e6\n[tribofilm]")
        .replace("[track]", "film_hardness = 2e9\n[track]")
        .replace("[thermal]", "radius_ball = 9.525e-3\nradius_disc = 23e-3\n[thermal]")
}

#[test]
#[ignore = "slow"]
fn every_number_of_a_scene_file_may_be_absurd() {
    let text = every_number();
    assert!(solve_contact(&Scene::from_toml(&text).unwrap()).is_ok());
    let lines: Vec<&str> = text.lines().collect();
    let (mut keys, mut failures) = (0, Vec::new());
    for (place, line) in lines.iter().enumerate() {
        let Some((key, old)) = line.split_once(" = ") else { continue };
        if !old.contains(|c: char| c.is_ascii_digit()) {
            continue;
        }
        keys += 1;
        for new in [
            "nan",
            "inf",
            "-inf",
            "-1.0",
            "-1",
            "0.0",
            "0",
            "1e-300",
            "1e300",
            "-1e300",
            "9223372036854775807",
        ] {
            let new_line = if old.starts_with('[') {
                format!("{key} = [{new}, 0.25e-3]")
            } else {
                format!("{key} = {new}")
            };
            let mut changed = lines.clone();
            changed[place] = &new_line;
            let end = match Scene::from_toml(&changed.join("\n")) {
                Ok(scene) => match (tried(&scene, 11), solve_contact(&scene)) {
                    (Err(reason), _) => Err(reason),
                    (Ok(end), Ok(_)) => Ok(end),
                    (Ok(_), Err(error)) => Err(error.to_string()),
                },
                Err(error) => Err(error.to_string()),
            };
            let no_number = new.contains("n");
            match end {
                Ok(end) if no_number => failures.push(format!("{new_line}: {end}")),
                Err(text) if no_number && !text.contains(key) => failures.push(format!("{new_line}: {text}")),
                Err(text) if !text.contains(['=', '`', ':']) => failures.push(format!("{new_line}: {text}")),
                _ => {}
            }
        }
    }
    assert!(keys >= 40, "{keys} keys with numbers");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// A contact of 12 x 12 nodes with a change.
fn changed(change: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = Scene::azam_2019(12);
    scene.solver.max_iterations = 300;
    change(&mut scene);
    scene
}

fn cells(nx: usize, ny: usize, half_x: f64, half_y: f64) -> GridSpec {
    GridSpec::Cells { nx, ny, x: [-half_x, half_x], y: [-half_y, half_y] }
}

const KINDS: [SolverKind; 5] = [
    SolverKind::Auto,
    SolverKind::NewtonKrylov,
    SolverKind::Multigrid,
    SolverKind::SemiSystem,
    SolverKind::Dry,
];

/// Unreasonable scenes, by hand, each with its name.
fn absurd_by_hand() -> Vec<(String, Scene)> {
    let mut list: Vec<(String, Scene)> = Vec::new();
    for force in [0.0, 5e-324, 1e-30, 1e-9, 1e6, 1e12, 1e30, 1e300] {
        list.push((format!("{force:e} N"), changed(|s| s.load = Load::force(force))));
        let dry = changed(|s| (s.load, s.lubricant) = (Load::force(force), None));
        list.push((format!("{force:e} N, dry"), dry));
    }
    for (nx, ny) in
        [(1, 1), (1, 12), (12, 1), (1, 512), (512, 1), (5, 128), (128, 5), (2, 2), (4, 4), (5, 5), (0, 12)]
    {
        list.push((format!("{nx} x {ny}"), changed(|s| s.grid = cells(nx, ny, 0.25e-3, 0.25e-3))));
        let line = changed(|s| {
            (s.grid, s.form) = (cells(nx, ny, 0.25e-3, 0.25e-3), Form::Cylinder { radius: 9.525e-3 });
        });
        list.push((format!("{nx} x {ny}, line"), line));
    }
    for n in [usize::MAX, 1 << 32, 1 << 26, 1 << 13] {
        list.push((format!("{n} x {n}"), changed(|s| s.grid = cells(n, n, 0.25e-3, 0.25e-3))));
        list.push((format!("{n} x 1"), changed(|s| s.grid = cells(n, 1, 0.25e-3, 0.25e-3))));
    }
    for half in [1e-300, 1e-9, 1e-5, 5e-5, 1.4e-4, 1.0, 1e150, 1e300] {
        for (lubricant, edge_contact) in [(true, false), (false, false), (false, true)] {
            let scene = changed(|s| {
                s.grid = cells(12, 12, half, half);
                s.solver.edge_contact = edge_contact;
                if !lubricant {
                    s.lubricant = None;
                }
            });
            list.push((format!("box of {half:e} m, {lubricant} {edge_contact}"), scene));
        }
    }
    for hardness in [5e-324, 1.0, 1e8, 3e8, 7.66e8, 7.7e8, 1e300] {
        let plastic =
            PlasticSpec::new(hardness).with_film_hardness(Some(hardness)).with_hardening_modulus(Some(1e300));
        list.push((format!("hardness of {hardness:e} Pa"), changed(|s| s.plastic = Some(plastic))));
        list.push((
            format!("hardness of {hardness:e} Pa, dry"),
            changed(|s| (s.plastic, s.lubricant) = (Some(plastic), None)),
        ));
    }
    for kind in KINDS {
        for tolerance in [0.0, 5e-324, 1e-300, 1e-17, 1e-15, 1e300, f64::NAN] {
            for smooth in [true, false] {
                let scene = changed(|s| {
                    (s.solver.kind, s.solver.tolerance) = (kind, tolerance);
                    s.solver.max_iterations = u64::MAX;
                    if smooth {
                        s.roughness = Default::default();
                    }
                });
                list.push((format!("{kind:?} to {tolerance:e}, smooth {smooth}"), scene));
            }
        }
        for film_cutoff in [5e-324, 1e-300, 1e-15, 1e-7, 1e-6, 9e-6, 1e-2, 1e300] {
            let scene = changed(|s| (s.solver.kind, s.solver.film_cutoff) = (kind, film_cutoff));
            list.push((format!("{kind:?}, cut-off of {film_cutoff:e} m"), scene));
        }
    }
    for modulus in [5e-324, 1e-300, 1e-100, 1.0, 1e6] {
        let scene = changed(|s| {
            s.tribofilm = Some(TribofilmSpec::default());
            s.elastic.tribofilm = Some(FilmElasticSpec::new(modulus, 0.3));
        });
        list.push((format!("film of {modulus:e} Pa"), scene));
    }
    for speed in [5e-324, 1e-30, 1e6, 1e30, 1e300] {
        list.push((format!("{speed:e} m/s"), changed(|s| s.motion.entrainment_speed = speed)));
    }
    list
}

#[test]
#[ignore = "slow"]
fn unreasonable_scenes_end_in_a_status_or_a_named_error() {
    // Two at a time. The threads of rayon would wait here for solves that need them.
    let list = absurd_by_hand();
    let every_other = |first: usize| -> Vec<String> {
        let scenes = list.iter().skip(first).step_by(2);
        let failed = scenes.filter_map(|(name, scene)| Some(format!("{name}: {}", tried(scene, 11).err()?)));
        failed.collect()
    };
    let failures = std::thread::scope(|scope| {
        let odd = scope.spawn(|| every_other(1));
        let mut failures = every_other(0);
        failures.extend(odd.join().unwrap());
        failures
    });
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn scenes_round_trip_through_toml(scene in scenes()) {
        prop_assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    }

    /// Absurd ones too, as long as their numbers are numbers: NaN is not itself.
    #[test]
    fn absurd_scenes_round_trip_through_toml(scene in absurd_scenes()) {
        match scene.to_toml().and_then(|text| Scene::from_toml(&text)) {
            Ok(read) => prop_assert_eq!(format!("{read:?}"), format!("{scene:?}")),
            // Counts beyond the integers of TOML.
            Err(error) => prop_assert!(matches!(scene.grid, GridSpec::Cells { nx: usize::MAX, .. }), "{}", error),
        }
    }

    #[test]
    fn pressures_fit_their_grid(nx in 1_usize..9, ny in 1_usize..9, seed in any::<u8>()) {
        let grid = stribeck::Grid::centred(nx, ny, 1e-6, 1e-6).unwrap();
        let mut runner = TestRunner::new_with_rng(
            Config::default(),
            TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]),
        );
        let field = pressures(&grid).new_tree(&mut runner).unwrap().current();
        prop_assert_eq!(field.len(), grid.len());
        prop_assert!(field.iter().all(|p| p.is_finite() && *p >= 0.0));
    }
}
