//! `stribeck init` of rigs and bearings, curves of rigid bearings.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use std::f64::consts::PI;

use common::{assert_refused, error_of, json_of, repository, stribeck, text};

/// The scene that `init` writes with these options, and its solution.
fn solved(options: &[&str]) -> (String, serde_json::Value) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let output = stribeck(&[["init"].as_slice(), options, &[text(&path)]].concat());
    assert!(output.status.success(), "{options:?}: {}", error_of(&output));
    let solution = stribeck(&["solve", text(&path), "--json"]);
    assert_eq!(solution.status.code(), Some(0), "{options:?}: {}", error_of(&solution));
    (std::fs::read_to_string(&path).unwrap(), json_of(&solution))
}

fn close(value: &serde_json::Value, expected: f64, tolerance: f64) {
    let value = value.as_f64().unwrap();
    assert!((value / expected - 1.0).abs() < tolerance, "{value:e} is not {expected:e}");
}

#[test]
fn rigs_are_solved_without_a_further_word() {
    let (_, mtm) = solved(&["--rig", "mtm"]);
    close(&mtm["hertz"]["force"], 37.0, 1e-9);
    close(&mtm["hertz"]["pressure"], 1e9, 0.02);
    let (_, glass) = solved(&["--rig", "ball-on-disc"]);
    close(&glass["hertz"]["pressure"], 0.5e9, 0.1);
    let (_, pin) = solved(&["--rig", "pin-on-disc", "--load", "5 N"]);
    close(&pin["hertz"]["force"], 5.0, 1e-9);
    close(&pin["friction"]["coefficient"], 0.6, 1e-6);
    close(&pin["friction"]["power_loss"], 0.3, 1e-6);
    let (_, discs) = solved(&["--rig", "twin-disc"]);
    close(&discs["hertz"]["pressure"], 1e9, 1e-6);
    // 147 N/sqrt(6) on each of three balls, sliding at 0.4607 m/s
    let (balls, four) = solved(&["--rig", "four-ball"]);
    close(&four["hertz"]["force"], 60.012, 1e-4);
    assert!(balls.contains("ball_speed = 0.460") && balls.contains("ASTM D4172"), "{balls}");
    assert!(balls.contains("bulk_temperature = \"75 degC\""), "{balls}");
}

#[test]
fn bearings_have_their_inner_geometry_and_source() {
    let (scene, ball) = solved(&["--bearing", "6205", "--load", "2 kN", "--rotation", "1500"]);
    close(&ball["hertz"]["force"], 5.0 * 2000.0 / 9.0, 1e-5);
    assert!(scene.contains("9 balls of 7.94 mm on 39.04 mm: Case Western"), "{scene}");
    let speed: f64 = scene
        .lines()
        .find_map(|line| line.strip_prefix("entrainment_speed = "))
        .unwrap()
        .split(' ')
        .next()
        .unwrap()
        .parse()
        .unwrap();
    let expected = 0.25 * 39.04e-3 * 50.0 * PI * (1.0 - (7.94_f64 / 39.04).powi(2));
    assert!((speed / expected - 1.0).abs() < 1e-5, "{speed}");
    // ISO 281 with the viscosity of ISO VG 68 at 60 degC: 28.4 mm^2/s over 18.60 mm^2/s.
    close(&ball["oil"]["kappa"], 28.4 / 18.60, 0.02);
    let (_, roller) = solved(&["--bearing", "nu 209"]);
    close(&roller["hertz"]["force"], 5.0 * 1000.0 / 14.0 / 9.6e-3, 1e-5);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    assert_refused(
        &["init", "--bearing", "7208", text(&path)],
        &["7208", "deep-groove", "its bore of 40 mm: 6008, 6208, 6308, NU208"],
    );
    assert_refused(&["init", "--bearing", "NU2210", text(&path)], &["its bore of 50 mm", "NU210"]);
    for option in [["--stroke", "1 mm"], ["--surface", "heights.csv"]] {
        assert_refused(
            &[&["init", "--bearing", "6205"], option.as_slice(), &[text(&path)]].concat(),
            &[option[0], "no effect", "--bearing"],
        );
    }
    assert!(!path.exists());
}

/// Of a bearing without published geometry the scene says that it is an estimate. 6206 has 9 balls of 9.525 mm on 46 mm.
#[test]
fn estimated_bearings_say_so() {
    let (scene, ball) = solved(&["--bearing", "6206-2RS", "--load", "2 kN"]);
    close(&ball["hertz"]["force"], 5.0 * 2000.0 / 9.0, 1e-5);
    for part in ["ESTIMATE", "ISO 15, 30 and 62 mm", "pitch circle 46 mm, 9 elements of 9.6 mm"] {
        assert!(scene.contains(part), "{part}: {scene}");
    }
    let (scene, roller) = solved(&["--bearing", "NU205", "--load", "2 kN"]);
    assert!(
        scene.contains("proportions of NU209") && roller["hertz"]["force"].as_f64().unwrap() > 0.0,
        "{scene}"
    );
}

/// A rough roller is a strip, on which asperities carry load where lambda is low.
#[test]
fn rough_roller_is_a_strip() {
    let rough = [
        "--roller",
        "--radius",
        "3 mm",
        "--load",
        "60 kN/m",
        "--speed",
        "0.003 m/s",
        "--roughness",
        "0.2 um",
    ];
    let (scene, roller) = solved(&[rough.as_slice(), &["--length", "30 um"]].concat());
    assert!(scene.contains("across = \"periodic\"") && scene.contains("[plastic]"), "{scene}");
    assert!(roller["film"]["lambda"].as_f64().unwrap() < 1.0, "{roller}");
    assert!(roller["contact"]["load_ratio"].as_f64().unwrap() > 0.01, "{roller}");
    assert!(roller["error_estimate"]["friction_coefficient"].as_f64().unwrap() > 0.0, "{roller}");
    let warnings = roller["warnings"].as_array().unwrap();
    // Of a contact with estimates the errors are named, not that they are unknown.
    let fields: Vec<_> = warnings.iter().filter_map(|warning| warning["field"].as_str()).collect();
    assert!(fields.iter().all(|field| field.starts_with("error_estimate.")), "{fields:?}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    assert_refused(&["init", "--roller", "--roughness", "0.2 um", text(&path)], &["--length", "missing"]);
    std::fs::write(&path, scene.replace("seed = 1", "seed = 1\ncells = [8, 8, 8]\n#")).unwrap();
    assert_refused(&["check", text(&path)], &["length 3, expected 2 values in `roughness.disc.cells`"]);
    std::fs::write(&path, scene.replace("ny = 20", "ny = 160")).unwrap();
    let checked = error_of(&stribeck(&["check", text(&path)]));
    let (before, _) = checked.split_once(" times as long along the flow").unwrap();
    assert!(before.split(' ').next_back().unwrap().len() < 5, "{checked}");
}

#[test]
fn roller_and_journal_are_solved_without_a_further_word() {
    let (_, roller) = solved(&["--roller", "--load", "100 kN/m"]);
    close(&roller["hertz"]["force"], 100e3, 1e-9);
    let (scene, journal) = solved(&["--journal"]);
    close(&journal["load"], 2000.0, 1e-5);
    let rise =
        journal["outlet_temperature"].as_f64().unwrap() - journal["supply_temperature"].as_f64().unwrap();
    let [power, flow] = ["power_loss", "side_flow"].map(|name| journal[name].as_f64().unwrap());
    assert!((rise - power / (1.7e6 * flow)).abs() < 1e-6 && rise > 1.0, "{scene}");
}

/// Under ten times the speed the Sommerfeld number of the same load is a tenth: the journal rises towards the middle.
#[test]
fn curve_of_a_journal_is_over_speed_load_and_temperature() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/scenes/journal.toml");
    let coarse =
        std::fs::read_to_string(scene).unwrap().replace("[lubricant]", "nx = 60\nny = 8\n[lubricant]");
    let path = folder.path().join("journal.toml");
    std::fs::write(&path, coarse).unwrap();
    let curve = |over: &str| {
        let out = text(folder.path());
        let output = stribeck(&[
            "curve",
            text(&path),
            "--over",
            over,
            "--points",
            "3",
            "--json",
            "--out",
            out,
            "--force",
        ]);
        assert_eq!(output.status.code(), Some(0), "{}", error_of(&output));
        let points = json_of(&output)["points"].as_array().unwrap().clone();
        let of = |name: &str| points.iter().map(|point| point[name].as_f64().unwrap()).collect::<Vec<f64>>();
        [of("eccentricity"), of("load"), of("power_loss")]
    };
    let [eccentricity, load, power] = curve("speed");
    assert!(eccentricity[0] > eccentricity[1] && eccentricity[1] > eccentricity[2], "{eccentricity:?}");
    assert!(power[2] > 50.0 * power[1] && load.iter().all(|load| (load / 2000.0 - 1.0).abs() < 1e-5));
    let [eccentricity, load, _] = curve("load");
    assert!((load[0] / 200.0 - 1.0).abs() < 1e-5 && eccentricity[0] < eccentricity[2], "{eccentricity:?}");
    let [eccentricity, ..] = curve("temperature");
    assert!(eccentricity[2] > eccentricity[0], "{eccentricity:?}");
    let csv = std::fs::read_to_string(folder.path().join("journal_curve_load.csv")).unwrap();
    assert_eq!(csv.lines().count(), 4);
    assert!(csv.starts_with("load_N,eccentricity,least_film_m"), "{csv}");
    let refused = |over: &str, words: &[&str]| {
        assert_refused(&["curve", text(&path), "--over", over, "--out", text(folder.path())], words);
    };
    refused("slide_roll_ratio", &["slide_roll_ratio", "at rest"]);
    let pad = repository("examples/scenes/textured_pad.toml");
    assert_refused(&["curve", text(&pad), "--over", "load", "--out", text(folder.path())], &["load", "film"]);
}

/// A bearing with holes has pictures and a report in the units of engineers, whose numbers are those of the JSON object.
#[test]
fn bearings_have_pictures_and_a_report() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("journal.toml");
    let holes = "nx = 80\nny = 12\nhole_angles = [\"180 deg\"]\nhole_diameter = \"6 mm\"\nsupply_pressure = \"2 bar\"\n[lubricant]";
    let scene = std::fs::read_to_string(repository("examples/scenes/journal.toml")).unwrap();
    std::fs::write(&path, scene.replace("[lubricant]", holes)).unwrap();
    let report = folder.path().join("report.html");
    let out = text(folder.path());
    let solved =
        stribeck(&["solve", text(&path), "--json", "--plot", "--out", out, "--report", text(&report)]);
    assert_eq!(solved.status.code(), Some(0), "{}", error_of(&solved));
    common::assert_pictures(
        folder.path(),
        "journal_profile",
        &["pressure (MPa)", "film (um)", "film fraction", "angle from the load, along the rotation (deg)"],
    );
    let json = json_of(&solved);
    close(&json["hole_flow"], json["side_flow"].as_f64().unwrap(), 1e-5);
    let page = std::fs::read_to_string(&report).unwrap();
    for (name, value, unit) in [
        ("Flow from holes", 1e6 * json["hole_flow"].as_f64().unwrap(), "ml/s"),
        ("Least film", 1e6 * json["least_film"].as_f64().unwrap(), "\u{b5}m"),
        ("Attitude angle", json["attitude"].as_f64().unwrap().to_degrees(), "\u{b0}"),
    ] {
        let row = page.split("<tr>").find(|row| row.contains(&format!("<th>{name}</th>"))).unwrap();
        let shown: f64 = row.split("</span>").next().unwrap().rsplit('>').next().unwrap().parse().unwrap();
        assert!((shown / value - 1.0).abs() < 1e-3 && row.contains(unit), "{name}: {row} {value}");
    }
    assert!(!page.contains("<th>least_film"), "keys are no labels");
}

/// Rough surfaces add columns; a flat contact has no curve, and the message says how to solve it.
#[test]
fn curve_of_a_rough_journal_has_the_share_of_solids() {
    let folder = tempfile::tempdir().unwrap();
    let rough = "nx = 60\nny = 8\n[given_film.roughness]\nrq = [\"0.2 um\", \"0.4 um\"]\nasperity_number = 0.05\n\
                 rq_over_radius = 0.01\nequivalent_modulus = \"230 GPa\"\nboundary_friction = 0.1\n[lubricant]";
    let scene = std::fs::read_to_string(repository("examples/scenes/journal.toml")).unwrap();
    let path = folder.path().join("rough.toml");
    std::fs::write(&path, scene.replace("[lubricant]", rough)).unwrap();
    let out = text(folder.path());
    let report = folder.path().join("report.html");
    let curve = [
        "curve",
        text(&path),
        "--from",
        "0.01 m/s",
        "--to",
        "1 m/s",
        "--points",
        "3",
        "--out",
        out,
        "--plot",
    ];
    let output = stribeck(&[&curve[..], &["--report", text(&report)]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", error_of(&output));
    assert!(String::from_utf8(output.stdout).unwrap().contains("solids, %"));
    let csv = std::fs::read_to_string(folder.path().join("rough_curve.csv")).unwrap();
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let column = lines.next().unwrap().iter().position(|name| *name == "contact_share").unwrap();
    let shares: Vec<f64> = lines.map(|line| line[column].parse().unwrap()).collect();
    assert!(shares.len() == 3 && shares[0] > 0.7 && shares[0] > shares[1] && shares[2] < 1e-3, "{shares:?}");
    let labels = ["least film (um)", "friction coefficient", "speed of the moving surface (m/s)"];
    common::assert_pictures(folder.path(), "rough_curve", &labels);
    let page = std::fs::read_to_string(report).unwrap();
    assert!(page.contains("least film") && page.contains("largest pressure"), "{page}");
    let report = String::from_utf8(stribeck(&["solve", text(&path)]).stdout).unwrap();
    assert!(report.contains("% of the load on solids"), "{report}");
    let flat = repository("examples/scenes/flat.toml");
    assert_refused(&["curve", text(&flat), "--out", out], &["flat", "stribeck solve", "load.mean_pressure"]);
}

/// Rigs and bearings take roughness: the disc has it on cells that hold it, in a box as wide as asperities reach.
#[test]
fn rigs_and_bearings_take_roughness() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    for element in [["--rig", "mtm"], ["--rig", "pin-on-disc"], ["--rig", "twin-disc"], ["--bearing", "6205"]]
    {
        let rough = ["--roughness", "0.2 um", "--length", "30 um", "--force", "--json"];
        let output = stribeck(&[&["init", text(&path)], &element[..], &rough].concat());
        assert_eq!(output.status.code(), Some(0), "{element:?}: {}", error_of(&output));
        // The groove of a ball bearing is outside of the range of the film formula.
        let unexpected = |line: &&str| line.starts_with("warning") && !line.contains("ellipticity");
        assert_eq!(error_of(&output).lines().find(unexpected), None, "{element:?}");
        let json = json_of(&output);
        close(&json["roughness"]["disc"]["rq"], 0.2e-6, 1e-9);
        let [low, high] = [0, 1].map(|end| json["grid"]["x"][end].as_f64().unwrap());
        let cell = (high - low) / json["grid"]["nx"].as_f64().unwrap();
        assert!(cell <= 30e-6 / 4.0, "{element:?}: {cell}");
    }
    // A wide ellipse has too many nodes. The strip that is offered in its place has its pressure.
    let polished = ["--finish", "polished", "--force", "--json"];
    let refused = stribeck(&[&["init", text(&path), "--bearing", "6205"], &polished[..]].concat());
    let error = error_of(&refused);
    assert!(error.contains("262144 nodes") && !error.contains("--cells"), "{error}");
    let (_, offered) = error.split_once("with --radius ").unwrap();
    let values: Vec<&str> = offered.split('"').step_by(2).collect();
    let quoted: Vec<&str> = offered.split('"').skip(1).step_by(2).collect();
    assert_eq!(values, ["", " --load ", " --speed ", " --slide-roll-ratio 0\n"], "{error}");
    let strip = ["--roller", "--radius", quoted[0], "--load", quoted[1], "--speed", quoted[2]];
    let output = stribeck(&[&["init", text(&path)], &strip[..], &polished].concat());
    assert_eq!(output.status.code(), Some(0), "{}", error_of(&output));
    assert_eq!(json_of(&output)["grid"]["ny"], 20);
    let pressure = || stribeck::sim::Scene::load(&path).unwrap().hertz().unwrap().pressure;
    let line = pressure();
    assert!(stribeck(&["init", text(&path), "--bearing", "6205", "--force"]).status.success());
    let ellipse = pressure();
    assert!((line / ellipse - 1.0).abs() < 0.01, "{line} {ellipse}");
    // Ground finishes are within the small slopes of the model, and strips of any length within the nodes.
    for element in [["--rig", "twin-disc"], ["--rig", "mtm"]] {
        let ground =
            stribeck(&[&["init", text(&path)], &element[..], &["--finish", "ground", "--force"]].concat());
        assert!(ground.status.success() && !error_of(&ground).contains("gradient"), "{}", error_of(&ground));
    }
    let finish = ["init", text(&path), "--rig", "ball-on-disc", "--finish", "honed", "--force"];
    assert!(stribeck(&finish).status.success());
    assert!(std::fs::read_to_string(&path).unwrap().contains("typical of a honed surface"));
}

#[test]
fn options_that_an_element_leaves_out_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    for (arguments, option) in [
        (&["--roller", "--surface", "heights.csv"][..], "--surface"),
        (&["--roller", "--cells", "64"], "--cells"),
        (&["--bearing", "6205", "--speed", "2 m/s"], "--speed"),
        (&["--journal", "--radius", "10 mm"], "--radius"),
        (&["--rig", "pin-on-disc", "--grade", "ISO VG 46"], "--grade"),
        (&["--rig", "four-ball", "--slide-roll-ratio", "1"], "--slide-roll-ratio"),
    ] {
        assert_refused(&[&["init", text(&path)], arguments].concat(), &[option, "no effect", arguments[0]]);
    }
    assert!(!path.exists());
}
