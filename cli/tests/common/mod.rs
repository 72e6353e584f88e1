//! Runs of the command, and its files.
#![allow(dead_code, reason = "not every test looks at everything")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// Runs `stribeck` with these arguments.
pub(crate) fn stribeck<S: AsRef<std::ffi::OsStr>>(arguments: &[S]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stribeck")).args(arguments).output().unwrap()
}

/// A file of the repository.
pub(crate) fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

pub(crate) fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

pub(crate) fn json_of(output: &Output) -> Value {
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}, {output:?}"))
}

pub(crate) fn error_of(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Ended with 2, nothing on standard output, one line on standard error with these words.
pub(crate) fn assert_refused<S: AsRef<std::ffi::OsStr>>(arguments: &[S], words: &[&str]) {
    let output = stribeck(arguments);
    let message = error_of(&output);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{message}");
    assert!(message.starts_with("error: ") && message.lines().count() == 1, "{message}");
    for word in words {
        assert!(message.contains(word), "no `{word}` in `{message}`");
    }
}

/// `name.svg` in `folder` is a drawing with these words, `name.png` a picture with the colours of one.
pub(crate) fn assert_pictures(folder: &Path, name: &str, words: &[&str]) {
    let svg = std::fs::read_to_string(folder.join(format!("{name}.svg"))).unwrap();
    let drawing = roxmltree::Document::parse(&svg).unwrap();
    let drawn: Vec<&str> = drawing.descendants().filter_map(|node| node.text()).map(str::trim).collect();
    for word in words {
        assert!(drawn.iter().any(|text| text.contains(word)), "{name}: no {word} in {drawn:?}");
    }
    let png = image::open(folder.join(format!("{name}.png"))).unwrap().to_rgb8();
    let root = drawing.root_element();
    let size = ["width", "height"].map(|side| root.attribute(side).unwrap().parse::<u32>().unwrap());
    assert_eq!([png.width(), png.height()], size);
    let colours: std::collections::BTreeSet<[u8; 3]> = png.pixels().map(|pixel| pixel.0).collect();
    assert!(colours.len() > 20, "{name}: {} colours", colours.len());
}

/// The rough scene of the repository on 32 x 32 cells, with roughness that they hold; `more` replaces text in
/// it.
pub(crate) fn rough(folder: &Path, more: &[(&str, &str)]) -> PathBuf {
    let mut scene = std::fs::read_to_string(repository("examples/scenes/rough.toml")).unwrap();
    for (from, to) in [("= 128", "= 32"), ("= 10e-6", "= 50e-6")].iter().chain(more) {
        assert!(scene.contains(from), "{from}");
        scene = scene.replace(from, to);
    }
    let path = folder.join("rough.toml");
    std::fs::write(&path, scene).unwrap();
    path
}
