//! `stribeck solve`: every number of its JSON, its report, fields and warnings.
#![expect(clippy::float_cmp, clippy::unwrap_used, reason = "tests")]

mod common;

use std::io::Read;
use std::path::PathBuf;
use std::process::Output;

use common::{assert_refused, error_of, json_of, repository, rough, stribeck, text};
use serde_json::Value;
use stribeck::surface::write_npy;

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/scenes");

fn solve(arguments: &[&str]) -> Output {
    stribeck(&[&["solve"], arguments].concat())
}

fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} in {value}"))
}

fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value / expected - 1.0).abs() < tolerance, "{value} is not {expected}");
}

/// A scene file with `text` in a new folder.
fn scene(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

/// The smooth scene of the repository, dry, on `n` x `n` nodes.
fn dry(n: usize) -> String {
    let text = std::fs::read_to_string(format!("{SCENES}/smooth.toml")).unwrap();
    let text = text.replace("nx = 128", &format!("nx = {n}")).replace("ny = 128", &format!("ny = {n}"));
    format!("{text}\n[solver]\nkind = \"dry\"\n")
}

#[test]
fn dry_smooth_contact_is_hertz() {
    let (_folder, path) = scene(&dry(128));
    let output = solve(&[path.to_str().unwrap(), "--json"]);
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    let json = json_of(&output);
    assert_eq!(json["status"], "converged");
    assert_eq!(json["solver"], "dry");
    assert_eq!(json["version"], env!("CARGO_PKG_VERSION"));
    assert!(json["moes"].is_null());
    for part in ["mass", "load", "complementarity"] {
        assert!(number(&json["residual"], &format!("/{part}")) <= 1e-6);
    }
    close(number(&json, "/hertz/radius"), 149.83e-6, 1e-4);
    close(number(&json, "/hertz/force"), 54.07, 1e-4);
    close(number(&json, "/hertz/pressure"), 1.15e9, 1e-12);
    close(number(&json, "/pressure/max"), 1.15e9, 1e-3);
    close(number(&json, "/approach"), 149.83e-6_f64.powi(2) / 9.525e-3, 2e-3);
    close(number(&json, "/contact/area_ratio"), 1.0, 2e-2);
    close(number(&json, "/contact/load_ratio"), 1.0, 1e-6);
    close(number(&json, "/grid/dx"), 0.5e-3 / 128.0, 1e-12);
    assert_eq!(number(&json, "/grid/nx"), 128.0);
    assert!(number(&json, "/work/convolutions") > 0.0 && number(&json, "/seconds") > 0.0);
}

/// The JSON fields are those of the document, no more and no less.
#[test]
fn json_fields_are_documented() {
    fn collect(value: &Value, name: &str, names: &mut Vec<String>) {
        match value {
            Value::Object(fields) => fields.iter().for_each(|(key, value)| {
                collect(value, format!("{name}.{key}").trim_start_matches('.'), names);
            }),
            _ => names.push(name.to_owned()),
        }
    }
    let (_folder, path) = scene(&dry(16));
    let mut found = Vec::new();
    collect(&json_of(&solve(&[path.to_str().unwrap(), "--json"])), "", &mut found);
    let document = include_str!("../../docs/output.md");
    let (_, table) = document.split_once("| field | meaning | unit |").unwrap();
    let first_cells =
        table.lines().skip(2).take_while(|line| line.starts_with('|')).map(|l| l.split('|').nth(1).unwrap());
    let mut expected: Vec<String> = first_cells
        .flat_map(|cell| cell.split(','))
        .map(|name| name.trim().trim_matches('`').to_owned())
        .collect();
    // Null in this scene.
    for table in ["moes", "oil", "flow", "stress", "thermal", "starvation", "error_estimate"] {
        expected.retain(|name| !name.starts_with(&format!("{table}.")));
        expected.push(table.to_owned());
    }
    found.sort();
    expected.sort();
    assert_eq!(found, expected);
}

#[test]
fn fast_smooth_film_has_no_contact() {
    let text = std::fs::read_to_string(format!("{SCENES}/smooth.toml")).unwrap();
    let (_folder, path) = scene(&text.replace("entrainment_speed = 0.1", "entrainment_speed = 2.0"));
    let output = solve(&[path.to_str().unwrap(), "--json"]);
    assert!(output.status.success(), "{output:?}");
    let json = json_of(&output);
    assert_eq!(number(&json, "/contact/load_ratio"), 0.0);
    assert_eq!(number(&json, "/contact/film_cutoff"), 1e-9);
    close(number(&json, "/moes/m"), 5518.2 / 20_f64.powf(0.75), 1e-3);
    assert!((30e-9..150e-9).contains(&number(&json, "/film/central")), "{json}");
    assert!(number(&json, "/film/minimum") < number(&json, "/film/central"));
    let [inflow, outflow] = ["/flow/inflow", "/flow/outflow"].map(|path| number(&json, path));
    // Of flows that are equal to their last digits only those of the imbalance are left.
    let imbalance = number(&json, "/flow/imbalance");
    assert!((imbalance - (outflow / inflow - 1.0).abs()).abs() < 1e-14 && imbalance < 1e-6, "{imbalance:e}");
}

#[test]
fn limit_of_iterations_ends_with_1() {
    let text = std::fs::read_to_string(format!("{SCENES}/rough_dry.toml")).unwrap();
    let (_folder, path) = scene(&format!("{text}\n[solver]\nmax_iterations = 1\n"));
    let output = solve(&[path.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let message = String::from_utf8(output.stderr.clone()).unwrap();
    assert!(message.lines().all(|line| line.starts_with("warning: grid.n")), "{message}");
    assert_eq!(json_of(&output)["status"], "max_iterations");
}

#[test]
fn report_is_short_text() {
    let output = solve(&[&format!("{SCENES}/rough_dry.toml")]);
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8(output.stdout).unwrap();
    let of_what: Vec<_> = text.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let said = "converged residuals work Hertz pressure contact roughness friction flow approach errors time";
    assert_eq!(of_what.join(" "), said, "{text}");
}

#[test]
fn bad_values_in_a_scene_are_one_line_and_end_with_2() {
    for (from, to, part) in [
        ("radius =", "raduis =", "raduis"),
        ("radius = 9.525e-3", "radius = \"big\"", "form.radius"),
        ("radius = 9.525e-3", "radius = ", "in `radius ="),
        ("nx = 16", "nx = 1", "grid.nx = 1"),
        ("nx = 16", "nx = 100000000", "grid.nx * grid.ny"),
        ("hertz_pressure = 1.15e9", "force = 0.0", "load.force = 0"),
    ] {
        let text = dry(16).replacen(from, to, 1);
        assert_ne!(text, dry(16), "{from}");
        let (_folder, path) = scene(&text);
        assert_refused(&["solve", path.to_str().unwrap(), "--json"], &[part]);
    }
    let (_folder, path) = scene(&dry(16));
    let inside_a_file = path.join("fields.npz");
    let fields = ["solve", path.to_str().unwrap(), "--fields", inside_a_file.to_str().unwrap()];
    assert_refused(&fields, &["scene.toml"]);
}

#[test]
fn heights_from_a_file_move_the_gap_of_their_own_node() {
    let (nx, ny) = (16, 12);
    let text =
        dry(nx).replace("ny = 16", "ny = 12") + "[roughness.disc]\nkind = \"file\"\npath = \"disc.npy\"\n";
    let (folder, path) = scene(&text);
    let mut heights = vec![0.0; nx * ny];
    heights[2 * nx + 5] = 50e-9;
    write_npy(folder.path().join("disc.npy"), nx, ny, &heights).unwrap();
    let fields = folder.path().join("fields.npz");
    let arguments = [path.to_str().unwrap(), "--json", "--fields", fields.to_str().unwrap()];
    assert!(solve(&arguments).status.success());

    let mut archive = zip::ZipArchive::new(std::fs::File::open(&fields).unwrap()).unwrap();
    let mut names: Vec<String> = archive.file_names().map(|name| name.unwrap().into_owned()).collect();
    names.sort();
    assert_eq!(
        names,
        [
            "film.npy",
            "fluid_pressure.npy",
            "gap.npy",
            "plastic_depth.npy",
            "pressure.npy",
            "theta.npy",
            "x.npy",
            "y.npy"
        ]
    );
    let mut gap = Vec::new();
    for name in names {
        let mut bytes = Vec::new();
        archive.by_name(&name).unwrap().read_to_end(&mut bytes).unwrap();
        let extracted = folder.path().join(&name);
        std::fs::write(&extracted, bytes).unwrap();
        let array = stribeck::surface::read(&extracted).unwrap();
        let shape = match name.as_str() {
            "x.npy" => (nx, 1),
            "y.npy" => (ny, 1),
            _ => (nx, ny),
        };
        assert_eq!((array.nx(), array.ny()), shape, "{name}");
        if let "x.npy" | "y.npy" = name.as_str() {
            // The box of the scene is half a millimetre wide, the first node in the middle of its cell.
            let first = 0.25e-3 * (1.0 / shape.0 as f64 - 1.0);
            assert!((array.heights()[0] / first - 1.0).abs() < 1e-12, "{name}: {}", array.heights()[0]);
        }
        if name == "gap.npy" {
            gap = array.heights().to_vec();
        }
    }
    let node = |i: usize, j: usize| gap[j * nx + i];
    // The smooth gap is the same at the mirrored node.
    assert!((node(10, 2) - node(5, 2) - 50e-9).abs() < 1e-15);
    assert!((node(10, 9) - node(5, 9)).abs() < 1e-15);
}

#[test]
fn warnings_are_on_the_terminal_and_in_the_json() {
    let text = dry(16).replace("radius = 9.525e-3", "radius = 9.525");
    let (_folder, path) = scene(&format!("{text}edge_contact = true\n"));
    let output = solve(&[path.to_str().unwrap(), "--json"]);
    let message = String::from_utf8(output.stderr.clone()).unwrap();
    let first = "warning: form.radius = 9.525: 9.525 m is implausible, above 1 m; did you mean 9.525 mm = 0.009525 m?";
    assert_eq!(message.lines().next(), Some(first));
    let json = json_of(&output);
    let warnings = json["warnings"].as_array().unwrap();
    assert_eq!(warnings.len(), message.lines().filter(|line| line.starts_with("warning: ")).count());
    let fields: Vec<&Value> = warnings.iter().map(|warning| &warning["field"]).collect();
    // Beyond the elastic range of any material.
    assert_eq!(fields, ["form.radius", "pressure.max"]);
    assert_eq!(number(&warnings[0], "/value"), 9.525);
    assert!(warnings[0]["message"].is_string() && warnings[0]["remedy"].is_string());
}

#[test]
fn estimates_are_printed_and_written() {
    let text = std::fs::read_to_string(format!("{SCENES}/rough.toml")).unwrap().replace("= 128", "= 64");
    let (_folder, path) = scene(&text.replace("[solver]", "[solver]\nestimate = true"));
    let json = json_of(&solve(&[path.to_str().unwrap(), "--json"]));
    assert_eq!(json["status"], "converged");
    let estimates = json["error_estimate"].as_object().unwrap();
    assert_eq!(estimates.len(), 8);
    for (key, value) in estimates {
        let documented = include_str!("../../docs/output.md").contains(&format!("`error_estimate.{key}`"));
        assert!(documented && value.as_f64().unwrap() >= 0.0, "{key}: {value}");
    }
    for key in ["film_mean_central", "friction_coefficient", "contact_load_ratio", "contact_area_ratio"] {
        assert!((1e-3..1.0).contains(&number(&json, &format!("/error_estimate/{key}"))), "{json}");
    }
    let [counted, corrected] =
        ["/contact/area_ratio", "/contact/corrected_area_ratio"].map(|path| number(&json, path));
    assert!(0.0 < corrected && corrected < counted);
    let report = String::from_utf8(solve(&[path.to_str().unwrap()]).stdout).unwrap();
    let errors = report.lines().find(|line| line.starts_with("errors")).unwrap();
    for name in ["mean film", "friction", "load ratio", "area ratio"] {
        assert!(errors.contains(name), "{errors}");
    }
}

#[test]
fn strip_is_solved_and_checked_per_metre() {
    let (_folder, path) = scene(
        &std::fs::read_to_string(format!("{SCENES}/strip.toml"))
            .unwrap()
            .replace("nx = 128", "nx = 64")
            .replace("ny = 64", "ny = 32"),
    );
    let path = path.to_str().unwrap();
    let [solved, json, checked] =
        [vec!["solve", path], vec!["solve", path, "--json"], vec!["check", path]].map(|line| stribeck(&line));
    assert!(
        [&solved, &json, &checked].iter().all(|output| output.status.success()),
        "{solved:?} {json:?} {checked:?}"
    );
    let printed = String::from_utf8(solved.stdout).unwrap();
    let sample = "--over roughness.ball.seed=1,1001,2001,3001 --out seeds`";
    for part in ["307.00 kN/m, half-width", "mm^2/s", "% of the area plastic", "on 64 x 32 nodes", sample] {
        assert!(printed.contains(part), "{part}: {printed}");
    }
    assert!(!printed.contains("500000") && !printed.contains("m^3/s"), "{printed}");
    close(number(&json_of(&json), "/hertz/force"), 307e3, 1e-12);
    let text = String::from_utf8(checked.stdout).unwrap();
    assert!(text.contains("307.00 kN/m, half-width") && text.contains("modelled   strip"), "{text}");
    assert!(text.contains("run        yes"), "{text}");
}

/// The numbers of a text, with the digits that are printed: "4.29", "1.6e-7".
fn printed_numbers(text: &str) -> Vec<&str> {
    let words =
        text.split(|letter: char| !(letter.is_ascii_digit() || matches!(letter, '.' | 'e' | '-' | '+')));
    words
        .map(|word| word.trim_matches(['.', '-', 'e', '+']))
        .filter(|word| word.parse::<f64>().is_ok())
        .collect()
}

fn numbers_in(json: &Value, found: &mut Vec<f64>) {
    match json {
        Value::Number(number) => found.extend(number.as_f64()),
        Value::Array(entries) => entries.iter().for_each(|entry| numbers_in(entry, found)),
        Value::Object(entries) => entries.values().for_each(|entry| numbers_in(entry, found)),
        _ => {}
    }
}

/// Compares the printed numbers of a command, but for the lines that begin with one of the words `without`, with its JSON. Angles are
/// printed in degrees.
fn assert_printed_numbers_are_in_the_json(arguments: &[&str], without: &[&str]) {
    let output = stribeck(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", error_of(&output));
    let printed = String::from_utf8(output.stdout).unwrap();
    let mut exact = Vec::new();
    numbers_in(&json_of(&stribeck(&[arguments, &["--json"]].concat())), &mut exact);
    let degrees: Vec<f64> = exact.iter().map(|value| value.to_degrees()).collect();
    exact.extend(degrees);
    let is_compared = |line: &&str| without.iter().all(|word| !line.trim_start().starts_with(word));
    let lines = printed.lines().filter(is_compared);
    for word in lines.flat_map(|line| printed_numbers(line.trim_end_matches("um^2 plastic"))) {
        let mantissa = word.split('e').next().unwrap();
        let shown: f64 = word.parse().unwrap();
        let decimals = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len() as i32);
        let exponent: i32 = word.split_once('e').map_or(0, |(_, digits)| digits.parse().unwrap());
        let half = 0.5001 * 10_f64.powi(exponent - decimals);
        // Units are powers of ten, areas those of micrometres.
        let is_found =
            |value: &f64| (-12..=18).any(|power| (value.abs() * 10_f64.powi(power) - shown).abs() <= half);
        assert!(exact.iter().any(is_found), "{word} is not in the JSON:\n{printed}");
    }
}

#[test]
fn json_has_every_printed_number() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[]);
    // Twice the same work takes other times.
    assert_printed_numbers_are_in_the_json(&["solve", text(&scene)], &["time"]);
    let out = folder.path().join("out");
    let curve = ["curve", text(&scene), "--points", "2", "--out", text(&out), "--force"];
    // Paths of files may have digits.
    assert_printed_numbers_are_in_the_json(&curve, &["written", "speed"]);
    let dry = repository("examples/scenes/dry_wear.toml");
    let run = ["run", text(&dry), "--duration", "20", "--time-step", "10"];
    // The digit of a unit is not a result: lines with such units are compared by name below.
    let units = [
        "contact.area",
        "contact.corrected_area ",
        "wear.ball_vol",
        "wear.disc_vol",
        "wear.ball_spec",
        "wear.disc_spec",
    ];
    assert_printed_numbers_are_in_the_json(&run, &units);
    let long = std::fs::read_to_string(repository("examples/scenes/cam.toml")).unwrap();
    let cam = folder.path().join("cam.toml");
    std::fs::write(&cam, long.replace("\nangle = [", "\nsteps = 100\nangle = [")).unwrap();
    let cycle = ["cycle", text(&cam), "--out", text(&out), "--force"];
    // The number of contacts is that of the points.
    assert_printed_numbers_are_in_the_json(&cycle, &["cycle", "time", "written"]);
}

/// The lines of a run whose units have digits.
#[test]
fn json_of_a_run_has_its_wear_rates() {
    let dry = repository("examples/scenes/dry_wear.toml");
    let run = ["run", text(&dry), "--duration", "20", "--time-step", "10"];
    let printed = String::from_utf8(stribeck(&run).stdout).unwrap();
    let json = json_of(&stribeck(&[&run[..], &["--json"]].concat()));
    for (name, column) in [("ball_specific_rate", 1), ("disc_specific_rate", 1), ("ball_volume", 2)] {
        let start = format!("wear.{name}");
        let line = printed.lines().find(|line| line.starts_with(&start)).unwrap();
        let shown: f64 = line.split_whitespace().nth(column).unwrap().parse().unwrap();
        close(shown, 1e9 * number(&json, &format!("/wear/{name}")), 1e-4);
    }
}
