//! Passages and cycles by the command, and scenes of machines.
#![expect(clippy::unwrap_used, clippy::float_cmp, reason = "tests")]

mod common;

use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::Path;

use common::{assert_pictures, assert_refused, error_of, json_of, stribeck, text};
use serde_json::Value;

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} in {value}"))
}

const FZG: [&str; 22] = [
    "--gear",
    "--module",
    "4.5 mm",
    "--teeth",
    "16",
    "24",
    "--shift",
    "0.1817",
    "0.1715",
    "--centre-distance",
    "91.5 mm",
    "--face-width",
    "14 mm",
    "--torque",
    "94.1",
    "--rotation",
    "2170",
    "--grade",
    "ISO VG 100",
    "--temperature",
    "90 degC",
    "--force",
];

/// A scene of the machine that `options` describe.
fn init(folder: &Path, options: &[&str]) -> std::path::PathBuf {
    let path = folder.join("machine.toml");
    let output = stribeck(&[&["init", text(&path)], options].concat());
    assert!(output.status.success(), "{output:?}");
    path
}

/// Flanks of type C: published contact ratio, films by formula, flash temperature by Blok.
#[test]
fn fzg_flanks_have_films_by_formula_and_the_flash_temperature_of_blok() {
    let folder = tempfile::tempdir().unwrap();
    let path = init(folder.path(), &FZG);
    assert!(fs::read_to_string(&path).unwrap().contains("contact ratio 1.43"), "FZG type C: 1.44");
    let output = stribeck(&["cycle", text(&path), "--json", "--plot", "--out", text(folder.path())]);
    assert!(output.status.success(), "{}", error_of(&output));
    assert_pictures(folder.path(), "machine_cycle", &["film (nm)", "flash (K)", "time (ms)"]);
    let json = json_of(&output);
    let points = json["points"].as_array().unwrap();
    assert_eq!(points.len(), 401);
    // Behind the jumps of load at the ends of single contact the film follows within ten steps.
    let jumps = |k: usize| {
        points[k.saturating_sub(12)..(k + 2).min(401)].iter().any(|p| number(p, "squeeze_ratio") > 0.02)
    };
    let (mut compared, mut near) = (0, 0);
    for (k, point) in points.iter().enumerate() {
        let film = number(point, "film_central") / number(point, "formula_film");
        assert!(jumps(k) || (0.9..1.1).contains(&film), "film over formula {film} in contact {k}");
        compared += usize::from(!jumps(k));
        near += usize::from((0.9..1.1).contains(&film));
        let (u1, u2) = (number(point, "ball_speed"), number(point, "disc_speed"));
        let (load, radius) = (number(point, "load"), number(point, "radius"));
        let half_width = (8.0 * load * radius / (PI * 210e9 / 0.91)).sqrt();
        let effusivity = 46.0 / 1.27e-5_f64.sqrt();
        let blok = 1.11 * number(point, "friction_coefficient") * load * (u1.sqrt() - u2.sqrt()).abs()
            / (effusivity * (2.0 * half_width).sqrt());
        let flash = number(point, "flash_rise");
        assert!((flash - blok).abs() < 0.2 * blok + 0.5, "{flash} K, Blok {blok} K in contact {k}");
        assert!(number(point, "residual_load") < 1e-6);
    }
    // The number in docs/cycles.md.
    println!("{near} of {} central films are within 10 % of the formula", points.len());
    assert!(compared > 300 && (389..=393).contains(&near), "{compared} and {near} contacts");
    let table = fs::read_to_string(folder.path().join("machine_cycle.csv")).unwrap();
    assert!(table.starts_with("time_s,angle_rad,load_N") && table.lines().count() == 402);
}

/// Lift `h (1 - d^2)^3` over 75 degrees to each side of the nose.
fn lift(folder: &Path, count: u32) -> std::path::PathBuf {
    let path = folder.join("lift.csv");
    let line = |k: u32| {
        let angle = 360.0 * f64::from(k) / f64::from(count);
        let d = (angle - 180.0) / 75.0;
        format!("{angle},{}\n", if d.abs() < 1.0 { 8e-3 * (1.0 - d * d).powi(3) } else { 0.0 })
    };
    fs::write(&path, (0..count).map(line).collect::<String>()).unwrap();
    path
}

fn cam(lift: &Path) -> Vec<&str> {
    let mut options = vec!["--cam", text(lift)];
    options.extend([
        "--base-circle",
        "26 mm",
        "--face-width",
        "12 mm",
        "--rotation",
        "1000",
        "--spring-rate",
        "30000",
    ]);
    options.extend(["--preload", "250 N", "--mass", "0.12", "--cells", "96", "--force"]);
    options
}

/// Mixed contacts of a strip by the law of asperity inlets, through both reversals.
#[test]
fn cam_by_asperity_inlets_balances_the_load_at_all_angles() {
    let folder = tempfile::tempdir().unwrap();
    let lift = lift(folder.path(), 73);
    let slow: Vec<&str> =
        cam(&lift).into_iter().map(|option| if option == "1000" { "5" } else { option }).collect();
    let path = init(folder.path(), &slow);
    let scene = fs::read_to_string(&path).unwrap();
    let (mut row, rate) = (0, TAU / 12.0);
    let numbers = |key: &str| -> Vec<f64> {
        let list = scene.split(&format!("\n{key} = [")).last().unwrap().split(']').next().unwrap();
        list.split(',').filter_map(|cell| cell.trim().parse().ok()).collect()
    };
    let [cam_speeds, follower] = ["ball_speed", "disc_speed"].map(numbers);
    // Sliding speed of a flat follower: rate of rotation times base circle and lift.
    for (k, (u1, u2)) in cam_speeds.iter().zip(&follower).enumerate() {
        let d: f64 = (360.0 * k as f64 / 73.0 - 180.0) / 75.0;
        let lift = if d.abs() < 1.0 { 8e-3 * (1.0 - d * d).powi(3) } else { 0.0 };
        assert!(((u1 - u2) / (rate * (26e-3 + lift)) - 1.0).abs() < 1e-6);
        row += usize::from(u1 + u2 < 0.0);
    }
    assert!(row > 4, "{row} rows with reversed flow");
    let rough = "[roughness.ball]\nkind = \"gaussian\"\nrq = 0.2e-6\nlength_x = 40e-6\nlength_y = 40e-6\nseed = 1\n[solver]\n\
                 model = \"asperity_inlets\"\n[cycle]\nquasi_static = true";
    let strip = scene
        .replace("nx = 96", "across = \"periodic\"\nnx = 96\nny = 24\ny = [-0.1e-3, 0.1e-3]")
        .replace("[cycle]", rough);
    fs::write(&path, strip).unwrap();
    let output = stribeck(&["cycle", text(&path), "--json", "--out", text(folder.path())]);
    assert!(output.status.success(), "{}", error_of(&output));
    let opposite = cam_speeds.iter().zip(&follower).filter(|(u1, u2)| *u1 * *u2 < 0.0).count();
    for words in
        ["cycle.quasi_static", &format!("the surfaces of {opposite} of 74 rows move in opposite directions")]
    {
        assert!(error_of(&output).contains(words), "no `{words}` in {}", error_of(&output));
    }
    let json = json_of(&output);
    let points = json["points"].as_array().unwrap();
    assert_eq!(points.len(), 73);
    assert!(points.iter().all(|point| number(point, "residual_load") < 1e-6));
    let nose = points.iter().find(|point| (number(point, "angle") - PI).abs() < 0.6 * TAU / 73.0).unwrap();
    assert!(number(nose, "contact_load_ratio") > 0.2, "{nose}");
}

#[test]
fn machines_that_cannot_run_are_refused_by_value() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("machine.toml");
    let lift = lift(folder.path(), 73);
    let with = |options: &[&str], from: &str, to: &str| -> Vec<String> {
        let changed = options.iter().map(|option| if *option == from { to } else { option }.to_owned());
        ["init".to_owned(), text(&path).to_owned()].into_iter().chain(changed).collect()
    };
    let cam = cam(&lift);
    assert_refused(&with(&FZG, "16", "9"), &["--teeth 9", "undercuts"]);
    assert_refused(&with(&FZG, "91.5 mm", "80 mm"), &["--centre-distance = 0.08 m", "base radii, 0.084"]);
    assert_refused(&with(&FZG, "91.5 mm", "96 mm"), &["contact ratio"]);
    assert_refused(&with(&FZG, "94.1", "-1"), &["--torque", "-1"]);
    assert_refused(&with(&cam, "26 mm", "18 mm"), &["--base-circle", "degrees", "radius of curvature"]);
    assert_refused(&with(&cam, "0.12", "3"), &["--preload", "leaves the cam"]);
    // The film of an unloaded contact fills the whole gap.
    assert_refused(&with(&FZG, "94.1", "1e-9"), &["row 1 of the cycle", "N/m", "inlet", "more load"]);
    assert_refused(&["init", text(&path), "--module", "2 mm"], &["--module", "no effect"]);
    fs::write(&lift, "angle, lift\n0, 0\n90, high\n").unwrap();
    assert_refused(&with(&cam, "", ""), &["line 3", "degrees", "metres"]);
    let angles =
        |keep: fn(&u32) -> bool| (0..90).filter(keep).map(|k| format!("{} 0\n", 4 * k)).collect::<String>();
    fs::write(&lift, angles(|k| *k != 40)).unwrap();
    assert_refused(&with(&cam, "", ""), &["angle 164 follows 156", "even steps"]);
    fs::write(&lift, angles(|_| true).replace("\n8 0", "\n8 6000")).unwrap();
    assert_refused(&with(&cam, "", ""), &["6000 m", "lifts are in metres"]);
    assert!(!path.exists());
    let heavy = with(&FZG, "94.1", "1e6");
    let heavy = stribeck(&heavy.iter().map(String::as_str).collect::<Vec<_>>());
    assert!(error_of(&heavy).contains("N/m is implausible"), "{heavy:?}");
}

#[test]
fn passage_prints_means_and_writes_contacts_and_frames() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ridges.toml");
    let scene = "form = { kind = \"cylinder\", radius = 10e-3 }\nelastic.equivalent_modulus = 230e9\nload.hertz_pressure = 0.8e9\n\
                 motion = { entrainment_speed = 3.0, slide_roll_ratio = 0.5, roughness = \"moving\", passage = \"0.2 mm\" }\n\
                 lubricant = { eta0 = 0.01, alpha = 15e-9, roelands_z = 0.6 }\nfriction.eyring_stress = 5e6\n\
                 grid = { nx = 96, x = [-0.4e-3, 0.3e-3] }\n\
                 roughness.ball = { kind = \"gaussian\", rq = 0.05e-6, length_x = 80e-6, length_y = 80e-6, seed = 1 }\n";
    fs::write(&path, scene).unwrap();
    let csv = folder.path().join("contacts.csv");
    let more = ["--csv", text(&csv), "--frames", "3", "--plot", "--out", text(folder.path()), "--json"];
    let output = stribeck(&[&["solve", text(&path)], &more[..]].concat());
    assert!(output.status.success(), "{}", error_of(&output));
    let json = json_of(&output);
    let table = fs::read_to_string(&csv).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let column = rows[0].iter().position(|name| *name == "film_mean_central_m").unwrap();
    let films: Vec<f64> =
        rows[1..].iter().filter(|row| row[0] == "1").map(|row| row[column].parse().unwrap()).collect();
    assert_eq!(films.len() as f64, number(&json, "contacts"));
    assert_eq!((rows.len() - 1 - films.len()) as f64, number(&json, "start_up"));
    // Without a terminal lines tell how far the passage is.
    let all = rows.len() - 1;
    let line = format!("passage: {} of {all} contacts", 5 * all.div_ceil(10));
    assert!(error_of(&output).contains(&line), "{}", error_of(&output));
    let mean = films.iter().sum::<f64>() / films.len() as f64;
    assert!((number(&json["means"]["film_mean_central"], "mean") / mean - 1.0).abs() < 1e-12);
    for frame in ["ridges_frame_0000.npz", "ridges_frame_0001.npz", "ridges_frame_0002.npz"] {
        assert!(folder.path().join(frame).exists());
    }
    assert_pictures(folder.path(), "ridges_passage", &["mean film (nm)", "on solids"]);
    let told = String::from_utf8(stribeck(&["solve", text(&path)]).stdout).unwrap();
    assert!(told.starts_with("passage") && told.contains("mean film") && told.contains(" +- "), "{told}");
    let checked = String::from_utf8(stribeck(&["check", text(&path)]).stdout).unwrap();
    assert!(checked.contains("moving roughness"), "{checked}");
    assert_refused(&["run", text(&path), "--duration", "1"], &["motion.roughness", "track.motion"]);
    fs::write(
        &path,
        scene.replace("roughness = \"moving\", passage = \"0.2 mm\"", "roughness = \"at_rest\""),
    )
    .unwrap();
    assert_refused(&["solve", text(&path), "--frames", "3"], &["--frames", "moving"]);
    let checked = json_of(&stribeck(&["check", text(&path), "--json"]));
    let part = checked["modelled"]
        .as_array()
        .unwrap()
        .iter()
        .find(|part| part["part"] == "moving roughness")
        .unwrap();
    assert!(part["why"].as_str().unwrap().contains("a model"), "{part}");
}

#[test]
fn history_of_a_cycle_prints_and_writes_a_line_per_solved_cycle() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rig.toml");
    let scene = "form = { kind = \"cylinder\", radius = 10e-3 }\nelastic.equivalent_modulus = 230e9\nload.force = 1e5\n\
                 motion = { entrainment_speed = 1.0, slide_roll_ratio = 0.2 }\n\
                 lubricant = { eta0 = 0.02, alpha = 18e-9, roelands_z = 0.6, inlet = \"box_edge\" }\nfriction.eyring_stress = 5e6\n\
                 grid = { nx = 64, x = [-0.4e-3, 0.4e-3] }\nwear = { exposure = \"contact_clock\", pressure = \"total\" }\n\
                 cycle = { time = [0.0, 1e-3], load = [1e5, 1e5], steps = 8, repeat = 200, solved = 2 }\n";
    fs::write(&path, scene).unwrap();
    let output = stribeck(&["cycle", text(&path), "--json", "--out", text(folder.path())]);
    assert!(output.status.success(), "{}", error_of(&output));
    let json = json_of(&output);
    let cycles = json["cycles"].as_array().unwrap();
    let printed = stribeck(&["cycle", text(&path), "--force", "--out", text(folder.path())]).stdout;
    let printed = String::from_utf8(printed).unwrap();
    assert!(printed.contains("disc, m/s  load, N/m"), "{printed}");
    // Archard's K F s/H of the total load, K/H = 5.45e-8/6 GPa.
    let expected = |cycles: f64| 5.45e-8 / 6e9 * 1e5 * 0.2 * 1e-3 * cycles;
    for (cycle, count) in cycles.iter().zip([100.0, 200.0]) {
        assert_eq!(number(cycle, "cycles"), count);
        let worn = number(cycle, "wear_disc_volume") / expected(count);
        assert!((worn - 1.0).abs() < 1e-3, "{worn}");
    }
    let table = fs::read_to_string(folder.path().join("rig_cycles.csv")).unwrap();
    assert!(table.starts_with("cycles,film_minimum_m") && table.lines().count() == 3, "{table}");
    let header = table.lines().next().unwrap();
    assert!(header.contains("wear_ball_volume_m3_per_m,wear_disc_volume_m3_per_m"), "{header}");
    let contacts = fs::read_to_string(folder.path().join("rig_cycle.csv")).unwrap();
    assert!(contacts.contains("load_N_per_m") && contacts.contains("friction_power_W_per_m"), "{contacts}");
    let printed = stribeck(&["cycle", text(&path), "--force", "--out", text(folder.path())]);
    let printed = String::from_utf8(printed.stdout).unwrap();
    assert!(printed.contains("ball, mm3/m") && printed.contains("2.00000e2"), "{printed}");
}

/// Steps longer than the passage of a half-width, and steady contacts at rest.
#[test]
fn cycles_that_skip_motion_or_squeeze_warn() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stop.toml");
    let scene = "form = { kind = \"cylinder\", radius = 10e-3 }\nelastic.equivalent_modulus = 230e9\nload.force = 1e5\n\
                 motion = { entrainment_speed = 1.0, slide_roll_ratio = 0.2 }\n\
                 lubricant = { eta0 = 0.02, alpha = 15e-9, roelands_z = 0.6 }\ngrid = { nx = 64, x = [-0.4e-3, 0.4e-3] }\n\
                 [cycle]\nball_speed = [1.0, 0.0, 1.0]\ndisc_speed = [1.0, 0.0, 1.0]\n";
    let warning_of = |more: &str| {
        fs::write(&path, format!("{scene}{more}")).unwrap();
        let output = stribeck(&["cycle", text(&path), "--force", "--out", text(folder.path())]);
        assert!(output.status.success(), "{}", error_of(&output));
        error_of(&output)
    };
    // Half-width sqrt(8 F R/(pi E')) = 105 um: 1 m/s over 5 ms/16 is 2.97 half-widths.
    let skipped = warning_of("time = [0.0, 2.5e-3, 5e-3]\nsteps = 16\n");
    assert!(skipped.contains("cycle.steps = 16: 2.97") && skipped.contains("at least 48 steps"), "{skipped}");
    let enough = warning_of("time = [0.0, 2.5e-3, 5e-3]\nsteps = 48\n");
    assert!(!enough.contains("cycle.steps"), "{enough}");
    let rest = warning_of("time = [0.0, 2.5e-3, 5e-3]\nquasi_static = true\n");
    assert!(rest.contains("without bound at 2.5000e-3 s"), "{rest}");
}

/// Films by formula rise with the speed; rows at rest have none.
#[test]
fn check_of_a_cycle_has_the_rows_of_the_extreme_films() {
    let folder = tempfile::tempdir().unwrap();
    let path = init(folder.path(), &FZG);
    let told = String::from_utf8(stribeck(&["check", text(&path)]).stdout).unwrap();
    assert!(
        told.starts_with("cycle      61 rows, 401 contacts in time\nthinnest film by formula: row "),
        "{told}"
    );
    let json = json_of(&stribeck(&["check", text(&path), "--json"]));
    let film = |row: &str| number(&json["cycle"][row]["film"], "formula_central");
    assert!(film("thinnest") < film("thickest"), "{json}");
    let rig = ["--reciprocating", "--stroke", "2 mm", "--frequency", "20", "--force"];
    let path = init(folder.path(), &rig);
    let told = String::from_utf8(stribeck(&["check", text(&path)]).stdout).unwrap();
    assert!(told.contains("121 rows, 400 contacts in time; 2 rows at rest"), "{told}");
}

/// A cycle without a number of steps has one per half-width of entrained film; the warnings of a cycle come before its first contact.
#[test]
fn check_of_a_cycle_has_its_steps_and_its_warnings() {
    let folder = tempfile::tempdir().unwrap();
    let cam = fs::read_to_string(common::repository("examples/scenes/cam.toml")).unwrap();
    let told = |name: &str, text_of: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text_of).unwrap();
        let output = stribeck(&["check", text(&path)]);
        (String::from_utf8(output.stdout.clone()).unwrap(), error_of(&output))
    };
    let (usual, warnings) = told("usual.toml", &cam);
    assert!(usual.starts_with("cycle      73 rows, 1944 contacts in time\n"), "{usual}");
    assert!(usual.contains("\ncycle      yes\n") && !warnings.contains("cycle.steps"), "{usual}{warnings}");
    let (_, warnings) = told("few.toml", &cam.replace("\nangle = [", "\nsteps = 100\nangle = ["));
    assert!(warnings.contains("cycle.steps = 100") && warnings.contains("at least 1944 steps"), "{warnings}");
    // A period in another unit.
    let (_, warnings) = told("long.toml", &cam.replace("period = 6.0000000000000005e-2", "period = 60.0"));
    assert!(warnings.contains("check the unit of the times, 60.000 s a cycle"), "{warnings}");
    let warm: Vec<String> = (0..72).map(|row| format!("{}.0", 350 + row % 2)).collect();
    let (_, warnings) = told(
        "warm.toml",
        &cam.replace("\nangle = [", &format!("\nbulk_temperature = [{}]\nangle = [", warm.join(", "))),
    );
    assert!(warnings.contains("cycle.bulk_temperature = 351"), "{warnings}");
    assert!(warnings.contains("brings full oil from its edge"), "{warnings}");
    let (scene, out) = (folder.path().join("usual.toml"), folder.path().join("out"));
    let output =
        stribeck(&["curve", text(&scene), "--points", "2", "--from", "3", "--to", "4", "--out", text(&out)]);
    assert!(
        error_of(&output).contains("[cycle]: `stribeck curve` solves the contact of the scene"),
        "{output:?}"
    );
}

/// The roughness of the options is that of the scene; options without effect are refused by name.
#[test]
fn machines_take_roughness_and_refuse_options_without_effect() {
    let folder = tempfile::tempdir().unwrap();
    let lift = lift(folder.path(), 73);
    let mut cam = cam(&lift);
    cam.retain(|option| !["--cells", "96"].contains(option));
    let rig = ["--reciprocating", "--stroke", "2 mm", "--frequency", "20", "--force"];
    for (machine, is_line) in [(&FZG[..], true), (&cam, true), (&rig, false)] {
        let options = [machine, &["--roughness", "300 nm", "--length", "40 um"]].concat();
        let scene = fs::read_to_string(init(folder.path(), &options)).unwrap();
        assert!(scene.contains("rq = \"300 nm\"") && scene.contains("length_x = \"40 um\""), "{scene}");
        assert_eq!(scene.contains("across = \"periodic\""), is_line);
    }
    let ground = [&FZG[..], &["--finish", "ground"]].concat();
    assert!(
        fs::read_to_string(init(folder.path(), &ground)).unwrap().contains("typical of a ground surface")
    );
    let path = folder.path().join("other.toml");
    for (machine, option, value) in [
        (&FZG[..], "--speed", "1 m/s"),
        (&FZG[..], "--slide-roll-ratio", "0.1"),
        (&FZG[..], "--load", "1 kN"),
        (&FZG[..], "--radius", "10 mm"),
        (&FZG[..], "--stroke", "1 mm"),
        (&cam, "--torque", "90"),
        (&rig, "--load-sharing", "half"),
        (&rig, "--speed", "1 m/s"),
        (&["--roller"], "--module", "2 mm"),
        (&["--load", "20 N"], "--module", "2 mm"),
    ] {
        let arguments = [&["init", text(&path)], machine, &[option, value]].concat();
        assert_refused(&arguments, &[option, "no effect"]);
    }
    let teeth = |shift: [&str; 2]| {
        let mut options = vec!["init", text(&path)];
        options.extend(FZG.iter().map(|option| match *option {
            "16" => "17",
            "0.1817" => shift[0],
            "0.1715" => shift[1],
            option => option,
        }));
        options.into_iter().map(str::to_owned).collect::<Vec<_>>()
    };
    assert_refused(&teeth(["0", "0"]), &["--teeth 17 24", "--shift must be at least 0.0057"]);
}

#[test]
fn cycle_without_a_table_is_refused() {
    let smooth = common::repository("examples/scenes/line.toml");
    let folder = tempfile::tempdir().unwrap();
    assert_refused(&["cycle", text(&smooth), "--out", text(folder.path())], &["cycle", "is missing"]);
}
