//! The load on solids by `check` against that of `solve`.
#![expect(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{error_of, json_of, repository, stribeck, text};
use stribeck::sim::Scene;
use stribeck::sim::solve_contact;
use stribeck::units::by_size;

/// Changes of the shipped ground disc: speeds from boundary lubrication to full film, finishes, lay, a light and a
/// heavy load.
const CHANGES: [(&str, &[(&str, &str)]); 12] = [
    ("as it is", &[]),
    ("slow", &[("\"0.1 m/s\"", "\"1 mm/s\"")]),
    ("slower", &[("\"0.1 m/s\"", "\"0.1 mm/s\"")]),
    ("fast", &[("\"0.1 m/s\"", "\"5 m/s\"")]),
    ("rough", &[("rq = \"40 nm\"", "rq = \"200 nm\"")]),
    ("rough and slow", &[("rq = \"40 nm\"", "rq = \"200 nm\""), ("\"0.1 m/s\"", "\"2 mm/s\"")]),
    ("very rough", &[("rq = \"40 nm\"", "rq = \"400 nm\"")]),
    ("polished", &[("rq = \"40 nm\"", "rq = \"5 nm\"")]),
    ("thin oil", &[("\"20 mPa s\"", "\"2 mPa s\""), ("\"0.1 m/s\"", "\"50 mm/s\"")]),
    ("transverse", &[("length_y = \"25 um\"", "length_y = \"100 um\""), ("\"0.1 m/s\"", "\"5 mm/s\"")]),
    ("light", &[("\"0.8 GPa\"", "\"0.4 GPa\""), ("\"0.1 m/s\"", "\"5 mm/s\"")]),
    ("heavy", &[("\"0.8 GPa\"", "\"1.0 GPa\""), ("\"0.1 m/s\"", "\"5 mm/s\"")]),
];

#[test]
fn load_on_solids_is_within_the_range_of_check() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let shipped = std::fs::read_to_string(repository("examples/scenes/ground_disc.toml")).unwrap();
    for (about, changes) in CHANGES {
        let changed = changes.iter().fold(shipped.clone(), |text, (from, to)| {
            assert!(text.contains(from), "{about}: {from}");
            text.replace(from, to)
        });
        std::fs::write(&path, &changed).unwrap();
        let numbers = json_of(&stribeck(&["check", text(&path), "--json"]));
        let report = String::from_utf8(stribeck(&["check", text(&path)]).stdout).unwrap();
        let solution = solve_contact(&Scene::from_toml(&changed).unwrap()).unwrap();
        let found = solution.contact.load_ratio;
        let range: Vec<f64> = serde_json::from_value(numbers["contact"]["load_ratio_range"].clone()).unwrap();
        assert!(range[0] - 0.05 < found && found < range[1] + 0.05, "{about}: {found} beside {range:?}");
        let words = report.lines().find(|line| line.starts_with("load ")).unwrap();
        assert!(found < 0.05 || !words.contains("full film"), "{about}: {found}, {words}");
        assert_eq!(
            words.contains("full film"),
            words.contains("by the inlets of the asperities"),
            "{about}: {words}"
        );
        assert!(found > 0.7 || !words.contains("boundary"), "{about}: {found}, {words}");
    }
}

/// `check` states viscosity and pressure-viscosity coefficient with their sources, `solve` the scatter of the film.
#[test]
fn oil_of_a_data_sheet_is_reported_with_its_sources() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let shipped = std::fs::read_to_string(repository("examples/scenes/ground_disc.toml")).unwrap();
    let oil = "eta0 = \"20 mPa s\"\nroelands_z = 0.68\n";
    assert!(shipped.contains(oil));
    let sheet = "grade = \"ISO VG 46\"\nviscosity_index = 95\n[thermal]\nbulk_temperature = \"40 degC\"\n";
    std::fs::write(&path, shipped.replace(oil, sheet)).unwrap();
    let report = String::from_utf8(stribeck(&["check", text(&path)]).stdout).unwrap();
    for part in [
        "39.29",
        "mPa s at 40.00 degC: ISO VG 46, VI 95",
        "870 kg/m^3",
        "assumed",
        "So and Klaus 1980",
        "+- 15 %",
        "of the film",
    ] {
        assert!(report.contains(part), "{part}: {report}");
    }
    let check = json_of(&stribeck(&["check", text(&path), "--json"]));
    let solve = stribeck(&["solve", text(&path)]);
    let film = check["oil"]["film_uncertainty"].as_f64().unwrap();
    assert!((0.06..0.09).contains(&film), "{film}");
    let solved = String::from_utf8(solve.stdout).unwrap();
    assert!(solved.contains(&format!("+- {:.0} % of the film", 100.0 * film)), "{solved}");
    std::fs::write(&path, &shipped).unwrap();
    let given = json_of(&stribeck(&["check", text(&path), "--json"]));
    assert_eq!(given["oil"]["eta0_source"], "lubricant.eta0");
    assert_eq!(given["oil"]["film_uncertainty"], 0.0);
}

#[test]
fn command_alone_prints_a_short_help() {
    let output = stribeck::<&str>(&[]);
    let help = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && output.stderr.is_empty());
    assert!(help.contains("stribeck solve scene.toml") && help.lines().count() < 15, "{help}");
}

#[test]
fn completion_scripts_list_the_subcommands() {
    for shell in ["bash", "zsh", "fish"] {
        let output = stribeck(&["completion", shell]);
        let script = String::from_utf8(output.stdout).unwrap();
        assert!(
            output.status.success() && script.contains("curve") && script.contains("slide_roll_ratio"),
            "{shell}"
        );
    }
}

/// A key has its row of the book, a warning its row of the table of warnings; all others the nearest keys.
/// Paths of all keys of `table`.
fn paths(table: &toml::Table, start: &str, found: &mut Vec<String>) {
    for (key, value) in table {
        match value {
            toml::Value::Table(inner) => paths(inner, &format!("{start}{key}."), found),
            _ => found.push(format!("{start}{key}")),
        }
    }
}

#[test]
fn explain_has_all_keys_of_the_examples() {
    let mut keys = Vec::new();
    for file in std::fs::read_dir(repository("examples/scenes")).unwrap() {
        let text = std::fs::read_to_string(file.unwrap().path()).unwrap_or_default();
        paths(&text.parse().unwrap_or_default(), "", &mut keys);
    }
    keys.retain(|key| !key.starts_with("schedule."));
    keys.sort();
    keys.dedup();
    assert!(keys.contains(&"roughness.disc.kind".to_owned()) && keys.len() > 50, "{keys:?}");
    for key in keys {
        let output = stribeck(&["explain", &key]);
        assert!(output.status.success(), "{key}: {}", error_of(&output));
    }
}

/// All names in `value`; those of the objects in a list are behind the name of the list.
fn names(value: &serde_json::Value, before: &str, found: &mut Vec<String>) {
    match value {
        serde_json::Value::Object(entries) => entries.iter().for_each(|(name, value)| {
            let path = if before.is_empty() { name.clone() } else { format!("{before}.{name}") };
            names(value, &path, found);
        }),
        serde_json::Value::Array(values) if values.iter().any(serde_json::Value::is_object) => {
            found.push(before.to_owned());
            values.iter().for_each(|value| names(value, "", found));
        }
        _ => found.push(before.to_owned()),
    }
}

#[test]
fn explain_has_all_names_of_json_outputs() {
    let folder = tempfile::tempdir().unwrap();
    let out = text(folder.path());
    let example = |name: &str| text(&repository(&format!("examples/scenes/{name}.toml"))).to_owned();
    let (rough, smooth) = (example("rough"), example("mtm"));
    let (journal, flat) = (example("journal"), example("flat"));
    let curve = ["--points", "2", "--seeds", "2", "--model", "asperity_inlets", "--out", out];
    let mut found = Vec::new();
    for arguments in [
        ["solve", &smooth].as_slice(),
        &["check", &example("roller_bearing")],
        &["check", &rough],
        &["solve", &journal],
        &["check", &journal],
        &["solve", &flat],
        &[["curve", &rough].as_slice(), &curve].concat(),
        &["curve", &journal, "--points", "2", "--out", out],
    ] {
        names(&json_of(&stribeck(&[arguments, &["--json"]].concat())), "", &mut found);
    }
    found.sort();
    found.dedup();
    assert!(found.contains(&"film.formula_central".to_owned()) && found.len() > 100, "{found:?}");
    for name in found {
        let output = stribeck(&["explain", &name]);
        assert!(output.status.success(), "{name}: {}", error_of(&output));
    }
}

#[test]
fn explain_prints_the_words_of_the_book() {
    let explained = |words: &[&str]| {
        let output = stribeck(&[&["explain"], words].concat());
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let key = explained(&["lubricant.grade"]);
    assert!(
        key.contains("ISO viscosity grade")
            && key.contains("ISO 3448")
            && key.contains("docs/scene_fluid.md"),
        "{key}"
    );
    assert_eq!(explained(&["modulus"]).matches("Young's modulus").count(), 3);
    let warning = explained(&["box", "that", "ends", "less", "than", "1.5", "Hertz", "half-widths"]);
    assert!(warning.contains("grid.accuracy"), "{warning}");
    common::assert_refused(&["explain", "lubricant.graed"], &["graed", "lubricant.grade"]);
    let all = explained(&[]);
    assert!(all.contains("[form] kind, radius") && all.contains("[given_film] kind"), "{all}");
    assert!(explained(&["film.lambda"]).contains("docs/output.md"));
    assert!(explained(&["materials"]).contains("[materials.ball], [materials.disc] hardness"));
}

const BEARING: &str = "[given_film]\nkind = \"journal\"\ndiameter = \"50 mm\"\nwidth = \"25 mm\"\nclearance = \"40 um\"\n\
    speed = \"1500 rpm on 50 mm\"\nload = \"1 kN\"\nnx = 90\nny = 16\n[lubricant]\ngrade = \"ISO VG 32\"\n\
    viscosity_index = 98\n[thermal]\nbulk_temperature = \"50 degC\"\n";

/// The text has the numbers of the JSON; the fields are those of the grid; other subcommands name the one that takes it.
#[test]
fn rigid_bearing_is_solved_under_its_load() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("journal.toml");
    std::fs::write(&path, BEARING).unwrap();
    let fields = folder.path().join("fields.npz");
    let numbers = json_of(&stribeck(&["solve", text(&path), "--json", "--fields", text(&fields)]));
    let number = |key: &str| numbers[key].as_f64().unwrap();
    assert!((number("load") - 1000.0).abs() < 2e-3 && fields.exists());
    let [towards, across] = [0, 1].map(|k| numbers["force"][k].as_f64().unwrap());
    assert!((towards.hypot(across) / number("load") - 1.0).abs() < 1e-12);
    let report = String::from_utf8(stribeck(&["solve", text(&path)]).stdout).unwrap();
    for part in [
        format!("eccentricity {:.4}", number("eccentricity")),
        format!("attitude {:.2} deg", number("attitude").to_degrees()),
        format!("power      {} lost", by_size(number("power_loss"), "W")),
        format!("side flow  {:.4} ml/s", 1e6 * number("side_flow")),
        format!("oil        {:.4} mPa s at 50.00 degC", 1e3 * number("eta0")),
    ] {
        assert!(report.contains(&part), "{part}: {report}");
    }
    let check = stribeck(&["check", text(&path)]);
    let lines = String::from_utf8(check.stdout).unwrap();
    // 1 kN on 50 mm x 25 mm
    for part in [
        "(1.60 per mille)",
        "over the projected area, by the film alone",
        &report_line(&report, "journal"),
        "left out   holes",
    ] {
        assert!(lines.contains(part), "{part}: {lines}");
    }
    let check = json_of(&stribeck(&["check", text(&path), "--json"]));
    assert!((check["specific_load"].as_f64().unwrap() / 0.8e6 - 1.0).abs() < 1e-5, "{check}");
    common::assert_refused(
        &["run", text(&path), "--steps", "1"],
        &["journal.toml", "[given_film]", "stribeck check"],
    );
    std::fs::write(&path, BEARING.replace("1 kN", "1 m")).unwrap();
    common::assert_refused(&["solve", text(&path)], &["journal.toml: given_film.load = \"1 m\"", "kN"]);
}

/// The line of `report` that begins with `word`.
/// A rate of rotation is on the diameter of the journal, and a warning names another one.
#[test]
fn rate_of_rotation_is_on_the_diameter_of_the_journal() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("journal.toml");
    let solved = |speed: &str| {
        std::fs::write(&path, BEARING.replace("1500 rpm on 50 mm", speed)).unwrap();
        json_of(&stribeck(&["solve", text(&path), "--json"]))
    };
    let (own, stated) = (solved("1500 rpm"), solved("1500 rpm on 50 mm"));
    assert_eq!(own["friction_moving"], stated["friction_moving"]);
    assert!(
        own["warnings"].as_array().unwrap().is_empty()
            && solved("1500 rpm on 50.4 mm")["warnings"][0].is_null()
    );
    let warning = &solved("1500 rpm on 40 mm")["warnings"][0];
    let message = warning["message"].as_str().unwrap();
    assert!(message.contains("40.000 mm") && message.contains("50.000 mm"), "{warning}");
    assert_eq!(warning["field"], "given_film.speed");
    std::fs::write(&path, BEARING.replace("1500 rpm on 50 mm", "1500 rpm at 50 mm")).unwrap();
    common::assert_refused(&["solve", text(&path)], &["given_film.speed", "rpm"]);
}

/// An oil that cavitates below an absolute vacuum is solved with a warning.
#[test]
fn cavitation_below_a_vacuum_is_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("journal.toml");
    for (pressure, is_warned) in [("-1 bar", false), ("-5 bar", true)] {
        let scene = BEARING.replace("nx = 90", &format!("cavitation_pressure = \"{pressure}\"\nnx = 90"));
        std::fs::write(&path, scene).unwrap();
        let numbers = json_of(&stribeck(&["solve", text(&path), "--json"]));
        let warnings = numbers["warnings"].as_array().unwrap();
        let found = warnings.iter().find(|warning| warning["field"] == "given_film.cavitation_pressure");
        assert_eq!(found.is_some(), is_warned, "{warnings:?}");
        assert!(found.is_none_or(|warning| warning["value"] == -5e5), "{found:?}");
    }
}

/// All missing keys of a bearing are named at once, one alone with its line or its meaning.
#[test]
fn missing_keys_of_a_bearing_are_named_together() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bearing.toml");
    for (scene, missing) in [
        ("kind = \"journal\"\n", ["given_film.diameter", "given_film.speed", "given_film.load", "lubricant"]),
        (
            "kind = \"pad\"\n",
            ["given_film.length", "given_film.inlet_film", "given_film.outlet_film", "lubricant"],
        ),
        (
            "kind = \"step\"\nload = 1\n",
            ["given_film.length", "given_film.step", "given_film.taper", "lubricant"],
        ),
    ] {
        std::fs::write(&path, format!("[given_film]\n{scene}")).unwrap();
        common::assert_refused(&["solve", text(&path)], &[["missing keys: "].as_slice(), &missing].concat());
    }
    std::fs::write(&path, BEARING.replace("width = \"25 mm\"\n", "").replace("load = \"1 kN\"\n", ""))
        .unwrap();
    common::assert_refused(&["solve", text(&path)], &["missing keys: `given_film.width`, `given_film.load`"]);
    std::fs::write(&path, BEARING.replace("load = \"1 kN\"\n", "")).unwrap();
    common::assert_refused(&["solve", text(&path)], &["missing key `load`, or `eccentricity`"]);
    std::fs::write(&path, BEARING).unwrap();
    let sweep = ["sweep", text(&path), "--over", "given_film.load=1,2", "--out", text(folder.path())];
    common::assert_refused(&sweep, &["stribeck curve --over speed"]);
}

fn report_line(report: &str, word: &str) -> String {
    report.lines().find(|line| line.starts_with(word)).unwrap().to_owned()
}

/// `init` writes an oil by its grade, at its temperature.
#[test]
fn init_writes_an_oil_by_its_grade() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new.toml");
    let arguments =
        ["--grade", "ISO VG 46", "--temperature", "60 degC", "--cells", "32", "--speed", "0.2 m/s"];
    let output = stribeck(&[&["init", text(&path)], &arguments[..]].concat());
    assert!(output.status.success(), "{output:?}");
    let scene = Scene::load(&path).unwrap();
    let oil = scene.oil_numbers().unwrap().unwrap();
    assert!(
        (oil.temperature - 333.15).abs() < 1e-9 && oil.eta0_source.starts_with("ISO VG 46, VI 95"),
        "{oil:?}"
    );
    std::fs::remove_file(&path).unwrap();
    common::assert_refused(&["init", text(&path), "--grade", "ISO VG 47"], &["ISO VG 46", "lubricant.grade"]);
    common::assert_refused(
        &["init", text(&path), "--grade", "ISO VG 46", "--eta0", "0.1"],
        &["--eta0", "--grade"],
    );
    common::assert_refused(&["init", text(&path), "--temperature", "60 degC"], &["--grade"]);
    assert!(!path.exists());
}

/// The shipped journal has the load of its scene, the shipped traction contact the film of its formula and the speeds of
/// its bodies.
#[test]
fn shipped_scenes_of_data_sheets_have_their_hand_formulas() {
    let shipped = |name: &str| repository(&format!("examples/scenes/{name}.toml"));
    let journal = json_of(&stribeck(&["solve", text(&shipped("journal")), "--json"]));
    let number = |key: &str| journal[key].as_f64().unwrap();
    assert!(
        (number("load") / 2000.0 - 1.0).abs() < 1e-5 && journal["warnings"].as_array().unwrap().is_empty()
    );
    // Between the friction of the centered journal (Petroff) and three times that.
    let speed = std::f64::consts::PI * 50.0 * 50e-3;
    let petroff = number("eta0") * speed / 25e-6 * std::f64::consts::PI * 50e-3 * 25e-3;
    assert!((1.0..3.0).contains(&(number("friction_moving") / petroff)), "{journal}");
    let scene = Scene::load(shipped("traction")).unwrap();
    let [ball, disc] = scene.motion.surface_speeds();
    assert!((ball - std::f64::consts::PI * 10.0 * 19.05e-3).abs() < 1e-12);
    assert!((disc - std::f64::consts::PI * 2.0 * 84e-3).abs() < 1e-12);
    let solution = solve_contact(&scene).unwrap();
    assert!(solution.warnings.is_empty(), "{:?}", solution.warnings);
    let formula = scene.formula_film().unwrap().unwrap().central;
    assert!((solution.film.central / formula - 1.0).abs() < 0.1, "{} {formula}", solution.film.central);
}

/// At half and at twice the contact film by the closed form, whose inlet number falls with the power 4/3 of it.
#[test]
fn contact_film_is_printed_with_its_effect_on_load_and_friction() {
    let folder = tempfile::tempdir().unwrap();
    let path = common::rough(folder.path(), &[]);
    let numbers = json_of(&stribeck(&["check", text(&path), "--json"]));
    let contact = &numbers["contact"];
    let share = contact["load_ratio"].as_f64().unwrap();
    let ends: Vec<f64> = serde_json::from_value(contact["load_ratio_by_contact_film"].clone()).unwrap();
    for (end, factor) in ends.iter().zip([0.5_f64, 2.0]) {
        let exact = 1.0 / (1.0 + (1.0 / share - 1.0) * factor.powf(-4.4));
        assert!((end - exact).abs() < 1e-9, "{end} {exact}");
    }
    let exact = 1.23 * (1.0 / share - 1.0).powf(1.0 / 3.3);
    let number = contact["inlet_number"].as_f64().unwrap();
    assert!((number / exact - 1.0).abs() < 1e-9, "{number} {exact}");
    let friction: Vec<f64> = serde_json::from_value(contact["friction_by_contact_film"].clone()).unwrap();
    let all = numbers["friction"]["coefficient"].as_f64().unwrap();
    assert!(friction[0] < all && all < friction[1], "{friction:?} {all}");
    assert_eq!(numbers["roughness"]["short_roughness"], 0.0);
    let output = String::from_utf8(stribeck(&["check", text(&path)]).stdout).unwrap();
    assert!(output.contains("touch      at films of 1.00 nm; at half of it solids have"), "{output}");
}

/// Waves that the cells do not hold and asperities do not flatten: of exponential surfaces, not of Gaussian ones, and not
/// where a contact film is given.
#[test]
fn contact_film_of_molecules_below_short_waves_is_warned_of() {
    let folder = tempfile::tempdir().unwrap();
    let film = |more: &[(&str, &str)]| {
        let path = common::rough(folder.path(), more);
        let output = stribeck(&["check", text(&path), "--json"]);
        let short = json_of(&output)["roughness"]["short_roughness"].as_f64().unwrap();
        (short, error_of(&output).contains("solver.film_cutoff"))
    };
    let exponential = ("kind = \"gaussian\"", "kind = \"exponential\"");
    let (short, is_said) = film(&[exponential]);
    assert!(is_said && (1e-8..1.3e-7).contains(&short), "{short:e}");
    let (_, is_said) = film(&[exponential, ("[solver]", "[solver]\nfilm_cutoff = \"2 nm\"")]);
    assert!(!is_said);
    assert!(!film(&[]).1);
}
