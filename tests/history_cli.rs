//! The example `history` from the outside: output, exit status, messages.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use serde_json::Value;
use stribeck::sim::scene::SolverKind;
use stribeck::sim::{MixedLubricationSim, Scene};

fn program() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| crate::common::example("history"))
}

fn scene() -> Scene {
    let mut scene = Scene::azam_2019(24).with_tribofilm();
    scene.solver.kind = SolverKind::Dry;
    scene
}

/// Runs the example on the scene.
fn history(scene: &Scene, arguments: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, scene.to_toml().unwrap()).unwrap();
    Command::new(program()).arg(path).args(arguments).output().unwrap()
}

#[test]
fn json_holds_the_means_of_the_last_tenth() {
    let output = history(&scene(), &["--steps", "20", "--time-step", "30", "--json"]);
    assert!(output.status.success(), "{output:?}");
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let number =
        |path: &str| json.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path}: {json}"));
    let mut sim = MixedLubricationSim::builder(scene()).build().unwrap();
    let records: Vec<_> = (0..20).map(|_| sim.step(30.0).unwrap()).collect();
    let mean =
        |value: fn(&stribeck::sim::StepRecord) -> f64| 0.5 * (value(&records[18]) + value(&records[19]));
    for (path, expected) in [
        ("/contact/area_ratio", mean(|r| r.contact.area_ratio)),
        ("/contact/load_ratio", mean(|r| r.contact.load_ratio)),
        ("/film/mean_central", mean(|r| r.film.mean_central)),
        ("/friction/coefficient", mean(|r| r.friction.coefficient)),
        ("/pressure/max", mean(|r| r.pressure.max)),
        ("/wear/ball_in_contact", mean(|r| r.wear.ball_in_contact)),
        ("/wear/disc_in_contact", mean(|r| r.wear.disc_in_contact)),
        ("/tribofilm/ball_in_contact", mean(|r| r.tribofilm.ball_in_contact)),
        ("/tribofilm/disc_in_contact", mean(|r| r.tribofilm.disc_in_contact)),
        ("/roughness/ball_rq", mean(|r| r.roughness.ball_rq)),
    ] {
        assert!((number(path) / expected - 1.0).abs() < 1e-9, "{path}: {} is not {expected}", number(path));
    }
    assert!(number("/averaged_steps") - 2.0 == 0.0 && number("/steps") - 20.0 == 0.0);
    assert_eq!(json["worn_profile"]["disc"].as_array().map(Vec::len), Some(24));
    let progress = String::from_utf8(output.stderr).unwrap();
    let warnings = progress.lines().take_while(|line| line.starts_with("warning: grid.n")).count();
    assert_eq!(json["warnings"].as_array().map(Vec::len), Some(warnings));
    assert_eq!((warnings, progress.lines().count()), (2, 12), "{progress}");
    assert!(progress.ends_with("20 of 20 steps, 600.0 s of the test\n"), "{progress}");
}

#[test]
fn bad_input_is_one_line_and_ends_with_1() {
    let refused = |scene: &Scene, arguments: &[&str], words: &str| {
        let output = history(scene, arguments);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0), "{message}");
        assert!(message.lines().count() == 1 && message.contains(words), "{message}");
    };
    refused(&scene(), &["--steps", "2"], "--time-step is missing");
    refused(&scene(), &["--steps", "0", "--time-step", "1"], "--steps");
    refused(&scene(), &["--steps", "2", "--time-step", "-1"], "--time-step = -1");
    refused(&scene(), &["--steps", "2", "--time-step", "nan"], "--time-step = NaN");
    let mut short = scene();
    short.track.exposure = stribeck::sim::scene::Exposure::Track;
    (short.track.radius_ball, short.track.radius_disc) = (Some(1e-6), Some(0.02));
    refused(&short, &["--steps", "2", "--time-step", "1"], "track.radius_ball = 1e-6");
}

#[test]
fn a_contact_that_is_not_solved_ends_with_2() {
    let mut scene = scene();
    scene.solver.max_iterations = 0;
    scene.solver.tolerance = 1e-9;
    let output = history(&scene, &["--steps", "2", "--time-step", "1", "--json"]);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(output.stdout.is_empty() && message.lines().last().unwrap().starts_with("error: "), "{message}");
}
