//! Files that `stribeck cycle` and `stribeck init --cam` read and write.
#![expect(clippy::unwrap_used, reason = "tests")]

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{assert_pictures, assert_refused, error_of, json_of, stribeck, text};

const SCENE: &str = "form = { kind = \"cylinder\", radius = 10e-3 }\nelastic.equivalent_modulus = 230e9\nload.force = 1e5\n\
                     motion = { entrainment_speed = 1.0, slide_roll_ratio = 0.2 }\nfriction.eyring_stress = 5e6\n\
                     lubricant = { eta0 = 0.02, alpha = 15e-9, roelands_z = 0.6, inlet = \"box_edge\" }\n";
const GRID: &str = "grid = { nx = 96, x = [-0.4e-3, 0.4e-3] }\n";
const CYCLE: &str = "[cycle]\ntable = \"rows.txt\"\nquasi_static = true\n";

/// A scene in `folder` with the `rows` of its cycle.
fn scene(folder: &Path, rows: &str, more: &str) -> PathBuf {
    let path = folder.join("cam.toml");
    fs::write(folder.join("rows.txt"), rows).unwrap();
    fs::write(&path, format!("{SCENE}{more}{CYCLE}")).unwrap();
    path
}

fn cycle(path: &Path, more: &[&str]) -> std::process::Output {
    let out = path.parent().unwrap();
    stribeck(&[&["cycle", text(path), "--out", text(out)], more].concat())
}

#[test]
fn tables_have_cells_between_any_separators() {
    let folder = tempfile::tempdir().unwrap();
    let table = "time (ms),load (N/mm)\n0,100\n1,110\n2,100\n";
    let loads = ["\t", ";", "  "].map(|separator| {
        let path = scene(folder.path(), &table.replace(',', separator), GRID);
        let output = cycle(&path, &["--json", "--force"]);
        assert!(output.status.success(), "{separator:?}: {}", error_of(&output));
        json_of(&output)["points"][1]["load"].as_f64().unwrap()
    });
    assert!(loads.iter().all(|load| (load - 1.1e5).abs() < 1e-6), "{loads:?}");
}

#[test]
fn tables_are_refused_by_line_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let cases: [(&str, &[&str]); 10] = [
        ("time (ms)\tload\n0\t1e5\n0,5\t1e5\n", &["line 3", "column time (ms)", "0,5", "decimal point"]),
        ("time (ms);load\n0;1e5\n1;1,1e5\n", &["line 3", "column load", "1,1e5", "decimal point"]),
        ("time (ms);load\n0,5;1e5\n", &["line 2", "0,5", "decimal point"]),
        ("time\tload\n0\t\n", &["line 2 has 1 values", "time, load"]),
        ("time,load\n# note\n\n0,\n", &["line 4", "load is empty"]),
        ("time load\n0 1e5\n1\n", &["line 3 has 1 values, expected 2", "time, load"]),
        ("time,radius\n0,1e-2\n1,-1e-2\n", &["line 3", "radius = -1e-2", "> 0"]),
        ("time,load\n0,1e5\n", &["single row", "at least 2"]),
        ("time,load\n", &["no rows"]),
        ("load\n1e5\n1e5\n", &["neither a column time nor angle"]),
    ];
    for (rows, words) in cases {
        let path = scene(folder.path(), rows, GRID);
        assert_refused(&["cycle", text(&path), "--out", text(folder.path())], words);
    }
}

#[test]
fn solved_cycle_is_taken_from_its_file_until_its_scene_changes() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "time,load\n0,1e5\n1e-3,1.1e5\n2e-3,1e5\n";
    let path = scene(folder.path(), rows, GRID);
    let first = cycle(&path, &["--json"]);
    assert!(first.status.success(), "{}", error_of(&first));
    let again = cycle(&path, &["--json", "--plot"]);
    assert!(error_of(&again).contains("solved: "), "{}", error_of(&again));
    assert_eq!(json_of(&first), json_of(&again));
    assert_pictures(folder.path(), "cam_cycle", &["film (nm)"]);
    let forced = cycle(&path, &["--force"]);
    assert!(forced.status.success() && !error_of(&forced).contains("solved: "), "{}", error_of(&forced));
    // of a table that is newer than the result
    let kept = fs::File::options().append(true).open(folder.path().join("cam_cycle.json")).unwrap();
    kept.set_modified(std::time::UNIX_EPOCH).unwrap();
    let renewed = cycle(&path, &["--json"]);
    assert!(renewed.status.success() && !error_of(&renewed).contains("solved: "), "{}", error_of(&renewed));
    scene(folder.path(), rows, &GRID.replace("96", "98"));
    assert_refused(&["cycle", text(&path), "--out", text(folder.path())], &["cam_cycle", "--force"]);
}

/// Half-width `sqrt(8 F R/(pi E'))` of 105.2 um in cells of 800/64 = 12.5 um.
#[test]
fn cycles_warn_of_few_cells_in_the_narrowest_contact_and_of_the_estimate() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "time,load\n0,1.2e5\n1e-3,1e5\n2e-3,1.2e5\n";
    let more = format!("{}solver.estimate = true\n", GRID.replace("96", "64"));
    let output = cycle(&scene(folder.path(), rows, &more), &[]);
    let told = error_of(&output);
    assert!(output.status.success(), "{told}");
    for words in ["line 3 has 8.4 cells", "at least 77 cells", "solver.estimate: ", "compare two meshes"] {
        assert!(told.contains(words), "no `{words}` in {told}");
    }
    let fine = cycle(&scene(folder.path(), rows, GRID), &["--force"]);
    assert!(!error_of(&fine).contains("grid.nx"), "{}", error_of(&fine));
}

#[test]
fn lifts_are_refused_by_line_and_have_units() {
    let folder = tempfile::tempdir().unwrap();
    let [path, lift] = ["machine.toml", "lift.txt"].map(|name| folder.path().join(name));
    let entry = |k: u32| {
        let d = (5.0 * f64::from(k) - 180.0) / 75.0;
        (5.0 * f64::from(k), if d.abs() < 1.0 { 8.0 * (1.0 - d * d).powi(3) } else { 0.0 })
    };
    let line = |k: u32, size: f64| format!("{}\t{}\n", entry(k).0, size * entry(k).1);
    let arguments =
        ["init", text(&path), "--cam", text(&lift), "--base-circle", "26 mm", "--face-width", "12 mm"];
    let more =
        ["--rotation", "1000", "--spring-rate", "30000", "--preload", "250 N", "--mass", "0.12", "--force"];
    let arguments = [&arguments[..], &more].concat();
    let rise = |size: f64| (0..72).map(|k| line(k, size)).collect::<String>();
    let cases: [(String, &[&str]); 5] = [
        ((0..72).rev().map(|k| line(k, 1e-3)).collect(), &["line 2", "350 follows 355", "rise"]),
        (rise(-1e-3), &["no lift is above 0"]),
        (format!("{}360 0.001\n", rise(1e-3)), &["line 73", "0.001", "equal"]),
        (rise(1.0), &["line 25: the lift of 0.373", "metres"]),
        (rise(1e-3).replace('.', ","), &["line 23", "metres"]),
    ];
    for (rows, words) in cases {
        fs::write(&lift, rows).unwrap();
        assert_refused(&arguments, words);
    }
    let scenes = [rise(1e-3), format!("angle (deg)\tlift (mm)\n{}", rise(1.0))].map(|rows| {
        fs::write(&lift, rows).unwrap();
        let output = stribeck(&arguments);
        assert!(output.status.success(), "{}", error_of(&output));
        let loads = fs::read_to_string(&path).unwrap();
        loads.split("radius = [").nth(1).unwrap().split(']').next().unwrap().to_owned()
    });
    assert_eq!(scenes[0], scenes[1]);
    let written = |arguments: &[&str]| {
        let output = stribeck(arguments);
        assert!(output.status.success(), "{}", error_of(&output));
        fs::read_to_string(&path).unwrap()
    };
    let units = arguments.iter().map(|word| match *word {
        "1000" => "1000 rpm",
        "30000" => "30 N/mm",
        "0.12" => "120 g",
        word => word,
    });
    let units: Vec<&str> = units.collect();
    assert_eq!(written(&arguments), written(&units));
    let wrong: Vec<&str> =
        arguments.iter().map(|word| if *word == "30000" { "30 kN" } else { word }).collect();
    assert_refused(&wrong, &["--spring-rate", "30 kN", "N/mm, N/m"]);
    // Of a least radius of about 6 mm digits to 0.01 mm at steps of 5 degrees leave 0.9 mm open, digits to 0.1 um 9 um.
    for (decimals, is_said) in [(2, true), (4, false)] {
        let rows: String = (0..72).map(|k| format!("{} {:.decimals$}\n", entry(k).0, entry(k).1)).collect();
        fs::write(&lift, format!("angle (deg) lift (mm)\n{rows}")).unwrap();
        let told = error_of(&stribeck(&arguments));
        assert_eq!(told.contains("lifts are rounded to 10.000 um"), is_said, "{told}");
    }
}
