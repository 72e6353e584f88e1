//! What several tests share.

pub(crate) mod coated;
pub(crate) mod dense;
pub(crate) mod free_volume;
pub(crate) mod scene_text;

use std::path::{Path, PathBuf};
use std::process::Command;

/// The example `name`, brought up to date: `cargo test` builds it, `cargo test --test` of one file does not.
pub(crate) fn example(name: &str) -> PathBuf {
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
    folder.join("examples").join(format!("{name}{}", std::env::consts::EXE_SUFFIX))
}
