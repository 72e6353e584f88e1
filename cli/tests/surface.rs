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
            // what a small surface does not have is null, but there
            assert!(report.get(key).is_some_and(|value| value.is_f64() || value.is_null()), "{name} {key}");
        }
        let page = format!("{}_surface", name.split('.').next().unwrap());
        assert_pictures(&out, &page, &["Height", "wavenumber", "Autocorrelation", "material ratio"]);
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
    assert!(error_of(&stribeck(&["surface", text(&plain)])).contains("sq = 1.479e-1 m is implausible"));
    std::fs::write(&plain, "unit: um\n0.1 0.2\n0.3 0.5\n").unwrap();
    assert_eq!(error_of(&stribeck(&["surface", text(&plain)])), "");
}
