//! The pages of the book: all are in the summary, their links and those of the README have targets, columns have
//! names, and default settings are those of the code.

use std::fs;
use std::path::{Path, PathBuf};

use stribeck::reynolds::NewtonSettings;
use stribeck::sim::StepRecord;

/// Targets of the links and pictures of a page.
fn targets(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| rest.split(')').next())
}

/// Headings of a page as they are linked to.
fn anchors(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    headings
        .map(|line| {
            let words = line.trim_start_matches('#').trim().to_lowercase().replace(' ', "-");
            words.chars().filter(|c| c.is_alphanumeric() || matches!(c, '-' | '_')).collect()
        })
        .collect()
}

fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let is_page = |path: &PathBuf| path.extension().is_some_and(|end| end == "md");
    let mut pages: Vec<PathBuf> =
        fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path()).filter(is_page).collect();
    pages.push(root.join("README.md"));
    pages
}

#[test]
fn links_have_existing_targets() {
    let (mut links, mut broken) = (0, Vec::new());
    for page in pages() {
        let text = fs::read_to_string(&page).unwrap();
        for target in targets(&text).filter(|target| !target.starts_with("http")) {
            links += 1;
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let path = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            let found = path.exists()
                && (anchor.is_empty()
                    || anchors(&fs::read_to_string(&path).unwrap()).contains(&anchor.to_owned()));
            if !found {
                broken.push(format!("{}: {target}", page.display()));
            }
        }
    }
    assert!(links > 30, "{links} links");
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn the_summary_names_every_page() {
    let summary = include_str!("../docs/SUMMARY.md");
    for page in pages() {
        let name = page.file_name().unwrap().to_str().unwrap();
        assert!(
            ["README.md", "SUMMARY.md"].contains(&name) || summary.contains(&format!("({name})")),
            "{name} is not in the summary"
        );
    }
}

#[test]
fn every_column_of_a_history_is_documented() {
    let document = include_str!("../docs/output.md");
    let header = StepRecord::csv_header();
    let missing: Vec<&str> =
        header.split(',').filter(|column| !document.contains(&format!("`{column}`"))).collect();
    assert!(missing.is_empty(), "not in docs/output.md: {missing:?}");
}

#[test]
fn default_settings_of_newton_in_the_book_are_those_of_the_code() {
    let page = include_str!("../docs/newton.md");
    let settings = NewtonSettings::default();
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let (term, reduction) = settings.pseudo_transient;
    for (row, default) in [
        ("film homotopy", format!("{} times at the start", settings.first_contact_film)),
        ("pseudo-transient term", format!("{} of the entrainment, times {reduction}", percent(term))),
        ("stall", format!("{} steps", settings.stall_window)),
        ("linear systems", percent(settings.krylov_tolerance)),
    ] {
        let line = page.lines().find(|line| line.starts_with(&format!("| {row} |")));
        let stated = line.and_then(|line| line.split('|').nth(3)).unwrap();
        assert!(stated.contains(&default), "{row}: {default} is not in `{stated}`");
    }
    let least_ratio =
        format!("the next ratio of film cut-offs would be below {}.", settings.least_film_ratio);
    assert!(page.contains(&least_ratio), "{least_ratio}");
}

/// A file of tests that no program names would not run.
#[test]
fn all_files_of_tests_are_built() {
    let named = [include_str!("suite.rs"), include_str!("../Cargo.toml")].concat();
    for entry in fs::read_dir("tests").unwrap() {
        let path = entry.unwrap().path();
        let Some(name) = path.file_name().and_then(|name| name.to_str()?.strip_suffix(".rs")) else {
            continue;
        };
        let is_named = named.contains(&format!("mod {name};")) || named.contains(&format!("tests/{name}.rs"));
        assert!(is_named, "tests/suite.rs does not name {name}");
    }
}
