//! `stribeck curve` from the outside.
#![expect(clippy::unwrap_used, clippy::float_cmp, reason = "tests")]

mod common;

use std::path::Path;

use common::{assert_pictures, assert_refused, error_of, json_of, repository, rough, stribeck, text};
use stribeck::sim::scene::Roughness;
use stribeck::sim::{Scene, solve_contact};

#[test]
fn the_curve_is_that_of_its_speeds() {
    let folder = tempfile::tempdir().unwrap();
    // The ratio of sliding is that of the schedule at the start.
    let sliding = "[schedule.slide_roll_ratio]\nkind = \"constant\"\nvalue = 0.1\n[motion]\n";
    let path = rough(folder.path(), &[("[motion]\n", sliding), ("= 0.05 # sliding", "= 0.0 # sliding")]);
    let output = stribeck(&[
        "curve",
        text(&path),
        "--from",
        "20 mm/s",
        "--to",
        "2",
        "--points",
        "3",
        "--json",
        "--plot",
        "--out",
        text(folder.path()),
    ]);
    assert!(output.status.success(), "{output:?}");
    assert!(!error_of(&output).contains("without sliding"), "{output:?}");
    let curve = json_of(&output);
    let points = curve["points"].as_array().unwrap();
    assert_eq!(points.len(), 3);
    let mut scene = Scene::load(&path).unwrap();
    scene.motion.entrainment_speed = points[1]["motion"]["entrainment_speed"].as_f64().unwrap();
    assert!((scene.motion.entrainment_speed / 0.2 - 1.0).abs() < 1e-12);
    assert_eq!(points[1]["motion"]["slide_roll_ratio"], 0.1);
    let solution = solve_contact(&scene).unwrap();
    assert_eq!(points[1]["friction"]["coefficient"], solution.friction.coefficient);
    assert_eq!(points[1]["contact"]["load_ratio"], solution.contact.load_ratio);
    let lambda = solution.film.mean_central / 20e-9_f64.hypot(130e-9);
    // Ball and disc are drawn apart, and by chance heights of one follow those of the other a little.
    assert!((points[1]["film"]["lambda"].as_f64().unwrap() / lambda - 1.0).abs() < 0.1);
    let table = std::fs::read_to_string(folder.path().join("rough_curve.csv")).unwrap();
    let row: Vec<&str> = table.lines().nth(2).unwrap().split(',').collect();
    assert_eq!(row[1].parse::<f64>().unwrap(), solution.friction.coefficient);
    assert_eq!(table.lines().count(), 4);
    assert_pictures(
        folder.path(),
        "rough_curve",
        &["Stribeck curve", "entrainment speed (m/s)", "friction", "smooth, by formula"],
    );
}

/// Rows, points and bands of a curve over `surfaces` of few cells.
fn curve_of(folder: &Path, scene: &Path, more: &[&str]) -> (serde_json::Value, String) {
    let out = folder.join("curve");
    let arguments =
        ["curve", text(scene), "--from", "0.02", "--to", "0.2", "--points", "2", "--json", "--force"];
    let output = stribeck(&[&arguments[..], &["--out", text(&out)], more].concat());
    assert!(output.status.success(), "{output:?}");
    (json_of(&output), error_of(&output))
}

/// Mean and standard deviation over three surfaces are those of their solutions; the first is the scene's own.
#[test]
fn a_curve_over_seeds_has_mean_and_standard_deviation() {
    let folder = tempfile::tempdir().unwrap();
    let path = rough(folder.path(), &[]);
    let (curve, messages) = curve_of(folder.path(), &path, &["--seeds", "3", "--plot"]);
    assert!(!messages.contains("one random surface"), "{messages}");
    assert!(messages.contains("needs: 6 solves"), "{messages}");
    assert!(messages.contains("each with about 2 MB"), "{messages}");
    let points = curve["points"].as_array().unwrap();
    assert_eq!(points.len(), 6);
    let friction: Vec<f64> =
        points[..3].iter().map(|point| point["friction"]["coefficient"].as_f64().unwrap()).collect();
    let mut scene = Scene::load(&path).unwrap();
    scene.motion.entrainment_speed = 0.02;
    assert_eq!(friction[0], solve_contact(&scene).unwrap().friction.coefficient);
    for body in [&mut scene.roughness.ball, &mut scene.roughness.disc] {
        let Roughness::Random(random) = body else { panic!("{body:?}") };
        random.seed += 2000;
    }
    assert_eq!(friction[2], solve_contact(&scene).unwrap().friction.coefficient);
    let mean = friction.iter().sum::<f64>() / 3.0;
    let sd = (friction.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / 2.0).sqrt();
    let row = &curve["curve"][0];
    let close = |key: &str, expected: f64| {
        let found = row[key].as_f64().unwrap();
        assert!((found / expected - 1.0).abs() < 1e-12, "{key}: {found} {expected}");
    };
    close("friction_coefficient", mean);
    close("friction_coefficient_sd", sd);
    assert_eq!((&row["surfaces"], row.get("friction_coefficient_error")), (&3.0.into(), None));
    let table = std::fs::read_to_string(folder.path().join("curve/rough_curve.csv")).unwrap();
    assert!(table.lines().next().unwrap().ends_with(",film_lambda_sd,surfaces,warnings,model"), "{table}");
    assert_pictures(&folder.path().join("curve"), "rough_curve", &["friction", "film / Rq"]);
}

/// Errors are absolute, in the unit of their column.
#[test]
fn a_curve_has_the_estimated_errors_of_its_contacts() {
    let folder = tempfile::tempdir().unwrap();
    let path = rough(folder.path(), &[("[solver]", "[solver]\nestimate = true")]);
    let (curve, messages) = curve_of(folder.path(), &path, &[]);
    assert_eq!(messages.matches("this is one random surface of many; --seeds 4").count(), 1, "{messages}");
    for (row, point) in curve["curve"].as_array().unwrap().iter().zip(curve["points"].as_array().unwrap()) {
        let error = |key: &str| point["error_estimate"][key].as_f64().unwrap();
        let row = |key: &str| row[key].as_f64().unwrap();
        assert_eq!(row("contact_load_ratio_error"), error("contact_load_ratio"));
        for (column, key) in
            [("friction_coefficient", "friction_coefficient"), ("film_mean_central_m", "film_mean_central")]
        {
            let found = row(&format!("{column}_error")) / row(column);
            assert!((found / error(key) - 1.0).abs() < 1e-12, "{column}: {found}");
        }
    }
    let out = folder.path().join("table");
    let table = stribeck(&[
        "curve",
        text(&path),
        "--points",
        "2",
        "--from",
        "0.1",
        "--to",
        "0.2",
        "--out",
        text(&out),
    ]);
    let table = String::from_utf8(table.stdout).unwrap();
    assert_eq!(table.matches(" +- ").count(), 8, "{table}");
}

#[test]
fn seeds_of_surfaces_that_are_not_random_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let smooth = repository("examples/scenes/smooth.toml");
    let out = folder.path().join("out");
    let arguments = ["curve", text(&smooth), "--seeds", "4", "--out", text(&out)];
    assert_refused(&arguments, &["--seeds = 4: ", "is random", "leave --seeds out"]);
    assert!(!out.exists());
    assert_refused(
        &["curve", text(&smooth), "--seeds", "0"],
        &["--seeds = \"0\": must be a whole number from 1"],
    );
}

/// Four surfaces of a strip whose width is the default, its own with `--seeds 1`.
#[test]
fn curve_of_a_strip_of_default_width_has_a_band() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("strip.toml");
    let scene = std::fs::read_to_string(repository("examples/scenes/strip.toml")).unwrap();
    let scene = scene.replace("nx = 128\nny = 64", "nx = 48\nny = 16");
    let open = scene.lines().filter(|line| !line.starts_with("y = ")).collect::<Vec<_>>().join("\n");
    std::fs::write(&path, open).unwrap();
    let arguments = ["--from", "0.05", "--to", "0.1", "--points", "2", "--json"];
    for (seeds, surfaces) in [(&[][..], 4), (&["--seeds", "1"], 1)] {
        let out = folder.path().join(surfaces.to_string());
        let result =
            stribeck(&[&["curve", text(&path), "--out", text(&out)], &arguments[..], seeds].concat());
        let curve: serde_json::Value = serde_json::from_slice(&result.stdout).unwrap();
        assert_eq!(curve["points"].as_array().unwrap().len(), 2 * surfaces, "{curve}");
    }
}

/// The table has whole lines of all speeds that were printed.
#[cfg(unix)]
#[test]
fn an_interrupted_curve_keeps_its_finished_speeds() {
    use std::process::{Command, Stdio};

    let folder = tempfile::tempdir().unwrap();
    let path = rough(folder.path(), &[]);
    let csv = folder.path().join("rough_curve.csv");
    let arguments = ["curve", text(&path), "--points", "1000", "--plot", "--out", text(folder.path())];
    let mut command = Command::new(env!("CARGO_BIN_EXE_stribeck"));
    let curve = command.args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let lines = || std::fs::read_to_string(&csv).map_or(0, |text| text.lines().count());
    while lines() < 3 {
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    assert!(Command::new("kill").args(["-INT", &curve.id().to_string()]).status().unwrap().success());
    let output = curve.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let rows = lines() - 1;
    let message = error_of(&output);
    assert!(message.contains(&format!("interrupted after {rows} of 1000 speeds")), "{message}");
    let table = String::from_utf8(output.stdout).unwrap();
    let printed = table.lines().filter(|line| !line.starts_with("written")).count();
    assert_eq!(printed, rows + 1, "{table}");
    let text = std::fs::read_to_string(&csv).unwrap();
    assert!(text.ends_with('\n') && text.lines().all(|line| line.split(',').count() == 7), "{text}");
    assert_pictures(folder.path(), "rough_curve", &["friction"]);
}

/// A curve that does not begin leaves no table.
#[test]
fn a_curve_without_a_row_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[("max_iterations = 20_000", "max_iterations = 1")]);
    let out = folder.path().join("out");
    let arguments = [
        "curve",
        text(&scene),
        "--points",
        "2",
        "--from",
        "0.1",
        "--to",
        "0.2",
        "--plot",
        "--out",
        text(&out),
    ];
    let output = stribeck(&arguments);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0), "{output:?}");
    assert!(!out.exists());
}

/// A steel contact in an oil by its grade, with 32 x 32 cells.
const BY_GRADE: &str = "[form]\nkind = \"sphere\"\nradius = \"10 mm\"\n[materials.ball]\nmaterial = \"steel\"\n\
    [materials.disc]\nmaterial = \"steel\"\n[load]\nforce = \"20 N\"\n[motion]\nentrainment_speed = \"0.5 m/s\"\n\
    slide_roll_ratio = 0.1\n[lubricant]\ngrade = \"ISO VG 46\"\nviscosity_index = 95\n[friction]\neyring_stress = \"5 MPa\"\n\
    [thermal]\nbulk_temperature = \"60 degC\"\n[grid]\nnx = 32\nny = 32\nx = [\"-300 um\", \"300 um\"]\n\
    y = [\"-300 um\", \"300 um\"]\n";

/// The middle of three contacts is that of its own scene, under the name of the quantity.
#[test]
fn curves_over_other_quantities_are_those_of_their_contacts() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grade.toml");
    std::fs::write(&path, BY_GRADE).unwrap();
    for (over, ends, column, title, label, middle) in [
        (
            "slide_roll_ratio",
            ["0", "40%"],
            "motion_slide_roll_ratio",
            "Traction curve",
            "slide-roll ratio",
            0.2,
        ),
        ("load", ["5 N", "20 N"], "load_N", "Curve over load", "load (N)", 10.0),
        (
            "temperature",
            ["40 degC", "100 degC"],
            "bulk_temperature_K",
            "over temperature",
            "temperature",
            343.15,
        ),
    ] {
        let out = folder.path().join(over);
        let arguments =
            ["curve", text(&path), "--over", over, "--from", ends[0], "--to", ends[1], "--points", "3"];
        let output = stribeck(&[&arguments[..], &["--json", "--plot", "--out", text(&out)]].concat());
        assert!(output.status.success(), "{output:?}");
        let curve = json_of(&output);
        let row = &curve["curve"][1];
        let at = row[column].as_f64().unwrap();
        assert!((at / middle - 1.0).abs() < 1e-12, "{over}: {at}");
        let mut scene = Scene::load(&path).unwrap();
        match over {
            "load" => scene.load.force = Some(at),
            "temperature" => scene.thermal.bulk_temperature = at,
            _ => scene.motion.slide_roll_ratio = at,
        }
        let solution = solve_contact(&scene).unwrap();
        assert_eq!(row["friction_coefficient"], solution.friction.coefficient, "{over}");
        assert_eq!(row["film_mean_central_m"], solution.film.mean_central, "{over}");
        let name = format!("grade_curve_{over}");
        assert_pictures(&out, &name, &[title, label, "friction"]);
        let table = std::fs::read_to_string(out.join(format!("{name}.csv"))).unwrap();
        assert!(table.starts_with(&format!("{column},friction_coefficient,")), "{table}");
    }
}

/// Friction grows with sliding and the film shrinks with temperature, in the table on the terminal too.
#[test]
fn traction_grows_with_sliding_from_zero() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grade.toml");
    std::fs::write(&path, BY_GRADE).unwrap();
    let out = text(folder.path());
    let output =
        stribeck(&["curve", text(&path), "--over", "slide_roll_ratio", "--points", "3", "--out", out]);
    let table = String::from_utf8(output.stdout).unwrap();
    let friction: Vec<f64> = table
        .lines()
        .filter(|line| !line.starts_with("written"))
        .skip(1)
        .map(|line| line.split_whitespace().nth(1).unwrap().parse().unwrap())
        .collect();
    assert_eq!(friction.len(), 3, "{table}");
    assert!(friction[0] == 0.0 && friction[1] > 0.005 && friction[2] > friction[1], "{table}");
    assert!(table.lines().next().unwrap().contains("slide/roll"), "{table}");
}

/// The rough scene on 128 x 128 cells, which resolve the curvature of its asperities.
fn within_inlets(folder: &Path) -> std::path::PathBuf {
    rough(folder, &[("= 32", "= 128")])
}

#[test]
fn curve_is_by_asperity_inlets_within_their_range_and_resolved_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let path = within_inlets(folder.path());
    let (curve, messages) = curve_of(folder.path(), &path, &["--resolve", "1", "--plot"]);
    let rows = curve["curve"].as_array().unwrap();
    let models: Vec<&str> = rows.iter().map(|row| row["model"].as_str().unwrap()).collect();
    assert_eq!(models, ["asperity_inlets", "asperity_inlets", "resolved"], "{messages}");
    let number = |row: usize, key: &str| rows[row][key].as_f64().unwrap();
    assert_eq!(number(0, "motion_entrainment_speed_m_s"), number(2, "motion_entrainment_speed_m_s"));
    let mut scene = Scene::load(&path).unwrap();
    scene.motion.entrainment_speed = 0.02;
    let resolved = solve_contact(&scene).unwrap();
    assert_eq!(number(2, "contact_load_ratio"), resolved.contact.load_ratio);
    assert!((number(0, "contact_load_ratio") - resolved.contact.load_ratio).abs() < 0.1);
    scene.solver.model = stribeck::sim::scene::SolverModel::AsperityInlets;
    let inlets = solve_contact(&scene).unwrap();
    assert_eq!(number(0, "contact_load_ratio"), inlets.contact.load_ratio);
    // The second speed starts from the dry contact of the first.
    scene.motion.entrainment_speed = 0.2;
    let inlets = solve_contact(&scene).unwrap();
    assert!((number(1, "contact_load_ratio") - inlets.contact.load_ratio).abs() < 1e-4);
    let out = folder.path().join("curve");
    let table = std::fs::read_to_string(out.join("rough_curve.csv")).unwrap();
    let ends: Vec<&str> = table.lines().map(|line| line.rsplit(',').next().unwrap()).collect();
    assert_eq!(ends, ["model", "asperity_inlets", "resolved", "asperity_inlets"]);
    assert_pictures(&out, "rough_curve", &["asperity inlets", "resolved"]);
    let (coarse, _) = curve_of(folder.path(), &rough(folder.path(), &[]), &["--resolve", "2"]);
    let rows = coarse["curve"].as_array().unwrap();
    assert!(rows.len() == 2 && rows.iter().all(|row| row["model"] == "resolved"), "{rows:?}");
}

#[test]
fn model_of_a_curve_follows_the_option() {
    let folder = tempfile::tempdir().unwrap();
    let coarse = rough(folder.path(), &[]);
    let (curve, messages) = curve_of(folder.path(), &coarse, &["--model", "asperity_inlets"]);
    assert!(curve["curve"].as_array().unwrap().iter().all(|row| row["model"] == "asperity_inlets"));
    assert!(messages.contains("too wide for the curvature"), "{messages}");
    let fine = within_inlets(folder.path());
    let (curve, _) = curve_of(folder.path(), &fine, &["--model", "resolved"]);
    assert!(curve["curve"].as_array().unwrap().iter().all(|row| row["model"] == "resolved"));
    let starved = rough(folder.path(), &[("[lubricant]", "[lubricant]\nsupplied_film = 1e-7\n#")]);
    let arguments = ["curve", text(&starved), "--model", "asperity_inlets", "--points", "2"];
    assert_refused(&arguments, &["asperity_inlets", "lubricant.supplied_film"]);
    let estimated = rough(folder.path(), &[("[solver]", "[solver]\nestimate = true")]);
    let arguments = ["curve", text(&estimated), "--model", "asperity_inlets", "--points", "2"];
    assert_refused(&arguments, &["solver.estimate = true", "leave out solver.estimate"]);
    assert_refused(&["curve", text(&fine), "--resolve", "0"], &["--resolve = \"0\""]);
}
