//! Scene files: round trip, the documentation, and errors that name the key.
#![expect(clippy::float_cmp, reason = "tests")]

use std::collections::BTreeSet;
use std::fmt::Write as _;

use stribeck::Grid;
use stribeck::sim::scene::{FileRoughness, GridSpec, Roughness, SolverKind, TribofilmSpec, WearSpec};
use stribeck::sim::{Scene, SimError, solve_contact, write_npz};
use stribeck::surface::{Form, write_npy};
use stribeck::wear::WearPressure;

use crate::common::scene_text::{assert_names, dry};

/// The page about scene files, and the tables in the order of the pages.
const FIRST_PAGE: &str = include_str!("../docs/scene.md");
const TABLES: [&str; 6] = [
    include_str!("../docs/cycles.md"),
    include_str!("../docs/scene_contact.md"),
    include_str!("../docs/scene_bodies.md"),
    include_str!("../docs/scene_fluid.md"),
    include_str!("../docs/scene_laws.md"),
    include_str!("../docs/scene_history.md"),
];

/// The first TOML block of `text`.
fn first_block(text: &str) -> &str {
    let (_, rest) = text.split_once("```toml\n").unwrap();
    rest.split_once("```").unwrap().0
}

/// The complete scene of the document.
fn documented() -> &'static str {
    let [.., history] = TABLES;
    first_block(history.split_once("## A complete scene").unwrap().1)
}

#[test]
fn documented_scene_is_the_reference_scene() {
    let expected = Scene::azam_2019(128).with_tribofilm();
    assert_eq!(Scene::from_toml(documented()).unwrap(), expected);
}

/// Its peak is Hertz' on 16 cells in the Hertz radius.
#[test]
fn smallest_documented_scene_is_solved() {
    let scene = Scene::from_toml(first_block(FIRST_PAGE)).unwrap();
    let solution = solve_contact(&scene).unwrap();
    assert!(solution.report.require_converged().is_ok());
    assert!((solution.pressure.max / 1e9 - 1.0).abs() < 1e-2, "{:?}", solution.contact);
}

#[test]
fn scenes_survive_the_round_trip() {
    let mut other = Scene::azam_2019(32);
    other.form = Form::Ellipsoid { radius_x: 1e-2, radius_y: 2e-2, angle: 0.0 };
    (other.load.hertz_pressure, other.load.force) = (None, Some(20.0));
    other.roughness.ball = Roughness::None;
    other.roughness.disc = Roughness::File(FileRoughness { path: "disc.npy".into(), rq: Some(1e-8) });
    other.solver.kind = SolverKind::SemiSystem;
    for scene in [Scene::azam_2019(128), Scene::azam_2019(8).with_tribofilm(), other] {
        assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    }
}

#[test]
fn defaults_are_those_of_the_document() {
    let mut scene = Scene::from_toml(documented()).unwrap();
    let minimal = Scene::from_toml(&dry("[tribofilm]\n[wear]\nexposure = \"contact_clock\"\n")).unwrap();
    assert_eq!(minimal.tribofilm, Some(TribofilmSpec::default()));
    let by_solids = WearSpec::azam_2019().with_pressure(WearPressure::Solid);
    assert_eq!(minimal.wear, Some(by_solids));
    assert_eq!((scene.solver, scene.thermal), (minimal.solver, minimal.thermal));
    assert_eq!((scene.friction, scene.tribofilm), (minimal.friction, minimal.tribofilm));
    assert_eq!(scene.wear, Some(WearSpec::azam_2019()));
    let lubricant = scene.lubricant.take();
    let short =
        Scene::from_toml(&dry("[lubricant]\neta0 = 0.004\nroelands_z = 0.68\nformula_alpha = 1.494e-8\n"))
            .unwrap();
    assert_eq!(short.lubricant, lubricant);
    assert_eq!(short.motion.entrainment_speed, 0.0);
}

/// Every key of the code is in the document, and every key of the document's scene is in its tables.
#[test]
fn document_lists_every_key() {
    let code = [
        include_str!("../src/sim/scene/mod.rs"),
        include_str!("../src/sim/scene/processes.rs"),
        include_str!("../src/sim/scene/elastic.rs"),
        include_str!("../src/sim/scene/lubricant.rs"),
        include_str!("../src/sim/scene/oil.rs"),
        include_str!("../src/thermal/properties.rs"),
        include_str!("../src/lubricant/doolittle_tait.rs"),
        include_str!("../src/lubricant/improved_yasutomi.rs"),
        include_str!("../src/sim/scene/materials.rs"),
        include_str!("../src/sim/scene/schedule.rs"),
        include_str!("../src/sim/scene/cycle.rs"),
        include_str!("../src/sim/scene/motion.rs"),
        include_str!("../src/sim/scene/roughness.rs"),
        include_str!("../src/sim/scene/stress.rs"),
        include_str!("../src/sim/scene/tribofilm.rs"),
        include_str!("../src/sim/scene/wear.rs"),
        include_str!("../src/surface/form.rs"),
    ]
    .concat();
    let fields: BTreeSet<&str> = code
        .lines()
        .filter_map(|line| {
            line.strip_prefix("    pub ").or_else(|| line.strip_prefix("        radius").map(|_| line.trim()))
        })
        .filter_map(|line| line.split_once(':'))
        .map(|(name, _)| name.trim())
        // The keys of an oil are those of its lubricant.
        .filter(|name| *name != "oil")
        .filter(|name| name.chars().all(|c| c.is_ascii_lowercase() || c == '_' || c.is_ascii_digit()))
        .collect();
    assert!(fields.len() > 40, "{fields:?}");
    let document = TABLES.concat();
    let missing: Vec<_> = fields
        .iter()
        .filter(|name| {
            let forms = [
                format!("`{name}`"),
                format!("[{name}]"),
                format!("[{name}."),
                format!(".{name}]"),
                format!(".{name}`"),
            ];
            !forms.iter().any(|form| document.contains(form.as_str()))
        })
        .collect();
    assert!(missing.is_empty(), "not in docs/scene_*.md: {missing:?}");
}

#[test]
fn unknown_keys_are_named_in_every_table() {
    assert_names(&format!("surprise = 1\n{}", dry("")), &["surprise", "line 1"]);
    let text = documented();
    let headers: Vec<&str> = text.lines().filter(|line| line.starts_with('[')).collect();
    assert_eq!(headers.len(), 15);
    for header in headers {
        let broken = text.replacen(header, &format!("{header}\nsurprise = 1"), 1);
        let line = 2 + text.lines().position(|other| other == header).unwrap();
        let table = header.trim_matches(['[', ']']);
        assert_names(&broken, &["surprise", table, &format!("line {line}")]);
    }
    assert_names(&dry("[roughness.ball]\nkind = \"none\"\nrq = 1e-9\n"), &["`rq`", "none", "roughness.ball"]);
    assert_names(&dry("[roughness.disc]\nkind = \"none\"\nfoo = 1\n"), &["`foo`", "roughness.disc"]);
    let ellipsoid = dry("").replacen("sphere", "ellipsoid", 1);
    assert_names(&ellipsoid, &["`radius`", "ellipsoid", "`form`"]);
}

#[test]
fn missing_and_mistyped_values_are_named() {
    let text = dry("[roughness.ball]\nkind = \"gaussian\"\nrq = 1e-9\nlength_x = 1e-5\nlength_y = 1e-5\n");
    let mut table = String::new();
    for (index, line) in text.lines().enumerate() {
        if let Some(header) = line.strip_prefix('[') {
            table = header.trim_end_matches(']').to_owned();
            continue;
        }
        let key = line.split(" = ").next().unwrap();
        let without: String = text.lines().filter(|other| *other != line).map(|l| format!("{l}\n")).collect();
        assert_names(&without, &[key, &table]);
        let mut mistyped = String::new();
        for (other, content) in text.lines().enumerate() {
            let content = if other == index { format!("{key} = true") } else { content.to_owned() };
            writeln!(mistyped, "{content}").unwrap();
        }
        assert_names(&mistyped, &[&format!("{table}.{key}"), &format!("line {}", index + 1)]);
    }
    assert_names(&dry("").replace("nx = 16", "nx = -1"), &["grid.nx", "-1"]);
    assert_names(&dry("").replace("x = [-0.25e-3, 0.25e-3]", "x = [-1e-3, 0.0, 1e-3]"), &["grid.x", "3"]);
    assert_names("[form\n", &["line 1", "[form"]);
}

/// One value of each field that is out of range, in the documented scene.
#[test]
fn values_out_of_range_are_named() {
    let cases = [
        ("form.radius", "radius = 9.525e-3", "radius = -1.0", "-1"),
        ("elastic.equivalent_modulus", "= 229.67e9", "= nan", "NaN"),
        ("load.hertz_pressure", "= 1.15e9", "= inf", "inf"),
        ("load.hertz_pressure", "= 1.15e9", "= 0", "0"),
        ("load.hertz_pressure", "= 1.15e9", "= 1e300", "1e300"),
        ("load", "hertz_pressure = 1.15e9", "hertz_pressure = 1e9\nforce = 1.0", "not both"),
        ("load", "hertz_pressure = 1.15e9", "", "missing"),
        ("motion.entrainment_speed", "= 0.1\n", "= 0.0\n", "0"),
        ("motion.slide_roll_ratio", "= 0.05", "= nan", "NaN"),
        ("lubricant.eta0", "eta0 = 0.004", "eta0 = 1e-5", "1e-5"),
        ("lubricant.roelands_z", "= 0.68", "= 0.0", "0"),
        ("lubricant.roelands_p0", "= 1.96e8", "= -1.0", "-1"),
        ("lubricant.formula_alpha", "= 1.494e-8", "= 0.0", "0"),
        ("lubricant.density_a", "= 0.6e-9", "= -1.0", "-1"),
        ("lubricant.density_b", "= 1.7e-9", "= nan", "NaN"),
        ("grid.nx", "nx = 128", "nx = 0", "0"),
        ("grid.ny", "ny = 128", "ny = 1", "1"),
        ("grid.nx * grid.ny", "nx = 128", "nx = 4000000000", "5.12e11"),
        ("grid.x", "x = [-0.25e-3, 0.25e-3]", "x = [0.25e-3, -0.25e-3]", "-0.00025"),
        ("grid.x", "x = [-0.25e-3, 0.25e-3]", "x = [0.1e-3, 0.25e-3]", "1.0"),
        ("grid", "x = [-0.25e-3, 0.25e-3]", "x = [-1.0, 1.0]", "Hertz"),
        ("roughness.ball.rq", "rq = 20e-9", "rq = -1.0", "-1"),
        (
            "roughness.disc.length_y",
            "rq = 130e-9\nlength_x = 10e-6\nlength_y = 10e-6",
            "rq = 130e-9\nlength_x = 10e-6\nlength_y = inf",
            "inf",
        ),
        ("plastic.hardness", "hardness = 6e9\nfilm", "hardness = 1e6\nfilm", "N"),
        ("plastic.film_hardness", "= 2e9", "= 0.0", "0"),
        ("friction.boundary_coefficient", "= 0.115", "= -0.1", "-0.1"),
        ("friction.limiting_shear_stress", "= 1e8", "= 0.0", "0"),
        ("tribofilm.maximum_thickness", "= 200e-9", "= 0.0", "0"),
        ("tribofilm.removal_rate", "= 4.022e-4", "= nan", "NaN"),
        ("wear.coefficient", "coefficient = 5.45e-8", "coefficient = -1.0", "-1"),
        ("wear.film_coefficient", "= 5.45e-9", "= 1.0", "1"),
        ("thermal.bulk_temperature", "= 353.15", "= -1.0", "-1"),
        ("thermal.conductivity", "= 46.0", "= 0.0", "0"),
        ("thermal.diffusivity", "= 1.27e-5", "= inf", "inf"),
        ("solver.tolerance", "tolerance = 1e-6", "tolerance = 1.0", "1"),
        ("solver.film_cutoff", "= 1e-9", "= 0.0", "0"),
        ("solver.film_cutoff", "= 1e-9", "= 1e300", "1e300"),
        ("solver.relaxation", "= 0.2", "= 1.5", "1.5"),
        ("solver.stiffness", "= 6.0", "= 0.5", "0.5"),
    ];
    for (field, from, to, value) in cases {
        let broken = documented().replacen(from, to, 1);
        assert_ne!(broken, documented(), "{from}");
        assert_names(&broken, &[field, value]);
    }
}

#[test]
fn files_of_heights_are_taken_node_by_node() {
    let folder = tempfile::tempdir().unwrap();
    let bump: Vec<f64> = (0..256).map(|k| 1e-9 * f64::from(k)).collect();
    write_npy(folder.path().join("ball.npy"), 16, 16, &bump).unwrap();
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, dry("[roughness.ball]\nkind = \"file\"\npath = \"ball.npy\"\n")).unwrap();
    let scene = Scene::load(&scene).unwrap();
    let mut smooth = scene.clone();
    smooth.roughness.ball = Roughness::None;
    let (rough, smooth) = (solve_contact(&scene).unwrap(), solve_contact(&smooth).unwrap());
    for (k, bump) in bump.iter().enumerate() {
        assert!((smooth.gap[k] - rough.gap[k] - bump).abs() < 1e-18, "{k}");
    }

    let mut other = scene.clone();
    other.grid = GridSpec::Cells { nx: 17, ny: 16, x: [-0.25e-3, 0.25e-3], y: [-0.25e-3, 0.25e-3] };
    let message = solve_contact(&other).unwrap_err().to_string();
    assert!(message.contains("roughness.ball.path") && message.contains("16 x 16"), "{message}");
    std::fs::write(folder.path().join("ball.npy"), b"\x93NUMPY\x01\x00").unwrap();
    let message = solve_contact(&scene).unwrap_err().to_string();
    assert!(message.contains("roughness.ball.path") && message.contains("ball.npy"), "{message}");
    std::fs::remove_file(folder.path().join("ball.npy")).unwrap();
    let message = solve_contact(&scene).unwrap_err().to_string();
    assert!(message.contains("roughness.ball.path") && message.contains("ball.npy"), "{message}");
}

#[test]
fn ellipsoid_turned_by_a_right_angle_is_the_same_contact() {
    let along = dry("").replacen(
        "kind = \"sphere\"\nradius = 9.525e-3",
        "kind = \"ellipsoid\"\nradius_x = 12e-3\nradius_y = 8e-3",
        1,
    );
    let across = along.replacen("radius_x = 12e-3\nradius_y = 8e-3", "radius_x = 8e-3\nradius_y = 12e-3", 1);
    let [along, across] =
        [along, across].map(|text| solve_contact(&Scene::from_toml(&text).unwrap()).unwrap());
    assert!((along.hertz.half_width_x / across.hertz.half_width_y - 1.0).abs() < 1e-12);
    assert!(along.hertz.half_width_x > along.hertz.half_width_y);
    for j in 0..16 {
        for i in 0..16 {
            let (p, q) = (along.state.pressure[j * 16 + i], across.state.pressure[i * 16 + j]);
            assert!((p - q).abs() < 1e-5 * along.hertz.pressure, "{i} {j}: {p} {q}");
        }
    }
}

#[test]
fn archive_refuses_what_it_cannot_hold() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields.npz");
    let grid = Grid::centred(3, 2, 1e-6, 1e-6).unwrap();
    for fields in [
        [("film", 5), ("gap", 6)],
        [("film", 6), ("film", 6)],
        [("", 6), ("gap", 6)],
        [("a/b", 6), ("gap", 6)],
        [("x", 6), ("gap", 6)],
    ] {
        let values = fields.map(|(name, n)| (name, vec![0.0; n]));
        let borrowed: Vec<(&str, &[f64])> = values.iter().map(|(name, v)| (*name, v.as_slice())).collect();
        let error = write_npz(&path, &grid, &borrowed).unwrap_err();
        assert!(matches!(error, SimError::Input(_)), "{error}");
        assert!(error.to_string().contains(fields[0].0), "{error}");
    }
    let error = write_npz(folder.path(), &grid, &[("film", &[0.0; 6])]).unwrap_err();
    assert!(matches!(error, SimError::Io { .. }), "{error}");
}
