//! `stribeck benchmark`: table, pictures, resuming, and errors.
#![expect(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{assert_refused, error_of, json_of, stribeck, text};

/// Six smooth cases on 16 x 16 cells.
const SMALL: [&str; 9] =
    ["benchmark", "--cases", "battery", "--tag", "smooth", "--every", "8", "--mesh", "16"];

#[test]
fn rows_and_pictures_are_written_and_a_second_run_solves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let solvers = ["--solver", "auto", "--solver", "newton_krylov:halvings=1", "--plot", "--json", "--out"];
    let arguments = [&SMALL[..], &solvers, &[text(folder.path())]].concat();
    let output = stribeck(&arguments);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let rows = json_of(&output)["rows"].as_array().unwrap().clone();
    assert_eq!(rows.len(), 12);
    assert!(rows.iter().all(|row| row["verdict"] == "converged"), "{rows:?}");
    for (name, word) in [
        ("stability_map", "of 6 converge"),
        ("work_precision", "convolutions"),
        ("performance_profile", "12"),
    ] {
        let svg = std::fs::read_to_string(folder.path().join(format!("{name}.svg"))).unwrap();
        roxmltree::Document::parse(&svg).unwrap();
        assert!(svg.contains(word) || word == "12", "{name}: no {word}");
    }
    let table = std::fs::read_to_string(folder.path().join("benchmark.csv")).unwrap();
    // A row that was solved again would have other seconds.
    assert_eq!(stribeck(&arguments).status.code(), Some(0));
    assert_eq!(std::fs::read_to_string(folder.path().join("benchmark.csv")).unwrap(), table);
}

#[test]
fn a_solver_without_budget_fails_and_the_status_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [&SMALL[..], &["--convolutions", "2", "--out", text(folder.path())]].concat();
    let output = stribeck(&arguments);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let words = String::from_utf8(output.stdout).unwrap();
    assert!(words.contains("auto fails in 6 of 6 runs") && words.contains("out_of_budget"), "{words}");
}

#[test]
fn cases_of_a_file_are_solved() {
    let folder = tempfile::tempdir().unwrap();
    let scene = common::repository("examples/scenes/smooth.toml");
    let cases = format!("[[case]]\nname = \"smooth\"\nscene = \"{}\"\ntags = [\"own\"]\n", text(&scene));
    let file = folder.path().join("cases.toml");
    std::fs::write(&file, cases).unwrap();
    let output =
        stribeck(&["benchmark", "--cases", text(&file), "--mesh", "24", "--out", text(folder.path())]);
    assert_eq!(output.status.code(), Some(0), "{}", error_of(&output));
    assert!(String::from_utf8(output.stdout).unwrap().contains("own"));
}

#[test]
fn unknown_lists_solvers_and_keys_are_refused() {
    assert_refused(
        &["benchmark", "--cases", "batteri"],
        &["no list is called `batteri`", "battery, corners"],
    );
    assert_refused(&["benchmark", "--solver", "newton"], &["newton", "unknown value"]);
    assert_refused(&["benchmark", "--solver", "auto:halvings=1"], &["unknown key `halvings`"]);
    assert_refused(&["benchmark", "--cases", "no/such.toml"], &["no/such.toml"]);
    assert_refused(&["benchmark", "--time=-1 s"], &["--time"]);
    assert_refused(&["benchmark", "--tolerance", "0.5"], &["solver.tolerance"]);
    assert_refused(&["benchmark", "--tag", "nothing"], &["there is no case"]);
}
