//! The load on solids by `check` against that of `solve`.
#![expect(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{json_of, repository, stribeck, text};
use stribeck::sim::Scene;
use stribeck::sim::solve_contact;

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
        assert!(found > 0.7 || !words.contains("boundary"), "{about}: {found}, {words}");
    }
}
