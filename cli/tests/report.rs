//! Reports: well formed, every number from the JSON object, one file.
#![expect(clippy::unwrap_used, reason = "tests")]

mod common;

use std::path::Path;

use common::{assert_refused, error_of, json_of, repository, rough, stribeck, text};
use roxmltree::{Document, Node, ParsingOptions};
use serde_json::Value;

/// The number under a key with dots.
fn number_at(json: &Value, key: &str) -> f64 {
    let value = key.split('.').fold(json, |value, part| match part.parse::<usize>() {
        Ok(index) => &value[index],
        Err(_) => &value[part],
    });
    value.as_f64().unwrap_or_else(|| panic!("{key} is not in the JSON"))
}

/// Runs the command with `--json --report` and compares both; the text of the report.
fn reported(folder: &Path, arguments: &[&str], scene: &Path, expected: &[&str]) -> String {
    let path = folder.join("report.html");
    let all = [arguments, &[text(scene), "--json", "--report", text(&path)]].concat();
    let output = stribeck(&all);
    assert!(output.status.success(), "{}", error_of(&output));
    let (json, page) = (json_of(&output), std::fs::read_to_string(&path).unwrap());
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(&page, options).unwrap();
    let cells: Vec<Node<'_, '_>> =
        document.descendants().filter(|node| node.attribute("data-key").is_some()).collect();
    for cell in &cells {
        let key = cell.attribute("data-key").unwrap();
        let factor: f64 = cell.attribute("data-factor").unwrap().parse().unwrap();
        let offset: f64 = cell.attribute("data-offset").map_or(0.0, |offset| offset.parse().unwrap());
        let (shown, exact): (f64, f64) =
            (cell.text().unwrap().parse().unwrap(), factor * number_at(&json, key) + offset);
        // Errors have two digits, values four.
        let is_error = key.starts_with("error_estimate.") || key.ends_with("_error") || key.ends_with("_sd");
        let rounding = if is_error { 6e-2 } else { 6e-4 };
        assert!((shown - exact).abs() <= rounding * exact.abs(), "{key}: {shown} for {exact}");
    }
    for key in expected {
        assert!(cells.iter().any(|cell| cell.attribute("data-key") == Some(key)), "no {key}");
    }
    let words = std::fs::read_to_string(scene).unwrap();
    let shown = document.descendants().find(|node| node.has_tag_name("pre")).unwrap();
    let shown: String =
        shown.descendants().filter_map(|node| node.text().filter(|_| node.is_text())).collect();
    assert_eq!(shown, words.trim_end());
    let loaded = ["src", "href"];
    for node in document.descendants() {
        let source = loaded.iter().find_map(|name| node.attribute(*name));
        assert!(source.is_none_or(|source| source.starts_with("data:")), "{source:?} is loaded");
    }
    page
}

#[test]
fn report_of_a_solve_has_the_numbers_of_the_json_and_warnings_first() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[("length_y = 50e-6", "length_y = 20e-6")]);
    let keys = [
        "film.central",
        "friction.coefficient",
        "contact.load_ratio",
        "hertz.pressure",
        "roughness.composite_rq",
    ];
    let page = reported(folder.path(), &["solve"], &scene, &keys);
    let place = |words: &str| page.find(words).unwrap_or_else(|| panic!("no {words}"));
    assert!(place("<h2>Warnings</h2>") < place("<h2>Numbers</h2>"));
    assert!(page.contains("cells of 1.5625e-5 m are wider than a third"));
    assert!(page.len() < 1_000_000, "{}", page.len());
}

#[test]
fn report_of_a_curve_has_a_row_for_each_value() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/scenes/line.toml");
    let arguments = ["curve", "--over", "load", "--points", "3", "--out", text(folder.path())];
    reported(
        folder.path(),
        &arguments,
        &scene,
        &["curve.0.load_N_m", "curve.2.film_mean_central_m", "curve.2.film_formula_m"],
    );
}

#[test]
fn report_of_a_history_has_means_and_a_slider_of_fields() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/scenes/dry_history.toml");
    let arguments = ["run", "--steps", "3", "--time-step", "10 s"];
    let page = reported(
        folder.path(),
        &arguments,
        &scene,
        &["steps", "wear.disc_volume", "tribofilm.ball_in_contact"],
    );
    let (_, data) = page.split_once("id=\"data\">").unwrap();
    let data: Value = serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap();
    assert_eq!(data["fields"]["frames"].as_array().unwrap().len(), 3);
    assert!(!page.contains("data-key=\"film.minimum\""), "the gap of touching solids is rounding");
}

#[test]
fn report_of_a_bearing_has_all_its_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/scenes/journal.toml");
    reported(folder.path(), &["solve"], &scene, &["load", "power_loss"]);
}

#[test]
fn report_over_a_file_or_the_scene_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[]);
    let path = folder.path().join("report.html");
    std::fs::write(&path, "mine").unwrap();
    assert_refused(&["solve", text(&scene), "--report", text(&path)], &["report.html", "exists", "--force"]);
    assert_refused(&["solve", text(&scene), "--report", text(&scene), "--force"], &["this is the scene"]);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
}
