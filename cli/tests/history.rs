//! `stribeck run` from the outside.
#![expect(clippy::unwrap_used, reason = "tests")]

mod common;

use std::path::{Path, PathBuf};

use common::{assert_pictures, assert_refused, error_of, json_of, repository, stribeck, text};
use serde_json::Value;
use stribeck::sim::scene::{ArchardSpec, GridSpec, Roughness, SolverKind, WearLawSpec};
use stribeck::sim::{HistoryMeans, MixedLubricationSim, Scene, Schedule};

fn scene() -> Scene {
    let mut scene = Scene::azam_2019(24).with_tribofilm();
    scene.solver.kind = SolverKind::Dry;
    // Waves that these cells hold: without a warning the messages are errors alone.
    for roughness in [&mut scene.roughness.ball, &mut scene.roughness.disc] {
        if let Roughness::Random(random) = roughness {
            *roughness = Roughness::gaussian(random.rq, 70e-6, random.seed);
        }
    }
    scene
}

fn written(scene: &Scene, folder: &Path) -> PathBuf {
    let path = folder.join("rubbing.toml");
    std::fs::write(&path, scene.to_toml().unwrap()).unwrap();
    path
}

/// Without the time that it took.
fn numbers(output: &std::process::Output) -> Value {
    assert!(output.status.success(), "{output:?}");
    let mut numbers = json_of(output);
    numbers.as_object_mut().unwrap().remove("seconds").unwrap();
    numbers
}

#[test]
fn a_run_has_the_numbers_of_the_library_also_where_it_was_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(&scene(), folder.path());
    let out = folder.path().join("run");
    let steps = |n: &str, more: &[&str]| {
        let arguments = ["run", text(&path), "--steps", n, "--time-step", "0.5 min", "--json"];
        stribeck(&[arguments.as_slice(), more].concat())
    };
    let csv = folder.path().join("rows.csv");
    let whole = numbers(&steps("12", &["--csv", text(&csv)]));
    let mut sim = MixedLubricationSim::builder(scene()).build().unwrap();
    let mut means = HistoryMeans::new(12);
    (0..12).for_each(|_| means.see(&sim.step(30.0).unwrap()));
    assert_eq!(whole, serde_json::to_value(means.numbers(&sim)).unwrap());
    assert_eq!(std::fs::read_to_string(&csv).unwrap().lines().count(), 13);

    numbers(&steps("5", &["--out", text(&out)]));
    let resumed = steps("12", &["--out", text(&out), "--resume", "--plot"]);
    assert_eq!(numbers(&resumed), whole);
    assert!(error_of(&resumed).contains("12 of 12 steps, 360.0 s of the test"), "{resumed:?}");
    for file in ["scene.toml", "history.csv", "checkpoint", "fields.npz"] {
        assert!(out.join(file).exists(), "{file}");
    }
    let rows = std::fs::read_to_string(out.join("history.csv")).unwrap();
    assert_eq!(rows, std::fs::read_to_string(&csv).unwrap());
    assert_pictures(
        &out,
        "rubbing_history",
        &["time (s)", "friction", "worn (nm)", "tribofilm (nm)", "disc"],
    );
    assert_pictures(&out, "rubbing_maps", &["pressure (GPa)", "tribofilm on the disc (nm)", "360 s"]);
}

/// The history of `docs/getting_started.md` in longer steps, on wider cells: solids stay away from the edges, where they
/// would end it.
#[test]
fn the_first_history_ends_with_solids_away_from_the_edges() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let output =
        stribeck(&["init", text(&path), "--roughness", "125 nm", "--length", "30 um", "--speed", "5 mm/s"]);
    assert!(output.status.success(), "{output:?}");
    let page = std::fs::read_to_string(repository("docs/getting_started.md")).unwrap();
    let tables = page.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let scene = std::fs::read_to_string(&path).unwrap() + "\n" + tables;
    std::fs::write(&path, scene).unwrap();
    let output = stribeck(&["run", text(&path), "--duration", "2 h", "--steps", "12", "--json"]);
    assert!(output.status.success(), "{output:?}");
    let numbers = json_of(&output);
    let number = |key: &str| numbers.pointer(key).and_then(Value::as_f64).unwrap();
    assert!(number("/contact/load_ratio") > 0.0 && number("/contact/area_ratio") > 0.0, "{numbers}");
    assert!(number("/wear/ball_volume") > 0.0 && number("/tribofilm/disc_in_contact") > 0.0, "{numbers}");
}

/// A groove that reaches the edge of the box: the steps before it are kept, the exit status is 1.
#[test]
fn a_run_whose_groove_reaches_the_edge_keeps_its_steps_and_ends_with_1() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = scene();
    (scene.lubricant, scene.roughness) = (None, Default::default());
    let half = 176e-6;
    scene.grid = GridSpec::Cells { nx: 24, ny: 32, x: [-250e-6, 250e-6], y: [-half, half] };
    let law = ArchardSpec { coefficient: 3e-6, film_coefficient: 3e-6, ..ArchardSpec::default() };
    scene.wear = scene.wear.map(|wear| wear.with_law(WearLawSpec::Archard(law)));
    let path = written(&scene, folder.path());
    let out = folder.path().join("run");
    let command = ["run", text(&path), "--steps", "400", "--time-step", "10 s", "--out", text(&out)];
    let output = stribeck(&command);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let message = error_of(&output);
    for words in ["reaches the edge of the box", "grid.y = [", "grid.ny = ", "grid.grows = true"] {
        assert!(message.contains(words), "`{words}` is not in {message}");
    }
    let ended = stribeck(&[&command[..], &["--force", "--json"]].concat());
    let found = json_of(&ended);
    assert_eq!(ended.status.code(), Some(1), "{ended:?}");
    assert!(found["ended_early"].as_str().unwrap().contains("reaches the edge"), "{found}");
    assert!(found["averaged_steps"].as_u64() > Some(0) && found["wear"].is_object(), "{found}");
    let rows = std::fs::read_to_string(out.join("history.csv")).unwrap().lines().count();
    assert!(rows > 5 && out.join("fields.npz").exists() && out.join("checkpoint").exists(), "{rows}");
    // In a box that grows the same history goes on.
    let GridSpec::Cells { nx, ny, x, y } = scene.grid else { panic!("cells") };
    scene.grid = GridSpec::Growing { nx, ny, x, y };
    let path = written(&scene, folder.path());
    let longer = (rows + 2).to_string();
    let grown = folder.path().join("grown");
    let command =
        ["run", text(&path), "--steps", &longer, "--time-step", "10 s", "--out", text(&grown), "--plot"];
    let output = stribeck(&command);
    assert!(output.status.success(), "{output:?}");
    assert!(error_of(&output).contains("warning: grid.y"), "{output:?}");
    let further = (rows + 4).to_string();
    let command =
        ["run", text(&path), "--steps", &further, "--time-step", "10 s", "--out", text(&grown), "--resume"];
    let output = stribeck(&command);
    assert!(output.status.success(), "{output:?}");
    let end = String::from_utf8(output.stdout).unwrap();
    assert!(end.contains("wear.disc_volume") && end.contains("mm^3/(N m)"), "{end}");
}

#[test]
fn the_schedule_says_how_long() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = scene();
    scene.schedule.load = Some(Schedule::ramps(&[(0.0, 30.0), (60.0, 50.0)]));
    let path = written(&scene, folder.path());
    let run = |more: &[&str]| numbers(&stribeck(&[&["run", text(&path), "--json"], more].concat()));
    let ten = run(&["--steps", "10"]);
    assert_eq!((&ten["steps"], &ten["time"]), (&10.into(), &60.0.into()));
    let four = run(&["--time-step", "15 s"]);
    assert_eq!((&four["steps"], &four["time"]), (&4.into(), &60.0.into()));
    let filled = run(&["--duration", "1 min", "--time-step", "25"]);
    assert_eq!((filled["steps"].as_u64(), filled["time"].as_f64()), (Some(3), Some(60.0)));
    let two = run(&["--duration", "1 min", "--time-step", "30"]);
    assert_eq!((&two["steps"], &two["time"]), (&2.into(), &60.0.into()));
}

#[test]
fn bad_input_ends_with_2_and_an_unsolved_contact_with_1() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(&scene(), folder.path());
    assert_refused(&["run", text(&path)], &["--duration"]);
    assert_refused(&["run", text(&path), "--steps", "2"], &["--time-step"]);
    let thrice = ["run", text(&path), "--steps", "2", "--time-step", "1", "--duration", "2"];
    assert_refused(&thrice, &["twice"]);
    for wrong in ["0", "-1", "nan", "5 m"] {
        let output = stribeck(&["run", text(&path), "--steps", "2", "--time-step", wrong]);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{output:?}");
        assert!(error_of(&output).contains("--time-step"), "{output:?}");
    }
    for (wrong, words) in [("-1", "--steps = \"-1\": must be a whole number from 1"), ("1.5", "whole number")]
    {
        let output = stribeck(&["run", text(&path), "--time-step", "1", "--steps", wrong]);
        assert!(output.status.code() == Some(2) && error_of(&output).contains(words), "{output:?}");
    }
    let mut hopeless = scene();
    hopeless.solver.max_iterations = 0;
    hopeless.solver.tolerance = 1e-9;
    let path = written(&hopeless, folder.path());
    let output = stribeck(&["run", text(&path), "--steps", "2", "--time-step", "1", "--json"]);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0), "{output:?}");
    assert!(error_of(&output).contains("error: the contact of step 0 was not solved"), "{output:?}");
}

#[test]
fn a_run_is_written_over_on_request_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(&scene(), folder.path());
    let out = folder.path().join("run");
    let arguments = ["run", text(&path), "--steps", "2", "--time-step", "1", "--out", text(&out)];
    assert!(stribeck(&arguments).status.success());
    let before = std::fs::read(out.join("history.csv")).unwrap();
    let refused = stribeck(&arguments);
    let message = error_of(&refused);
    assert_eq!(refused.status.code(), Some(2), "{message}");
    assert!(message.contains("--resume goes on with it, --force writes over it"), "{message}");
    assert_eq!(std::fs::read(out.join("history.csv")).unwrap(), before);
    assert!(stribeck(&[&arguments[..], &["--force"]].concat()).status.success());
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_ends_with_a_checkpoint() {
    use std::process::{Command, Stdio};

    let folder = tempfile::tempdir().unwrap();
    let path = written(&scene(), folder.path());
    let out = folder.path().join("run");
    let arguments = ["run", text(&path), "--steps", "1000000", "--time-step", "1", "--out", text(&out)];
    let mut command = Command::new(env!("CARGO_BIN_EXE_stribeck"));
    let run = command.args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    while std::fs::metadata(out.join("history.csv")).map_or(0, |found| found.len()) < 5000 {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert!(Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap().success());
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let message = error_of(&output);
    assert!(message.contains("s of 1000000 s") && message.contains("--resume"), "{message}");
    let rows = std::fs::read_to_string(out.join("history.csv")).unwrap().lines().count() - 1;
    let more = (rows + 1).to_string();
    let resumed_arguments =
        ["run", text(&path), "--steps", &more, "--time-step", "1", "--out", text(&out), "--resume"];
    let resumed = stribeck(&resumed_arguments);
    assert!(resumed.status.success() && !error_of(&resumed).contains("warning"), "{resumed:?}");
    let message = error_of(&stribeck(&resumed_arguments));
    assert!(message.contains("at its end already") && !message.contains("goes on with"), "{message}");
    let more = (rows + 2).to_string();
    let longer = ["run", text(&path), "--steps", &more, "--time-step", "2", "--out", text(&out), "--resume"];
    let message = error_of(&stribeck(&longer));
    assert!(message.contains("has taken steps of 1 s, it goes on with steps of 2 s"), "{message}");
    let fewer = ["run", text(&path), "--steps", "1", "--time-step", "1", "--out", text(&out), "--resume"];
    let refused = stribeck(&fewer);
    let message = error_of(&refused);
    assert_eq!(refused.status.code(), Some(2), "{message}");
    assert!(
        message.contains("the run has reached") && message.contains("more than the 1 s asked for"),
        "{message}"
    );
}

/// Steps are 20 s until 60 s; then 25 s, and the last one ends at the duration.
#[test]
fn a_resumed_run_ends_at_its_duration_with_any_step() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(&scene(), folder.path());
    let out = folder.path().join("run");
    let run = |duration: &str, step: &str, more: &[&str]| {
        let arguments =
            ["run", text(&path), "--duration", duration, "--time-step", step, "--json", "--out", text(&out)];
        stribeck(&[arguments.as_slice(), more].concat())
    };
    // Without a run the command begins one, with a warning.
    let begun = run("60", "20", &["--resume"]);
    assert_eq!(numbers(&begun)["steps"], 3);
    assert!(error_of(&begun).contains("there is no run to go on with; a new one begins"), "{begun:?}");
    for (duration, step, steps) in [("125", "25", 6), ("125", "10", 6), ("130", "100", 7), ("150.5", "7", 10)]
    {
        let resumed = run(duration, step, &["--resume"]);
        let found = numbers(&resumed);
        let time = found["time"].as_f64().unwrap();
        assert!((time / duration.parse::<f64>().unwrap() - 1.0).abs() < 1e-12, "{time} {duration}");
        assert_eq!(found["steps"], steps, "{duration} {step}");
        let words = match step {
            "10" => "the run is at its end already".to_owned(),
            _ => format!("it goes on with steps of {step} s"),
        };
        assert!(error_of(&resumed).contains(&words), "{resumed:?}");
    }
    let rows = std::fs::read_to_string(out.join("history.csv")).unwrap();
    let column = rows.lines().next().unwrap().split(',').position(|name| name == "time_s").unwrap();
    let times: Vec<f64> =
        rows.lines().skip(1).map(|row| row.split(',').nth(column).unwrap().parse().unwrap()).collect();
    assert_eq!(times, [20.0, 40.0, 60.0, 85.0, 110.0, 125.0, 130.0, 137.0, 144.0, 150.5]);
}

#[test]
fn another_schedule_or_law_than_that_of_the_run_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(&scene(), folder.path());
    let out = folder.path().join("run");
    let run = ["run", text(&path), "--steps", "2", "--time-step", "1", "--out", text(&out)];
    assert!(stribeck(&run).status.success());
    let before = std::fs::read(out.join("history.csv")).unwrap();
    let mut scheduled = scene();
    scheduled.schedule.load = Some(Schedule::steps(&[(0.0, 30.0), (2.0, 50.0)]));
    let mut worn = scene();
    worn.wear = None;
    for (other, part) in [(scheduled, "scene.schedule"), (worn, "scene.wear")] {
        written(&other, folder.path());
        let longer =
            ["run", text(&path), "--steps", "3", "--time-step", "1", "--out", text(&out), "--resume"];
        assert_refused(
            &longer,
            &["belongs to another run", part, "take scene, laws and heights of that run"],
        );
        assert_eq!(std::fs::read(out.join("history.csv")).unwrap(), before);
    }
}

#[test]
fn no_output_is_written_over_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, scene().to_toml().unwrap()).unwrap();
    let before = std::fs::read(&path).unwrap();
    let (scene, out) = (text(&path), text(folder.path()));
    for arguments in [
        vec!["solve", &scene, "--fields", &scene],
        vec!["run", &scene, "--steps", "1", "--time-step", "1", "--csv", &scene],
        vec!["run", &scene, "--steps", "1", "--time-step", "1", "--out", &out],
    ] {
        let output = stribeck(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(error_of(&output).contains("this is the scene"), "{arguments:?}");
        assert_eq!(std::fs::read(&path).unwrap(), before);
    }
}
