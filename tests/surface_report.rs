//! The examples that read surface files, from the outside: `surface_report` and `mtm_zddp --surface`.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Mutex;

use serde_json::Value;

/// One build at a time.
static BUILDING: Mutex<()> = Mutex::new(());

/// An example, brought up to date: `cargo test` builds it, `cargo test --test surface_report` does not.
fn example(name: &str) -> PathBuf {
    let lock = BUILDING.lock();
    let test = std::env::current_exe().unwrap();
    let folder = test.parent().and_then(Path::parent).unwrap();
    let profile = match folder.file_name().and_then(|name| name.to_str()).unwrap() {
        "debug" => "test",
        other => other,
    };
    let built = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--offline", "--profile", profile, "--example", name, "--target-dir"])
        .arg(folder.parent().unwrap())
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(built.status.success(), "{built:?}");
    drop(lock);
    folder.join("examples").join(format!("{name}{}", std::env::consts::EXE_SUFFIX))
}

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/surfaces").join(name)
}

fn run(program: &Path, file: &Path, out: &Path, more: &[&str]) -> Output {
    Command::new(program).arg(file).arg("--out").arg(out).args(more).output().unwrap()
}

/// One line on standard error, status 1.
fn refused(output: &Output, expected: &str) {
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.lines().count() == 1 && message.contains(expected), "{expected}: {message}");
}

const KEYS: [&str; 20] = [
    "sa", "sq", "ssk", "sku", "sp", "sv", "sz", "sdq", "sdr", "sal", "str", "sk", "spk", "svk", "smr1",
    "smr2", "vmp", "vmc", "vvc", "vvv",
];

#[test]
fn the_report_has_all_parameters_of_every_format_and_a_page() {
    let program = example("surface_report");
    let folder = tempfile::tempdir().unwrap();
    let table = std::fs::read_to_string(data("expected.csv")).unwrap();
    for line in table.lines().skip(1) {
        let (name, numbers) = line.split_once(',').unwrap();
        let numbers: Vec<f64> = numbers.split(',').map(|number| number.parse().unwrap()).collect();
        let page = folder.path().join("pages").join(format!("{name}.svg"));
        let output = run(&program, &data(name), &page, &["--json"]);
        assert!(output.status.success(), "{output:?}");
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        let keys = ["nx", "ny", "size_x", "size_y", "undefined", "sa", "sq", "ssk", "sku", "min", "max"];
        for (key, expected) in keys.iter().zip(numbers) {
            let found = report[*key].as_f64().unwrap();
            assert!((found - expected).abs() <= 1e-6 * expected.abs(), "{name} {key}: {found} {expected}");
        }
        for key in KEYS {
            // what a small surface does not have is null, but there
            assert!(report.get(key).is_some_and(|value| value.is_f64() || value.is_null()), "{name} {key}");
        }
        let svg = std::fs::read_to_string(&page).unwrap();
        for text in ["Height", "wavenumber", "Autocorrelation", "material ratio"] {
            assert!(svg.contains(text), "{name}: no {text}");
        }
    }
}

#[test]
fn bad_files_give_one_line() {
    let program = example("surface_report");
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.svg");
    refused(&run(&program, Path::new("none.x3p"), &page, &[]), "none.x3p");
    refused(&run(&program, &data("README.md"), &page, &[]), "README.md: neither x3p");
    let damaged = folder.path().join("damaged.sur");
    std::fs::write(&damaged, &std::fs::read(data("cut.sur")).unwrap()[..1000]).unwrap();
    refused(&run(&program, &damaged, &page, &[]), "damaged.sur: the data of 24 x 18 points");
    refused(&run(&program, &data("cut.sur"), &page, &["--unknown"]), "--unknown");
    // without spacing there is no slope, but there are heights
    let text = folder.path().join("plain.txt");
    std::fs::write(&text, "1e-6 2e-6\n3e-6 5e-6\n").unwrap();
    let output = run(&program, &text, &page, &["--json"]);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(report["sdq"].is_null() && report["size_x"].is_null() && report["sa"].is_f64(), "{report}");
}

#[test]
fn any_file_can_be_the_disc_of_the_test_rig() {
    let program = example("mtm_zddp");
    let folder = tempfile::tempdir().unwrap();
    let with = |surface: &Path| {
        Command::new(&program)
            .args(["--quick", "--grid", "32", "--steps", "1", "--surface"])
            .arg(surface)
            .arg("--out")
            .arg(folder.path())
            .output()
            .unwrap()
    };
    // the small files cover a few micrometres; with other spacings they cover enough
    let wide = stribeck::surface::read(data("cut.x3p")).unwrap().with_spacing(3e-6, 5e-6).unwrap();
    let (x3p, text) = (folder.path().join("wide.x3p"), folder.path().join("wide.txt"));
    stribeck::surface::write_x3p(&x3p, &wide).unwrap();
    stribeck::surface::write_text(&text, &wide).unwrap();
    let npy = folder.path().join("nodes.npy");
    stribeck::surface::write_npy(&npy, 32, 32, &[0.0; 1024]).unwrap();
    for file in [x3p, text, npy, data("compressed.sur"), data("binary.sdf"), data("cut.plu")] {
        let output = with(&file);
        assert!(output.status.success(), "{}: {output:?}", file.display());
    }
    refused(&with(&data("cut.x3p")), "repeated more often");
    refused(&with(&data("README.md")), "README.md");
    let small = folder.path().join("small.npy");
    stribeck::surface::write_npy(&small, 2, 2, &[0.0; 4]).unwrap();
    refused(&with(&small), "2 x 2 heights without spacing");
}
