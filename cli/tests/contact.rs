//! `stribeck solve`, `check` and `init` from the outside.
#![expect(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{assert_pictures, assert_refused, error_of, json_of, repository, rough, stribeck, text};
use stribeck::Grid;
use stribeck::lubricant::{DensityLaw as _, DowsonHigginson};
use stribeck::sim::scene::Roughness;
use stribeck::sim::{Scene, solve_contact};
use stribeck::surface::Heights;

#[test]
fn solve_has_the_numbers_of_the_library_and_draws_them() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[]);
    let pictures = folder.path().join("pictures");
    let fields = folder.path().join("fields.npz");
    let output = stribeck(&[
        "solve",
        text(&scene),
        "--json",
        "--plot",
        "--out",
        text(&pictures),
        "--fields",
        text(&fields),
    ]);
    assert!(output.status.success(), "{output:?}");
    let mut numbers = json_of(&output);
    assert!(numbers["seconds"].as_f64().unwrap() > 0.0);
    numbers.as_object_mut().unwrap().remove("seconds");
    let oil = numbers.as_object_mut().unwrap().remove("oil").unwrap();
    let loaded = Scene::load(&scene).unwrap();
    assert_eq!(oil, serde_json::to_value(loaded.oil_numbers().unwrap()).unwrap());
    let solution = solve_contact(&loaded).unwrap();
    assert_eq!(numbers, serde_json::to_value(&solution).unwrap());
    assert_pictures(
        &pictures,
        "rough_maps",
        &["film (nm)", "pressure (GPa)", "theta", "x (µm)", "converged"],
    );
    assert_pictures(&pictures, "rough_profile", &["pressure (GPa)", "film (nm)", "fluid", "Hertz", "x (µm)"]);
    assert!(std::fs::read(&fields).unwrap().starts_with(b"PK"));
    let report = String::from_utf8(stribeck(&["solve", text(&scene)]).stdout).unwrap();
    assert!(report.starts_with("converged by") && report.contains("\nfriction "), "{report}");
    assert!(
        report.contains("composite Rq") && report.contains("lambda") && report.contains("of the fluid"),
        "{report}"
    );
}

#[test]
fn not_converging_ends_with_1() {
    let folder = tempfile::tempdir().unwrap();
    let scene = rough(folder.path(), &[("max_iterations = 20_000", "max_iterations = 1")]);
    let output = stribeck(&["solve", text(&scene), "--json"]);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    assert_eq!(json_of(&output)["status"], "max_iterations");
}

#[test]
fn bad_input_ends_with_2() {
    assert_refused(&["solve", "no_such_scene.toml"], &["no_such_scene.toml"]);
    let folder = tempfile::tempdir().unwrap();
    for command in ["solve", "check", "run", "curve"] {
        let scene = rough(folder.path(), &[("radius = 9.525e-3", "radius = \"9.5 kg\"")]);
        assert_refused(&[command, text(&scene)], &["rough.toml: form.radius = \"9.5 kg\"", "mm"]);
        let scene = rough(folder.path(), &[("eta0 = 0.004", "eta0 = -1.0")]);
        assert_refused(&[command, text(&scene)], &["rough.toml: ", "= -1"]);
    }
    let scene = rough(folder.path(), &[]);
    for arguments in [vec!["--nonsense"], vec!["solve"], vec!["curve", text(&scene), "--points", "1"]] {
        let output = stribeck(&arguments);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{output:?}");
    }
    let file = folder.path().join("a_file");
    std::fs::write(&file, "").unwrap();
    assert_refused(&["solve", text(&scene), "--plot", "--out", text(&file)], &["a_file"]);
    assert_refused(&["curve", text(&scene), "--from", "1 m/s", "--to", "1 mm/s"], &["--to = 0.001"]);
    let dry = rough(folder.path(), &[("kind = \"auto\"", "kind = \"dry\"")]);
    assert_refused(&["curve", text(&dry)], &["lubricant: a Stribeck curve needs an oil"]);
}

/// An oil whose viscosity does not know temperature has no film temperature.
#[test]
fn check_refuses_what_solve_refuses() {
    let folder = tempfile::tempdir().unwrap();
    let warm = "[lubricant.thermal]\n[grid]";
    for (from, to) in [("[grid]", warm), ("hardness = 6e9", "hardness = 1e6"), ("nx = 32", "nx = 3")] {
        let scene = rough(folder.path(), &[(from, to)]);
        let [check, solve] = ["check", "solve"].map(|command| {
            let output = stribeck(&[command, text(&scene)]);
            assert_eq!(output.status.code(), Some(2), "{output:?}");
            error_of(&output).lines().find(|line| line.starts_with("error: ")).map(str::to_owned)
        });
        assert!(check.is_some() && check == solve, "{check:?} {solve:?}");
    }
}

/// A scene that is one contact or one history alone is checked as that, and the other says why not.
#[test]
fn check_tells_contact_and_history_apart() {
    let folder = tempfile::tempdir().unwrap();
    let loads = "[schedule.load]\nkind = \"steps\"\ntimes = [0.0, 10.0]\nvalues = [20.0, 1e5]\n[solver]";
    for (from, to, refused) in [
        ("[solver]", "[track]\nradius_disc = 1e-6\n[solver]", "track.radius_disc = 1e-6: "),
        ("[solver]", "[track]\nexposure = \"track\"\n[solver]", "track.radius_ball: "),
        ("[solver]", loads, "plastic.hardness = "),
    ] {
        let scene = rough(folder.path(), &[(from, to)]);
        let check = stribeck(&["check", text(&scene), "--json"]);
        assert_eq!(check.status.code(), Some(0), "{check:?}");
        let numbers = json_of(&check);
        let why = numbers["refused"]["run"].as_str().unwrap();
        assert!(why.starts_with(refused) && numbers["refused"]["solve"].is_null(), "{why}");
        assert!(numbers["hertz"]["force"].as_f64().unwrap() < 60.0, "{numbers}");
        assert_refused(&["run", text(&scene), "--steps", "1", "--time-step", "1"], &[why]);
        let solve = stribeck(&["solve", text(&scene), "--json"]);
        assert!(solve.status.code().is_some_and(|code| code < 2), "{solve:?}");
        let report = String::from_utf8(stribeck(&["check", text(&scene)]).stdout).unwrap();
        assert!(report.contains("\nsolve      yes\n") && report.contains("\nrun        no: "), "{report}");
        assert!(report.contains(why), "{report}");
    }
    // Half of 8 cells do for no estimate.
    let estimate = rough(folder.path(), &[("= 32", "= 8"), ("[solver]", "[solver]\nestimate = true")]);
    let check = stribeck(&["check", text(&estimate), "--json"]);
    assert!(
        check.status.code() == Some(2) && error_of(&check).contains("solver.estimate needs"),
        "{check:?}"
    );
    for command in
        [["solve", text(&estimate)].as_slice(), &["run", text(&estimate), "--steps", "1", "--time-step", "1"]]
    {
        let refused = stribeck(command);
        let message = error_of(&check);
        assert!(refused.status.code() == Some(2) && error_of(&refused) == message, "{refused:?}");
    }
    // Cells that the solve picks are none for a history.
    let line = stribeck(&["check", text(&repository("examples/scenes/line.toml")), "--json"]);
    assert!(json_of(&line)["refused"]["run"].as_str().unwrap().contains("grid"), "{line:?}");
}

#[test]
fn check_tells_what_to_expect() {
    let folder = tempfile::tempdir().unwrap();
    let path = rough(folder.path(), &[("length_y = 50e-6", "length_y = 20e-6")]);
    let output = stribeck(&["check", text(&path), "--json"]);
    assert!(output.status.success(), "{output:?}");
    let numbers = json_of(&output);
    let scene = Scene::load(&path).unwrap();
    let (hertz, film) = (scene.hertz().unwrap(), scene.formula_film().unwrap().unwrap());
    assert_eq!(numbers["hertz"]["half_width_x"], hertz.half_width_x);
    assert_eq!(numbers["moes"]["m"], film.moes.m);
    let density = DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap().ratio(hertz.pressure);
    assert_eq!(numbers["film"]["formula_central"], film.central / density);
    assert_eq!(numbers["regime"], "piezoviscous-elastic");
    let rq = numbers["roughness"]["composite_rq"].as_f64().unwrap();
    assert!((rq / 20e-9_f64.hypot(130e-9) - 1.0).abs() < 0.2, "on the track: {rq}");
    let solved = solve_contact(&scene).unwrap();
    assert!((rq / solved.roughness.composite_rq - 1.0).abs() < 1e-12, "as `solve` has it");
    assert_eq!(numbers["film"]["formula_lambda"], film.central / density / rq);
    let length = numbers["roughness"]["correlation_length"].as_f64().unwrap();
    assert!((length - 20e-6).abs() < scene.grid().unwrap().dx(), "within a cell: {length}");
    assert_eq!(numbers["grid"]["cells_in_half_width"], hertz.half_width_x / scene.grid().unwrap().dx());
    assert_eq!(numbers["warnings"], serde_json::to_value(scene.warnings()).unwrap());
    let warnings = error_of(&output);
    assert!(!scene.warnings().is_empty());
    assert_eq!(warnings.lines().filter(|line| line.starts_with("warning: ")).count(), scene.warnings().len());
    let modelled = |name: &str| {
        let parts = numbers["modelled"].as_array().unwrap();
        parts.iter().find(|part| part["part"] == name).unwrap()["modelled"].as_bool().unwrap()
    };
    assert!(modelled("oil") && modelled("plastic limit") && modelled("rough disc"));
    assert!(!modelled("wear") && !modelled("tribofilm") && modelled("flooded inlet"));
    assert!(modelled("shear of the oil") && !modelled("flow thinning"));
    let report = String::from_utf8(stribeck(&["check", text(&path)]).stdout).unwrap();
    for words in [
        "Hertz",
        "by the formula of Hamrock and Dowson",
        "lambda",
        "32 x 32 cells",
        "tribofilm, wear",
        "Newtonian",
        "lubrication: ",
    ] {
        assert!(report.contains(words), "no {words} in {report}");
    }
    assert!(
        report.starts_with("regime     piezoviscous-elastic") && report.lines().count() <= 25,
        "{report}"
    );
    let thinned =
        "[friction]\ncarreau_stress = 5e6\ncarreau_exponent = 0.5\nflow_thinning = \"effective\"\n[motion]\n";
    let thinned = rough(folder.path(), &[("[motion]\n", thinned)]);
    let report = String::from_utf8(stribeck(&["check", text(&thinned)]).stdout).unwrap();
    let modelled = report.lines().find(|line| line.starts_with("modelled ")).unwrap();
    assert!(modelled.contains("shear of the oil by Carreau, flow thinning"), "{report}");
    // A scene that picks its mesh, of a line contact.
    let line = stribeck(&["check", text(&repository("examples/scenes/line.toml")), "--json"]);
    assert!(line.status.success() && json_of(&line)["grid"].is_null(), "{line:?}");
}

#[test]
fn a_scene_of_init_is_checked_and_solved_without_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let rough =
        ["--roughness", "20 nm", "--length", "30 um", "--cells", "64", "--slide-roll-ratio", "5%"].as_slice();
    let smooth =
        ["--roughness", "0", "--radius", "12.7 mm", "--load", "30", "--speed", "200 mm/s", "--cells", "192"]
            .as_slice();
    for options in [rough, smooth] {
        let output = stribeck(&[&["init", text(&path)], options].concat());
        assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
        let written = std::fs::read_to_string(&path).unwrap();
        assert!(written.contains("estimate = true"), "{written}");
        assert!(written.contains("entrainment_speed = \"") && written.matches("# ").count() > 8, "{written}");
        let output = stribeck(&["check", text(&path)]);
        assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
        let output = stribeck(&["solve", text(&path), "--json"]);
        assert!(output.status.success() && !error_of(&output).contains("warning"), "{output:?}");
        let numbers = json_of(&output);
        assert_eq!(numbers["status"], "converged");
        assert_eq!(numbers["warnings"].as_array().unwrap().len(), 0);
        // It is written over on request alone.
        assert_refused(&["init", text(&path)], &["scene.toml", "--force"]);
        std::fs::remove_file(&path).unwrap();
    }
    // A thick film needs a longer inlet, on cells of the same size.
    let thicker = ["--eta0", "50 mPa s", "--speed", "2 m/s", "--load", "5 N", "--roughness", "0"];
    let output = stribeck(&[&["init", text(&path)], thicker.as_slice()].concat());
    assert!(output.status.success(), "{output:?}");
    let grid = Scene::load(&path).unwrap().grid().unwrap();
    assert!(grid.nx() > grid.ny() && (grid.dx() / grid.dy() - 1.0).abs() < 1e-3, "{grid:?}");
    std::fs::remove_file(&path).unwrap();
    // A very thick one a wider box, and one that a ball swims on is refused.
    let thick =
        ["init", text(&path), "--roughness", "0", "--load", "5", "--speed", "2", "--eta0", "300 mPa s"];
    let output = stribeck(&thick);
    assert!(output.status.success(), "{output:?}");
    let scene = Scene::load(&path).unwrap();
    let (grid, hertz) = (scene.grid().unwrap(), scene.hertz().unwrap());
    assert!(-grid.x(0) > 8.0 * hertz.half_width_x && grid.nx() < 300, "{grid:?}");
    let solution = solve_contact(&scene).unwrap();
    assert!(solution.report.require_converged().is_ok(), "{:?}", solution.report);
    std::fs::remove_file(&path).unwrap();
    let swims = ["init", text(&path), "--load", "1", "--speed", "10", "--eta0", "100 mPa s"];
    assert_refused(&swims, &["--speed = 10", "more load"]);
    let short = ["init", text(&path), "--roughness", "50 nm", "--length", "1 um"];
    assert_refused(&short, &["more than 262144 nodes", "--length", "--cells"]);
    let few = ["init", text(&path), "--roughness", "50 nm", "--length", "5 um", "--cells", "64"];
    assert_refused(&few, &["--cells = 64", "less than 3 cells"]);
    assert_refused(&["init", text(&path), "--roughness", "50 nm"], &["--length is missing", "--finish"]);
    for (option, value, words) in [
        ("--alpha", "12", "--alpha = 12: "),
        ("--radius", "9.525", "did you mean 9.525 mm"),
        ("--radius", "-3mm", "--radius = -0.003: must be"),
        ("--slide-roll-ratio", "fast", "--slide-roll-ratio"),
        ("--cells", "-1", "--cells = \"-1\": must be a whole number from 16 to 2048"),
    ] {
        let output = stribeck(&["init", text(&path), option, value]);
        assert!(output.status.code() == Some(2) && error_of(&output).contains(words), "{output:?}");
    }
    let slow = ["init", text(&path), "--speed", "0.001", "--roughness", "0"];
    let output = stribeck(&slow);
    assert!(output.status.success(), "{output:?}");
    assert!(error_of(&output).contains("warning: contact.load_ratio = 0.87"), "{output:?}");
    std::fs::remove_file(&path).unwrap();
    let unit = ["init", text(&path), "--load", "5 kg"];
    assert_refused(&unit, &["--load = \"5 kg\"", "N"]);
    assert!(!path.exists());
}

/// The cells resolve the roughness, whichever key describes it.
#[test]
fn cells_of_init_follow_from_the_roughness() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let light = ["--load", "1 N", "--speed", "2 m/s", "--eta0", "20 mPa s"];
    let written = |options: &[&str]| {
        let output = stribeck(&[&["init", text(&path), "--force"], light.as_slice(), options].concat());
        assert!(output.status.success(), "{output:?}");
        let scene = Scene::load(&path).unwrap();
        assert!(scene.solver.estimate);
        scene
    };
    let cell = |scene: &Scene| scene.grid().unwrap().dx();
    let Roughness::Random(polished) = written(&["--finish", "polished"]).roughness.disc else {
        panic!("random")
    };
    assert!((polished.rq / 25e-9 - 1.0).abs() < 1e-9, "{polished:?}");
    let own = ["--roughness", "20 nm", "--length", "6 um"];
    let random = written(&own);
    assert!(cell(&random) <= 1.5e-6 && cell(&random) > 1.2e-6, "{:?}", random.grid);
    // A measured surface of that length on points of 0.5 um.
    let grid = Grid::centred(800, 800, 0.5e-6, 0.5e-6).unwrap();
    let Roughness::Random(surface) = Roughness::gaussian(20e-9, 6e-6, 3) else { panic!("random") };
    let heights = Heights::new(800, 800, Some([0.5e-6; 2]), surface.generate(&grid).unwrap(), None).unwrap();
    let file = folder.path().join("disc.sdf");
    std::fs::write(&file, sdf(&heights)).unwrap();
    let measured = written(&["--surface", text(&file)]);
    assert!(matches!(&measured.roughness.disc, Roughness::File(_)), "{:?}", measured.roughness.disc);
    assert!((cell(&measured) / cell(&random) - 1.0).abs() < 0.25, "{:?} {:?}", measured.grid, random.grid);
    let both = ["init", text(&path), "--finish", "ground", "--roughness", "50 nm", "--length", "10 um"];
    assert_eq!(stribeck(&both).status.code(), Some(2));
}

/// A surface as text in the format sdf.
fn sdf(surface: &Heights) -> String {
    let mut text = format!(
        "aBCR-1.0\nManufacID = none\nCreateDate = 010120200000\nModDate = 010120200000\nNumPoints = {}\nNumProfiles = {}\n\
         Xscale = {:e}\nYscale = {:e}\nZscale = 1\nZresolution = -1\nCompression = 0\nDataType = 7\nCheckType = 0\n*\n",
        surface.nx(),
        surface.ny(),
        surface.dx().unwrap(),
        surface.dy().unwrap()
    );
    for height in surface.heights() {
        text += &format!("{height:e}\n");
    }
    text + "*\n"
}
