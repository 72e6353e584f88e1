//! Every warning of `docs/errors.md` on the terminal, in the JSON, in the solution and in a run.
#![expect(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{error_of, json_of, stribeck, text};
use serde_json::Value;
use stribeck::sim::{MixedLubricationSim, Scene, solve_contact};

/// A dry contact without a warning.
const GOOD: &str = r#"
[form]
kind = "sphere"
radius = 9.525e-3
[elastic]
equivalent_modulus = 229.67e9
[load]
force = 50.0
[motion]
entrainment_speed = 0.1
slide_roll_ratio = 0.05
[grid]
nx = 24
ny = 24
x = [-0.25e-3, 0.25e-3]
y = [-0.25e-3, 0.25e-3]
[roughness.disc]
kind = "gaussian"
rq = 130e-9
length_x = 64e-6
length_y = 64e-6
[solver]
edge_contact = false
"#;
const OIL: &str = "[lubricant]\neta0 = 0.04\nroelands_z = 0.68\nalpha = 20e-9\n[solver]";

/// Subject of a warning, the change of the valid scene that causes it, its field and words of it.
struct Case {
    about: &'static str,
    changes: &'static [(&'static str, &'static str)],
    field: &'static str,
    words: &'static str,
    /// Whether a history has it.
    in_run: bool,
}

const CASES: [Case; 10] = [
    Case {
        about: "a near edge",
        changes: &[("x = [-0.25e-3", "x = [-0.2e-3")],
        field: "grid.x",
        words: "less than 1.5 Hertz half-widths",
        in_run: true,
    },
    Case {
        about: "a wide contact",
        changes: &[
            ("force = 50.0", "force = 3e6"),
            ("-0.25e-3, 0.25e-3", "-25e-3, 25e-3"),
            ("= 64e-6", "= 6.4e-3"),
        ],
        field: "load.force",
        words: "of the radius",
        in_run: true,
    },
    Case {
        about: "cells wider than waves",
        changes: &[("= 64e-6", "= 40e-6")],
        field: "grid.nx",
        words: "wider than a third of the shortest waves",
        in_run: true,
    },
    Case {
        about: "waves of any length",
        changes: &[("\"gaussian\"", "\"exponential\"")],
        field: "grid.nx",
        words: "waves down to any length",
        in_run: true,
    },
    Case {
        about: "another unit",
        changes: &[("slide_roll_ratio = 0.05", "slide_roll_ratio = 5.0")],
        field: "motion.slide_roll_ratio",
        words: "did you mean 5 % = 0.05?",
        in_run: true,
    },
    Case {
        about: "rough as the contact is wide",
        changes: &[("rq = 130e-9", "rq = 20e-6"), ("= false", "= true")],
        field: "roughness.disc.rq",
        words: "is implausible, above",
        in_run: true,
    },
    Case {
        about: "a formula out of its range",
        changes: &[
            ("[solver]", OIL),
            (
                "kind = \"sphere\"\nradius = 9.525e-3",
                "kind = \"ellipsoid\"\nradius_x = 12e-3\nradius_y = 8e-3",
            ),
        ],
        field: "film.formula_central",
        words: "outside the range of the formula of Hamrock and Dowson",
        in_run: true,
    },
    Case {
        about: "a film as thick as the ball",
        changes: &[
            ("rq = 130e-9", "rq = 0.0"),
            ("= 229.67e9", "= 10e6"),
            ("force = 50.0", "force = 0.1"),
            ("entrainment_speed = 0.1", "entrainment_speed = 5.0"),
            ("x = [-0.25e-3, 0.25e-3]", "x = [-2.5e-3, 1.5e-3]"),
            ("y = [-0.25e-3, 0.25e-3]", "y = [-2e-3, 2e-3]"),
            ("[solver]\nedge_contact = false", OIL),
        ],
        field: "film.central",
        words: "whose gap differs by",
        in_run: true,
    },
    Case {
        about: "twice the Hertz pressure",
        changes: &[
            ("rq = 130e-9", "rq = 0.0"),
            ("-0.25e-3, 0.25e-3", "-0.05e-3, 0.05e-3"),
            ("= false", "= true"),
        ],
        field: "pressure.max",
        words: "times the Hertz pressure",
        in_run: true,
    },
    Case {
        about: "a large error of the mesh",
        changes: &[("= false", "= false\nestimate = true"), ("rq = 130e-9", "rq = 300e-9")],
        field: "error_estimate.",
        words: "errors of the mesh above 0.1",
        in_run: true,
    },
];

/// The warning is in `json` and a line of `terminal`; the warnings.
fn assert_warned(case: &Case, json: &Value, terminal: &str) -> Value {
    let about = case.about;
    let warnings = json["warnings"].as_array().unwrap();
    let told = warnings.iter().find(|warning| {
        let part = |name: &str| warning[name].as_str().unwrap();
        let all = format!("{}; {}", part("message"), part("remedy"));
        part("field").starts_with(case.field) && all.contains(case.words)
    });
    assert!(told.is_some_and(|warning| warning["value"].is_number()), "{about}: {warnings:?}");
    let line =
        |line: &&str| line.starts_with(&format!("warning: {}", case.field)) && line.contains(case.words);
    assert_eq!(terminal.lines().filter(line).count(), 1, "{about}: {terminal}");
    assert_eq!(terminal.matches("warning: ").count(), warnings.len(), "{about}: {terminal}");
    json["warnings"].clone()
}

#[test]
fn surface_file_without_unit_is_one_warning_of_check_solve_and_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let row = ["1e-9"; 24].join(" ") + "\n";
    for (header, expected) in [("", 1), ("unit: m\n", 0)] {
        std::fs::write(folder.path().join("disc.txt"), format!("{header}{}", row.repeat(24))).unwrap();
        let (before, after) = GOOD.split_once("kind = \"gaussian\"").unwrap();
        let solver = after.split_once("[solver]").unwrap().1;
        let scene = format!("{before}kind = \"file\"\npath = \"disc.txt\"\n[solver]{solver}");
        std::fs::write(&path, scene.replace("edge_contact = false", "")).unwrap();
        let run = ["run", text(&path), "--steps", "1", "--time-step", "1", "--json"];
        for arguments in [&["check", text(&path), "--json"][..], &["solve", text(&path), "--json"], &run] {
            let output = stribeck(arguments);
            let json = json_of(&output);
            let warnings = json["warnings"].as_array().unwrap();
            let found: Vec<&Value> =
                warnings.iter().filter(|warning| warning["field"] == "roughness.disc.path").collect();
            assert_eq!(found.len(), expected, "{arguments:?}: {json}");
            let line = "warning: roughness.disc.path: the file names no unit of its heights";
            assert_eq!(error_of(&output).matches(line).count(), expected, "{arguments:?}");
            assert!(found.iter().all(|warning| warning["value"].is_null()), "{json}");
        }
    }
}

#[test]
fn every_warning_is_in_text_json_and_library() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    assert!(solve_contact(&Scene::from_toml(GOOD).unwrap()).unwrap().warnings.is_empty());
    for case in &CASES {
        let about = case.about;
        let changed = case.changes.iter().fold(GOOD.to_owned(), |text, (from, to)| {
            assert!(text.contains(from), "{about}: {from}");
            text.replace(from, to)
        });
        std::fs::write(&path, &changed).unwrap();
        let scene = Scene::from_toml(&changed).unwrap();
        let output = stribeck(&["solve", text(&path), "--json"]);
        let told = assert_warned(case, &json_of(&output), &error_of(&output));
        let solution = solve_contact(&scene).unwrap();
        assert_eq!(told, serde_json::to_value(&solution.warnings).unwrap(), "{about}");
        if !case.in_run {
            continue;
        }
        let arguments = ["run", text(&path), "--steps", "1", "--time-step", "1", "--json"];
        let output = stribeck(&arguments);
        let lines: Vec<String> = error_of(&output).lines().map(str::to_owned).collect();
        let warnings: Vec<&str> =
            lines.iter().map(String::as_str).filter(|line| line.starts_with("warning: ")).collect();
        let told = assert_warned(case, &json_of(&output), &warnings.join("\n"));
        let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
        sim.step(1.0).unwrap();
        assert_eq!(told, serde_json::to_value(sim.warnings()).unwrap(), "{about}");
    }
}
