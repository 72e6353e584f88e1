//! Random scenes, absurd ones included: each ends in convergence, in a status or in an error that says what is wrong.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a test stops at what it did not expect")]

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc;
use std::time::Duration;

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use stribeck::Status;
use stribeck::sim::scene::{GridSpec, PlasticSpec, SolverKind, WearSpec};
use stribeck::sim::{MixedLubricationSim, Scene, SimError, solve_contact};
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
                if !solution.contact.max_pressure.is_finite() || !solution.film.central.is_finite() {
                    return Err("a number that is not finite as success".to_owned());
                }
                if report.residuals.max() > scene.solver.tolerance {
                    return Err(format!("converged with {:?}", report.residuals));
                }
                let load = state.pressure.iter().sum::<f64>() * solution.grid.cell_area();
                if (load / solution.hertz.load - 1.0).abs() > 2.0 * scene.solver.tolerance + 1e-12 {
                    return Err(format!("converged with {load} N instead of {} N", solution.hertz.load));
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
                    record.lambda,
                    record.load_ratio,
                    record.max_pressure,
                    record.mean_wear[0],
                    record.mean_film[1],
                    record.friction_coefficient,
                    record.rq[1],
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

/// The kind of an error that names what is wrong.
fn named(error: &SimError) -> Result<String, String> {
    let text = error.to_string();
    match error {
        SimError::Input(_) | SimError::Surface(_) if text.contains(['=', ':', '.', ' ']) => {
            Ok("refused".to_owned())
        }
        SimError::Reynolds(_) => Ok("refused by the solver".to_owned()),
        _ => Err(format!("an error of no use: {text}")),
    }
}

fn tried(scene: &Scene, heights: usize) -> Result<String, String> {
    let (sender, receiver) = mpsc::channel();
    let copy = scene.clone();
    std::thread::spawn(move || {
        let result = catch_unwind(AssertUnwindSafe(|| outcome(&copy, heights)));
        // Nobody listens any more to one that came too late.
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
fn scenes_end_as_they_may() {
    try_scenes(60);
}

#[test]
#[ignore = "takes minutes"]
fn a_thousand_scenes_end_as_they_may() {
    try_scenes(1000);
}

/// What random scenes have found: a start above the pressure limit, wear beyond the range of numbers.
#[test]
fn scenes_that_once_did_not() {
    let mut start = Scene::azam_2019(16);
    start.solver.kind = SolverKind::SemiSystem;
    start.solver.max_iterations = 500;
    start.plastic = Some(PlasticSpec { hardness: 6e8, film_hardness: None, hardening_modulus: None });
    let mut worn = Scene::azam_2019(16);
    worn.lubricant = None;
    worn.solver.edge_contact = true;
    worn.wear = Some(WearSpec { coefficient: 1e300, film_coefficient: 0.0, ..WearSpec::default() });
    for scene in [start, worn] {
        if let Err(reason) = tried(&scene, 11) {
            panic!("{reason}: {scene:?}");
        }
    }
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
        match scene.to_toml() {
            Ok(text) => {
                let read = Scene::from_toml(&text).map(|scene| format!("{scene:?}"));
                prop_assert_eq!(read.unwrap(), format!("{scene:?}"), "{}", text);
            }
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
