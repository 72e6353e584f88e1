//! `stribeck surface` from the outside.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use std::path::PathBuf;

use common::{assert_pictures, assert_refused, error_of, json_of, repository, stribeck, text};

fn data(name: &str) -> PathBuf {
    repository("tests/data/surfaces").join(name)
}

const KEYS: [&str; 20] = [
    "sa", "sq", "ssk", "sku", "sp", "sv", "sz", "sdq", "sdr", "sal", "str", "sk", "spk", "svk", "smr1",
    "smr2", "vmp", "vmc", "vvc", "vvv",
];

#[test]
fn the_report_has_all_parameters_of_every_format_and_a_page() {
    let folder = tempfile::tempdir().unwrap();
    let table = std::fs::read_to_string(data("expected.csv")).unwrap();
    for line in table.lines().skip(1) {
        let (name, numbers) = line.split_once(',').unwrap();
        let numbers: Vec<f64> = numbers.split(',').map(|number| number.parse().unwrap()).collect();
        let out = folder.path().join(name);
        let output = stribeck(&["surface", text(&data(name)), "--json", "--plot", "--out", text(&out)]);
        assert!(output.status.success(), "{output:?}");
        let report = json_of(&output);
        let keys = ["nx", "ny", "size_x", "size_y", "undefined", "sa", "sq", "ssk", "sku", "min", "max"];
        for (key, expected) in keys.iter().zip(numbers) {
            let found = report[*key].as_f64().unwrap();
            assert!((found - expected).abs() <= 1e-6 * expected.abs(), "{name} {key}: {found} {expected}");
        }
        for key in KEYS {
            // parameters that a small surface does not have are null
            assert!(report.get(key).is_some_and(|value| value.is_f64() || value.is_null()), "{name} {key}");
        }
        let page = format!("{}_surface", name.split('.').next().unwrap());
        assert_pictures(
            &out,
            &page,
            &[
                "Height",
                "Profile",
                "wavenumber",
                "Autocorrelation",
                "Height distribution",
                "material ratio",
                "Sk",
            ],
        );
    }
}

#[test]
fn bad_files_give_one_line() {
    assert_refused(&["surface", "none.x3p"], &["none.x3p"]);
    assert_refused(&["surface", text(&data("README.md"))], &["README.md: neither x3p"]);
    let folder = tempfile::tempdir().unwrap();
    let damaged = folder.path().join("damaged.sur");
    std::fs::write(&damaged, &std::fs::read(data("cut.sur")).unwrap()[..1000]).unwrap();
    assert_refused(&["surface", text(&damaged)], &["damaged.sur: the data of 24 x 18 points"]);
    // without spacing there is no slope, but there are heights
    let plain = folder.path().join("plain.txt");
    std::fs::write(&plain, "1e-6 2e-6\n3e-6 5e-6\n").unwrap();
    let report = json_of(&stribeck(&["surface", text(&plain), "--json"]));
    assert!(report["sdq"].is_null() && report["size_x"].is_null() && report["sa"].is_f64(), "{report}");
    std::fs::write(&plain, "0.1 0.2\n0.3 0.5\n").unwrap();
    let report = stribeck(&["surface", text(&plain), "--json"]);
    let (warning, report) = (error_of(&report), json_of(&report));
    let listed = report["warnings"].as_array().unwrap();
    assert_eq!(listed.len(), 1, "{report}");
    assert!(listed[0].as_str().unwrap().starts_with("the unit of the heights is not known"), "{report}");
    assert!(warning.contains("plain.txt: the unit of the heights is not known"), "{warning}");
    let named = stribeck(&["surface", text(&plain), "--unit", "um", "--json"]);
    assert_eq!((error_of(&named), json_of(&named)["unit"].as_str()), (String::new(), Some("um")));
    assert_refused(&["surface", text(&plain), "--unit", "volt"], &["--unit", "volt", "unit of length"]);
    std::fs::write(&plain, "unit: um\n0.1 0.2\n0.3 0.5\n").unwrap();
    assert_eq!(error_of(&stribeck(&["surface", text(&plain)])), "");
}

#[test]
fn a_long_profile_has_a_spectrum_and_a_developed_length() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("trace.csv");
    // 1 and 2 um by turns of 100 points, positions rounded to a tenth
    let row = |k: usize| format!("{:.1},{}\n", 0.15625 * k as f64, 76_320.5 + (k / 100 % 2) as f64);
    std::fs::write(&path, "x (um),z (um)\n".to_owned() + &(0..9600).map(row).collect::<String>()).unwrap();
    let out = folder.path().join("out");
    let output = stribeck(&["surface", text(&path), "--json", "--plot", "--out", text(&out)]);
    let report = json_of(&output);
    assert_eq!((report["nx"].as_u64(), report["undefined"].as_u64()), (Some(9600), Some(0)), "{report}");
    assert!(report["sdr"].as_f64().unwrap() > 0.0, "{report}");
    assert!(report["warnings"][0].as_str().unwrap().contains("9600 equidistant ones"), "{report}");
    assert_pictures(&out, "trace_surface", &["profiles along x", "Height, colours 76320.5"]);
    let svg = std::fs::read_to_string(out.join("trace_surface.svg")).unwrap();
    assert!(!svg.contains("no spectrum") && !svg.contains("profiles along y"));
    assert_refused(&["surface", text(&path), "--channel", "2"], &["trace.csv: one surface alone"]);
    std::fs::write(&path, "nan nan nan\nnan nan nan\n").unwrap();
    assert_refused(&["surface", text(&path)], &["trace.csv: all 6 points", "undefined"]);
    let picture = folder.path().join("a.png");
    std::fs::write(&picture, b"\x89PNG\r\n\x1a\n").unwrap();
    let refused = error_of(&stribeck(&["surface", text(&picture)]));
    assert!(refused.contains("PNG picture") && !refused.contains("stribeck.surface.read"), "{refused}");
}

/// A rough roller of radius 4 mm and its axis along y, tilted, with its heights in micrometres.
fn roller() -> String {
    let mut file = "# Width: 640 um\n# Height: 480 um\n# Value units: um\n".to_owned();
    for j in 0..48 {
        let row = (0..64).map(|i| {
            let (x, y) = (f64::from(i) * 10.0 - 320.0, f64::from(j) * 10.0 - 240.0);
            let rough = 0.05 * f64::from((i * 7 + j * 13) % 5 - 2);
            format!("{:.6}", (4000.0_f64.powi(2) - x * x).sqrt() + 0.02 * y + rough)
        });
        file += &(row.collect::<Vec<_>>().join("\t") + "\n");
    }
    file
}

#[test]
fn forms_are_named_and_removed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("roller.txt");
    std::fs::write(&path, roller()).unwrap();
    let sq = |options: &[&str]| {
        let output = stribeck(&[&["surface", text(&path), "--json"], options].concat());
        (json_of(&output)["sq"].as_f64().unwrap(), error_of(&output))
    };
    let (whole, warning) = sq(&[]);
    assert!(warning.contains("a form of the second degree holds") && warning.contains("--form"), "{warning}");
    let (level, warning) = sq(&["--level"]);
    assert!(warning.contains("a form of the second degree") && level < whole, "{warning}");
    // heights 0, 0.05 and 0.1 um by turns: Sq is 0.0707 um
    for options in [["--form", "cylinder"], ["--form", "polynomial"]] {
        let (rough, warning) = sq(&options);
        assert!(
            (rough / 0.0707e-6 - 1.0).abs() < 0.02 && warning.is_empty(),
            "{options:?}: {rough} {warning}"
        );
    }
    let (filtered, _) = sq(&["--level", "--filter", "80 um"]);
    assert!(filtered < 0.3 * level, "{filtered} {level}");
    std::fs::write(
        &path,
        "# unit: um\n".to_owned()
            + &(0..8).map(|j| format!("{j} {} {}.5\n", j + 2, j + 4)).collect::<String>(),
    )
    .unwrap();
    let (_, warning) = sq(&[]);
    assert!(warning.contains("a plane holds") && warning.contains("--level"), "{warning}");
}

#[test]
fn a_file_without_a_reader_comes_with_the_line_that_converts_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vk4");
    std::fs::write(&path, b"VK4_\0\0\0").unwrap();
    assert_refused(
        &["surface", text(&path)],
        &["Keyence vk4", "stribeck[formats]", "stribeck.surface.read(", "a.x3p"],
    );
    let path = folder.path().join("two.txt");
    std::fs::write(&path, "# Channel: Z\n# unit: nm\n1 2\n3 5\n# Channel: Phase\n7 8\n9 1\n").unwrap();
    assert_refused(&["surface", text(&path)], &["1 \"Z\", 2 \"Phase\"", "channel = 1 to 2"]);
    let chosen = json_of(&stribeck(&["surface", text(&path), "--channel", "2", "--json"]));
    assert!((chosen["mean"].as_f64().unwrap() / 6.25e-9 - 1.0).abs() < 1e-12, "{chosen}");
}

/// The command, the library and (`python/tests/test_surfaces.py`) the Python package make the same surfaces.
#[test]
fn generated_surfaces_of_all_kinds_are_those_of_the_library() {
    use std::io::Read;
    let folder = tempfile::tempdir().unwrap();
    let kinds = [
        "kind = \"gaussian\"\nrq = 2e-8\nlength_x = 6e-5\nlength_y = 9e-5\nseed = 1",
        "kind = \"exponential\"\nrq = 2e-8\nlength_x = 6e-5\nlength_y = 6e-5\nskewness = -1.0\nkurtosis = 5.0\nseed = 2",
        "kind = \"self_affine\"\nrq = 2e-8\nhurst = 0.8\nroll_off = 2e-4\nshortest = 4e-5\nseed = 3",
        "kind = \"self_affine\"\nrq = 2e-8\nhurst = 0.7\nroll_off = 2e-4\nsynthesis = \"random_phase\"\nseed = 4",
        "kind = \"dimples\"\nradius = 2e-5\ndepth = 1e-8\npitch = 1e-4\nlayout = \"random\"\nseed = 5",
        "kind = \"grooves\"\nwidth = 2e-5\ndepth = 1e-8\npitch = 1e-4\ndirection = \"along_y\"",
    ];
    let base = std::fs::read_to_string(repository("examples/scenes/dry_history.toml")).unwrap();
    let (before, rest) = base.split_once("[roughness.ball]").unwrap();
    let (_, after) = rest.split_once("[plastic]").unwrap();
    for (k, table) in kinds.into_iter().enumerate() {
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, format!("{before}[roughness.disc]\n{table}\n\n[plastic]{after}")).unwrap();
        let scene = stribeck::sim::Scene::load(&path).unwrap();
        let expected = scene.roughness.disc.heights(&scene.grid().unwrap()).unwrap();
        let out = folder.path().join(format!("run{k}"));
        let output =
            stribeck(&["run", text(&path), "--steps", "1", "--time-step", "1 s", "--out", text(&out)]);
        assert!(out.join("fields.npz").exists(), "{table}: {output:?}");
        let mut archive = zip::ZipArchive::new(std::fs::File::open(out.join("fields.npz")).unwrap()).unwrap();
        let mut bytes = Vec::new();
        archive.by_name("disc_initial.npy").unwrap().read_to_end(&mut bytes).unwrap();
        let found = stribeck::surface::read_bytes(&bytes, "disc_initial.npy").unwrap();
        let bits = |values: &[f64]| values.iter().map(|z| z.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(found.heights()), bits(&expected), "{table}");
    }
}
