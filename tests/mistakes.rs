//! Mistakes that people make with scenes and calls: each ends with an error or a warning that names the
//! wrong. None panics, hangs or converges in silence.

use std::path::Path;

use stribeck::SurfaceState;
use stribeck::sim::scene::{FileRoughness, GridSpec, InletSpec, Roughness};
use stribeck::sim::{MixedLubricationSim, Scene, Schedule, SimError, Warning, solve_contact};
use stribeck::surface::{Heights, write_npy, write_text};
use stribeck::wear::WearLaw;

/// A scene without mistakes: rough, in oil, of a few cells.
const GOOD: &str = r#"
[form]
kind = "sphere"
radius = 9.525e-3
[elastic]
equivalent_modulus = 229.67e9
[load]
hertz_pressure = 1.15e9
[motion]
entrainment_speed = 0.1
slide_roll_ratio = 0.05
[lubricant]
eta0 = 0.004
roelands_z = 0.68
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
[plastic]
hardness = 6e9
[friction]
boundary_coefficient = 0.1
[thermal]
bulk_temperature = 353.15
[solver]
max_iterations = 40
film_cutoff = 1e-9
"#;

/// The outcome of a mistake: all warnings, and the error or the end of the solve.
fn end_of(text: &str) -> String {
    let scene = match Scene::from_toml(text) {
        Ok(scene) => scene,
        Err(error) => return error.to_string(),
    };
    let mut lines: Vec<String> = Vec::new();
    match solve_contact(&scene) {
        Ok(solution) => lines.extend(solution.warnings.iter().map(ToString::to_string)),
        Err(error) => {
            lines.extend(scene.warnings().iter().map(ToString::to_string));
            lines.push(error.to_string());
        }
    }
    lines.join("\n")
}

/// Whether one line of `end` has all `parts`, and none has a word that only programmers know.
fn is_named(end: &str, parts: &[&str]) -> bool {
    let jargon = ["f64", "usize", "struct ", "variant", "Some(", "None"];
    let named = end.lines().any(|line| parts.iter().all(|part| line.contains(part)));
    named && !jargon.iter().any(|word| end.contains(word))
}

fn assert_named(name: &str, end: &str, parts: &[&str]) {
    assert!(is_named(end, parts), "{name}: {parts:?} is not in a line of\n{end}");
}

#[test]
fn the_scene_without_mistakes_has_no_warning() {
    assert_eq!(end_of(GOOD), "");
}

/// A line of the scene, the mistaken line, and words of the message.
const MISTAKES: [(&str, &str, &[&str]); 55] = [
    // Units.
    ("radius = 9.525e-3", "radius = 9.525", &["form.radius = 9.525", "did you mean 9.525 mm = 0.009525 m?"]),
    ("= 229.67e9", "= 229.67", &["elastic.equivalent_modulus = 229.67", "did you mean 229.67 GPa"]),
    ("= 229.67e9", "= 229670", &["elastic.equivalent_modulus = 229670", "did you mean 229670 MPa"]),
    (
        "hertz_pressure = 1.15e9",
        "hertz_pressure = 1.15",
        &["load.hertz_pressure = 1.15", "1.15 GPa = 1150000000 Pa"],
    ),
    ("hertz_pressure = 1.15e9", "force = 1e6", &["load.force = 1000000", "half-width", "radius"]),
    (
        "entrainment_speed = 0.1",
        "entrainment_speed = 500",
        &["motion.entrainment_speed = 500", "mm/s = 0.5 m/s"],
    ),
    ("slide_roll_ratio = 0.05", "slide_roll_ratio = 5", &["motion.slide_roll_ratio = 5", "5 % = 0.05"]),
    ("eta0 = 0.004", "eta0 = 4.0", &["lubricant.eta0 = 4", "4 mPa s = 0.004 Pa s"]),
    (
        "roelands_z = 0.68",
        "roelands_z = 0.68\nalpha = 15.0",
        &["lubricant.alpha = 15", "15 1/GPa = 1.5e-8 1/Pa"],
    ),
    ("roelands_z = 0.68", "roelands_z = 0.68\nalpha = 0.015", &["lubricant.alpha = 0.015", "0.015 1/MPa"]),
    (
        "roelands_z = 0.68",
        "roelands_z = 0.68\nroelands_p0 = 196.0",
        &["lubricant.roelands_p0 = 196", "196 MPa"],
    ),
    ("roelands_z = 0.68", "roelands_z = 0.68\ndensity_a = 0.6", &["lubricant.density_a = 0.6", "0.6 1/GPa"]),
    ("rq = 130e-9", "rq = 130.0", &["roughness.disc.rq = 130", "130 nm = 1.3e-7 m"]),
    ("rq = 130e-9", "rq = 0.13", &["roughness.disc.rq = 0.13", "0.13 um = 1.3e-7 m"]),
    ("rq = 130e-9", "rq = \"50 um\"", &["roughness.disc.rq = 5e-5", "did you mean 50 nm = 5e-8 m?"]),
    (
        "kind = \"sphere\"\nradius = 9.525e-3",
        "kind = \"ellipsoid\"\nradius_x = 9.525e-3\nradius_y = \"1e9 mm\"",
        &["form.radius_y = 1000000", "it is taken in m, of which 0.01 is usual"],
    ),
    ("roelands_z = 0.68", "roelands_z = 6.8", &["lubricant.roelands_z = 6.8", "0.6 is usual"]),
    (
        "[plastic]",
        "[wear]\nexposure = \"track\"\ncoefficient = 1\n[plastic]",
        &["wear.coefficient = 1", "1e-6 is usual"],
    ),
    ("length_x = 64e-6", "length_x = 64", &["roughness.disc.length_x = 64", "at most"]),
    ("hardness = 6e9", "hardness = 6", &["plastic.hardness = 6", "6 GPa"]),
    ("= 353.15", "= 80", &["thermal.bulk_temperature = 80", "80 degC = 353.15 K"]),
    ("film_cutoff = 1e-9", "film_cutoff = 1", &["solver.film_cutoff = 1", "1 nm = 1e-9 m"]),
    ("coefficient = 0.1", "coefficient = 10", &["friction.boundary_coefficient = 10", "10 % = 0.1"]),
    (
        "coefficient = 0.1",
        "coefficient = 0.1\nlimiting_stress_coefficient = 8",
        &["friction.limiting_stress_coefficient = 8", "8 % = 0.08"],
    ),
    (
        "hardness = 6e9",
        "hardness = 6e9\nhardening_modulus = 5.0",
        &["plastic.hardening_modulus = 5", "5 GPa/um"],
    ),
    ("[plastic]", "[stress]\nyield_strength = 1.5\n[plastic]", &["stress.yield_strength = 1.5", "1.5 GPa"]),
    ("[plastic]", "[stress]\ndeepest = 0.2\n[plastic]", &["stress.deepest = 0.2", "0.2 mm"]),
    (
        "[load]",
        "[elastic.layer]\nthickness = 2\nmodulus = 300e9\npoisson = 0.25\nsubstrate_modulus = 2e11\n\
         substrate_poisson = 0.3\n[load]",
        &["elastic.layer.thickness = 2", "2 um = 2e-6 m"],
    ),
    (
        "eta0 = 0.004\nroelands_z = 0.68",
        "viscosity = { law = \"barus\", eta0 = 0.004, alpha = 15.0 }",
        &["lubricant.viscosity = 15", "15 1/GPa"],
    ),
    (
        "eta0 = 0.004\nroelands_z = 0.68",
        "viscosity = { law = \"barus\", eta0 = 4.0, alpha = 15e-9 }",
        &["lubricant.viscosity = 4", "4 mPa s"],
    ),
    (
        "[plastic]",
        "[tribofilm]\nlaw = \"ghanbarzadeh\"\nx_tribo = 1.0\n[plastic]",
        &["tribofilm.x_tribo = 1", "4e-16 is usual"],
    ),
    // Boxes and cells.
    ("x = [-0.25e-3, 0.25e-3]", "x = [-0.1e-3, 0.25e-3]", &["grid.x = -0.0001", "1.5 Hertz half-widths"]),
    ("x = [-0.25e-3, 0.25e-3]", "x = [-0.25, 0.25]", &["grid", "no node", "Hertz half-widths"]),
    ("x = [-0.25e-3, 0.25e-3]", "x = [0.25e-3, -0.25e-3]", &["grid.x", "-0.00025"]),
    ("x = [-0.25e-3, 0.25e-3]", "x = [0.1e-3, 0.6e-3]", &["grid.x", "the bodies touch at 0"]),
    ("x = [-0.25e-3, 0.25e-3]", "x = [-0.25e-3, 0.0, 0.25e-3]", &["grid.x", "3", "two"]),
    ("length_x = 64e-6", "length_x = 10e-6", &["grid.nx = 24", "a third", "at least 150 cells"]),
    ("kind = \"gaussian\"", "kind = \"exponential\"", &["grid.nx = 24", "roughness.disc", "any length"]),
    ("nx = 24", "nx = 0", &["grid.nx = 0"]),
    ("nx = 24", "nx = 4000000000", &["grid.nx * grid.ny"]),
    // Types and names.
    ("radius = 9.525e-3", "radius = \"big\"", &["form.radius", "\"big\"", "a number"]),
    ("nx = 24", "nx = 16.5", &["grid.nx", "16.5", "a whole number"]),
    ("nx = 24", "nx = -16", &["grid.nx", "-16", "a whole number"]),
    (
        "[form]\nkind = \"sphere\"\nradius = 9.525e-3\n[elastic]\nequivalent_modulus = 229.67e9",
        "elastic = 229.67e9\n[form]\nkind = \"sphere\"\nradius = 9.525e-3",
        &["elastic", "a table"],
    ),
    ("radius = 9.525e-3", "radius = 1979-05-27", &["form.radius: it is a date"]),
    ("[solver]", "[[solver]]", &["solver: it is a list", "[solver]"]),
    ("kind = \"sphere\"", "kind = \"bal\"", &["form.kind", "bal", "sphere"]),
    ("radius = 9.525e-3", "raduis = 9.525e-3", &["raduis", "form"]),
    ("[lubricant]", "[lubrication]", &["lubrication", "lubricant"]),
    // Values.
    ("radius = 9.525e-3", "radius = -9.525e-3", &["form.radius = -0.009525"]),
    ("hertz_pressure = 1.15e9", "hertz_pressure = nan", &["load.hertz_pressure = NaN"]),
    ("hertz_pressure = 1.15e9", "hertz_pressure = 1e9\nforce = 50.0", &["load", "not both", "50"]),
    ("entrainment_speed = 0.1", "entrainment_speed = 0.0", &["motion.entrainment_speed = 0"]),
    ("eta0 = 0.004", "eta0 = 1e-6", &["lubricant.eta0", "1e-6"]),
    ("[solver]", "[solver]\ntolerance = 0.5", &["solver.tolerance = 0.5"]),
];

#[test]
fn mistakes_in_scene_files_are_named() {
    let mut failures = Vec::new();
    for (from, to, parts) in MISTAKES {
        let text = GOOD.replacen(from, to, 1);
        assert_ne!(text, GOOD, "{from}");
        let end = end_of(&text);
        if !is_named(&end, parts) {
            failures.push(format!("{to}: {parts:?} is not in a line of\n{end}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn values_that_are_plainly_in_another_unit_are_refused() {
    for (from, to, words) in [
        ("roelands_z = 0.68", "roelands_z = 0.68\nalpha = 12.0", "lubricant.alpha = 12: "),
        ("= 229.67e9", "= 229.67", "did you mean 229.67 GPa"),
        ("rq = 130e-9", "rq = 0.13", "did you mean 0.13 um"),
        ("film_cutoff = 1e-9", "film_cutoff = 1", "did you mean 1 nm"),
    ] {
        let scene = Scene::from_toml(&GOOD.replacen(from, to, 1)).unwrap();
        let message = assert_refused_by_both(to, &scene).unwrap();
        assert!(message.contains(words), "{message}");
        let history = MixedLubricationSim::builder(scene).build().unwrap_err();
        assert_eq!(history.to_string(), message, "{to}");
    }
    let heights: Vec<f64> = waves(8.0).iter().map(|height| 5e4 * height).collect();
    let builder = MixedLubricationSim::builder(Scene::from_toml(GOOD).unwrap()).disc_heights(heights);
    let message = builder.solve().unwrap_err().to_string();
    assert!(
        message.starts_with("roughness.disc_rq = 0.0035") && message.contains("0.003535534 um"),
        "{message}"
    );
}

/// A joint of rubber on bone: its bodies fit so closely that the reduced radius is 3 m.
#[test]
fn a_radius_of_metres_is_plausible_in_a_soft_joint_alone() {
    let joint = |modulus: &str| {
        let text = GOOD.replacen("radius = 9.525e-3", "radius = 3.0", 1);
        Scene::from_toml(&text.replacen("229.67e9", modulus, 1)).unwrap().warnings()
    };
    let is_about_radius =
        |warnings: &[Warning]| warnings.iter().any(|warning| warning.field == "form.radius");
    assert!(!is_about_radius(&joint("5e7")) && is_about_radius(&joint("2e11")));
}

/// The error of check and solve before the first iteration; a contact that turns out to reach the edge has none.
fn assert_refused_by_both(name: &str, scene: &Scene) -> Option<String> {
    let check = MixedLubricationSim::builder(scene.clone()).check_contact();
    let solve = match solve_contact(scene) {
        Err(SimError::BoxTooSmall(_)) => return None,
        solve => solve,
    };
    let [checked, solved] = [check.err(), solve.err()].map(|error| error.map(|error| error.to_string()));
    assert_eq!(checked, solved, "{name}");
    checked
}

#[test]
fn check_rejects_every_scene_that_solve_rejects() {
    let mut refused = 0;
    for (from, to, _) in MISTAKES {
        if let Ok(scene) = Scene::from_toml(&GOOD.replacen(from, to, 1)) {
            refused += usize::from(assert_refused_by_both(to, &scene).is_some());
        }
    }
    assert!(refused >= 15, "{refused}");
    // Problems outside of the scope of a solver, missing laws, and meshes that do not fit.
    let oil = "[lubricant]\neta0 = 0.004\nroelands_z = 0.68\n";
    let kind = |kind: &str| GOOD.replacen("[solver]", &format!("[solver]\nkind = \"{kind}\""), 1);
    let estimate = GOOD.replacen("[solver]", "[solver]\nestimate = true", 1);
    for (good, from, to, word) in [
        (GOOD, "[solver]", "[lubricant.thermal]\n[solver]", "lubricant.thermal"),
        (GOOD, "hardness = 6e9", "hardness = 1e8", "plastic.hardness"),
        (&kind("newton_krylov"), "[solver]", "[solver]\ncontact = \"paper\"", "paper"),
        (&kind("semi_system"), oil, "", "lubricant"),
        (&kind("multigrid"), oil, "", "lubricant"),
        (&estimate, "[solver]", "[solver]\ncontact = \"paper\"", "solver.estimate"),
        (&estimate, "nx = 24", "nx = 8", "solver.estimate"),
    ] {
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good, "{from}");
        let error = assert_refused_by_both(to, &Scene::from_toml(&text).unwrap()).unwrap_or_default();
        assert!(error.contains(word), "{to}: {error}");
    }
    let (before, after) = GOOD.split_once("[grid]").unwrap();
    let (_, after) = after.split_once("[roughness.disc]").unwrap();
    let picked = format!("{before}[grid]\naccuracy = 1e-2\n[roughness.disc]{after}");
    for (from, to, word) in [
        ("\"gaussian\"", "\"exponential\"", "roughness.disc.kind"),
        ("length_x = 64e-6", "length_x = 1e-8", "grid.accuracy"),
        ("accuracy = 1e-2", "accuracy = 1e-6", "grid.accuracy = 1e-6"),
    ] {
        let text = picked.replacen(from, to, 1);
        assert_ne!(text, picked, "{from}");
        let error = assert_refused_by_both(to, &Scene::from_toml(&text).unwrap()).unwrap_or_default();
        assert!(error.contains(word), "{to}: {error}");
    }
}

/// The check of a history returns the error of its first step.
#[test]
fn check_rejects_every_scene_that_a_history_rejects() {
    let mut refused = 0;
    for (from, to, _) in MISTAKES {
        let Ok(scene) = Scene::from_toml(&GOOD.replacen(from, to, 1)) else { continue };
        let check = MixedLubricationSim::builder(scene.clone()).check().err().map(|error| error.to_string());
        let built = MixedLubricationSim::builder(scene).build();
        match built {
            Err(error) => assert_eq!(check, Some(error.to_string()), "{to}"),
            Ok(mut sim) => {
                let Some(check) = check else { continue };
                assert_eq!(check, sim.step(1.0).unwrap_err().to_string(), "{to}");
            }
        }
        refused += 1;
    }
    assert!(refused >= 15, "{refused}");
    // Outside of the scope of the solver of the first step.
    let paper = GOOD.replacen("[solver]", "[solver]\nkind = \"newton_krylov\"\ncontact = \"paper\"", 1);
    let builder = || MixedLubricationSim::builder(Scene::from_toml(&paper).unwrap());
    let check = builder().check().unwrap_err().to_string();
    assert_eq!(check, builder().build().unwrap().step(1.0).unwrap_err().to_string());
    // Rejected by histories only.
    let mut scene = Scene::from_toml(GOOD).unwrap();
    scene.track.radius_ball = Some(1e-6);
    let builder = || MixedLubricationSim::builder(scene.clone());
    let check = builder().check().unwrap_err().to_string();
    assert!(check.contains("track.radius_ball") && builder().check_contact().is_ok(), "{check}");
}

#[test]
fn all_missing_keys_are_named_at_once() {
    let keys = ["radius = 9.525e-3", "eta0 = 0.004", "ny = 24", "rq = 130e-9", "hardness = 6e9"];
    let text = keys.iter().fold(GOOD.to_owned(), |text, key| text.replacen(key, "", 1));
    let parts =
        ["`form.radius`", "`lubricant.eta0`", "`grid.ny`", "`roughness.disc.rq`", "`plastic.hardness`"];
    assert_named("five keys", &end_of(&text), &parts);
    assert_named("an empty file", &end_of(""), &["missing", "`form`", "`elastic`", "`load`", "`grid`"]);
    let pure = GOOD.replace("eta0 = 0.004\n", "").replace("[elastic]\nequivalent_modulus = 229.67e9\n", "");
    assert_named("no modulus", &end_of(&pure), &["missing keys", "`elastic`", "`lubricant.eta0`"]);
    let dry_start = "[lubricant]\nroelands_z = 0.68\n";
    assert_named(
        "an oil alone",
        &end_of(dry_start),
        &["`form`", "`elastic`", "`load`", "`motion`", "`lubricant.eta0`", "`grid`"],
    );
    let cylinder = "[form]\nkind = \"cylinder\"\n[load]\nforce = 1e5\n[grid]\nnx = 100\n";
    let end = end_of(cylinder);
    assert_named("a cylinder", &end, &["`form.radius`", "`elastic`", "`grid.x`"]);
    assert!(!end.contains("grid.y") && !end.contains("grid.ny"), "{end}");
}

#[test]
fn files_that_are_no_scenes_are_refused() {
    assert_named("another format", &end_of("form:\n  radius: 3\n"), &["line 1", "form:"]);
    assert_named("bytes", &end_of("\u{1}\u{2}PK\u{3}"), &["line 1"]);
    let deep = format!("{GOOD}\nx = {}", "[".repeat(100_000));
    assert_named("nested without end", &end_of(&deep), &["line "]);
    let huge = format!("{GOOD}\n[form.x]\n{}", "y = 1\n".repeat(200_000));
    assert_named("huge", &end_of(&huge), &["line "]);
    let folder = tempfile::tempdir().unwrap();
    let error = Scene::load(folder.path()).unwrap_err().to_string();
    assert!(error.contains(folder.path().to_str().unwrap()), "{error}");
    // Large ones are refused before they are read.
    for large in ["large.toml", "large.csv"] {
        std::fs::File::create(folder.path().join(large)).unwrap().set_len(17_000_000).unwrap();
    }
    let size = ["the file has 17000000 bytes", "at most 16777216"];
    let error = Scene::load(folder.path().join("large.toml")).unwrap_err().to_string();
    assert_named("large", &error, &[size[0], size[1], "large.toml"]);
    let mut scheduled = Scene::from_toml(GOOD).unwrap();
    scheduled.schedule.load = Some(Schedule::Table { path: folder.path().join("large.csv") });
    let error = solve_contact(&scheduled).unwrap_err().to_string();
    assert_named("large table", &error, &[size[0], size[1], "schedule.load.path", "large.csv"]);
    std::fs::write(folder.path().join("latin.toml"), b"# \xb5m\n").unwrap();
    let error = Scene::load(folder.path().join("latin.toml")).unwrap_err().to_string();
    assert_named("another encoding", &error, &["latin.toml", "the file is not text in UTF-8"]);
    let error = Scene::load(folder.path().join("none.toml")).unwrap_err().to_string();
    assert!(error.contains("none.toml"), "{error}");
}

/// The scene with a disc from `file`, solved.
fn with_disc(file: &Path) -> String {
    let mut scene = Scene::from_toml(GOOD).unwrap();
    scene.lubricant = None;
    scene.roughness.disc = Roughness::File(FileRoughness { path: file.to_owned(), rq: None });
    match solve_contact(&scene) {
        Ok(solution) => solution.warnings.iter().map(|warning| format!("{warning}\n")).collect(),
        Err(error) => error.to_string(),
    }
}

/// Heights of 100 nm with waves of `cells` cells.
fn waves(cells: f64) -> Vec<f64> {
    let height = |k: usize| 1e-7 * (std::f64::consts::TAU * (k % 24) as f64 / cells).sin();
    (0..24 * 24).map(height).collect()
}

#[test]
fn files_of_heights_that_do_not_fit_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let write = |name: &str, nx: usize, heights: &[f64]| {
        write_npy(path(name), nx, heights.len() / nx, heights).unwrap();
    };
    write("good.npy", 24, &waves(8.0));
    let good = with_disc(&path("good.npy"));
    assert!(good.contains("names no unit of its heights") && good.lines().count() == 1, "{good}");
    assert_named("no file", &with_disc(&path("none.npy")), &["roughness.disc.path", "none.npy"]);
    std::fs::write(path("empty.npy"), b"").unwrap();
    assert_named("empty", &with_disc(&path("empty.npy")), &["roughness.disc.path", "empty.npy"]);
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000, 1000000000), }\n";
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(header.len()).unwrap().to_le_bytes());
    bytes.extend(header.as_bytes());
    std::fs::write(path("huge.npy"), bytes).unwrap();
    assert_named("says it is huge", &with_disc(&path("huge.npy")), &["roughness.disc.path", "huge.npy"]);
    write("shape.npy", 12, &waves(8.0));
    assert_named("shape", &with_disc(&path("shape.npy")), &["roughness.disc.path", "12 x 48", "24 x 24"]);
    let nanometres: Vec<f64> = waves(8.0).iter().map(|height| height * 1e9).collect();
    write("unit.npy", 24, &nanometres);
    assert_named("nanometres", &with_disc(&path("unit.npy")), &["roughness.disc_rq", "nm"]);
    write("fine.npy", 24, &waves(2.4));
    assert_named(
        "short waves",
        &with_disc(&path("fine.npy")),
        &["grid.nx = 24", "roughness.disc", "three cells"],
    );
    // Points at a quarter of the cells, long waves that stay and short ones that do not.
    let spacing = Some([0.5e-3 / 96.0; 2]);
    let measured = |period: f64| -> Vec<f64> {
        (0..96 * 96).map(|k| 1e-7 * (std::f64::consts::TAU * (k % 96) as f64 / period).sin()).collect()
    };
    for (name, period) in [("long.txt", 32.0), ("short.txt", 6.0)] {
        let heights = Heights::new(96, 96, spacing, measured(period), None).unwrap();
        write_text(path(name), &heights).unwrap();
    }
    assert!(!with_disc(&path("long.txt")).contains("in the file"));
    assert_named(
        "lost",
        &with_disc(&path("short.txt")),
        &["roughness.disc_rq", "Rq of 70.", "smaller cells"],
    );
}

#[test]
fn mistakes_in_calls_are_named() {
    let dry = || {
        let mut scene = Scene::from_toml(GOOD).unwrap();
        scene.lubricant = None;
        scene
    };
    let built = |heights: Vec<f64>| match MixedLubricationSim::builder(dry()).disc_heights(heights).build() {
        Ok(sim) => sim.warnings().iter().map(|warning| format!("{warning}\n")).collect(),
        Err(error) => error.to_string(),
    };
    assert_eq!(built(waves(8.0)), "");
    assert_named("none", &built(Vec::new()), &["disc_heights", "0 values", "576"]);
    assert_named("too few", &built(vec![0.0; 7]), &["disc_heights", "7 values", "576"]);
    assert_named("NaN", &built(vec![f64::NAN; 576]), &["disc_heights[0][0] = NaN"]);
    assert_named("in um", &built(waves(8.0).iter().map(|z| z * 1e6).collect()), &["roughness.disc_rq", "um"]);
    assert_named(
        "absurd",
        &built(waves(8.0).iter().map(|z| z * 1e170).collect()),
        &["roughness.disc = 1e163", "above 0.1 m"],
    );
    assert_named("short waves", &built(waves(2.4)), &["grid.nx = 24", "three cells"]);

    let mut sim = MixedLubricationSim::builder(dry()).build().unwrap();
    for time_step in [-1.0, f64::NAN, f64::INFINITY] {
        let error = sim.step(time_step).unwrap_err().to_string();
        assert!(error.contains("step") && error.contains(&time_step.to_string()), "{error}");
    }
    assert_eq!((sim.steps(), sim.time().to_bits()), (0, 0));
    let mut row = dry();
    row.grid = GridSpec::Row { nx: 24, x: [-0.25e-3, 0.25e-3] };
    let error = solve_contact(&row).unwrap_err().to_string();
    assert!(error.contains("grid") && error.contains("ny and y are missing"), "{error}");
}

/// An ellipse that the film formula does not know, and an estimate of the mesh error above 10 %.
#[test]
fn numbers_that_do_not_hold_are_named() {
    let ellipse = GOOD.replacen(
        "kind = \"sphere\"\nradius = 9.525e-3",
        "kind = \"ellipsoid\"\nradius_x = 12e-3\nradius_y = 8e-3",
        1,
    );
    let warnings = Scene::from_toml(&ellipse).unwrap().warnings();
    let named = |field: &str| warnings.iter().filter(|warning| warning.field == field).count();
    assert_eq!(named("film.formula_central"), 1, "{warnings:?}");
    assert!(warnings.iter().any(|warning| warning.message.contains("ellipticity")), "{warnings:?}");

    let coarse = GOOD.replacen("max_iterations = 40", "estimate = true", 1);
    let solution = solve_contact(&Scene::from_toml(&coarse).unwrap()).unwrap();
    let estimate = solution.error_estimate.unwrap();
    assert!(
        estimate.film_minimum.max(estimate.film_mean_central).max(estimate.film_central) > 0.1,
        "{estimate:?}"
    );
    let mesh = |field: &str| field.starts_with("error_estimate.");
    let large: Vec<_> = solution.warnings.iter().filter(|warning| mesh(&warning.field)).collect();
    assert!(large.len() == 1 && large[0].value > 0.1, "{:?}", solution.warnings);
}

/// A smooth mesh that does not hold the inlet, and a fluid that rubs more than oils do, in solves and runs.
#[test]
fn numbers_of_solutions_that_mislead_are_named() {
    let mut smooth = Scene::from_toml(GOOD).unwrap();
    (smooth.roughness, smooth.plastic) = (Default::default(), None);
    let named = |scene: &Scene| {
        let mut scene = scene.clone();
        scene.solver.max_iterations = 1000;
        let solution = solve_contact(&scene).unwrap();
        solution.report.require_converged().unwrap();
        let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
        sim.step(1.0).unwrap();
        let fields = |warnings: &[Warning]| warnings.iter().map(|w| w.field.clone()).collect::<Vec<_>>();
        assert_eq!(fields(sim.warnings()), fields(&solution.warnings));
        fields(&solution.warnings)
    };
    assert_eq!(named(&smooth), ["film.minimum"]);
    let mut fine = smooth.clone();
    fine.grid = GridSpec::Cells { nx: 96, ny: 96, x: [-0.25e-3, 0.25e-3], y: [-0.25e-3, 0.25e-3] };
    assert!(named(&fine).is_empty());
    let mut slipping = fine;
    slipping.load.hertz_pressure = Some(0.5e9);
    slipping.motion.slide_roll_ratio = 2.0;
    let oil = slipping.lubricant.as_mut().unwrap();
    (oil.eta0, oil.inlet) = (0.4, InletSpec::BoxEdge);
    slipping.grid = GridSpec::Cells { nx: 64, ny: 64, x: [-0.2e-3, 0.1e-3], y: [-0.15e-3, 0.15e-3] };
    assert_eq!(named(&slipping), ["friction.coefficient", "friction.fluid"]);
}

/// A run has its warnings once, and those of its first contact beside them.
#[test]
fn a_run_has_each_warning_once() {
    let mut scene = Scene::from_toml(GOOD).unwrap();
    scene.lubricant = None;
    scene.roughness = Default::default();
    scene.grid = GridSpec::Cells { nx: 24, ny: 24, x: [-0.06e-3, 0.06e-3], y: [-0.06e-3, 0.06e-3] };
    scene.plastic = None;
    scene.lubricant = None;
    scene.solver.edge_contact = true;
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    assert!(sim.warnings().is_empty(), "{:?}", sim.warnings());
    sim.step(1.0).unwrap();
    sim.step(1.0).unwrap();
    let fields: Vec<&str> = sim.warnings().iter().map(|warning| warning.field.as_str()).collect();
    assert_eq!(fields, ["pressure.max"]);
}

#[test]
fn wear_that_is_too_deep_is_said_once() {
    let mut scene = Scene::azam_2019(16);
    (scene.lubricant, scene.roughness) = (None, Default::default());
    // The law wears beside the contact too.
    scene.solver.edge_contact = true;
    let mut sim = MixedLubricationSim::builder(scene).wear_law(WornAway).build().unwrap();
    assert!(sim.warnings().is_empty(), "{:?}", sim.warnings());
    sim.step(1e-9).unwrap();
    assert!(sim.warnings().is_empty(), "a nanometre is nothing: {:?}", sim.warnings());
    sim.step(5e-5).unwrap();
    sim.step(1e-9).unwrap();
    let fields: Vec<&str> = sim.warnings().iter().map(|warning| warning.field.as_str()).collect();
    assert!(
        fields == ["wear.disc_max", "time_step"] || fields == ["wear.ball_max", "time_step"],
        "{fields:?}"
    );
    assert!(sim.warnings()[0].value > 2e-5, "{:?}", sim.warnings());
    let before = sim.bodies().clone().map(|body| body.wear().to_vec());
    let error = sim.step(1.0).unwrap_err().to_string();
    assert!(error.contains("time_step = 1") && error.contains("half-width"), "{error}");
    assert_eq!(sim.bodies().clone().map(|body| body.wear().to_vec()), before);
}

/// A metre in a second.
#[derive(Debug)]
struct WornAway;

impl WearLaw for WornAway {
    fn depth_rate(&self, _at: &SurfaceState, _film_thickness: f64) -> f64 {
        1.0
    }
}
