//! `stribeck sweep`: points, their folder, and errors.
#![expect(clippy::unwrap_used, reason = "tests")]

mod common;

use std::path::Path;

use common::{assert_refused, error_of, json_of, rough, stribeck, text};
use serde_json::Value;

const OVER: [&str; 4] =
    ["--over", "motion.entrainment_speed=0.1m/s..0.4m/s:3", "--over", "load.force=10 N,20 N"];

fn sweep(scene: &Path, out: &Path, more: &[&str]) -> std::process::Output {
    let mut arguments = vec!["sweep", text(scene), "--out", text(out), "--json"];
    arguments.extend(more);
    stribeck(&arguments)
}

/// The points without the seconds that they took.
fn points(output: &std::process::Output) -> Vec<Value> {
    json_of(output)["points"].as_array().unwrap().clone()
}

#[test]
fn points_are_those_of_single_solves_for_any_number_of_jobs() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[]);
    let one = sweep(&scene, &folder.path().join("one"), &[&OVER[..], &["--jobs", "1"]].concat());
    let two = sweep(&scene, &folder.path().join("two"), &[&OVER[..], &["--jobs", "2"]].concat());
    assert_eq!(one.status.code(), Some(0), "{one:?}");
    assert_eq!(points(&one), points(&two));
    let point = &points(&one)[3];
    let speed = point["inputs"]["motion.entrainment_speed"].as_f64().unwrap();
    assert!((speed - 0.2).abs() < 1e-15 && point["inputs"]["load.force"] == 20.0, "{point}");
    let kept = std::fs::read_to_string(&scene).unwrap();
    let start = kept.find("[load]").unwrap();
    let end = start + kept[start..].find("\n\n").unwrap();
    let mut single = kept.replace(&kept[start..end], "[load]\nforce = 20.0");
    let from = single.find("entrainment_speed").unwrap();
    let line = single[from..].lines().next().unwrap().to_owned();
    single = single.replacen(&line, &format!("entrainment_speed = {speed}"), 1);
    let path = folder.path().join("single.toml");
    std::fs::write(&path, single).unwrap();
    let solution = json_of(&stribeck(&["solve", text(&path), "--json"]));
    assert_eq!(point["values"]["film"], solution["film"]);
    let table = std::fs::read_to_string(folder.path().join("one/sweep.csv")).unwrap();
    assert_eq!(table.lines().count(), 7);
    assert!(table.starts_with("motion.entrainment_speed,load.force,status,error,"), "{table}");
}

#[test]
fn kept_points_are_not_solved_again_and_shards_share_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (rough(folder.path(), &[]), folder.path().join("out"));
    let third = sweep(&scene, &out, &[&OVER[..], &["--shard", "1/3"]].concat());
    assert_eq!((third.status.code(), points(&third).len()), (Some(0), 2), "{third:?}");
    let file = out.join("point_000001.json");
    let before = std::fs::metadata(&file).unwrap().modified().unwrap();
    let whole = sweep(&scene, &out, &OVER);
    assert_eq!(points(&whole).len(), 6);
    assert_eq!(std::fs::metadata(&file).unwrap().modified().unwrap(), before);
    // a file that is damaged is solved again
    for damaged in ["{\"status\": \"conv", "{\"status\": \"converged\", \"error\": null, \"values\": [1]}"] {
        std::fs::write(&file, damaged).unwrap();
        assert_eq!(points(&sweep(&scene, &out, &OVER)), points(&whole), "{damaged}");
    }
    let other = ["sweep", text(&scene), "--out", text(&out), "--over", "load.force=10 N,30 N"];
    assert_refused(&other, &["holds another sweep", "points differ"]);
}

#[test]
fn point_that_is_refused_leaves_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[]);
    let output = sweep(&scene, &folder.path().join("out"), &["--over", "load.force=10,-3"]);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let statuses: Vec<Value> = points(&output).iter().map(|point| point["status"].clone()).collect();
    assert_eq!(statuses, ["converged", "refused"]);
    assert!(points(&output)[1]["error"].as_str().unwrap().contains("load.force"), "{output:?}");
    assert!(!error_of(&output).contains("panicked"));
}

#[test]
fn sweep_refuses_what_does_not_fit() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[]);
    let out = folder.path().join("out");
    let cases: [(&[&str], &[&str]); 8] = [
        (&["--over", "load.force"], &["--over load.force", "KEY=FROM..TO:COUNT"]),
        (&["--over", "load.force=1..2"], &["KEY=FROM..TO:COUNT"]),
        (&["--over", "load.force=1..2:1"], &["KEY=FROM..TO:COUNT"]),
        (&["--over", "motion.entrainment_sped=1"], &["entrainment_sped"]),
        (&["--over", "load.force=1 m/s..2 m/s:3"], &["load.force"]),
        (&["--zip", "--over", "load.force=1,2", "--over", "motion.entrainment_speed=1"], &["2, 1"]),
        (&["--over", "load.force=1,2", "--shard", "2/2"], &["--shard 2/2"]),
        (&["--over", "load.force=1,2", "--jobs", "0"], &["--jobs"]),
    ];
    for (more, words) in cases {
        let mut arguments = vec!["sweep", text(&scene), "--out", text(&out)];
        arguments.extend(more);
        assert_refused(&arguments, words);
    }
}

/// Means and sample standard deviations over the seeds, for each load.
#[test]
fn seeds_have_means_and_standard_deviations() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[]);
    let over = ["--over", "roughness.disc.seed=1,2,18446744073709551615", "--over", "load.force=10,20"];
    let out = folder.path().join("out");
    let output = sweep(&scene, &out, &over);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let (json, points) = (json_of(&output), points(&output));
    assert_eq!(points[4]["inputs"]["roughness.disc.seed"], u64::MAX);
    let groups = json["seeds"].as_array().unwrap();
    assert_eq!(groups.len(), 2, "{json}");
    for (group, load) in groups.iter().zip([10.0, 20.0]) {
        assert_eq!((&group["inputs"]["load.force"], &group["count"]), (&Value::from(load), &Value::from(3)));
        let of_load = points.iter().filter(|point| point["inputs"]["load.force"] == load);
        let films: Vec<f64> =
            of_load.map(|point| point["values"]["film"]["mean_central"].as_f64().unwrap()).collect();
        let mean = films.iter().sum::<f64>() / 3.0;
        let deviation = (films.iter().map(|film| (film - mean).powi(2)).sum::<f64>() / 2.0).sqrt();
        let found = &group["means"]["film.mean_central"];
        assert!((found["mean"].as_f64().unwrap() / mean - 1.0).abs() < 1e-12, "{found}");
        assert!((found["standard_deviation"].as_f64().unwrap() / deviation - 1.0).abs() < 1e-9, "{found}");
        assert!(deviation > 0.0);
    }
    let arguments = [&["sweep", text(&scene), "--out", text(&out)], &over[..]].concat();
    let told = String::from_utf8(stribeck(&arguments).stdout).unwrap();
    assert!(told.contains("\nseeds ") && told.contains("load.force = 20") && told.contains(" +- "), "{told}");
}

#[test]
fn ranges_of_whole_numbers_stay_whole() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[]);
    let seeds = |over: &str| -> Vec<Value> {
        let output = sweep(&scene, &folder.path().join(over), &["--over", over]);
        points(&output).iter().map(|point| point["inputs"]["roughness.disc.seed"].clone()).collect()
    };
    assert_eq!(seeds("roughness.disc.seed=1..3:3"), [1, 2, 3]);
    let last = u64::MAX;
    assert_eq!(
        seeds("roughness.disc.seed=18446744073709551613..18446744073709551615:3"),
        [last - 2, last - 1, last]
    );
}
